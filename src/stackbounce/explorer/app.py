"""The server's addresses: the request that each takes, and the function that computes its answer.

An address that takes and returns JSON is a line of `ROUTES`. Files need functions of their own.
"""

import contextlib
import functools
import inspect
import json
import tempfile
from collections.abc import AsyncIterator, Callable, Sequence
from pathlib import Path
from typing import Annotated, Any, NamedTuple

from fastapi import FastAPI, File, Form, HTTPException, Request, UploadFile
from fastapi.exceptions import RequestValidationError
from fastapi.responses import FileResponse, JSONResponse, Response
from fastapi.staticfiles import StaticFiles
from pydantic import BaseModel

from stackbounce.errors import InvalidValue, StackbounceError, shown
from stackbounce.explorer import schema
from stackbounce.explorer.addresses import Place
from stackbounce.explorer.answers import catalogue, exports, maps, play, predictions, records
from stackbounce.explorer.guard import Guard
from stackbounce.explorer.limits import LIMITS, Limits
from stackbounce.explorer.page.parts import KINDS, made_file
from stackbounce.explorer.paper_pages import Papers
from stackbounce.explorer.shares import AGAIN_SECONDS, Busy, client_of
from stackbounce.explorer.worker_pool import Workers
from stackbounce.version import __version__

__all__ = ["ROUTES", "Route", "create_app"]

_STATIC = Path(__file__).parent / "static"
_PROBLEMS: dict[int | str, dict[str, Any]] = {
    status: {"model": schema.Problem, "description": says}
    for status, says in {
        400: "The request cannot be read.",
        413: "The request is too large.",
        422: "A value makes no sense, or one request asks for too much; the detail says which.",
        429: "This client asks for too much at once; the detail says when to try again.",
        503: "All clients ask for too much at once; the detail says when to try again.",
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
_LEVELS = 8  # of lists and objects in each other
_PLAIN = (str, int, float, bool, type(None))


def _is_short(_: schema.Request) -> bool:
    return True


def _is_long(_: schema.Request) -> bool:
    return False


class Route(NamedTuple):
    """An address that takes JSON and returns JSON, computed by a worker process."""

    path: str
    compute: Callable[..., str]
    request: type[schema.Request]
    answer: type[BaseModel]
    is_short: Callable[[Any], bool] = _is_short
    """Whether a request should take less than a second."""


def _is_short_map(asked: schema.MapRequest) -> bool:
    return asked.x.count * asked.y.count * len(asked.drop.balls) ** 2 <= LIMITS.short_map


ROUTES = (
    Route("/api/stack", catalogue.stack_balls, schema.StackRequest, schema.CatalogueStack),
    Route("/api/law", catalogue.calibrate_law, schema.MeasuredLaw, schema.OneContact),
    Route("/api/like", catalogue.convert_law, schema.LikeLaw, schema.OneContact),
    Route("/api/simulate", play.play_drop, schema.Play, schema.Simulation),
    Route("/api/predict", predictions.predict_drop, schema.Uncertain, schema.Predicted, _is_long),
    Route("/api/map", maps.map_drop, schema.MapRequest, schema.Map, _is_short_map),
    Route("/api/map/paths", maps.list_paths, schema.MapPaths, schema.Paths),
)
"""All addresses that take and return JSON; a new one is a line here."""


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
    _add_errors(app)
    for route in ROUTES:
        _add_route(app, workers, route)
    _add_queries(app, workers, limits, others)
    _add_files(app, workers)
    _add_pages(app)
    return Guard(app, limits, framed_by)


def _json(text: str) -> Response:
    return Response(text, media_type="application/json")


def _add_route(app: FastAPI, workers: Workers, route: Route) -> None:
    """Add a route: the request's fields are the keywords of its answer function."""

    async def respond(request: Request, asked: Any) -> Response:
        job = functools.partial(route.compute, **dict(asked))
        seconds, client, short = LIMITS.job_seconds, client_of(request), route.is_short(asked)
        return _json(await workers.run(job, seconds=seconds, client=client, short=short))

    respond.__annotations__["asked"] = route.request
    app.post(
        route.path,
        response_model=route.answer,
        name=route.compute.__name__,
        description=inspect.cleandoc(route.compute.__doc__ or "").partition("\n")[0],
    )(respond)


def _add_queries(app: FastAPI, workers: Workers, limits: Limits, others: Sequence[Place]) -> None:
    """Add the addresses that take no arguments."""

    @app.get("/api/status", response_model=schema.State)
    async def read_status() -> dict[str, Any]:
        """Tell that the server runs, and its version."""
        return {"stackbounce": __version__}

    @app.get("/api/catalogue", response_model=schema.Catalogue)
    async def list_choices(request: Request) -> Response:
        """List the balls, the contact laws, the paper's cases, and the limits of a request."""
        job = functools.partial(catalogue.list_choices, limits)
        seconds, client = LIMITS.job_seconds, client_of(request)
        return _json(await workers.run(job, seconds=seconds, client=client, short=True))

    @app.get("/api/places", response_model=schema.Places)
    async def list_places() -> dict[str, Any]:
        """List the addresses that other machines can type, with their QR codes."""
        return {"places": [one._asdict() for one in others]}

    @app.get("/api/measure/options", response_model=schema.MeasureOptions)
    async def list_options() -> Response:
        """List the kinds of measurement and the options of the page's form."""
        return _json(records.list_options())


def _add_files(app: FastAPI, workers: Workers) -> None:
    """Add the addresses that take or return a file."""

    @app.post("/api/export/{kind}", response_class=Response, responses=_EXPORTED)
    async def export_drop(
        request: Request, kind: schema.ExportKind, asked: schema.Export
    ) -> Response:
        """Export a drop as a file: its data, its picture, its scenario, or lines of Python."""
        given = asked.drop, asked.until, asked.errors
        job = functools.partial(exports.export_drop, kind, *given)
        seconds, client = LIMITS.job_seconds, client_of(request)
        content = await workers.run(job, seconds=seconds, client=client, short=True)
        name = f"drop.{_ENDINGS.get(kind, kind)}"
        headers = {"content-disposition": f'attachment; filename="{name}"'}
        return Response(content, media_type=exports.KINDS[kind], headers=headers)

    @app.post("/api/measure", response_model=schema.Measured)
    async def measure_record(
        request: Request,
        file: Annotated[UploadFile, File()],
        options: Annotated[str, Form()] = "{}",
        alone: Annotated[UploadFile | None, File()] = None,
    ) -> Response:
        """Recognise a file of measurements and analyse it."""
        other = None if alone is None else (_name(alone), await alone.read())
        known = _parse_object("options", options)
        job = (records.measure_record, _name(file), await file.read(), known, other)
        client = client_of(request)
        return _json(await workers.run(*job, seconds=LIMITS.fit_seconds, client=client))

    @app.post("/api/fit", response_model=schema.Fitted)
    async def fit_record(
        request: Request,
        drop: Annotated[str, Form()],
        vary: Annotated[str, Form()],
        measured: Annotated[str, Form()] = "{}",
        file: Annotated[UploadFile | None, File()] = None,
        options: Annotated[str, Form()] = "{}",
    ) -> Response:
        """Fit a drop to measured numbers, or to the forces of a file."""
        asked = schema.read_drop(_parse("drop", drop))
        paths = _parse("vary", vary)
        if not isinstance(paths, list) or not all(isinstance(path, str) for path in paths):
            raise InvalidValue(f"vary must be a list of paths, got {shown(vary)}")
        if not 0 < len(paths) <= LIMITS.varied:
            raise InvalidValue(f"vary must have from 1 to {LIMITS.varied} paths, got {len(paths)}")
        values = _parse_object("measured", measured)
        if not all(isinstance(value, str) for value in values.values()):
            raise InvalidValue("measured must have texts such as '1.64 ± 0.02'")
        if not values:
            raise InvalidValue(
                "measured must name what was measured, such as "
                '{"rebound_ratios.1": "1.64 ± 0.02"}, got nothing'
            )
        content = b"" if file is None else await file.read()
        name = "" if file is None else _name(file)
        known = _parse_object("options", options)
        job = (records.fit_record, asked, paths, values, name, content, known)
        client = client_of(request)
        return _json(await workers.run(*job, seconds=LIMITS.fit_seconds, client=client))


def _name(file: UploadFile) -> str:
    """Return a file's name as messages show it."""
    name = Path(file.filename or "").name
    return "".join(c if c.isprintable() else "?" for c in name)[:80] or "the file"


def _parse_object(what: str, text: str) -> dict[str, Any]:
    value = _parse(what, text)
    if not isinstance(value, dict):
        raise InvalidValue(f"{what} must be an object in JSON, got {shown(text)}")
    return value


def _parse(what: str, text: str) -> Any:
    try:
        value = json.loads(text)
    except (ValueError, RecursionError):
        raise InvalidValue(f"{what} must be JSON, got {shown(text)}") from None
    parts = [value]
    for _ in range(_LEVELS):
        lists = (one.values() if isinstance(one, dict) else one for one in parts)
        parts = [part for one in lists if not isinstance(one, _PLAIN) for part in one]
    if parts:
        raise InvalidValue(f"{what} must be JSON of at most {_LEVELS} levels, got {shown(text)}")
    return value


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

    @app.get("/made/{name}", include_in_schema=False)
    def made(name: str) -> Response:
        if name not in KINDS:
            raise HTTPException(404)
        return Response(made_file(name), media_type=KINDS[name])

    app.mount("/", StaticFiles(directory=_STATIC, html=True), name="static")


def _add_errors(app: FastAPI) -> None:
    """Answer every error with one line that says what was wrong."""

    def problem(status: int, detail: str) -> JSONResponse:
        text = detail.encode("utf-8", "replace").decode()  # a lone surrogate cannot be sent
        headers = {"retry-after": str(AGAIN_SECONDS)} if status in (429, 503) else None
        return JSONResponse({"detail": text}, status, headers)

    @app.exception_handler(RequestValidationError)
    async def invalid(_: Request, error: RequestValidationError) -> Response:
        return problem(422, schema.describe_error(error.errors()[0]))

    @app.exception_handler(StackbounceError)
    async def wrong(_: Request, error: StackbounceError) -> Response:
        return problem(error.status if isinstance(error, Busy) else 422, str(error))

    @app.exception_handler(Exception)
    async def unexpected(_: Request, error: Exception) -> Response:
        return problem(500, f"unexpected {type(error).__name__}: please report it")
