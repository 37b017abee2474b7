"""The measurements of Cross (2007) as datasets: what `stackbounce.cross2007.PAPER` holds."""

from stackbounce.cross2007.bench import PAPER
from stackbounce.datasets.description import TEXT, Column, Description

_PLACES = {  # those that have measurements; the other sections have what is computed or chosen
    "Sec. III": ("cross2007-section-3", "A tennis ball on a basketball, and each of them alone"),
    "Fig. 7, text": ("cross2007-figure-7", "Balls that are pressed slowly"),
    "Table I": ("cross2007-table-1", "Three superballs, each of them alone"),
    "Sec. IV": ("cross2007-section-4", "Pairs of superballs, and of steel balls"),
    "Table II": ("cross2007-table-2", "Pairs of balls: their rebound ratios"),
}
_SOURCE = "R. Cross, Vertical bounce of two vertically aligned balls, Am. J. Phys. 75, 1009 (2007)"
_ERRORS = (
    "An error is the one that the paper states, or half a unit in the last printed digit if that is"
    " larger or none is stated; 0 marks a number that the paper chooses or fits."
)


def paper_datasets() -> dict[str, Description]:
    """Return the datasets of the paper by their names: a row for each number, in SI units.

    Examples
    --------
    >>> list(paper_datasets())[2]
    'cross2007-table-1'
    """
    return {name: _description(name, title, place) for place, (name, title) in _PLACES.items()}


def _description(name: str, title: str, place: str) -> Description:
    inputs = [number for number in PAPER.values() if number.where == place]
    values = tuple(number.value for number in inputs)
    errors = tuple(number.spread for number in inputs)
    return Description(
        name=name,
        title=title,
        measured="Each row is one number that the paper gives",
        ball="those of the paper",
        source=f"{_SOURCE}, {place}",
        doi="10.1119/1.2772286",
        address="https://doi.org/10.1119/1.2772286",
        seen="full text",
        remarks=_ERRORS,
        columns=(
            _words(
                "quantity", "the number's name in this package", [number.key for number in inputs]
            ),
            _words("what", "what it is", [number.what for number in inputs]),
            _words("printed", "as printed", [number.printed for number in inputs]),
            _words("unit", "the SI unit of the value", [number.unit or "1" for number in inputs]),
            Column("value", "1", "in the unit of its row", values, errors),
        ),
    )


def _words(name: str, meaning: str, values: list[str]) -> Column:
    return Column(name, TEXT, meaning, tuple(values))
