"""`vicode check`, `import` and `docs` of C++ sources with state machines."""

import json
from pathlib import Path

import pytest

from vicode.cli.entry_point import main
from vicode.store import open_project

SOURCE = """#include "Behavior.h"

option(Attack)
{
  initial_state(search)
  {
    transition
    {
      if(theBall.seen)
        goto go;
      else if(theBall.seen && theBall.near)
        goto kick;
      timer = 3;
    }
  }

  state(go)
  {
    transition { if(theBall.seen && lost) goto search; }
    action { WalkTo({.x = 3}); }
  }

  state(kick) { transition { goto search; } }
}

option(WalkTo) { initial_state(walk) { } }
"""


@pytest.fixture
def sources(tmp_path: Path) -> Path:
    folder = tmp_path / "behavior"
    folder.mkdir()
    (folder / "Attack.cpp").write_text(SOURCE, encoding="utf-8")
    (folder / "Root.cpp").write_text("// Attack and Help\nvoid update() { Attack(); }\n", encoding="utf-8")
    return folder


def found(folder: Path, capsys: pytest.CaptureFixture[str]) -> list[tuple[str, int]]:
    main(["check", "--json", str(folder)])
    return [(each["code"], each["line"]) for each in json.loads(capsys.readouterr().out)]


def test_findings_have_the_place_in_the_source(sources: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = sources / "Attack.cpp"
    assert main(["check", str(sources)]) == 0
    said = capsys.readouterr().out
    assert f"{file}:11:12: warning D423 shadowed-transition: " in said
    assert "      else if(theBall.seen && theBall.near)\n" in said
    assert f"{file}:23:3: warning D421 unreachable-state: 'kick' is unreachable" in said
    assert said.endswith("3 warnings in 2 state machines\n")
    assert main(["check", "--strict", str(file)]) == 1
    capsys.readouterr()
    assert main(["check", "--sarif", str(file)]) == 0
    assert "Attack.cpp" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("state(b) { transition { goto c; } }", [("D402", 2)]),
        ("state(b) { transition { if(y) { if(z) goto c; } if(x) goto a; } }", [("D402", 2)]),
        ("state(b) { }", [("D422", 2)]),
        ("aborted_state(b) { }", []),
        ("target_state(b) { }", []),
        ("state(b) { transition { if(x) goto a; } }", [("D435", 1)]),
        ("state(b) { transition { if(y) goto a; } }", []),
        ("state(b) { transition { if(x && state_time > 500) goto a; } }", []),
        ("state(b) { transition { if(left) goto a; } } state(c) { action { x = 1; } }", [("D421", 2)]),
        ("state(b) { transition { if(x || y) goto a; } action { x = 3; } }", []),
        ("state(b) { transition { if(m == E::p && m == E::q) goto a; } }", [("D433", 2), ("D422", 2)]),
        ("state(b) { transition { if(m != E::p || m != E::q) goto a; } }", [("D434", 2)]),
        ("state(b) { action { goto a; } }", []),
    ],
)
def test_only_problems_of_the_machine_are_found(
    text: str, expected: list[tuple[str, int]], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    top = "option(Walk) { initial_state(a) { transition { if(x) goto b; } }\n"
    (tmp_path / "walk.h").write_text(f"{top}{text} }}\nint main() {{ Walk(); }}\n", encoding="utf-8")
    assert sorted(found(tmp_path, capsys)) == sorted(expected)


@pytest.mark.parametrize(
    ("there", "back", "is_found"),
    [
        ("far", "far", True),
        ("far > 3", "far < 5", True),
        ("far && low", "low", True),
        ("far", "low", False),  # They may exclude each other.
        ("seen(4000) && far || seen(2000)", "!seen(4000) || (!seen(2000) && !far)", False),
        ("mode == Mode::play", "mode == Mode::wait", False),
        ("far", "left || far", False),  # The option sets it.
        ("far", "action_aborted || far", False),
    ],
)
def test_states_alternate_only_if_their_guards_surely_hold_together(
    there: str, back: str, is_found: bool, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = f"""option(Walk, vars((bool)(false) left)) {{
  initial_state(a) {{ transition {{ if({there}) goto b; }} }}
  state(b) {{ transition {{ if({back}) goto a; }} }}
}}
int main() {{ Walk(); }}
"""
    (tmp_path / "walk.h").write_text(text, encoding="utf-8")
    assert found(tmp_path, capsys) == [("D435", 2)] * is_found


def test_unused_options_are_found_unless_options_are_chosen_at_run_time(
    sources: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (sources / "Help.cpp").write_text("option(Help)\n{ initial_state(wait) {} }\n", encoding="utf-8")
    (sources / "Help.h").write_text("option(Help, args((int) speed));\n", encoding="utf-8")
    assert ("P214", 1) in found(sources, capsys)
    chosen = "option(Select) { initial_state(all) { action { select_option(names); } } }\nint n = Select();\n"
    (sources / "Select.cpp").write_text(chosen, encoding="utf-8")
    assert "P214" not in [code for code, _line in found(sources, capsys)]


def test_a_file_that_cannot_be_read_is_an_error_with_its_place(
    sources: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (sources / "Broken.cpp").write_text("option(Broken)\n{ initial_state(a) { transition { if(x] } } }\n", "utf-8")
    assert main(["check", str(sources)]) == 1
    assert "Broken.cpp:2:39: error S804 unbalanced-brackets: ']' closes nothing" in capsys.readouterr().out
    out = sources.parent / "designs"
    assert main(["import", str(sources), "--out", str(out)]) == 1
    assert "S804" in capsys.readouterr().err
    assert sorted(path.name for path in out.iterdir()) == ["Attack.yaml", "WalkTo.yaml", "project.yaml"]


def test_machines_become_designs_and_what_is_not_understood_is_listed(
    sources: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(sources.parent)
    assert main(["import", "behavior", "--out", "designs"]) == 0
    assert capsys.readouterr().out == (
        "wrote designs: 2 designs, 4 states, 1 hand-written component, 0 agents, 0 comments\n"
        "the designs cannot express 1 detail of the C++ files:\n"
        "  behavior/Attack.cpp:13: not in the design: timer = 3;\n"
    )
    opened = open_project(Path("designs"))
    assert [design.component for design in opened.project.designs] == ["Attack", "WalkTo"]
    assert all(state.at for design in opened.project.designs for state in design.states)
    assert main(["check", "designs"]) == 0
    capsys.readouterr()
    assert main(["import", "behavior", "--out", "designs"]) == 1
    assert "would be overwritten" in capsys.readouterr().err


def test_the_site_shows_the_sources(sources: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = sources.parent / "site"
    link = "https://example.org/{path}#L{line}"
    assert main(["docs", str(sources), "--out", str(out), "--source-url", link, "--strict"]) == 1
    assert "3 warnings" in capsys.readouterr().out
    page = (out / "component-Attack.html").read_text("utf-8")
    assert "Attack.cpp#L11" in page
    assert "Attack.cpp#L23" in page
    assert "theBall.near" in page


def test_files_without_machines_are_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "main.cpp").write_text("int main() {}\n", encoding="utf-8")
    assert main(["import", str(tmp_path / "main.cpp"), "--out", str(tmp_path / "out")]) == 2
    assert "no state machines in" in capsys.readouterr().err
    assert main(["import", str(tmp_path / "missing.cpp"), "--out", str(tmp_path / "out")]) == 2
