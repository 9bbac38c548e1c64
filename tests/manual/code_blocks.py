"""The code blocks of the documents."""

import re
import shlex
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]
# Examples of docs/rules.md violate rules; tests/check runs them.
PAGES = sorted(
    {ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").rglob("*.md")} - {ROOT / "docs/rules.md"}
)
_BLOCK = re.compile(r"^```(?P<language>\w*)(?: (?P<name>\S+))?\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)
_NAME_LINE = re.compile(r"\A(?:#|//) (?P<name>[\w./-]+\.\w+)\n")


@dataclass(frozen=True, slots=True, kw_only=True)
class CodeBlock:
    """A code block; `name` is the file that its first line or its opening fence names."""

    page: Path
    line: int
    language: str
    name: str
    text: str

    def __str__(self) -> str:
        return f"{self.page.relative_to(ROOT)}:{self.line}"


def code_blocks(page: Path, *languages: str) -> Iterator[CodeBlock]:
    text = page.read_text(encoding="utf-8")
    for match in _BLOCK.finditer(text):
        # A block without a language may start with a command.
        language = match["language"] or ("sh" if match["text"].startswith("vicode ") else "text")
        if language in languages:
            name_line = _NAME_LINE.match(match["text"])
            yield CodeBlock(
                page=page,
                line=text.count("\n", 0, match.start()) + 1,
                language=language,
                name=name_line["name"] if name_line else match["name"] or "",
                text=match["text"],
            )


def all_blocks(*languages: str) -> list[CodeBlock]:
    return [block for page in PAGES for block in code_blocks(page, *languages)]


def vicode_commands(block: CodeBlock) -> Iterator[list[str]]:
    """The arguments of each call of vicode in a block of commands; without what is piped or redirected."""
    lines = block.text.replace("\\\n", " ").splitlines()
    if block.language == "console":
        lines = [line.removeprefix("$ ") for line in lines if line.startswith("$ ")]
    for line in lines:
        for part in re.split(r" && |; | \| ", line.split(" > ")[0].removesuffix(" &")):
            if re.match(r"(\S*/)?vicode ", part):
                yield shlex.split(part, comments=True)[1:]
