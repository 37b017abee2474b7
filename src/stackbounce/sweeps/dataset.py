"""Sweeps in memory: parameters that vary, also as texts, become dimensions of a Dataset."""

import json
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidType, InvalidValue, all_real, shown
from stackbounce.library_types import DataArray, Dataset
from stackbounce.model import Drop
from stackbounce.run.batch import solve
from stackbounce.run.options import Options, run_options
from stackbounce.run.paths import Number, check, identifier, number_at
from stackbounce.run.result import Status
from stackbounce.units import count_written, factor, in_unit, quantity
from stackbounce.version import __version__

_MOST = 10**9
_RIGHT = "START:STOP:COUNT, with :log for logarithmic spacing, or VALUE,VALUE,…"
_OUTPUTS = {  # name in `Outcomes`: (dimension of its own, type, unit, meaning)
    "rebound_ratio": ("ball", float, "1", "velocity after the impact over the impact speed v0"),
    "collisions": ("contact", np.int64, "1", "contact intervals; -1 where infinitely many"),
    "first_touch": ("contact", float, "s", "first touch; nan where there is none"),
    "last_release": ("contact", float, "s", "last release; nan where there is no touch"),
    "energy_retained": ("", float, "1", "kinetic energy at the end over the one that came in"),
    "status": ("", np.int64, "1", "how the run ended"),
}


def grid(drop: Drop, texts: Sequence[str]) -> dict[str, NDArray[np.float64]]:
    """Return the values in SI units of each parameter that the texts describe, by its path.

    Parameters
    ----------
    drop : Drop
        The drop that has the parameters.
    texts : sequence of str
        ``PATH=START:STOP:COUNT`` for equal steps, the same with ``:log`` for equal ratios, or
        ``PATH=VALUE,VALUE,…``; values with or without units.

    Returns
    -------
    dict
        (n,) values of each.

    Raises
    ------
    InvalidValue
        If a text cannot be read, the drop has no such number, or two name the same one.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], height=1.0)
    >>> grid(drop, ["balls.0.mass=1kg:3kg:3", "height=5cm,50cm"])
    {'balls.0.mass': array([1., 2., 3.]), 'height': array([0.05, 0.5 ])}
    >>> grid(drop, ["contacts.0.stiffness=1kN/m:100kN/m:3:log"])
    {'contacts.0.stiffness': array([  1000.,  10000., 100000.])}
    >>> grid(drop, ["balls.0.mass=1g:3g:3:lin"])
    {'balls.0.mass': array([0.001, 0.002, 0.003])}
    """
    found: dict[str, NDArray[np.float64]] = {}
    for text in texts:
        path, equals, written = text.partition("=")
        if not equals or not written:
            raise InvalidValue(f"--over must be PATH={_RIGHT}, got {shown(text)}")
        number = number_at(drop, path.strip())
        values = _spaced(number, written.strip())
        if number.path in found:
            raise InvalidValue(f"--over must name each number once, got {number.path} twice")
        found[number.path] = values
    return found


def _spaced(number: Number, written: str) -> NDArray[np.float64]:
    """Return the values of a parameter that a text describes, see `grid`."""
    path, parts = number.path, written.split(":")
    if len(parts) == 1:
        return np.array([quantity(text, number.unit, path) for text in written.split(",")])
    spacing = parts[3:]
    if len(parts) < 3 or not parts[2].isdecimal() or spacing not in ([], ["log"], ["lin"]):
        raise InvalidValue(f"{path} must be {_RIGHT}, got {shown(written)}")
    start, stop = (quantity(text, number.unit, path) for text in parts[:2])
    count = count_written(parts[2])
    if count is None or not 1 <= count <= _MOST:
        many = shown(parts[2]).strip("'")
        raise InvalidValue(f"{path} must have from 1 to {_MOST} values, got {many}")
    if spacing != ["log"]:
        return np.linspace(start, stop, count)
    if not start * stop > 0.0:
        raise InvalidValue(
            f"{path} must run between numbers of one sign for :log, not from or to 0, got {written}"
        )
    return np.geomspace(start, stop, count)


def sweep(
    drop: Drop,
    values: Mapping[str, Any],
    *,
    until: float | None = None,
    rtol: float = 1e-12,
    event_limit: int = 1_000_000,
) -> Dataset:
    """Run a drop for all combinations of other parameter values; return the results.

    Parameters
    ----------
    drop : Drop
        The base: every number that does not vary.
    values : mapping
        The numbers that vary, by their paths: ``balls.0.mass``, ``contacts.1.stiffness``,
        ``gaps.0``, ``velocities.2``, ``impact_speed``, ``height``, ``gravity``. Each value is a
        DataArray, broadcast by the names of its dimensions; or a number or 1-D array_like, which
        gets a dimension of its own, ``balls_0_mass`` for the path ``balls.0.mass``; or a pair of a
        dimension's name and a 1-D array_like. Numbers that share a dimension vary together: 300
        values of each are 300 drops. SI units, or those of a DataArray's attribute `units`, of
        pint, or of texts: a list of them, or ``"10 g:200 g:50"``, also with ``:log``, as after
        ``--over``. Arrays of dask make the Dataset lazy, with their chunks.
    until, rtol, event_limit
        As in `simulate`, for every drop.

    Returns
    -------
    xarray.Dataset
        With the dimensions of the values: `rebound_ratio` (..., ball); `collisions`,
        `first_touch` and `last_release` in s, (..., contact); `energy_retained`; `status`, the
        numbers of `Status`. The values are its coordinates, ``balls_0_mass`` for the path
        ``balls.0.mass``; their attributes have the unit, the path and what the number is. The
        Dataset's attributes tell the version, the base, the laws' formulas and the options.

    Raises
    ------
    InvalidValue
        If the drop has no such path, or a value is not valid; the message gives the element and
        all its numbers. Errors in lazy values are raised when they are computed.
    InvalidType
        If something has the wrong type, or a value is masked.

    Notes
    -----
    Every drop is solved as by `simulate`, except two balls that come in together and are run to
    their end, under these laws. Under `Rigid` without gravity they have an engine with the same
    bits, and under linear laws (`Spring`, `Dashpot`, `StandardLinearSolid`) faster ones, which
    differ by round-off. Under `Hertz`, `PowerLaw`, `Viscoelastic`, `HuntCrossley` and `Hysteretic`
    they have another one, which differs by about `rtol`, unless the other contact is a relaxing
    solid, or one is `Hysteretic` and `rtol` below 1e-11; for a picture an `rtol` of 1e-4 is enough.
    All pass drops near their limits of accuracy on to the general one.

    The result of a drop depends on its own numbers only: it is the same bit for bit whatever the
    chunks, blocks or threads.

    Examples
    --------
    Figure 4(a) of R. Cross, Am. J. Phys. 75, 1009 (2007), at two mass ratios:

    >>> import stackbounce as sb
    >>> balls, springs = [sb.Ball(1.0), sb.Ball(1.0)], [sb.Spring(1.0), sb.Spring(1.0)]
    >>> drop = sb.Drop(balls, springs, impact_speed=1.0)
    >>> ds = sb.sweep(drop, {"balls.0.mass": [1.0, 10.0]})
    >>> ds.rebound_ratio.values.round(4)
    array([[0.7664, 1.1886],
           [0.9864, 1.1269]])
    >>> round(ds.rebound_ratio.sel(balls_0_mass=10.0, ball=1).item(), 4)
    1.1269

    Three drops, in which two numbers vary together:

    >>> pairs = {"balls.0.mass": ("row", [1.0, 2.0, 3.0]), "gaps.0": ("row", [0.0, 0.1, 0.2])}
    >>> sb.sweep(drop, pairs).sizes["row"]
    3
    """
    options = run_options(drop, until, rtol, event_limit)
    numbers, arrays = read_values(drop, values)
    return _dataset(drop, numbers, arrays, options)


def read_values(drop: Drop, values: Mapping[str, Any]) -> tuple[list[Number], list[DataArray]]:
    """Return the numbers that vary, and their values with named dimensions in SI units."""
    if not isinstance(values, Mapping):
        raise InvalidType(f"values must be a mapping of paths to values, got {shown(values)}")
    numbers = [number_at(drop, path) for path in values]
    check_together(numbers)
    arrays = [_named(number, values[number.path]) for number in numbers]
    _check_pairs(numbers, arrays)
    return numbers, arrays


def check_together(numbers: Sequence[Number]) -> None:
    """Raise if two parameters vary that determine each other: e and n of a `Hysteretic` contact."""
    for number in numbers:
        if number.field == "restitution":
            other = f"{number.part}.{number.index}.unloading_exponent"
            if any(number.path == other for number in numbers):
                raise InvalidValue(f"{number.path} and {other}: only one of the two can vary")


def _check_pairs(numbers: Sequence[Number], arrays: Sequence[DataArray]) -> None:
    """Raise if parameters share a dimension and have not as many values along it."""
    known: dict[Any, tuple[str, int]] = {}
    for number, array in zip(numbers, arrays, strict=True):
        for dim, size in array.sizes.items():
            path, other = known.setdefault(dim, (number.path, size))
            if other != size:
                raise InvalidValue(
                    f"{number.path} must have as many values along {dim} as {path}, {other}, "
                    f"got {size}"
                )


def _named(number: Number, value: Any) -> DataArray:
    """Return the values of a parameter as a DataArray of floats in SI units."""
    import xarray as xr

    own = identifier(number.path)
    if isinstance(value, tuple) and [isinstance(part, str) for part in value] == [True, False]:
        own, value = value
    all_real(number.path, value)
    if isinstance(value, str) and {*value} & {*":,"}:
        value = _spaced(number, value)
    if isinstance(value, xr.DataArray):
        data = in_unit(value.data, number.unit, number.path)
        array = value if data is value.data else value.copy(data=data)
    else:
        value = in_unit(value, number.unit, number.path)
        try:
            plain = np.asarray(value) if not hasattr(value, "dask") else value
        except ValueError as error:
            raise InvalidType(f"{number.path} must be numbers, got {shown(value)}") from error
        if plain.ndim > 1:
            raise InvalidValue(
                f"{number.path} must be a number, one dimension of them, or a DataArray with named "
                f"dimensions, got {plain.ndim} dimensions"
            )
        array = xr.DataArray(plain, dims=[own] * plain.ndim)
    clash = {"ball", "contact", *_OUTPUTS} & {*array.dims, *array.coords}
    if clash:
        raise InvalidValue(
            f"{number.path} has a dimension or coordinate named {clash.pop()}, as results are"
        )
    if array.dtype.kind not in "iuf":
        raise InvalidType(f"{number.path} must be numbers, got {array.dtype}")
    given = str(array.attrs.get("units") or number.unit)
    if given != number.unit:
        array = array * factor(given, number.unit, number.path)
    array = array.astype(float)
    array.attrs = dict(number.attributes)
    return array


def _dataset(
    drop: Drop, numbers: Sequence[Number], arrays: Sequence[DataArray], options: Options
) -> Dataset:
    import xarray as xr

    dims = tuple(dict.fromkeys(dim for array in arrays for dim in array.dims))
    if any(array.chunks is not None for array in arrays):
        dims = ()  # a chunk does not know its place in the array
    size = len(drop.balls)
    own = [[dim] if dim else [] for dim, *_ in _OUTPUTS.values()]

    def run(*blocks: NDArray[np.float64]) -> tuple[NDArray[Any], ...]:
        return run_block(drop, numbers, dims, options, blocks)

    if not numbers:
        made = [xr.DataArray(array, dims=dim) for array, dim in zip(run(), own, strict=True)]
    else:
        made = xr.apply_ufunc(
            run,
            *arrays,
            output_core_dims=own,
            dask="parallelized",
            output_dtypes=[kind for _, kind, *_ in _OUTPUTS.values()],
            dask_gufunc_kwargs={"output_sizes": {"ball": size, "contact": size}},
        )
    for array, (_, _, unit, meaning) in zip(made, _OUTPUTS.values(), strict=True):
        array.attrs = {"units": unit, "long_name": meaning}
    made[-1].attrs["flag_values"] = [int(status) for status in Status]
    made[-1].attrs["flag_meanings"] = " ".join(status.name for status in Status)
    index = {"ball": np.arange(size), "contact": np.arange(size)}
    coordinates: dict[Any, DataArray] = dict(made[0].coords)
    coordinates |= zip([identifier(number.path) for number in numbers], arrays, strict=True)
    found = dict(zip(_OUTPUTS, made, strict=True)) | coordinates
    # variables: xarray would align arrays whose dimension has other labels than the values
    variables = {name: array.variable for name, array in found.items()}
    data = xr.Dataset(variables, index, _provenance(drop, numbers, options))
    return data.set_coords(coordinates)


def check_along(drop: Drop, dim: str, values: Mapping[str, NDArray[np.float64]]) -> None:
    """Raise for the first values, of numbers that vary together, with which the drop is not valid.

    ``values`` are 1-D, by path, and have the dimension ``dim``.
    """
    rows = {number_at(drop, path): axis for path, axis in values.items()}
    check(drop, rows, lambda index: f"(at {dim} {index[0]})")


def run_block(
    drop: Drop,
    numbers: Sequence[Number],
    dims: Sequence[Any],
    options: Options,
    blocks: Sequence[NDArray[np.float64]],
) -> tuple[NDArray[Any], ...]:
    """Validate and run one block of a sweep; return an array for each output variable.

    ``blocks`` are the values of ``numbers``; they broadcast with each other.
    """
    rows = dict(zip(numbers, blocks, strict=True))
    shape = np.broadcast_shapes(*(block.shape for block in blocks))

    def where(index: Sequence[int]) -> str:
        place = ", ".join(f"{dim} {i}" for dim, i in zip(dims, index, strict=False))
        there = ", ".join(
            f"{number.path} = {np.broadcast_to(values, shape)[tuple(index)]:.10g}"
            for number, values in rows.items()
        )
        return f"(at {place}: {there})" if place else f"(at {there})"

    check(drop, rows, where)
    out = solve(drop, rows, shape, options)
    found = (getattr(out, name) for name in _OUTPUTS)
    return tuple(array.reshape(shape + array.shape[1:]) for array in found)


def _provenance(drop: Drop, numbers: Sequence[Number], options: Options) -> dict[str, Any]:
    """Return the attributes that record the provenance: version, base drop, laws and options.

    They hold no date, so that equal sweeps give equal files.
    """
    laws = {type(law).__name__: law.formula for law in drop.contacts if law is not None}
    return {
        "stackbounce": __version__,
        "drop": drop.to_toml(),
        "varied": json.dumps([number.path for number in numbers]),
        "laws": json.dumps(laws),
        "until": options.until,
        "rtol": options.rtol,
        "event_limit": options.event_limit,
    }
