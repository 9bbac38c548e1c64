"""From the format's values to the model's."""

from typing import cast

from vicode.model.design import (
    Action,
    Assign,
    Call,
    Code,
    CommonSection,
    Decision,
    DecisionGroup,
    Declaration,
    Design,
    Guard,
    RunCode,
    State,
    Stay,
    Transition,
    Use,
)
from vicode.model.project import Agent, Enumeration, Interface, Project
from vicode.store.schema_types import FormatValue


class RecordFields:
    """A record's value, asked key by key; a missing key has the value that its absence means."""

    def __init__(self, data: FormatValue) -> None:
        """Wrap pairs of name and value."""
        self.values = dict(cast("tuple[tuple[str, FormatValue], ...]", data))

    def has(self, name: str) -> bool:
        """Whether the key is there."""
        return name in self.values

    def text(self, name: str, default: str = "") -> str:
        """A text."""
        return cast("str", self.values.get(name, default))

    def number(self, name: str) -> float | None:
        """A number."""
        return cast("float | None", self.values.get(name))

    def flag(self, name: str) -> bool:
        """A truth."""
        return cast("bool", self.values.get(name, False))

    def pair(self, name: str) -> tuple[float, float] | None:
        """Two numbers."""
        return cast("tuple[float, float] | None", self.values.get(name))

    def text_list(self, name: str) -> tuple[str, ...]:
        """A list of texts."""
        return cast("tuple[str, ...]", self.values.get(name, ()))

    def text_map(self, name: str) -> tuple[tuple[str, str], ...]:
        """A table of texts."""
        return cast("tuple[tuple[str, str], ...]", self.values.get(name, ()))

    def value_map(self, name: str) -> tuple[tuple[str, FormatValue], ...]:
        """A table of other things."""
        return cast("tuple[tuple[str, FormatValue], ...]", self.values.get(name, ()))

    def record_map(self, name: str) -> "list[tuple[str, RecordFields]]":
        """A table of records."""
        return [(key, RecordFields(value)) for key, value in self.value_map(name)]

    def record_list(self, name: str) -> "list[RecordFields]":
        """A list of records."""
        return [RecordFields(value) for value in cast("tuple[FormatValue, ...]", self.values.get(name, ()))]

    def code(self, name: str) -> Code | None:
        """Code, None when the key is missing."""
        return Code(texts=self.text_map(name)) if name in self.values else None


def decode_design(data: FormatValue, default_name: str) -> Design:
    """A design; `default_name` names its component when the file does not."""
    fields = RecordFields(data)
    return Design(
        component=fields.text("component", default_name),
        doc=fields.text("doc"),
        xabsl_name=fields.text("xabsl_name"),
        frequency_hz=fields.number("frequency"),
        resume=fields.flag("resume"),
        arithmetic=fields.text("arithmetic"),
        time_unit=fields.text("time_unit"),
        uses=tuple(
            Use(alias=alias, component=use.text("component"), at=use.pair("at"))
            for alias, use in fields.record_map("uses")
        ),
        parameters=_declarations(fields, "parameters", "default"),
        outputs=_declarations(fields, "outputs", "initial"),
        variables=_declarations(fields, "variables", "initial"),
        initial=fields.text("initial"),
        module=fields.code("module") or Code(),
        members=fields.code("members") or Code(),
        common=_common(RecordFields(fields.value_map("common"))),
        states=tuple(_state(name, state) for name, state in fields.record_map("states")),
    )


def decode_project(data: FormatValue, default_name: str) -> Project:
    """A project without its designs; `default_name` names it when the file does not."""
    fields = RecordFields(data)
    return Project(
        name=fields.text("project", default_name),
        doc=fields.text("doc"),
        languages=fields.text_list("languages") if fields.has("languages") else ("python",),
        world=fields.text("world"),
        generated=fields.text("generated", "generated"),
        enumerations=tuple(
            Enumeration(
                name=name,
                doc=each.text("doc"),
                elements=each.text_map("elements"),
                internal=each.flag("internal"),
                xabsl_name=each.text("xabsl_name"),
                xabsl_elements=each.text_map("xabsl_elements"),
            )
            for name, each in fields.record_map("enumerations")
        ),
        constants=_declarations(fields, "constants", "value"),
        components=tuple(_interface(name, each) for name, each in fields.record_map("components")),
        agents=tuple(
            Agent(
                name=name,
                root=agent.text("root"),
                title=agent.text("title"),
                doc=agent.text("doc"),
                xabsl_name=agent.text("xabsl_name"),
            )
            for name, agent in fields.record_map("agents")
        ),
    )


def _declarations(fields: RecordFields, section: str, value_key: str) -> tuple[Declaration, ...]:
    return tuple(
        Declaration(
            name=name,
            type=each.text("type"),
            initial=each.text(value_key),
            unit=each.text("unit"),
            range=each.pair("range"),
            doc=each.text("doc"),
            xabsl_name=each.text("xabsl_name"),
            arguments=_declarations(each, "arguments", "default") if each.has("arguments") else None,
        )
        for name, each in fields.record_map(section)
    )


def _interface(name: str, fields: RecordFields) -> Interface:
    return Interface(
        component=name,
        title=fields.text("title"),
        doc=fields.text("doc"),
        xabsl_name=fields.text("xabsl_name"),
        implementation=fields.text("implementation"),
        frequency_hz=fields.number("frequency"),
        parameters=_declarations(fields, "parameters", "default"),
        outputs=_declarations(fields, "outputs", "initial"),
        variables=_declarations(fields, "variables", "initial"),
    )


def _common(fields: RecordFields) -> CommonSection:
    return CommonSection(
        doc=fields.text("doc"),
        at=fields.pair("at"),
        actions=_actions(fields, "actions"),
        transitions=_decisions(fields, "transitions"),
    )


def _state(name: str, fields: RecordFields) -> State:
    return State(
        name=name,
        id=fields.text("id"),
        xabsl_name=fields.text("xabsl_name"),
        doc=fields.text("doc"),
        at=fields.pair("at"),
        final=fields.flag("final"),
        capacity=fields.number("capacity"),
        synchronized=fields.number("synchronized"),
        disabled=fields.flag("disabled"),
        requires=fields.text_list("requires"),
        modulates=tuple(
            Call(alias=alias, arguments=cast("tuple[tuple[str, str], ...]", arguments))
            for alias, arguments in fields.value_map("modulates")
        ),
        enter=_actions(fields, "enter"),
        actions=_actions(fields, "actions"),
        leave=_actions(fields, "leave"),
        transitions=_decisions(fields, "transitions"),
    )


def _actions(fields: RecordFields, name: str) -> tuple[Action, ...]:
    return tuple(_action(action) for action in fields.record_list(name))


def _action(fields: RecordFields) -> Action:
    if fields.has("set"):
        return Assign(values=fields.text_map("set"))
    if fields.has("call"):
        return Call(alias=fields.text("call"), arguments=fields.text_map("with"))
    return RunCode(code=fields.code("code") or Code(), id=fields.text("id"))


def _decisions(fields: RecordFields, name: str) -> tuple[Decision, ...]:
    return tuple(_decision(decision) for decision in fields.record_list(name))


def _decision(fields: RecordFields) -> Decision:
    guard = Guard(when=fields.text("when"), after=fields.text("after"), code=fields.code("code"))
    doc, id_, disabled = fields.text("doc"), fields.text("id"), fields.flag("disabled")
    if fields.has("to"):
        to, label_at = fields.text("to"), fields.pair("label_at")
        return Transition(to=to, guard=guard, doc=doc, id=id_, disabled=disabled, label_at=label_at)
    if fields.has("stay"):
        return Stay(guard=guard, doc=doc, id=id_, disabled=disabled)
    then, otherwise = _decisions(fields, "then"), _decisions(fields, "else")
    return DecisionGroup(guard=guard, then=then, otherwise=otherwise, doc=doc, id=id_, disabled=disabled)
