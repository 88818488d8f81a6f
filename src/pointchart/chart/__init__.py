"""Parameters of a finished mesh."""
