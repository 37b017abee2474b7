"""All units that the package reads, for the page: names, prefixes, factors and dimensions.

The page reads units as `stackbounce.units.quantity` does, which asks pint. A name has letters only.
"""

import re
from typing import Any

_NAME = re.compile(r"[^\W\d_]+")


def list_units() -> dict[str, Any]:
    """Return the names of units with factor and dimensions, the prefixes, and the dimensions.

    A unit that is no multiple of an SI unit, such as a degree Celsius, has the factor None.

    Examples
    --------
    >>> units = list_units()
    >>> factor, place = units["names"]["inch"]
    >>> round(factor, 4), units["dimensions"][place]
    (0.0254, {'[length]': 1})
    """
    import pint

    registry: Any = pint.UnitRegistry()
    dimensions: list[dict[str, float]] = []
    names: dict[str, tuple[float | None, int]] = {}
    for name in sorted(filter(_NAME.fullmatch, registry._units)):  # pint's order varies
        if not registry._units[name].is_multiplicative:
            names[name] = None, 0
            continue
        size = registry.Quantity(1.0, name).to_base_units()
        own = dict(sorted(size.dimensionality.items()))
        if own not in dimensions:
            dimensions.append(own)
        names[name] = float(size.magnitude), dimensions.index(own)
    prefixes = [
        (prefix, float(one.value))
        for prefix, one in registry._prefixes.items()
        if _NAME.fullmatch(prefix)
    ]
    return {"names": names, "prefixes": prefixes, "dimensions": dimensions}
