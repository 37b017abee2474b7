"""Intervals of laws fitted to tables of bounces hold the truth as often as they claim."""

import numpy as np
import pytest

from coverage_cases import chosen
from stackbounce.fitting.series import fit_series
from stackbounce.fitting.series.family import Family
from stackbounce.model import LAWS
from stackbounce.model.drop import STANDARD_GRAVITY


def made(generator, law, path):
    """Write a table of rounded heights, some of them repeated; return the true restitution."""
    value, count = generator.uniform(0.5, 0.9), int(generator.integers(2, 6))
    heights = np.sort(generator.choice(np.arange(20, 210, 10), count, replace=False))
    falls = np.sqrt(2.0 * STANDARD_GRAVITY * heights / 100.0)
    ratios = Family(LAWS[law], float(falls.max())).at(value, falls)
    scatter, step = generator.uniform(0.2, 1.5), generator.choice([0.1, 0.5, 1.0])
    rows = generator.integers(count, size=int(generator.integers(max(5, count + 1), 13)) - count)
    lines = ["Fallhöhe (cm);Sprunghöhe (cm)"]
    for k in generator.permutation([*range(count), *rows]):
        rise = ratios[k] ** 2 * heights[k] + scatter * generator.standard_normal()
        lines.append(f"{heights[k]};{step * round(rise / step):.1f}".replace(".", ","))
    path.write_text("\n".join(lines), "utf-8")
    return value


@pytest.mark.slow
@pytest.mark.parametrize("law", chosen(("Rigid", "Viscoelastic"), "Rigid"))
def test_intervals_of_300_made_tables_hold_the_truth_and_p_refutes_as_often_as_it_says(
    law, tmp_path
):
    """5 to 12 rows, some heights repeated, read to 1 mm, 5 mm or 1 cm."""
    generator, path = np.random.default_rng(1), tmp_path / "made.csv"
    inside, chances = [], []
    for _ in range(300):
        truth = made(generator, law, path)
        (found,) = fit_series(path, laws=[law]).comparisons
        limits = [found.outcomes[0].interval(level) for level in (0.6827, 0.9545)]
        inside.append([low <= truth <= high for low, high in limits])
        chances.append(found.outcomes[0].p)
    one, two = np.mean(inside, axis=0)
    assert 0.63 <= one <= 0.73
    assert 0.93 <= two <= 0.97
    assert 0.02 <= np.mean(np.array(chances) < 0.05) <= 0.08
