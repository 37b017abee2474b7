"""Ties: what follows from what is varied, and formulas that would do harm."""

import numpy as np
import pytest

import stackbounce as sb
from drops import STACK
from refusals import refusal
from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.fitting.formula import read_formula

DATA = {"rebound_ratios": [(0.39, 0.01), (1.80, 0.01)], "durations.0": (30e-3, 1e-3)}
LOWER, UPPER = "contacts.0.stiffness", "contacts.1.stiffness"
INFINITE = ("9**9**9 * k", "(9**9999)**9999 + k", "k / 0", "log(-k)", "exp(k)")


def fitted(tie, vary=None):
    return sb.fit(STACK, DATA, vary or {"k": (500.0, 5000.0)}, tie=tie, starts=4)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("2 * a + b", 7.0),
        ("-a ** 2 / b", -4.0 / 3.0),
        ("sqrt(a) * pi", np.sqrt(2.0) * np.pi),
        ("exp(log(a))", 2.0),
        ("maximum(a, b) - minimum(a, b)", 1.0),
        ("1e-3*a + 2.5E+2*b", 750.002),
        ("balls.0.mass * .5", 0.075),
        ("\n ( a\n + 1. ) ", 3.0),
        ("e3 + 2e3", 2005.0),
        ("2**-1", 0.5),
    ],
)
def test_a_formula_computes(text, expected):
    values = {"a": 2.0, "b": 3.0, "balls.0.mass": 0.15, "e3": 5.0}
    run, _ = read_formula(text, values, "gaps.0")
    found = run({name: np.array([one, one]) for name, one in values.items()})
    assert np.broadcast_to(found, 2).tolist() == pytest.approx([expected] * 2, rel=1e-12)


@pytest.mark.parametrize(
    "text",
    [
        *("().__class__", "k.__class__", "(1,2)*1000000000", "[k]*9", "'k'*9", "k if k else k"),
        *("lambda: k", "k = 1", "k == k", "k // 2", "k @ k", "~k", "k\nk", "k[0]", "k(k)"),
        *("sqrt", "sqrt(k, k)", "sqrt(x=k)", "maximum(*k)", "open(k)", "__import__(k)"),
        *("import os", "1j * k", "0x10 * k", "1_000 * k", "True * k", "*", "k\0", "k\u00b2"),
        "\u212a",  # the sign of the kelvin, which Python reads as K
        *("(" * 240 + "k" + ")" * 240, "-" * 100_000 + "k", "k" * 100_000),
    ],
)
def test_what_is_no_formula_is_refused(text):
    said = refusal(InvalidValue, fitted, {UPPER: text})
    assert said.startswith("tie: contacts.1.stiffness ")
    assert len(said) < 1500


def fails(*_):
    raise KeyError("mass")


@pytest.mark.parametrize(
    ("ties", "message"),
    [
        *(({UPPER: text}, "= .* is not always a finite number$") for text in INFINITE),
        *(({UPPER: text}, "= .* gives no drop: ") for text in ("-k", "0 * k", "k - 1000")),
        ({UPPER: "contacts.1.stiffness * k"}, "these depend on each other in a circle: "),
        ({UPPER: f"{LOWER} * k", LOWER: UPPER}, "these depend on each other in a circle: "),
        ({UPPER: fails}, "= .* fails: 'mass'"),
        ({UPPER: lambda _: "a lot"}, "= .* fails: could not convert"),
        ({UPPER: lambda _: np.ones(77)}, "= .* fails: "),
        ({UPPER: lambda _: np.nan}, "= .* is not always a finite number"),
    ],
)
def test_what_is_not_finite_no_drop_or_a_circle_or_fails_is_refused(ties, message):
    with pytest.raises(InvalidValue, match=rf"^tie: .*{message}"):
        fitted(ties)


@pytest.mark.parametrize("formula", ["", "  ", 3.0, None, b"k", ["k"]])
def test_a_formula_is_a_text_or_a_function(formula):
    with pytest.raises(InvalidType, match=r"^tie: contacts\.1\.stiffness must have a formula"):
        fitted({UPPER: formula})


def test_ties_may_use_each_other_in_any_order():
    ties = {UPPER: "2 * contacts.0.stiffness / 5", "contacts.0.stiffness": "k"}
    one = fitted(ties)
    other = fitted(dict(reversed(ties.items())))
    alone = fitted({"contacts.0.stiffness": "k", UPPER: "0.4 * k"})
    assert one.best == other.best
    assert one.best["k"] == pytest.approx(alone.best["k"], rel=1e-9)
    law, above = one.drop.contacts
    assert above.stiffness == pytest.approx(0.4 * law.stiffness, rel=1e-12)


def test_a_diameter_that_one_drop_alone_has_changes_nothing():
    sized = STACK.replace(balls=[sb.Ball(STACK.balls[0].mass, 0.2), *STACK.balls[1:]])
    pairs = {"a": STACK, "b": sized}, {"a": STACK, "b": STACK}
    done = [
        sb.fit(two, dict.fromkeys(two, DATA), {"k": (500, 5000)}, tie={UPPER: "k"}) for two in pairs
    ]
    assert done[0].best == done[1].best


def test_a_function_of_python_is_a_tie():
    vary = {"contacts.0.stiffness": (500.0, 5000.0)}
    found = fitted({UPPER: lambda values: 0.4 * values["contacts.0.stiffness"]}, vary)
    assert found.best == fitted({UPPER: "0.4 * contacts.0.stiffness"}, vary).best


@pytest.mark.parametrize(
    ("tie", "vary", "message"),
    [
        ({"contacts.9.stiffness": "k"}, None, "is not a parameter of the drop"),
        ({UPPER: "k"}, {"k": (1.0, 2.0), UPPER: (1.0, 2.0)}, "both varied and tied"),
        ({UPPER: "2.0 * m"}, None, "has m, which is neither varied nor a number of the drop"),
        ({UPPER: "2.0 * pi"}, None, "k is neither a number of the drop nor used by a tie"),
        ({UPPER: "k * balls.0.diameter"}, None, "which the drop does not give"),
        ({UPPER: "pi"}, {"pi": (1.0, 2.0)}, "pi means something else in formulas"),
        ({UPPER: "lambda"}, {"lambda": (1.0, 2.0)}, "lambda means something else in formulas"),
        ({UPPER: "k"}, {"k": None}, "k needs bounds"),
        ({UPPER: f"k * {'9' * 400}"}, None, "cannot be read: it may have numbers up to 1e308"),
        ({UPPER: f"-{'9' * 400} + k"}, None, "cannot be read: it may have numbers up to 1e308"),
        ({UPPER: "k()"}, None, "cannot be read: it may have numbers up to 1e308"),
        ({UPPER: "k"}, {"k": ("1 kN/m", "2 kN/m")}, "^k must be a pure number"),
    ],
)
def test_names_that_do_not_fit(tie, vary, message):
    with pytest.raises(InvalidValue, match=message):
        fitted(tie, vary)


def test_a_diameter_that_is_varied_can_be_used():
    found = fitted({UPPER: "1e4 * balls.0.diameter"}, {"balls.0.diameter": (0.05, 0.3)})
    stiffness = pytest.approx(1e4 * found.best["balls.0.diameter"], rel=1e-12)
    assert found.drop.contacts[1].stiffness == stiffness


def test_shared_and_own_numbers_of_several_drops():
    other = sb.Drop([sb.Ball(0.3), sb.Ball(0.057)], STACK.contacts, impact_speed=3.5)
    drops = {"one": STACK, "contacts": other}  # a name that paths begin with
    truth = {key: sb.simulate(drop).rebound_ratios for key, drop in drops.items()}
    data = {key: {"rebound_ratios": [(one, 0.01) for one in two]} for key, two in truth.items()}
    found = sb.fit(drops, data, {UPPER: (500.0, 2000.0), "contacts.gaps.0": (0.0, 0.005)})
    assert found.best[UPPER] == pytest.approx(1000.0, rel=1e-3)
    assert found.drops["one"].gaps == (0.0,)
    assert found.best["contacts.gaps.0"] == found.drops["contacts"].gaps[0]


def test_a_number_is_varied_or_tied_once():
    drops = {"one": STACK, "two": STACK}
    data = {"one": DATA, "two": DATA}
    with pytest.raises(InvalidValue, match="is varied twice: only once for each drop"):
        sb.fit(drops, data, {UPPER: (500.0, 2000.0), "two.contacts.1.stiffness": (500.0, 2000.0)})
    with pytest.raises(InvalidValue, match="is tied twice: only once for each drop"):
        sb.fit(drops, data, {"k": (1.0, 9.0)}, tie={UPPER: "k", f"two.{UPPER}": "2 * k"})
    with pytest.raises(InvalidValue, match="is both varied and tied"):
        sb.fit(drops, data, {UPPER: (1.0, 9.0)}, tie={f"two.{UPPER}": "7"})
