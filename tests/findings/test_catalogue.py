"""The rule catalogue: unique codes and names in a fixed format."""

import re

import pytest

from vicode.findings import RULES, Rule, Severity, get_rule
from vicode.findings.catalogue import RETIRED_CODES


def test_get_rule_returns_the_rule_of_a_code() -> None:
    assert get_rule("D421").name == "unreachable-state"
    with pytest.raises(KeyError):
        get_rule("D000")


def test_names_are_unique() -> None:
    names = [rule.name for rule in RULES.values()]
    assert len(set(names)) == len(RULES) > 0


@pytest.mark.parametrize("rule", RULES.values(), ids=lambda rule: rule.code)
def test_rules_are_well_formed(rule: Rule) -> None:
    assert re.fullmatch(r"[YPEDLGXS]\d{3}", rule.code)
    assert re.fullmatch(r"[a-z]+(-[a-z]+)*", rule.name)
    assert rule.summary[:1].islower() or rule.summary.startswith(("YAML", "Python"))
    assert not rule.summary.endswith(".")


def test_retired_codes_are_not_used_again() -> None:
    assert {"D417", "D429"} <= RETIRED_CODES
    assert not RETIRED_CODES & RULES.keys()


def test_severities_are_ordered_from_the_worst() -> None:
    assert list(Severity) == [Severity.ERROR, Severity.WARNING, Severity.NOTE]
    assert {rule.severity for rule in RULES.values()} == set(Severity)
