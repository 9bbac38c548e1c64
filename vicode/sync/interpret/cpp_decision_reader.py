"""Reads the statements of `decide` in one state back as its decisions."""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from difflib import SequenceMatcher

from vicode.cpp_tokens import CppToken
from vicode.model.design import Decision, DecisionGroup, Guard, Stay, Transition
from vicode.model.disabled import strip_disabled_decision
from vicode.sync.interpret.cpp_expression_reader import (
    CppExpressionReader,
    UnreadableError,
    changed_guard,
    new_guard,
)
from vicode.sync.interpret.cpp_expressions import CppNode, parse_statement, path_of
from vicode.sync.interpret.cpp_plain_forms import PlainForms, comment_words
from vicode.sync.interpret.cpp_source import CppComment, CppIf, CppSimple, CppStatement, always_ends

_TO, _STAY, _GROUP = "to", "stay", "group"


@dataclass(frozen=True, slots=True)
class WrittenDecision:
    """A decision as it is written: its comment, its test (None: always), and what it does.

    `to` and `id` are the element of the enumeration and the id in `change_to(…)`.
    """

    kind: str
    form: object
    doc: str = ""
    test: tuple[CppToken, ...] | None = None
    to: str = ""
    id: str = ""
    then: "tuple[WrittenDecision, ...]" = ()
    otherwise: "tuple[WrittenDecision, ...]" = ()


@dataclass(frozen=True, slots=True)
class CppDecisionReader:
    """Reads the decisions of one state.

    Attributes:
        forms: The compared forms.
        expressions: Reads tests.
        disabled: The disabled states.
    """

    forms: PlainForms
    expressions: CppExpressionReader
    disabled: Collection[str]

    def read(
        self, items: Sequence[Decision], before: Sequence[CppStatement], after: Sequence[CppStatement]
    ) -> tuple[Decision, ...]:
        """Return decisions as they were changed.

        Args:
            items: The decisions of the design.
            before: The statements generated from them.
            after: The statements of the person.

        Raises:
            UnreadableError: A statement belongs to no decision.
        """
        return self._merge(items, tuple(self._written(before)), tuple(self._written(after)))

    def _written(self, statements: Sequence[CppStatement]) -> Iterator[WrittenDecision]:
        rest = list(statements)
        doc: str = ""
        notes: Sequence[CppToken] = ()
        while rest:
            first = rest.pop(0)
            match first:
                case CppComment(tokens=tokens):
                    if not rest or _returns(rest[0]) == "false":
                        raise UnreadableError(f"the comment '{' '.join(comment_words(tokens)[:5])}'")
                    doc, notes = _doc_of(tokens), tokens
                    continue
                case CppIf(otherwise=otherwise) if always_ends(first.then):
                    # What is tested after a branch that ends may stand behind it.
                    yield self._tested(replace(first, otherwise=()), doc, notes)
                    yield from self._written(otherwise)
                case CppIf():
                    yield self._tested(first, doc, notes)
                case CppSimple():
                    if _returns(first) == "false" and not rest:
                        return
                    yield replace(self._outcome(first, rest), doc=doc, form=("always", doc, first_texts(first)))
            doc, notes = "", ()

    def _tested(self, statement: CppIf, doc: str, notes: Sequence[CppToken]) -> WrittenDecision:
        if statement.comments:
            raise UnreadableError("a comment after 'if'")
        form = (comment_words(notes), self.forms.statements((statement,)))
        then = list(statement.then)
        first = then.pop(0) if then else None
        if isinstance(first, CppSimple) and not statement.otherwise:
            outcome = self._outcome(first, then)
            if not then:
                return replace(outcome, doc=doc, test=statement.test, form=form)
        return WrittenDecision(
            _GROUP,
            form,
            doc,
            statement.test,
            then=tuple(self._written(statement.then)),
            otherwise=tuple(self._written(statement.otherwise)),
        )

    def _outcome(self, first: CppSimple, rest: list[CppStatement]) -> WrittenDecision:
        """Read a change of the state, or none; takes the `return` behind it from the rest."""
        if _returns(first) in ("", "true"):
            return WrittenDecision(_STAY, ())
        match _parsed(first):
            case CppNode(kind="call", parts=(callee, CppNode(kind="name", text=text), *given)) if path_of(
                callee
            ) == "change_to" and text.startswith("State::"):
                id_ = given[0].text.strip('"') if given and given[0].kind == "text" else ""
                found = WrittenDecision(_TO, (), to=text.removeprefix("State::"), id=id_)
            case CppNode(kind="call", parts=(callee,)) if path_of(callee) == "stay":
                found = WrittenDecision(_STAY, ())
            case _:
                raise UnreadableError(" ".join(first_texts(first)))
        if not rest or _returns(rest.pop(0)) not in ("", "true"):
            raise UnreadableError("a state change without 'return' after it")
        return found

    def _merge(
        self, items: Sequence[Decision], before: Sequence[WrittenDecision], after: Sequence[WrittenDecision]
    ) -> tuple[Decision, ...]:
        parts = [*self._parts(items, before)]
        pairs = dict(_aligned([each.form for each in before], [each.form for each in after]))
        owners = {old: part for part in parts for old in range(part.first, part.last)}
        result: list[Decision] = []
        waiting = list(parts)
        at = 0
        while at < len(after):
            part = owners.get(pairs.get(at, -1))
            while part is not None and part in waiting:
                # Disabled decisions stay before the one that follows them.
                result += waiting.pop(0).disabled
            if part is not None and part.is_kept(before, after, pairs, at):
                result.append(part.item)
                at += part.last - part.first
            elif part is not None and (last := part.written_to(after, pairs, at)) > at + 1:
                result.append(self._nested(part, (before, after), pairs, (at, last)))
                at = last
            else:
                result.append(self._one(part, before, after[at], pairs.get(at, -1)))
                at += 1
        return (*result, *(item for part in waiting for item in part.disabled))

    def _nested(
        self,
        part: "_Part",
        written: tuple[Sequence[WrittenDecision], Sequence[WrittenDecision]],
        pairs: dict[int, int],
        places: tuple[int, int],
    ) -> Decision:
        """Return a group whose `else` stands behind it in the code."""
        (before, after), (at, last) = written, places
        head = self._one(part, before, after[at], pairs[at])
        assert isinstance(part.item, DecisionGroup)
        otherwise = self._merge(part.item.otherwise, before[part.first + 1 : part.last], after[at + 1 : last])
        return replace(head, otherwise=otherwise) if isinstance(head, DecisionGroup) else part.item

    def _one(
        self, part: "_Part | None", before: Sequence[WrittenDecision], written: WrittenDecision, old: int
    ) -> Decision:
        item = part.item if part is not None and part.first == old else None
        was = before[old] if item is not None else None
        guard = self._guard(item, was, written)
        doc = item.doc if item is not None and was is not None and was.doc == written.doc else written.doc
        id_ = written.id or (item.id if item is not None else "")
        is_off = item is not None and item.disabled
        if written.kind == _GROUP:
            olds = (item.then, item.otherwise) if isinstance(item, DecisionGroup) else ((), ())
            were = (was.then, was.otherwise) if was is not None and isinstance(item, DecisionGroup) else ((), ())
            return DecisionGroup(
                guard=guard,
                then=self._merge(olds[0], were[0], written.then),
                otherwise=self._merge(olds[1] if were[1] else (), were[1], written.otherwise),
                doc=doc,
                id=id_,
                disabled=is_off,
            )
        if written.kind == _STAY:
            if isinstance(item, Transition) and was is not None and was.kind == _STAY:
                return replace(item, guard=guard, doc=doc)
            return Stay(guard=guard, doc=doc, id=id_)
        to = self.expressions.symbols.states.get(written.to)
        if to is None:
            raise UnreadableError(f"State::{written.to}")
        place = item.label_at if isinstance(item, Transition) else None
        return Transition(to=to, guard=guard, doc=doc, id=id_, label_at=place)

    def _guard(self, item: Decision | None, was: WrittenDecision | None, written: WrittenDecision) -> Guard:
        if written.test is None:
            return Guard()
        read = self.expressions.read_guard(written.test)
        if item is None or was is None or was.test is None:
            return new_guard(read)
        return changed_guard(self.expressions, item.guard, was.test, read)

    def _parts(self, items: Sequence[Decision], written: Sequence[WrittenDecision]) -> Iterator["_Part"]:
        """Assign the written decisions to those of the design."""
        at = 0
        disabled: list[Decision] = []
        for item in items:
            enabled = strip_disabled_decision(item, self.disabled)
            if enabled is None:
                disabled.append(item)
                continue
            last = at + self._length(item, written[at:])
            if last > len(written):
                # A decision behind one that always holds is not generated.
                disabled.append(item)
                continue
            yield _Part(item, at, last, tuple(disabled))
            at, disabled = last, []
        if at != len(written) and not _is_report(written[at:]):
            raise UnreadableError("decisions in a form that cannot be mapped to those of the design")
        yield _Part(Stay(), at, len(written), tuple(disabled))

    def _length(self, item: Decision, written: Sequence[WrittenDecision]) -> int:
        """The number of written decisions of an item."""
        if not isinstance(item, DecisionGroup) or not written:
            return 1
        enabled = strip_disabled_decision(item, self.disabled)
        assert isinstance(enabled, DecisionGroup)
        if item.guard.is_empty:
            return sum(self._length(each, written) for each in enabled.then)
        is_flat = enabled.otherwise and not written[0].otherwise and written[0].kind == _GROUP
        if not is_flat and enabled.otherwise and written[0].kind != _GROUP:
            is_flat = True
        count, rest = 1, written[1:]
        for each in enabled.otherwise if is_flat else ():
            own = self._length(each, rest)
            count, rest = count + own, rest[own:]
        return count


@dataclass(frozen=True, slots=True)
class _Part:
    """A decision of the design with the written decisions from `first` to `last`, and the disabled ones before it."""

    item: Decision
    first: int
    last: int
    disabled: tuple[Decision, ...]

    def is_kept(
        self,
        before: Sequence[WrittenDecision],
        after: Sequence[WrittenDecision],
        pairs: dict[int, int],
        at: int,
    ) -> bool:
        """Whether the written decisions from an index on are those of this one."""
        own = range(self.first, self.last)
        return at + len(own) <= len(after) and all(
            pairs.get(at + step) == old and before[old].form == after[at + step].form for step, old in enumerate(own)
        )

    def written_to(self, after: Sequence[WrittenDecision], pairs: dict[int, int], at: int) -> int:
        """The end of the written decisions that belong to a group whose `else` stands behind it."""
        if self.last - self.first < 2 or not isinstance(self.item, DecisionGroup) or self.item.guard.is_empty:
            return at
        own = range(self.first, self.last)
        if pairs.get(at) != self.first:
            return at
        ends = [index for index in range(at, len(after)) if pairs.get(index, -1) in own]
        inner = [pairs.get(index, self.first) for index in range(at, ends[-1] + 1)]
        return ends[-1] + 1 if all(old in own for old in inner) else at


def _is_report(written: Sequence[WrittenDecision]) -> bool:
    """Whether a robot that stays in a cooperative state reports it."""
    return len(written) == 1 and written[0].kind == _STAY and written[0].test is None


def _aligned(before: Sequence[object], after: Sequence[object]) -> Iterator[tuple[int, int]]:
    """Yield pairs of indexes: of what was written, and what it was before."""
    matcher = SequenceMatcher(None, _hashed(before), _hashed(after), autojunk=False)
    for tag, first, last, start, end in matcher.get_opcodes():
        if tag in ("equal", "replace"):
            yield from zip(range(start, end), range(first, last), strict=False)


def _hashed(forms: Sequence[object]) -> list[str]:
    return [repr(form) for form in forms]


def _parsed(statement: CppSimple) -> CppNode | None:
    try:
        return parse_statement(statement.tokens)
    except SyntaxError:
        return None


def _returns(statement: CppStatement) -> str | None:
    """What a statement returns, "" for nothing; None for any other statement."""
    if not isinstance(statement, CppSimple) or statement.tokens[0].text != "return":
        return None
    texts = [token.text for token in statement.tokens[1:-1]]
    return texts[0] if len(texts) == 1 and texts[0] in ("true", "false") else None if texts else ""


def first_texts(statement: CppSimple) -> tuple[str, ...]:
    """Return the first tokens of a statement, to name it."""
    return tuple(token.text for token in statement.tokens[:12])


def _doc_of(tokens: Sequence[CppToken]) -> str:
    """Return the text of a comment: paragraphs are separated by an empty line."""
    paragraphs = " ".join(comment_words(tokens)).split("\n")
    return "\n\n".join(paragraph.strip() for paragraph in paragraphs if paragraph.strip())
