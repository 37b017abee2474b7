"""The explorer in a cell of a notebook: its one HTML file in a frame, and nothing is served."""

import html
from dataclasses import dataclass

from stackbounce.cross2007.cases import explorer_address
from stackbounce.errors import InvalidValue, counted, instance, whole
from stackbounce.explorer.limits import LIMITS
from stackbounce.explorer.made import one_file
from stackbounce.model import Drop


@dataclass(frozen=True)
class ExplorerFrame:
    """The explorer as a notebook shows it.

    Parameters
    ----------
    drop : Drop, optional
        What it begins with.
    height : int
        The height of the frame in px.
    """

    drop: Drop | None
    height: int

    def __repr__(self) -> str:
        balls = "" if self.drop is None else f" with {counted(len(self.drop.balls), 'ball')}"
        return f"<the explorer{balls}: a notebook shows it as the last line of a cell>"

    def _repr_html_(self) -> str:
        state = "" if self.drop is None else explorer_address(self.drop, {})
        return (
            f'<iframe title="stackbounce: the explorer" name="{html.escape(state)}" '
            f'style="width: 100%; height: {self.height}px; border: 0" '
            f'allow="clipboard-write *; fullscreen *" srcdoc="{html.escape(one_file())}">'
            "The explorer is shown in a notebook that is trusted: run this cell again.</iframe>"
        )


def explore(drop: Drop | None = None, *, height: int = 640) -> ExplorerFrame:
    """Return the explorer for the last line of a notebook's cell; it begins with a drop.

    It computes in the browser, also in a notebook that was saved as HTML, and asks for nothing.
    What is changed there does not come back to Python; *Share* has it as lines of Python. A saved
    notebook grows by 1.4 MB with each cell that shows the explorer.

    Parameters
    ----------
    drop : Drop, optional
        The drop to begin with; the explorer's own first one by default.
    height : int, optional
        The height of the frame in px.

    Returns
    -------
    ExplorerFrame

    Raises
    ------
    InvalidType
        If `drop` is no drop, or `height` no whole number.
    InvalidValue
        If the explorer cannot show the drop: it has at most 6 balls, and of the contact laws those
        that `stackbounce` offers in menus, without `Tabulated`, `Bond` and those of your own.
    FileError
        If the package was built without the engine for browsers.

    Examples
    --------
    >>> from stackbounce import Ball, Drop, Spring
    >>> explore(Drop([Ball(0.057)], [Spring(22500)], height=1.0))
    <the explorer with 1 ball: a notebook shows it as the last line of a cell>
    """
    if drop is not None:
        drop = instance("drop", drop, Drop)
        if len(drop.balls) > LIMITS.balls:
            raise InvalidValue(
                f"balls must be at most {LIMITS.balls} in the explorer, got {len(drop.balls)}"
            )
        for i, law in enumerate(drop.contacts):
            name, home = type(law).__name__, type(law).__module__
            if law is not None and not (law.listed and home.startswith("stackbounce.")):
                raise InvalidValue(f"contacts.{i} must be a law that the explorer has, got {name}")
    return ExplorerFrame(drop, whole("height", height, 1))
