"""Identifies users: a browser keeps its id and the user's name for a year."""

import json
import re
import uuid
from urllib.parse import quote, unquote

from nicegui import ui

from vicode.editor.session import User, UserDirectory
from vicode.editor.session.presence import clean_name

NAME_COOKIE = "vicode_name"
BROWSER_COOKIE = "vicode_browser"
_YEAR_S = 365 * 24 * 3600
# Windows that open together have no cookie yet: the first one sets it, the others load again with it, once.
_KEEP_ID = f"""
<script>
{{
  const held = document.cookie.match(/(?:^|; ){BROWSER_COOKIE}=([0-9a-f]{{32}})/)?.[1];
  if (!held || held === "ID") document.cookie = "{BROWSER_COOKIE}=ID; path=/; max-age={_YEAR_S}; samesite=lax";
  else if (!sessionStorage.getItem("ID")) {{
    sessionStorage.setItem("ID", "replaced");
    location.reload();
  }}
}}
</script>
"""


def identify_user(users: UserDirectory) -> User:
    """The user of the request's browser.

    The session cookie of NiceGUI does not identify a browser: browsers send the cookies of a host to all its ports, so
    that each editor on this machine would replace the cookie of the others, and its key is new with each start.
    """
    cookies = ui.context.client.request.cookies
    held = cookies.get(BROWSER_COOKIE, "")
    id_ = held if re.fullmatch("[0-9a-f]{32}", held) else uuid.uuid4().hex
    ui.add_head_html(_KEEP_ID.replace("ID", id_))
    return users.get_or_create_user(id_, unquote(cookies.get(NAME_COOKIE, "")))


def store_name(name: str) -> None:
    cookie = f"{NAME_COOKIE}={quote(clean_name(name), safe='')}; path=/; max-age={_YEAR_S}; samesite=strict"
    ui.run_javascript(f"document.cookie = {json.dumps(cookie)}")
