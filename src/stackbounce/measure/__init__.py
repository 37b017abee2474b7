"""From the files that people have to parameters with uncertainties."""

from stackbounce.measure.reading import read

__all__ = ["read"]
