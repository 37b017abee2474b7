"""A list in place of a stiffness in N/m**exponent ended in pint's TypeError, not in words."""

import pytest

import stackbounce as sb
from stackbounce.errors import ScenarioError


def test_a_list_of_stiffnesses_is_refused():
    contact = {"law": "HuntCrossley", "stiffness": [1.5, "2 mm"], "exponent": 1.0, "dissipation": 0}
    drop = {"balls": [{"mass": 1.0}], "contacts": [contact], "impact_speed": 1.0}
    with pytest.raises(ScenarioError, match=r"contacts.0.stiffness.1 must be a stiffness"):
        sb.Drop.from_mapping(drop)
