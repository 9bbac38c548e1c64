"""The page that is shown where no page is, by whoever serves a site that is being built again and again."""

from vicode.docsite.addresses import HOME
from vicode.templating import render


def missing_page(folder: str = "", *, name: str = "") -> str:
    """The page for an address without one; `folder` is where the site's home is, `name` what the site is about."""
    return render("docsite/missing.html.jinja", folder=folder, home=folder + HOME, name=name)
