import inspect
import json
import math
import os
import re
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from typer.testing import CliRunner

import stackbounce as sb
from stackbounce import cross2007, plots
from stackbounce.cli import app, main
from stackbounce.cli.drop_options import read_contact
from stackbounce.cli.options import DROP
from stackbounce.cli.scenario import read
from stackbounce.model import LAWS
from stackbounce.plots import style
from stackbounce.run.collision import separate
from stackbounce.version import __version__

PAIR = ["simulate", "basketball", "tennis", "--height", "0.63m", "--gap", "2mm"]

MAIN = "import sys; from stackbounce.cli import main; sys.exit(main())"


def process(*arguments, code=MAIN, **options):
    command = [sys.executable, "-c", code, *arguments]
    given = {"capture_output": True, "text": True, "timeout": 120} | options
    return subprocess.run(command, check=False, **given)


def rows(text, first):
    """The cells of each table row that begins so: cells are two spaces apart, or more."""
    cells = [re.split(r"  +", line.strip()) for line in text.splitlines()]
    return [row for row in cells if row[0] == first and len(row) > 1]


def test_version_and_help(printed, run):
    assert run("--version") == (0, f"stackbounce {__version__}\n", "")
    out = printed("--help")
    assert all(command in out for command in ("simulate", "balls", "paper"))
    assert run() == (0, out, "")
    assert run("-h") == (0, out, "")
    assert CliRunner().invoke(app, ["--help"]).exit_code == 0
    for command in ("balls", "paper"):
        assert run(command, "--help")[0] == 0
    of_simulate = printed("simulate", "--help")
    assert all(name in of_simulate for name in LAWS)


def test_functions_of_commands_take_the_options_of_the_table():
    for command in app.registered_commands:
        code, takes = command.callback.__code__, set(inspect.signature(command.callback).parameters)
        named = set(code.co_varnames[: code.co_argcount + code.co_kwonlyargcount])
        others = code.co_flags & inspect.CO_VARKEYWORDS
        assert named <= takes if others else named == takes, command.name
        if command.name == "simulate":  # whose other options are read as numbers of the drop
            assert takes <= named | set(DROP)


@pytest.mark.parametrize("arguments", [["--help"], ["fit", "--help"]])
def test_help_does_not_wait_for_heavy_libraries(arguments):
    code = (
        f"import sys; from stackbounce.cli import main; main({arguments}); "
        "heavy = {'numpy', 'pint', 'xarray', 'matplotlib', 'numba', 'uncertainties', 'jinja2', "
        "'emcee', 'scipy'}; "
        "sys.exit(', '.join(sorted(heavy & set(sys.modules))))"
    )
    assert process(code=code).stderr.strip() == ""


@pytest.mark.parametrize(
    ("arguments", "expected", "command"),
    [
        (["simulat"], "No such command 'simulat'", "stackbounce"),
        (["balls", "--jsn"], "No such option", "stackbounce balls"),
        (["simulate"], "Missing argument", "stackbounce simulate"),
        (["simulate", "B1", "--height"], "'--height' requires an argument", "stackbounce simulate"),
        (["balls", "B1"], "unexpected extra argument", "stackbounce balls"),
    ],
)
def test_wrong_usage_is_one_line(refused, arguments, expected, command):
    err = refused(*arguments)
    assert expected in err
    assert err.endswith(f" (see {command} --help)\n")


@pytest.mark.parametrize(
    ("words", "found"),
    [
        ("hi", {"highest"}),
        ("simulate te", {"tennis", "tennis-ball"}),
        ("simulate B1 --contact Hy", {"Hysteretic"}),
        ("highest --law Hun", {"HuntCrossley"}),
        ("datasets golf-marble-h", {"golf-marble-heights"}),
        ("fit --compa", {"--compare"}),
    ],
)
def test_the_shell_completes(words, found, monkeypatch, capsys):
    words = ["stackbounce", *words.split()]
    monkeypatch.setenv("_STACKBOUNCE_COMPLETE", "complete_bash")
    monkeypatch.setenv("COMP_WORDS", " ".join(words))
    monkeypatch.setenv("COMP_CWORD", str(len(words) - 1))
    with pytest.raises(SystemExit) as ended:
        main([])
    assert ended.value.code == 0
    assert set(capsys.readouterr().out.split()) == found


def test_the_shells_script_asks_this_program(monkeypatch, capsys):
    monkeypatch.setenv("_STACKBOUNCE_COMPLETE", "source_bash")  # as --show-completion in bash
    with pytest.raises(SystemExit) as ended:
        main([])
    assert ended.value.code == 0
    assert "_STACKBOUNCE_COMPLETE=complete_bash" in capsys.readouterr().out


def test_a_table_for_people(printed):
    out = printed(*PAIR)
    assert "basketball + tennis from 0.63 m, at 3.515 m/s" in out
    assert "contact 1, basketball – tennis: Spring, stiffness 1000 N/m  [Cross 2007, Fig" in out
    assert "gap 0, basketball – tennis: 2 mm  [--gap]" in out
    assert "Kinetic energy retained: 100.0 %" in out
    result = sb.simulate(read(PAIR[1:3], height="0.63m", gap=["2mm"]).drop)
    textbook = sb.simulate(separate(result.drop))
    for i, name in enumerate(("basketball", "tennis")):
        ratio, other = result.rebound_ratios[i], textbook.rebound_ratios[i]
        after, apart = result.rebound_speeds[i], textbook.rebound_speeds[i]
        mass, before = result.drop.balls[i].mass * 1e3, -result.drop.reference_speed
        numbers = [mass, before, after, ratio, ratio**2, 0.63 * ratio**2, apart, other**2]
        assert [float(cell) for cell in rows(out, name)[0][1:]] == pytest.approx(numbers, rel=1e-3)
    interval = result.intervals[1]
    start, end = interval["start"] * 1e3, interval["end"] * 1e3
    peaks = [interval["peak_force"], interval["peak_compression"] * 1e3, interval["impulse"]]
    numbers = [1.0, start, end, end - start, *peaks]
    cells = [float(cell) for cell in rows(out, "basketball – tennis")[0][1:]]
    assert cells == pytest.approx(numbers, rel=1e-3)


def test_springs_of_any_exponent_lose_nothing(run):
    _, out, _ = run("simulate", "B1", "--contact", "Hertz stiffness=1e6")
    assert "Springs lose nothing." in out
    _, out, _ = run("simulate", "B1", "--contact", "Dashpot stiffness=1e4 damping=1")
    assert "Springs lose nothing." not in out


@pytest.mark.fast_cases(1)
@pytest.mark.parametrize(
    "arguments", [PAIR, ["balls"], ["simulate", "B1", "B2", "B3", "tennis"], ["simulate", "B1"]]
)
def test_piped_output_is_plain_and_no_wider_than_a_page(arguments):
    done = process(*arguments, env=os.environ | {"PYTHONIOENCODING": "utf-8"}, encoding="utf-8")
    assert (done.returncode, done.stderr) == (0, "")
    assert "\x1b" not in done.stdout
    assert "…" not in done.stdout
    assert max(len(line) for line in done.stdout.splitlines()) <= 100


def test_a_terminal_without_unicode_is_no_reason_to_fail():
    done = process(*PAIR, env=os.environ | {"PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0"})
    assert (done.returncode, done.stderr) == (0, "")


def test_a_reader_that_goes_away_is_no_error():
    reader, writer = os.pipe()
    os.close(reader)
    done = process("balls", capture_output=False, stdout=writer, stderr=subprocess.PIPE)
    os.close(writer)
    assert done.stderr == ""


def test_json_for_machines(told):
    got = told(*PAIR, "--plot", "drop.svg")
    result = sb.simulate(sb.Drop.from_mapping(got["drop"]))
    assert got["stackbounce"] == __version__
    assert got["status"] == "FINISHED"
    assert got["rebound_speeds"] == result.rebound_speeds.tolist()
    assert got["rebound_ratios"] == result.rebound_ratios.tolist()
    assert got["collisions"] == [1, 1]
    assert got["intervals"][1]["peak_force"] == result.intervals["peak_force"][1]
    assert got["contact_sources"] == ["Cross 2007, Figure 9"] * 2
    assert got["gap_sources"] == ["--gap"]
    textbook = sb.simulate(separate(result.drop))
    assert got["separate"]["rebound_speeds"] == textbook.rebound_speeds.tolist()


def test_json_has_null_where_numbers_are_not_finite(printed):
    out = printed("simulate", "B1", "--contact", "Rigid restitution=0.8", "--json")
    got = json.loads(out, parse_constant=pytest.fail)
    assert got["intervals"][0]["peak_force"] is None
    assert got["separate"] is None


def test_a_rigid_drop_needs_no_textbook_beside_it(run):
    _, out, _ = run("simulate", "B1", "--contact", "Rigid restitution=0.5", "--speed", "2")
    assert "Rigid, restitution 0.5" in out
    assert "eparate" not in out
    assert rows(out, "B1")[0][3:6] == ["1.000", "0.5000", "0.2500"]


def test_a_scenario_file_and_changes_to_it(printed, told):
    laws = [sb.Spring(1e4), sb.Hysteretic(5e3, restitution=0.8)]
    drop = sb.Drop([sb.Ball(0.1, name="lower"), sb.Ball(0.05)], laws, height=0.5)
    Path("drop.toml").write_text(drop.to_toml())
    out = printed("simulate", "drop.toml")
    assert "lower + ball 1 from 0.5 m, at 3.132 m/s" in out
    assert "Hysteretic, stiffness 5000 N/m, restitution 0.8  [drop.toml]" in out
    numbers = ("--speed", "2 m/s", "--gap", "1mm", "--gravity", "9.81m/s^2")
    laws = ("--contact", "Spring stiffness='20 kN/m'", "--contact", "spring stiffness=1000")
    found = told("simulate", "./drop.toml", *numbers, *laws)
    assert sb.Drop.from_mapping(found["drop"]) == sb.Drop(
        drop.balls, [sb.Spring(2e4), sb.Spring(1e3)], gaps=[0.001], impact_speed=2.0, gravity=9.81
    )


@pytest.mark.parametrize("laws", [[], ["--contact", "Rigid restitution=0.9"] * 2])
def test_a_ball_off_the_middle_and_how_straight_it_must_lie(laws, printed, told):
    asked = [*PAIR, *laws, "--offset", "1mm", "--straight", "5 deg"]
    found = told(*asked)
    result = sb.simulate(sb.Drop.from_mapping(found["drop"]))
    (leaving,), (straight,) = found["sideways"], found["straight"]
    top = result.sideways({1: 1e-3}).isel(ball=1)
    top = {name: float(value) for name, value in top.items()}
    assert leaving == {"moved": 1, **top}
    for ball, most in enumerate(straight["most"]):
        angle = result.sideways({1: most}).angle.values[ball]
        assert abs(angle) == pytest.approx(math.radians(5.0), rel=1e-9)
    off, within = rows(printed(*asked), "tennis")[1:]
    numbers = [math.degrees(top["angle"]), top["sideways_speed"], top["landing"]]
    assert [float(cell) for cell in off[1:]] == pytest.approx(numbers, rel=1e-3)
    within = [1e-3 * float(cell) for cell in within[1:]]
    assert within == pytest.approx(straight["most"], rel=1e-3)


def test_a_tower_says_which_ball_matters_most_and_where_first_order_ends(printed, told):
    asked = ["simulate", "B1", "B2", "B3", "tennis", "--offset", "1mm", "--straight", "5deg"]
    worst = min(told(*asked)["straight"], key=lambda row: row["most"][-1])["moved"]
    out = printed(*asked)
    assert f"For the tennis, the place of {asked[1 + worst]} matters most." in out
    assert "An angle is above 15 degrees, where first order ends." in out


def test_names_cannot_write_on_the_terminal(run):
    drop = sb.Drop([sb.Ball(1.0, name="a\x1b[31mb\nc[red] ..")], [sb.Spring(1.0)], impact_speed=1.0)
    Path("drop.toml").write_text(drop.to_toml())
    _, out, _ = run("simulate", "drop.toml")
    assert "\x1b" not in out
    assert "a?[31mb?c[red] … at 1 m/s" in out


def test_highest_points_are_shown(printed, run):
    contact = "Rigid restitution=0.5"
    given = ("--height", "1m", "--gravity", "9.81m/s^2", "--until", "60s", "--contact", contact)
    out = printed("simulate", "B1", *given)
    assert "Highest points" in out
    assert re.search(r"B1 +\d+ +0\.2258 +0\.2500 +0\.5644 +0\.06250", out)
    assert "Status: SETTLED" in out
    assert "Highest points" not in run("simulate", "B1")[1]


def test_a_run_that_did_not_finish_says_what_to_do(printed, run):
    out = printed("simulate", "B1", "B2", "--until", "3ms")
    assert "not yet" in out
    assert re.search(r"Status: TIME_REACHED: .*until", out)
    rigid = ["--contact", "Rigid restitution=0.1"] * 2
    _, out, _ = run("simulate", "B3", "B1", *rigid)
    assert "Status: COLLAPSED: " in out
    assert rows(out, "floor – B3")[0][1] == "∞"


def test_chaos_is_told_with_its_time(printed):
    balls, law = [sb.Ball(0.1), sb.Ball(0.05), sb.Ball(0.02)], sb.HuntCrossley(1e6, 1.5, 0.2)
    drop = sb.Drop(balls, [law] * 3, gaps=[0.0, 1e-3], height=0.3, gravity=9.81)
    Path("chaos.toml").write_text(drop.to_toml())
    known = sb.simulate(drop, until=2.97).known_until
    told = f"Chaotic: no digit of the speeds is known after {known:.3f} s"
    assert told in printed("simulate", "chaos.toml", "--until", "2.97s")


def one_ball(name, law, mass=0.1, **how):
    how = how or {"height": 0.5}
    drop = sb.Drop([sb.Ball(mass, name=name)], [law], **how)
    Path(f"{name}.toml").write_text(drop.to_toml())
    return f"{name}.toml"


def test_balls_of_a_file_each_are_stacked(told):
    lower = one_ball("lower", sb.Hysteretic(3e4, restitution=0.8), 0.3)
    upper = one_ball("upper", sb.Hysteretic(1e4, restitution=0.6), 0.05, height=2.0)
    found = told("simulate", lower, upper, "--gap", "1mm")
    drop = sb.Drop.from_mapping(found["drop"])
    assert [ball.name for ball in drop.balls] == ["lower", "upper"]
    assert (drop.height, drop.gaps) == (0.5, (0.001,))
    assert drop.contacts[1].stiffness == pytest.approx(7500.0)
    assert drop.contacts[1].restitution == pytest.approx(math.sqrt(0.25 * 0.64 + 0.75 * 0.36))
    assert found["contact_sources"] == ["lower.toml", "lower.toml and upper.toml in series"]


def test_rigid_balls_are_stacked_by_their_contacts_alone(printed):
    balls = [one_ball("lower", sb.Spring(3e4)), one_ball("upper", sb.Rigid(0.6))]
    contacts = ["--contact", "Rigid restitution=0.8", "--contact", "Rigid restitution=0.5"]
    assert "Rigid, restitution 0.5" in printed("simulate", *balls, *contacts)


@pytest.mark.usefixtures("little_work")
@pytest.mark.parametrize("stiffness", ["1e300", "1e-300"])
def test_a_drop_without_a_result_ends_with_3(run, stiffness):
    contacts = ["--contact", f"Spring stiffness={stiffness}", "--contact", "Spring stiffness=1"]
    name = "INVALID" if stiffness == "1e300" else "EVENT_LIMIT"
    code, out, err = run("simulate", "B1", "B2", *contacts, "--json")
    assert (code, json.loads(out)["status"]) == (3, name)
    assert err == f"stackbounce: error: no result for 1 of 1 drop: 1 {name}\n"


def test_a_sweep_says_how_many_drops_have_no_result(run):
    contacts = ["--contact", "Spring stiffness=1", "--contact", "Spring stiffness=1"]
    over = ["--over", "contacts.0.stiffness=1,1e300", "--out", "a.zarr"]
    code, out, err = run("sweep", "B1", "B2", *contacts, *over)
    assert code == 3
    assert "1 FINISHED" in out
    assert err == "stackbounce: error: no result for 1 of 2 drops: 1 INVALID\n"


def test_a_number_of_many_digits_is_refused(refused):
    digits = "9" * 5000
    for over in (f"balls.0.mass=1:2:{digits}", f"balls.{digits}.mass=1:2:3"):
        assert "unexpected" not in refused("sweep", "B1", "--over", over, "--out", "a.zarr")


def test_an_interruption_while_modules_are_imported_is_one_line():
    code = (
        "import os, signal, sys\n"
        "class Interrupt:\n"
        "    def find_spec(self, name, *_):\n"
        "        if name == 'typer': os.kill(os.getpid(), signal.SIGINT)\n"
        "sys.meta_path.insert(0, Interrupt())\n"
        "from stackbounce.__main__ import main\n"
        "sys.exit(main())"
    )
    done = process(code=code)
    assert (done.returncode, done.stderr) == (130, "stackbounce: interrupted\n")


def test_an_interruption_that_python_drops_comes_again():
    done = process(code=LOST)
    assert (done.returncode, done.stderr) == (130, "")


LOST = """
import signal, sys, time
import stackbounce.cli
from stackbounce.__main__ import main

class Finalised:
    def __del__(self):
        signal.raise_signal(signal.SIGINT)

def run():
    try:
        Finalised()
        time.sleep(600.0)
    except KeyboardInterrupt:
        return 130

stackbounce.cli.main = run
sys.exit(main())
"""


@pytest.mark.slow
def test_pictures_do_not_depend_on_the_settings_of_matplotlib(run):
    assert run("simulate", "B1", "--plot", "plain.svg")[0] == 0
    Path("matplotlibrc").write_text("text.usetex: True\nfont.size: 30\n")
    done = process("simulate", "B1", "--plot", "own.svg", env={**os.environ, "MPLBACKEND": "junk"})
    assert (done.returncode, done.stderr) == (0, "")
    assert Path("own.svg").read_bytes() == Path("plain.svg").read_bytes()


def broken_import():
    error = ImportError("initialization failed")
    error.__cause__ = KeyboardInterrupt()
    return error


@pytest.mark.parametrize(
    ("error", "code", "line"),
    [
        (KeyboardInterrupt(), 130, "interrupted\n"),
        (broken_import(), 130, "interrupted\n"),
        (OSError(28, "No space left on device", "x.svg"), 2, "error: x.svg: No space left on dev"),
        (MemoryError(), 1, "error: out of memory: ask for fewer balls"),
        (OverflowError(4, "a\nb"), 1, "error: unexpected OverflowError: (4, 'a\\nb')"),
        (RecursionError("deep"), 1, "error: unexpected RecursionError: deep (please report it)"),
    ],
)
def test_what_ends_a_run_is_one_line(run, monkeypatch, error, code, line):
    def failing(*_, **__):
        raise error

    monkeypatch.setattr(sb, "simulate", failing)
    ended, out, err = run("simulate", "B1")
    assert (ended, out) == (code, "")
    assert err.startswith(f"stackbounce: {line}")
    assert err.count("\n") == 1


@pytest.mark.usefixtures("little_work")
@pytest.mark.fast_cases(2)
@pytest.mark.parametrize("speed", ["1e200", "1e-200", "1e308", "5e-324"])
@pytest.mark.parametrize("form", [[], ["--json"]])
def test_speeds_at_the_ends_of_the_range(run, speed, form):
    code, out, err = run("simulate", "B1", "B2", "--speed", speed, *form)
    lost = "stackbounce: error: no result for 1 of 1 drop: 1"
    assert (code, err) in [(0, ""), (3, f"{lost} EVENT_LIMIT\n"), (3, f"{lost} INVALID\n")]
    assert "nan" not in out.lower()


@pytest.mark.fast_cases(2)
@pytest.mark.skipif(os.name != "posix", reason="a shell closes the streams")
@pytest.mark.parametrize(
    ("streams", "line"),
    [
        (">&-", "there is no standard output to write to: it is closed"),
        (">/dev/full", "the disk: No space left on device"),
        (">&- 2>&-", None),
    ],
)
@pytest.mark.parametrize("arguments", ["--help", "simulate basketball"])
def test_a_standard_output_that_cannot_be_written_to(arguments, streams, line):
    command = ["sh", "-c", f'"$0" -c "{MAIN}" {arguments} {streams}', sys.executable]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode in (1, 2)
    assert done.stderr == ("" if line is None else f"stackbounce: error: {line}\n")


def test_the_catalogue_as_a_table_and_as_json(printed, told):
    out = printed("balls")
    assert rows(out, "tennis")[0] == ["tennis", *"57.00 66.00 0.7506 5.000 22500 10300".split()]
    assert rows(out, "basketball")[0][4] == "–"
    assert "Cross 2007, Table I" in out
    assert rows(out, "B1")[1][:5] == ["B1", "B2", "56000", "16000", "1.000"]
    got = told("balls")
    tennis = got["balls"][1]
    assert (tennis["name"], tennis["mass"], tennis["stiffness"]) == ("tennis", 0.057, 22500.0)
    assert tennis["sources"]["mass"] == "Cross 2007, section III"
    assert got["balls"][0]["contact_time"] is None
    assert got["pairs"][0]["stiffness"] == 1000.0


@pytest.fixture
def write(monkeypatch):
    """Stands in for the report, which has tests of its own, and takes its time."""
    written = []

    def stand_in(out, progress):
        progress("figure 2a")
        written.append(out)
        told = {"counts": {"agrees": 2, "differs": 1}, "computed": math.inf}
        counted = "3 numbers: agrees 2, differs 1"
        rows = [SimpleNamespace(verdict="agrees", explained=True)] * 2
        rows.append(SimpleNamespace(verdict="differs", explained=False))
        return SimpleNamespace(rows=rows, counted=counted, as_dict=lambda: told)

    monkeypatch.setattr(cross2007, "write", stand_in)
    return written


def test_paper_says_what_it_does_and_what_came_out(run, write):
    code, out, err = run("paper", "--out", "new/folder")
    assert (code, err) == (0, "figure 2a\n")
    assert write == [Path("new/folder")]
    assert out.startswith("3 numbers: agrees 2, differs 1\n")
    assert "Rows that disagree without an explanation: 1\n" in out
    assert out.endswith("Open new/folder/index.html\n")
    found = json.loads(run("paper", "--out", "new", "--json")[1])
    assert found == {"counts": {"agrees": 2, "differs": 1}, "computed": None}


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="root may write everywhere")
def test_an_output_folder_without_permission(refused):
    Path("shut").mkdir(mode=0o500)
    assert refused("paper", "--out", "shut") == "shut cannot be written to: Permission denied\n"
    assert list(Path("shut").iterdir()) == []


@pytest.mark.parametrize(
    ("words", "law", "text"),
    [
        ("none", None, "none"),
        ("Rigid restitution=78%", sb.Rigid(0.78), "Rigid, restitution 0.78"),
        ("Hertz stiffness=2e9", sb.Hertz(2e9), "Hertz, stiffness 2e+09 N/m^1.5"),
        ("powerlaw stiffness=2N/m^2 exponent=2", sb.PowerLaw(2, 2), "PowerLaw, stiffness 2 N/m^2"),
    ],
)
def test_a_law_is_read_and_described(words, law, text):
    assert read_contact(words, "x") == law
    assert law is None or law.described().startswith(text)


def test_sweep_writes_a_store_and_a_picture(printed, told, tmp_path):
    over = ["--over", "balls.0.mass=50g:500g:4:log", "--over", "gaps.0=0mm,2mm"]
    files = ["--out", "map.zarr", "--plot", "map.png"]
    out = printed("sweep", "basketball", "tennis", *over, *files)
    assert "8 drops, over\n  balls_0_mass: 4, 0.05 to 0.5 kg\n  gaps_0: 2, 0 to 0.002 m\n" in out
    assert "  energy_retained: 1\n" in out
    assert "8 FINISHED" in out
    assert (tmp_path / "map.png").stat().st_size > 5000
    found = told("sweep", "basketball", "tennis", *over, "--out", "map.zarr")
    assert found["status"] == {"FINISHED": 8}
    assert found["over"] == {"balls_0_mass": 4, "gaps_0": 2}
    low, high = found["ranges"]["rebound_ratio"]["ball 1"]
    assert 1.0 < low < high < 3.0


def test_sweep_draws_the_ball_that_is_asked_for(run, monkeypatch):
    drawn = []
    monkeypatch.setattr(plots, "lines", lambda _, *asked, **which: drawn.append((asked, which)))
    monkeypatch.setattr(style, "render", lambda draw, *_: draw() or b"")
    over = ["--over", "balls.0.mass = 50 g, 60 g", "--out", "a.zarr", "--overwrite"]
    for asked in ("rebound_ratio.0", "collisions"):
        assert run("sweep", "B1", "B2", *over, "--plot", "a.png", "--show", asked)[0] == 0
    assert drawn == [(("rebound_ratio",), {"index": 0}), (("collisions",), {})]
