"""Who opens a page: a browser is known by an id for as long as the editor runs, and by a chosen name for a year."""

import json
from urllib.parse import quote, unquote

from nicegui import app, ui

from vicode.editor.session import People, Person
from vicode.editor.session.people import clean_name

COOKIE = "vicode_name"
_YEAR_S = 365 * 24 * 3600


def greet_visitor(people: People) -> Person:
    """The person at the browser that asks for the page being built."""
    name = unquote(ui.context.client.request.cookies.get(COOKIE, ""))
    return people.greet(str(app.storage.browser["id"]), name)


def keep_name(name: str) -> None:
    """Let the browser remember a name."""
    cookie = f"{COOKIE}={quote(clean_name(name), safe='')}; path=/; max-age={_YEAR_S}; samesite=strict"
    ui.run_javascript(f"document.cookie = {json.dumps(cookie)}")
