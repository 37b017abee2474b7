"""The command line as a function, in a folder of its own."""

import json

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
def printed(run):
    """Runs a command that has to succeed without complaints; returns what it printed."""

    def run_well(*arguments):
        code, out, err = run(*arguments)
        assert (code, err) == (0, "")
        return out

    return run_well


@pytest.fixture
def told(printed):
    """Runs such a command; returns what it tells machines."""
    return lambda *arguments: json.loads(printed(*arguments, "--json"))


@pytest.fixture
def refused(run):
    """Runs a command that has to be refused in one line, which it returns."""

    def run_refused(*arguments):
        code, out, err = run(*arguments)
        assert (code, out, err.count("\n")) == (2, "", 1)
        assert err.startswith("stackbounce: error: ")
        return err.removeprefix("stackbounce: error: ")

    return run_refused
