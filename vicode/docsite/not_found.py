"""The page for unknown URLs of a served site."""

from vicode.docsite.urls import HOME
from vicode.templating import render


def not_found_page(base_url: str = "", *, site_name: str = "") -> str:
    """Render the page for an unknown URL; `base_url` is the URL of the folder of the site."""
    return render("docsite/not_found.html.jinja", folder=base_url, home=base_url + HOME, name=site_name)
