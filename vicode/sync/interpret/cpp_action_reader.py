"""Reads the statements of `act`, `enter` and `leave` in one state back as its actions."""

import re
import textwrap
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field, replace
from difflib import SequenceMatcher

from vicode.cpp_tokens import COMMENT, DIRECTIVE, STRING, WORD, CppToken
from vicode.model.design import Action, Assign, Call, Code, RunCode
from vicode.model.edits import unique_name
from vicode.sync.interpret.cpp_expression_reader import CppExpressionReader, UnreadableError
from vicode.sync.interpret.cpp_expressions import CppNode, parse_statement, path_of
from vicode.sync.interpret.cpp_plain_forms import PlainForm, PlainForms, called_action
from vicode.sync.interpret.cpp_source import CppComment, CppStatement

_LEAVING = frozenset({"return", "break", "continue", "goto", "case", "default", "co_return", "co_await", "co_yield"})
_GENERATED_NAME = re.compile(r"(do|when|in|decide|act)_\w+|__\w+|state_|calls_")


@dataclass(frozen=True, slots=True)
class _Origin:
    """An action of the design that a statement belongs to; `value` is the number of its assignment."""

    action: Action
    value: int = 0
    is_modulation: bool = False


@dataclass(frozen=True, slots=True)
class _Step:
    """A statement as it is written, and where it comes from."""

    form: PlainForm
    tokens: tuple[CppToken, ...]
    is_comment: bool = False


@dataclass(frozen=True, slots=True)
class _Found:
    """An action that was read from one statement, with its origin."""

    action: Action
    origin: _Origin | None = None


@dataclass(frozen=True, slots=True)
class ReadActions:
    """The actions of a state, and the calls that follow them."""

    actions: tuple[Action, ...]
    modulates: tuple[Call, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class CppActionReader:
    """Reads actions.

    Attributes:
        forms: The compared forms.
        expressions: Reads values.
        text: The edited file.
        known: The names that hand-written code may use.
        kept: The functions that the edited file has.
        may_add_code: Whether statements may become hand-written code.
        taken_ids: The ids of actions and decisions.
    """

    forms: PlainForms
    expressions: CppExpressionReader
    text: str
    known: Collection[str]
    kept: Collection[str]
    may_add_code: bool
    taken_ids: Collection[str]
    prefix: str = field(default="code")

    def read(
        self,
        actions: Sequence[Action],
        modulates: Sequence[Call],
        before: Sequence[CppStatement],
        after: Sequence[CppStatement],
    ) -> ReadActions:
        """Return actions as they were changed.

        Raises:
            UnreadableError: A statement is no action.
        """
        origins = [*_origins(actions, is_modulation=False), *_origins(modulates, is_modulation=True)]
        olds, news = self._steps(before), self._steps(after)
        if len(origins) != len(olds):
            raise UnreadableError("actions in a form that cannot be mapped to those of the design")
        pairs = _aligned(olds, news)
        self._require_code(olds, news)
        found = list(self._read_all(origins, olds, news, pairs))
        return _split(_joined(self._with_ids(found)))

    def _steps(self, statements: Sequence[CppStatement]) -> list[_Step]:
        return [
            _Step(form, each.tokens, isinstance(each, CppComment))
            for each in statements
            for form in [(self.forms.statements((each,)) or ((),))[0]]
        ]

    def _require_code(self, olds: Sequence[_Step], news: Sequence[_Step]) -> None:
        """Refuse to remove the call of hand-written code that is still there."""
        present = [called_action(step.form) for step in news]
        for step in olds:
            name = called_action(step.form)
            if name.startswith("do_") and name not in present and name in self.kept:
                raise UnreadableError(f"the call of {name}() was removed, but its code was not")

    def _read_all(
        self,
        origins: Sequence[_Origin],
        olds: Sequence[_Step],
        news: Sequence[_Step],
        pairs: dict[int, int],
    ) -> Iterator[_Found]:
        waiting: list[int] = []
        for at, step in enumerate(news):
            old = pairs.get(at)
            found = self._read(step, None if old is None else origins[old], None if old is None else olds[old])
            if found is None:
                waiting.append(at)
                continue
            if waiting:
                yield self._code(news, waiting)
                waiting = []
            yield found
        if waiting:
            yield self._code(news, waiting)

    def _read(self, step: _Step, origin: _Origin | None, old: _Step | None) -> _Found | None:
        """Read one statement; None for hand-written code."""
        if origin is not None and old is not None and old.form == step.form:
            return _Found(origin.action, origin)
        if step.is_comment:
            return None
        try:
            node = parse_statement(step.tokens)
        except SyntaxError:
            return None
        was = _parsed(old)
        return self._set(node, origin, was) or self._component_call(node, origin, was)

    def _set(self, node: CppNode, origin: _Origin | None, was: CppNode | None) -> _Found | None:
        found = self._assignment(node)
        if found is None:
            return None
        name, value = found
        old = self._assignment(was) if was is not None else None
        action = origin.action if origin is not None else None
        if origin is not None and isinstance(action, Assign) and old is not None and old[0] == name:
            pair = (name, self.expressions.read_value(action.values[origin.value][1], old[1], value))
            values = tuple(pair if at == origin.value else each for at, each in enumerate(action.values))
            return _Found(replace(action, values=values), replace(origin, action=replace(action, values=values)))
        return _Found(Assign(values=((name, self.expressions.text_of(value)),)))

    def _assignment(self, node: CppNode) -> tuple[str, CppNode] | None:
        """Return the variable that a statement sets, and its value."""
        names = self.expressions.symbols.assignable
        match node:
            case CppNode(kind="assign", text=operator, parts=(target, value)) if path_of(target) in names:
                whole = value if operator == "=" else CppNode("binary", operator[0], (target, value))
                return names[path_of(target)], whole
            case CppNode(kind="call", parts=(callee, value)) if f"{path_of(callee)}(" in names:
                return names[f"{path_of(callee)}("], value
            case _:
                return None

    def _component_call(self, node: CppNode, origin: _Origin | None, was: CppNode | None) -> _Found | None:
        found = self._arguments(node)
        if found is None:
            return None
        path, values = found
        alias, declared = self.expressions.symbols.aliases[path], self.expressions.symbols.arguments[path]
        before = self._arguments(was) if was is not None else None
        if origin is None or not isinstance(origin.action, Call) or before is None or before[0] != path:
            given = zip((name for name, _type in declared), values, strict=False)
            return _Found(Call(alias=alias, arguments=tuple((n, self.expressions.text_of(v)) for n, v in given)))
        call = self._changed_call(origin.action, declared, before[1], values)
        return _Found(call, replace(origin, action=call))

    def _changed_call(
        self,
        call: Call,
        declared: Sequence[tuple[str, str]],
        before: Sequence[CppNode],
        after: Sequence[CppNode],
    ) -> Call:
        old = dict(call.arguments)
        new: dict[str, str] = {}
        for at, (name, _type) in enumerate(declared[: len(after)]):
            is_same = at < len(before) and self.forms.typed(before[at]) == self.forms.typed(after[at])
            if name in old:
                same = old[name] if is_same else ""
                was = before[at] if at < len(before) else after[at]
                new[name] = same or self.expressions.read_value(old[name], was, after[at])
            elif not is_same:
                new[name] = self.expressions.text_of(after[at])
        ordered = [name for name, _text in call.arguments if name in new]
        ordered += [name for name in new if name not in old]
        return replace(call, arguments=tuple((name, new[name]) for name in ordered))

    def _arguments(self, node: CppNode) -> tuple[str, tuple[CppNode, ...]] | None:
        match node:
            case CppNode(kind="call", parts=(callee, target, CppNode(kind="list", parts=values), *_stored)) if (
                path_of(callee) == "call" and path_of(target) in self.expressions.symbols.aliases
            ):
                return path_of(target), values
            case _:
                return None

    def _code(self, news: Sequence[_Step], places: Sequence[int]) -> _Found:
        """Return statements as hand-written code."""
        tokens = [token for at in places for token in news[at].tokens]
        others = [token for at, step in enumerate(news) if at not in places for token in step.tokens]
        words = [token for token in tokens if token.kind == WORD]
        shown = " ".join(token.text for token in tokens[:8])
        declared = _declared(tokens)
        is_fixed = any(
            token.text in _LEAVING or _GENERATED_NAME.fullmatch(token.text) or token.kind == DIRECTIVE
            for token in tokens
        )
        is_multiline = any(token.kind == STRING and "\n" in token.text for token in tokens)
        is_shared = declared & ({token.text for token in others} | set(self.expressions.symbols.types))
        if not self.may_add_code or not words or is_fixed or is_multiline or is_shared:
            raise UnreadableError(shown)
        unknown = find_unknown_words(tokens, self.known)
        if unknown:
            raise UnreadableError(f"{min(unknown)} in '{shown}'")
        start = self.text.rfind("\n", 0, tokens[0].start) + 1
        body = textwrap.dedent(self.text[start : tokens[-1].end].expandtabs(4))
        return _Found(RunCode(code=Code(texts=(("cpp", body.strip("\n") + "\n" * ("\n" in body)),))))

    def _with_ids(self, found: Sequence[_Found]) -> list[_Found]:
        """Give new code before old code an id: the functions of the old code keep their names."""
        olds = [at for at, each in enumerate(found) if isinstance(each.action, RunCode) and each.origin is not None]
        taken = set(self.taken_ids)
        result: list[_Found] = []
        for at, each in enumerate(found):
            changed = each
            if isinstance(each.action, RunCode) and each.origin is None and any(old > at for old in olds):
                name = unique_name(self.prefix, taken)
                taken.add(name)
                changed = replace(each, action=replace(each.action, id=name))
            result.append(changed)
        return result


def _origins(actions: Sequence[Action], *, is_modulation: bool) -> Iterator[_Origin]:
    for action in actions:
        count = len(action.values) if isinstance(action, Assign) else 1
        yield from (_Origin(action, value, is_modulation) for value in range(count))


def _aligned(olds: Sequence[_Step], news: Sequence[_Step]) -> dict[int, int]:
    """Return the old statement of each new one: the same one, or the one in its place."""
    keys = [[repr(step.form) for step in steps] for steps in (olds, news)]
    pairs: dict[int, int] = {}
    replaced: list[tuple[int, int]] = []
    for tag, first, last, start, end in SequenceMatcher(None, keys[0], keys[1], autojunk=False).get_opcodes():
        places = list(zip(range(start, end), range(first, last), strict=False))
        if tag == "equal":
            pairs |= dict(places)
        elif tag == "replace":
            replaced += places
    used = set(pairs.values())
    for new, key in enumerate(keys[1]):
        old = next((at for at, each in enumerate(keys[0]) if each == key and at not in used), None)
        if new not in pairs and old is not None:
            pairs[new] = old
            used.add(old)
    return pairs | {new: old for new, old in replaced if new not in pairs and old not in used}


def _parsed(step: _Step | None) -> CppNode | None:
    if step is None:
        return None
    try:
        return parse_statement(step.tokens)
    except SyntaxError:
        return None


def _joined(found: Sequence[_Found]) -> list[_Found]:
    """Join the assignments of one action again, and new ones in a row."""
    result: list[_Found] = []
    for each in found:
        pairs = _values(each)
        last = result[-1] if result else None
        if pairs and last is not None and isinstance(last.action, Assign) and _is_together(last, each):
            result[-1] = replace(last, action=Assign(values=(*last.action.values, *pairs)))
        elif pairs:
            result.append(replace(each, action=Assign(values=pairs)))
        else:
            result.append(each)
    return result


def _values(found: _Found) -> tuple[tuple[str, str], ...]:
    if not isinstance(found.action, Assign):
        return ()
    return found.action.values if found.origin is None else (found.action.values[found.origin.value],)


def _is_together(before: _Found, found: _Found) -> bool:
    if before.origin is None or found.origin is None:
        return before.origin is None and found.origin is None
    olds = [each.origin.action for each in (before, found) if each.origin is not None]
    names = [[name for name, _text in each.values] for each in olds if isinstance(each, Assign)]
    return len(names) == 2 and names[0] == names[1] and before.origin.value < found.origin.value


def _split(found: Sequence[_Found]) -> ReadActions:
    """Return the calls at the end as modulations, unless they were actions before."""
    first = len(found)
    aliases: set[str] = set()
    while first > 0:
        each = found[first - 1]
        is_old_action = each.origin is not None and not each.origin.is_modulation
        if not isinstance(each.action, Call) or is_old_action or each.action.alias in aliases:
            break
        aliases.add(each.action.alias)
        first -= 1
    calls = (each.action for each in found[first:])
    return ReadActions(
        tuple(each.action for each in found[:first]), tuple(call for call in calls if isinstance(call, Call))
    )


def _declared(tokens: Sequence[CppToken]) -> set[str]:
    """Return the names that code declares, and perhaps others: words behind a type, or in the brackets of `auto`."""
    found: set[str] = set()
    words = [token for token in tokens if token.kind != COMMENT]
    for at, token in enumerate(words[1:], start=1):
        before = words[at - 1]
        is_type = before.kind == WORD and before.text not in ("else", "do", "new", "delete", "throw")
        if token.kind == WORD and (is_type or before.text in ("*", "&", ">", "&&")):
            found.add(token.text)
        if token.text == "[" and "auto" in [each.text for each in words[max(0, at - 3) : at]]:
            closing = next((end for end in range(at, len(words)) if words[end].text == "]"), at)
            found |= {each.text for each in words[at:closing] if each.kind == WORD}
    return found


def find_unknown_words(tokens: Sequence[CppToken], known: Collection[str]) -> set[str]:
    """Return the names that code uses and does not declare, except those of members of something."""
    words = [token for token in tokens if token.kind != COMMENT]
    used = {
        token.text
        for at, token in enumerate(words)
        if token.kind == WORD and (at == 0 or words[at - 1].text not in (".", "->", "::"))
    }
    return used - _declared(tokens) - set(known)
