"""Checks the topics of ROS 2 in profiles."""

import re
from collections.abc import Callable, Iterator

from vicode.bica.errors import NetworkError
from vicode.bica.ros_messages import FieldError, MessageField, find_field, message_fields
from vicode.findings import DesignPath, did_you_mean
from vicode.model.design import Declaration
from vicode.model.expressions import BOOL, FLOAT, INT, build_scope
from vicode.model.project import Interface, Project, TopicReference

_TOPIC = re.compile(r"/?[A-Za-z_]\w*(/[A-Za-z_]\w*)*\Z", re.ASCII)
_SET_BY_RUNTIME = ("data_age", "is_alive")
_KINDS = {BOOL: ("bool",), INT: ("int",), FLOAT: ("float", "int")}
Problem = tuple[DesignPath, str, str]
"""Place, message and fix."""


def find_bad_topics(project: Project, choice: TopicReference) -> Iterator[Problem]:
    """Yield what is wrong in a topic. Types are not checked if rosbags is not installed."""
    interface = project.interface(choice.component)
    assert interface is not None
    if not _TOPIC.match(choice.topic):
        yield ("topic",), f"'{choice.topic}' is no name of a topic", "use letters, digits, _ and /, such as /scan"
    if bool(choice.outputs) == bool(choice.parameters):
        message = "a topic is either read or published"
        yield (), message, "give 'outputs' or 'parameters'; use two components for both directions"
        return
    if not choice.type:
        yield (), f"the topic '{choice.topic}' has no type", "add 'type: package/msg/Name'"
        return
    yield from _find_unassigned(interface, choice)
    try:
        message_fields(choice.type)
        type_of = build_scope(project, None).type_of
        for section in ("outputs", "parameters"):
            for name, source in getattr(choice, section):
                yield from _find_bad_field(interface, choice, (section, name), source, type_of=type_of)
    except FieldError as error:
        yield ("type",), str(error), did_you_mean(error.name, error.known, "use a type such as std_msgs/msg/String")
    except NetworkError:
        return


def _find_unassigned(interface: Interface, choice: TopicReference) -> Iterator[Problem]:
    """Outputs of a topic that is read, and parameters of one that is published, that have no field."""
    given = dict(choice.outputs or choice.parameters)
    section = "outputs" if choice.outputs else "parameters"
    for declared in getattr(interface, section):
        if declared.name not in given and declared.name not in _SET_BY_RUNTIME:
            yield (section,), f"'{declared.name}' of '{interface.component}' has no field", f"add it to '{section}'"


def _find_bad_field(
    interface: Interface,
    choice: TopicReference,
    place: tuple[str, str],
    source: str,
    *,
    type_of: Callable[[Declaration], str],
) -> Iterator[Problem]:
    section, name = place
    declared: tuple[Declaration, ...] = getattr(interface, section)
    declaration = next((each for each in declared if each.name == name), None)
    if declaration is None:
        kind = section.removesuffix("s")
        names = [each.name for each in declared]
        yield place, f"'{interface.component}' has no {kind} '{name}'", did_you_mean(name, names, "declare it")
        return
    if name in _SET_BY_RUNTIME and section == "outputs":
        yield place, f"'{name}' is set by the runtime", "remove it from 'outputs'"
        return
    try:
        field = find_field(choice.type, source)
    except FieldError as error:
        yield place, str(error), did_you_mean(error.name, error.known, "use a field of the type")
        return
    if section == "parameters" and field.fold:
        yield place, f"'{source}' cannot be published", "use a field that is no array"
    elif not _fits(type_ := type_of(declaration), field, section):
        yield place, f"'{name}' is {type_}, '{source}' is {field.kind}", "use a field of the same type"


def _fits(type_: str, field: MessageField, section: str) -> bool:
    """Whether values can be converted; elements of enumerations are numbers or texts in messages."""
    if section == "parameters" and type_ == INT:
        return field.kind in ("int", "float")
    if section == "parameters" and type_ == FLOAT:
        return field.kind == "float"
    return field.kind in _KINDS.get(type_, ("int", "string"))
