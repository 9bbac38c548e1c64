"""Plays the pages that show a session: writes their files, runs their commands, returns what is printed."""

import re
import shlex
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.cli.command_runner import vicode
from tests.manual.code_blocks import ROOT, CodeBlock, code_blocks

_MEASURED = re.compile(r" +\d+\.\d{3}(?= )")
_COMMAND = re.compile(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", re.MULTILINE)


def play(page: str, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> tuple[str, str]:
    """Play a page in the current folder; return its text, and the text with what was printed."""
    text = played = (ROOT / "docs" / page).read_text(encoding="utf-8")
    for block in code_blocks(ROOT / "docs" / page, "yaml", "python", "csv", "xabsl", "cpp", "console"):
        if block.language != "console":
            _write(block)
            continue
        shown = []
        for command, expected in commands_of(block):
            printed = _run(command, capfd, monkeypatch)
            is_same = re.fullmatch(_pattern(expected), _plain(printed))
            shown.append(f"$ {command}\n{expected if is_same else printed}")
        played = played.replace(block.text, "".join(shown), 1)
    return text, played


def commands_of(block: CodeBlock) -> Iterator[tuple[str, str]]:
    yield from _COMMAND.findall(block.text)


def _write(block: CodeBlock) -> None:
    if block.name:
        file = Path(block.name)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(block.text, encoding="utf-8")


def _run(command: str, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> str:
    """Run a command in this process, if it is one of vicode, or else in a shell; return what it prints."""
    first, *filters = command.split(" | ")
    words = shlex.split(first)
    capfd.readouterr()
    if words[0] == "cd":
        monkeypatch.chdir(words[1])
        return ""
    if words[0] == "vicode":
        vicode(*words[1:])
        out, err = capfd.readouterr()
        printed = out + err
    else:
        printed = subprocess.run(first, shell=True, capture_output=True, text=True, check=True).stdout
    for each in filters:
        printed = subprocess.run(each, shell=True, input=printed, capture_output=True, text=True, check=True).stdout
    return printed


def _pattern(expected: str) -> str:
    """What a command may print: durations differ, and a line of an ellipsis stands for any lines."""
    lines = _plain(expected).splitlines(keepends=True)
    return "".join("(?:.*\n)*?" if line.strip() == "…" else re.escape(line) for line in lines)


def _plain(text: str) -> str:
    lines = (_MEASURED.sub(" #", line).rstrip() for line in text.strip("\n").splitlines())
    return "".join(f"{line}\n" for line in lines)
