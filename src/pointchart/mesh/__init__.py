"""The mesh: triangulated or assembled, its edges swapped, mended and measured."""
