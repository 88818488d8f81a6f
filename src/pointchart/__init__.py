"""From an unorganized point cloud of one surface patch to planar parameters and a certified disc mesh."""
