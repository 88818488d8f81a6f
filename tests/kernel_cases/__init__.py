"""Arguments for every compiled kernel, in a module for each room of the kernels."""

from kernel_cases import agreement, boundary, io, map, mesh, plane, points, proof, solve, surface

CASES = (
    agreement.CASES
    | boundary.CASES
    | io.CASES
    | map.CASES
    | mesh.CASES
    | plane.CASES
    | points.CASES
    | proof.CASES
    | solve.CASES
    | surface.CASES
)
