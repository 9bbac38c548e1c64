"""From the model's values to the format's: the way back of `building`."""

from collections.abc import Iterable

from vicode.model.design import (
    Action,
    Assign,
    Call,
    Code,
    Decision,
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
from vicode.store.format import (
    ACTION,
    AGENT,
    COMMON,
    CONSTANT,
    DECISION,
    DESIGN,
    ENUMERATION,
    INTERFACE,
    OUTPUT,
    PARAMETER,
    PROJECT,
    STATE,
    USE,
    VARIABLE,
    VERSION,
)
from vicode.store.schema_types import FormatValue, RecordSchema, build_record_value


def encode_design(design: Design) -> FormatValue:
    """A design as the format's value."""
    return build_record_value(
        DESIGN,
        {
            "vicode": VERSION,
            "component": design.component,
            "doc": design.doc,
            "xabsl_name": design.xabsl_name,
            "frequency": design.frequency_hz,
            "resume": design.resume,
            "arithmetic": design.arithmetic,
            "time_unit": design.time_unit,
            "uses": tuple((use.alias, _use(use)) for use in design.uses),
            "parameters": _declarations(PARAMETER, "default", design.parameters),
            "outputs": _declarations(OUTPUT, "initial", design.outputs),
            "variables": _declarations(VARIABLE, "initial", design.variables),
            "initial": design.initial,
            "module": design.module.texts,
            "members": design.members.texts,
            "common": build_record_value(
                COMMON,
                {
                    "doc": design.common.doc,
                    "at": design.common.at,
                    "actions": _actions(design.common.actions),
                    "transitions": _decisions(design.common.transitions),
                },
            ),
            "states": tuple((state.name, _state(state)) for state in design.states),
        },
    )


def encode_project(project: Project) -> FormatValue:
    """What project.yaml says of a project, as the format's value."""
    return build_record_value(
        PROJECT,
        {
            "vicode": VERSION,
            "project": project.name,
            "doc": project.doc,
            "languages": project.languages,
            "world": project.world,
            "generated": project.generated,
            "enumerations": tuple((each.name, _enumeration(each)) for each in project.enumerations),
            "constants": _declarations(CONSTANT, "value", project.constants),
            "components": tuple((each.component, _interface(each)) for each in project.components),
            "agents": tuple((agent.name, _agent(agent)) for agent in project.agents),
        },
    )


def _use(use: Use) -> FormatValue:
    return build_record_value(USE, {"component": use.component, "at": use.at})


def _agent(agent: Agent) -> FormatValue:
    return build_record_value(
        AGENT, {"root": agent.root, "title": agent.title, "doc": agent.doc, "xabsl_name": agent.xabsl_name}
    )


def _enumeration(enumeration: Enumeration) -> FormatValue:
    return build_record_value(
        ENUMERATION,
        {
            "doc": enumeration.doc,
            "elements": enumeration.elements,
            "internal": enumeration.internal,
            "xabsl_name": enumeration.xabsl_name,
            "xabsl_elements": enumeration.xabsl_elements,
        },
    )


def _interface(interface: Interface) -> FormatValue:
    return build_record_value(
        INTERFACE,
        {
            "implementation": interface.implementation,
            "title": interface.title,
            "xabsl_name": interface.xabsl_name,
            "frequency": interface.frequency_hz,
            "doc": interface.doc,
            "parameters": _declarations(PARAMETER, "default", interface.parameters),
            "outputs": _declarations(OUTPUT, "initial", interface.outputs),
            "variables": _declarations(VARIABLE, "initial", interface.variables),
        },
    )


def _declarations(record: RecordSchema, value_key: str, declarations: Iterable[Declaration]) -> FormatValue:
    return tuple((each.name, _declaration(record, value_key, each)) for each in declarations)


def _declaration(record: RecordSchema, value_key: str, declaration: Declaration) -> FormatValue:
    arguments = declaration.arguments
    values: dict[str, FormatValue | None] = {
        "type": declaration.type,
        value_key: declaration.initial,
        "unit": declaration.unit,
        "range": declaration.range,
        "doc": declaration.doc,
        "xabsl_name": declaration.xabsl_name,
        "arguments": None if arguments is None else _declarations(PARAMETER, "default", arguments),
    }
    return build_record_value(record, values)


def _state(state: State) -> FormatValue:
    return build_record_value(
        STATE,
        {
            "id": state.id,
            "xabsl_name": state.xabsl_name,
            "doc": state.doc,
            "at": state.at,
            "final": state.final,
            "capacity": state.capacity,
            "synchronized": state.synchronized,
            "disabled": state.disabled,
            "requires": state.requires,
            "modulates": tuple((call.alias, call.arguments) for call in state.modulates),
            "enter": _actions(state.enter),
            "actions": _actions(state.actions),
            "leave": _actions(state.leave),
            "transitions": _decisions(state.transitions),
        },
    )


def _actions(actions: Iterable[Action]) -> FormatValue:
    return tuple(_action(action) for action in actions)


def _action(action: Action) -> FormatValue:
    match action:
        case Assign(values=values):
            return build_record_value(ACTION, {"set": values})
        case Call(alias=alias, arguments=arguments):
            return build_record_value(ACTION, {"call": alias, "with": arguments})
        case RunCode(code=code, id=id_):
            return build_record_value(ACTION, {"code": code.texts, "id": id_})


def _decisions(decisions: Iterable[Decision]) -> FormatValue:
    return tuple(_decision(decision) for decision in decisions)


def _decision(decision: Decision) -> FormatValue:
    values = _guard(decision.guard) | {"doc": decision.doc, "id": decision.id, "disabled": decision.disabled}
    match decision:
        case Transition(to=to, label_at=label_at):
            values["to"] = to
            values["label_at"] = label_at
        case Stay():
            values["stay"] = True
        case _:
            values["then"] = _decisions(decision.then)
            values["else"] = _decisions(decision.otherwise)
    return build_record_value(DECISION, values)


def _guard(guard: Guard) -> dict[str, FormatValue | None]:
    code: Code | None = guard.code
    return {"when": guard.when, "after": guard.after, "code": None if code is None else code.texts}
