"""Edits an option as the update of an imported behavior does."""

import re

from vicode.xabsl import tree
from vicode.xabsl.parser import parse
from vicode.xabsl.patching.option_edits import OptionVersion, edit_option
from vicode.xabsl.patching.source_edits import SourceEdits


def version(text: str) -> OptionVersion:
    parsed = parse(text, "play.xabsl")
    (option,) = parsed.file.body
    assert isinstance(option, tree.OptionNode)
    return OptionVersion(option, parsed, tuple(option.states))


def edited(old: str, after: str, before: str = "") -> str:
    """Edit an option; `before` is the form in which `after` is generated, if it is another one."""
    original = version(old)
    file = SourceEdits(original.file)
    edit_option(file, original.option, version(clean(before or old)), version(clean(after)))
    return file.result()


def clean(text: str) -> str:
    """The text without the comments that no design has: those in and behind lines."""
    return re.sub(r"^( *[^ /\n].*?) *//.*$|/\*(?!\*).*?\*/", r"\1", text, flags=re.MULTILINE)
