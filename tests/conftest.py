"""What all tests share: hypothesis profiles, `--accept` for golden files, and a real Chromium that must stay quiet."""

import gc
import os
import shutil
import signal
import socket
from collections import Counter
from collections.abc import Generator, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, settings
from playwright.sync_api import Browser, BrowserContext, ConsoleMessage, Error, Page, Playwright, sync_playwright

from tests.file_scheduling import pytest_xdist_make_scheduler  # noqa: F401

CHROMIUM_NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
CHROMIUM_ARGUMENTS = (
    "--no-sandbox",
    "--disable-dev-shm-usage",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)

# The same examples on every run, so that the test command says the same of the same code; the nightly run looks
# for new ones. Written out in full, since on a build machine hypothesis starts from a profile of its own.
_BOUNDED = settings(
    parent=settings.get_profile("default"),
    deadline=None,
    derandomize=True,
    database=None,
    max_examples=40,
    print_blob=True,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.register_profile("bounded", _BOUNDED)
settings.register_profile("nightly", _BOUNDED, max_examples=2000, derandomize=False)
settings.load_profile(os.environ.get("VICODE_HYPOTHESIS", "bounded"))


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option that rewrites golden files."""
    parser.addoption("--accept", action="store_true", help="rewrite the expected files of golden tests")


@pytest.hookimpl(trylast=True)
def pytest_configure(config: pytest.Config) -> None:
    """Prepare the process of the tests."""
    _accept_interrupts()
    _send_results_at_once(config)


def _accept_interrupts() -> None:
    """`make test &` ignores SIGINT, and so would all processes that tests start and interrupt."""
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _send_results_at_once(config: pytest.Config) -> None:
    """Let pytest-rerunfailures (16.7) send its two messages per test at once; otherwise each test waits 40 ms.

    It writes twice before it reads, so the second write waits for the delayed acknowledgment of the first.
    """
    connection = getattr(getattr(config, "failures_db", None), "sock", None)
    if connection is not None:
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark what needs Chromium, before `-m` selects, so that nobody can forget the mark; and run it last.

    While Playwright's synchronous API is open, no other test of the process may call asyncio.run. Among the files with
    browser tests, those with most tests start first, so that the workers end at about the same time.

    A person tries again when the machine was asleep for a second; so do we, once, and it is told. Browsers are not
    alone in this: tests start processes, send signals and wait for sockets. The nightly run, which asks whether a test
    ever fails, gives no second try.
    """
    has_second_try = "VICODE_ONE_TRY" not in os.environ
    sizes: Counter[Path] = Counter()
    for item in items:
        if "chromium" in getattr(item, "fixturenames", ()):
            sizes[item.path] += 1
            item.add_marker(pytest.mark.browser)
        if has_second_try:
            item.add_marker(pytest.mark.flaky(reruns=1))
    items.sort(key=lambda item: (item.path in sizes, -sizes[item.path]))


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Generator[None, Any, Any]:
    """Keep modules and tests out of garbage collection: none becomes garbage, and a full collection takes 0.2 s.

    Collections during tests are rarer than usual: at the defaults they take a tenth of the processor time.
    """
    gc.disable()
    result = yield
    gc.freeze()
    gc.set_threshold(50_000, 20, 50)
    gc.enable()
    return result


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item, call: pytest.CallInfo[None]) -> Generator[None, Any, Any]:
    """Where `VICODE_PICTURES` names a folder, the pages of a failed test are kept there as they were when it failed."""
    report = yield
    folder, browser = os.environ.get("VICODE_PICTURES"), getattr(item, "funcargs", {}).get("chromium")
    if folder and browser and report.when == "call" and report.failed:
        for number, page in enumerate(page for context in browser.contexts for page in context.pages):
            page.screenshot(path=Path(folder) / f"{item.name}-{number}.png")
    return report


@pytest.fixture(scope="session")
def accept(request: pytest.FixtureRequest) -> bool:
    """Whether golden tests shall rewrite their expected files instead of comparing with them."""
    return bool(request.config.getoption("--accept"))


@pytest.fixture(scope="session")
def chromium() -> Iterator[Browser]:
    """A headless Chromium; one that is missing fails the test, since a test left out proves nothing."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=find_chromium(playwright), args=list(CHROMIUM_ARGUMENTS), timeout=60_000
        )
        if most_ms := os.environ.get("VICODE_LINE_MS"):
            _slow_down(browser, int(most_ms))
        yield browser
        browser.close()


def _slow_down(browser: Browser, most_ms: int) -> None:
    """Let every message between a page and its server take a while."""
    script = Path(__file__).with_name("slow_lines.js").read_text(encoding="utf-8").replace("MOST_MS", str(most_ms))

    def slow_down(context: BrowserContext) -> None:
        context.add_init_script(script)

    browser.on("context", slow_down)


@pytest.fixture
def console_errors() -> list[str]:
    """What the browser complained about so far; a test that provokes a complaint clears it."""
    return []


@pytest.fixture(scope="module")
def stays_open(chromium: Browser) -> Iterator[Page]:
    """A page that stays open while others of the same person come and go."""
    with page_that_stays_open(chromium) as page:
        yield page


@contextmanager
def page_that_stays_open(chromium: Browser) -> Iterator[Page]:
    """The page of a new person.

    What it opens runs in the process that is there, which has read the scripts of the editor before: that takes half
    of the time. To the browser all ports of 127.0.0.1 are one site.
    """
    context = chromium.new_context(viewport={"width": 1440, "height": 900})
    context.set_default_timeout(15_000)
    page = context.new_page()
    address = "http://127.0.0.1/"
    page.route(address, lambda route: route.fulfill(content_type="text/html", body="<title>Stays open</title>"))
    page.goto(address)
    page.unroute(address)
    yield page
    context.close()


@pytest.fixture
def page(stays_open: Page, console_errors: list[str]) -> Iterator[Page]:
    """A fresh page without storage; errors in its console fail the test at the end."""
    page = opened_beside(stays_open)
    _collect_errors(page, console_errors)
    yield page
    close_all_but(stays_open)
    assert not console_errors, "the browser reported errors:\n" + "\n".join(console_errors)


def close_all_but(page: Page) -> None:
    """Close the other pages of the same person, and forget what they stored, cookies and permissions."""
    context = page.context
    origins = set()
    for other in context.pages:
        if other is not page:
            origins.add("/".join(other.url.split("/")[:3]))
            other.close()
    devtools = context.new_cdp_session(page)
    for origin in origins:
        devtools.send("Storage.clearDataForOrigin", {"origin": origin, "storageTypes": "local_storage,indexeddb"})
    devtools.detach()
    context.clear_cookies()
    context.clear_permissions()


def opened_beside(page: Page) -> Page:
    """A window of the same person; a second tab would hide the first, and hidden pages hardly work."""
    with page.expect_popup() as opening:
        page.evaluate("void window.open('about:blank', '', 'popup')")
    return opening.value


def find_chromium(playwright: Playwright) -> str:
    for name in CHROMIUM_NAMES:
        if path := shutil.which(name):
            return path
    if Path(playwright.chromium.executable_path).exists():
        return playwright.chromium.executable_path
    pytest.fail("no Chromium found: run .ci/chromium, or 'sudo apt install chromium'", pytrace=False)


def _collect_errors(page: Page, errors: list[str]) -> None:
    def on_console(message: ConsoleMessage) -> None:
        if message.type == "error":
            errors.append(message.text)

    def on_page_error(error: Error) -> None:
        errors.append(f"{error.message}\n{error.stack or ''}")

    page.on("console", on_console)
    page.on("pageerror", on_page_error)


@pytest.fixture
def net_port(monkeypatch: pytest.MonkeyPatch) -> str:
    """The first of the ports of this test process."""
    port = str(20_000 + 32 * (os.getpid() % 1000))
    monkeypatch.setenv("VICODE_NET_PORT", port)
    monkeypatch.delenv("VICODE_NET_CONFIG", raising=False)
    return port
