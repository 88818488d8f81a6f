"""The triangles on which neighbouring stars agree, made a surface, and the rims of that surface."""

import math

import numpy as np
from numba import njit

from .link_trust import are_adjacent

JOINED, FULL, TWISTED = 0, 1, 2  # outcomes of `join_alike`: numbers, as compiled code has no enumerations


@njit(cache=True, nogil=True)
def count_votes(indptr, indices, is_open, first, last, votes):
    """Count the stars that hold the triangle of each entry and its follower; the one of smallest index counts."""
    for i in range(first, last):
        begin, end = indptr[i], indptr[i + 1]
        for e in range(begin, end):
            following = e + 1 if e + 1 < end else begin
            votes[e] = 0
            if end - begin < 2 or (is_open[i] and following == begin):
                continue
            j, k = indices[e], indices[following]
            held_by_j = are_adjacent(indptr, indices, is_open, j, k, i)
            held_by_k = are_adjacent(indptr, indices, is_open, k, i, j)
            # Each triangle has an entry in every star that holds it: only one of them may count.
            if not (held_by_j and j < i) and not (held_by_k and k < i):
                votes[e] = 1 + held_by_j + held_by_k


@njit(cache=True, nogil=True)
def collect_triangles(points, indptr, indices, votes, spacing, widest, triangles, width, held):
    """Write the triangles with votes and a circumradius under `widest` local spacings; return how many.

    `width` is that radius in spacings, `held` the votes.
    """
    count = 0
    for i in range(len(points)):
        for e in range(indptr[i], indptr[i + 1]):
            if votes[e] == 0:
                continue
            j, k = indices[e], indices[e + 1 if e + 1 < indptr[i + 1] else indptr[i]]
            radius = circumradius(points, i, j, k) / max(spacing[i], spacing[j], spacing[k])
            if radius < widest:
                triangles[count, 0], triangles[count, 1], triangles[count, 2] = i, j, k
                width[count], held[count] = radius, votes[e]
                count += 1
    return count


@njit(cache=True, nogil=True, inline="always")
def circumradius(points, a, b, c):
    """Return the circumradius of a triangle, very large if it is flat."""
    ux, uy, uz = points[b, 0] - points[a, 0], points[b, 1] - points[a, 1], points[b, 2] - points[a, 2]
    vx, vy, vz = points[c, 0] - points[a, 0], points[c, 1] - points[a, 1], points[c, 2] - points[a, 2]
    wx, wy, wz = ux - vx, uy - vy, uz - vz
    nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    product = (ux * ux + uy * uy + uz * uz) * (vx * vx + vy * vy + vz * vz) * (wx * wx + wy * wy + wz * wz)
    return math.sqrt(product) / max(2.0 * math.sqrt(nx * nx + ny * ny + nz * nz), 1e-300)


@njit(cache=True, nogil=True)
def count_at_edges(edge_of, wanted, is_contested):
    """Count the triangles that want each edge, up to three, and mark those with an edge that three want."""
    for t in range(len(edge_of)):
        for e in edge_of[t]:
            wanted[e] = min(wanted[e] + 1, 3)  # all that is asked is if there are more than two, and a byte holds it
    for t in range(len(edge_of)):
        is_contested[t] = wanted[edge_of[t, 0]] > 2 or wanted[edge_of[t, 1]] > 2 or wanted[edge_of[t, 2]] > 2


@njit(cache=True, nogil=True)
def add_corner_angles(points, triangles, total):
    """Add the angles of each triangle to those at its corners, in radians."""
    for t in range(len(triangles)):
        for k in range(3):
            at, left, right = triangles[t, k], triangles[t, (k + 1) % 3], triangles[t, (k + 2) % 3]
            ux, uy, uz = (
                points[left, 0] - points[at, 0],
                points[left, 1] - points[at, 1],
                points[left, 2] - points[at, 2],
            )
            vx, vy, vz = (
                points[right, 0] - points[at, 0],
                points[right, 1] - points[at, 1],
                points[right, 2] - points[at, 2],
            )
            nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
            total[at] += math.atan2(math.sqrt(nx * nx + ny * ny + nz * nz), ux * vx + uy * vy + uz * vz)


@njit(cache=True, nogil=True)
def name_edges(triangles, first, ends, edge_of):
    """Give the edges of triangles numbers, whatever their orientation; return how many there are.

    Edge k of a triangle lies opposite to corner k. `first` is scratch space of (n_points + 1,), `ends` of (3 m, 2).
    """
    m = len(triangles)
    first[:] = 0
    for t in range(m):
        for k in range(3):
            first[min(triangles[t, (k + 1) % 3], triangles[t, (k + 2) % 3]) + 1] += 1
    for v in range(len(first) - 1):
        first[v + 1] += first[v]
    filled = np.zeros(len(first), np.int32)
    slots = np.full(3 * m, -1, np.int32)
    count = 0
    for t in range(m):
        for k in range(3):
            a, b = triangles[t, (k + 1) % 3], triangles[t, (k + 2) % 3]
            a, b = min(a, b), max(a, b)
            name = -1
            # Edges are bucketed by their smaller end: a bucket holds half a star, short enough to search in turn.
            for s in range(first[a], first[a] + filled[a]):
                if ends[slots[s], 1] == b:
                    name = slots[s]
            if name < 0:
                name = count
                ends[count, 0], ends[count, 1] = a, b
                slots[first[a] + filled[a]] = count
                filled[a] += 1
                count += 1
            edge_of[t, k] = name
    return count


@njit(cache=True, nogil=True)
def root_of(parent, is_odd, t):
    """Return the root of triangle t in a forest, and whether t has the other orientation; shortens the way."""
    root, odd = t, False
    while parent[root] != root:
        odd ^= is_odd[root]
        root = parent[root]
    turned = odd
    # `turned` tells if t is turned against the root, not against the one above it.
    while parent[t] != root and t != root:
        above, beyond = parent[t], turned ^ is_odd[t]
        parent[t], is_odd[t] = root, turned
        t, turned = above, beyond
    return root, odd


@njit(cache=True, nogil=True)
def join_alike(triangles, edge_of, sides, parent, is_odd, t):
    """Add triangle t to a surface: JOINED, or FULL if an edge has two already, or TWISTED if no orientation fits.

    Parts of the surface that are joined so far are trees of `parent`; `is_odd` tells which triangles are turned against
    the one above them.
    """
    roots, odds = (-1, -1, -1), (False, False, False)
    for k in range(3):
        if sides[edge_of[t, k], 1] >= 0:
            return FULL
    for k in range(3):
        e = edge_of[t, k]
        other = sides[e, 0]
        if other < 0:
            continue
        # Neighbours are oriented alike if they run along their edge in opposite directions.
        runs_alike = False
        for j in range(3):
            if edge_of[other, j] == e:
                runs_alike = triangles[other, (j + 1) % 3] == triangles[t, (k + 1) % 3]
        root, odd = root_of(parent, is_odd, np.int64(other))
        odd ^= runs_alike
        # Two sides on one part that ask for opposite orientations: with this triangle it would be a Moebius strip.
        for j in range(k):
            if roots[j] == root and odds[j] != odd:
                return TWISTED
        # Tuples, made anew, as an array would be allocated for each triangle.
        roots = (root if k == 0 else roots[0], root if k == 1 else roots[1], root if k == 2 else roots[2])
        odds = (odd if k == 0 else odds[0], odd if k == 1 else odds[1], odd if k == 2 else odds[2])
    parent[t], is_odd[t] = t, False
    for k in range(3):
        put_beside(sides, edge_of[t, k], t)
        if roots[k] >= 0:
            # Earlier sides may have hung t below another part.
            root, odd = root_of(parent, is_odd, t)
            if root_of(parent, is_odd, np.int64(roots[k]))[0] != root:
                parent[root], is_odd[root] = roots[k], odd ^ odds[k]
    return JOINED


@njit(cache=True, nogil=True)
def put_beside(sides, edge, t):
    """Note triangle t at an edge with room."""
    sides[edge, 0 if sides[edge, 0] < 0 else 1] = t


@njit(cache=True, nogil=True)
def keep_manifold(triangles, order, may_twist, edge_of, sides, parent, is_odd, outcome):
    """Take triangles in the given order wherever no edge gets a third one; `sides` holds the triangles at each edge.

    Those that no orientation fits come last, and only if they may. `outcome` tells of each triangle whether it was
    JOINED or TWISTED, or FULL and left out.
    """
    for t in order:
        outcome[t] = join_alike(triangles, edge_of, sides, parent, is_odd, t)
    for t in order:
        if outcome[t] == TWISTED:
            a, b, c = edge_of[t, 0], edge_of[t, 1], edge_of[t, 2]
            if not may_twist[t] or sides[a, 1] >= 0 or sides[b, 1] >= 0 or sides[c, 1] >= 0:
                outcome[t] = FULL
            else:
                for e in (a, b, c):
                    put_beside(sides, e, t)


@njit(cache=True, nogil=True)
def turn_alike(triangles, edge_of, parent, is_odd, outcome):
    """Turn joined triangles so that neighbours are oriented alike; `parent` becomes their part, -1 for the others."""
    for t in range(len(triangles)):
        if outcome[t] == JOINED:
            odd = root_of(parent, is_odd, t)[1]
            if odd:
                # Edges lie opposite to their corners, so they change places with them.
                triangles[t, 1], triangles[t, 2] = triangles[t, 2], triangles[t, 1]
                edge_of[t, 1], edge_of[t, 2] = edge_of[t, 2], edge_of[t, 1]
    for t in range(len(triangles)):
        if outcome[t] == JOINED:
            parent[t] = root_of(parent, is_odd, t)[0]
        else:
            parent[t] = -1


@njit(cache=True, nogil=True)
def close_up(sides, dropped, number):
    """Take dropped triangles from the sides of edges, and give the others their new numbers."""
    for e in range(len(sides)):
        a, b = sides[e, 0], sides[e, 1]
        a = -1 if a < 0 or dropped[a] else number[a]
        b = -1 if b < 0 or dropped[b] else number[b]
        sides[e, 0], sides[e, 1] = (b, a) if a < 0 else (a, b)


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
