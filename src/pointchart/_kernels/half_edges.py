"""Half-edges of a triangle mesh: half-edge 3 t + k runs from corner k of triangle t to its next corner."""

from numba import njit


@njit(cache=True, nogil=True, inline="always")
def following(h):
    """Return the next half-edge of the same triangle."""
    return h + 1 if h % 3 < 2 else h - 2


@njit(cache=True, nogil=True, inline="always")
def preceding(h):
    """Return the previous half-edge of the same triangle."""
    return h - 1 if h % 3 > 0 else h + 2


@njit(cache=True, nogil=True)
def pair_half_edges(corners, n_points, first, leaving, twin):
    """Write the opposite of each half-edge to `twin`, -1 on the boundary; return how many edges are no manifold ones.

    An edge is none when two half-edges run the same way along it: more than two triangles, or opposite orientations.
    `first` and `leaving` are scratch space for the half-edges that leave each point, (n + 1,) and (3 m,).
    """
    first[:] = 0
    for h in range(len(corners)):
        first[corners[h] + 1] += 1
    for v in range(n_points):
        first[v + 1] += first[v]
    for h in range(len(corners)):
        v = corners[h]
        leaving[first[v]] = h
        first[v] += 1
    for v in range(n_points, 0, -1):
        first[v] = first[v - 1]
    first[0] = 0
    broken = 0
    for h in range(len(corners)):
        a, b = corners[h], corners[following(h)]
        twin[h] = -1
        for e in range(first[b], first[b + 1]):
            if corners[following(leaving[e])] == a:
                twin[h] = leaving[e]
        for e in range(first[a], first[a + 1]):
            if leaving[e] != h and corners[following(leaving[e])] == b:
                broken += 1
    return broken


@njit(cache=True, nogil=True)
def count_fans(corners, twin, fans, seen):
    """Count the fans of triangles around each point: 1 where the mesh is a manifold."""
    fans[:] = 0
    seen[:] = False
    for h in range(len(corners)):
        if seen[h]:
            continue
        fans[corners[h]] += 1
        k = h
        while k >= 0 and not seen[k]:
            seen[k] = True
            k = twin[preceding(k)]
        k = twin[h]
        while k >= 0 and not seen[following(k)]:
            k = following(k)
            seen[k] = True
            k = twin[k]


@njit(cache=True, nogil=True)
def order_rings(corners, twin, first, indptr, indices, is_open):
    """Write the neighbours of each point of a manifold mesh anticlockwise; `first` is a half-edge leaving each point.

    A boundary point begins with its neighbour along the boundary.
    """
    for v in range(len(first)):
        start = first[v]
        is_open[v] = True
        if start < 0:
            continue
        is_open[v] = False
        h = start
        while twin[h] >= 0:
            h = following(twin[h])
            if h == start:
                break
        if twin[h] < 0:
            is_open[v] = True
        begin = h
        e = indptr[v]
        while True:
            indices[e] = corners[following(h)]
            e += 1
            back = preceding(h)
            h = twin[back]
            if h < 0:
                indices[e] = corners[back]
                break
            if h == begin:
                break
