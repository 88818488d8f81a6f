"""Signs and polygons in the plane."""
