"""Pieces of a Python expression: how tightly they bind, and where their lines may end."""

from dataclasses import dataclass

from vicode.generators.python.layout import WIDTH, Doc, Group, Line, bracketed, call, joined, render, separated

CHOICE, OR, AND, NOT, COMPARISON, ADDITION, MULTIPLICATION, NEGATIVE, ATOM = range(1, 10)
# Formatters see `and` and `or` as one level.
_LEVELS = {OR: AND}


@dataclass(frozen=True, slots=True, kw_only=True)
class Piece:
    """An expression.

    `breakable` may end lines at its operators, which only brackets around allow; `rigid` only inside its own brackets.
    `loosest` is the level of the operator that binds least, outside brackets, and how many of that level there are.
    """

    breakable: Doc
    rigid: Doc
    precedence: int = ATOM
    loosest: tuple[int, int] = (ATOM, 0)
    begins_bracketed: bool = False
    ends_bracketed: bool = False
    parts: "tuple[tuple[str | None, Piece], ...]" = ()


def atom(text: str) -> Piece:
    """A name or literal."""
    return Piece(breakable=text, rigid=text)


def call_piece(function: str, arguments: list[Doc]) -> Piece:
    """A call."""
    doc = call(function, arguments)
    return Piece(breakable=doc, rigid=doc, ends_bracketed=bool(arguments))


def chain(parts: list[tuple[str | None, Piece]], precedence: int) -> Piece:
    """Operands of one precedence with the operator before each but the first."""
    is_comparison = precedence == COMPARISON
    flat: list[tuple[str | None, Piece]] = []
    for operator, piece in parts:
        # Python reads them from the left, so a chain that begins with another one needs no brackets; nor does
        # a longer `and`, whatever the order.
        is_same = piece.precedence == precedence and (not flat or precedence in (AND, OR)) and not is_comparison
        if is_same and piece.parts:
            flat += [(operator if index == 0 else each, part) for index, (each, part) in enumerate(piece.parts)]
        else:
            flat.append((operator, _at_least(piece, precedence, is_first=not flat)))
    pieces = [piece for _operator, piece in flat]
    docs: list[Doc] = [_with_operator(operator, piece.breakable) for operator, piece in flat]
    rigid: list[Doc] = [_with_operator(operator, piece.rigid) for operator, piece in flat]
    return Piece(
        breakable=Group(separated(docs, Line())),
        rigid=separated(rigid, " "),
        precedence=precedence,
        loosest=_loosest([*(piece.loosest for piece in pieces), (_LEVELS.get(precedence, precedence), len(flat) - 1)]),
        begins_bracketed=pieces[0].begins_bracketed,
        ends_bracketed=pieces[-1].ends_bracketed,
        parts=tuple(flat),
    )


def prefixed(operator: str, piece: Piece, precedence: int) -> Piece:
    """`not x` or `-x`."""
    inner = piece if piece.precedence >= (NOT if precedence == NOT else ATOM) else in_brackets(piece)
    return Piece(
        breakable=joined(operator, inner.breakable),
        rigid=joined(operator, inner.rigid),
        precedence=precedence,
        loosest=inner.loosest,
        ends_bracketed=inner.ends_bracketed,
    )


def ternary(then: Piece, test: Piece, otherwise: Piece) -> Piece:
    """`then if test else otherwise`."""
    first, middle = (in_brackets(piece) if piece.precedence == CHOICE else piece for piece in (then, test))
    tails: list[tuple[str | None, Piece]] = [("if", middle)]
    tails += (
        [("else", otherwise.parts[0][1]), *otherwise.parts[1:]]
        if otherwise.parts and otherwise.precedence == CHOICE
        else [("else", otherwise)]
    )
    parts = [(None, first), *tails]
    return Piece(
        breakable=Group(separated([_with_operator(operator, piece.breakable) for operator, piece in parts], Line())),
        rigid=separated([_with_operator(operator, piece.rigid) for operator, piece in parts], " "),
        precedence=CHOICE,
        loosest=_loosest([*(piece.loosest for _operator, piece in parts), (CHOICE, len(tails) // 2)]),
        begins_bracketed=first.begins_bracketed,
        ends_bracketed=parts[-1][1].ends_bracketed,
        parts=tuple(parts),
    )


def in_brackets(piece: Piece) -> Piece:
    """The same in brackets."""
    doc = bracketed("(", piece.breakable)
    return Piece(breakable=doc, rigid=doc, begins_bracketed=True, ends_bracketed=True)


def statement(before: str, piece: Piece, after: str = "", *, indent: int) -> list[str]:
    """A line of code with an expression in it, in as many lines as it needs."""
    flat = _flat(before, piece, after, indent)
    if len(flat) == 1 and len(flat[0]) <= WIDTH:
        return flat
    # Brackets that the expression has already serve to break it, unless operators would be torn apart.
    has_brackets = piece.begins_bracketed or piece.ends_bracketed
    is_single = piece.loosest[1] <= 1 and piece.precedence != CHOICE
    if is_single and has_brackets and (piece.loosest[1] == 0 or all(len(line) <= WIDTH for line in flat)):
        return flat
    inside = render(joined(before, bracketed("(", piece.breakable), after), indent)
    if piece.loosest[1] == 0 and any(len(line) > WIDTH for line in inside):
        return flat
    return inside


def _flat(before: str, piece: Piece, after: str, indent: int) -> list[str]:
    return render(joined(before, piece.rigid, after), indent)


def _with_operator(operator: str | None, doc: Doc) -> Doc:
    return doc if operator is None else joined(f"{operator} ", doc)


def _at_least(piece: Piece, precedence: int, *, is_first: bool) -> Piece:
    if precedence == OR and piece.precedence == AND:
        return in_brackets(piece)
    needed = precedence if is_first and precedence != COMPARISON else precedence + 1
    return piece if piece.precedence >= needed else in_brackets(piece)


def _loosest(levels: list[tuple[int, int]]) -> tuple[int, int]:
    lowest = min(level for level, _count in levels)
    return (lowest, sum(count for level, count in levels if level == lowest))
