"""The page on gaps, stacks and masses: its commands print what stands there, and draw."""

from pathlib import Path

import pytest

from pages.consoles import read_page, run_all, steps, write_files

TEXT = read_page("gaps-and-masses")
RUNS = steps(TEXT)


@pytest.mark.fast_cases(1)
@pytest.mark.parametrize("step", RUNS, ids=lambda step: step[0][1])
def test_a_command_prints_what_stands_there(step, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    write_files(TEXT, tmp_path)
    run_all([step], capsys, whole=True)
    command, _ = step
    if "--plot" in command:
        assert Path(command[command.index("--plot") + 1]).stat().st_size > 10_000
    if "--save" in command:
        run_all([(["simulate", command[command.index("--save") + 1]], [])], capsys)


def test_all_commands_of_the_page_are_run():
    assert len(RUNS) == TEXT.count("$ stackbounce") == 5
    assert TEXT.count("--plot") == 2
