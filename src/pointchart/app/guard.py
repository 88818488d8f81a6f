"""The door of the page: loopback only, a token in its address, and no other origin."""

import io
import secrets
import time
from collections.abc import Awaitable, Callable, Iterator
from contextlib import contextmanager, redirect_stdout
from dataclasses import replace
from http import HTTPStatus
from http.client import HTTPConnection
from inspect import isawaitable
from typing import Any

import viser
import websockets.asyncio.server as sockets
from websockets.asyncio.server import ServerConnection
from websockets.datastructures import Headers
from websockets.http11 import Request, Response

from ..errors import InputError

HOST = "127.0.0.1"  # loopback: no other machine gets through
ENTRY_SECONDS = 60.0  # for a browser to start in; after that, the word that it was started with opens nothing
# Says what to do, and nothing of what was wrong with the request.
REFUSED = "this page opens only by the address that pointchart printed in the terminal, which carries a token"
# Headers by which the address, and so the token, stays in this browser: no page is told it, none may frame this one.
KEPT_IN = {
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "Cache-Control": "no-store",
    "Content-Security-Policy": "default-src 'self' 'unsafe-inline' 'unsafe-eval' data: blob:; frame-ancestors 'none'; "
    "connect-src 'self' data: ws://127.0.0.1:{port} ws://localhost:{port}",
}

Answer = Callable[[ServerConnection, Request], Response | Awaitable[Response | None] | None]


class LocalServer(viser.ViserServer):
    """A server whose page cannot be shared: a tunnel would show it to the world."""

    def request_share_url(self, verbose: bool = True) -> None:
        """Share nothing."""


def start_server(token: str, entry: str) -> LocalServer:
    """Start a guarded server on a free port of this machine's own address.

    Parameters
    ----------
    token : str
        Without it, nothing is answered.
    entry : str
        Stands for the token once within `ENTRY_SECONDS`, so that who starts a browser need not name it: all users see
        the words of a process. One who is faster than the browser gets in; then the browser is refused, which is seen.

    Returns
    -------
    LocalServer

    Raises
    ------
    InputError
        If the server would answer without the token: then viser has changed and is stopped.
    """
    with redirect_stdout(io.StringIO()), _guarding(token, entry):
        server = LocalServer(HOST, 0, label="pointchart", verbose=False)
    port = server.get_port()
    if not all(_is_refused(port, headers) for headers in ({}, _upgrade(port))):
        stop_server(server)
        raise InputError(
            f"viser {viser.__version__} answers without the token of the page, so it is not started; "
            "take another version: pip install 'viser==1.1.1'"
        )
    return server


def stop_server(server: LocalServer) -> None:
    """Stop a server without a word."""
    with redirect_stdout(io.StringIO()):
        server.stop()


def address(server: LocalServer, token: str) -> str:
    """Return the address that opens the page."""
    return f"http://{HOST}:{server.get_port()}/{token}/"


def path_within(path: str, headers: Headers, token: str, port: int) -> str | None:
    """Return the path behind the token, if a request has it and comes by the right name, from our own page or none.

    The token is the first part of the path: a cookie would be sent to every other server of this machine. Whoever has
    it asks for nothing more: words behind a question mark, with which viser would fetch and run what others have
    written, are refused.

    Parameters
    ----------
    path : str
    headers : Headers
        A foreign `Host` is a name that was made to point here; a websocket has to name its `Origin`.
    token : str
    port : int

    Returns
    -------
    str or None
        None for a request that is refused.

    Examples
    --------
    >>> mine = Headers(Host="127.0.0.1:8000")
    >>> path_within("/secret/a.js", mine, "secret", 8000), path_within("/other/", mine, "secret", 8000)
    ('/a.js', None)
    >>> path_within("/secret/", Headers(Host="evil.example:8000"), "secret", 8000)
    """
    hosts, origins = headers.get_all("Host"), headers.get_all("Origin")
    if len(hosts) != 1 or hosts[0] not in (f"{HOST}:{port}", f"localhost:{port}"):
        return None
    is_socket = bool(headers.get_all("Upgrade"))
    if any(origin != f"http://{hosts[0]}" for origin in origins) or (is_socket and len(origins) != 1):
        return None
    start, given, rest = (*path.split("/", 2), "", "")[:3]
    is_ours = secrets.compare_digest(given.encode("utf-8", "surrogateescape"), token.encode())
    return f"/{rest}" if is_ours and start == "" and "?" not in rest else None


@contextmanager
def _guarding(token: str, entry: str) -> Iterator[None]:
    """Have every request of the servers that start in the body pass the guard before it is answered."""
    serve, entries = sockets.serve, {entry: time.monotonic() + ENTRY_SECONDS}

    def guarded(*arguments: Any, process_request: Answer | None = None, **options: Any) -> Any:
        return serve(*arguments, process_request=_guard(token, entries, process_request), **options)

    sockets.serve = guarded  # type: ignore[assignment, misc]
    try:
        yield
    finally:
        sockets.serve = serve  # type: ignore[misc]


def _guard(token: str, entries: dict[str, float], answer: Answer | None) -> Answer:
    async def check(connection: ServerConnection, request: Request) -> Response | None:
        port = connection.local_address[1]
        path = path_within(request.path, request.headers, token, port)
        for entry, end in list(entries.items()):
            if path_within(request.path, request.headers, entry, port) == "/" and time.monotonic() < end:
                del entries[entry]
                opened = connection.respond(HTTPStatus.FOUND, "")
                opened.headers["Location"] = f"/{token}/"
                return opened
        if path is None:
            return connection.respond(HTTPStatus.FORBIDDEN, f"{REFUSED}\n")
        given = None if answer is None else answer(connection, replace(request, path=path))
        response = await given if isawaitable(given) else given
        if response is not None:
            for name, value in KEPT_IN.items():
                response.headers[name] = value.format(port=port)
        return response

    return check


def _upgrade(port: int) -> dict[str, str]:
    return {
        "Connection": "Upgrade",
        "Upgrade": "websocket",
        "Origin": f"http://{HOST}:{port}",
        "Sec-WebSocket-Key": "AAAAAAAAAAAAAAAAAAAAAA==",
        "Sec-WebSocket-Version": "13",
    }


def _is_refused(port: int, headers: dict[str, str]) -> bool:
    connection = HTTPConnection(HOST, port, timeout=10)
    try:
        connection.request("GET", "/", headers=headers)
        return connection.getresponse().status == HTTPStatus.FORBIDDEN
    finally:
        connection.close()
