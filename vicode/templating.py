"""Renders Jinja templates; undefined names are errors.

HTML templates escape all strings; a template marks a string that is already HTML as safe.
"""

from functools import lru_cache
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

_PACKAGE_FOLDER = Path(__file__).parent


def render(template: str, **views: object) -> str:
    """Render a template, such as `python/component.py.jinja`, with views as its variables."""
    return _environment().get_template(template).render(**views)


def read_asset(path: str) -> str:
    """Read a file of the templates folder that is not a template, such as `docsite/site.css`."""
    return (_folder() / path).read_text(encoding="utf-8")


def template_files(folder: str) -> tuple[Path, ...]:
    """All files in and below a folder of templates, sorted by path."""
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
        # Templates do not change while the program runs.
        auto_reload=False,
    )


def _is_html(template: str | None) -> bool:
    return template is not None and template.endswith(".html.jinja")


def _folder() -> Path:
    # An installed package contains the templates; in a checkout they are next to the package.
    installed = _PACKAGE_FOLDER / "_templates"
    return installed if installed.is_dir() else _PACKAGE_FOLDER.parent / "templates"
