"""Small programs are accepted or rejected as by the original compiler, except for the listed improvements."""

import pytest

from tests.xabsl.xabsl_cases import Probe, load_texts, parse_words, read_probes
from vicode.findings import Finding
from vicode.xabsl.compiler import CompileResult, compile_source
from vicode.xabsl.engine.code_writer import write_code

PROBES = read_probes()

# Probes with a different result: rejected by a defect in the lexer of the original, or accepted although no engine can
# load them.
IMPROVEMENTS = {
    "empty_block_comment": "X651",  # the original reads the start of a description
    "cycle": "X636",  # the original compiles it, but no engine loads it
}
# Message classes of the original with the corresponding codes.
CODES = {
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
def test_result_matches_the_original_compiler(probe: Probe) -> None:
    compiled = compile_probe(probe)
    if probe.name in IMPROVEMENTS:
        assert (compiled.program is None) == probe.accepted
        assert IMPROVEMENTS[probe.name] in {finding.rule.code for finding in compiled.findings}
    else:
        assert (compiled.program is not None) == probe.accepted, [finding.message for finding in compiled.findings]


@pytest.mark.parametrize("probe", [probe for probe in PROBES if probe.message], ids=lambda probe: probe.name)
def test_every_message_class_has_a_finding_at_the_same_line(probe: Probe) -> None:
    code = min((code for code in CODES if code in probe.message), key=probe.message.index)
    findings = [finding for finding in compile_probe(probe).findings if finding.rule.code in CODES[code]]
    assert findings, code
    if probe.name not in IMPROVEMENTS:
        assert _original_location(probe.message) in {_location(finding) for finding in findings}


def _original_location(message: str) -> str:
    """File and line of a message like "ERROR    X5552 root.xabsl:4" or "root.xabsl(3) : error …"."""
    first = message.split("\n", maxsplit=1)[0]
    if " : error" in first:
        return first.split(" : error")[0].replace("(", ":").rstrip(")")
    return first.split()[2] if ":" in first.split()[2] else f"{first.split()[2]}:1"


def _location(finding: Finding) -> str:
    assert finding.location
    # The original reports no line for an unexpected end of file.
    return f"{finding.location.file}:{0 if finding.rule.code == 'X605' else finding.location.line}"


@pytest.mark.parametrize("probe", [probe for probe in PROBES if probe.code], ids=lambda probe: probe.name)
def test_intermediate_code_matches_the_original_compiler(probe: Probe) -> None:
    program = compile_probe(probe).program
    if probe.name in IMPROVEMENTS:
        assert program is None
        return
    assert program
    words = parse_words(write_code(program))
    expected = parse_words(probe.code)
    assert any(words[start : start + len(expected)] == expected for start in range(len(words)))


@pytest.mark.parametrize("probe", PROBES, ids=lambda probe: probe.name)
def test_every_finding_is_located_inside_its_file(probe: Probe) -> None:
    for finding in compile_probe(probe).findings:
        assert finding.location
        lines = probe.files[finding.location.file].split("\n")
        assert 1 <= finding.location.line <= len(lines)
        assert 1 <= finding.location.column <= len(lines[finding.location.line - 1]) + 1
