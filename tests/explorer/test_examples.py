"""The examples with a class's balls: what they say is what they do."""

import re

import pytest

import stackbounce as sb
from stackbounce.cross2007.cases import list_cases
from stackbounce.explorer import LIMITS
from stackbounce.explorer.examples import list_examples

EXAMPLES = list(list_examples())


@pytest.mark.parametrize("case", EXAMPLES, ids=[case.name for case in EXAMPLES])
def test_an_example_says_what_happens(case):
    result = sb.simulate(case.drop)
    assert result.status == sb.Status.FINISHED
    top = result.rebound_ratios[-1]
    assert f"{top:.2f} times" in case.says
    heights = re.findall(r"(\d+) times the height", case.says)
    assert all(int(height) == round(top**2) for height in heights)


def test_examples_fit_the_page():
    names = [case.name for case in (*EXAMPLES, *list_cases())]
    assert len(set(names)) == len(names)
    assert all(len(case.drop.balls) <= LIMITS.balls for case in EXAMPLES)


def test_the_last_ball_of_the_cradle_takes_most_of_the_speed():
    case = next(case for case in EXAMPLES if case.name == "cradle")
    *others, next_to_last, last = sb.simulate(case.drop).rebound_ratios
    assert f"the next at {next_to_last:.2f}." in case.says
    assert max(map(abs, others)) < 0.1 * last
