"""Notes on a press curve, a sentence each."""

from typing import Any

from stackbounce.measure.kinds.press.result import Press

_CLEAR = 3.0  # standard errors
_WORTH = 0.02  # of a number, below which a difference gets no note


def sentences(found: Press, held: int) -> list[str]:
    """Return the notes on a cycle that has a loading.

    Parameters
    ----------
    found : Press
        Without notes.
    held : int
        Points at which the press stood still.

    Returns
    -------
    list of str
    """
    p: Any = found.exponent
    notes = []
    if found.zero.nominal_value == 0.0 and found.zero.std_dev == 0.0:
        notes.append(
            "There are no points before the contact: the zero of the force was assumed to be right."
        )
        assert found.loading is not None
        least = float(found.loading.compression.min())
        if least > 0.1 * found.peak_compression.nominal_value:
            notes.append(
                "The record begins with the ball already pressed; the contact, and with it "
                "exponent and works, follow from the curve before it."
            )
    if p.nominal_value < 1.0 - _CLEAR * p.std_dev:
        notes.append(
            "The ball gets softer as it is pressed (exponent below 1), which no power law of this "
            "package does: the straight line stands for it, or the table of its points."
        )
    notes += _on_fits(found)
    notes += _on_loss(found, held)
    return notes + _on_cycles(found)


def _on_fits(found: Press) -> list[str]:
    laws = {"loading": "one power law", "unloading": "the power law that Hysteretic unloads by"}
    curves = {name: getattr(found, name) for name in laws}
    return [
        f"The {name} is not well described by {laws[name]}: it is off by "
        f"{100.0 * curve.misfit:.2g} % of the peak force."
        for name, curve in curves.items()
        if curve is not None and not curve.fits
    ]


def _on_loss(found: Press, held: int) -> list[str]:
    if found.unloading is None:
        return ["There is no unloading: what is lost cannot be known."]
    notes = []
    loss: Any = found.loss
    if loss is not None and loss.nominal_value < -_CLEAR * loss.std_dev:
        notes.append(
            "More work comes back than went in: the branches are swapped, or the machine drifts."
        )
    energy: Any = found.energy_exponent
    fitted: Any = found.unloading_exponent
    if energy is not None and fitted is not None:
        apart = abs(energy.nominal_value - fitted.nominal_value)
        error = (energy - fitted).std_dev
        if apart > _CLEAR * error and apart > _WORTH * fitted.nominal_value:
            notes.append(
                f"The unloading exponent is {energy.nominal_value:.3g} by the energy and "
                f"{fitted.nominal_value:.3g} by the shape of the curve: Hysteretic with the first "
                "has the right loss, not quite the right shape."
            )
    relaxed: Any = found.relaxed
    peak = found.peak_force.nominal_value
    if relaxed is not None and abs(relaxed.nominal_value) > max(
        _CLEAR * relaxed.std_dev, _WORTH * peak
    ):
        how = "while the press stood still" if held else "at the turn"
        notes.append(
            f"The force changed by {-relaxed.nominal_value:.3g} N {how}; the loss includes it."
        )
    return notes


def _on_cycles(found: Press) -> list[str]:
    if not found.others:
        return []
    notes = [f"This is cycle {found.cycle + 1} of {found.cycles}."]
    first = found.others[0]
    own, other = found.linear_stiffness, first.linear_stiffness
    if own is not None and other is not None and other.nominal_value != 0.0:
        change = (own - other) / other
        if abs(change.nominal_value) > max(_CLEAR * change.std_dev, _WORTH):
            word = "softer" if change.nominal_value < 0.0 else "stiffer"
            size = 100.0 * abs(change.nominal_value)
            notes.append(f"It is {size:.2g} % {word} than cycle {first.cycle + 1}.")
    return notes
