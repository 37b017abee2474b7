"""Results that show themselves: a table with remarks below it, as text and in a notebook."""

from collections.abc import Sequence
from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pandas as pd


class Shown:
    """A result with a `table` and `remarks`, which its text and its HTML consist of.

    Examples
    --------
    >>> import pandas as pd
    >>> class Heights(Shown):
    ...     table = pd.DataFrame({"value": ["63 ± 1"], "unit": ["cm"]}, index=["height"])
    >>> Heights()
            value  unit
    height  63 ± 1  cm
    """

    table: "pd.DataFrame"
    """What was found, a row each."""

    @property
    def remarks(self) -> Sequence[str]:
        """What a reader should know of it, a sentence each: its notes."""
        return tuple(getattr(self, "notes", ()))

    def __repr__(self) -> str:
        """The table and the remarks, as text."""
        return "\n".join([self.table.to_string(float_format="{:.4g}".format), *self.remarks])

    def _repr_html_(self) -> str:
        """The table and the remarks, for a notebook."""
        listed = "".join(f"<p>{escape(remark)}</p>" for remark in self.remarks)
        return f"{self.table.to_html(float_format='{:.4g}'.format)}{listed}"
