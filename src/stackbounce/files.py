"""Files: reading ordinary ones of limited size, and writing them whole or not at all.

A file of its own kind ends with a seal: a comment that has the digest of the rest. The package
replaces a file only if the seal says that it is as it was written here. In a folder that it makes,
the digests of all files are in ``stackbounce.sha256``.
"""

import contextlib
import hashlib
import os
import secrets
import stat
import struct
import tempfile
import zlib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from stackbounce.errors import FileError, InvalidType, shown

_SUMS = "stackbounce.sha256"
_COMMENTS = {
    ".toml": (b"# ", b"\n"),
    ".pdf": (b"% ", b"\n"),
    ".svg": (b"<!-- ", b" -->\n"),
    ".html": (b"<!-- ", b" -->\n"),
}
_PNG_END = 12  # bytes of the last chunk, before which a comment has to be
_LARGEST = 2**30  # bytes of a file of ours


def shipped(package: str, name: str) -> str:
    """Return the text of a file that lies in one of the package's folders.

    Examples
    --------
    >>> shipped("stackbounce", "attributes.toml").partition(",")[0]
    '# Attributes that people try and that are not there'
    """
    return Path(__file__).parent.joinpath(*package.split(".")[1:], name).read_text("utf-8")


def shipped_table(package: str, name: str) -> dict[str, Any]:
    """Return what a file in TOML says that lies in one of the package's folders."""
    import tomllib

    return tomllib.loads(shipped(package, name))


def content_of(path: object, most: int) -> tuple[str, bytearray]:
    """Return the name of a file and its bytes.

    Parameters
    ----------
    path : str or path-like
        The file.
    most : int
        The bytes that it may have.

    Raises
    ------
    InvalidType
        If `path` is neither a string nor a path.
    FileError
        If it cannot be read, is no ordinary file, is empty, or larger than `most`.

    Examples
    --------
    >>> path = getfixture("tmp_path") / "ball.toml"
    >>> _ = path.write_bytes(b"height = 1")
    >>> content_of(path, 100)[1]
    bytearray(b'height = 1')
    """
    name = os.fspath(path) if isinstance(path, str | os.PathLike) else None
    if not isinstance(name, str):
        raise InvalidType(f"path must be a string or a path, got {shown(path)}")
    if "\n" in name:
        raise FileError(f"path must be the name of a file, not what is in one, got {shown(name)}")
    try:
        mode = os.stat(name).st_mode  # noqa: PTH116  # Path("") is the folder one is in
        if stat.S_ISDIR(mode):
            raise FileError(f"{name} is a folder: give one of its files")
        if not stat.S_ISREG(mode):  # a pipe or a device may never end
            raise FileError(f"{name} is no ordinary file: copy what it gives into one")
        with Path(name).open("rb") as file:  # its read() would allocate the size that is asked for
            content = bytearray(min(os.fstat(file.fileno()).st_size, most) + 1)
            del content[file.readinto(content) :]
    except OSError as error:
        if isinstance(error, FileError):
            raise
        raise FileError(f"{name} cannot be read: {error.strerror or error}") from error
    except ValueError as error:  # a null character in the name
        raise FileError(f"{name!r} cannot be read: {error}") from error
    if len(content) > most:
        size = f"{most >> 20} MiB" if most >= 2**20 else f"{most >> 10} KiB"
        raise FileError(f"{name} is larger than {size}: cut out what is of interest")
    if not content:
        raise FileError(f"{name} is empty")
    return name, content


def check_place(path: Path) -> None:
    """Refuse the path of a file that is to be written into a folder that does not exist.

    Raises
    ------
    FileError
        If the folder does not exist.

    Examples
    --------
    >>> check_place(Path("missing/bounce.svg"))
    Traceback (most recent call last):
    stackbounce.errors.FileError: missing/bounce.svg cannot be written: there is no folder missing
    """
    if not path.parent.is_dir():
        raise FileError(f"{path} cannot be written: there is no folder {path.parent}")


def check_own(path: Path, overwrite: bool = False, read: Iterable[str] = ()) -> None:
    """Refuse to replace a file that is not as `write_file` wrote it, or that is read.

    Parameters
    ----------
    path : Path
        The file.
    overwrite : bool, optional
        Whether any file may be replaced.
    read : iterable of str, optional
        Files that the same command reads; other texts do not matter.

    Raises
    ------
    FileError
        If there is such a file. Pipes and devices may be written to.

    Examples
    --------
    >>> path = getfixture("tmp_path") / "ball.toml"
    >>> _ = path.write_text("height = 1")
    >>> check_own(path)
    Traceback (most recent call last):
    stackbounce.errors.FileError: ...ball.toml is there, and has no mark that stackbounce wrote ...
    """
    exists = os.path.exists  # Path.exists raises where a name is too long
    if overwrite or not exists(path) or _is_stream(path):
        return
    if any(exists(other) and path.samefile(other) for other in read):
        raise FileError(f"{path} is read here: choose another name, or add --overwrite")
    try:
        content = path.read_bytes() if path.stat().st_size < _LARGEST else b""
    except OSError:
        content = b""
    seal, end = len(_seal(path, b"")), _end(path)
    rest = content[: -seal - end] + content[len(content) - end :]
    if not seal or content != _sealed(path, rest):
        raise FileError(
            f"{path} is there, and has no mark that stackbounce wrote it and nobody changed it: "
            "choose another name, or add --overwrite"
        )


def write_file(path: Path, content: bytes, overwrite: bool = False) -> None:
    r"""Write a file, sealed, whole or not at all; see `check_own` and `write_files`.

    Examples
    --------
    >>> path = getfixture("tmp_path") / "ball.toml"
    >>> write_file(path, b"height = 1\n")
    >>> path.read_text().splitlines()
    ['height = 1', '# sha256 of the rest, by stackbounce: 7e29...']
    >>> write_file(path, b"height = 2\n")
    """
    check_own(path, overwrite)
    write_files([(path, _sealed(path, content))])


def _sealed(path: Path, content: bytes) -> bytes:
    """Return the content of a file with its seal."""
    at = len(content) - _end(path)
    return content[:at] + _seal(path, content) + content[at:]


def _seal(path: Path, content: bytes) -> bytes:
    """Return a comment with the digest of a file's content; nothing if it can have no comment."""
    words = b"sha256 of the rest, by stackbounce: " + hashlib.sha256(content).hexdigest().encode()
    suffix = path.suffix.lower()
    if suffix == ".png":
        chunk = b"tEXtComment\0" + words
        return struct.pack(">I", len(chunk) - 4) + chunk + struct.pack(">I", zlib.crc32(chunk))
    before, after = _COMMENTS.get(suffix, (b"", b""))
    return before + words + after if before else b""


def _end(path: Path) -> int:
    """Return how many bytes of a file come after its seal."""
    return _PNG_END if path.suffix.lower() == ".png" else 0


def write_files(files: Iterable[tuple[Path, bytes]]) -> None:
    """Write files whole or not at all: all of them beside their places, then each is renamed.

    A file that cannot be written, such as on a full disk, leaves all that was there. A new file
    has the permissions that the system gives it, and one that is replaced keeps its own. The target
    of a symbolic link is replaced, not the link. What is no ordinary file, such as a pipe or a
    device, is written directly.

    Parameters
    ----------
    files : iterable of (Path, bytes)
        The files, in the order in which they are renamed.

    Raises
    ------
    FileError
        If one cannot be written.

    Examples
    --------
    >>> folder = getfixture("tmp_path")
    >>> write_files([(folder / "a.txt", b"1"), (folder / "b.txt", b"2")])
    >>> sorted(path.name for path in folder.iterdir())
    ['a.txt', 'b.txt']
    """
    parts: list[tuple[Path, Path]] = []
    path = Path()
    try:
        for path, content in files:
            if _is_stream(path):
                path.write_bytes(content)
                continue
            place = Path(os.path.realpath(path))
            part = place.with_name(f".stackbounce-{secrets.token_hex(8)}.part")
            parts.append((part, place))
            _write_beside(part, place, content)
        for part, place in parts:
            path = place
            part.replace(place)
    except (OSError, ValueError) as error:  # ValueError: a null character in the name
        reason = getattr(error, "strerror", None) or error
        raise FileError(f"{path} cannot be written: {reason}") from error
    finally:
        for part, _ in parts:
            with contextlib.suppress(OSError, ValueError):
                part.unlink(missing_ok=True)


def prepare_folder(folder: Path, names: Iterable[str], overwrite: bool = False) -> None:
    """Make a folder for files, with the folders in it, before these are computed.

    Parameters
    ----------
    folder : Path
        The folder.
    names : iterable of str
        The names of the files, such as ``figures/first.svg``.
    overwrite : bool, optional
        Whether `write_folder` will replace any file.

    Raises
    ------
    FileError
        If the folder cannot be made or written to, or `write_folder` would not replace a file.

    Examples
    --------
    >>> folder = getfixture("tmp_path") / "new"
    >>> prepare_folder(folder, ["index.html", "made/data.json"])
    >>> [path.name for path in folder.iterdir()]
    ['made']
    """
    names = list(names)
    try:
        for place in sorted({folder, *((folder / name).parent for name in names)}):
            place.mkdir(parents=True, exist_ok=True)
            tempfile.TemporaryFile(dir=place).close()
    except (OSError, ValueError) as error:  # ValueError: a null character in the name
        reason = getattr(error, "strerror", None) or error
        raise FileError(f"{folder} cannot be written to: {reason}") from None
    _check_ours(folder, names, overwrite)


def write_folder(folder: Path, files: Mapping[str, bytes], overwrite: bool = False) -> None:
    """Write files into a folder, all or none, and their digests into ``stackbounce.sha256`` there.

    Whenever it is stopped, the digests tell which files are as they were written here. Only such
    files are replaced.

    Parameters
    ----------
    folder : Path
        The folder, as `prepare_folder` makes it.
    files : mapping of str to bytes
        The contents of the files by their names.
    overwrite : bool, optional
        Whether any file is replaced.

    Raises
    ------
    FileError
        If a file is there that was not written here, or one cannot be written.

    Examples
    --------
    >>> folder = getfixture("tmp_path")
    >>> write_folder(folder, {"index.html": b"1"})
    >>> write_folder(folder, {"index.html": b"2"})
    >>> _ = (folder / "index.html").write_bytes(b"mine")
    >>> write_folder(folder, {"index.html": b"3"})
    Traceback (most recent call last):
    stackbounce.errors.FileError: ...index.html is there, and is not as this command writes it: ...
    """
    known = _check_ours(folder, files, overwrite)
    new = {f"{hashlib.sha256(content).hexdigest()}  {name}" for name, content in files.items()}
    others = [line for line in known if line.partition("  ")[2] not in files]
    contents = [(folder / name, content) for name, content in files.items()]
    before, after = (
        (folder / _SUMS, "".join(f"{line}\n" for line in sorted({*new, *lines})).encode())
        for lines in (known, others)
    )
    write_files([before, *contents, after])


def _check_ours(folder: Path, names: Iterable[str], overwrite: bool) -> list[str]:
    """Refuse files that are not as they were written here; return what was, ``DIGEST  NAME``."""
    sums = folder / _SUMS
    known = sums.read_text("utf-8", "replace").splitlines() if sums.is_file() else []
    for name in () if overwrite else names:
        path = folder / name
        found = hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else ""
        if path.exists() and f"{found}  {name}" not in known:
            raise FileError(
                f"{path} is there, and is not as this command writes it: move it away, or choose "
                "another folder"
            )
    return known


def _is_stream(path: Path) -> bool:
    """Return whether a path is no ordinary file, or where the standard output goes."""
    try:
        found = path.stat()
    except FileNotFoundError:
        return False
    if not stat.S_ISREG(found.st_mode):
        return True
    try:
        return os.path.samestat(found, os.fstat(1))
    except OSError:  # there is no standard output
        return False


def _write_beside(part: Path, place: Path, content: bytes) -> None:
    """Write a new file on the disk, with the permissions of the one whose place it takes."""
    mode = _mode_of(place)
    with os.fdopen(os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666), "wb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())  # some systems say only now that the disk is full
    if mode is not None:
        part.chmod(mode)


def _mode_of(place: Path) -> int | None:
    """Return the permissions of a file, None if there is none; raise if it is write-protected."""
    try:
        with os.fdopen(os.open(place, os.O_WRONLY), "wb") as file:  # which truncates nothing
            return stat.S_IMODE(os.fstat(file.fileno()).st_mode)
    except FileNotFoundError:
        return None
