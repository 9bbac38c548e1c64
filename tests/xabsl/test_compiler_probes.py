"""Tiny programs are judged as the original compiler judged them, or better; what is better is listed."""

import pytest

from tests.xabsl.xabsl_cases import Probe, load_texts, parse_words, read_probes
from vicode.findings import Finding
from vicode.xabsl.compiler import CompileResult, compile_source
from vicode.xabsl.engine.code_writer import write_code

PROBES = read_probes()

# Verdicts that differ, and why: what the original refused by a slip of its lexer, and what it let pass.
BETTER = {
    "empty_block_comment": "X651",  # it opens a description there, which is never closed
    "cycle": "X636",  # it compiles, and no engine loads it
}
# The class of each message of the original, and ours for it.
OURS = {
    "X2537": {"X604", "X634", "X651"},
    "X2555": {"X605"},
    "X2573": {"X601"},
    "X2375": {"X606"},
    "X3275": {"X651"},
    "X5255": {"X621", "X626"},
    "X5327": {"X629"},
    "X5525": {"X625"},
    "X5552": {"X621", "X624"},
    "X5723": {"X622"},
    "X5732": {"X625"},
    "X7325": {"X641"},
}


def compile_probe(probe: Probe) -> CompileResult:
    return compile_source(load_texts(probe.files))


@pytest.mark.parametrize("probe", PROBES, ids=lambda probe: probe.name)
def test_the_verdict_is_the_originals_or_better(probe: Probe) -> None:
    compiled = compile_probe(probe)
    if probe.name in BETTER:
        assert (compiled.program is None) == probe.accepted
        assert BETTER[probe.name] in {each.rule.code for each in compiled.findings}
    else:
        assert (compiled.program is not None) == probe.accepted, [each.message for each in compiled.findings]


@pytest.mark.parametrize("probe", [each for each in PROBES if each.message], ids=lambda probe: probe.name)
def test_every_class_of_message_has_its_like(probe: Probe) -> None:
    code = min((code for code in OURS if code in probe.message), key=probe.message.index)
    found = [each for each in compile_probe(probe).findings if each.rule.code in OURS[code]]
    assert found, code
    if probe.name not in BETTER:
        assert _line_of(probe.message) in {_place(each) for each in found}


def _line_of(message: str) -> str:
    """File and line that a message begins with: "ERROR    X5552 root.xabsl:4" or "root.xabsl(3) : error …"."""
    first = message.split("\n", maxsplit=1)[0]
    if " : error" in first:
        return first.split(" : error")[0].replace("(", ":").rstrip(")")
    return first.split()[2] if ":" in first.split()[2] else f"{first.split()[2]}:1"


def _place(finding: Finding) -> str:
    assert finding.location
    # The original tells no line where a file ends too early.
    return f"{finding.location.file}:{0 if finding.rule.code == 'X605' else finding.location.line}"


@pytest.mark.parametrize("probe", [each for each in PROBES if each.code], ids=lambda probe: probe.name)
def test_the_code_is_the_originals(probe: Probe) -> None:
    program = compile_probe(probe).program
    if probe.name in BETTER:
        assert program is None
        return
    assert program
    root = parse_words(write_code(program))
    wanted = parse_words(probe.code)
    assert any(root[at : at + len(wanted)] == wanted for at in range(len(root)))


@pytest.mark.parametrize("probe", PROBES, ids=lambda probe: probe.name)
def test_every_message_stands_in_its_file(probe: Probe) -> None:
    for finding in compile_probe(probe).findings:
        assert finding.location
        lines = probe.files[finding.location.file].split("\n")
        assert 1 <= finding.location.line <= len(lines)
        assert 1 <= finding.location.column <= len(lines[finding.location.line - 1]) + 1
