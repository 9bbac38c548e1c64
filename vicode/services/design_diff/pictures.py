"""Writes the differences of designs as a diagram or as a page with diagrams."""

from collections.abc import Sequence

from vicode.diagram.diff_diagram import DARK_DIFF, LIGHT_DIFF, css_variable_diff, diff_variables, render_diff
from vicode.diagram.svg import write_svg
from vicode.model.design import Design
from vicode.model.diff import ChangeKind, changed_lines, describe_change
from vicode.services.design_diff.file_differences import FileDifference
from vicode.templating import render


def format_svg(differences: Sequence[FileDifference], *, dark: bool = False) -> str:
    """The diagram of the only design that differs.

    Raises:
        OSError: None or several designs differ.
    """
    designs = [(difference.name, pair) for difference in differences if (pair := _designs(difference)) is not None]
    if len(designs) != 1:
        names = ", ".join(name for name, _pair in designs)
        what = f"{len(designs)} designs differ: {names}" if designs else "no design differs"
        raise OSError(f"--svg shows the differences of one design, and {what}")
    ((_name, (old, new)),) = designs
    return write_svg(render_diff(old, new, DARK_DIFF if dark else LIGHT_DIFF))


def format_page(differences: Sequence[FileDifference]) -> str:
    """A page in HTML with the words and the diagram of each file."""
    files = [
        {
            "name": difference.lines()[0].removesuffix(":"),
            "lines": _lines(difference),
            "picture": _picture(difference),
        }
        for difference in differences
        if not difference.errors
    ]
    return render(
        "diff/page.html.jinja",
        title="Differences of designs",
        files=files,
        kinds=[str(kind) for kind in ChangeKind],
        light=diff_variables(LIGHT_DIFF),
        dark=diff_variables(DARK_DIFF),
    )


def _lines(difference: FileDifference) -> list[dict[str, str]]:
    if difference.changes:
        return [_line(change.kind, describe_change(change), *changed_lines(change)) for change in difference.changes]
    return [_line(difference.status, line.strip()) for line in difference.lines()[1:]]


def _line(kind: str, text: str, *details: str) -> dict[str, str]:
    return {"kind": kind, "text": text, "details": "\n".join(details)}


def _picture(difference: FileDifference) -> str:
    pair = _designs(difference)
    return "" if pair is None else write_svg(render_diff(*pair, css_variable_diff()), is_embedded=True)


def _designs(difference: FileDifference) -> tuple[Design, Design] | None:
    """Both designs of a changed file; of an added or removed one, with an empty design."""
    old = None if difference.old is None else difference.old.design
    new = None if difference.new is None else difference.new.design
    present = new or old
    if present is None or difference.errors or not difference.is_different:
        return None
    empty = Design(component=present.component)
    return old or empty, new or empty
