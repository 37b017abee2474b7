"""Force against compression as a kind of measurement."""

from typing import Any

from stackbounce.measure.kinds.press.analysis import press
from stackbounce.measure.kinds.press.result import Press
from stackbounce.measure.setup import Setup


def analyse(data: Any, setup: Setup) -> Press:
    """Return the contact that a press curve tells."""
    return press(data, tabulated=setup.tabulated)
