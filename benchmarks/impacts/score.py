"""Score a program's answers to the impacts benchmark: `python score.py answers-of-mine.json`.

It needs Python 3.11 or later and nothing else. README.md says what an answer has, and what the
digits mean. The exit status is 0 if the file could be scored, whatever the answers, and 2 if not.
"""

import argparse
import json
import math
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from statistics import median
from typing import Any

FOLDER = Path(__file__).parent
MOST = 15.0  # digits: a double has hardly more
LEVELS = (3, 6, 12)  # digits to which an answer is called right
FIELDS = {
    "velocities": ("velocities",),
    "counts": ("counts",),
    "times": ("first_touch", "last_release"),
    "end": ("end",),
    "forces": ("peak_force",),
    "status": ("status",),
}
"""The fields of an answer that a word of a problem's `ask` stands for."""


class Malformed(ValueError):
    """A file that cannot be scored; the message is one line."""


@dataclass(frozen=True)
class Score:
    """What an answer is worth; None for what was not asked or could not be scored.

    `outcome` is answered, unsupported, failed or missing. `speeds`, `times` and `forces` are
    digits, 0 where an answered problem lacks the field.
    """

    name: str
    grade: int
    outcome: str
    speeds: float | None = None
    times: float | None = None
    forces: float | None = None
    counts: bool | None = None
    status: bool | None = None
    reason: str = ""

    def right(self, digits: float) -> bool:
        """Return whether counts and status are right, and speeds and times to so many digits."""
        exact = self.counts is not False and self.status is not False
        known = [x for x in (self.speeds, self.times) if x is not None]
        return self.outcome == "answered" and exact and all(x >= digits for x in known)


def digits_right(error: Fraction | None, conditioning: float) -> float:
    """Return how many digits an error leaves, over the conditioning; None is no number at all."""
    if error is None:
        return 0.0
    if error == 0:
        return MOST
    scaled = error / Fraction(max(1.0, conditioning))
    log = math.log10(scaled.numerator) - math.log10(scaled.denominator)
    return min(MOST, max(0.0, -log))


def score(problem: dict[str, Any], reference: dict[str, Any], answer: dict[str, Any]) -> Score:
    """Return what an answer to a problem is worth; both are entries of the files."""
    name, grade, ask = problem["name"], problem["grade"], problem["ask"]
    for outcome in ("unsupported", "failed"):
        if outcome in answer:
            return Score(name, grade, outcome, reason=str(answer[outcome]))
    _check_shapes(problem, answer)
    speed = max(Fraction(abs(v)) for v in problem["velocities"])
    factors = reference["conditioning"]

    def digits(word: str, fields: Sequence[str]) -> float:
        pairs = [pair for field in fields for pair in _pairs(answer.get(field), reference[field])]
        largest = max((abs(Fraction(true)) for _, true in pairs if true), default=Fraction(0))
        unit = speed if word == "velocities" else None
        errors = [_error(mine, true, unit, largest or Fraction(1)) for mine, true in pairs]
        worst = None if None in errors else max(errors, default=Fraction(0))
        return digits_right(worst, factors[word])

    timed = [field for word in ("times", "end") if word in ask for field in FIELDS[word]]
    return Score(
        name,
        grade,
        "answered",
        digits("velocities", FIELDS["velocities"]) if "velocities" in ask else None,
        digits("times", timed) if timed else None,
        digits("forces", FIELDS["forces"]) if "forces" in ask and "peak_force" in answer else None,
        answer.get("counts") == reference["counts"] if "counts" in ask else None,
        answer.get("status") == reference["status"] if "status" in ask else None,
    )


def _pairs(mine: Any, theirs: Any) -> Iterable[tuple[Any, Any]]:
    listed = theirs if isinstance(theirs, list) else [theirs]
    if not isinstance(theirs, list):
        mine = [mine]
    return zip([math.nan] * len(listed) if mine is None else mine, listed, strict=True)


def _error(mine: Any, true: Any, unit: Fraction | None, largest: Fraction) -> Fraction | None:
    """Return the error over the unit, or without one over the true value; None if one is missing.

    Of a true value of zero it is the error over the largest true value.
    """
    if mine is None or true is None:
        return Fraction(0) if mine is true else None
    if not math.isfinite(float(mine)):
        return None
    exact = Fraction(true)
    return abs(Fraction(mine) - exact) / (unit or abs(exact) or largest)


def _check_shapes(problem: dict[str, Any], answer: dict[str, Any]) -> None:
    """Raise `Malformed` where a field has not one number (or null) for each ball."""
    name, balls = problem["name"], len(problem["masses"])
    for field in ("velocities", "counts", "first_touch", "last_release", "peak_force"):
        values = answer.get(field)
        if values is None:
            continue
        if not isinstance(values, list) or len(values) != balls:
            raise Malformed(f"{name}: {field} has to be a list of {balls}, one for each ball")
        for value in values:
            _check_number(name, field, value)
    if "end" in answer:
        _check_number(name, "end", answer["end"])


def _check_number(name: str, field: str, value: Any) -> None:
    try:
        if value is not None:
            float(value)
    except (TypeError, ValueError):
        raise Malformed(f"{name}: {field} has {value!r}, which is no number") from None


def score_all(
    problems: Sequence[dict[str, Any]],
    references: Sequence[dict[str, Any]],
    answers: Sequence[dict[str, Any]],
) -> list[Score]:
    """Return the score of every problem; one without an answer is `missing`."""
    known = {one["name"]: one for one in references}
    mine: dict[str, dict[str, Any]] = {}
    for one in answers:
        if not isinstance(one, dict) or "name" not in one:
            raise Malformed("each answer has to be an object with the name of its problem")
        if one["name"] not in known:
            raise Malformed(f"there is no problem {one['name']!r}")
        if one["name"] in mine:
            raise Malformed(f"there are two answers to {one['name']!r}")
        mine[one["name"]] = one
    return [
        score(problem, known[problem["name"]], mine[problem["name"]])
        if problem["name"] in mine
        else Score(problem["name"], problem["grade"], "missing")
        for problem in problems
    ]


def read(path: Path, entries: str) -> dict[str, Any]:
    """Return a file of the set, whose list of that name is there."""
    try:
        content = json.loads(path.read_text("utf-8"))
    except OSError as error:
        raise Malformed(f"{path} cannot be read: {error.strerror}") from None
    except ValueError as error:
        raise Malformed(f"{path} is not JSON: {error}") from None
    if not isinstance(content, dict) or not isinstance(content.get(entries), list):
        raise Malformed(f'{path} has to be an object with a list "{entries}"')
    return content


def summary(scores: Sequence[Score]) -> dict[str, Any]:
    """Return the sums of a list of scores, and the median digits of what was answered."""
    answered = [one for one in scores if one.outcome == "answered"]

    def middle(name: str) -> float | None:
        values = [x for one in answered if (x := getattr(one, name)) is not None]
        return median(values) if values else None

    return {
        "problems": len(scores),
        "answered": len(answered),
        "counts": sum(one.counts is not False for one in answered),
        **{f"right_{level}": sum(one.right(level) for one in scores) for level in LEVELS},
        **{name: middle(name) for name in ("speeds", "times", "forces")},
    }


def _shown(value: Any) -> str:
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "right" if value else "wrong"
    return f"{value:.1f}" if isinstance(value, float) else str(value)


def _table(heads: Sequence[str], rows: Sequence[Sequence[Any]]) -> str:
    texts = [list(heads), *([_shown(x) for x in row] for row in rows)]
    widths = [max(len(row[i]) for row in texts) for i in range(len(heads))]
    return "\n".join("  ".join(map(str.ljust, row, widths)).rstrip() for row in texts)


def report(scores: Sequence[Score]) -> str:
    """Return the tables as text: a row for each problem, then a row for each grade."""
    problems = _table(
        ["problem", "grade", "outcome", "speeds", "times", "forces", "counts", "status"],
        [
            [x.name, x.grade, x.outcome, x.speeds, x.times, x.forces, x.counts, x.status]
            for x in scores
        ],
    )
    grades = sorted({x.grade for x in scores})
    groups = {str(grade): [x for x in scores if x.grade == grade] for grade in grades}
    sums = {grade: summary(group) for grade, group in {**groups, "all": scores}.items()}
    heads = ["grade", "problems", "answered", "counts right"]
    heads += [f"right to {level} digits" for level in LEVELS]
    heads += [f"median digits: {name}" for name in ("speeds", "times", "forces")]
    sums_table = _table(heads, [[grade, *one.values()] for grade, one in sums.items()])
    return f"{problems}\n\n{sums_table}\n"


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the tables of a file of answers; return the exit status."""
    parser = argparse.ArgumentParser(prog="score.py", description=(__doc__ or "").splitlines()[0])
    parser.add_argument("answers", type=Path, help="your answers, as README.md describes them")
    told = parser.parse_args(arguments)
    try:
        problems = read(FOLDER / "problems.json", "problems")["problems"]
        references = read(FOLDER / "answers.json", "answers")["answers"]
        answers = read(told.answers, "answers")["answers"]
        sys.stdout.write(report(score_all(problems, references, answers)))
    except Malformed as error:
        sys.stderr.write(f"score.py: {error}\n")
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
