"""Documents of Python expressions with operator precedence and possible line breaks."""

from dataclasses import dataclass

from vicode.generators.python.pretty_printer import (
    LINE_WIDTH,
    Doc,
    DocGroup,
    SoftLine,
    bracketed,
    call_doc,
    concat,
    join_docs,
    render_doc,
)

CHOICE, OR, AND, NOT, COMPARISON, ADDITION, MULTIPLICATION, NEGATIVE, ATOM = range(1, 10)
# Formatters treat `and` and `or` as one level.
_LEVELS = {OR: AND}


@dataclass(frozen=True, slots=True, kw_only=True)
class ExpressionDoc:
    """An expression.

    Attributes:
        breakable: May break lines at operators, which requires enclosing brackets.
        unbreakable: Breaks lines only inside its own brackets.
        weakest_operator: The lowest precedence outside brackets, and the number of operators with that precedence.
        operands: The operands of a chain, each with the operator before it.
    """

    breakable: Doc
    unbreakable: Doc
    precedence: int = ATOM
    weakest_operator: tuple[int, int] = (ATOM, 0)
    starts_with_bracket: bool = False
    ends_with_bracket: bool = False
    operands: "tuple[tuple[str | None, ExpressionDoc], ...]" = ()


def atom(text: str) -> ExpressionDoc:
    """Return the document of a name or literal."""
    return ExpressionDoc(breakable=text, unbreakable=text)


def call_expression(function: str, arguments: list[Doc]) -> ExpressionDoc:
    doc = call_doc(function, arguments)
    return ExpressionDoc(breakable=doc, unbreakable=doc, ends_with_bracket=bool(arguments))


def operator_chain(parts: list[tuple[str | None, ExpressionDoc]], precedence: int) -> ExpressionDoc:
    """Join operands of one precedence, each but the first with the operator before it."""
    is_comparison = precedence == COMPARISON
    flat: list[tuple[str | None, ExpressionDoc]] = []
    for operator, piece in parts:
        # Operators are left-associative, so a first operand of the same precedence needs no brackets. `and` and `or`
        # are associative and need none at any position.
        is_same = piece.precedence == precedence and (not flat or precedence in (AND, OR)) and not is_comparison
        if is_same and piece.operands:
            flat += [(inner if index else operator, part) for index, (inner, part) in enumerate(piece.operands)]
        else:
            flat.append((operator, _parenthesize_below(piece, precedence, is_first=not flat)))
    pieces = [piece for _operator, piece in flat]
    docs: list[Doc] = [_with_operator(operator, piece.breakable) for operator, piece in flat]
    rigid: list[Doc] = [_with_operator(operator, piece.unbreakable) for operator, piece in flat]
    return ExpressionDoc(
        breakable=DocGroup(join_docs(docs, SoftLine())),
        unbreakable=join_docs(rigid, " "),
        precedence=precedence,
        weakest_operator=_weakest_operator(
            [*(piece.weakest_operator for piece in pieces), (_LEVELS.get(precedence, precedence), len(flat) - 1)]
        ),
        starts_with_bracket=pieces[0].starts_with_bracket,
        ends_with_bracket=pieces[-1].ends_with_bracket,
        operands=tuple(flat),
    )


def unary_expression(operator: str, piece: ExpressionDoc, precedence: int) -> ExpressionDoc:
    inner = piece if piece.precedence >= (NOT if precedence == NOT else ATOM) else parenthesized(piece)
    return ExpressionDoc(
        breakable=concat(operator, inner.breakable),
        unbreakable=concat(operator, inner.unbreakable),
        precedence=precedence,
        weakest_operator=inner.weakest_operator,
        ends_with_bracket=inner.ends_with_bracket,
    )


def conditional_expression(then: ExpressionDoc, test: ExpressionDoc, otherwise: ExpressionDoc) -> ExpressionDoc:
    """`then if test else otherwise`."""
    first, middle = (parenthesized(piece) if piece.precedence == CHOICE else piece for piece in (then, test))
    tails: list[tuple[str | None, ExpressionDoc]] = [("if", middle)]
    tails += (
        [("else", otherwise.operands[0][1]), *otherwise.operands[1:]]
        if otherwise.operands and otherwise.precedence == CHOICE
        else [("else", otherwise)]
    )
    parts = [(None, first), *tails]
    return ExpressionDoc(
        breakable=DocGroup(
            join_docs([_with_operator(operator, piece.breakable) for operator, piece in parts], SoftLine())
        ),
        unbreakable=join_docs([_with_operator(operator, piece.unbreakable) for operator, piece in parts], " "),
        precedence=CHOICE,
        weakest_operator=_weakest_operator(
            [*(piece.weakest_operator for _operator, piece in parts), (CHOICE, len(tails) // 2)]
        ),
        starts_with_bracket=first.starts_with_bracket,
        ends_with_bracket=parts[-1][1].ends_with_bracket,
        operands=tuple(parts),
    )


def parenthesized(piece: ExpressionDoc) -> ExpressionDoc:
    doc = bracketed(piece.breakable)
    return ExpressionDoc(breakable=doc, unbreakable=doc, starts_with_bracket=True, ends_with_bracket=True)


def format_statement(before: str, piece: ExpressionDoc, after: str = "", *, indent: int) -> list[str]:
    """Format a statement that contains one expression; it may span several lines."""
    flat = _flat(before, piece, after, indent)
    if len(flat) == 1 and len(flat[0]) <= LINE_WIDTH:
        return flat
    # Break inside existing brackets unless that separates operators.
    has_brackets = piece.starts_with_bracket or piece.ends_with_bracket
    is_single = piece.weakest_operator[1] <= 1 and piece.precedence != CHOICE
    if is_single and has_brackets and (piece.weakest_operator[1] == 0 or all(len(line) <= LINE_WIDTH for line in flat)):
        return flat
    inside = render_doc(concat(before, bracketed(piece.breakable), after), indent)
    if piece.weakest_operator[1] == 0 and any(len(line) > LINE_WIDTH for line in inside):
        return flat
    return inside


def _flat(before: str, piece: ExpressionDoc, after: str, indent: int) -> list[str]:
    return render_doc(concat(before, piece.unbreakable, after), indent)


def _with_operator(operator: str | None, doc: Doc) -> Doc:
    return doc if operator is None else concat(f"{operator} ", doc)


def _parenthesize_below(piece: ExpressionDoc, precedence: int, *, is_first: bool) -> ExpressionDoc:
    if precedence == OR and piece.precedence == AND:
        return parenthesized(piece)
    needed = precedence if is_first and precedence != COMPARISON else precedence + 1
    return piece if piece.precedence >= needed else parenthesized(piece)


def _weakest_operator(levels: list[tuple[int, int]]) -> tuple[int, int]:
    lowest = min(level for level, _count in levels)
    return (lowest, sum(count for level, count in levels if level == lowest))
