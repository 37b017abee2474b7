"""A drop: balls, the contacts below them, the gaps between them, and the impact speed."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from typing import TYPE_CHECKING, Annotated, Any

from stackbounce.errors import (
    InvalidType,
    InvalidValue,
    finite,
    instance,
    listed,
    no_attribute,
    non_negative,
    positive,
    shown,
)
from stackbounce.model.ball import Ball
from stackbounce.model.drawing import draw_stack, names_of
from stackbounce.model.laws import LAWS, ContactLaw
from stackbounce.shown import Shown, Table
from stackbounce.units import Unit, checked, handy_text, in_unit

if TYPE_CHECKING:
    from stackbounce.explorer.notebook import ExplorerFrame

STANDARD_GRAVITY = 9.80665
"""Standard gravity in m/s**2, for the fall from `height` if `gravity` is 0."""

_MOST_ITEMS = 100_000  # far more than can be run: an endless sequence ends with an error
_FEW = 6  # velocities that are written
_INCIDENCE = ("impact_speed", "height", "velocities")


@dataclass(frozen=True, repr=False)
class Drop(Shown):
    """A falling stack of balls at t = 0, when the lowest ball touches the floor.

    Its numbers are SI, or texts or quantities of pint with a unit.

    Parameters
    ----------
    balls : sequence of Ball
        N balls, the lowest first.
    contacts : sequence of ContactLaw
        N laws; each is that of the contact below the ball with the same index. The first one is the
        contact with the floor; None means that there is no floor. Either all are rigid (`Rigid`,
        `RigidBySpeed`, `RigidLossBySpeed`) or none.
    gaps : sequence of float, optional
        N - 1 distances in m, 0 or above, each between a ball and the next one up; default all 0.
    impact_speed : float, optional
        In m/s, above 0, downward, the same for every ball.
    height : float, optional
        In m, above 0: the height of the fall from rest, which gives the impact speed. The fall has
        the acceleration `gravity`, or 9.80665 m/s**2 if `gravity` is 0.
    velocities : sequence of float, optional
        The N velocities in m/s at t = 0, up-positive, not all 0. Exactly one of `impact_speed`,
        `height` and `velocities` must be given.
    gravity : float, optional
        In m/s**2, 0 or above, during the run; 0 is the paper's assumption.

    Raises
    ------
    InvalidValue
        If a number is out of its range, a length does not fit, rigid laws are mixed with others,
        or not exactly one of `impact_speed`, `height` and `velocities` is given.
    InvalidType
        If something has the wrong type.

    Notes
    -----
    Sequences become tuples and numbers floats. The numbers are those of R. Cross, Am. J. Phys. 75,
    1009 (2007), Fig. 3.

    Examples
    --------
    >>> from stackbounce.model.laws import Spring
    >>> drop = Drop(
    ...     balls=[Ball(0.150), Ball(0.057)],
    ...     contacts=[Spring(2500), Spring(1000)],
    ...     impact_speed=3.53,
    ... )
    >>> drop.gaps, drop.start_velocities
    ((0.0,), (-3.53, -3.53))
    >>> Drop(drop.balls, drop.contacts, gaps=["2 mm"], height="63 cm").gaps
    (0.002,)
    """

    balls: Sequence[Ball]
    contacts: Sequence[ContactLaw | None]
    # None stands for all zero in the call only: __post_init__ replaces it.
    gaps: Sequence[Annotated[float, Unit("m")]] = None  # type: ignore[assignment]
    impact_speed: Annotated[float, Unit("m/s")] | None = None
    height: Annotated[float, Unit("m")] | None = None
    velocities: Sequence[Annotated[float, Unit("m/s")]] | None = None
    gravity: Annotated[float, Unit("m/s**2")] = 0.0

    def __post_init__(self) -> None:
        balls = listed("balls", self.balls, _MOST_ITEMS)
        contacts = listed("contacts", self.contacts, _MOST_ITEMS)
        given: object = self.gaps
        gaps = (0.0,) * (len(balls) - 1) if given is None else listed("gaps", given, _MOST_ITEMS)
        if not balls:
            raise InvalidValue("balls must hold at least one ball, got none")
        for i, ball in enumerate(balls):
            instance(f"balls.{i}", ball, Ball)
        _check_contacts(contacts, len(balls))
        if len(gaps) != len(balls) - 1:
            raise InvalidValue(
                f"gaps must hold one number per neighbouring pair of balls ({len(balls) - 1}), "
                f"got {len(gaps)}"
            )
        gaps = in_unit(gaps, "m", "gaps")
        gaps = tuple(non_negative(f"gaps.{i}", gap, "metres") for i, gap in enumerate(gaps))
        for i, gap in enumerate(gaps):
            if gap > 0.0 and contacts[i + 1].pulls:
                bond = type(contacts[i + 1]).__name__
                raise InvalidValue(f"gaps.{i} must be 0 at a {bond}, got {gap!r}")
        values: dict[str, Any] = {"balls": balls, "contacts": contacts, "gaps": gaps}
        values["gravity"] = checked(non_negative, "gravity", self.gravity, "m/s**2")
        for name, value in (values | self._incidence(len(balls))).items():
            object.__setattr__(self, name, value)
        if not 0.0 < self.reference_speed < math.inf:  # only a height's is computed
            raise InvalidValue(
                "height must give an impact speed above 0 and finite at "
                f"{self.gravity or STANDARD_GRAVITY!r} m/s**2, got {self.height!r}"
            )

    def _incidence(self, count: int) -> dict[str, Any]:
        given = [name for name in _INCIDENCE if getattr(self, name) is not None]
        if len(given) != 1:
            raise InvalidValue(
                "impact_speed, height and velocities: exactly one of the three must be given, "
                f"got {' and '.join(given) or 'none'}"
            )
        if self.impact_speed is not None:
            return {"impact_speed": checked(positive, "impact_speed", self.impact_speed, "m/s")}
        if self.height is not None:
            return {"height": checked(positive, "height", self.height, "metres")}
        velocities = listed("velocities", self.velocities, _MOST_ITEMS)
        if len(velocities) != count:
            raise InvalidValue(
                f"velocities must hold one number per ball ({count}), got {len(velocities)}"
            )
        velocities = in_unit(velocities, "m/s", "velocities")
        velocities = tuple(finite(f"velocities.{i}", v, "m/s") for i, v in enumerate(velocities))
        if not any(velocities):
            raise InvalidValue("velocities must not all be 0, got 0 for every ball")
        return {"velocities": velocities}

    if not TYPE_CHECKING:  # checkers know which attributes there are

        def __getattr__(self, name: str) -> Any:
            raise no_attribute(Drop, name)

    def replace(self, **changes: Any) -> "Drop":
        """Return the drop with other values of some fields.

        Parameters
        ----------
        **changes
            As of `Drop`. Another impact speed, height or velocities take the place of the one of
            the three that was given.

        Raises
        ------
        TypeError
            If a drop has no such field.
        InvalidValue, InvalidType
            As of `Drop`.

        Examples
        --------
        >>> import stackbounce as sb
        >>> drop = sb.stack("basketball", "tennis", height="63 cm").replace(impact_speed="2 m/s")
        >>> drop.height, drop.impact_speed
        (None, 2.0)
        """
        if changes.keys() & set(_INCIDENCE):
            changes = dict.fromkeys(_INCIDENCE) | changes
        return replace(self, **changes)

    @property
    def reference_speed(self) -> float:
        """The impact speed v0 in m/s, the unit of rebound ratios; or the largest start speed."""
        if self.impact_speed is not None:
            return self.impact_speed
        if self.height is not None:
            return math.sqrt(2.0 * (self.gravity or STANDARD_GRAVITY) * self.height)
        assert self.velocities is not None
        return max(abs(velocity) for velocity in self.velocities)

    @property
    def start_velocities(self) -> tuple[float, ...]:
        """The velocity of each ball at the start, (N,), in m/s, up-positive."""
        if self.velocities is not None:
            return tuple(self.velocities)
        return (-self.reference_speed,) * len(self.balls)

    @property
    def rigid(self) -> bool:
        """Return whether every contact is rigid, so that the drop is a sequence of collisions."""
        return all(law.rigid for law in self.contacts if law is not None)

    @property
    def incidence(self) -> str:
        """How the balls come in, in words: the height or the speed, and gravity.

        Examples
        --------
        >>> from stackbounce.model.laws import Rigid
        >>> Drop([Ball(0.057)], [Rigid(0.8)], height=0.63, gravity=9.81).incidence
        'from 0.63 m, at 3.516 m/s, with gravity 9.81 m/s²'
        """
        fall = f"from {handy_text(self.height, 'm')}, " if self.height is not None else ""
        speeds = [f"{velocity:.4g}" for velocity in self.velocities or ()]
        listed = ", ".join([*speeds[:_FEW], *["…"] * (len(speeds) > _FEW)])
        came = f"coming in at {listed}" if listed else f"at {self.reference_speed:.4g}"
        gravity = f", with gravity {self.gravity:.6g} m/s²" if self.gravity else ""
        return f"{fall}{came} m/s{gravity}"

    def _tables(self) -> Sequence[Table]:
        rows = [("floor", "")] if self.contacts[0] is not None else []
        stack = zip(self.balls, names_of(self.balls), self.contacts, strict=True)
        for i, (ball, name, law) in enumerate(stack):
            gap = f", gap {handy_text(self.gaps[i - 1], 'm')}" if i and self.gaps[i - 1] else ""
            if law is not None:
                rows.append((f"  contact {i}", law.described() + gap))
            size = f", {handy_text(ball.diameter, 'm')}" if ball.diameter else ""
            rows.append((name, handy_text(ball.mass, "kg") + size))
        return (Table(f"Drop {self.incidence}", ("", ""), rows[::-1]),)

    def _drawing(self) -> str:
        return draw_stack(self.balls, self.gaps, floor=self.contacts[0] is not None)

    @classmethod
    def from_mapping(cls, mapping: Mapping[str, Any]) -> "Drop":
        """Make a drop from a mapping with the keys and values of a scenario file.

        Parameters
        ----------
        mapping : mapping
            As read from TOML or JSON: ``balls`` and ``contacts`` are lists of mappings, each
            contact has a ``law`` (``"none"`` for no floor), numbers are SI and strings carry
            units.

        Returns
        -------
        Drop

        Raises
        ------
        ScenarioError
            If it cannot be read; the message begins with the path of what is wrong.

        Examples
        --------
        >>> drop = Drop.from_mapping({
        ...     "balls": [{"mass": "57 g"}],
        ...     "contacts": [{"law": "Spring", "stiffness": "22.5 kN/m"}],
        ...     "impact_speed": 1.0,
        ... })
        >>> drop.balls[0].mass, drop.contacts[0].stiffness
        (0.057, 22500.0)
        """
        from stackbounce.model.toml import read_mapping

        return read_mapping(cls, mapping)

    @classmethod
    def from_toml(cls, path: str | PathLike[str]) -> "Drop":
        """Read a drop from a scenario file in TOML; see `from_mapping` for its keys.

        Parameters
        ----------
        path : str or path-like
            The file.

        Returns
        -------
        Drop

        Raises
        ------
        InvalidType
            If `path` is no path.
        FileError
            If the file cannot be opened.
        ScenarioError
            If it is not TOML, or no drop; the message begins with the file's name.

        Examples
        --------
        >>> Drop.from_toml("no-such-file.toml")
        Traceback (most recent call last):
            ...
        stackbounce.errors.FileError: no-such-file.toml cannot be read: No such file or directory
        """
        from stackbounce.model.toml import read_toml

        return read_toml(cls, path)

    def to_mapping(self) -> dict[str, Any]:
        """Return the drop as plain dicts, lists, strings and numbers, which `from_mapping` reads.

        Examples
        --------
        >>> from stackbounce.model.laws import Spring
        >>> Drop([Ball(0.057)], [Spring(22500)], impact_speed=1).to_mapping()["contacts"]
        [{'law': 'Spring', 'stiffness': 22500.0}]
        """
        from stackbounce.model.toml import write_mapping

        return write_mapping(self)

    def to_toml(self) -> str:
        """Return the drop as a scenario file's text, which `from_toml` reads back exactly.

        Examples
        --------
        >>> from stackbounce.model.laws import Spring
        >>> print(Drop([Ball(0.057)], [Spring(22500)], impact_speed=1).to_toml())
        gaps = []
        impact_speed = 1.0
        gravity = 0.0
        <BLANKLINE>
        [[balls]]
        mass = 0.057
        <BLANKLINE>
        [[contacts]]
        law = "Spring"
        stiffness = 22500.0
        <BLANKLINE>
        """
        from stackbounce.model.toml import write_toml

        return write_toml(self.to_mapping())

    def explore(self, *, height: int = 640) -> "ExplorerFrame":
        """Return the explorer with this drop for the last line of a notebook's cell.

        Parameters
        ----------
        height : int, optional
            The height of the frame in px.

        Returns
        -------
        ExplorerFrame

        Raises
        ------
        InvalidValue
            If the explorer cannot show the drop, see `stackbounce.explore`.

        Examples
        --------
        >>> from stackbounce.model.laws import Spring
        >>> Drop([Ball(0.057)], [Spring(22500)], height=1.0).explore()
        <the explorer with 1 ball: a notebook shows it as the last line of a cell>
        """
        import stackbounce  # by its public name: the model knows nothing of the explorer

        return stackbounce.explore(self, height=height)


def _check_contacts(contacts: tuple[Any, ...], count: int) -> None:
    if len(contacts) != count:
        raise InvalidValue(
            f"contacts must hold one law per ball, the one below it ({count}), got {len(contacts)}"
        )
    for i, law in enumerate(contacts):
        if law is None and i > 0:
            raise InvalidValue(f"contacts.{i} must be a contact law, got None (for the floor only)")
        if law is not None and not isinstance(law, ContactLaw):
            known = ", ".join(LAWS)
            raise InvalidType(f"contacts.{i} must be a contact law ({known}), got {shown(law)}")
    first = {law.rigid: i for i, law in reversed(list(enumerate(contacts))) if law is not None}
    if len(first) == 2:
        one, other = (type(contacts[first[rigid]]).__name__ for rigid in (True, False))
        raise InvalidValue(
            "contacts must be all rigid or have none that is, got a mixture: "
            f"contacts.{first[True]} is {one} and contacts.{first[False]} is {other}"
        )
