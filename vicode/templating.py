"""The one Jinja environment: templates of a folder fill in finished strings, an unknown name in one is an error.

In templates of HTML every string is escaped; what is HTML already is told so by the template.
"""

from functools import lru_cache
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

_PACKAGE_FOLDER = Path(__file__).parent


def render(template: str, **views: object) -> str:
    """The text of a template, `python/component.py.jinja`, filled with views."""
    return _environment().get_template(template).render(**views)


def read_asset(path: str) -> str:
    """A file that stands among the templates and is no template, `docsite/site.css`."""
    return (_folder() / path).read_text(encoding="utf-8")


def template_files(folder: str) -> tuple[Path, ...]:
    """Everything in a folder of templates and below it, by name."""
    return tuple(sorted(path for path in (_folder() / folder).rglob("*") if path.is_file()))


@lru_cache(maxsize=1)
def _environment() -> Environment:
    return Environment(
        loader=FileSystemLoader(_folder()),
        undefined=StrictUndefined,
        autoescape=_is_html,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        # Nobody edits a template while it is used.
        auto_reload=False,
    )


def _is_html(template: str | None) -> bool:
    return template is not None and template.endswith(".html.jinja")


def _folder() -> Path:
    # In an installed package the templates lie inside it, in a checkout beside it.
    installed = _PACKAGE_FOLDER / "_templates"
    return installed if installed.is_dir() else _PACKAGE_FOLDER.parent / "templates"
