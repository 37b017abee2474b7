"""The pictures of `validation.md`: the points of a series, and the best curve of each law."""

import matplotlib.pyplot as plt
from shared import WIDE

from stackbounce import datasets, plots
from stackbounce.fitting.series import SeriesFit
from stackbounce.fitting.series.comparison import compare_laws
from stackbounce.fitting.series.series import make_series


def _draw(axes, name, *, air=True):
    compared = compare_laws(make_series(datasets.load(name), air=air))
    plots.restitutions(SeriesFit((compared,), {}), axes=axes)


def golf():
    """The flights of a golf ball."""
    _, axes = plt.subplots(figsize=(WIDE, 4.0), layout="constrained")
    _draw(axes, "golf-marble-flights")


def air():
    """The flights of a table tennis ball, with the drag of the air and without."""
    _, both = plt.subplots(1, 2, figsize=(WIDE, 3.8), layout="constrained")
    for axes, corrected in zip(both, (True, False), strict=True):
        _draw(axes, "table-tennis-parquet-flights", air=corrected)
        axes.set_title("drag corrected" if corrected else "air left out")
