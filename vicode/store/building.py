"""From the format's values to the model's."""

from typing import cast

from vicode.model.design import (
    Action,
    Assign,
    Call,
    Code,
    Common,
    Decision,
    Declaration,
    Design,
    Group,
    Guard,
    RunCode,
    State,
    Stay,
    Transition,
    Use,
)
from vicode.model.project import Agent, Enumeration, Interface, Project
from vicode.store.shapes import Data


class Fields:
    """A record's value, asked key by key; a missing key has the value that its absence means."""

    def __init__(self, data: Data) -> None:
        """Wrap pairs of name and value."""
        self.values = dict(cast("tuple[tuple[str, Data], ...]", data))

    def has(self, name: str) -> bool:
        """Whether the key is there."""
        return name in self.values

    def text(self, name: str, missing: str = "") -> str:
        """A text."""
        return cast("str", self.values.get(name, missing))

    def number(self, name: str) -> float | None:
        """A number."""
        return cast("float | None", self.values.get(name))

    def flag(self, name: str) -> bool:
        """A truth."""
        return cast("bool", self.values.get(name, False))

    def pair(self, name: str) -> tuple[float, float] | None:
        """Two numbers."""
        return cast("tuple[float, float] | None", self.values.get(name))

    def words(self, name: str) -> tuple[str, ...]:
        """A list of texts."""
        return cast("tuple[str, ...]", self.values.get(name, ()))

    def texts(self, name: str) -> tuple[tuple[str, str], ...]:
        """A table of texts."""
        return cast("tuple[tuple[str, str], ...]", self.values.get(name, ()))

    def pairs(self, name: str) -> tuple[tuple[str, Data], ...]:
        """A table of other things."""
        return cast("tuple[tuple[str, Data], ...]", self.values.get(name, ()))

    def table(self, name: str) -> "list[tuple[str, Fields]]":
        """A table of records."""
        return [(key, Fields(value)) for key, value in self.pairs(name)]

    def items(self, name: str) -> "list[Fields]":
        """A list of records."""
        return [Fields(value) for value in cast("tuple[Data, ...]", self.values.get(name, ()))]

    def code(self, name: str) -> Code | None:
        """Code, None when the key is missing."""
        return Code(texts=self.texts(name)) if name in self.values else None


def build_design(data: Data, otherwise: str) -> Design:
    """A design; `otherwise` names its component when the file does not."""
    fields = Fields(data)
    return Design(
        component=fields.text("component", otherwise),
        doc=fields.text("doc"),
        xabsl_name=fields.text("xabsl_name"),
        frequency_hz=fields.number("frequency"),
        resume=fields.flag("resume"),
        arithmetic=fields.text("arithmetic"),
        time_unit=fields.text("time_unit"),
        uses=tuple(
            Use(alias=alias, component=use.text("component"), at=use.pair("at")) for alias, use in fields.table("uses")
        ),
        parameters=_declarations(fields, "parameters", "default"),
        outputs=_declarations(fields, "outputs", "initial"),
        variables=_declarations(fields, "variables", "initial"),
        initial=fields.text("initial"),
        module=fields.code("module") or Code(),
        members=fields.code("members") or Code(),
        common=_common(Fields(fields.pairs("common"))),
        states=tuple(_state(name, state) for name, state in fields.table("states")),
    )


def build_project(data: Data, otherwise: str) -> Project:
    """A project without its designs; `otherwise` names it when the file does not."""
    fields = Fields(data)
    return Project(
        name=fields.text("project", otherwise),
        doc=fields.text("doc"),
        languages=fields.words("languages") if fields.has("languages") else ("python",),
        world=fields.text("world"),
        generated=fields.text("generated", "generated"),
        enumerations=tuple(
            Enumeration(
                name=name,
                doc=each.text("doc"),
                elements=each.texts("elements"),
                internal=each.flag("internal"),
                xabsl_name=each.text("xabsl_name"),
                xabsl_elements=each.texts("xabsl_elements"),
            )
            for name, each in fields.table("enumerations")
        ),
        constants=_declarations(fields, "constants", "value"),
        components=tuple(_interface(name, each) for name, each in fields.table("components")),
        agents=tuple(
            Agent(
                name=name,
                root=agent.text("root"),
                title=agent.text("title"),
                doc=agent.text("doc"),
                xabsl_name=agent.text("xabsl_name"),
            )
            for name, agent in fields.table("agents")
        ),
    )


def _declarations(fields: Fields, section: str, value_key: str) -> tuple[Declaration, ...]:
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
        for name, each in fields.table(section)
    )


def _interface(name: str, fields: Fields) -> Interface:
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


def _common(fields: Fields) -> Common:
    return Common(
        doc=fields.text("doc"),
        at=fields.pair("at"),
        actions=_actions(fields, "actions"),
        transitions=_decisions(fields, "transitions"),
    )


def _state(name: str, fields: Fields) -> State:
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
        requires=fields.words("requires"),
        modulates=tuple(
            Call(alias=alias, arguments=cast("tuple[tuple[str, str], ...]", arguments))
            for alias, arguments in fields.pairs("modulates")
        ),
        enter=_actions(fields, "enter"),
        actions=_actions(fields, "actions"),
        leave=_actions(fields, "leave"),
        transitions=_decisions(fields, "transitions"),
    )


def _actions(fields: Fields, name: str) -> tuple[Action, ...]:
    return tuple(_action(action) for action in fields.items(name))


def _action(fields: Fields) -> Action:
    if fields.has("set"):
        return Assign(values=fields.texts("set"))
    if fields.has("call"):
        return Call(alias=fields.text("call"), arguments=fields.texts("with"))
    return RunCode(code=fields.code("code") or Code(), id=fields.text("id"))


def _decisions(fields: Fields, name: str) -> tuple[Decision, ...]:
    return tuple(_decision(decision) for decision in fields.items(name))


def _decision(fields: Fields) -> Decision:
    guard = Guard(when=fields.text("when"), after=fields.text("after"), code=fields.code("code"))
    doc, id_, disabled = fields.text("doc"), fields.text("id"), fields.flag("disabled")
    if fields.has("to"):
        to, label_at = fields.text("to"), fields.pair("label_at")
        return Transition(to=to, guard=guard, doc=doc, id=id_, disabled=disabled, label_at=label_at)
    if fields.has("stay"):
        return Stay(guard=guard, doc=doc, id=id_, disabled=disabled)
    then, otherwise = _decisions(fields, "then"), _decisions(fields, "else")
    return Group(guard=guard, then=then, otherwise=otherwise, doc=doc, id=id_, disabled=disabled)
