import socket
from contextlib import closing, nullcontext

import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect
from windows import ask, token_of

from pointchart import InputError, read_scan
from pointchart.app import guard
from pointchart.app.browser_app import open_page


@pytest.mark.parametrize(
    "path", ["/", "/wrong/", "/{}x/", "//{}/", "/?token={}", "/%2e/{}/", "//[", "/{}?a=1", "/{}/?a=1"]
)
def test_without_its_token_alone_the_page_is_refused_with_a_sentence(page, path):
    status, body, _ = ask(page, path.format(token_of(page)))
    assert (status, body) == (403, f"{guard.REFUSED}\n")


def test_the_token_opens_the_page_and_no_cookie_tells_it_to_other_servers_of_this_machine(page):
    status, body, answer = ask(page, f"/{token_of(page)}/")
    assert (status, "<html" in body) == (200, True)
    assert "frame-ancestors 'none'" in answer.getheader("Content-Security-Policy")
    assert answer.getheader("Referrer-Policy") == "no-referrer"
    assert answer.getheader("Set-Cookie") is None
    assert ask(page, "/", Cookie=f"token={token_of(page)}")[0] == 403
    assert ask(page, f"/{token_of(page)}/none")[0] == 404
    assert ask(page, f"/{token_of(page)}/..%2f..%2fetc%2fpasswd")[0] == 404


def test_the_address_that_a_browser_is_started_with_opens_the_page_once(bare):
    """All users of a machine see the words of its processes."""
    entry = bare.entrance.removeprefix(f"http://127.0.0.1:{bare.server.get_port()}")
    assert token_of(bare) not in entry
    assert ask(bare, entry, Origin="http://evil.example")[0] == 403
    assert ask(bare, f"{entry}index.html")[0] == 403
    status, _, answer = ask(bare, entry)
    assert (status, answer.getheader("Location")) == (302, f"/{token_of(bare)}/")
    assert ask(bare, entry)[0] == 403
    assert ask(bare, f"/{token_of(bare)}/")[0] == 200


def test_the_address_that_a_browser_is_started_with_is_soon_closed(scan_file, monkeypatch):
    monkeypatch.setattr(guard, "ENTRY_SECONDS", 0.0)
    with closing(open_page(scan_file, read_scan(scan_file))) as page:
        assert ask(page, page.entrance.partition(f":{page.server.get_port()}")[2])[0] == 403


def test_a_recording_that_someone_else_has_written_is_not_played(page):
    """Viser plays what its address names, scripts included: an address with more than the token is refused."""
    assert ask(page, f"/{token_of(page)}/?playbackPath=data:application/octet-stream;base64,AAAA")[0] == 403
    policy = ask(page, f"/{token_of(page)}/")[2].getheader("Content-Security-Policy")
    (connects,) = [part for part in policy.split("; ") if part.startswith("connect-src")]
    assert not {"blob:", "http:", "https:", "*"} & set(connects.split())


@pytest.mark.parametrize("host", ["evil.example", "evil.example:{}", "127.0.0.1", "127.0.0.1:1"])
def test_another_name_for_this_machine_is_refused(page, host):
    assert ask(page, f"/{token_of(page)}/", Host=host.format(page.server.get_port()))[0] == 403


def test_another_origin_is_refused_even_with_the_token(page):
    path = f"/{token_of(page)}/"
    assert ask(page, path, Origin="http://evil.example")[0] == 403
    assert ask(page, path, Origin="null")[0] == 403


@pytest.mark.parametrize("origin", ["http://evil.example", "http://localhost:{}", "https://127.0.0.1:{}", None])
def test_a_websocket_of_another_origin_or_none_is_refused(page, origin):
    port = page.server.get_port()
    with (
        pytest.raises(InvalidStatus) as refused,
        connect(f"ws://127.0.0.1:{port}/{token_of(page)}", origin=origin and origin.format(port)),
    ):
        pass
    assert refused.value.response.status_code == 403


def test_a_websocket_needs_the_token_and_opens_with_it(page):
    port = page.server.get_port()
    own = {"origin": f"http://127.0.0.1:{port}", "subprotocols": ["viser-v0"]}
    for path in ("", "/", "/wrong"):
        with pytest.raises(InvalidStatus), connect(f"ws://127.0.0.1:{port}{path}", **own):
            pass
    with connect(f"ws://127.0.0.1:{port}/{token_of(page)}", **own) as opened:
        assert opened.response.status_code == 101


def test_the_server_listens_on_loopback_only(page):
    assert page.server.get_host() == "127.0.0.1"
    with pytest.raises(ConnectionRefusedError):
        socket.create_connection(("127.0.0.2", page.server.get_port()), timeout=5).close()


def test_a_server_that_answers_without_the_token_is_stopped_at_once(monkeypatch):
    monkeypatch.setattr(guard, "_guarding", lambda *_: nullcontext())
    with pytest.raises(InputError, match="answers without the token of the page, so it is not started"):
        guard.start_server("secret", "entry")
