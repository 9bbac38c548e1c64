"""A pretty printer that breaks lines as Python formatters do (documents of text, groups and soft line breaks)."""

from dataclasses import dataclass

LINE_WIDTH = 120
INDENT_WIDTH = 4


@dataclass(frozen=True, slots=True)
class SoftLine:
    """A possible line break; prints `flat` where the line does not break."""

    flat: str = " "


@dataclass(frozen=True, slots=True)
class IfBreak:
    """Text that is printed only if the enclosing group is broken."""

    text: str


@dataclass(frozen=True, slots=True)
class Concat:
    """Consecutive parts."""

    parts: "tuple[Doc, ...]"


@dataclass(frozen=True, slots=True)
class DocGroup:
    """Printed on one line if it fits; otherwise all its soft lines break."""

    inner: "Doc"
    must_break: bool = False


@dataclass(frozen=True, slots=True)
class Indent:
    """Content indented by one level."""

    inner: "Doc"


Doc = str | SoftLine | IfBreak | Concat | DocGroup | Indent
_Task = tuple[int, bool, Doc]


def concat(*parts: Doc) -> Doc:
    return Concat(parts)


def join_docs(parts: list[Doc], separator: Doc) -> Doc:
    joined: list[Doc] = []
    for part in parts:
        joined += [separator, part] if joined else [part]
    return Concat(tuple(joined))


def bracketed(inner: Doc) -> Doc:
    """Enclose a document in brackets; a document that does not fit moves to separate lines."""
    return DocGroup(concat("(", Indent(concat(SoftLine(""), inner)), SoftLine(""), ")"))


def call_doc(function: str, arguments: list[Doc], *, must_break: bool = False) -> Doc:
    """Build a call with its arguments on one line, or one per line with a trailing comma."""
    if not arguments:
        return f"{function}()"
    inner = DocGroup(concat(join_docs(arguments, concat(",", SoftLine())), IfBreak(",")), must_break)
    return DocGroup(concat(f"{function}(", Indent(concat(SoftLine(""), inner)), SoftLine(""), ")"), must_break)


def render_doc(doc: Doc, indent: int = 0) -> list[str]:
    """Render a document to lines; the first line is indented too."""
    flat = _flat_text(doc, in_group=False)
    if flat is not None and indent + len(flat) <= LINE_WIDTH and "\n" not in flat:
        return [" " * indent + flat]
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


def _flat_text(doc: Doc, *, in_group: bool) -> str | None:
    """Return the document as one line; None if a line must break."""
    if isinstance(doc, str):
        return doc
    if isinstance(doc, Concat):
        parts = []
        for part in doc.parts:
            text = part if isinstance(part, str) else _flat_text(part, in_group=in_group)
            if text is None:
                return None
            parts.append(text)
        return "".join(parts)
    if isinstance(doc, SoftLine):
        return doc.flat if in_group else None
    if isinstance(doc, DocGroup):
        return None if doc.must_break else _flat_text(doc.inner, in_group=True)
    if isinstance(doc, Indent):
        return _flat_text(doc.inner, in_group=in_group)
    return "" if in_group else None


def _fits(first: list[_Task], rest: list[_Task], width: int) -> bool:
    """Whether everything up to the next possible line break fits into `width` columns."""
    tasks, remaining = first, len(rest)
    while width >= 0:
        if not tasks:
            if not remaining:
                return True
            remaining -= 1
            tasks.append(rest[remaining])
        depth, is_flat, item = tasks.pop()
        match item:
            case str(text) | SoftLine(flat=text) | IfBreak(text=text):
                if isinstance(item, SoftLine) and not is_flat:
                    return True
                width -= 0 if isinstance(item, IfBreak) and is_flat else len(text)
            case Concat(parts=parts):
                tasks += [(depth, is_flat, part) for part in reversed(parts)]
            case Indent(inner=inner):
                tasks.append((depth, is_flat, inner))
            case DocGroup(inner=inner, must_break=is_broken):
                if is_broken and is_flat:
                    return False
                tasks.append((depth, is_flat, inner))
    return False
