"""The server's addresses: what each takes, and the function that computes its answer."""

import contextlib
import mimetypes
import tempfile
from collections.abc import AsyncIterator, Callable, Sequence
from pathlib import Path
from typing import Annotated, Any

from fastapi import FastAPI, Form, HTTPException, Request, UploadFile
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse, Response
from fastapi.staticfiles import StaticFiles
from pydantic import Json
from starlette.middleware.gzip import GZipMiddleware

from stackbounce.errors import StackbounceError
from stackbounce.explorer import schema
from stackbounce.explorer.addresses import Place
from stackbounce.explorer.answers import predictions, records
from stackbounce.explorer.guard import add_guard
from stackbounce.explorer.limits import Limits
from stackbounce.explorer.made import FOLDER, HTTP, MEASURING, PAGE, PLAYING
from stackbounce.explorer.paper_pages import Papers
from stackbounce.explorer.workers import AGAIN_SECONDS, Busy, Workers
from stackbounce.version import __version__

_PROBLEMS: dict[int | str, dict[str, Any]] = {
    int(status): {"model": schema.Problem, "description": meaning}
    for status, meaning in HTTP["problems"].items()
}
_Options = Annotated[Json[dict[str, Any]] | None, Form()]


def create_app(limits: Limits, others: Sequence[Place] = (), framed_by: Sequence[str] = ()) -> Any:
    """Return the explorer's server, an ASGI application.

    Parameters
    ----------
    limits : Limits
        Of the server as a whole; those of a single request are always `LIMITS`.
    others : sequence of Place
        The addresses that others can type, for the page to show.
    framed_by : sequence of str
        The origins of the sites that may show the page in a frame.

    Returns
    -------
    callable

    Examples
    --------
    >>> from stackbounce.explorer import LIMITS
    >>> app = create_app(LIMITS)
    """
    workers = Workers(limits)

    @contextlib.asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        workers.start()
        with tempfile.TemporaryDirectory(prefix="stackbounce-") as folder:
            app.state.papers = Papers(workers, Path(folder), limits.paper_seconds)
            try:
                yield
            finally:
                workers.stop()

    app = FastAPI(
        title="stackbounce",
        version=__version__,
        summary="What happens when a stack of balls hits the floor.",
        openapi_url="/api/openapi.json",
        docs_url=None,  # these pages load their scripts from elsewhere
        redoc_url=None,
        lifespan=lifespan,
        responses=_PROBLEMS,
    )
    app.add_middleware(GZipMiddleware, compresslevel=4)  # more saves a tenth, for twice the time
    add_guard(app, limits, others, framed_by)
    _add_errors(app)
    _add_jobs(app, workers, limits.job_seconds)

    @app.get("/api/places")
    async def list_places() -> dict[str, Any]:
        """List the addresses that other machines can type, with their QR codes."""
        return {"places": [place._asdict() for place in others]}

    _add_pages(app)
    return app


def _add_jobs(app: FastAPI, workers: Workers, seconds: float) -> None:
    """Add the addresses whose answers are computed by a worker process."""

    @contextlib.asynccontextmanager
    async def turn(request: Request) -> AsyncIterator[None]:
        """Wait for the turn of a request; give it up if its client has gone."""
        async with workers.turn(request.client.host if request.client else ""):
            if await request.is_disconnected():
                raise HTTPException(400, "the client has gone")
            yield

    async def compute(answer: Callable[..., str], *arguments: Any) -> Response:
        text = await workers.run(answer, *arguments, seconds=seconds)
        return Response(text, media_type="application/json")

    @app.post("/api/predict")
    async def predict_drop(request: Request, asked: schema.Uncertain) -> Response:
        """Carry the errors of a drop's numbers forward; return numbers and curves with errors."""
        async with turn(request):
            return await compute(predictions.predict_drop, asked.drop, asked.errors, asked.until)

    @app.post("/api/measure")
    async def measure_record(
        request: Request, file: UploadFile, options: _Options = None
    ) -> Response:
        """Recognise a file of measurements and analyse it."""
        async with turn(request):
            return await compute(records.measure_record, *await _read(file), options or {})

    @app.post("/api/fit")
    async def fit_record(
        request: Request,
        drop: Annotated[Json[schema.Scenario], Form()],
        vary: Annotated[Json[schema.Varied], Form()],
        measured: Annotated[Json[schema.Texts], Form()],
        options: _Options = None,
        file: UploadFile | None = None,
    ) -> Response:
        """Fit a drop to measured numbers, or to the forces of a file."""
        async with turn(request):
            record = ("", b"") if file is None else await _read(file)
            return await compute(records.fit_record, drop, vary, measured, *record, options or {})


async def _read(file: UploadFile) -> tuple[str, bytes]:
    """Return a file's name, as messages show it, and its content."""
    name = Path(file.filename or "").name
    shown = "".join(c if c.isprintable() else "?" for c in name)[:80]
    return shown or "the file", await file.read()


def _add_pages(app: FastAPI) -> None:
    """Add the paper's pages and, at every other address, the files of the page."""

    @app.get("/paper", include_in_schema=False)
    @app.get("/paper/{name:path}", include_in_schema=False)
    async def paper_page(request: Request, name: str = "") -> Response:
        papers: Papers = request.app.state.papers
        return await papers.page(name, request.scope)

    mimetypes.add_type("text/javascript", ".js")  # Windows may say text/plain: then none runs it
    files = StaticFiles(directory=FOLDER)

    @app.api_route("/{name:path}", methods=["GET", "HEAD"], include_in_schema=False)
    async def page_file(request: Request, name: str) -> Response:
        if name not in ("", PAGE, *PLAYING, *MEASURING):
            raise HTTPException(404)
        return await files.get_response(name or PAGE, request.scope)


def _add_errors(app: FastAPI) -> None:
    """Answer every error with one line that says what was wrong."""

    def problem(status: int, detail: str) -> JSONResponse:
        text = detail.encode("utf-8", "replace").decode()  # a lone surrogate cannot be sent
        headers = {"retry-after": str(AGAIN_SECONDS)} if status == 429 else None
        return JSONResponse({"detail": text}, status, headers)

    @app.exception_handler(RequestValidationError)
    async def invalid(_: Request, error: RequestValidationError) -> Response:
        return problem(422, schema.describe_error(error.errors()[0]))

    @app.exception_handler(StackbounceError)
    async def wrong(_: Request, error: StackbounceError) -> Response:
        return problem(429 if isinstance(error, Busy) else 422, str(error))

    @app.exception_handler(Exception)
    async def unexpected(_: Request, error: Exception) -> Response:
        return problem(500, f"unexpected {type(error).__name__}: please report it")
