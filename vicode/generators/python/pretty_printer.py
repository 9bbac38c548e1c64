"""Breaks long code into lines as Python's formatters do: a document of texts, groups and possible line ends."""

from dataclasses import dataclass

LINE_WIDTH = 120
INDENT_WIDTH = 4


@dataclass(frozen=True, slots=True)
class SoftLine:
    """A place where a line may end; else `flat` stands there."""

    flat: str = " "


@dataclass(frozen=True, slots=True)
class IfBreak:
    """Text that stands only where the group around it is broken."""

    text: str


@dataclass(frozen=True, slots=True)
class Concat:
    """One part after the other."""

    parts: "tuple[Doc, ...]"


@dataclass(frozen=True, slots=True)
class DocGroup:
    """Stands in one line if it fits, else all its own line ends are taken."""

    inner: "Doc"
    must_break: bool = False


@dataclass(frozen=True, slots=True)
class Indent:
    """One step further in."""

    inner: "Doc"


Doc = str | SoftLine | IfBreak | Concat | DocGroup | Indent
_Task = tuple[int, bool, Doc]


def concat(*parts: Doc) -> Doc:
    """The parts in a row."""
    return Concat(parts)


def join_docs(parts: list[Doc], separator: Doc) -> Doc:
    """The parts with something between them."""
    between: list[Doc] = []
    for part in parts:
        between += [separator, part] if between else [part]
    return Concat(tuple(between))


def bracketed(opening: str, inner: Doc, closing: str = ")") -> Doc:
    """Brackets with lines of their own for what is inside, if that is too long."""
    return DocGroup(concat(opening, Indent(concat(SoftLine(""), inner)), SoftLine(""), closing))


def call_doc(function: str, arguments: list[Doc], *, must_break: bool = False) -> Doc:
    """A call; its arguments stand in one line, or each in its own with a comma behind."""
    if not arguments:
        return f"{function}()"
    inner = DocGroup(concat(join_docs(arguments, concat(",", SoftLine())), IfBreak(",")), must_break)
    return DocGroup(concat(f"{function}(", Indent(concat(SoftLine(""), inner)), SoftLine(""), ")"), must_break)


def render_doc(doc: Doc, indent: int = 0) -> list[str]:
    """The lines of a document, the first one indented too."""
    out: list[str] = [" " * indent]
    column = indent
    tasks: list[_Task] = [(indent, False, doc)]
    while tasks:
        depth, is_flat, item = tasks.pop()
        match item:
            case str():
                out.append(item)
                column += len(item)
            case SoftLine(flat=flat):
                column = column + len(flat) if is_flat else depth
                out.append(flat if is_flat else "\n" + " " * depth)
            case IfBreak(text=text):
                tasks.append((depth, is_flat, "" if is_flat else text))
            case Concat(parts=parts):
                tasks += [(depth, is_flat, part) for part in reversed(parts)]
            case Indent(inner=inner):
                tasks.append((depth + INDENT_WIDTH, is_flat, inner))
            case DocGroup(inner=inner, must_break=is_broken):
                flat_now = is_flat or (not is_broken and _fits([(depth, True, inner)], tasks, LINE_WIDTH - column))
                tasks.append((depth, flat_now, inner))
    return "".join(out).split("\n")


def _fits(first: list[_Task], rest: list[_Task], room: int) -> bool:
    """Whether all up to the next possible line end has room."""
    tasks, waiting = first, len(rest)
    while room >= 0:
        if not tasks:
            if not waiting:
                return True
            waiting -= 1
            tasks.append(rest[waiting])
        depth, is_flat, item = tasks.pop()
        match item:
            case str(text) | SoftLine(flat=text) | IfBreak(text=text):
                if isinstance(item, SoftLine) and not is_flat:
                    return True
                room -= 0 if isinstance(item, IfBreak) and is_flat else len(text)
            case Concat(parts=parts):
                tasks += [(depth, is_flat, part) for part in reversed(parts)]
            case Indent(inner=inner):
                tasks.append((depth, is_flat, inner))
            case DocGroup(inner=inner, must_break=is_broken):
                if is_broken and is_flat:
                    return False
                tasks.append((depth, is_flat, inner))
    return False
