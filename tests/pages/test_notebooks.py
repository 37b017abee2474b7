"""The notebooks of the documentation run, show their pictures once, and say nothing else."""

from pathlib import Path

import pytest
from myst_nb.core.read import read_myst_markdown_notebook
from nbclient import execute

pytestmark = pytest.mark.slow
FOLDER = Path(__file__).parents[2] / "docs" / "notebooks"


@pytest.mark.parametrize("name", [path.stem for path in sorted(FOLDER.glob("*.md"))])
def test_each_cell_shows_what_it_ends_with(name):
    notebook = read_myst_markdown_notebook((FOLDER / f"{name}.md").read_text("utf-8"))
    execute(notebook, cwd=str(FOLDER), timeout=60)
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert {output.output_type for cell in cells for output in cell.outputs} == {"execute_result"}
    pictures = [cell.outputs for cell in cells if "\nsb.plots." in f"\n{cell.source}"]
    assert len(pictures) > 0
    assert all("image/png" in output.data for (output,) in pictures)
