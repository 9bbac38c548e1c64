"""Long and deep programs: each is compiled, run, formatted, imported, checked and written back."""

import subprocess
import sys
from pathlib import Path

import pytest

SYMBOLS = 'namespace s("S") {\n  float input x;\n  bool input b;\n  float output o;\n}\n'
DEEP_IF = "if (b) {\n" * 100 + "goto z;\n" + "} else { stay; }\n" * 100
ELSE_IFS = "if (x < 0) goto z;\n" + "".join(f"else if (x == {number}) goto z;\n" for number in range(499))

DECISIONS = {
    "else-if": (ELSE_IFS + "else stay;", "o = 1;"),
    "and": (f"if ({' && '.join(f'x > -{number}' for number in range(500))}) goto z; else stay;", "o = 1;"),
    "nested": (DEEP_IF, "o = 1;"),
    "sum": ("if (b) goto z; else stay;", f"o = {' + '.join(['x'] * 500)};"),
}


def run(folder: Path, *arguments: str) -> str:
    """The output of a command that succeeds."""
    command = [sys.executable, "-m", "vicode", *arguments]
    done = subprocess.run(command, cwd=folder, check=False, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, f"{arguments}\n{done.stdout}\n{done.stderr[-2000:]}"
    return done.stdout


def write_behavior(folder: Path, options: dict[str, str], root: str) -> None:
    for name, text in options.items():
        (folder / f"{name}.xabsl").write_text(text, encoding="utf-8")
    (folder / "symbols.xabsl").write_text(SYMBOLS, encoding="utf-8")
    includes = "".join(f'include "{name}.xabsl";\n' for name in (*options, "symbols"))
    (folder / "agents.xabsl").write_text(f'{includes}agent a("A", {root});\n', encoding="utf-8")
    (folder / "inputs.csv").write_text("x,b\n7,1\n9,1\n", encoding="utf-8")


def play(decision: str, action: str) -> str:
    states = f"initial state a {{ decision {{ {decision} }} action {{ {action} }} }}"
    return f"option play {{ {states} state z {{ decision {{ goto a; }} action {{ o = 2; }} }} }}\n"


def compile_and_run(folder: Path, agents: str) -> str:
    run(folder, "xabsl", "compile", agents, "-o", "code", "--symbols", "symbols")
    return run(folder, "xabsl", "run", "code", "--symbols", "symbols", "--inputs", "inputs.csv")


@pytest.mark.parametrize("kind", DECISIONS)
def test_long_and_deep_options_survive_every_command(tmp_path: Path, kind: str) -> None:
    write_behavior(tmp_path, {"play": play(*DECISIONS[kind])}, "play")
    trace = compile_and_run(tmp_path, "agents.xabsl")
    run(tmp_path, "xabsl", "format", "play.xabsl")
    assert compile_and_run(tmp_path, "agents.xabsl") == trace
    run(tmp_path, "import", "agents.xabsl", "--out", "designs")
    run(tmp_path, "check", "designs")
    run(tmp_path, "gen", "designs", "--out", "generated", "--language", "xabsl")
    (back,) = tmp_path.glob("generated/**/agents.xabsl")
    run(tmp_path, "xabsl", "check", str(back))


def test_a_chain_of_2000_calls_runs(tmp_path: Path) -> None:
    last = 1999
    options = {
        f"c{number}": f"option c{number} {{ initial state a {{ action {{ {call} }} }} }}\n"
        for number in range(last + 1)
        for call in [f"c{number + 1}();" if number < last else "o = x;"]
    }
    write_behavior(tmp_path, options, "c0")
    assert '"component":"c1999"' in compile_and_run(tmp_path, "agents.xabsl")
