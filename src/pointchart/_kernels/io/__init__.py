"""Unpacking of what programs packed."""
