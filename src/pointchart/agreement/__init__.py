"""What the stars of neighbouring points agree on: links and a surface of triangles."""
