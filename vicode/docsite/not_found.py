"""The page that is shown where no page is, by whoever serves a site that is being built again and again."""

from vicode.docsite.urls import HOME
from vicode.templating import render


def not_found_page(base_url: str = "", *, site_name: str = "") -> str:
    """The page for an address without one; `base_url` is where the site's home is, `site_name` what the site is about."""
    return render("docsite/not_found.html.jinja", folder=base_url, home=base_url + HOME, name=site_name)
