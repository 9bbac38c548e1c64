"""All mistakes of a behavior are told at once, each at its word, with the nearest known name; none hides others."""

from pathlib import Path

from tests.check.test_rules_page import SECTIONS
from tests.xabsl.xabsl_cases import CASES, load_texts
from vicode.findings import render_text
from vicode.xabsl.compiler import CompileResult, compile_source
from vicode.xabsl.parser import parse
from vicode.xabsl.source_loader import load_source

SYMBOLS = """namespace symbols("Symbols") {
  enum side { left, right };
  float input ball.distance [0..5000] "mm";
  enum side input ball.side;
  float output speed [0..300];
  behavior stand { }
}
"""
AGENTS = 'include "symbols.xabsl";\ninclude "play.xabsl";\nagent player("Player", play);\n'


def codes_at(play: str, **others: str) -> list[str]:
    """Line, column and code of everything told of play.xabsl, notes left out."""
    named = {f"{name}.xabsl": text for name, text in others.items()}
    files = {"agents.xabsl": AGENTS, "symbols.xabsl": SYMBOLS.replace("  behavior stand { }\n", ""), "play.xabsl": play}
    compiled = compile_source(load_texts({**files, **named}))
    return [f"{each.location.line}:{each.location.column} {each.rule.code}" for each in in_play(compiled)]


def in_play(compiled: CompileResult) -> list:
    found = [each for each in compiled.findings if each.location and each.location.file == "play.xabsl"]
    return [each for each in found if each.rule.code not in ("X642", "X644")]


def test_one_mistake_does_not_hide_the_next() -> None:
    play = """option play {
  initial state wait {
    decision {
      if (ball.distanc < 300) goto kick;
      else if (ball.side == lft) stay;
      else goto nowhere;
    }
    action { speed = 3 }
  }
  state kick {
    decision { if (ball.distance < < 3) stay; else stay; }
    action { sped = 1; speed = 400; fly(); speed = left; }
  }
  state kick { action { } }
}
"""
    wanted = ["4:11 X621", "5:29 X621", "6:17 X621", "8:24 X604", "11:36 X604"]
    assert codes_at(play) == [*wanted, "12:14 X621", "12:32 X646", "12:37 X621", "12:52 X621", "14:9 X623"]


def test_the_nearest_name_is_told() -> None:
    files = {
        "agents.xabsl": AGENTS,
        "symbols.xabsl": SYMBOLS.replace("  behavior stand { }\n", ""),
        "play.xabsl": "option play { initial state wait { decision { if (ball.distanc > 3) goto wat; else stay; }\n"
        "action { sped = 1; } } }\n",
    }
    found = in_play(compile_source(load_texts(files)))
    assert [each.fix for each in found] == [f"did you mean '{name}'?" for name in ("ball.distance", "wait", "speed")]
    assert all(
        each.location and each.location.length == len(name)
        for each, name in zip(found, ("ball.distanc", "wat", "sped"), strict=True)
    )


def test_a_forgotten_semicolon_costs_nothing_else() -> None:
    play = "option play {\n  initial state wait {\n    action {\n      speed = 1\n      speed = 2;\n    }\n  }\n}\n"
    assert codes_at(play) == ["5:7 X604"]


def test_a_forgotten_brace_is_one_mistake() -> None:
    play = "option play {\n  initial state wait {\n    action { speed = 1; }\n"
    assert codes_at(play) == ["4:1 X605"]


def test_files_are_the_same_however_they_are_spelt() -> None:
    files = {
        "agents.xabsl": 'include "symbols.xabsl";\ninclude "sub/play.xabsl";\nagent player("Player", play);\n',
        "symbols.xabsl": SYMBOLS.replace("  behavior stand { }\n", ""),
        "sub/play.xabsl": 'include "../symbols.xabsl";\noption play { initial state s { action { } } }\n',
    }
    compiled = compile_source(load_texts(files))
    assert compiled.program
    assert {each.rule.code for each in compiled.findings} == {"X644"}


def test_deep_nesting_is_told_instead_of_failing() -> None:
    for deep in ("(" * 5000 + "1" + ")" * 5000, "-" * 5000 + "1", " + ".join("1" * 5000), "!" * 3000 + "true"):
        text = f"option play {{ initial state s {{ action {{ speed = {deep}; }} }} }}"
        assert [each.rule.code for each in parse(text).findings] == ["X604"]
    chain = "if (true) stay; else " * 5000 + "stay;"
    text = f"option play {{ initial state s {{ decision {{ {chain} }} action {{ }} }} }}"
    assert [each.rule.code for each in parse(text).findings] == ["X604"]


def test_what_the_original_never_looked_for() -> None:
    compiled = compile_source(load_source(CASES / "programs" / "p1" / "agents.xabsl"))
    assert {each.rule.code for each in compiled.findings} == {"X642", "X643", "X644", "X646", "X647"}


def test_other_encodings_and_line_ends_are_read(tmp_path: Path) -> None:
    play = "// gr\u00fc\u00dfe\r\noption play {\r\n  initial state s {\r\n    action { }\r\n  }\r\n}\r\n"
    (tmp_path / "play.xabsl").write_bytes(play.encode("cp1252"))
    (tmp_path / "agents.xabsl").write_bytes(b"\xef\xbb\xbf" + b'include "play.xabsl";\r\nagent a("A", play);\r\n')
    compiled = compile_source(load_source(tmp_path / "agents.xabsl"))
    assert compiled.program, render_text(compiled.findings)


def test_every_rule_of_the_language_is_in_the_rules_page() -> None:
    assert sum(code.startswith("X") for code in SECTIONS) > 25
