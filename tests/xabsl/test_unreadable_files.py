"""Messages about files of a behavior that cannot be read."""

from dataclasses import replace
from pathlib import Path

import pytest

from vicode.cli.console import format_findings
from vicode.xabsl.source_loader import load_source


def test_a_missing_main_file_is_named_once(tmp_path: Path) -> None:
    (finding,) = load_source(tmp_path / "agents.xabsl").findings
    assert finding.location
    assert finding.location.file == "agents.xabsl"


def test_utf16_is_named(tmp_path: Path) -> None:
    (tmp_path / "symbols.xabsl").write_text("namespace s", encoding="utf-16")
    agents = tmp_path / "agents.xabsl"
    agents.write_text('include "symbols.xabsl";\nagent a("A", play);\n', encoding="utf-8")
    (finding,) = load_source(agents).findings
    assert finding.message == "symbols.xabsl is encoded in UTF-16"
    assert finding.fix == "save it as UTF-8"


@pytest.mark.parametrize(
    ("text", "excerpt"),
    [
        ("option main {\n initial state s { decision { /* häß */ stay } }\n}\n".encode("cp1252"), "/* häß */ stay }"),
        (b"option main {\r initial state s { decision { stay } }\r}\r", "stay } }"),
    ],
)
def test_the_excerpt_of_an_old_file_points_at_the_place(tmp_path: Path, text: bytes, excerpt: str) -> None:
    (tmp_path / "main.xabsl").write_bytes(text)
    agents = tmp_path / "agents.xabsl"
    agents.write_text('include "main.xabsl";\nagent a("A", main);\n', encoding="utf-8")
    findings = [
        replace(finding, location=replace(finding.location, file=str(tmp_path / finding.location.file)))
        for finding in load_source(agents).findings
        if finding.location
    ]
    _message, line, caret = format_findings(findings).splitlines()[:3]
    assert excerpt in line
    assert line[caret.index("^")] == "}"
