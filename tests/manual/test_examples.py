"""Every command, file and program of the documents is one that vicode accepts."""

import argparse
import json
import re
import shutil
import subprocess
import textwrap
from pathlib import Path

import pytest
import yaml

from tests.cli.command_runner import vicode
from tests.manual.code_blocks import PAGES, ROOT, CodeBlock, all_blocks, code_blocks, vicode_commands
from vicode.cli.entry_point import COMMANDS, make_command_parser
from vicode.simulated_robot.map_file import read_world_map
from vicode.store import read_design, read_project_file
from vicode.store.format import DESIGN_RECORDS
from vicode.store.project_format import PROJECT_RECORDS

_SPAN = re.compile(r"`(?:\.venv/bin/)?vicode ([a-z][^`\n]*)`")
_OPTION = re.compile(r"(?<![\w-])--?[a-z][a-z-]*")
_PROJECT_KEYS = {key.name for record in PROJECT_RECORDS if record.name == "project" for key in record.keys}
_DESIGN_KEYS = {key.name for record in DESIGN_RECORDS if record.name == "design" for key in record.keys}
# Commands that end and write only where they are.
_WITHOUT_INPUT = {"sample", "schema"}
_RUNNABLE = {"check", "docs", "export", "gen", "run", "deploy", "conform", *_WITHOUT_INPUT}
_NOT_HERE = {"--watch", "--net", "--real-time", "--reload", "--profile", "--emulator"}


@pytest.mark.parametrize("block", all_blocks("sh", "console", "bash"), ids=str)
def test_commands_are_accepted(block: CodeBlock) -> None:
    for words in vicode_commands(block):
        make_command_parser().parse_args(words)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_options_in_the_text_exist(page: Path) -> None:
    options = _options_by_command()
    for span in _SPAN.findall(page.read_text(encoding="utf-8")):
        name = next(
            name for name in (" ".join(span.split()[:2]), span.split()[0]) if name in options or " " not in name
        )
        given = set(_OPTION.findall(re.sub(r'"[^"]*"|\'[^\']*\'', "", span)))
        assert given <= options[name], f"vicode {span}"


@pytest.mark.parametrize("block", all_blocks("sh"), ids=str)
def test_commands_run(block: CodeBlock, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    commands = [words for words in vicode_commands(block) if words[0] in _RUNNABLE and not _NOT_HERE & set(words)]
    if commands:
        shutil.copytree(ROOT / "designs", tmp_path / "designs", ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.chdir(tmp_path)
    for words in commands:
        if all(path.exists() for path in _inputs(words)) and "@" not in str(words):
            assert vicode(*words) == 0, words


@pytest.mark.parametrize("block", all_blocks("yaml"), ids=str)
def test_files_are_valid(block: CodeBlock) -> None:
    if block.page.name == "conformance.md":
        return  # a case with an ellipsis; tests/conformance reads complete ones
    keys = set(re.findall(r"^([\w-]+):", block.text, re.MULTILINE))
    if {"project", "component"} & keys:
        read = read_project_file if "project" in keys else read_design
        assert read(block.text).findings == ()
    elif keys <= _PROJECT_KEYS:
        assert read_project_file(f"vicode: 1\nproject: Sample\n{block.text}").findings == ()
    elif keys <= _DESIGN_KEYS:
        start = "vicode: 1\ncomponent: Sample\n" + ("" if "states" in keys else "states: {A: {}}\n")
        assert read_design(start + block.text).findings == ()
    elif "walls" in keys:
        assert read_world_map(block.text).findings == ()
    else:
        _check_workflow(yaml.safe_load(block.text))


def test_the_examples_of_the_architectures_are_one_project(tmp_path: Path) -> None:
    """All checks find nothing in it, and its designs behave alike in the interpreter and in generated Python."""
    page = ROOT / "docs" / "architectures.md"
    for block in code_blocks(page, "yaml"):
        name = "project.yaml" if "\nproject:" in block.text else block.name
        (tmp_path / name).write_text(block.text, encoding="utf-8")
    assert vicode("check", "--strict", "--deep", str(tmp_path)) == 0
    for name in ("life", "deliver", "watchman", "rover"):
        assert vicode("conform", str(tmp_path / f"{name}.yaml"), "--iterations", "200") == 0, name


@pytest.mark.parametrize("block", all_blocks("python", "py"), ids=str)
def test_programs_compile(block: CodeBlock) -> None:
    compile(textwrap.dedent(block.text), str(block), "exec")


@pytest.mark.parametrize("block", all_blocks("json"), ids=str)
def test_json_can_be_read(block: CodeBlock) -> None:
    rest = "\n".join(line for line in block.text.strip().splitlines() if "…" not in line)
    while rest:  # one value, or one per line
        _, end = json.JSONDecoder().raw_decode(rest)
        rest = rest[end:].strip()


@pytest.mark.parametrize("block", all_blocks("lua"), ids=str)
def test_settings_of_neovim_can_be_read(block: CodeBlock, tmp_path: Path) -> None:
    program = shutil.which("nvim")
    if program is None:
        pytest.skip("Neovim is missing: run .ci/neovim, or 'sudo apt install neovim'")
    (tmp_path / "init.lua").write_text(block.text, encoding="utf-8")
    command = [program, "--headless", "-u", "NONE", "-i", "NONE", "+lua assert(loadfile('init.lua'))", "+qa"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stderr) == (0, "")


def _check_workflow(content: object) -> None:
    """The commands of a file for CI."""
    texts = re.findall(r"'vicode ([^']*)'", str(content))
    assert texts
    for text in texts:
        make_command_parser().parse_args(text.split())


def _options_by_command() -> dict[str, set[str]]:
    found: dict[str, set[str]] = {}

    def collect(name: str, parser) -> None:
        found[name] = {option for action in parser._actions for option in action.option_strings}
        for action in parser._actions:
            if isinstance(action, argparse._SubParsersAction):
                for word, command in action.choices.items():
                    collect(f"{name} {word}".strip(), command)

    collect("", make_command_parser(COMMANDS))
    return found


def _inputs(words: list[str]) -> list[Path]:
    """The files that a command reads; files that readers have of their own do not exist here."""
    arguments = vars(make_command_parser().parse_args(words))
    given = [arguments.get(name) or [] for name in ("path", "paths", "file", "design")]
    paths = [path for each in given for path in (each if isinstance(each, list) else [each])]
    return [Path("nowhere")] if not paths and words[0] not in _WITHOUT_INPUT else [Path(path) for path in paths]
