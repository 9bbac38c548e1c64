"""Faults of the Python runtime for `benchmarks.planted_faults`."""

from dataclasses import dataclass

PYTHON = ("python",)
CPP = ("cpp",)
XABSL = ("xabsl",)
ALL = ("python", "cpp", "xabsl")


@dataclass(frozen=True, slots=True)
class Fault:
    """A fault: in a file, the text `old`, which occurs once, is replaced by `new`.

    Attributes:
        languages: The languages whose traces it may change.
        equivalent: Why it changes no trace, if so; tests of its package may still notice it.
    """

    file: str
    doc: str
    old: str
    new: str
    languages: tuple[str, ...]
    equivalent: str = ""

    @property
    def key(self) -> tuple[str, str]:
        """What tells it from others."""
        return self.file, self.doc

    def plant(self, source: str) -> str:
        """Return the text of its file with the fault.

        Raises:
            ValueError: The text does not occur exactly once.
        """
        if (count := source.count(self.old)) != 1:
            raise ValueError(f"{self.file}: '{self.doc}' replaces a text that occurs {count} times")
        return source.replace(self.old, self.new)


_COMPONENT = "vicode/bica/component.py"
_LEAVE = """            if leave is not None:
                leave()
            self._left = old
            self._transition = transition
            self._current = new
            self.state = name
            self._entered_ns = self.root.now_ns
"""
_LEAVE_LATE = """            self._left = old
            self._transition = transition
            self._current = new
            self.state = name
            self._entered_ns = self.root.now_ns
            if leave is not None:
                leave()
"""
_ENTER = """            if enter is not None:
                enter()
            if new.requires and new.requires != old.requires:
                for component in new.requires:
                    if component not in old.requires:
                        component.step()
"""
_ENTER_LATE = """            if new.requires and new.requires != old.requires:
                for component in new.requires:
                    if component not in old.requires:
                        component.step()
            if enter is not None:
                enter()
"""

RUNTIME_FAULTS = (
    Fault(_COMPONENT, "restart only after two missed iterations", "if missed > 1:", "if missed > 2:", PYTHON),
    Fault(_COMPONENT, "the first activation resumes", "is_first=missed > iteration + 1", "is_first=False", PYTHON),
    Fault(
        _COMPONENT,
        "period elapsed 1 ns late",
        "now_ns - self._worked_ns >= period",
        "now_ns - self._worked_ns > period",
        PYTHON,
    ),
    Fault(
        _COMPONENT,
        "period truncated",
        "self._period_ns = round(1e9 / self.frequency_hz)",
        "self._period_ns = int(1e9 / self.frequency_hz)",
        PYTHON,
    ),
    Fault(
        _COMPONENT,
        "period of hand-written components truncated",
        "self._period_ns = round(1e9 / hertz)",
        "self._period_ns = int(1e9 / hertz)",
        PYTHON,
    ),
    Fault(_COMPONENT, "done for one iteration more", "- self._stepped_in <= 1", "- self._stepped_in <= 2", PYTHON),
    Fault(_COMPONENT, "leave in the new state", _LEAVE, _LEAVE_LATE, PYTHON),
    Fault(_COMPONENT, "enter after the new requires", _ENTER, _ENTER_LATE, PYTHON),
    Fault(_COMPONENT, "new requires stepped again", "if component not in old.requires:", "if component:", PYTHON),
    Fault(_COMPONENT, "second decision in the new state", "        run(False)\n", "        run()\n", PYTHON),
    Fault(_COMPONENT, "stay skips the actions", "        self._current.run(False)\n", "        pass\n", PYTHON),
    Fault(
        _COMPONENT,
        "repeated calls keep the parameters of others",
        "            _modulate(component, parameters)\n            component.step()",
        "            component.step()",
        PYTHON,
    ),
    Fault(
        _COMPONENT,
        "calls of earlier works are repeated",
        "                if self._called:\n                    self._called = []",
        "                pass",
        PYTHON,
    ),
    Fault(
        _COMPONENT,
        "a restart does not count as elapsed period",
        "self._worked_ns = now_ns - self._period_ns",
        "self._worked_ns = now_ns",
        PYTHON,
    ),
    Fault(
        _COMPONENT,
        "component_time continues after a restart",
        "self._started_ns = self._entered_ns = now_ns",
        "self._entered_ns = now_ns",
        PYTHON,
    ),
    Fault(
        _COMPONENT,
        "no enter at a restart",
        "        if initial.enter is not None:\n            initial.enter()",
        "        if initial.enter is None:\n            return",
        PYTHON,
    ),
    Fault(
        "vicode/bica/base_root.py",
        "time is not continued",
        "        self._skip_time(clock_ns - self.now_ns)\n",
        "",
        PYTHON,
    ),
    Fault("vicode/bica/base_root.py", "time runs backwards", "if now_ns < self.now_ns:", "if now_ns < 0:", PYTHON),
    Fault(
        "vicode/bica/xabsl.py",
        "done at once after a restart",
        "return self._restarted_in != iteration",
        "return True",
        PYTHON,
    ),
    Fault("vicode/bica/xabsl.py", "one restart per iteration", "self._stepped_in = iteration - 2", "pass", PYTHON),
    Fault(
        "vicode/bica/arithmetic.py",
        "division by -0.0",
        "return math.copysign(math.inf, a) * math.copysign(1.0, zero)",
        "return math.copysign(math.inf, a)",
        PYTHON,
    ),
    Fault(
        "vicode/bica/arithmetic.py",
        "% with the sign of the dividend",
        "return float(a) % float(b)",
        "return math.fmod(float(a), float(b)) if b else math.nan",
        PYTHON,
    ),
    Fault(
        "vicode/bica/arithmetic.py",
        "round half up",
        "return _limited(x, round)",
        "return _limited(x, lambda y: math.floor(y + 0.5))",
        PYTHON,
    ),
    Fault("vicode/bica/arithmetic.py", "clamp of nan", "return min(x, high)", "return min(high, x)", PYTHON),
    Fault("vicode/bica/arithmetic.py", "division of XABSL", "return a / (b or 1e-7)", "return a / (b or 1e-6)", PYTHON),
    Fault(
        "vicode/bica/arithmetic.py",
        "minimum of nan",
        "return min(a, *others) if others else a",
        "return min(*reversed((a, *others))) if others else a",
        PYTHON,
        "generated Python calls min; the editor evaluates guards with this function",
    ),
    Fault(
        "vicode/bica/arithmetic.py",
        "saturation at nan",
        "    if is_nan(x):\n        return 0\n",
        "    if is_nan(x):\n        return -MAX_INT\n",
        PYTHON,
    ),
    Fault(
        "vicode/bica/team.py",
        "one iteration more to wait",
        "self.waiting_iterations >= self.team.ticks",
        "self.waiting_iterations > self.team.ticks",
        PYTHON,
    ),
    Fault(
        "vicode/bica/team.py",
        "one robot more to enter together",
        "self.in_component + 1 >= self.number",
        "self.in_component >= self.number",
        PYTHON,
    ),
    Fault(
        "vicode/bica/team.py",
        "capacity not contested by one",
        "self.executing + self.entering >= self.number",
        "self.executing + self.entering > self.number",
        PYTHON,
    ),
)
