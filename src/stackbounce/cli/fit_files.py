"""The files of ``stackbounce fit``: the problem that it reads, drops and draws that it writes."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from stackbounce.cli import scenario
from stackbounce.cli.output import check_file
from stackbounce.cross2007.datasets import PREFIX, load_dataset
from stackbounce.errors import FileError, InvalidValue
from stackbounce.files import check_own, check_place, write_file
from stackbounce.fitting import Fit, FitProblem, Posterior
from stackbounce.fitting.files import Parts, read_parts
from stackbounce.fitting.series import StackTable
from stackbounce.sweeps.draws import draws_text


def read_parts_of(
    what: Sequence[str], changes: Mapping[str, Any], stack: StackTable | None = None
) -> Parts:
    """Return the parts of a fit problem: from a table, a data set, a file, or a drop alone."""
    if stack is not None:
        parts = Parts(stack.drops, dict(stack.data), {}, {})
    elif len(what) == 1 and what[0].startswith(PREFIX) and not Path(what[0]).exists():
        drop, data, vary, _ = load_dataset(what[0])
        parts = Parts({"": drop}, {"": data}, vary, {})
    elif len(what) == 1 and scenario.is_file(what[0]):
        parts = read_parts(what[0])
    else:
        return Parts({"": scenario.read(what, **changes).drop}, {}, {}, {})
    drops = {key: scenario.change(drop, **changes) for key, drop in parts.drops.items()}
    return parts._replace(drops=drops)


def check_save(
    path: Path | None,
    overwrite: bool,
    problem: FitProblem,
    read: Sequence[str],
    option: str = "--save",
    suffix: str = ".toml",
) -> None:
    """Refuse a path for --save or --draws that cannot be written, before anything is computed."""
    if path is None or len(problem.drops) == 1:
        check_file(path, overwrite, option, (suffix,), read)
    elif path.suffix or (path.exists() and not path.is_dir()):
        raise InvalidValue(
            f"{option} must name a folder for {len(problem.drops)} drops, a file each, got {path}"
        )
    else:
        check_place(path)
        for name in problem.drops:
            check_own(path / f"{name}{suffix}", overwrite, read)


def save(
    fit: Fit, path: Path | None, overwrite: bool, draws_of: Posterior | None = None
) -> list[Path]:
    """Write each fitted drop, or its draws, and return the files; several are in a folder."""
    if path is None:
        return []
    suffix = ".csv" if draws_of else ".toml"
    texts = {
        key: draws_text(drop, fit.draws(draws_of, key)) if draws_of else drop.to_toml()
        for key, drop in fit.drops.items()
    }
    files = dict.fromkeys([path], next(iter(texts.values())))
    if len(texts) > 1:
        try:
            path.mkdir(exist_ok=True)
        except OSError as error:
            raise FileError(f"{path} cannot be written: {error.strerror or error}") from error
        files = {path / f"{name}{suffix}": text for name, text in texts.items()}
    for file, text in files.items():
        write_file(file, text.encode(), overwrite)
    return list(files)
