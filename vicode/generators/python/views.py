"""The layout of generated modules: imports, classes and methods."""

from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class MethodView:
    """A method; both texts are indented, and the signature ends with a colon."""

    signature: str
    body: str

    @property
    def text(self) -> str:
        return f"{self.signature}\n{self.body}"


def format_module(
    docstring: str, imports: Iterable[tuple[str, ...]], runtime: str, *classes: str, module_code: str = ""
) -> str:
    """Return a module of components; `imports` are import sections."""
    sections = [docstring, "from __future__ import annotations", "from typing import TYPE_CHECKING"]
    sections += ["\n".join(lines) for lines in imports]
    sections += [f"if TYPE_CHECKING:\n    from {runtime} import Root"]
    sections += [module_code] if module_code else []
    return "\n\n\n".join(["\n\n".join(sections), *classes]) + "\n"


def format_class(name: str, base: str, docstring: str, *members: str) -> str:
    """Return a class whose members are separated by blank lines."""
    return "\n\n".join([f"class {name}({base}):\n{docstring}", *members])
