"""All problems of a behavior are reported at once, at their tokens, with the most similar known name."""

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
    """Line, column and code of all findings in play.xabsl, except unused symbols and omitted parameters."""
    named = {f"{name}.xabsl": text for name, text in others.items()}
    files = {"agents.xabsl": AGENTS, "symbols.xabsl": SYMBOLS.replace("  behavior stand { }\n", ""), "play.xabsl": play}
    compiled = compile_source(load_texts({**files, **named}))
    return [f"{finding.location.line}:{finding.location.column} {finding.rule.code}" for finding in in_play(compiled)]


def in_play(compiled: CompileResult) -> list:
    findings = [finding for finding in compiled.findings if finding.location and finding.location.file == "play.xabsl"]
    return [finding for finding in findings if finding.rule.code not in ("X642", "X644")]


def test_one_error_does_not_hide_the_next() -> None:
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
    expected = ["4:11 X621", "5:29 X621", "6:17 X621", "8:24 X604", "11:36 X604"]
    assert codes_at(play) == [*expected, "12:14 X621", "12:32 X646", "12:37 X621", "12:52 X621", "14:9 X623"]


def test_the_fix_suggests_the_most_similar_name() -> None:
    files = {
        "agents.xabsl": AGENTS,
        "symbols.xabsl": SYMBOLS.replace("  behavior stand { }\n", ""),
        "play.xabsl": "option play { initial state wait { decision { if (ball.distanc > 3) goto wat; else stay; }\n"
        "action { sped = 1; } } }\n",
    }
    findings = in_play(compile_source(load_texts(files)))
    assert [finding.fix for finding in findings] == [
        f"did you mean '{name}'?" for name in ("ball.distance", "wait", "speed")
    ]
    assert all(
        finding.location and finding.location.length == len(name)
        for finding, name in zip(findings, ("ball.distanc", "wat", "sped"), strict=True)
    )


def test_a_missing_semicolon_is_one_finding() -> None:
    play = "option play {\n  initial state wait {\n    action {\n      speed = 1\n      speed = 2;\n    }\n  }\n}\n"
    assert codes_at(play) == ["5:7 X604"]


def test_a_missing_brace_is_one_finding() -> None:
    play = "option play {\n  initial state wait {\n    action { speed = 1; }\n"
    assert codes_at(play) == ["4:1 X605"]


def test_a_file_included_by_two_spellings_is_read_once() -> None:
    files = {
        "agents.xabsl": 'include "symbols.xabsl";\ninclude "sub/play.xabsl";\nagent player("Player", play);\n',
        "symbols.xabsl": SYMBOLS.replace("  behavior stand { }\n", ""),
        "sub/play.xabsl": 'include "../symbols.xabsl";\noption play { initial state s { action { } } }\n',
    }
    compiled = compile_source(load_texts(files))
    assert compiled.program
    assert {finding.rule.code for finding in compiled.findings} == {"X644"}


def test_deep_nesting_is_one_finding() -> None:
    for expression in ("(" * 5000 + "1" + ")" * 5000, "-" * 5000 + "1", " + ".join("1" * 5000), "!" * 3000 + "true"):
        text = f"option play {{ initial state s {{ action {{ speed = {expression}; }} }} }}"
        assert [finding.rule.code for finding in parse(text).findings] == ["X604"]
    chain = "if (true) stay; else " * 5000 + "stay;"
    text = f"option play {{ initial state s {{ decision {{ {chain} }} action {{ }} }} }}"
    assert [finding.rule.code for finding in parse(text).findings] == ["X604"]


def test_checks_that_the_original_lacks() -> None:
    compiled = compile_source(load_source(CASES / "programs" / "p1" / "agents.xabsl"))
    assert {finding.rule.code for finding in compiled.findings} == {"X642", "X643", "X644", "X646", "X647"}


def test_other_encodings_and_line_endings(tmp_path: Path) -> None:
    play = "// gr\u00fc\u00dfe\r\noption play {\r\n  initial state s {\r\n    action { }\r\n  }\r\n}\r\n"
    (tmp_path / "play.xabsl").write_bytes(play.encode("cp1252"))
    (tmp_path / "agents.xabsl").write_bytes(b"\xef\xbb\xbf" + b'include "play.xabsl";\r\nagent a("A", play);\r\n')
    compiled = compile_source(load_source(tmp_path / "agents.xabsl"))
    assert compiled.program, render_text(compiled.findings)


def test_the_rules_page_documents_the_xabsl_rules() -> None:
    assert sum(code.startswith("X") for code in SECTIONS) > 25
