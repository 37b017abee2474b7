"""The paper's pages: figures, tables and audit, as `stackbounce paper` writes them."""

from pathlib import Path

from stackbounce import cross2007

__all__ = ["write_paper"]


def write_paper(folder: str) -> None:
    """Write the paper's pages into a folder beside the page; the audit itself is not sent back."""
    cross2007.write(Path(folder), explorer="../")
