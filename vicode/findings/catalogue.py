"""The catalogue of rules: one line each, the code never used again for another meaning."""

from dataclasses import dataclass
from enum import StrEnum


class Severity(StrEnum):
    """How bad a finding is, the worst first."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule:
    """A promise that designs keep; `code` and `name` are its address in docs/rules.md."""

    code: str
    name: str
    severity: Severity
    summary: str


def get_rule(code: str) -> Rule:
    """The rule with this code; KeyError is a bug of ours."""
    return RULES[code]


_ERRORS = {
    # Reading the text of files
    "Y101": ("not-yaml", "the text is not YAML"),
    "Y102": ("unknown-key", "a key that means nothing here"),
    "Y103": ("wrong-shape", "a value of another shape than expected here"),
    "Y104": ("missing-key", "a key that must be given"),
    "Y105": ("duplicate-key", "the same key twice in one mapping"),
    "Y106": ("refused-tag", "a YAML tag; only plain values are read"),
    "Y107": ("refused-alias", "YAML anchors and aliases are not read"),
    "Y108": ("too-large", "the file is larger or deeper than any design"),
    "Y109": ("wrong-version", "a version of the format that is not known"),
    "Y110": ("not-text", "the file cannot be read as UTF-8 text"),
    "Y111": ("conflicting-keys", "keys that exclude each other"),
    "Y112": ("several-documents", "more than one YAML document in a file"),
    # A project of designs
    "P201": ("duplicate-component", "two components with one name"),
    "P202": ("unknown-component", "a component that nothing in the project declares"),
    "P203": ("bad-implementation", "an implementation that is not written module:Class"),
    "P204": ("unknown-language", "a language vicode does not generate"),
    "P205": ("unknown-type", "a type that is neither bool, int, float nor an enumeration"),
    "P206": ("bad-range", "a range whose ends are swapped, or on something that is not a number"),
    "P207": ("empty-enumeration", "an enumeration without elements"),
    "P208": ("unusable-project-name", "a project whose Python package cannot be imported or hides another module"),
    # Expressions
    "E301": ("not-an-expression", "text that is not an expression"),
    "E302": ("outside-grammar", "Python that expressions do not allow"),
    "E303": ("unknown-name", "a name that is not declared"),
    "E304": ("wrong-type", "a value of the wrong type"),
    "E305": ("wrong-arguments", "a function called with the wrong arguments"),
    "E306": ("unknown-element", "a literal that the enumeration does not have"),
    "E307": ("not-settable", "setting what cannot be set here"),
    "E308": ("not-constant", "a first value that is not known before the component runs"),
    "E309": ("bad-time", "a time that is neither a number of seconds from 0 up nor a constant"),
    # The structure of a design
    "D401": ("no-initial-state", "a design without a valid initial state"),
    "D402": ("unknown-state", "a transition to a state that does not exist"),
    "D403": ("unknown-use", "a component used under a name that is not declared in uses"),
    "D404": ("bad-name", "a name that is not letters, digits and underscores"),
    "D405": ("reserved-name", "a name that the runtime keeps for itself"),
    "D406": ("keyword-name", "a name that is a keyword in a language of the project"),
    "D407": ("duplicate-name", "one name for two things"),
    "D408": ("uses-cycle", "components that use each other in a circle"),
    "D409": ("unknown-parameter", "a call with a parameter that the component does not have"),
    "D410": ("misplaced-call", "a call of a component outside actions"),
    "D411": ("no-states", "a design without states"),
    "D412": ("code-does-not-parse", "code that the language's parser refuses"),
    "D413": ("duplicate-id", "two things with one id"),
    "D414": ("missing-language", "code that is missing in a language of the project"),
    "D415": ("empty-code", "a predicate without code"),
    "D416": ("bad-frequency", "a frequency that is not above 0"),
    "D418": ("disabled-initial-state", "an initial state that is disabled"),
    # What a language of the project cannot say
    "L701": ("not-in-xabsl", "something that XABSL cannot say"),
    "L702": ("other-result-in-xabsl", "an expression that gives another result in XABSL"),
    "L703": ("bad-xabsl-name", "a name that XABSL cannot have, or that two things would have there"),
    "L704": ("code-is-not-xabsl", "code in XABSL that its parser refuses"),
    # Generated files
    "G501": ("edited-outside", "a generated file whose code was edited by hand"),
    "G502": ("stale-output", "a generated file that is not what the design gives"),
    "G503": ("broken-marks", "region marks that do not match"),
    # Reading the files of an XABSL behavior
    "X601": ("illegal-character", "a character that no word of the language has, or a text that is never closed"),
    "X602": ("open-comment", "a comment that is never closed"),
    "X603": ("stray-comment-end", "the end of a comment that was not begun"),
    "X604": ("not-xabsl", "words in an order that the language does not have"),
    "X605": ("unexpected-end", "a file that ends too early"),
    "X606": ("missing-file", "an include of a file that cannot be read"),
    "X607": ("wrong-extension", "a file whose name does not end in .xabsl"),
    "X609": ("nothing-defined", "a file, or a behavior, without what it is there for"),
    "X610": ("several-definitions", "more than one option or namespace in a file, or agents in two"),
    # What an XABSL behavior declares and means
    "X621": ("unknown-word", "a name that nothing declares here"),
    "X622": ("ambiguous-word", "a name that may mean two things"),
    "X623": ("declared-twice", "two declarations of one kind with one name"),
    "X624": ("wrong-use", "a symbol that cannot be used so"),
    "X625": ("wrong-kind", "a decimal, bool or enum where another is wanted"),
    "X626": ("wrong-enumeration", "a value of another enumeration"),
    "X627": ("given-twice", "a parameter that is given twice in a call"),
    "X628": ("no-initial", "an option without initial state"),
    "X629": ("two-initials", "an option with more than one initial state"),
    "X630": ("mixed-namespace", "symbols and basic behaviors in one namespace"),
    "X632": ("needless-else", "a decision that begins with else where no common decision is"),
    "X633": ("stay-in-common", "stay in a common decision"),
    "X635": ("parameter-without-at", "a parameter of an option without @"),
    "X636": ("option-cycle", "options that call each other in a circle"),
}

_WARNINGS = {
    "D421": ("unreachable-state", "a state that no way leads to"),
    "D422": ("trap-state", "a state without exit that is not final"),
    "D423": ("dead-transition", "a transition after one that always holds"),
    "D424": ("unused-declaration", "something declared that nothing uses"),
    "D425": ("stepped-twice", "a component that may be stepped twice in an iteration"),
    "D426": ("never-stepped", "a component that is read, but that nobody steps here"),
    "D427": ("outside-range", "a literal outside the declared range"),
    "X608": ("included-twice", "one file included twice by another"),
    "X631": ("empty-namespace", "a namespace that declares nothing"),
    "X634": ("needless-range", "a range or unit of something that is no decimal"),
    "X643": ("unreached-state", "a state that no decision leads to"),
    "X645": ("never-set", "an internal symbol that is read, and that no action sets"),
    "X646": ("out-of-range", "a number outside the declared range"),
    "X647": ("active-twice", "an option that may be executed twice in a cycle"),
    "X641": ("missing-else", "a decision that does not begin with else, though a common one goes before it"),
    "D428": ("unused-use", "a used component that no state requires, modulates or reads"),
}

_NOTES = {
    "X644": ("unused-word", "something declared that nothing uses"),
    "X642": ("not-given", "a parameter that a call does not give"),
    "X652": ("bool-choice", "a choice between bools, which no original engine reads"),
    "X651": ("slip", "a spelling that the original compiler does not read"),
    "D430": ("no-effect", "a transition that changes nothing"),
}


def _build_catalogue() -> dict[str, Rule]:
    tables = ((Severity.ERROR, _ERRORS), (Severity.WARNING, _WARNINGS), (Severity.NOTE, _NOTES))
    return {
        code: Rule(code=code, name=name, severity=severity, summary=summary)
        for severity, table in tables
        for code, (name, summary) in table.items()
    }


RULES = _build_catalogue()
