"""Running the programs: each in a process of its own, with a time limit for each problem.

A program that crashes or takes too long costs that problem only: its process is ended, and a new
one goes on with the next problem.
"""

import multiprocessing
from collections.abc import Callable, Iterator, Sequence
from multiprocessing.connection import Connection
from time import perf_counter
from typing import Any

from benchmarks.peers.impacts.common import Answer, Peer, Problem, Unsupported

STARTING = 120.0  # s, for imports


def serve(peer: Peer, pipe: Connection) -> None:
    """Answer the problems that come through a pipe; this is what the process does."""
    solve = peer.prepare()
    pipe.send({})
    while True:
        problem = pipe.recv()
        begin = perf_counter()
        try:
            answer = solve(problem)
        except Unsupported as error:
            answer = {"unsupported": str(error)}
        except Exception as error:  # whatever goes wrong there is told in the table
            answer = {"failed": f"{type(error).__name__}: {error}".splitlines()[0]}
        pipe.send({**answer, "seconds": perf_counter() - begin})


class Process:
    """A process that runs a program, started when it is needed."""

    def __init__(self, peer: Peer) -> None:
        self.peer = peer
        self.process: Any = None
        self.pipe: Any = None

    def ask(self, problem: Problem, limit: float) -> Answer:
        """Return the answer, or that it failed."""
        try:
            if self.process is None:
                self._start()
            self.pipe.send(problem)
            return self._receive(limit)
        except TimeoutError:
            self.end()
            return {"failed": f"not done after {limit:g} s"}
        except (EOFError, OSError):
            self.end()
            return {"failed": "the process died"}

    def _start(self) -> None:
        context = multiprocessing.get_context("spawn")
        self.pipe, other = context.Pipe()
        self.process = context.Process(target=serve, args=(self.peer, other), daemon=True)
        self.process.start()
        other.close()
        self._receive(STARTING)

    def _receive(self, limit: float) -> Answer:
        if not self.pipe.poll(limit):
            raise TimeoutError
        return self.pipe.recv()

    def end(self) -> None:
        """End the process."""
        if self.process is not None:
            self.process.kill()
            self.process.join()
            self.pipe.close()
            self.process = None


def answers(
    peer: Peer,
    problems: Sequence[Problem],
    limit: float,
    progress: Callable[[str], None],
) -> Iterator[Answer]:
    """Yield a program's answer to each problem, with its name and the time in s that it took."""
    process = Process(peer)
    try:
        for problem in problems:
            progress(f"{peer.name}: {problem['name']}")
            yield {"name": problem["name"], **process.ask(problem, limit)}
    finally:
        process.end()
