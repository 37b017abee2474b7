"""Calls that are refused in one line: ``refused_calls.toml`` lists them."""

import tomllib
from pathlib import Path

import numpy as np
import pandas as pd
import pint
import pytest
import xarray as xr

import stackbounce as sb
from stackbounce.errors import StackbounceError

CALLS = tomllib.loads(Path(__file__).with_name("refused_calls.toml").read_text("utf-8"))["calls"]
DROP = sb.Drop([sb.Ball(0.15), sb.Ball(0.057)], [sb.Spring(2500.0)] * 2, height=0.63)
NAMES = {"np": np, "pd": pd, "sb": sb, "xr": xr, "unit": pint.UnitRegistry(), "DROP": DROP}
NAMES |= {"TIMES": np.linspace(0.0, 0.02, 300), "FORCE": np.zeros(300)}
NAMES["PREDICTED"] = sb.predict(DROP, {"height": (0.63, 0.01)})


@pytest.mark.parametrize(("call", "line"), CALLS)
def test_it_says_why(call, line):
    with pytest.raises(StackbounceError) as refused:
        eval(call, dict(NAMES))
    assert str(refused.value).startswith(line)
