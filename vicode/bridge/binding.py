"""Binds behaviors to the class of a world: what they use must exist, and sensors get the types of the project."""

import inspect
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from vicode.bridge.declarations import Command, Event, Sensor
from vicode.bridge.dialects import RESERVED_TARGETS
from vicode.bridge.world import World, list_declarations


@dataclass(frozen=True, slots=True, kw_only=True)
class Requirement:
    """A name that a behavior reads or calls.

    Attributes:
        name: The attribute of the world.
        description: What it is for the behavior, such as "input symbol ball.distance".
        place: Where it is declared, such as "project.yaml:12:7".
        parameters: Those of a call; None if it is read.
    """

    name: str
    description: str
    place: str
    parameters: tuple[str, ...] | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclaredType:
    """The type of a value in the project; `elements` are those of an enumeration."""

    value_type: type[Any]
    elements: tuple[str, ...] = ()
    unit: str = ""
    bounds: tuple[float, float] | None = None


def find_missing(world: World, requirements: Iterable[Requirement]) -> list[str]:
    """Describe everything that the behaviors use and the world does not have, one line each."""
    problems = ((each, _find_problem(world, each)) for each in requirements)
    return list(dict.fromkeys(f"{each.place}: {each.description}{problem}" for each, problem in problems if problem))


def find_declaration_problems(world_class: type[World]) -> list[str]:
    """Describe targets that belong to the protocol or are declared twice, and values that cannot be folded."""
    received = _list_received(world_class)
    sent = list_declarations(world_class, Command)
    reserved = [each.target for each in (*received, *sent) if each.target in RESERVED_TARGETS]
    problems = [f"target {target} is reserved for the protocol" for target in reserved]
    for targets in ([each.target for each in received], [each.target for each in sent]):
        problems += [f"target {each} is declared twice" for each in dict.fromkeys(targets) if targets.count(each) > 1]
    folded = [(each.target, each.fold_problem) for each in received if isinstance(each, Sensor)]
    return problems + [f"{target}: {problem}" for target, problem in folded if problem]


def apply_types(world_class: type[World], types: Mapping[str, DeclaredType]) -> None:
    """Give sensors and events of one value the type, range and unit of the project's output of the same name."""
    for each in _list_received(world_class):
        parameters, declared = each.parameters, types.get(each.name)
        if declared is None or parameters.is_list or parameters.fields:
            continue
        if isinstance(each, Event) and not each.has_value:
            continue
        if parameters.value_type is None:
            parameters.value_type, parameters.elements = declared.value_type, declared.elements
        if parameters.bounds is None and parameters.value_type in (int, float):
            parameters.bounds = declared.bounds
        if isinstance(each, Sensor):
            each.unit = each.unit or declared.unit


def _list_received(world_class: type[World]) -> list[Sensor | Event]:
    return [*list_declarations(world_class, Sensor), *list_declarations(world_class, Event)]


def _find_problem(world: World, required: Requirement) -> str:
    """Why a requirement is not met; "" if it is."""
    command = inspect.getattr_static(type(world), required.name, None)
    if isinstance(command, Command) and required.parameters is not None:
        unknown = [each for each in required.parameters if each not in command.parameters]
        return f": the command has no parameter {', '.join(unknown)}" if unknown else ""
    try:
        value = getattr(world, required.name)
    except AttributeError:
        return f": the world has no {required.name}"
    except Exception:
        # A property that fails before the first values, which is reported in the tick that reads it.
        return ""
    if required.parameters is None:
        return ""
    if not callable(value):
        return f": {required.name} is no method of the world"
    try:
        inspect.signature(value).bind(**dict.fromkeys(required.parameters))
    except TypeError as error:
        return f": {required.name}: {error}"
    except ValueError:
        # Not known for some functions written in C.
        return ""
    return ""
