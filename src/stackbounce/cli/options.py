"""The arguments and options of the commands, as ``options.toml`` lists them."""

import inspect
import tomllib
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Annotated, Any

import typer

from stackbounce.files import shipped
from stackbounce.measure.options import OPTIONS, Option
from stackbounce.model.laws import LAWS, usual_laws

DROP = ("height", "speed", "gap", "contact", "gravity")
"""The options that change a drop, as `stackbounce.cli.scenario.read` takes them."""

_FORMS: dict[str, Any] = {
    "text": str, "texts": list[str], "number": float, "count": int, "flag": bool, "file": Path,
    "files": list[Path],
}  # fmt: skip


def add_command(app: typer.Typer, name: str, run: Callable[..., None]) -> None:
    """Add a command, with the arguments and options that it takes by the table."""
    command, known = _TABLE["commands"][name], _TABLE["shared"] | _TABLE.get(name, {})
    parameters = [_parameter(key, **known[key]) for key in command["takes"]]
    run.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    app.command(name, epilog=command.get("epilog"))(run)


def _parameter(
    name: str,
    form: str = "text",
    names: Sequence[str] = (),
    argument: bool = False,
    required: bool = False,
    default: Any = None,
    completed: str = "",
    **more: Any,
) -> inspect.Parameter:
    """Return the parameter of a command's function for a row of the table."""
    make: Any = typer.Argument if argument else typer.Option
    more["autocompletion"] = _COMPLETED.get(completed)
    more |= {"readable": not form.startswith("file"), "show_default": default not in (None, "")}
    kind, value = _FORMS[form], bool(default) if form == "flag" else default
    if required:
        value = inspect.Parameter.empty
    elif value is None:
        kind |= None
    about, keyword = Annotated[kind, make(*names, **more)], inspect.Parameter.KEYWORD_ONLY
    return inspect.Parameter(name, keyword, default=value, annotation=about)


def _measured(option: Option) -> dict[str, Any]:
    """Return the row of an option of measurements, whose numbers are texts with a unit."""
    forms = {"flag": "flag", "columns": "texts"}
    return {
        "form": forms.get(option.form, "text"),
        "names": [option.on_command_line],
        "default": option.default,
        "metavar": None if option.form == "flag" else option.value_name,
        "help": option.says,
        "rich_help_panel": option.panel or None,
    }


def _read() -> dict[str, Any]:
    """Return the table, with the options of measurements after the files of ``measure``."""
    text = shipped(__package__, "options.toml")
    for field, laws in (("{laws}", LAWS), ("{usual_laws}", usual_laws())):
        text = text.replace(field, ", ".join(laws))
    table = tomllib.loads(text)
    table["commands"]["measure"]["takes"][1:1] = [option.name for option in OPTIONS]
    table["measure"] |= {option.name: _measured(option) for option in OPTIONS}
    return table


def _balls() -> list[str]:
    """Return the balls of the catalogue as they are typed."""
    from stackbounce.model.catalogue import ENTRIES

    return [name.replace(" ", "-") for name in ENTRIES]


def _datasets() -> Sequence[str]:
    """Return the published measurements."""
    from stackbounce.datasets import names

    return names()


_COMPLETED = {"balls": _balls, "laws": lambda: list(LAWS), "datasets": _datasets}
"""What the shell completes from; typer chooses what begins as typed."""
_TABLE = _read()
