"""Libraries that some formats need, imported on first use."""

from importlib import import_module
from types import ModuleType

from ..errors import FormatError
from .source import AnyPath


def extra_module(path: AnyPath, module: str, extra: str) -> ModuleType:
    """Import a library, or say which extra of the package brings it."""
    try:
        return import_module(module)
    except ImportError:
        raise FormatError(f"{path}: the package {module} is not installed; pip install 'pointchart[{extra}]'") from None
