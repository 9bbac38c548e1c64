"""The server of a watched site: it answers this machine alone, and what it adds to pages is on no disk."""

import json
from collections.abc import Iterator
from http.client import HTTPConnection
from pathlib import Path
from threading import Thread
from urllib.parse import urlsplit

import pytest

from vicode.docsite.site_server import ReloadBroadcaster, SiteServer

POLICY = "default-src 'none'; script-src 'self' file:"
PAGE = f'<html><head><meta content="{POLICY}"></head><body>Hello</body></html>'


@pytest.fixture
def news() -> ReloadBroadcaster:
    return ReloadBroadcaster()


@pytest.fixture
def server(tmp_path: Path, news: ReloadBroadcaster) -> Iterator[SiteServer]:
    site = tmp_path / "site"
    (site / "inner").mkdir(parents=True)
    for place in (site, site / "inner", tmp_path):
        (place / "index.html").write_text(PAGE.replace("Hello", place.name), "utf-8")
    (site / "site.css").write_text("a {}", "utf-8")
    (site / "notes.txt").write_text("private", "utf-8")
    (site / "out.html").symlink_to(tmp_path / "index.html")
    with SiteServer(site, news) as running:
        yield running


def ask(server: SiteServer, path: str, host: str = "") -> tuple[int, str, dict[str, str]]:
    address = urlsplit(server.url)
    assert address.hostname == "127.0.0.1"
    connection = HTTPConnection("127.0.0.1", address.port or 0, timeout=10)
    connection.request("GET", path, headers={"Host": host or address.netloc})
    answer = connection.getresponse()
    text = answer.read().decode()
    connection.close()
    return answer.status, text, {name.lower(): value for name, value in answer.getheaders()}


def test_a_page_gets_what_reloads_it_on_its_way(server: SiteServer, news: ReloadBroadcaster, tmp_path: Path) -> None:
    status, text, headers = ask(server, "/")
    assert (status, headers["content-type"]) == (200, "text/html; charset=utf-8")
    assert f'<script src="/-/live_reload.js" data-build="{news.build_id}" defer></script>' in text
    assert POLICY in text
    assert (tmp_path / "site" / "index.html").read_text("utf-8") == PAGE.replace("Hello", "site")
    assert "inner" in ask(server, "/inner/")[1]
    assert ask(server, "/site.css")[1] == "a {}"
    assert "EventSource" in ask(server, "/-/live_reload.js")[1]
    assert ".build-errors" in ask(server, "/-/live_reload.css")[1]


@pytest.mark.parametrize("host", ["evil.example", "127.0.0.1", "127.0.0.1:1", "localhost.evil.example"])
def test_who_was_led_here_by_another_name_is_told_nothing(server: SiteServer, host: str) -> None:
    for path in ("/", "/site.css", "/-/events", "/-/live_reload.js"):
        status, text, _headers = ask(server, path, host)
        assert status == 403
        assert "Hello" not in text
    assert ask(server, "/", f"localhost:{urlsplit(server.url).port}")[0] == 200


@pytest.mark.parametrize(
    "path",
    [
        "/../index.html",
        "/%2e%2e/index.html",
        "/inner/..%2f..%2findex.html",
        "//etc/passwd",
        "/notes.txt",
        "/out.html",
        "/inner",
        "/nothing.html",
        "/-/../index.html",
        "/-/site.js",
        "/a%00b.html",
    ],
)
def test_nothing_but_the_site_is_shown(server: SiteServer, path: str, tmp_path: Path) -> None:
    status, text, _headers = ask(server, path)
    assert status == 404
    assert "<h1>Page not found</h1>" in text or path.startswith("/-/")
    assert tmp_path.name not in text
    assert "private" not in text


def test_a_page_hears_of_what_changed_after_it_was_sent(server: SiteServer, news: ReloadBroadcaster) -> None:
    news.publish(["early.html"], "")
    build = news.build_id
    heard: list[object] = []
    address = urlsplit(server.url)
    connection = HTTPConnection("127.0.0.1", address.port or 0, timeout=20)
    connection.request("GET", f"/-/events?since={build}", headers={"Host": address.netloc})
    answer = connection.getresponse()

    def listen() -> None:
        while len(heard) < 3:
            line = answer.readline().decode()
            if line.startswith("data: "):
                heard.append(json.loads(line.removeprefix("data: ")))

    assert answer.getheader("Content-Type") == "text/event-stream"
    listener = Thread(target=listen)
    first = answer.readline().decode()
    assert json.loads(first.removeprefix("data: ")) == {"changed": [], "errors": ""}
    listener.start()
    news.publish(["late.html", "site.css"], "")
    news.publish([], "player.yaml:5: <error>")
    listener.join(timeout=20)
    connection.close()
    assert {"changed": ["late.html", "site.css"], "errors": "player.yaml:5: <error>"} in heard


def test_a_page_of_a_server_that_ended_has_all_to_hear(news: ReloadBroadcaster) -> None:
    news.publish(["one.html"], "")
    assert json.loads(news.message_since(f"{'0' * 8}.1"))["changed"] == ["*"]
    for strange in ("", "x", ".", f"{news.build_id.split('.')[0]}.x", f"{news.build_id.split('.')[0]}.-1"):
        assert json.loads(news.message_since(strange))["changed"] == ["*"]
