"""What can be written at a place: it depends on the block that the place is in, and on what is wanted there."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from vicode.xabsl.declared import ENUM, Declared, Table
from vicode.xabsl.lexer import Tokens
from vicode.xabsl.server.behavior import Behavior
from vicode.xabsl.server.describing import doc_of, signature
from vicode.xabsl.tokens import NAME

_BLOCKS = frozenset(("option", "state", "decision", "action", "namespace", "behavior", "enum"))
_VALUES = ("true", "false", "state_time", "option_time", "action_done", "conflict")
_WORDS = {
    "": ("include", "option", "namespace", "agent"),
    "option": ("initial", "target", "state", "common", "float", "bool", "enum"),
    "state": ("decision", "action"),
    "decision": ("if", "else", "goto", "stay"),
    "namespace": ("float", "bool", "enum", "behavior", "const", "input", "output", "internal"),
    "behavior": ("float", "bool", "enum"),
}
TEMPLATES = {
    "option": "option ${1:name} {\n  initial state ${2:begin} {\n    decision {\n      ${3:stay;}\n    }\n"
    "    action {\n      $0\n    }\n  }\n}",
    "namespace": 'namespace ${1:name}("${2:Title}") {\n  $0\n}',
    "agent": 'agent ${1:name}("${2:Title}", ${3:option});',
    "state": "state ${1:name} {\n  decision {\n    ${2:stay;}\n  }\n  action {\n    $0\n  }\n}",
    "decision": "decision {\n  $0\n}",
    "action": "action {\n  $0\n}",
    "if": "if ($1)\n  $2\nelse\n  ${0:stay;}",
}


@dataclass(frozen=True, slots=True)
class Choice:
    """Something to write: `kind` is the role of a declaration or "word"; `snippet` has places to fill in."""

    name: str
    kind: str
    detail: str = ""
    doc: str = ""
    snippet: str = ""


@dataclass(slots=True)
class _Place:
    """Where something is to be written: the blocks around it, the option, and the last tokens before it."""

    blocks: list[str]
    option: str
    before: list[str]
    kinds: list[str]
    call: str = ""
    """What is called in the parentheses around it."""


def choices_at(behavior: Behavior, tokens: Tokens, offset: int) -> list[Choice]:
    """What can be written at a character; a word that ends there is being written."""
    place, table = _place_at(tokens, offset), behavior.compiled.table
    last = place.kinds[-1] if place.kinds else ""
    block = place.blocks[-1] if place.blocks else ""
    if last == "goto":
        option = table.options.get(place.option)
        return [_choice(each) for each in option.states.values()] if option else []
    if last == "enum":
        return [_choice(each) for each in table.enums.values()]
    if place.call:
        return list(_in_call(table, place))
    if block == "action" and last in ("{", ";"):
        return list(_beginnings(table))
    if block in ("decision", "action") and last not in ("{", ";", "else", ")"):
        return list(_values(table, place))
    return [_word(each) for each in _WORDS.get(block, ())]


def _in_call(table: Table, place: _Place) -> Iterator[Choice]:
    """In parentheses: parameters of what is called, or values for one; the conditions of `if` are values, too."""
    owner = _called(table, place.call)
    if place.kinds[-1] in ("(", ",") and owner is not None:
        for each in owner.parameters.values():
            choice = _choice(each)
            yield Choice(choice.name, choice.kind, choice.detail, choice.doc, f"{each.name} = ${{1}}")
    elif place.call == "agent":
        yield from (_choice(each) for each in table.options.values())
    else:
        yield from _values(table, place)


def _called(table: Table, name: str) -> Declared | None:
    found = [*table.callable.get(name, ()), *(each for each in table.readable.get(name, ()) if each.role == "input")]
    return found[0] if found else None


def _beginnings(table: Table) -> Iterator[Choice]:
    """What an action begins with."""
    for found in table.assignable.values():
        for each in found:
            choice = _choice(each)
            yield Choice(choice.name, choice.kind, choice.detail, choice.doc, f"{each.name} = ${{1}};")
    for each in (*table.options.values(), *table.behaviors.values()):
        given = ", ".join(f"{name} = ${{{at}}}" for at, name in enumerate(each.parameters, 1))
        choice = _choice(each)
        yield Choice(choice.name, choice.kind, choice.detail, choice.doc, f"{each.name}({given});")


def _values(table: Table, place: _Place) -> Iterator[Choice]:
    """What can be read: first the elements of the enumeration that is wanted."""
    yield from (_choice(each) for each in _wanted_elements(table, place))
    option = table.options.get(place.option)
    for each in option.parameters.values() if option else ():
        yield Choice(f"@{each.name}", "parameter", signature(each), doc_of(each))
    for each in table.symbols("input", "output", "internal", "const"):
        choice = _choice(each)
        given = ", ".join(f"{name} = ${{{at}}}" for at, name in enumerate(each.parameters, 1))
        yield Choice(each.name, choice.kind, choice.detail, choice.doc, f"{each.name}({given})" if given else "")
    yield from (_word(each) for each in _VALUES)


def _wanted_elements(table: Table, place: _Place) -> Iterable[Declared]:
    """The elements of the enumeration to the left of `=`, `==` or `!=`."""
    if len(place.before) < 2 or place.kinds[-1] not in ("=", "==", "!="):
        return ()
    name = place.before[-2]
    owner, option = _called(table, place.call), table.options.get(place.option)
    known = [*table.readable.get(name, ())]
    if place.kinds[-1] == "=" and owner is not None:
        known = [owner.parameters[name]] if name in owner.parameters else []
    if name.startswith("@") and option is not None:
        known = [option.parameters[name[1:]]] if name[1:] in option.parameters else []
    enums = [table.enums[each.enum] for each in known if each.kind == ENUM and each.enum in table.enums]
    return enums[0].elements.values() if enums else ()


def _place_at(tokens: Tokens, offset: int) -> _Place:
    place = _Place([], "", [], [])
    stack: list[str] = []
    calls: list[str] = []
    opening = ""
    for number, kind in enumerate(tokens.kinds):
        start, text = tokens.starts[number], tokens.texts[number]
        # The word that ends here is what is to be completed.
        if start >= offset or (start + len(text) >= offset and (kind == NAME or text.isalpha())):
            break
        if kind in _BLOCKS:
            opening = kind
            if kind == "option" and not stack:
                place.option = tokens.texts[number + 1] if number + 1 < len(tokens.texts) else ""
        elif kind == "{":
            stack.append(opening or (stack[-1] if stack else ""))
            opening = ""
        elif kind == "}" and stack:
            stack.pop()
        elif kind == "(":
            calls.append(_callee(tokens, number))
        elif kind == ")" and calls:
            calls.pop()
        elif kind == ";":
            calls.clear()
        place.before.append(text)
        place.kinds.append(kind)
    place.blocks, place.call = stack, calls[-1] if calls else ""
    return place


def _callee(tokens: Tokens, number: int) -> str:
    """What stands before an opening parenthesis: the name of what is called, `agent`, or `if`."""
    if number >= 2 and tokens.kinds[number - 2] == "agent":
        return "agent"
    before = number - 1
    if before >= 1 and tokens.kinds[before] in ("option", "behavior"):
        before -= 1
    return tokens.texts[before] if before >= 0 and tokens.kinds[before] in (NAME, "if") else "if"


def _choice(declared: Declared) -> Choice:
    return Choice(declared.name, declared.role, signature(declared), doc_of(declared))


def _word(word: str) -> Choice:
    return Choice(word, "word", snippet=TEMPLATES.get(word, ""))
