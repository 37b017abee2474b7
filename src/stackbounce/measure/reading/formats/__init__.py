"""The layouts of programs, a file for each sort of them; every module here is imported."""

from importlib import import_module
from pkgutil import iter_modules

from stackbounce.measure.reading.layouts import LAYOUTS, Layout, general
from stackbounce.measure.reading.text import Text

__all__ = ["layout_of"]

for _module in iter_modules(__path__, f"{__name__}."):
    import_module(_module.name)


def layout_of(text: Text) -> Layout:
    """Return the layout of a table: that of the first program that knows it, or a general one."""
    return next((found for layout in LAYOUTS if (found := layout(text))), None) or general(text)
