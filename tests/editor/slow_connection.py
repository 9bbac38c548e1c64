"""A line between page and server that can be slow."""

import time

from playwright.sync_api import Page, WebSocketRoute


class SlowConnection:
    """What the server says to a page can be held back; what the page says arrives at once."""

    def __init__(self, page: Page) -> None:
        self.is_held = False
        self.waiting: list[tuple[WebSocketRoute, str | bytes]] = []
        self._is_sending = False
        self._open: list[WebSocketRoute] = []
        page.route_web_socket("**/*", self._connect)

    def hold(self) -> None:
        self.is_held = True

    def release(self) -> None:
        """Hand on all that waits, and all that comes from now on."""
        self.is_held = False
        self._send_waiting()

    def release_until(self, page: Page, words: str) -> None:
        """Hand on what waits, up to the first message that says these words; it may be on the way still."""
        until_s = time.monotonic() + 20
        while not (found := [at for at, (_route, said) in enumerate(self.waiting) if words in _plain(said)]):
            assert time.monotonic() < until_s, [str(said)[:300] for _route, said in self.waiting]
            page.wait_for_timeout(20)
        self._send(found[0] + 1)

    def cut(self) -> None:
        """Close the connection, if there is one; what waits is lost, and the page connects again."""
        self.is_held = False
        self.waiting.clear()
        for route in self._open:
            route.close(code=1001)
        self._open.clear()

    def _send(self, count: int) -> None:
        for route, message in self.waiting[:count]:
            route.send(message)
        del self.waiting[:count]

    def _send_waiting(self) -> None:
        """Messages that come while another one is sent wait for their turn, as the page drops older ones."""
        if self._is_sending:
            return
        self._is_sending = True
        while self.waiting and not self.is_held:
            route, message = self.waiting.pop(0)
            route.send(message)
        self._is_sending = False

    def _connect(self, route: WebSocketRoute) -> None:
        server = route.connect_to_server()

        def pass_on(message: str | bytes) -> None:
            if route not in self._open:
                self._open.append(route)
            self.waiting.append((route, message))
            self._send_waiting()

        server.on_message(pass_on)


def _plain(said: str | bytes) -> str:
    """Without what quotes need in the texts in texts."""
    return str(said).replace("\\", "")
