"""Height fields: terrain, towns, seabeds and contour lines over a plane."""
