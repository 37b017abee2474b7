import os
import stat
import zlib
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from stackbounce.cli import main
from stackbounce.errors import FileError
from stackbounce.files import content_of, prepare_folder, write_file, write_files, write_folder

posix = pytest.mark.skipif(os.name != "posix", reason="permissions, links and pipes of POSIX")


@pytest.fixture(autouse=True)
def _in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def disk_of():
    """Refuse further bytes of a file, as a full disk does."""
    resource = pytest.importorskip("resource")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    yield lambda size: resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    resource.setrlimit(resource.RLIMIT_FSIZE, before)


def names(folder="."):
    return sorted(path.name for path in Path(folder).iterdir())


HEIGHTS = ["measure", "--heights", "1, 0.6 m", "--mass", "57g"]
FILES = pytest.mark.parametrize(
    ("command", "name"),
    [
        ([*HEIGHTS, "--save"], "ball.toml"),
        (["simulate", "B1", "--plot"], "a.svg"),
        (["simulate", "B1", "--plot"], "a.png"),
        (["simulate", "B1", "--plot"], "a.pdf"),
        (["simulate", "B1", "--plot"], "a.SVG"),
    ],
)


@FILES
@pytest.mark.fast_cases(2)
def test_a_full_disk_leaves_the_file_that_was_there(command, name, capsys, disk_of):
    Path(name).write_bytes(b"as it was")
    disk_of(10)
    code = main([*command, name, "--overwrite"])
    _, err = capsys.readouterr()
    assert code == 2
    assert err.startswith(f"stackbounce: error: {name} cannot be written: ")
    assert err.count("\n") == 1
    assert Path(name).read_bytes() == b"as it was"
    assert names() == [name]


@FILES
@pytest.mark.fast_cases(2)
def test_a_file_is_replaced_if_it_is_as_it_was_written_here(command, name, capsys):
    path = Path(name)
    assert main([*command, name]) == main([*command, name]) == 0
    before = path.read_bytes()
    for others in (before + b"\n", before[:99] + b" " + before[99:], b"mine", b""):
        path.write_bytes(others)
        capsys.readouterr()
        assert main([*command, name]) == 2
        err = capsys.readouterr().err
        assert err.startswith(f"stackbounce: error: {name} is there, and has no mark that stackbou")
        assert err.endswith("choose another name, or add --overwrite\n")
        assert path.read_bytes() == others
    assert main([*command, name, "--overwrite"]) == 0
    assert path.read_bytes() == before


def test_a_marked_file_is_whole():
    for name in ("a.png", "a.svg"):
        assert main(["simulate", "B1", "--plot", name]) == 0
    assert pytest.importorskip("matplotlib.image").imread("a.png").ndim == 3
    assert ET.parse("a.svg").getroot().tag.endswith("svg")
    content = Path("a.png").read_bytes()
    chunk = content[content.index(b"tEXtComment") : -16]
    assert content[-16:-12] == zlib.crc32(chunk).to_bytes(4, "big")
    assert chunk.startswith(b"tEXtComment\0sha256 of the rest, by stackbounce: ")


MEASURED = """
[measured]
rebound_ratios = ['0.8 ± 0.01']  # this morning
[vary]
"contacts.0.restitution" = ""
"""


def test_a_file_that_is_read_is_not_replaced(capsys):
    """Not even if it was written here; the fit once replaced its data and the user's comments."""
    assert main([*HEIGHTS, "--save", "ball.toml"]) == 0
    ours = Path("ball.toml").read_bytes()
    Path("mine.toml").write_text(ours.decode() + MEASURED, "utf-8")
    mine = Path("mine.toml").read_bytes()
    Path("linked.toml").symlink_to("mine.toml")
    vary = ["--vary", "contacts.0.restitution", "--measured", "rebound_ratios.0=0.8±0.01"]
    for command, said in (
        (["fit", "mine.toml", "--save", "mine.toml"], "mine.toml is read here: "),
        (["fit", "mine.toml", "--save", "linked.toml"], "linked.toml is read here: "),
        (["fit", "ball.toml", *vary, "--save", "ball.toml"], "ball.toml is read here: "),
        (["highest", "ball.toml", "B1", "--balls", "2", "--save", "ball.toml"], "ball.toml is re"),
        (["fit", "ball.toml", *vary, "--save", "mine.toml"], "mine.toml is there, and has no mark"),
    ):
        capsys.readouterr()
        assert main(command) == 2
        assert capsys.readouterr().err.startswith(f"stackbounce: error: {said}")
        assert Path("mine.toml").read_bytes() == mine
        assert Path("ball.toml").read_bytes() == ours
    assert main(["fit", "mine.toml", "--save", "fitted.toml"]) == 0
    assert main(["fit", "mine.toml", "--save", "fitted.toml"]) == 0
    assert main(["fit", "ball.toml", *vary, "--save", "ball.toml", "--overwrite"]) == 0
    assert Path("ball.toml").read_bytes() != ours


def test_a_table_has_no_mark(capsys):
    """A comment would be a row of it for other programs."""
    command = ["fit", "B1", "--measured", "durations.0=2.0±0.1ms", "--sample", "3200"]
    command += ["--vary", "contacts.0.stiffness", "--draws", "draws.csv"]
    assert main(command) == 0
    assert main(command) == 2
    assert "draws.csv is there" in capsys.readouterr().err
    assert main([*command, "--overwrite"]) == 0


def test_of_several_files_all_are_written_or_none(disk_of):
    write_file(Path("a"), b"old")
    disk_of(10)
    with pytest.raises(FileError, match="b cannot be written"):
        write_files([(Path("a"), b"new"), (Path("b"), bytes(11))])
    assert names() == ["a"]
    assert Path("a").read_bytes() == b"old"


@posix
def test_permissions_are_those_of_a_plain_write():
    before = os.umask(0o027)
    try:
        write_file(Path("new"), b"1")
        assert stat.S_IMODE(Path("new").stat().st_mode) == 0o640
        Path("new").chmod(0o604)
        write_file(Path("new"), b"2", overwrite=True)
        assert stat.S_IMODE(Path("new").stat().st_mode) == 0o604
    finally:
        os.umask(before)


@posix
@pytest.mark.skipif(os.name == "posix" and os.geteuid() == 0, reason="root may write everywhere")
def test_a_write_protected_file_is_not_replaced():
    write_file(Path("kept"), b"1")
    Path("kept").chmod(0o400)
    with pytest.raises(FileError, match="kept cannot be written: Permission denied"):
        write_file(Path("kept"), b"2", overwrite=True)


@posix
def test_the_target_of_a_link_is_replaced():
    Path("below").mkdir()
    for target in ("below/there", "below/new"):
        link = Path(f"to-{Path(target).name}")
        link.symlink_to(target)
        write_file(link, b"1")
        assert link.is_symlink()
        assert Path(target).read_bytes() == b"1"
    assert names("below") == ["new", "there"]


@posix
def test_a_pipe_is_written_to():
    out, into = os.pipe()
    try:
        write_file(Path(f"/dev/fd/{into}"), b"picture")
        assert os.read(out, 100) == b"picture"
    finally:
        os.close(out)
        os.close(into)


@pytest.mark.parametrize("name", ["none/a", "a\0b", "kept/below", "."])
def test_places_where_nothing_can_be_written(name):
    Path("kept").write_bytes(b"1")
    with pytest.raises(FileError, match="cannot be written"):
        write_file(Path(name), b"2")
    assert names() == ["kept"]


def test_no_more_is_read_than_allowed():
    Path("large").write_bytes(bytes(2**20 + 1))
    assert len(content_of("large", 2**20 + 1)[1]) == 2**20 + 1
    with pytest.raises(FileError, match="large is larger than 1 MiB"):
        content_of("large", 2**20)


def test_no_temporary_file_stays_where_a_file_of_a_folder_cannot_be_replaced(tmp_path):
    (tmp_path / "audit.csv").mkdir()
    with pytest.raises(FileError):
        write_folder(tmp_path, {"audit.csv": b"new", "index.html": b"new"})
    assert [path.name for path in tmp_path.iterdir()] == ["audit.csv"]


def test_only_files_as_they_were_written_are_replaced(tmp_path):
    write_folder(tmp_path, {"index.html": b"1", "study.html": b"1"})
    write_folder(tmp_path, {"index.html": b"2"})
    assert (tmp_path / "index.html").read_bytes() == b"2"
    write_folder(tmp_path, {"study.html": b"3"})
    (tmp_path / "index.html").write_bytes(b"changed by hand")
    with pytest.raises(FileError, match=r"index\.html is there"):
        write_folder(tmp_path, {"index.html": b"4", "study.html": b"4"})
    assert (tmp_path / "study.html").read_bytes() == b"3"


def test_a_folder_is_made_for_its_files_and_foreign_files_are_told_of_before():
    prepare_folder(Path("new/site"), ["index.html", "made/data.json"])
    assert names("new/site") == ["made"]
    Path("new/site/made/data.json").write_bytes(b"mine")
    with pytest.raises(FileError, match=r"data\.json is there, and is not as this command"):
        prepare_folder(Path("new/site"), ["index.html", "made/data.json"])
    Path("taken").write_bytes(b"mine")
    for place in ("taken", "taken/below", "a\0b"):
        with pytest.raises(FileError, match="cannot be written to"):
            prepare_folder(Path(place), ["index.html"])
