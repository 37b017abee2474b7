"""Times of bounces as kinds of measurement: of knocks, and as phyphox derives them."""

from typing import Any

from stackbounce.measure.kinds.bounces.analysis import bounces
from stackbounce.measure.kinds.bounces.result import Bounces
from stackbounce.measure.setup import Setup


def analyse(data: Any, setup: Setup) -> Bounces:
    """Return the restitutions that times of bounces tell."""
    return bounces(data, drop_height=setup.drop_height, gravity=setup.gravity, drag=setup.drag)
