"""The study of Table II starts; its own tests are in `studies/table2/tests`."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]


def test_the_study_starts():
    """It computes the first bound, and says how it is run."""
    code = (
        "from studies.table2.energy import bound_energy; "
        "import studies.table2.__main__ as run, sys; "
        "print(round(bound_energy('B3_on_B1').measured, 3)); "
        "sys.argv = ['table2', '--help']; run.main()"
    )
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("0.81\n")
    assert "--out" in done.stdout
