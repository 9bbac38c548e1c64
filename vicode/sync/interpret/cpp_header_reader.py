"""Reads a changed C++ header back: initial values, docs, and code beside its regions."""

import re
import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from difflib import SequenceMatcher

from vicode.cpp_tokens import iter_tokens
from vicode.generators.cpp import CppCode
from vicode.model.design import Code, Declaration, Design
from vicode.model.edits import set_declarations
from vicode.sync.interpret.cpp_expression_reader import CppExpressionReader, UnreadableError
from vicode.sync.interpret.cpp_expressions import CppNode, parse_expression
from vicode.sync.interpret.cpp_plain_forms import is_mark
from vicode.sync.same_code import is_same_code

_MEMBER = re.compile(r"\s+[\w:]+ (?P<name>\w+) = (?P<value>.*);")
_DOC = re.compile(r"\s*///(.*)")
_FACTS = re.compile(r" \([^()]*\)\Z")
_ENDS = {"module": re.compile(r"namespace .*"), "members": re.compile(r"private:")}
"""The lines before which code of the module and of the class stands."""


def is_same_header(a: str, b: str) -> bool:
    """Whether two headers are the same code with the same comments; marks of regions do not count."""
    return is_same_code(_unmarked(a), _unmarked(b), "//")


def read_header(design: Design, code: CppCode, edited: str) -> Design:
    """Return the design with what was understood; the code generated from it may still differ."""
    old, new = _Header.of(code.header), _Header.of(edited)
    changed = design if old.doc == new.doc else replace(design, doc=new.doc)
    changed = _with_values(changed, code, old, new)
    return _with_code(changed, code.header, edited)


@dataclass(frozen=True, slots=True)
class _Header:
    """The doc of the class, and the values and docs of the members."""

    doc: str
    values: Mapping[str, str]
    docs: Mapping[str, str]

    @classmethod
    def of(cls, text: str) -> "_Header":
        doc, lines = "", []
        values: dict[str, str] = {}
        docs: dict[str, str] = {}
        for line in text.split("\n"):
            if found := _DOC.fullmatch(line):
                lines.append(found[1].strip())
                continue
            if line.startswith("class "):
                doc = _joined(lines)
            elif (member := _MEMBER.fullmatch(line)) and member["name"] not in values:
                values[member["name"]], docs[member["name"]] = member["value"], _joined(lines)
            lines = []
        return cls(doc, values, docs)


def _joined(lines: Sequence[str]) -> str:
    paragraphs = "\n".join(lines).split("\n\n")
    return "\n\n".join(" ".join(paragraph.split()) for paragraph in paragraphs).strip()


def _with_values(design: Design, code: CppCode, old: _Header, new: _Header) -> Design:
    names = {text: name for name, text in code.symbols.texts.items()}
    reader = CppExpressionReader(code.symbols, design.time_unit)
    for section in ("parameters", "outputs", "variables"):
        declarations = tuple(
            _declared(each, names.get(each.name, each.name), reader, (old, new)) for each in getattr(design, section)
        )
        design = set_declarations(design, section, declarations)
    return design


def _declared(
    declaration: Declaration, name: str, reader: CppExpressionReader, headers: tuple[_Header, _Header]
) -> Declaration:
    old, new = headers
    if name not in old.values or name not in new.values:
        return declaration
    changed = declaration
    if old.values[name] != new.values[name] and (value := _parsed(new.values[name])) is not None:
        try:
            initial = reader.read_value(declaration.initial, _parsed(old.values[name]) or value, value)
        except UnreadableError:
            return declaration
        changed = replace(changed, initial=initial, type=changed.type or reader.symbols.types.get(name, ""))
        if declaration.initial and not declaration.type:
            changed = replace(changed, type=_needed_type(declaration, initial, changed.type))
    if old.docs[name] != new.docs[name]:
        has_facts = declaration.unit or declaration.range
        changed = replace(changed, doc=_FACTS.sub("", new.docs[name]) if has_facts else new.docs[name])
    return changed


def _needed_type(declaration: Declaration, initial: str, type_: str) -> str:
    """The type, unless the new value has the form of the old one, of which it is inferred."""
    return "" if ("." in declaration.initial) == ("." in initial) else type_


def _parsed(text: str) -> CppNode | None:
    try:
        return parse_expression(list(iter_tokens(text)))
    except SyntaxError:
        return None


def _with_code(design: Design, generated: str, edited: str) -> Design:
    """Move lines that were added beside a region, or where one would be, into its code."""
    lines = [_unmarked(text).split("\n") for text in (generated, edited)]
    own, other = ([line.strip() for line in each if line.strip()] for each in lines)
    kept = [line for line in lines[1] if line.strip()]
    for tag, first, _last, start, end in SequenceMatcher(None, own, other, autojunk=False).get_opcodes():
        section = _section(own, first) if tag == "insert" else ""
        if section:
            code: Code = getattr(design, section)
            text = _merged(code.in_language("cpp") or "", own, first, kept[start:end])
            texts = {**dict(code.texts), "cpp": text}
            design = replace(design, **{section: Code(texts=tuple(texts.items()))})  # type: ignore[arg-type]
    return design


def _section(own: Sequence[str], at: int) -> str:
    """The section of code that lines before an index belong to; empty if they belong to none."""
    for section, end in _ENDS.items():
        place = next((index for index, line in enumerate(own) if end.fullmatch(line)), -1)
        start = _start(own, section)
        if start <= at <= place:
            return section
    return ""


def _start(own: Sequence[str], section: str) -> int:
    """The first place where code of a section may stand."""
    if section == "module":
        places = [at for at, line in enumerate(own) if line.startswith("#include")]
    else:
        members = [at for at, line in enumerate(own) if line.endswith("override;") or line == "// Used components"]
        places = members[-1:]
    return places[0] + 1 if places else len(own)


def _merged(text: str, own: Sequence[str], at: int, added: Sequence[str]) -> str:
    """The code with added lines at the place that an index of the header means."""
    block = textwrap.dedent("\n".join(added))
    lines = text.rstrip("\n").split("\n") if text.strip() else []
    plain = [line.strip() for line in lines if line.strip()]
    behind = 0
    while behind < len(plain) and at + behind < len(own) and own[at + behind] in plain:
        behind += 1
    place = len(lines) - behind if behind else len(lines)
    joined = [*lines[:place], block, *lines[place:]]
    return "\n".join(joined).strip("\n") + "\n"


def _unmarked(text: str) -> str:
    return "\n".join(line for line in text.split("\n") if not _is_mark_line(line))


def _is_mark_line(line: str) -> bool:
    tokens = list(iter_tokens(line.strip())) if "vicode" in line else []
    return bool(tokens) and is_mark(tokens[0])
