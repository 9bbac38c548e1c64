"""Completion: proposals depend on the enclosing block and on the expected value."""

import re
from bisect import bisect_left
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from vicode.xabsl.lexer import Tokens
from vicode.xabsl.server.hover import doc_comment, signature
from vicode.xabsl.server.open_behavior import OpenBehavior
from vicode.xabsl.symbol_table import ENUM, Definition, SymbolTable
from vicode.xabsl.tokens import DOC, HEADER, NAME, STRING

_BLOCKS = frozenset(("option", "state", "decision", "action", "namespace", "behavior", "enum"))
_COMPLETE_COMMENT = re.compile(r"//[^\n]*\n|/\*(?s:.*?)\*/")
_PREFIX = re.compile(r"@?[A-Za-z_][A-Za-z0-9_.]*\Z|@\Z")
_VALUES = ("true", "false", "state_time", "option_time", "action_done", "conflict")
_BLOCK_KEYWORDS = {
    "": ("include", "option", "namespace", "agent"),
    "option": ("initial", "target", "state", "common", "float", "bool", "enum"),
    "state": ("decision", "action"),
    "decision": ("if", "else", "goto", "stay"),
    "namespace": ("float", "bool", "enum", "behavior", "const", "input", "output", "internal"),
    "behavior": ("float", "bool", "enum"),
}
SNIPPETS = {
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
class CompletionProposal:
    """A completion; `kind` is the role of a definition or "word", `snippet` the text with placeholders."""

    name: str
    kind: str
    detail: str = ""
    doc: str = ""
    snippet: str = ""


@dataclass(slots=True)
class _CompletionContext:
    """The context of a position: enclosing blocks, option and preceding tokens."""

    blocks: list[str]
    option: str
    texts: list[str]
    kinds: list[str]
    call: str = ""
    """The callee of the enclosing parentheses."""
    prefix: str = ""


def find_prefix(text: str, offset: int) -> str:
    """The part of a name before a character, with its dots."""
    match = _PREFIX.search(text, text.rfind("\n", 0, offset) + 1, offset)
    return match[0] if match else ""


def complete_at(behavior: OpenBehavior, tokens: Tokens, offset: int) -> list[CompletionProposal]:
    """Completions at a character; the word that ends there is the prefix."""
    if _is_in_comment_or_string(tokens, offset):
        return []
    context, table = _context_at(tokens, offset), behavior.compiled.table
    context.prefix = find_prefix(tokens.text, offset)
    last = context.kinds[-1] if context.kinds else ""
    block = context.blocks[-1] if context.blocks else ""
    if last == "goto":
        option = table.options.get(context.option)
        return [_definition_proposal(state) for state in option.states.values()] if option else []
    if last == "enum":
        return [_definition_proposal(enum) for enum in table.enums.values()]
    if context.call:
        return list(_argument_proposals(table, context))
    if block == "action" and last in ("{", ";"):
        return list(_action_proposals(table))
    if block in ("decision", "action") and last not in ("{", ";", "else", ")"):
        return list(_value_proposals(table, context))
    return [_keyword_proposal(keyword) for keyword in _BLOCK_KEYWORDS.get(block, ())]


def _is_in_comment_or_string(tokens: Tokens, offset: int) -> bool:
    last = bisect_left(tokens.starts, offset) - 1
    if last < 0:
        between = tokens.text[:offset]
    else:
        end = tokens.starts[last] + len(tokens.texts[last])
        if tokens.kinds[last] in (STRING, DOC, HEADER) and offset < end:
            return True
        between = tokens.text[end:offset]
    rest = _COMPLETE_COMMENT.sub("", between)
    return "//" in rest or "/*" in rest


def _argument_proposals(table: SymbolTable, context: _CompletionContext) -> Iterator[CompletionProposal]:
    """Proposals inside parentheses: parameters of the callee, or values for a parameter or a condition."""
    owner = find_callee(table, context.call)
    if context.kinds[-1] in ("(", ",") and owner is not None:
        for parameter in owner.parameters.values():
            proposal = _definition_proposal(parameter)
            yield CompletionProposal(
                proposal.name, proposal.kind, proposal.detail, proposal.doc, f"{parameter.name} = ${{1}}"
            )
    elif context.call == "agent":
        yield from (_definition_proposal(candidate) for candidate in table.options.values())
    else:
        yield from _value_proposals(table, context)


def find_callee(table: SymbolTable, name: str) -> Definition | None:
    callees = [
        *table.callable.get(name, ()),
        *(definition for definition in table.readable.get(name, ()) if definition.role == "input"),
    ]
    return callees[0] if callees else None


def _action_proposals(table: SymbolTable) -> Iterator[CompletionProposal]:
    for definitions in table.assignable.values():
        for definition in definitions:
            proposal = _definition_proposal(definition)
            yield CompletionProposal(
                proposal.name, proposal.kind, proposal.detail, proposal.doc, f"{definition.name} = ${{1}};"
            )
    for definition in (*table.options.values(), *table.behaviors.values()):
        placeholders = ", ".join(f"{name} = ${{{index}}}" for index, name in enumerate(definition.parameters, 1))
        proposal = _definition_proposal(definition)
        yield CompletionProposal(
            proposal.name, proposal.kind, proposal.detail, proposal.doc, f"{definition.name}({placeholders});"
        )


def _value_proposals(table: SymbolTable, context: _CompletionContext) -> Iterator[CompletionProposal]:
    """Proposals for values: first the elements of the expected enumeration, then symbols that can be read."""
    yield from (_definition_proposal(element) for element in _expected_elements(table, context))
    for enum in table.enums.values():
        if context.prefix and f"{enum.name}.".startswith(context.prefix.partition(".")[0]):
            for element in enum.elements.values():
                proposal = _definition_proposal(element)
                yield replace(proposal, name=f"{enum.name}.{element.name}")
    option = table.options.get(context.option)
    for parameter in option.parameters.values() if option else ():
        yield CompletionProposal(f"@{parameter.name}", "parameter", signature(parameter), doc_comment(parameter))
    for symbol in table.symbols("input", "output", "internal", "const"):
        proposal = _definition_proposal(symbol)
        placeholders = ", ".join(f"{name} = ${{{index}}}" for index, name in enumerate(symbol.parameters, 1))
        yield CompletionProposal(
            symbol.name,
            proposal.kind,
            proposal.detail,
            proposal.doc,
            f"{symbol.name}({placeholders})" if placeholders else "",
        )
    yield from (_keyword_proposal(keyword) for keyword in _VALUES)


def _expected_elements(table: SymbolTable, context: _CompletionContext) -> Iterable[Definition]:
    """The elements of the enumeration to the left of `=`, `==` or `!=`."""
    if len(context.texts) < 2 or context.kinds[-1] not in ("=", "==", "!="):
        return ()
    name = context.texts[-2]
    owner, option = find_callee(table, context.call), table.options.get(context.option)
    candidates = [*table.readable.get(name, ())]
    if context.kinds[-1] == "=" and owner is not None:
        candidates = [owner.parameters[name]] if name in owner.parameters else []
    if name.startswith("@") and option is not None:
        candidates = [option.parameters[name[1:]]] if name[1:] in option.parameters else []
    enums = [
        table.enums[candidate.enum]
        for candidate in candidates
        if candidate.kind == ENUM and candidate.enum in table.enums
    ]
    return enums[0].elements.values() if enums else ()


def _context_at(tokens: Tokens, offset: int) -> _CompletionContext:
    context = _CompletionContext([], "", [], [])
    stack: list[str] = []
    calls: list[str] = []
    opening = ""
    for number, kind in enumerate(tokens.kinds):
        start, text = tokens.starts[number], tokens.texts[number]
        # The word that ends here is the prefix of the completion.
        if start >= offset or (start + len(text) >= offset and (kind == NAME or text.isalpha())):
            break
        if kind in _BLOCKS:
            opening = kind
            if kind == "option" and not stack:
                context.option = tokens.texts[number + 1] if number + 1 < len(tokens.texts) else ""
        elif kind == "{":
            stack.append(opening or (stack[-1] if stack else ""))
            opening = ""
        elif kind == "}" and stack:
            stack.pop()
        elif kind == "(":
            calls.append(callee_name(tokens, number))
        elif kind == ")" and calls:
            calls.pop()
        elif kind == ";":
            calls.clear()
        context.texts.append(text)
        context.kinds.append(kind)
    context.blocks, context.call = stack, calls[-1] if calls else ""
    return context


def callee_name(tokens: Tokens, number: int) -> str:
    """The name before an opening parenthesis: a callee, `agent` or `if`."""
    if number >= 2 and tokens.kinds[number - 2] == "agent":
        return "agent"
    before = number - 1
    if before >= 1 and tokens.kinds[before] in ("option", "behavior"):
        before -= 1
    return tokens.texts[before] if before >= 0 and tokens.kinds[before] in (NAME, "if") else "if"


def _definition_proposal(definition: Definition) -> CompletionProposal:
    return CompletionProposal(definition.name, definition.role, signature(definition), doc_comment(definition))


def _keyword_proposal(keyword: str) -> CompletionProposal:
    return CompletionProposal(keyword, "word", snippet=SNIPPETS.get(keyword, ""))
