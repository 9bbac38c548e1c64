"""The commands of the console of running robots, in the terminal and in the editor: words of COLBERT, gdb and pdb."""

import asyncio
import contextlib
import math
import re
from collections.abc import Awaitable, Callable, Iterable, Mapping
from dataclasses import replace
from typing import Any, TypeVar

from vicode.findings import did_you_mean
from vicode.generators import UnsoundDesignError
from vicode.model.design import COMMON, Design, Transition
from vicode.model.expressions import parse_expression
from vicode.model.project import Project
from vicode.model.traversal import iter_transitions
from vicode.runs import PARAMETERS, SimulationInput
from vicode.runs.guard_values import format_value, guard_values
from vicode.runs.input_script import InputTextError, read_value
from vicode.runs.inputs import declared_input
from vicode.services.running_robots.robot_link import (
    ANY_ERROR,
    ERROR_PLACE,
    NO_CONTROL,
    LinkStatus,
    Place,
    RobotLink,
    RobotRequestError,
)
from vicode.services.running_robots.watched_robot import WatchedRobot

_T = TypeVar("_T")
_BREAKPOINT = "STATE|A->B|error"
_SHORT = {"b": "break", "c": "go", "continue": "go", "p": "print", "s": "step"}
_WITHOUT_CONTROL = ("help", "print", "robot", "states")
_ARROW = re.compile(r"\s*(?:->|→)\s*")
_LAST_WORD = re.compile(r"[^\s()]*$")
_MOST_LISTED = 12
_POLL_S = 0.02


class ConsoleError(Exception):
    """A command that was not done; the message says why, and what would be right."""


class RobotConsole:
    """Runs commands on the robot that a connection follows.

    Args:
        link: The connection.
        project: Returns the project of the robot; if it has no design of a component, what was received is known.
        component: Returns the component whose names need no prefix; by default, the root of the robot.
        set_breakpoints: Replaces the breakpoints of a component.
        waits: Whether commands wait until their effect was received, as scripts need it.
    """

    def __init__(
        self,
        link: RobotLink,
        project: Callable[[], Project],
        *,
        component: Callable[[], str] = lambda: "",
        set_breakpoints: Callable[[str, tuple[Place, ...]], Awaitable[None]] | None = None,
        waits: bool = False,
    ) -> None:
        self._link, self._project, self._component, self._waits = link, project, component, waits
        self._set_breakpoints = set_breakpoints or link.set_breakpoints
        self.commands: Mapping[str, tuple[str, str, Callable[[str, str], Awaitable[str]]]] = {
            "help": ("", "list the commands", self._help),
            "pause": ("", "pause the robot", self._pause),
            "resume": ("", "end the pause", self._resume),
            "go": ("[STATE]", "end the pause; with a state: enter it, a pause remains", self._go),
            "step": ("[N]", "run one iteration, or N, then pause", self._step),
            "break": (f"[{_BREAKPOINT}]", "pause when this happens; alone: list the breakpoints", self._break),
            "clear": (f"[{_BREAKPOINT}]", "remove a breakpoint; alone: all", self._clear),
            "set": ("NAME VALUE", "set an output, variable, parameter or tunable constant", self._set),
            "hold": ("NAME VALUE", "set a value in each iteration", lambda *given: self._set(*given, hold=True)),
            "unset": ("NAME", "hold a value no longer", self._unset),
            "print": ("[EXPRESSION]", "show a value or expression; alone: all values of the component", self._print),
            "states": ("", "list the components with their active state and their states", self._states),
            "robot": ("[ROBOT]", "follow another robot; alone: list the robots", self._follow),
            "frequency": ("COMPONENT HZ", "change the frequency of a component", self._set_frequency),
            "raise": ("COMPONENT [MESSAGE]", "let the next step of a component raise an exception", self._raise),
        }

    async def run(self, line: str) -> str:
        """Run a command and return its answer.

        Raises:
            ConsoleError: It was not done.
        """
        word, *rest = line.split(maxsplit=1) or [""]
        name = _SHORT.get(word, word)
        arguments, _doc, act = _find("command", name, self.commands)
        # "set x = 1" as in gdb.
        given = (re.split(r"\s*=\s*|\s+", rest[0].strip(), maxsplit=1) if " " in arguments else rest) if rest else []
        required = sum(part[0] != "[" for part in arguments.split())
        if not required <= len(given) <= len(arguments.split()):
            raise ConsoleError(f"write: {name} {arguments}".rstrip())
        if self._link.status is LinkStatus.CONNECTED and not self._link.control and name not in _WITHOUT_CONTROL:
            raise ConsoleError(NO_CONTROL)
        # What the names mean is known with the first iteration.
        await self._wait(lambda robot: robot.iteration or name == "help")
        try:
            return await act(*(*(each.strip() for each in given), "", "")[:2])
        except RobotRequestError as error:
            raise ConsoleError(str(error)) from error

    def complete(self, line: str) -> tuple[str, ...]:
        """What the last word of a line may be."""
        last = _LAST_WORD.findall(line)[0]
        name, *before = line.removesuffix(last).split() or [""]
        arguments = self.commands[_SHORT.get(name, name)][0].split() if _SHORT.get(name, name) in self.commands else []
        kind = arguments[min(len(before), len(arguments) - 1)].strip("[]") if arguments else ""
        known: Mapping[str, Callable[[], Iterable[str]]] = {
            _BREAKPOINT: lambda: (*self._list_states(), "error"),
            "STATE": self._list_states,
            "NAME": self._values,
            "EXPRESSION": self._values,
            "VALUE": lambda: _list_literals(self._values().get(before[0])),
            "COMPONENT": lambda: self._robot.description.components,
            "ROBOT": lambda: self._link.robots,
        }
        names = (known[kind]() if kind in known and self._link.robot else ()) if name else self.commands
        found = (each for each in names if each.startswith(last))
        # Short names first, then those with an alias, then those with a component.
        return tuple(sorted(found, key=lambda each: ("." in each, each.swapcase())))

    @property
    def _robot(self) -> WatchedRobot:
        if self._link.robot is None:
            raise ConsoleError(f"there is no robot: {self._link.problem or 'attach to one first'}")
        return self._link.robot

    @property
    def _shown(self) -> str:
        return self._component() or self._robot.description.root

    def _values(self) -> dict[str, SimulationInput]:
        """The values by `name` of the shown component, `alias.name` and `Component.name`; constants by name.

        What is not declared has no type.
        """
        robot, design = self._robot, self._project().design(self._shown)
        inputs = robot.iteration.inputs if robot.iteration else {}
        owners = [(f"{name}.", name) for name in (*robot.description.components, *inputs)]
        owners += [(f"{use.alias}.", use.component) for use in (design.uses if design else ())]
        owners += [("", PARAMETERS), ("", self._shown)]
        return {f"{start}{name}": value for start, owner in owners for name, value in self._values_of(owner).items()}

    def _values_of(self, component: str) -> dict[str, SimulationInput]:
        """The received values of a component, else the declared ones."""
        project, declared = self._project(), {}
        interface = project.interface(component)
        own = (*interface.parameters, *interface.readable) if interface else ()
        for each in project.constants if component == PARAMETERS else own:
            with contextlib.suppress(UnsoundDesignError):
                declared[each.name] = declared_input(project, component, each)
        names = self._robot.values_of(component) or declared
        unknown = SimulationInput(component=component, name="", type="", initial=None)
        return {name: declared.get(name, replace(unknown, name=name)) for name in names}

    def _list_states(self) -> dict[str, tuple[str, str]]:
        """Component and state by `state` of the shown component, and by `Component.state`."""
        components = self._robot.description.components
        own = components[self._shown].states if self._shown in components else ()
        every = {f"{name}.{state}": (name, state) for name, each in components.items() for state in each.states}
        return {**{state: (self._shown, state) for state in own}, **every}

    async def _help(self, *_: str) -> str:
        rows = self.commands.items()
        return "\n".join(f"{name} {arguments}".rstrip() + f"\t{doc}" for name, (arguments, doc, _act) in rows)

    async def _go(self, state: str, _: str) -> str:
        if not state:
            return await self._resume()
        component, entered = _find("state", state, self._list_states())
        return await self._link.request("enter", component=component, state=entered)

    async def _resume(self, *_: str) -> str:
        before = self._robot.iteration_number
        done = await self._link.request("resume")
        await self._wait(lambda robot: not robot.is_paused or robot.iteration_number != before)
        return done

    async def _pause(self, *_: str) -> str:
        done = await self._link.request("pause")
        await self._wait(lambda robot: robot.is_paused)
        return done

    async def _step(self, count: str, _: str) -> str:
        if count and not re.fullmatch(r"0*[1-9]\d{0,6}", count):
            raise ConsoleError(f"'{count}' is no number of iterations; write: step 10")
        before = self._robot.iteration_number
        done = await self._link.request("step", count=int(count or 1))
        await self._wait(lambda robot: robot.is_paused and robot.iteration_number != before)
        return done

    async def _break(self, text: str, _: str) -> str:
        if text:
            component, places = self._find_places(text)
            known = self._link.breakpoints.get(component, ())
            await self._set_breakpoints(component, tuple(dict.fromkeys((*known, *places))))
        set_ = [_describe(component, each) for component, places in self._link.breakpoints.items() for each in places]
        return f"breakpoints: {', '.join(set_) or 'none'}"

    async def _clear(self, text: str, _: str) -> str:
        found = dict([self._find_places(text)]) if text else dict(self._link.breakpoints)
        for component, places in found.items():
            known = self._link.breakpoints.get(component, ())
            if text and not set(places) & set(known):
                raise ConsoleError(f"there is no breakpoint '{text}'; break lists them")
            await self._set_breakpoints(component, tuple(each for each in known if each not in places))
        return await self._break("", "")

    def _find_places(self, text: str) -> tuple[str, tuple[Place, ...]]:
        """The component and places of a breakpoint; a transition may have several, one for each id."""
        if text == "error":
            return ANY_ERROR, (ERROR_PLACE,)
        source, *targets = _ARROW.split(text, maxsplit=1)
        component, state = _find("state", source, self._list_states())
        if not targets:
            return component, ((state,),)
        design = self._project().design(component)
        if design is None:
            raise ConsoleError(f"the design of {component} is not here: vicode attach ADDRESS FOLDER --console")
        leading = [each.decision for each in iter_transitions(design) if each.source in (state, COMMON)]
        target = targets[0].removeprefix(f"{component}.")
        found: dict[str, dict[Place, None]] = {}
        for each in leading:
            if isinstance(each, Transition):
                found.setdefault(each.to, {})[state, each.to, each.id or None] = None
        return component, tuple(_find(f"transition from {state} to", target, found))

    async def _set(self, name: str, text: str, *, hold: bool = False) -> str:
        value = _find("value", name, self._values())
        if value.component == PARAMETERS:
            if not any(each.name == name and each.tunable for each in self._project().constants):
                raise ConsoleError(f"the constant {name} cannot be changed; declare it with tunable: true")
            return await self._link.request("tune", name=name, value=_parse_value(text, value))
        if value.component not in self._robot.description.components:
            raise ConsoleError(f"{name} cannot be set: the world provides it")
        key = {"component": value.component, "name": value.name}
        return await self._link.request("set", **key, value=_parse_value(text, value), hold=hold)

    async def _unset(self, name: str, _: str) -> str:
        value = _find("value", name, self._values())
        return await self._link.request("unset", component=value.component, name=value.name)

    async def _print(self, text: str, _: str) -> str:
        robot, values = self._robot, self._values()
        if not text:
            own = robot.values_of(self._shown)
            return "\n".join(f"{key} = {_format(each)}" for key, each in own.items()) or f"{self._shown} has no values"
        if text in values and values[text].component != PARAMETERS:
            value = values[text]
            return f"{text} = {_format(robot.values_of(value.component).get(value.name))} {value.unit}".rstrip()
        return f"{text} = {_format(self._evaluate(text, values))}"

    def _evaluate(self, text: str, values: Mapping[str, object]) -> Any:
        """The value of an expression as in guards of the shown component; None if it reads what was not received."""
        robot, project = self._robot, self._project()
        if robot.iteration is None:
            raise ConsoleError(f"nothing was received of {robot.name} yet")
        steps = {name: seen.step for name, seen in robot.steps.items()}
        tree = [dict(step) for name, step in steps.items() if name == self._shown or robot.is_active(name)]
        inputs = {name: robot.values_of(name) for name in robot.iteration.inputs}
        now = replace(robot.iteration, component=self._shown, tree=tree, inputs=inputs)
        design = project.design(self._shown) or Design(component=self._shown)
        known = guard_values(project, design, now, steps, robot.tuned)
        parsed = parse_expression(text, known.scope)
        if parsed.tree is None or parsed.diagnostics:
            if text.replace(".", "_").isidentifier():
                _find("value", text, values)
            raise ConsoleError("; ".join(filter(None, (parsed.diagnostics[0].message, parsed.diagnostics[0].fix))))
        return known.evaluate(parsed.tree)

    async def _states(self, *_: str) -> str:
        rows = []
        for name, each in self._robot.description.components.items():
            if each.states:
                seen = self._robot.steps.get(name)
                active = seen.step.get("state") if seen and self._robot.is_active(name) else "not active"
                rows.append(f"{name}: {active} (of {', '.join(each.states)})")
        return "\n".join(rows)

    async def _follow(self, name: str, _: str) -> str:
        if name:
            _find("robot", name, self._link.robots)
            self._link.follow(name)
            await self._wait(lambda robot: any("values" in seen.step for seen in robot.steps.values()))
        rows = [(each.name, each.root_state, "paused" * each.is_paused) for each in self._link.robots.values()]
        return "\n".join(f"{'* ' if row[0] == self._link.followed else '  '}{'  '.join(row)}".rstrip() for row in rows)

    async def _set_frequency(self, component: str, text: str) -> str:
        _find("component", component, self._robot.description.components)
        hertz = _guess(text)
        if isinstance(hertz, bool | str):
            raise ConsoleError(f"'{text}' is no frequency in Hz; write: frequency {component} 50")
        return await self._link.request("frequency", component=component, hz=hertz)

    async def _raise(self, component: str, message: str) -> str:
        _find("component", component, self._robot.description.components)
        return await self._link.request("raise", component=component, message=message)

    async def _wait(self, fits: Callable[[WatchedRobot], object]) -> None:
        while self._waits and self._link.status is LinkStatus.CONNECTED and not fits(self._robot):
            await asyncio.sleep(_POLL_S)


def _find(kind: str, name: str, known: Mapping[str, _T]) -> _T:
    if name not in known:
        listed = [each for each in known if "." not in each] or list(known)
        words = f"known are {', '.join(listed[:_MOST_LISTED])}" if listed else "none is known"
        raise ConsoleError(f"there is no {kind} '{name}'; {did_you_mean(name, known, words)}")
    return known[name]


def _parse_value(text: str, value: SimulationInput) -> Any:
    if not value.type and not value.options:
        return _guess(text)
    low, high = value.range or (-math.inf, math.inf)
    limits = f" from {low:g} to {high:g} {value.unit}".rstrip() if value.range else ""
    try:
        parsed = read_value(text, value)
    except InputTextError as error:
        raise ConsoleError(f"{error}{limits}") from error
    if not isinstance(parsed, str) and not low <= parsed <= high:
        raise ConsoleError(
            f"'{text}' is no value of {f'{value.component}.{value.name}'.lstrip('.')}: it must be{limits}"
        )
    return parsed


def _guess(text: str) -> Any:
    """The value of a text whose type is not declared; the robot compares the type."""
    with contextlib.suppress(ValueError):
        if math.isfinite(number := float(text)):
            return int(text) if text.lstrip("+-").isdecimal() else number
    return {"true": True, "false": False}.get(text, text)


def _list_literals(value: SimulationInput | None) -> tuple[str, ...]:
    return value.options or (("true", "false") if value.type == "bool" else ()) if value else ()


def _format(value: Any) -> str:
    return f"{value:.10g}" if isinstance(value, float) else format_value(value)


def _describe(component: str, place: Place) -> str:
    ends = " -> ".join(part or "any" for part in place[:2])
    return f"{component}.{ends}{f' ({place[2]})' if place[2:] and place[2] else ''}" if component else ends
