"""The generated parts of docs/reference: commands, runtime, functions of expressions."""

import argparse
import ast
import dataclasses
import inspect
import re
import textwrap
from collections.abc import Iterator
from typing import Any

import vicode.bica
from vicode.bica.options import make_parser
from vicode.cli.entry_point import COMMANDS, make_command_parser
from vicode.model.expressions import FUNCTIONS, BuiltinFunction

_DEFAULT = re.compile(r" *[(;] ?default(?P<when>[^:()]*): (?P<value>(?:[^()]|\([^()]*\))*)\)?$")
_SECTION = re.compile(r"^(Args|Attributes|Raises):\n((?:    .*\n?|\n)+)", re.MULTILINE)
_ENTRY = re.compile(r"^(\w+): (.*(?:\n +.*)*)", re.MULTILINE)
_SECTION_TITLES = {"Args": "Arguments", "Attributes": "Attributes", "Raises": "Raises"}


def commands() -> str:
    """A section for each command, with all arguments and options."""
    parser = make_command_parser(COMMANDS)
    sections = [*_command_sections(parser, "vicode"), *_command_sections(make_parser(), "python -m vicode.bica")]
    links = [f"- [`{name}`](#{_anchor(name)})\n" for name, _ in sections]
    return "".join(links) + "".join(f"\n## {name}\n\n{text}" for name, text in sections)


def _command_sections(parser: argparse.ArgumentParser, name: str) -> Iterator[tuple[str, str]]:
    groups = [each for each in parser._actions if isinstance(each, argparse._SubParsersAction)]
    if not groups:
        yield (
            name,
            f"{parser.description}\n\n```text\n{_usage(parser, name)}\n```\n{_option_table(parser)}{_epilog(parser)}",
        )
        return
    for group in groups:
        for word, command in group.choices.items():
            yield from _command_sections(command, f"{name} {word}")


def _usage(parser: argparse.ArgumentParser, name: str) -> str:
    """The name, the number of options, the arguments; options are in the table."""
    shown = [action for action in parser._actions if action.help is not argparse.SUPPRESS]
    words = [name]
    if any(action.option_strings and not action.required for action in shown):
        words.append("[OPTION …]")
    words += [
        " ".join((action.option_strings[-1], _metavar(action)))
        for action in shown
        if action.required and action.option_strings
    ]
    words += [_positional(action) for action in shown if not action.option_strings]
    return " ".join(words)


def _positional(action: argparse.Action) -> str:
    name = _metavar(action)
    match action.nargs:
        case "?":
            return f"[{name}]"
        case "+":
            return f"{name} [{name} …]"
        case "*":
            return name if name.startswith("[") or "|" in name else f"[{name} …]"
        case _:
            return name


def _option_table(parser: argparse.ArgumentParser) -> str:
    rows = []
    for action in parser._actions:
        if action.help is argparse.SUPPRESS or isinstance(action, argparse._HelpAction):
            continue
        meaning, default = _split_default(action)
        meaning = re.sub(r"docs/([\w-]+\.md)", r"[\1](../\1)", meaning)
        rows.append(f"| `{_cell(_names(action))}` | {_cell(meaning)} | {_cell(default)} |\n")
    if not rows:
        return ""
    return "".join(["\n| argument or option | meaning | default |\n", "|---|---|---|\n", *rows])


def _names(action: argparse.Action) -> str:
    if not action.option_strings:
        return _metavar(action)
    value = _metavar(action)
    optional = f" [{value}]" if action.nargs == "?" else f" {value}" if value else ""
    return ", ".join(action.option_strings) + optional


def _metavar(action: argparse.Action) -> str:
    if action.nargs == 0:
        return ""
    if isinstance(action.metavar, str):
        return action.metavar
    return "|".join(map(str, action.choices)) if action.choices else action.dest.upper()


def _split_default(action: argparse.Action) -> tuple[str, str]:
    """The help without the default, and the default."""
    text = (action.help or "") % {"default": action.default, "prog": ""}
    if match := _DEFAULT.search(text):
        when = f" ({match['when'].strip()})" if match["when"] else ""
        return text[: match.start()], match["value"] + when
    is_needed = action.required if action.option_strings else action.nargs not in ("?", "*", argparse.REMAINDER)
    return text, "required" if is_needed else "–"


def _epilog(parser: argparse.ArgumentParser) -> str:
    return f"\n{parser.epilog}\n" if parser.epilog else ""


def functions() -> str:
    """A table of the functions of expressions."""
    rows = [f"| `{_call(each)}` | {_types(each)} | {each.return_type} | {each.doc} |\n" for each in FUNCTIONS.values()]
    return "".join(["| function | arguments | result | meaning |\n", "|---|---|---|---|\n", *rows])


def _call(function: BuiltinFunction) -> str:
    return f"{function.name}({', '.join(function.parameter_names)}{', …' if function.is_variadic else ''})"


def _types(function: BuiltinFunction) -> str:
    types = dict.fromkeys(function.parameter_types)
    return ", ".join(types)


def runtime() -> str:
    """A section for each public name of `vicode.bica`."""
    names = sorted(vicode.bica.__all__, key=str.casefold)
    links = [f"- [`{name}`](#{_anchor(name)})\n" for name in names]
    return "".join(links) + "".join(f"\n## {name}\n\n{_describe(getattr(vicode.bica, name))}" for name in names)


def _describe(value: Any) -> str:
    if not isinstance(value, type):
        return f"A constant: {', '.join(f'`{each}`' for each in sorted(value))}.\n"
    if dataclasses.is_dataclass(value) or hasattr(value, "__total__"):
        head = _docstring(value, leave_out=("Args", "Attributes")) + _field_table(value)
    else:
        head = _constructor(value) + _docstring(value)
    return head + "".join(_member_sections(value))


def _field_table(value: type) -> str:
    """The fields of a dataclass or the keys of a dictionary, with what the docstring says of them."""
    meanings = {
        name: " ".join(doc.split()) for _, body in _SECTION.findall(_clean(value)) for name, doc in _entries(body)
    }
    rows = []
    for line in _syntax(value).body:
        match line:
            case ast.AnnAssign(target=ast.Name(id=name), annotation=annotation, value=default) if name[0] != "_":
                type_ = ast.unparse(annotation)
                optional = type_.removeprefix("NotRequired[").removesuffix("]") if "NotRequired" in type_ else ""
                shown = "may be missing" if optional else f"`{ast.unparse(default)}`" if default else "–"
                rows.append(f"| `{name}` | `{_cell(optional or type_)}` | {shown} | {meanings.get(name, '')} |\n")
    return "".join(["\n| field | type | default | meaning |\n", "|---|---|---|---|\n", *rows])


def _body(value: type) -> list[ast.stmt]:
    """The statements of a class, and of its bases that are not public themselves."""
    inner = [each for each in value.__bases__ if each.__module__.startswith("vicode") and not _is_public(each)]
    return [*_syntax(value).body, *(line for base in inner for line in _body(base))]


def _is_public(value: type) -> bool:
    return value.__name__ in vicode.bica.__all__


def _constructor(value: type) -> str:
    for line in _body(value):
        if isinstance(line, ast.FunctionDef) and line.name == "__init__":
            return _signature(value.__name__, line.args, None)
    return ""


def _member_sections(value: type) -> Iterator[str]:
    for line in _body(value):
        if not isinstance(line, ast.FunctionDef) or line.name.startswith("_"):
            continue
        member = inspect.getattr_static(value, line.name)
        match [ast.unparse(each) for each in line.decorator_list]:
            case ["property"]:
                yield f"\n### {value.__name__}.{line.name}\n\n"
                yield f"`{ast.unparse(line.returns)}`. {_docstring(member.fget)}" if line.returns else ""
            case []:
                yield f"\n### {value.__name__}.{line.name}()\n\n"
                yield _signature(line.name, line.args, line.returns) + _docstring(member)


def _syntax(value: type) -> ast.ClassDef:
    syntax = ast.parse(textwrap.dedent(inspect.getsource(value))).body[0]
    assert isinstance(syntax, ast.ClassDef)
    return syntax


def _signature(name: str, arguments: ast.arguments, returns: ast.expr | None) -> str:
    """The signature without `self`; one parameter per line if it is long."""
    rest = ast.arguments(**{**vars(arguments), "args": arguments.args[1:]})
    result = f" -> {ast.unparse(returns)}" if returns else ""
    # Annotated parameters have spaces around the equals sign.
    parts = [re.sub(r"^(\w+: [^=]+)=", r"\1 = ", each) for each in _split_top_level(ast.unparse(rest))]
    text = f"{name}({', '.join(parts)}){result}"
    if len(text) > 100:
        text = f"{name}(\n" + "".join(f"    {each},\n" for each in parts) + f"){result}"
    return f"```text\n{text.replace('BaseRoot', 'Root')}\n```\n\n"


def _split_top_level(text: str) -> list[str]:
    parts, depth, start = [], 0, 0
    for index, char in enumerate(text):
        depth += (char in "[({") - (char in "])}")
        if char == "," and depth == 0:
            parts.append(text[start:index].strip())
            start = index + 1
    return [*parts, text[start:].strip()]


def _clean(value: Any) -> str:
    return inspect.cleandoc(value.__doc__ or "") + "\n"


def _entries(body: str) -> list[tuple[str, str]]:
    return _ENTRY.findall(re.sub(r"^    ", "", body, flags=re.MULTILINE))


def _docstring(value: Any, leave_out: tuple[str, ...] = ()) -> str:
    """The docstring, with its sections as lists."""

    def section(match: re.Match[str]) -> str:
        if match[1] in leave_out:
            return ""
        lines = [f"- `{name}`: {' '.join(doc.split())}\n" for name, doc in _entries(match[2])]
        return f"{_SECTION_TITLES[match[1]]}:\n\n{''.join(lines)}\n"

    plain = _SECTION.sub(section, _clean(value)).strip()
    assert plain, f"{value.__qualname__} has no docstring"
    paragraphs = re.split(r"\n\n+", plain)
    return "\n\n".join(each if each.startswith("- ") else " ".join(each.split()) for each in paragraphs) + "\n"


def _anchor(title: str) -> str:
    """The anchor of a heading, as GitHub makes it."""
    return re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-")


def _cell(text: str) -> str:
    return text.replace("|", "\\|")
