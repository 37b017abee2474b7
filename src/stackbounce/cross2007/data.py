"""The paper's data: all input numbers of the audit, the tables and the figures.

Values are in SI units. ``printed`` is the number as the paper gives it. ``spread`` is the error
that the paper states, or half a unit in the last printed digit if that is larger or no error is
stated.
A spread of 0 marks a number that the paper chooses for a calculation: Fig. 5's masses and springs,
and the restitutions in eqs 1 to 4. Some of these come from a fit; the audit's row says so if their
rounding matters (71 % with e = 0.92).
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

__all__ = ["PAPER", "Data", "Input", "changed"]


@dataclass(frozen=True)
class Input:
    """One number that the paper gives.

    Parameters
    ----------
    key : str
        Its name in this package, such as ``"tennis.mass"``.
    printed : str
        As printed, with its unit.
    value : float
        In SI units.
    unit : str
        The SI unit; empty for a plain ratio.
    spread : float
        Its error in `unit`, see the module's text.
    where : str
        Section, table or figure.
    what : str
        What it is.
    """

    key: str
    printed: str
    value: float
    unit: str
    spread: float
    where: str
    what: str


Data = Mapping[str, Input]
"""The paper's numbers by key."""


def changed(data: Data, key: str, factor: float) -> Data:
    """Return the data with one value multiplied.

    Parameters
    ----------
    data : mapping of str to Input
        The data to start from.
    key : str
        The number to change.
    factor : float
        The factor.

    Returns
    -------
    mapping of str to Input

    Raises
    ------
    KeyError
        If the key is unknown.

    Examples
    --------
    >>> heavier = changed(PAPER, "tennis.mass", 1.01)
    >>> round(heavier["tennis.mass"].value, 5)
    0.05757
    """
    old = data[key]
    return MappingProxyType({**data, key: replace(old, value=old.value * factor)})


def _table(where: str, *rows: tuple[str, str, float, str, float, str]) -> dict[str, Input]:
    return {
        key: Input(key, printed, value, unit, spread, where, what)
        for key, printed, value, unit, spread, what in rows
    }


_INTRODUCTION = _table(
    "Sec. I",
    ("textbook.restitution", "no loss", 1.0, "", 0.0, "restitution of the usual explanation"),
    ("textbook.mass_ratio", "m1 >> m2", 1e9, "", 0.0, "stands for 'much heavier'"),
    ("tennis.height_ratio", "0.55", 0.55, "", 0.005, "tennis ball's usual bounce over drop height"),
)

_MODELS = _table(
    "Sec. II",
    ("models.lossless", "e = 1", 1.0, "", 0.0, "restitution of the lossless curves"),
    ("models.restitution", "e = 0.8", 0.8, "", 0.0, "restitution of the lossy curves"),
    ("models.equal", "m1 = m2, k1 = k2", 1.0, "", 0.0, "both ratios of the simplest case"),
    ("models.speed", "1 m/s", 1.0, "m/s", 0.0, "impact speed of the simplest case"),
    ("models.mass_ratio", "m1/m2 = 10", 10.0, "", 0.0, "mass ratio of the comparison"),
    ("models.stiffness_ratio", "r_k = 1", 1.0, "", 0.0, "stiffness ratio of the comparison"),
)

_FIGURE_5 = _table(
    "Fig. 5",
    ("fig5.lower_mass", "0.4 kg", 0.4, "kg", 0.0, "m1"),
    ("fig5.upper_mass", "0.2 kg", 0.2, "kg", 0.0, "m2"),
    ("fig5.floor_stiffness", "1e5 N/m", 1e5, "N/m", 0.0, "k1"),
    ("fig5.ball_stiffness", "5e3 N/m", 5e3, "N/m", 0.0, "k2"),
)

_BASKETBALL = _table(
    "Sec. III",
    ("basketball.mass", "150 g", 0.150, "kg", 0.5e-3, "basketball's mass"),
    ("basketball.diameter", "160 mm", 0.160, "m", 0.5e-3, "basketball's diameter"),
    ("tennis.mass", "57 g", 0.057, "kg", 0.5e-3, "tennis ball's mass"),
    ("tennis.diameter", "66 mm", 0.066, "m", 0.5e-3, "tennis ball's diameter"),
    ("stack.drop_height", "0.71 m", 0.71, "m", 0.005, "drop height"),
    ("basketball.rebound_height", "0.42 m", 0.42, "m", 0.005, "basketball's bounce, dropped alone"),
    ("tennis.rebound_height", "0.40 m", 0.40, "m", 0.005, "tennis ball's bounce, dropped alone"),
    ("stack.lower_height", "0.01 m", 0.01, "m", 0.005, "basketball's bounce under the tennis ball"),
    ("stack.upper_height", "1.72 m", 1.72, "m", 0.03, "tennis ball's bounce on the basketball"),
    ("stack.impact_speed", "3.53 m/s", 3.53, "m/s", 0.005, "impact speed v0"),
    ("stack.upper_speed", "5.8 m/s", 5.8, "m/s", 0.05, "tennis ball's rebound speed"),
    ("stack.lower_speed", "0.44 m/s", 0.44, "m/s", 0.005, "basketball's rebound speed"),
    ("stack.lossless", "e = 1", 1.0, "", 0.0, "restitution of the lossless estimate"),
    ("stack.restitution", "e = 0.9", 0.9, "", 0.0, "restitution of the estimate with loss"),
    ("stack.duration", "30 ms", 0.030, "s", 0.5e-3, "measured impact duration"),
    ("stack.delay", "7 ms", 0.007, "s", 0.5e-3, "measured time without a ball-ball force"),
    ("stack.gap", "2 mm", 0.002, "m", 0.5e-3, "largest separation of the two balls in the fall"),
    ("tennis.contact_time", "5.0 ms", 0.0050, "s", 0.05e-3, "tennis ball's impact duration"),
    ("fig8.drop_height", "30 cm", 0.30, "m", 0.005, "drop height of the force measurement"),
)

_STATIC_PRESS = _table(
    "Fig. 7, text",
    ("static.force", "30 N", 30.0, "N", 0.5, "press force"),
    ("static.basketball", "18.6 mm", 18.6e-3, "m", 0.05e-3, "basketball's compression"),
    ("static.tennis", "2.9 mm", 2.9e-3, "m", 0.05e-3, "tennis ball's compression"),
    ("static.both", "27.7 mm", 27.7e-3, "m", 0.05e-3, "compression of both, one on the other"),
    ("static.stiffness_ratio", "1.8", 1.8, "", 0.05, "k1/k2 under static load"),
)

_FIGURE_9 = _table(
    "Fig. 9",
    ("fig9.floor_stiffness", "2500 N/m", 2500.0, "N/m", 0.5, "k1 of the better fit"),
    ("fig9.ball_stiffness", "1000 N/m", 1000.0, "N/m", 0.5, "k2 of the better fit"),
    ("fig9.other_floor_stiffness", "2000 N/m", 2000.0, "N/m", 0.5, "k1 of the alternative"),
    ("fig9.other_ball_stiffness", "500 N/m", 500.0, "N/m", 0.5, "k2 of the alternative"),
)

_TABLE_ONE = _table(
    "Table I",
    ("B1.diameter", "58 mm", 58e-3, "m", 0.5e-3, "large superball's diameter"),
    ("B2.diameter", "38 mm", 38e-3, "m", 0.5e-3, "middle superball's diameter"),
    ("B3.diameter", "26 mm", 26e-3, "m", 0.5e-3, "small superball's diameter"),
    ("B1.mass", "101 g", 0.101, "kg", 0.5e-3, "large superball's mass"),
    ("B2.mass", "24.8 g", 0.0248, "kg", 0.05e-3, "middle superball's mass"),
    ("B3.mass", "8.5 g", 0.0085, "kg", 0.05e-3, "small superball's mass"),
    ("B1.static_stiffness", "4e4 N/m", 4e4, "N/m", 5e3, "B1's static stiffness"),
    ("B2.static_stiffness", "1.3e4 N/m", 1.3e4, "N/m", 650.0, "B2's static stiffness"),
    ("B3.static_stiffness", "1.2e4 N/m", 1.2e4, "N/m", 600.0, "B3's static stiffness"),
    ("B1.contact_time", "4.3 ms", 4.3e-3, "s", 0.1e-3, "large superball's impact duration"),
    ("B2.contact_time", "2.6 ms", 2.6e-3, "s", 0.1e-3, "middle superball's impact duration"),
    ("B3.contact_time", "1.9 ms", 1.9e-3, "s", 0.1e-3, "small superball's impact duration"),
    ("B1.restitution", "0.78", 0.78, "", 0.02, "large superball's restitution"),
    ("B1.dynamic_stiffness", "5.4e4 N/m", 5.4e4, "N/m", 500.0, "B1's dynamic stiffness"),
    ("B2.dynamic_stiffness", "3.6e4 N/m", 3.6e4, "N/m", 500.0, "B2's dynamic stiffness"),
    ("B3.dynamic_stiffness", "2.3e4 N/m", 2.3e4, "N/m", 500.0, "B3's dynamic stiffness"),
)

_SUPERBALLS = _table(
    "Sec. IV",
    ("steel.large_diameter", "38.1 mm", 38.1e-3, "m", 0.05e-3, "larger steel ball's diameter"),
    ("steel.small_diameter", "27.0 mm", 27.0e-3, "m", 0.05e-3, "smaller steel ball's diameter"),
    ("steel.time_ratio", "1.407", 1.407, "", 0.0005, "ratio of the collision times"),
    ("steel.mass_ratio", "2.815", 2.815, "", 0.0005, "ratio of the masses"),
    ("superballs.drop_height", "20 cm", 0.20, "m", 0.005, "drop height"),
    ("superballs.gap", "1 mm", 1e-3, "m", 0.5e-3, "separation of the balls in the fall"),
    ("superballs.delay", "2 ms", 2e-3, "s", 0.5e-3, "delay before the balls met"),
    ("superballs.late_delay", "7 ms", 7e-3, "s", 0.5e-3, "delay before the balls met, B1 on B3"),
    ("B2_on_B1.duration", "6.0 ms", 6.0e-3, "s", 0.05e-3, "impact duration, B2 on B1"),
    ("B1_on_B2.duration", "9.0 ms", 9.0e-3, "s", 0.05e-3, "impact duration, B1 on B2"),
    ("superballs.twin_delay", "1 ms", 1e-3, "s", 0.5e-3, "shortest delay of the two large balls"),
    ("superballs.twin_duration", "12 ms", 12e-3, "s", 0.5e-3, "impact of two large balls"),
    ("fit.restitution", "e = 0.90", 0.90, "", 0.0, "restitution that fits B1 and B2"),
    ("fit.reversed_restitution", "e = 0.92", 0.92, "", 0.0, "better one for B1 on B2"),
    ("fit.B3_restitution", "e = 0.88", 0.88, "", 0.0, "restitution that fits B1 on B3"),
    ("fit.twin_restitution", "e = 0.88", 0.88, "", 0.0, "restitution that fits B1 on B1"),
    ("fit.twin_floor", "0.76", 0.76, "", 0.0, "restitution of the floor in the other reading"),
    ("fit.twin_balls", "1.0", 1.0, "", 0.0, "restitution between the balls in the other reading"),
)

_TABLE_TWO = _table(
    "Table II",
    ("B2_on_B1.mass_ratio", "4.23", 4.23, "", 0.005, "m1/m2, B2 on B1"),
    ("B3_on_B1.mass_ratio", "12.3", 12.3, "", 0.05, "m1/m2, B3 on B1"),
    ("B2_on_B1.lower", "0.28", 0.28, "", 0.02, "e1, B2 on B1"),
    ("B2_on_B1.upper", "1.91", 1.91, "", 0.02, "e2, B2 on B1"),
    ("B1_on_B2.lower", "0.17", 0.17, "", 0.02, "e1, B1 on B2"),
    ("B1_on_B2.upper", "0.84", 0.84, "", 0.02, "e2, B1 on B2"),
    ("B1_on_B2.upper_height", "0.71", 0.71, "", 0.005, "h2/h0, B1 on B2"),
    ("B3_on_B1.lower", "0.68", 0.68, "", 0.02, "e1, B3 on B1"),
    ("B3_on_B1.upper", "2.26", 2.26, "", 0.02, "e2, B3 on B1"),
    ("B1_on_B3.lower", "0.51", 0.51, "", 0.02, "e1, B1 on B3"),
    ("B1_on_B3.upper", "0.70", 0.70, "", 0.02, "e2, B1 on B3"),
    ("B1_on_B1.lower", "0.76", 0.76, "", 0.02, "e1, B1 on B1"),
    ("B1_on_B1.upper", "0.76", 0.76, "", 0.02, "e2, B1 on B1"),
    ("B1_on_B1.mass_ratio", "1.040", 1.040, "", 0.0005, "m1/m2 of the two large balls"),
    ("tennis_on_basketball.lower", "0.18", 0.18, "", 0.005, "e1, tennis ball on basketball"),
    ("tennis_on_basketball.upper", "1.64", 1.64, "", 0.005, "e2, tennis ball on basketball"),
)

_FITS = _table(
    "Sec. V",
    ("V.exponent", "n = 2.3", 2.3, "", 0.05, "exponent of the unloading curve"),
    ("fig13.gap", "1 mm", 1e-3, "m", 0.5e-3, "d of the fit to B2 on B1"),
    ("fig13.floor_stiffness", "5.6e4 N/m", 5.6e4, "N/m", 500.0, "k1 of the fit to B2 on B1"),
    ("fig13.ball_stiffness", "1.6e4 N/m", 1.6e4, "N/m", 500.0, "k2 of the fit to B2 on B1"),
    ("B3_fit.gap", "2.4 mm", 2.4e-3, "m", 0.05e-3, "d of the fit to B3 on B1"),
    ("B3_fit.floor_stiffness", "5.4e4 N/m", 5.4e4, "N/m", 500.0, "k1 of the fit to B3 on B1"),
    ("B3_fit.ball_stiffness", "1.4e4 N/m", 1.4e4, "N/m", 500.0, "k2 of the fit to B3 on B1"),
)

PAPER: Data = MappingProxyType(
    _INTRODUCTION
    | _MODELS
    | _FIGURE_5
    | _BASKETBALL
    | _STATIC_PRESS
    | _FIGURE_9
    | _TABLE_ONE
    | _SUPERBALLS
    | _TABLE_TWO
    | _FITS
)
"""The paper's numbers by key, in the order of the paper."""
