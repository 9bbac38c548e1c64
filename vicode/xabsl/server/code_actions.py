"""Quick fixes for findings: the change that the fix of a finding describes, where it is unambiguous."""

from bisect import bisect_right
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from lsprotocol import types as lsp

from vicode.findings import Finding
from vicode.xabsl import tree
from vicode.xabsl.parser import ParsedFile
from vicode.xabsl.server.language_server import diagnostic, finding_offset
from vicode.xabsl.server.open_behavior import OpenBehavior
from vicode.xabsl.server.positions import offset_at, range_at, uri_of
from vicode.xabsl.symbol_table import BOOLEAN, ENUM, Definition


@dataclass(frozen=True, slots=True)
class _Change:
    """A title for the menu of the editor, and the replacement of a range of characters."""

    title: str
    start: int
    end: int
    text: str


@dataclass(frozen=True, slots=True)
class _Case:
    """A finding in a file; `token` is the number of the token at its location."""

    behavior: OpenBehavior
    parsed: ParsedFile
    finding: Finding
    token: int

    def change(self, title: str, first: int, last: int, text: str) -> _Change:
        """Replace the tokens from `first` to `last`."""
        tokens = self.parsed.tokens
        return _Change(title, tokens.starts[first], tokens.starts[last] + len(tokens.texts[last]), text)

    def remove(self, title: str, first: int, last: int) -> _Change:
        """Remove tokens, and their lines if nothing else is in them."""
        text, change = self.parsed.tokens.text, self.change(title, first, last, "")
        line_start, line_end = text.rfind("\n", 0, change.start) + 1, text.find("\n", change.end) + 1
        if line_end and not text[line_start : change.start].strip() and not text[change.end : line_end].strip():
            return _Change(title, line_start, line_end, "")
        return change


def code_actions(behavior: OpenBehavior, path: Path, params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
    """The quick fixes of all findings that touch a range or that the editor names, such as those of the line."""
    parsed = behavior.source.files.get(path)
    if parsed is None:
        return []
    text, folder = parsed.tokens.text, behavior.source.main.parent
    first, last = offset_at(text, params.range.start), offset_at(text, params.range.end)
    named = {(each.code, each.range.start.line, each.range.start.character) for each in params.context.diagnostics}
    actions = []
    for finding in behavior.compiled.findings:
        if finding.location is None or (folder / finding.location.file).resolve() != path:
            continue
        start = finding_offset(text, finding.location)
        shown = diagnostic(finding, folder, text)
        place = (shown.code, shown.range.start.line, shown.range.start.character)
        if (start > last or start + finding.location.length < first) and place not in named:
            continue
        case = _Case(behavior, parsed, finding, bisect_right(parsed.tokens.starts, start) - 1)
        change = _find_change(case)
        if change is not None:
            edit = lsp.TextEdit(range=range_at(text, change.start, change.end), new_text=change.text)
            actions.append(
                lsp.CodeAction(
                    title=change.title,
                    kind=lsp.CodeActionKind.QuickFix,
                    diagnostics=[shown],
                    edit=lsp.WorkspaceEdit(changes={uri_of(path): [edit]}),
                    is_preferred=True,
                )
            )
    return actions


def _find_change(case: _Case) -> _Change | None:
    finding = case.finding
    if finding.suggestion:
        return _replace_name(case, finding.suggestion)
    find = _CHANGES.get(finding.rule.code)
    return find(case) if find else None


def _replace_name(case: _Case, name: str) -> _Change:
    old = case.parsed.tokens.texts[case.token]
    if old.startswith('"'):
        # The name of a file in the path of an include.
        head = old[1:-1].replace("\\", "/").rpartition("/")
        name = f'"{head[0]}{head[1]}{name}"'
    return case.change(f"Replace with {name}", case.token, case.token, name)


def _syntax(case: _Case) -> _Change | None:
    """Insert a missing semicolon or a missing last branch, or remove a superfluous mark."""
    tokens, message = case.parsed.tokens, case.finding.message
    previous = case.token - 1
    if message.startswith("expected ';'") and previous >= 0:
        end = tokens.starts[previous] + len(tokens.texts[previous])
        return _Change("Insert ;", end, end, ";")
    if message == "an if without else" and previous >= 0:
        end = tokens.starts[previous] + len(tokens.texts[previous])
        return _Change("Add else stay;", end, end, " else stay;")
    if case.finding.fix == "remove it" and tokens.kinds[case.token] in (",", ";"):
        return case.change(f"Remove {tokens.texts[case.token]}", case.token, case.token, "")
    return None


def _duplicate_include(case: _Case) -> _Change | None:
    for include in case.parsed.file.includes:
        if include.first_token <= case.token <= include.last_token:
            return case.remove("Remove the second include", include.first_token, include.last_token)
    return None


def _initial_state(case: _Case) -> _Change | None:
    option = _named(case, case.behavior.compiled.table.options.values())
    if option is None or not isinstance(option.node, tree.OptionNode) or not option.node.states:
        return None
    first = option.node.states[0]
    start = case.parsed.tokens.starts[first.first_token]
    return _Change(f"Make {first.name.text} the initial state", start, start, "initial ")


def _missing_else(case: _Case) -> _Change | None:
    tokens = case.parsed.tokens
    opening = next((n for n in range(case.token, len(tokens.kinds)) if tokens.kinds[n] == "{"), None)
    if opening is None or opening + 1 >= len(tokens.starts):
        return None
    start = tokens.starts[opening + 1]
    return _Change("Start the decision with else", start, start, "else ")


def _omitted_arguments(case: _Case) -> _Change | None:
    """Write the values that the engine uses for omitted arguments."""
    tokens, number = case.parsed.tokens, case.token
    callee_token = number if tokens.kinds[number] != "(" else number - 1
    if tokens.kinds[callee_token] in ("option", "behavior"):
        callee_token -= 1
    callee = next((each for token, each in case.behavior.references_in(tokens) if token == callee_token), None)
    if callee is None:
        return None
    if tokens.kinds[number] != "(":
        values = ", ".join(f"{each.name} = {_default(case, each)}" for each in callee.parameters.values())
        return case.change("Add the arguments", number, number, f"{tokens.texts[number]}({values})")
    closing, used = _arguments(case, number)
    missing = [each for each in callee.parameters.values() if each.name not in used]
    values = ", ".join(f"{each.name} = {_default(case, each)}" for each in missing)
    gap = ", " if used and tokens.kinds[closing - 1] != "," else ""
    return case.change(f"Add {', '.join(each.name for each in missing)}", closing, closing, f"{gap}{values})")


def _arguments(case: _Case, opening: int) -> tuple[int, set[str]]:
    """The closing parenthesis of a call, and the names of its arguments."""
    tokens, depth, used = case.parsed.tokens, 0, set[str]()
    for number in range(opening, len(tokens.kinds)):
        kind = tokens.kinds[number]
        depth += (kind == "(") - (kind == ")")
        if depth == 0:
            return number, used
        if depth == 1 and kind == "=":
            used.add(tokens.texts[number - 1])
    return len(tokens.kinds) - 1, used


def _default(case: _Case, parameter: Definition) -> str:
    if parameter.kind == BOOLEAN:
        return "false"
    if parameter.kind == ENUM:
        enum = case.behavior.compiled.table.enums.get(parameter.enum)
        return next(iter(enum.elements), "0") if enum else "0"
    return "0"


def _unreachable_state(case: _Case) -> _Change | None:
    for item in case.parsed.file.body:
        for state in item.states if isinstance(item, tree.OptionNode) else ():
            if state.name.first_token == case.token:
                return case.remove(f"Remove state {state.name.text}", state.first_token, state.last_token)
    return None


def _unused(case: _Case) -> _Change | None:
    for item in case.parsed.file.body:
        for declaration in item.declarations if isinstance(item, tree.NamespaceNode) else ():
            if declaration.name.first_token == case.token:
                name = declaration.name.text
                return case.remove(f"Remove {name}", declaration.first_token, declaration.last_token)
    return None


def _named(case: _Case, definitions: Iterable[Definition]) -> Definition | None:
    return next(
        (
            each
            for each in definitions
            if each.tokens is case.parsed.tokens and each.name_node.first_token == case.token
        ),
        None,
    )


_CHANGES: dict[str, Callable[[_Case], _Change | None]] = {
    "X604": _syntax,
    "X605": _syntax,
    "X608": _duplicate_include,
    "X628": _initial_state,
    "X641": _missing_else,
    "X642": _omitted_arguments,
    "X643": _unreachable_state,
    "X644": _unused,
    "X651": _syntax,
}
