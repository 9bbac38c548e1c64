"""The parts of a design in words: for differences, tooltips and the documentation site.

A field of a record needs no entry here: its name is the default.
"""

from collections.abc import Collection, Iterator
from dataclasses import MISSING, fields, is_dataclass
from typing import Any

from vicode.model.design import (
    Action,
    Assign,
    Call,
    Code,
    Competence,
    Declaration,
    Design,
    Guard,
    InvariantProperty,
    NeverProperty,
    Origin,
    Property,
    ReachProperty,
    RecoveryProperty,
    RunCode,
)

_WORDS = {
    "doc": "description",
    "frequency_hz": "frequency",
    "origin": "derived from",
    "xabsl_name": "XABSL name",
    "BridgeSettings.tick_ms": "tick",
    "Declaration.initial": "value",
    "Design.initial": "initial state",
    "Design.members": "class code",
    "Design.module": "module code",
    "Enumeration.xabsl_elements": "XABSL names of elements",
    "Guard.after": "time",
    "Guard.code": "guard code",
    "Guard.when": "guard",
    "Competence.goal": "until",
    "Interrupt.during": "while",
    "Layer.hold": "for",
    "Layer.requires": "runs",
    "ProfileClass.implementation": "class",
    "Project.generated": "output folder",
    "Project.live": "live view in C++",
    "Project.name": "project name",
    "Project.xabsl_encoding": "encoding of XABSL files",
    "RemoteReference.max_age": "longest age",
    "RemoteReference.remote": "remote component",
    "TopicReference.max_age": "longest age",
    "Transition.to": "target",
}
"""Words for fields of all records, or of one record."""


def field_word(owner: type, name: str) -> str:
    """The word for a field, such as "description"."""
    return _WORDS.get(f"{owner.__name__}.{name}") or _WORDS.get(name) or name.replace("_", " ")


_NOT_IN_WORDS = ("name", "id", "at", "label_at", "origin")


def describe_fields(record: Any, apart: Collection[str] = ()) -> Iterator[str]:
    """The fields that have another value than their default, such as "capacity 2"; of a flag, only its word.

    Names, ids, positions, the parts of a record, and the fields that the caller shows `apart` are left out.
    """
    for field in fields(record):
        value = getattr(record, field.name)
        default = field.default_factory() if field.default_factory is not MISSING else field.default
        is_left_out = field.name in apart or field.name in _NOT_IN_WORDS or any(map(is_dataclass, _as_tuple(value)))
        text = describe_value(value)
        if text and value != default and not is_left_out:
            word = field_word(type(record), field.name)
            yield word if value is True else f"{word} {text}"


def describe_guard(guard: Guard) -> str:
    """The parts of a guard, as in the file; empty if it always holds."""
    parts = (("when ", guard.when), ("after ", guard.after), ("", "code" if guard.code is not None else ""))
    return ", ".join(f"{word}{text}" for word, text in parts if text)


def describe_action(action: Action) -> str:
    match action:
        case Assign(values=values):
            return f"set {_describe_pairs(values)}"
        case Call(alias=alias, arguments=arguments):
            return f"call {alias}{f' with {_describe_pairs(arguments)}' if arguments else ''}"
        case RunCode(code=code):
            return describe_code(code)


def describe_property(promised: Property) -> str:
    """A property as a phrase, such as "after Kick, LookForBall is reached within 5"."""
    match promised:
        case ReachProperty(reach=reach, after=after, within=within):
            phrase = f"{reach} is reached within {within}" if within else f"{reach} is reached eventually"
        case NeverProperty(never=never, after=after, before=before):
            phrase = f"no {never} before {before}" if before else f"{never} is never active"
        case RecoveryProperty(can_reach=can_reach):
            return f"there is always a way to {can_reach}"
        case InvariantProperty(holds=holds):
            return f"{holds} always holds"
    return f"after {after}, {phrase}" if after else phrase


def describe_constructs(design: Design) -> Iterator[str]:
    """What a design is lowered from (`vicode.model.lowering`), one line for each construct."""
    return (text for _origin, text in _iter_constructs(design))


def describe_construct(design: Design, origin: Origin) -> str:
    """The construct that something is derived from in one line; empty for what is not derived."""
    return next((text for each, text in _iter_constructs(design) if each == origin), "") if origin else ""


def _iter_constructs(design: Design) -> Iterator[tuple[Origin, str]]:
    for latch in design.latches:
        yield ("latches", latch.name), _describe_construct(f"latch {latch.name}", latch)
    for number, interrupt in enumerate(design.interrupts):
        yield ("interrupts", number), _describe_construct(f"interrupt by {interrupt.do}", interrupt, "do")
    if design.competence is not None:
        yield ("competence",), _describe_construct("competence", design.competence)
        for step in design.competence.steps:
            yield ("competence", "steps", step.name), _describe_construct(f"step {step.name}", step)
    for layer in design.layers:
        yield ("layers", layer.name), _describe_construct(f"layer {layer.name}", layer)


def _describe_construct(title: str, construct: object, *apart: str) -> str:
    return f"{title}: {describe_parts(construct, *apart)}"


def describe_parts(construct: object, *apart: str) -> str:
    """The fields and modulations of a latch, interrupt, step or layer."""
    modulates = describe_value(getattr(construct, "modulates", ()))
    return "; ".join((*describe_fields(construct, apart), *((f"modulates {modulates}",) if modulates else ())))


def describe_code(code: Code | None) -> str:
    """The text of code; with several languages or another one than Python, each with its name."""
    texts = code.texts if code is not None else ()
    if [language for language, _text in texts] == ["python"]:
        return texts[0][1].rstrip("\n")
    return "\n".join(f"{language}: {text}".rstrip("\n") for language, text in texts)


def describe_declaration(declaration: Declaration) -> str:
    """Type, value, unit and range of a declaration."""
    arguments = declaration.arguments
    listed = "" if arguments is None else f"({', '.join(_describe_argument(each) for each in arguments)})"
    low_high = " to ".join(map(describe_number, declaration.range or ()))
    return " ".join(
        part for part in (listed, declaration.type, declaration.initial, declaration.unit, low_high) if part
    )


def describe_value(value: object) -> str:
    """A plain value as text; empty for a missing one."""
    match value:
        case None | "" | () | False:
            return ""
        case True:
            return "yes"
        case float():
            return describe_number(value)
        case Code():
            return describe_code(value)
        case tuple():
            return ", ".join(
                ": ".join(map(describe_value, each)) if _is_pair(each) else describe_value(each) for each in value
            )
        case _:
            return _describe_record(value)


def _describe_record(value: object) -> str:
    match value:
        case Declaration():
            return f"{value.name} {describe_declaration(value)}".rstrip()
        case Call():
            return f"{value.alias}({_describe_pairs(value.arguments)})"
        case Competence():
            steps = (f"{each.name} ({describe_parts(each)})" for each in value.steps)
            return f"{'; '.join(describe_fields(value))}; steps {', '.join(steps)}"
        case _:
            return str(value)


def describe_number(value: float) -> str:
    """The shortest text that is read as this number."""
    return repr(float(value)).removesuffix(".0")


def _as_tuple(value: object) -> tuple[object, ...]:
    return value if isinstance(value, tuple) else (value,)


def _is_pair(value: object) -> bool:
    return isinstance(value, tuple) and len(value) == 2


def _describe_argument(argument: Declaration) -> str:
    return f"{argument.name} {describe_declaration(argument)}".rstrip()


def _describe_pairs(pairs: tuple[tuple[str, str], ...]) -> str:
    return ", ".join(f"{name}: {text}" for name, text in pairs)
