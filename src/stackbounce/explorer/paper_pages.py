"""The paper's pages: computed at the first request, kept while the server runs."""

import asyncio
import base64
import hashlib
import html
import re
from collections.abc import Iterator
from pathlib import Path

from fastapi.responses import FileResponse, HTMLResponse, RedirectResponse, Response
from starlette.exceptions import HTTPException

from stackbounce.errors import StackbounceError
from stackbounce.explorer.answers import paper
from stackbounce.explorer.guard import PAPER
from stackbounce.explorer.worker_pool import Workers

__all__ = ["Papers"]

_SCRIPT = re.compile(rb"<script>(.*?)</script>", re.DOTALL)
_AGAIN = "2"  # s, after which the waiting page reloads itself
_WAIT = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>The paper recomputed</title>
<link rel="icon" href="/icon.svg" type="image/svg+xml">
<link rel="stylesheet" href="/style.css">
</head>
<body>
<main class="waiting" role="status"><h1>The paper is being recomputed</h1>
<p>{words}</p>
<p><a href="/">Back to the explorer</a></p></main>
</body>
</html>
"""
_COMPUTING = (
    "Its figures, its tables and the audit of every number in it: half a minute or so. "
    "This page shows them when they are there."
)


class Papers:
    """A folder of pages, and the job that writes it.

    Parameters
    ----------
    workers : Workers
        The pool that runs the job.
    folder : Path
        An empty folder for the pages.
    seconds : float
        Time limit of the job in s.

    Examples
    --------
    >>> from stackbounce.explorer import LIMITS
    >>> workers = Workers(LIMITS)
    >>> papers = Papers(workers, getfixture("tmp_path"), 60.0)
    >>> workers.stop()
    """

    def __init__(self, workers: Workers, folder: Path, seconds: float) -> None:
        self._workers, self._folder, self._seconds = workers, folder, seconds
        self._job: asyncio.Task[None] | None = None

    async def page(self, name: str) -> Response:
        """Return a page or file of the paper, or a waiting page while they are being computed.

        Raises
        ------
        HTTPException
            If there is no file of this name.
        """
        if self._job is None:
            job = self._workers.run(paper.write_paper, str(self._folder), seconds=self._seconds)
            self._job = asyncio.create_task(job)
        if not self._job.done():
            return HTMLResponse(_WAIT.format(words=_COMPUTING), headers={"refresh": _AGAIN})
        error = self._job.exception()
        if error is not None:
            self._job = None
            words = str(error) if isinstance(error, StackbounceError) else type(error).__name__
            return HTMLResponse(_WAIT.format(words=html.escape(f"It failed: {words}")), 503)
        if not name:
            return RedirectResponse("/paper/index.html")
        return self._send_file(name)

    def _send_file(self, name: str) -> Response:
        files = {path.relative_to(self._folder).as_posix(): path for path in self._files()}
        if name not in files:
            raise HTTPException(404, "the paper has no such page")
        path = files[name]
        if path.suffix != ".html":
            return FileResponse(path)
        content = path.read_bytes()
        return HTMLResponse(content, headers={"content-security-policy": _allow_scripts(content)})

    def _files(self) -> Iterator[Path]:
        return (path for path in self._folder.rglob("*") if path.is_file())


def _allow_scripts(page: bytes) -> str:
    """Return the content security policy of a page: only its own inline scripts may run."""
    digests = [hashlib.sha256(script).digest() for script in _SCRIPT.findall(page)]
    allowed = " ".join(f"'sha256-{base64.b64encode(digest).decode()}'" for digest in digests)
    return f"{PAPER}; script-src {allowed}" if allowed else PAPER
