"""The paper's map: convex weights, and the system that places every point (sections 2 to 4)."""
