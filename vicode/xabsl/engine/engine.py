"""The engine: executes compiled programs. Uses the standard library only."""

import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from types import CodeType, SimpleNamespace
from typing import Any

from .arithmetic import divide, remainder
from .emitter import PythonEmitter
from .linker import NEVER, BehaviorRecord, WorldLinker
from .program import Program
from .recursion import allow_calls
from .symbols import SymbolList
from .team import CapacityState, CoopMessage, CoopState, StrictSynchronizedState, SynchronizedState, TeamSettings
from .validation import LoadError, check_loops, check_structure, check_symbols, select_used_symbols, used_symbols

_MASK = 0xFFFFFFFF


class OptionRecord:
    """Runtime data of an option: function of its state, times of activation, last cycle and parameters."""

    __slots__ = ("__dict__", "is_target", "last_cycle", "option_since", "run", "state_since", "was_active")

    def __init__(self, parameters: Iterable[object]) -> None:
        self.run: Callable[[int, int], None]
        self.last_cycle, self.was_active, self.is_target = NEVER, False, False
        self.option_since = self.state_since = 0
        for number, value in enumerate(parameters):
            setattr(self, f"p{number}", value)


@dataclass(slots=True)
class OptionView:
    """Status of an option. Times in milliseconds since the activation of the option and its state."""

    name: str
    is_active: bool
    state: str
    option_time: int
    state_time: int
    parameters: dict[str, Any]


def monotonic_ms() -> int:
    return time.monotonic_ns() // 1_000_000


@lru_cache(maxsize=8)
def _compile(source: str) -> CodeType:
    """Compile the functions of a program once for all robots that run it."""
    return compile(source, "<behavior>", "exec")


class Engine:
    """Executes a program for one robot, cycle by cycle.

    Args:
        program: a compiled program, or the result of `read_code`.
        world: object with the symbols as attributes; dots in names become underscores. A callable input is called with
            its parameters as keywords. Values of enumerations are strings: the unqualified names of the elements.
        behaviors: basic behaviors by name, called with keywords. Others are looked up in `world`.
        symbols: all symbols of the robot program. Without them, only the symbols that the program uses are known, and
            parameters omitted in all calls take the default values of the Python function.
        clock: returns the time in milliseconds.
        strict: reject programs in which an option or behavior may be active twice in a cycle, as the second version of
            the original engine does.
        traced: record each cycle in `trace`.

    Raises:
        LoadError: The program cannot run with this world; the error lists all reasons.
    """

    def __init__(
        self,
        program: Program,
        world: object,
        *,
        behaviors: Mapping[str, Callable[..., object]] | None = None,
        symbols: SymbolList | None = None,
        clock: Callable[[], int] = monotonic_ms,
        strict: bool = False,
        traced: bool = False,
    ) -> None:
        allow_calls(len(program.options))
        self.program, self.world, self.clock = program, world, clock
        self.symbols = select_used_symbols(symbols, program) if symbols is not None else used_symbols(program)
        self.errors: list[str] = []
        """Errors of the last cycle."""
        self.errors_occurred = False
        """Whether an error occurred since the start or the last `reset`."""
        self.trace: list[Any] = []
        """Nodes of the last cycle in the order of execution: ["s", symbol, value], ["b", behavior, time,
        {parameter: value}] and ["o", option, state, option_time, state_time, {parameter: value}, [node], state before].
        """
        self.messages: list[str] = []
        """Conflicts between robots in the last cycle."""
        self.cycle = 0
        self.team = TeamSettings()
        self.memory = SimpleNamespace()
        problems = check_structure(program)
        if not problems and symbols is not None:
            problems = check_symbols(program, symbols)
        problems = problems or check_loops(program, strict=strict)
        if problems:
            raise LoadError(problems)
        self._is_traced = traced
        self._linker = WorldLinker(program, self.symbols, world, behaviors or {}, self.memory)
        zero = self._linker.default_value
        self._records = [OptionRecord([zero(slot) for slot in option.parameters]) for option in program.options]
        self._numbers = {option.name: number for number, option in enumerate(program.options)}
        self._functions = self._linker.functions
        self._load(strict=strict, traced=traced)
        self.agent = program.agents[0][0] if program.agents else ""
        self._roots: list[tuple[Callable[[int, int], None], str]] = []
        if program.agents:
            self.select(self.agent)

    # Execution

    def execute(self) -> None:
        """Run one cycle, starting from each root action."""
        now = self.clock() & _MASK
        self.cycle = cycle = self.cycle + 1
        if self.errors:
            self.errors = []
        if self.messages:
            self.messages.clear()
        if self._is_traced:
            self.trace = []
        for run, _name in self._roots:
            run(now, cycle)

    def select(self, agent: str) -> bool:
        """Switch to another agent without a reset. Returns False and changes nothing if there is no such agent."""
        root = next((root for name, root in self.program.agents if name == agent), None)
        if root is None:
            return False
        self.agent = agent
        self.set_root(root)
        return True

    def set_root(self, name: str, **parameters: Any) -> None:
        """Replace all root actions by one option or basic behavior with these parameters."""
        self._roots = []
        self.add_root(name, **parameters)

    def add_root(self, name: str, **parameters: Any) -> None:
        """Add an option or basic behavior to the root actions.

        Raises:
            LoadError: There is no option or basic behavior of this name.
        """
        number = self._numbers.get(name)
        if number is None:
            act = self._linker.find_behavior(name)

            def play(_now: int, _cycle: int) -> None:
                act(**parameters)

            self._roots.append((play, name))
            return
        record, slots = self._records[number], self.program.options[number].parameters
        run = self._functions[f"run{number}"]
        arguments = {f"{name}.{key}": value for key, value in parameters.items()}
        values = [
            (f"p{index}", arguments.get(slot.name, self._linker.default_value(slot)))
            for index, slot in enumerate(slots)
        ]

        def call(now: int, cycle: int) -> None:
            for key, value in values:
                setattr(record, key, value)
            run(now, cycle)

        self._roots.append((call if values else run, name))

    def reset(self) -> None:
        """Restart all options in their initial states with the next cycle; symbols keep their values."""
        # Skip two cycles, so that no option counts as active in the previous cycle.
        self.cycle += 2
        self.errors_occurred = False

    # Team communication

    def prepare_incoming_messages(self) -> None:
        """Discard the messages of the previous cycle. Call it once per cycle, before `process_incoming_message`."""
        for state in self._coop:
            state.begin_cycle()

    def process_incoming_message(self, message: CoopMessage) -> None:
        for number in message.executed:
            self._coop[number].executing += 1
        for number in message.entering:
            state = self._coop[number]
            state.highest_priority = (
                max(state.highest_priority, message.priority) if state.entering else message.priority
            )
            state.entering += 1
        for number in message.option_executed:
            self._coop[number].in_option += 1

    def generate_outgoing_message(self) -> CoopMessage:
        """Create the message for the other robots after this cycle."""
        executed, entering, option_executed = [], [], []
        for number, coop in enumerate(self._coop):
            record = self._records[self._numbers[coop.option]]
            if record.last_cycle != self.cycle:
                continue
            option_executed.append(number)
            if self._states[record.run] == coop.state:
                executed.append(number)
            elif coop.is_entering:
                entering.append(number)
        return CoopMessage(self.team.priority, tuple(executed), tuple(entering), tuple(option_executed))

    # Inspection

    @property
    def options(self) -> list[OptionView]:
        """The status of all options after the last cycle."""
        now = self.clock() & _MASK
        return [self._view(number, now) for number in range(len(self._records))]

    @property
    def active_options(self) -> list[OptionView]:
        """The options executed in the last cycle."""
        return [view for view in self.options if view.is_active]

    def _view(self, number: int, now: int) -> OptionView:
        option, record = self.program.options[number], self._records[number]
        is_active = record.last_cycle == self.cycle
        parameters = {slot.name: getattr(record, f"p{index}") for index, slot in enumerate(option.parameters)}
        state = self._states.get(record.run, option.initial) if record.last_cycle != NEVER else option.initial
        times = (now - record.option_since) & _MASK, (now - record.state_since) & _MASK
        return OptionView(option.name, is_active, state, *times, parameters)

    # Loading

    def _load(self, *, strict: bool, traced: bool) -> None:
        emitter = PythonEmitter(self.program, self._linker.link(), traced=traced, strict=strict)
        self.source = emitter.source()
        """The generated Python source, for debugging."""
        self._coop = self._coop_states(emitter.coop, strict=strict)
        functions = self._functions
        functions.update({f"o{number}": record for number, record in enumerate(self._records)})
        functions.update({f"c{number}": state for number, state in enumerate(self._coop)})
        functions.update(w=self.world, m=self.memory, divide=divide, remainder=remainder)
        functions.update(
            twice=self._report_double_execution,
            begin=self._begin_option_trace,
            end=self._end_option_trace,
            note=self._trace_symbol,
            play=self._trace_behavior,
        )
        # Safe: all names in the source are generated; words of the program occur only as literals written by `repr`.
        exec(_compile(self.source), functions)  # noqa: S102
        self._states = {
            functions[f"s{number}_{state_number}"]: state.name
            for number, option in enumerate(self.program.options)
            for state_number, state in enumerate(option.states)
        }

    def _coop_states(self, numbers: Mapping[tuple[str, str], int], *, strict: bool) -> list[CoopState]:
        states = {(option.name, state.name): state for option in self.program.options for state in option.states}
        kinds = {"c": CapacityState, "s": StrictSynchronizedState if strict else SynchronizedState}
        return [kinds[states[key].mode](*key, states[key].robots, self.team, self.messages) for key in numbers]

    # Callbacks of the generated functions

    def _report_double_execution(self, number: int) -> None:
        name = self.program.options[number].name
        self.errors_occurred = True
        self.errors.append(
            f'XabslOption::execute(): option "{name}" is executed multiple times. '
            "This is unsupported. Resulting behavior might be unexpected."
        )

    def _begin_option_trace(self, number: int) -> list[Any]:
        inner: list[Any] = []
        outer, self.trace = self.trace, inner
        state = self._states[self._records[number].run]
        outer.append(["o", self.program.options[number].name, state, 0, 0, {}, inner, state])
        return outer

    def _end_option_trace(self, number: int, outer: list[Any], now: int) -> None:
        view = self._view(number, now)
        node = outer[-1]
        node[2:6] = [view.state, view.option_time, view.state_time, view.parameters]
        self.trace = outer

    def _trace_symbol(self, symbol: str, value: object) -> None:
        self.trace.append(["s", symbol, value])

    def _trace_behavior(self, record: BehaviorRecord, now: int, cycle: int, arguments: dict[str, Any]) -> None:
        if record.last_cycle != cycle:
            record.was_active = record.last_cycle == cycle - 1
        if not record.was_active:
            record.active_since = now
        parameters = {slot.name: arguments[record.keywords[slot.name]] for slot in record.slots}
        self.trace.append(["b", record.name, (now - record.active_since) & _MASK, parameters])
        record.act(**arguments)
        record.last_cycle = cycle
