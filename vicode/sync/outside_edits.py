"""Separates the edits of a generated file outside regions from what changed in the design since."""

from vicode.model.merge import merge_lines
from vicode.regions import find_regions, get_comment_prefix
from vicode.sync.file_edits import FileEdits


def rebase_outside_edits(file: FileEdits, base: str | None) -> str | None:
    """Return the text generated now with the edits outside regions.

    Args:
        file: The edited file.
        base: The text that was generated when the file was written, None if it is unknown.

    Returns:
        None if the design changed the same lines; without a base the text of the file, in which changes of the design
        look like edits that revert them.
    """
    if file.new is None:
        return None
    if base is None:
        return file.old
    before, edited = (_with_regions_of(text, file.new, file.path) for text in (base, file.old))
    return merge_lines(before, edited, file.new)


def _with_regions_of(text: str, other: str, path: str) -> str:
    """The text with the regions of another text: only statements outside regions are compared."""
    comment = get_comment_prefix(path)
    lines, others = text.replace("\r\n", "\n").split("\n"), other.split("\n")
    blocks = {region.id: others[region.line - 1 : region.end_line] for region in find_regions(other, comment).regions}
    for region in reversed(find_regions(text, comment).regions):
        if region.id in blocks:
            lines[region.line - 1 : region.end_line] = blocks[region.id]
    return "\n".join(lines)
