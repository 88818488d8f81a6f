"""What a mesh bridges: gaps of the scan, and whether the mesh may stand."""
