"""The address as a web terminal makes it clickable: in a page of another site, and without its last slash."""

from __future__ import annotations

import http.server
import threading
from collections.abc import Iterator
from typing import Any

import pytest

CLICKABLE = '<a id="here" href="{0}">same tab</a> <a id="new" href="{0}" target="_blank" rel="noopener">new tab</a>'
FRAMED = '<iframe src="{0}"></iframe><img src="{0}icon.svg"><script src="{0}api.js"></script>'


class _Terminal(http.server.BaseHTTPRequestHandler):
    text = ""

    def do_GET(self) -> None:
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.end_headers()
        self.wfile.write(self.text.encode())

    def log_message(self, *args: Any) -> None:
        pass


@pytest.fixture
def terminal() -> Iterator[str]:
    """Address of a page on another port, without the name; what it says is `_Terminal.text`."""
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), _Terminal) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        yield f":{server.server_port}/"
        server.shutdown()
        thread.join()


@pytest.mark.slow
@pytest.mark.parametrize(("name", "slash"), [("localhost", ""), ("127.0.0.1", "/")], ids=["cross-site", "same-site"])
def test_the_address_can_be_clicked_in_a_page_elsewhere(
    browser: Any, address: str, terminal: str, monkeypatch: pytest.MonkeyPatch, name: str, slash: str
) -> None:
    monkeypatch.setattr(_Terminal, "text", CLICKABLE.format(address.rstrip("/") + slash))
    context = browser.new_context()
    try:
        page = context.new_page()
        page.goto(f"http://{name}{terminal}")
        with context.expect_page() as opened:
            page.locator("#new").click()
        page.locator("#here").click()
        for studio in (page, opened.value):
            studio.locator("body[data-ready=yes]").wait_for()
            assert studio.url.startswith(f"{address}#")
        page.reload()
        page.locator("body[data-ready=yes]").wait_for()
    finally:
        context.close()


@pytest.mark.slow
def test_a_page_elsewhere_can_still_not_use_what_it_knows_the_address_of(
    browser: Any, address: str, terminal: str, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr(_Terminal, "text", FRAMED.format(address))
    context = browser.new_context()
    try:
        page = context.new_page()
        page.goto(f"http://localhost{terminal}", wait_until="load")
        fetched = page.evaluate(f"fetch('{address}api/studio').then(() => 'came in', () => 'refused')")
        assert fetched == "refused"
        assert [record.message[:21] for record in caplog.records] == ["refused http with 403"] * 4
    finally:
        context.close()
