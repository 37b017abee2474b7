"""A paragraph for the methods section of a paper that used a fit, and what it cites, as BibTeX."""

from typing import Any

from stackbounce.errors import counted
from stackbounce.files import shipped
from stackbounce.fitting.comparison import Comparison
from stackbounce.fitting.result import Fit
from stackbounce.fitting.series import SeriesFit
from stackbounce.model.laws import LAWS
from stackbounce.version import __version__


def cite(found: Fit | Comparison | SeriesFit) -> str:
    """Return what was fitted, by which program and from which laws, and the entries for BibTeX.

    Parameters
    ----------
    found : Fit, Comparison or SeriesFit
        What was fitted.

    Examples
    --------
    >>> from stackbounce.fitting.series import fit_series
    >>> print(cite(fit_series("dataset:golf-marble-heights", laws=["Rigid"]))[:64])
    Contact laws were fitted to 4 restitutions of 1 ball by weighted
    """
    if isinstance(found, SeriesFit):
        series = [compared.series for compared in found.comparisons]
        numbers = sum(own.values.size for own in series)
        data = f"{numbers} restitutions of {counted(len(series), 'ball')}"
        rows = [row for own in found.comparisons for row in own.outcomes]
        laws: set[Any] = {LAWS[name] for row in rows for name in row.laws}
        result = "The goodness of each is told by chi squared and its probability p."
    else:
        fits = found.fits if isinstance(found, Comparison) else {"": found}
        one = next(iter(fits.values()))
        drops = one.objective.measured
        data = f"{counted(one.objective.size, 'number')} of {counted(len(drops), 'drop')}"
        stacks = [drop for own in fits.values() for drop in own.drops.values()]
        laws = {type(law) for drop in stacks for law in drop.contacts if law is not None}
        if isinstance(found, Comparison):
            result = f"The models are compared by {found.criterion.upper()}."
        else:
            varied = ", ".join(
                f"{name} = {found[name]:.1uS} {unit}".rstrip() for name, unit in found.units.items()
            )
            result = f"Best values: {varied}. {found.remarks[0]}"
    listed = "; ".join(
        f"{law.__name__}, {law.formula} ({law.source})"
        for law in sorted(laws, key=lambda law: law.__name__)
    )
    entries = shipped(__package__, "cite.bib").strip().replace("VERSION", __version__)
    return (
        f"Contact laws were fitted to {data} by weighted least squares with stackbounce "
        f"{__version__}. {result} Laws: {listed}.\n\n{entries}"
    )
