"""From an unorganized point cloud of one surface patch to planar parameters and a certified disc mesh.

The public names are listed in ``__init__.pyi``, where type checkers read them too; each is imported when it is first
asked for.
"""

import lazy_loader

from ._compiled import choose_folder

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
choose_folder()
