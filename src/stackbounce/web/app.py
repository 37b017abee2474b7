"""The server's addresses: what is asked there, and which answer is computed."""

import contextlib
import json
import tempfile
from collections.abc import AsyncIterator
from pathlib import Path
from typing import Annotated, Any

from fastapi import FastAPI, File, Form, Request, UploadFile
from fastapi.exceptions import RequestValidationError
from fastapi.responses import FileResponse, JSONResponse, Response
from fastapi.staticfiles import StaticFiles

from stackbounce.errors import InvalidValue, StackbounceError, shown
from stackbounce.version import __version__
from stackbounce.web import schema
from stackbounce.web.answers import catalogue, exports, maps, play, records
from stackbounce.web.guard import Guard
from stackbounce.web.limits import Limits
from stackbounce.web.paper_pages import Papers
from stackbounce.web.worker_pool import Busy, TooLong, Workers

__all__ = ["create_app"]

_STATIC = Path(__file__).parent / "static"
_PROBLEMS: dict[int | str, dict[str, Any]] = {
    status: {"model": schema.Problem, "description": says}
    for status, says in {
        400: "The request cannot be read.",
        413: "The request is too large.",
        422: "A value makes no sense; the detail says which, and what would be right.",
        503: "Too much is asked for at once, or of one request; the detail says what.",
    }.items()
}
_EXPORTED: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "The file.",
        "content": {
            kind.partition(";")[0]: {"schema": {"type": "string", "format": "binary"}}
            for kind in exports.KINDS.values()
        },
    }
}
_ENDINGS = {"python": "py"}


def create_app(limits: Limits) -> Any:
    """Return the explorer's server, an ASGI application.

    Parameters
    ----------
    limits : Limits
        How much one request may ask for.

    Returns
    -------
    callable

    Examples
    --------
    >>> from stackbounce.web import LIMITS
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
    _add_errors(app)
    _add_answers(app, workers, limits)
    _add_records(app, workers, limits)
    _add_pages(app)
    return Guard(app, limits)


def _json(text: str) -> Response:
    return Response(text, media_type="application/json")


def _add_answers(app: FastAPI, workers: Workers, limits: Limits) -> None:
    """Add the addresses that take JSON."""
    seconds = limits.job_seconds

    @app.get("/api/status", response_model=schema.State)
    async def status() -> dict[str, Any]:
        """Tell whether the compiled kernels are there: the first start compiles them."""
        return {"stackbounce": __version__, "ready": workers.ready}

    @app.get("/api/catalogue", response_model=schema.Catalogue)
    async def balls_laws_and_cases() -> Response:
        """List the balls, the contact laws, the paper's cases, and the bounds of a request."""
        return _json(await workers.run(catalogue.catalogue, limits, seconds=seconds))

    @app.post("/api/stack", response_model=schema.CatalogueStack)
    async def stack(asked: schema.StackRequest) -> Response:
        """Put balls of the catalogue on top of each other."""
        job = (catalogue.stacked, asked.balls, asked.height)
        return _json(await workers.run(*job, seconds=seconds))

    @app.post("/api/law", response_model=schema.OneContact)
    async def law(asked: schema.MeasuredLaw) -> Response:
        """Find the constants of a law from restitution and contact time."""
        given = asked.model_dump(exclude={"law"}, exclude_none=True)
        return _json(await workers.run(catalogue.measured_law, asked.law, given, seconds=seconds))

    @app.post("/api/like", response_model=schema.OneContact)
    async def like(asked: schema.LikeLaw) -> Response:
        """Find another law with the restitution and contact time of this one."""
        numbers = asked.mass, asked.impact_speed, asked.restitution, asked.contact_time
        job = (catalogue.like, asked.contact, asked.to, *numbers)
        return _json(await workers.run(*job, seconds=seconds))

    @app.post("/api/simulate", response_model=schema.Simulation)
    async def simulate(asked: schema.Play) -> Response:
        """Drop a stack of balls: where everything is at each moment."""
        job = (play.simulation, asked.drop, asked.until, asked.frames, limits.events)
        return _json(await workers.run(*job, seconds=seconds))

    @app.post("/api/map", response_model=schema.Map)
    async def drop_map(asked: schema.MapRequest) -> Response:
        """Map a number of the outcome over two numbers of the drop."""
        points = asked.x.count * asked.y.count
        if points > limits.map_points:
            raise InvalidValue(
                f"x.count times y.count must be at most {limits.map_points}, got {points}"
            )
        x, y = (maps.Line(**side.model_dump()) for side in (asked.x, asked.y))
        job = (maps.drop_map, asked.drop, x, y, asked.show, limits.events)
        return _json(await workers.run(*job, seconds=seconds))

    @app.post("/api/map/paths", response_model=schema.Paths)
    async def map_paths(asked: schema.MapPaths) -> Response:
        """List what can vary over a map of this drop, and what it can show."""
        return _json(await workers.run(maps.map_paths, asked.drop, seconds=seconds))

    @app.post("/api/export/{kind}", response_class=Response, responses=_EXPORTED)
    async def export(kind: schema.ExportKind, asked: schema.Export) -> Response:
        """Write a drop to a file: its data, its picture, its scenario, or lines of Python."""
        job = (exports.exported, kind, asked.drop, asked.until, limits.events)
        content = await workers.run(*job, seconds=seconds)
        name = f"drop.{_ENDINGS.get(kind, kind)}"
        headers = {"content-disposition": f'attachment; filename="{name}"'}
        return Response(content, media_type=exports.KINDS[kind], headers=headers)


def _add_records(app: FastAPI, workers: Workers, limits: Limits) -> None:
    """Add the addresses that take a file."""

    @app.get("/api/measure/options", response_model=schema.MeasureOptions)
    async def measure_options() -> Response:
        """List the kinds of measurement, and the options that a file may need."""
        return _json(records.options())

    @app.post("/api/measure", response_model=schema.Measured)
    async def measure(
        file: Annotated[UploadFile, File()],
        options: Annotated[str, Form()] = "{}",
        alone: Annotated[UploadFile | None, File()] = None,
    ) -> Response:
        """Tell what a file of measurements is, and what is found in it."""
        other = None if alone is None else (_name(alone), await alone.read())
        known = _object("options", options)
        job = (records.measured, _name(file), await file.read(), known, other)
        return _json(await workers.run(*job, seconds=limits.fit_seconds))

    @app.post("/api/fit", response_model=schema.Fitted)
    async def fit(
        drop: Annotated[str, Form()],
        vary: Annotated[str, Form()],
        measured: Annotated[str, Form()] = "{}",
        file: Annotated[UploadFile | None, File()] = None,
        options: Annotated[str, Form()] = "{}",
    ) -> Response:
        """Fit a drop to what was measured: numbers with errors, or the forces of a file."""
        asked = schema.read_drop(_parsed("drop", drop))
        paths = _parsed("vary", vary)
        if not isinstance(paths, list) or not all(isinstance(path, str) for path in paths):
            raise InvalidValue(f"vary must be a list of paths, got {shown(vary)}")
        if not 0 < len(paths) <= limits.varied:
            raise InvalidValue(f"vary must have from 1 to {limits.varied} paths, got {len(paths)}")
        told = _object("measured", measured)
        if not all(isinstance(value, str) for value in told.values()):
            raise InvalidValue("measured must have texts such as '1.64 ± 0.02'")
        if not told:
            raise InvalidValue(
                "measured must name what was measured, such as "
                '{"rebound_ratios.1": "1.64 ± 0.02"}, got nothing'
            )
        content = b"" if file is None else await file.read()
        name = "" if file is None else _name(file)
        job = (records.fitted, asked, paths, told, name, content, _object("options", options))
        return _json(await workers.run(*job, seconds=limits.fit_seconds))


def _name(file: UploadFile) -> str:
    """Return a file's name as messages show it."""
    name = Path(file.filename or "").name
    return "".join(c if c.isprintable() else "?" for c in name)[:80] or "the file"


def _object(what: str, text: str) -> dict[str, Any]:
    value = _parsed(what, text)
    if not isinstance(value, dict):
        raise InvalidValue(f"{what} must be an object in JSON, got {shown(text)}")
    return value


def _parsed(what: str, text: str) -> Any:
    try:
        return json.loads(text)
    except (ValueError, RecursionError):
        raise InvalidValue(f"{what} must be JSON, got {shown(text)}") from None


def _add_pages(app: FastAPI) -> None:
    """Add the paper's pages and, at every other address, the files of the page."""

    @app.get("/paper", include_in_schema=False)
    @app.get("/paper/{name:path}", include_in_schema=False)
    async def paper_page(request: Request, name: str = "") -> Response:
        papers: Papers = request.app.state.papers
        return await papers.page(name)

    @app.get("/favicon.ico", include_in_schema=False)
    async def icon() -> Response:
        return FileResponse(_STATIC / "icon.svg")

    app.mount("/", StaticFiles(directory=_STATIC, html=True), name="static")


def _add_errors(app: FastAPI) -> None:
    """Say in one line what was wrong, whatever it was."""

    def problem(status: int, detail: str) -> JSONResponse:
        headers = {"retry-after": "5"} if status == 503 else None
        text = detail.encode("utf-8", "replace").decode()  # a lone surrogate cannot be sent
        return JSONResponse({"detail": text}, status, headers)

    @app.exception_handler(RequestValidationError)
    async def invalid(_: Request, error: RequestValidationError) -> Response:
        return problem(422, schema.told(error.errors()[0]))

    @app.exception_handler(StackbounceError)
    async def wrong(_: Request, error: StackbounceError) -> Response:
        return problem(503 if isinstance(error, Busy | TooLong) else 422, str(error))

    @app.exception_handler(Exception)
    async def unexpected(_: Request, error: Exception) -> Response:
        return problem(500, f"unexpected {type(error).__name__}: please report it")
