"""A manifold of triangles: those that no edge is too full for, turned alike."""

import numpy as np
from numba import njit

JOINED, FULL, TWISTED = 0, 1, 2  # outcomes of `join_alike`: numbers, as compiled code has no enumerations


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
