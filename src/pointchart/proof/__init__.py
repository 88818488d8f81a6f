"""What is proved of a mesh on every run."""
