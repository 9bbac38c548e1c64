"""Messages about files of a behavior that cannot be read."""

from pathlib import Path

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
