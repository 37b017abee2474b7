"""The right analysis for what a file holds."""

from typing import TYPE_CHECKING

from stackbounce.errors import InvalidType, InvalidValue, shown
from stackbounce.measure.kinds import KINDS
from stackbounce.measure.quantities import Number
from stackbounce.measure.setup import Place, Setup
from stackbounce.model.drop import STANDARD_GRAVITY
from stackbounce.model.laws import ContactLaw

if TYPE_CHECKING:
    import xarray as xr

    from stackbounce.measure.finding import Finding


def analyse(
    data: "xr.Dataset",
    *,
    mass: Number | float | None = None,
    diameter: Number | float | None = None,
    contact_time: Number | float | None = None,
    restitution: Number | float | None = None,
    law: type[ContactLaw] | ContactLaw | str | None = None,
    exponent: float | None = None,
    height: Number | float | None = None,
    speed: Number | float | None = None,
    height_error: float | None = None,
    repeated: bool = False,
    measured_to: Place | tuple[Place, Place] = "bottom",
    floor: float | None = None,
    alone: "xr.Dataset | None" = None,
    tabulated: bool = False,
    time_constant: float | None = None,
    gravity: float = STANDARD_GRAVITY,
    drag_coefficient: Number | float | None = None,
    air_density: Number | float | None = None,
) -> "tuple[Finding, ...]":
    r"""Return the results of the analyses that belong to the kind of a measurement.

    Parameters
    ----------
    data : xarray.Dataset
        As `read` gives it.
    mass : float or ufloat, optional
        Of the ball, in kg: a contact time then gives a stiffness.
    diameter : float or ufloat, optional
        Of the ball, in m; needed where `measured_to` is not its bottom, and for drag.
    contact_time, restitution : float or ufloat, optional
        Of the lower ball alone, in s and dimensionless, for the gap of a stack.
    law : ContactLaw, its class or its name, optional
        Of the contact in a force waveform; touch and release then have smaller errors.
    exponent : float, optional
        Of the loading curve, where the law leaves it open.
    height : float or ufloat, optional
        From where the ball fell, in m: gives the restitution of the first bounce.
    speed : float or ufloat, optional
        Impact speed in m/s: calibrates the impulse of a force waveform.
    height_error : float, optional
        Of each height in a table, in m.
    repeated : bool, optional
        Whether a table's heights after the first are those of the first bounce in repeated drops.
    measured_to : {"bottom", "centre", "top"} or a pair of them, optional
        The point of the ball at which `height` and a table's heights were read, and that a track
        follows; a pair has the point for the drop height first, then that for the bounces.
    floor : float, optional
        Level of the floor in a track of one ball, in m as tracked.
    alone : xarray.Dataset, optional
        The floor's force under the lower ball alone; with that under the stack it gives the gap.
    tabulated : bool, optional
        Whether the contact of a press curve is the table of its points, in place of a fitted law.
    time_constant : float, optional
        Of a piezo sensor's droop, in s, which is then corrected.
    gravity : float, optional
        In m/s**2.
    drag_coefficient : float or ufloat, optional
        Of the ball in air, with `mass` and `diameter`: its drag is then taken into account in times
        and heights of bounces and in tracks. By default, or with 0, there is no air.
    air_density : float or ufloat, optional
        In kg/m**3, with a drag coefficient; by default 1.204.

    Returns
    -------
    tuple
        Of a sound `Bounces` (`FewBounces` where they are too few for a restitution) and `Knocks`;
        of knock times and of phyphox's bounces `Bounces`; of a track `Tracks`; of an acceleration
        `Accelerometer`; of a force waveform `Waveform`, with a second sensor between two balls
        `SensorGap` before it, and with `alone` `FloorGap` after it; of a press curve `Press`; of a
        table with one column of heights, the drop's above the bounces', `Heights`.

    Raises
    ------
    InvalidType
        If `data` is not from `read`.
    InvalidValue
        If there is no analysis for what `data` holds, or the analysis finds nothing.

    Notes
    -----
    A kind that has no use for an option ignores it, so that files of several kinds can be analysed
    with the same options.

    Examples
    --------
    >>> import stackbounce as sb
    >>> path = getfixture("tmp_path") / "knocks.csv"
    >>> text = '"Event time (s)","Interval (s)"\n0,0\n0.8,0.8\n1.44,0.64\n1.952,0.512\n'
    >>> _ = path.write_text(text)
    >>> (found,) = analyse(sb.read(path))
    >>> f"{found.mean.nominal_value:.3f}"
    '0.800'
    """
    options = dict(locals())
    holds = getattr(data, "attrs", {}).get("holds")
    if holds is None:
        raise InvalidType(f"data must be a Dataset from read, got {shown(data)}")
    if holds not in KINDS:
        raise InvalidValue(
            f"there is no analysis of {holds}: give the kind of measurement, one of "
            f"{', '.join(KINDS)}"
        )
    kind = KINDS[holds]
    return kind.analyse(data, Setup.of(kind.options, options))
