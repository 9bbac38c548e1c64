"""The catalogue: codes and names are addresses, so they are unique and keep their shape."""

import re

import pytest

from vicode.findings import RULES, Rule, Severity, get_rule


def test_a_rule_is_found_by_its_code() -> None:
    assert get_rule("D421").name == "unreachable-state"
    with pytest.raises(KeyError):
        get_rule("D000")


def test_names_are_unique() -> None:
    names = [each.name for each in RULES.values()]
    assert len(set(names)) == len(names)


@pytest.mark.parametrize("each", RULES.values(), ids=lambda each: each.code)
def test_a_rule_keeps_its_shape(each: Rule) -> None:
    assert re.fullmatch(r"[YPEDLGX]\d{3}", each.code)
    assert re.fullmatch(r"[a-z]+(-[a-z]+)*", each.name)
    assert each.summary[:1].islower() or each.summary.startswith(("YAML", "Python"))
    assert not each.summary.endswith(".")


def test_withdrawn_codes_stay_free() -> None:
    assert "D429" not in RULES


def test_severities_are_ordered_from_the_worst() -> None:
    assert list(Severity) == [Severity.ERROR, Severity.WARNING, Severity.NOTE]
    assert {each.severity for each in RULES.values()} == set(Severity)
