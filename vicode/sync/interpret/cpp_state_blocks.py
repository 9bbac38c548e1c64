"""Splits the body of a C++ function at its switch over the state."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from vicode.cpp_tokens import COMMENT, CppToken
from vicode.sync.interpret.cpp_source import PAIRS, CppComment, Tokens, always_ends, matching, split_statements


@dataclass(frozen=True, slots=True, kw_only=True)
class StateBlocks:
    """A function as what it does in each state: before the switch over the state, in the cases, and behind it.

    Attributes:
        head: The tokens before the switch.
        cases: The tokens of the cases by the name of the state, without `break`; None if there is no switch.
        tail: The tokens behind the switch.
    """

    head: tuple[CppToken, ...]
    cases: Mapping[str, tuple[CppToken, ...]] | None = None
    tail: tuple[CppToken, ...] = ()

    def case(self, state: str) -> tuple[CppToken, ...]:
        """Return the tokens of the case of a state; empty without one."""
        return () if self.cases is None else self.cases.get(state, ())


def split_states(body: Tokens) -> StateBlocks:
    """Split the body of a function at its switch over the state.

    Raises:
        SyntaxError: The switch has cases that continue in the next one, or statements for other states.
    """
    depth = 0
    for at, token in enumerate(body):
        depth += (token.text in PAIRS) - (token.text in PAIRS.values())
        if depth == 0 and token.text == "switch":
            opening = matching(body, at + 1) + 1
            closing = matching(body, opening)
            subject = "".join(each.text for each in body[at + 2 : opening - 1])
            if subject in ("state_", "state", "next") and not any(each.text == "switch" for each in body[closing:]):
                cases = _split_cases(body[opening + 1 : closing])
                return StateBlocks(head=tuple(body[:at]), cases=cases, tail=tuple(body[closing + 1 :]))
    return StateBlocks(head=tuple(body))


def _split_cases(tokens: Tokens) -> dict[str, tuple[CppToken, ...]]:
    cases: dict[str, tuple[CppToken, ...]] = {}
    names: list[str] = []
    block: list[CppToken] = []
    at = 0
    while at < len(tokens):
        label = _label(tokens, at)
        if label is None:
            end = matching(tokens, at) if tokens[at].text in PAIRS else at
            if not names:
                raise SyntaxError("statements before the first case")
            block += tokens[at : end + 1]
            at = end + 1
            continue
        if any(each.kind != COMMENT for each in block):
            _add_case(cases, names, block)
            names, block = [], []
        elif block:
            raise SyntaxError("a comment between cases")
        names.append(label[0])
        at = label[1]
    if names:
        _add_case(cases, names, block)
    return cases


def _label(tokens: Tokens, at: int) -> tuple[str, int] | None:
    texts = [token.text for token in tokens[at : at + 5]]
    if texts[:2] == ["default", ":"]:
        return "", at + 2
    if texts[:1] == ["case"]:
        if texts[1:3] == ["State", "::"] and texts[4:5] == [":"]:
            return texts[3], at + 5
        raise SyntaxError("a case is no state")
    return None


def _add_case(cases: dict[str, tuple[CppToken, ...]], names: Sequence[str], block: Tokens) -> None:
    own = _without_break(block)
    for name in names:
        if name in cases or (not name and own):
            raise SyntaxError("a case for all other states")
        if name:
            cases[name] = own


def _without_break(block: Tokens) -> tuple[CppToken, ...]:
    """The tokens of a case without the `break` at its end, and without braces around all of it."""
    own = list(block)
    if own and own[0].text == "{":
        closing = matching(own, 0)
        rest = [each.text for each in own[closing + 1 :]]
        if rest in ([], ["break", ";"]):
            own = [*own[1:closing], *own[closing + 1 :]]
    texts = [each.text for each in own]
    if texts[-2:] == ["break", ";"]:
        own, texts = own[:-2], texts[:-2]
        if texts[-2:] == ["break", ";"]:
            own, texts = own[:-2], texts[:-2]
    elif not _ends_with_return(own):
        raise SyntaxError("a case continues in the next one")
    if "break" in texts:
        raise SyntaxError("a case ends at several places")
    return tuple(own)


def _ends_with_return(block: Tokens) -> bool:
    statements = [each for each in split_statements(block) if not isinstance(each, CppComment)]
    return bool(statements) and always_ends(statements[-1:])
