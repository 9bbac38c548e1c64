"""Who opens a page: a browser is known by an id for as long as the editor runs, and by a chosen name for a year."""

import json
from urllib.parse import quote, unquote

from nicegui import app, ui

from vicode.editor.session import User, UserDirectory
from vicode.editor.session.presence import clean_name

NAME_COOKIE = "vicode_name"
_YEAR_S = 365 * 24 * 3600


def identify_user(people: UserDirectory) -> User:
    """The person at the browser that asks for the page being built."""
    name = unquote(ui.context.client.request.cookies.get(NAME_COOKIE, ""))
    return people.get_or_create_user(str(app.storage.browser["id"]), name)


def store_name(name: str) -> None:
    """Let the browser remember a name."""
    cookie = f"{NAME_COOKIE}={quote(clean_name(name), safe='')}; path=/; max-age={_YEAR_S}; samesite=strict"
    ui.run_javascript(f"document.cookie = {json.dumps(cookie)}")
