"""What each run does: read, call the library, write; imported when a run is executed."""
