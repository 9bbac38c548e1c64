"""The one Jinja environment: templates of a folder fill in finished strings, an unknown name in one is an error."""

from functools import lru_cache
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

_HERE = Path(__file__).parent


def render(template: str, **views: object) -> str:
    """The text of a template, `python/component.py.jinja`, filled with views."""
    return _environment().get_template(template).render(**views)


@lru_cache(maxsize=1)
def _environment() -> Environment:
    # In an installed package the templates lie inside it, in a checkout beside it.
    installed = _HERE / "_templates"
    folder = installed if installed.is_dir() else _HERE.parent / "templates"
    return Environment(
        loader=FileSystemLoader(folder),
        undefined=StrictUndefined,
        autoescape=False,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
