"""The rims of a surface of triangles: drawn tight to boundary points, and walked."""

from numba import njit


@njit(cache=True, nogil=True)
def draw_tight(points, triangles, ends, edge_of, sides, is_boundary, on_rim, queue, removed):
    """Remove triangles from the rims inwards whose inner corner scores as a boundary point and is obtuse.

    `queue` holds an edge a place and is scratch space; `on_rim` and `removed` are marked.
    """
    size = head = 0
    for e in range(len(ends)):
        if sides[e, 0] >= 0 and sides[e, 1] < 0:
            on_rim[ends[e, 0]] = on_rim[ends[e, 1]] = True
            queue[size] = e
            size += 1
    while head < size:
        edge = queue[head]
        head += 1
        t = sides[edge, 1] if sides[edge, 0] < 0 or removed[sides[edge, 0]] else sides[edge, 0]
        a, b = ends[edge, 0], ends[edge, 1]
        inner = triangles[t, 0] + triangles[t, 1] + triangles[t, 2] - a - b
        if on_rim[inner] or not is_boundary[inner]:
            continue
        cosine = 0.0
        for k in range(3):
            cosine += (points[a, k] - points[inner, k]) * (points[b, k] - points[inner, k])
        # The inner corner lies in Thales' circle over the rim's edge: that edge cuts a bay of the boundary short.
        if cosine < 0.0:
            removed[t], on_rim[inner] = True, True
            for other in edge_of[t]:
                if other != edge:
                    queue[size] = other
                    size += 1


@njit(cache=True, nogil=True)
def walk_rims(ends, edge_of, sides, seen, walk, starts):
    """Walk along all edges with a single triangle, at each point round the fan to the next such edge.

    Walks follow each other in `walk`; `starts` says where each begins. Returns the number of walks.
    """
    size = walks = 0
    for seed in range(len(ends)):
        if seen[seed] or sides[seed, 0] < 0 or sides[seed, 1] >= 0:
            continue
        starts[walks] = size
        walks += 1
        edge, at = seed, ends[seed, 1]
        walk[size] = ends[seed, 0]
        size += 1
        while not seen[edge]:
            seen[edge] = True
            if edge != seed:
                walk[size] = at
                size += 1
                at = ends[edge, 0] + ends[edge, 1] - at  # the other end
            triangle = sides[edge, 0]
            while True:
                for k in range(3):
                    other = edge_of[triangle, k]
                    if other != edge and (ends[other, 0] == at or ends[other, 1] == at):
                        break
                edge = other
                if sides[edge, 1] < 0:
                    break
                triangle = sides[edge, 0] + sides[edge, 1] - triangle
    starts[walks] = size
    return walks
