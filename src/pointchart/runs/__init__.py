"""A run as a value: one record for the command line and the app, which execute it and get a report."""
