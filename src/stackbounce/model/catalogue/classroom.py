"""Balls that a class owns: each figure with its source, and whether it is measured.

A measured figure comes first, then the middle of what the rules of the game allow, then an
estimate, which says how it was made. The figures of a ball's bounce hold for the drop height or
speed that their source names; a ball of another make, pressure or age has others.

Source of the compressions: L. J. Dowell and G. Krebs, Br. J. Sports Med. 25, 34 (1991), who dropped
balls on carbon paper. They found a compression of d = c v, as of a linear spring, which gives
the contact time π c.
"""

import math
from dataclasses import dataclass

from stackbounce.model.ball import Ball
from stackbounce.model.catalogue.entry import ESTIMATE, MEASURED, RULE, CatalogueBall
from stackbounce.model.laws import Hysteretic


@dataclass(frozen=True)
class Figure:
    """A number in SI units, what it is, and where it comes from.

    Examples
    --------
    >>> Figure(0.057, "measured", "Cross 2007, section III").value
    0.057
    """

    value: float
    kind: str
    source: str


def _middle(low: float, high: float, source: str) -> Figure:
    return Figure(0.5 * (low + high), RULE, source)


def _round(low: float, high: float, source: str) -> Figure:
    """Return the diameter that belongs to the middle of two circumferences in m."""
    return Figure(0.5 * (low + high) / math.pi, RULE, source)


def _compressed(slope: float, ball: str) -> Figure:
    """Return the contact time of a ball whose compression is `slope`, in mm, times v in m/s."""
    measured = f"the compression of a {ball}, {slope} mm times v in m/s (Dowell, Krebs 1991)"
    source = f"π d/v from {measured}"
    return Figure(1e-3 * math.pi * slope, ESTIMATE, source)


def _ball(
    name: str, *, mass: Figure, diameter: Figure, restitution: Figure, contact_time: Figure
) -> CatalogueBall:
    """Return a ball whose contact has the restitution and the contact time exactly."""
    given = {"mass": mass, "diameter": diameter}
    bounce = {"restitution": restitution, "contact_time": contact_time}
    numbers = {key: figure.value for key, figure in bounce.items()}
    wanted = numbers | {"mass": mass.value, "exponent": 1.0, "impact_speed": 1.0}
    figures = given | bounce
    sources = {key: figure.source for key, figure in figures.items()}
    kinds = {key: figure.kind for key, figure in figures.items() if figure.kind != MEASURED}
    if ESTIMATE in (mass.kind, restitution.kind, contact_time.kind):
        kinds["stiffness"] = ESTIMATE
    sources["stiffness"] = "from mass, contact time and restitution, as a Hysteretic contact"
    return CatalogueBall(
        ball=Ball(mass=mass.value, diameter=diameter.value, name=name),
        stiffness=Hysteretic.calibrated(wanted).stiffness,
        static_stiffness=None,
        sources=tuple(sources.items()),
        kinds=tuple(kinds.items()),
        lossy=True,
        **numbers,
    )


_CROSS = "Cross 2007, section III"
_TABLE_I = "Cross 2007, Table I: ball B2"
_JENA = "Jena, Wassin, Gibbon, Eur. J. Phys. 42, 025001 (2021)"
_IHF = "IHF rule 3:2 (balls.com/rules/handball-not-the-indoor-variety.html)"
_FIVB = "FIVB rules (blog.sportsgeo.com/2017/08/25/volleyball-world-of-sports)"
_FIFA = "FIFA Quality (adsport.sk/puma/technologia/fifa-quality-3)"
_RANDA = "Rules of Golf, Appendix III, as in 2016 (usga.org)"
_GLASS = "soda-lime glass: Sci. Rep. 11 (2021), s41598-021-04045-6, table 1"
_STEEL = "bearing steel 1.3536 (makeitfrom.com)"
_AFTER_A_METRE = "Hertz contact with a rigid floor after a fall from 1 m"

CLASS_BALLS: tuple[CatalogueBall, ...] = (
    _ball(
        "big basketball",
        mass=_middle(0.600, 0.650, "600 to 650 g (library.thinkquest.org/10615)"),
        diameter=_round(0.75, 0.78, "75 to 78 cm round (library.thinkquest.org/10615)"),
        restitution=Figure(
            0.81,
            MEASURED,
            "leather, 8.5 psi, from 1.31 m, linoleum on concrete (uta.edu/physics/mavballs)",
        ),
        contact_time=_compressed(3.07, "basketball"),
    ),
    _ball(
        "football",
        mass=_middle(0.410, 0.450, f"410 to 450 g, {_FIFA}"),
        diameter=_round(0.68, 0.70, f"68 to 70 cm round, {_FIFA}"),
        restitution=Figure(
            math.sqrt(1.40 / 2.00), RULE, f"1.15 to 1.65 m from 2 m on steel, {_FIFA}"
        ),
        contact_time=_compressed(2.80, "soccer ball"),
    ),
    _ball(
        "handball",
        mass=_middle(0.425, 0.475, f"425 to 475 g, {_IHF}"),
        diameter=_round(0.58, 0.60, f"58 to 60 cm round, {_IHF}"),
        restitution=Figure(
            0.75, ESTIMATE, "no measurement found; less than a basketball's, with less air pressure"
        ),
        contact_time=Figure(
            9e-3, ESTIMATE, "no measurement found; as of the other balls that are full of air"
        ),
    ),
    _ball(
        "volleyball",
        mass=_middle(0.260, 0.280, f"260 to 280 g, {_FIVB}"),
        diameter=_round(0.65, 0.67, f"65 to 67 cm round, {_FIVB}"),
        restitution=Figure(
            0.75, ESTIMATE, "no measurement found; less than a basketball's, with less air pressure"
        ),
        contact_time=_compressed(2.90, "volleyball"),
    ),
    _ball(
        "tennis ball",
        mass=Figure(0.057, MEASURED, _CROSS),
        diameter=Figure(0.066, MEASURED, _CROSS),
        restitution=Figure(
            math.sqrt(0.40 / 0.71), MEASURED, f"{_CROSS}: bounce to 0.40 m from 0.71 m"
        ),
        contact_time=Figure(5.0e-3, MEASURED, _CROSS),
    ),
    _ball(
        "ping-pong ball",
        mass=Figure(2.83e-3, MEASURED, _JENA),
        diameter=Figure(39.7e-3, MEASURED, _JENA),
        restitution=Figure(0.88, MEASURED, f"{_JENA}: from 31.5 cm, on a table"),
        contact_time=Figure(0.68e-3, MEASURED, f"{_JENA}: from 31.5 cm, on a table"),
    ),
    _ball(
        "golf ball",
        mass=Figure(0.04593, RULE, f"at most 45.93 g, {_RANDA}"),
        diameter=Figure(0.04267, RULE, f"at least 42.67 mm, {_RANDA}"),
        restitution=Figure(
            math.sqrt(0.678 / 0.92),
            MEASURED,
            "0.678 m from 0.92 m, mean of five, floor not named (socratic.org)",
        ),
        contact_time=_compressed(0.17, "golf ball"),
    ),
    _ball(
        "superball",
        mass=Figure(0.0248, MEASURED, _TABLE_I),
        diameter=Figure(0.038, MEASURED, _TABLE_I),
        restitution=Figure(0.90, MEASURED, f"{_TABLE_I}, from 20 cm"),
        contact_time=Figure(2.6e-3, MEASURED, f"{_TABLE_I}, from 20 cm"),
    ),
    _ball(
        "marble",
        mass=Figure(5.50e-3, ESTIMATE, f"a sphere of 2.563 g/cm³, {_GLASS}"),
        diameter=Figure(0.016, ESTIMATE, "a usual size"),
        restitution=Figure(
            0.97, MEASURED, "glass sphere and glass wall, ± 0.01 (liquisearch.com/soda-lime_glass)"
        ),
        contact_time=Figure(3.1e-5, ESTIMATE, f"{_AFTER_A_METRE}, 72.8 GPa and 0.222, {_GLASS}"),
    ),
    _ball(
        "steel ball",
        mass=Figure(0.0804, ESTIMATE, f"a sphere of 7.8 g/cm³, {_STEEL}"),
        diameter=Figure(0.027, MEASURED, "Hessel et al., in Cross 2007, section IV"),
        restitution=Figure(0.9, ESTIMATE, "on thick hard steel or stone; on a soft floor far less"),
        contact_time=Figure(5.5e-5, ESTIMATE, f"{_AFTER_A_METRE}, 190 GPa and 0.29, {_STEEL}"),
    ),
)
"""The balls that a class owns; their contacts lose energy as measured."""
