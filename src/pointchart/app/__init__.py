"""A local page with the pipeline as steps, a boundary by hand, and exports; needs the extra `view`."""
