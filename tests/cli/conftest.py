"""The command line as a function, in a folder of its own."""

import pytest

from stackbounce.cli import main


@pytest.fixture(autouse=True)
def _in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def run(capfd):
    """Runs a command; returns its status, and what it printed on both streams."""

    def run_main(*arguments):
        code = main(list(arguments))
        out, err = capfd.readouterr()
        return code, out, err

    return run_main


@pytest.fixture
def refused(run):
    """Runs a command that has to be refused in one line, which it returns."""

    def run_refused(*arguments):
        code, out, err = run(*arguments)
        assert (code, out, err.count("\n")) == (2, "", 1)
        assert err.startswith("stackbounce: error: ")
        return err.removeprefix("stackbounce: error: ")

    return run_refused
