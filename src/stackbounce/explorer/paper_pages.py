"""The paper's pages: computed at the first request, kept while the server runs."""

import asyncio
import re
from collections.abc import MutableMapping
from pathlib import Path
from typing import Any

from starlette.responses import FileResponse, RedirectResponse, Response
from starlette.staticfiles import StaticFiles

from stackbounce import cross2007
from stackbounce.explorer.made import FOLDER, WAITING, digest
from stackbounce.explorer.workers import Workers

_SCRIPT = re.compile(rb"<script>(.*?)</script>", re.DOTALL)
_AGAIN = "2"  # s, after which the waiting page reloads itself
_POLICY = (
    "default-src 'none'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'; script-src {scripts}"
)
"""The content security policy of the pages, which hold their styles and pictures inline."""


class Papers:
    """A folder of pages, and the job that writes it.

    Parameters
    ----------
    workers : Workers
        The processes that run the job.
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
        self._job: asyncio.Task[str] | None = None

    async def page(self, name: str, scope: MutableMapping[str, Any]) -> Response:
        """Return a page or file of the paper, or a waiting page while they are being computed.

        Raises
        ------
        HTTPException
            If there is no file of this name.
        StackbounceError
            If the pages could not be computed; the next request computes them again.
        """
        if self._job is None:
            self._job = asyncio.create_task(self._write())
            self._job.add_done_callback(lambda job: job.cancelled() or job.exception())  # seen
        if not self._job.done():
            return FileResponse(FOLDER / WAITING, headers={"refresh": _AGAIN})
        job = self._job
        if job.exception():
            self._job = None
        policy = job.result()
        if not name:
            return RedirectResponse("/paper/index.html")
        found = await StaticFiles(directory=self._folder).get_response(name, scope)
        found.headers["content-security-policy"] = policy
        return found

    async def _write(self) -> str:
        """Write the pages; return their content security policy: their own scripts may run."""
        async with self._workers.turn("the paper"):
            await self._workers.run(_write, self._folder, seconds=self._seconds)
        scripts = _SCRIPT.findall((self._folder / "index.html").read_bytes())
        allowed = " ".join(f"'{digest(script)}'" for script in scripts)
        return _POLICY.format(scripts=allowed or "'none'")


def _write(folder: Path) -> None:
    """Write the paper's pages; the audit itself is not sent back."""
    cross2007.write(folder, explorer="../")
