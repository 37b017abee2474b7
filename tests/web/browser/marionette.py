"""Firefox, driven by its own remote protocol, Marionette: JSON over a socket."""

import contextlib
import json
import shutil
import socket
import subprocess
import time

NAMES = ("firefox-esr", "firefox")
START = 60.0  # s

__all__ = ["NAMES", "Firefox", "firefox"]


class Firefox:
    """A session of a running Firefox."""

    def __init__(self, stream):
        self._stream, self._count = stream, 0
        self._receive()  # what it is
        self._send("WebDriver:NewSession", {})

    def open(self, address):
        self._send("WebDriver:Navigate", {"url": "about:blank"})
        self._send("WebDriver:Navigate", {"url": address})

    def run(self, script, *given):
        """Return what a function's body returns; a promise is awaited."""
        asked = {"script": script, "args": list(given), "sandbox": None}
        return self._send("WebDriver:ExecuteScript", asked)["value"]

    def wait(self, script, seconds=30.0):
        """Wait until an expression is true."""
        end = time.monotonic() + seconds
        while not self.run(f"return Boolean({script})"):
            assert time.monotonic() < end, script
            time.sleep(0.05)

    def _send(self, name, given):
        self._count += 1
        text = json.dumps([0, self._count, name, given]).encode()
        self._stream.sendall(b"%d:%s" % (len(text), text))
        _, _, error, answer = self._receive()
        assert error is None, error
        return answer

    def _receive(self):
        size = b""
        while not size.endswith(b":"):
            size += self._stream.recv(1)
        left, parts = int(size[:-1]), []
        while left:
            parts.append(self._stream.recv(left))
            left -= len(parts[-1])
        return json.loads(b"".join(parts))


@contextlib.contextmanager
def firefox(folder):
    """Start Firefox without a window, with a new profile in a folder; yield a session, or None."""
    path = next(filter(None, map(shutil.which, NAMES)), None)
    if path is None:
        yield None
        return
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    (folder / "user.js").write_text(f'user_pref("marionette.port", {port});\n')
    command = [path, "--headless", "--marionette", "--profile", folder]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        try:
            with _connected(port) as stream:
                yield Firefox(stream)
        finally:
            process.terminate()


def _connected(port):
    end = time.monotonic() + START
    while True:
        try:
            return socket.create_connection(("127.0.0.1", port), timeout=START)
        except OSError:
            if time.monotonic() > end:
                raise
            time.sleep(0.1)
