"""Names in generated C++: those of the design, with a trailing `_` where C++ or the runtime uses the name itself."""

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

from vicode.generators.plan import ComponentPlan, PackagePlan, ProjectPlan, ValuePlan
from vicode.languages import LANGUAGES
from vicode.model.names import python_attribute_name

RESERVED_MODULES = frozenset({*LANGUAGES["cpp"].keywords, "bica", "components", "declarations", "interfaces", "world"})
"""File names that no design may use."""

_KEYWORDS = LANGUAGES["cpp"].keywords
_GLOBAL_NAMES = frozenset({"Component", "Components", "State", "World", "XabslComponent", "bica", "root", "std"})
_MEMBERS = frozenset(
    [
        "Parameters",
        "State",
        "act",
        "act_common",
        "already",
        "attempt",
        "call",
        "call_id",
        "called",
        "change_state",
        "change_to",
        "count_step",
        "decide",
        "decide_common",
        "enter",
        "entered_ns",
        "errors",
        "forget_calls",
        "in_final_state",
        "is_restarting",
        "is_recent",
        "leave",
        "left_state",
        "mark_restart",
        "may_enter",
        "must_work",
        "name",
        "next",
        "parameters",
        "period_ns",
        "repeat_calls",
        "require",
        "required",
        "required_by",
        "restart_again",
        "record_change",
        "restart_machine",
        "restart_times",
        "run_step",
        "start",
        "state_name",
        "state_time_ns",
        "component_time_ns",
        "stay",
        "step_machine",
        "step_modulated",
        "step_observed",
        "stepped_in",
        "transition",
        "visit_parameters",
        "visit_values",
        "visitor",
        "was_stepped",
    ]
)


# With a trailing `_` these are data members of generated classes.
_STORED = frozenset({"calls", "root", "state", "world"})
# Private data members of bica::Component, which hide global names in its subclasses.
_PRIVATE = frozenset({"entered_ns_", "left_", "name_", "period_ns_", "started_ns_", "transition_", "worked_ns_"})


def namespace(package: PackagePlan) -> str:
    return escape(package.name, _GLOBAL_NAMES)


# Macros of the standard headers and of POSIX; Arduino has more, which bica.hpp undefines.
_MACRO_LIST = """
BIG_ENDIAN BUFSIZ BYTE_ORDER CLOCKS_PER_SEC EOF EXIT_FAILURE EXIT_SUCCESS FILENAME_MAX FOPEN_MAX HUGE_VAL INFINITY
LITTLE_ENDIAN NAN NULL PDP_ENDIAN RAND_MAX SNAN TIME_UTC TMP_MAX WEOF alloca assert errno linux offsetof
stderr stdin stdout unix
E2BIG EACCES EAGAIN EALREADY EBADE EBADF EBADR EBFONT EBUSY ECANCELED ECHILD ECOMM EDEADLK EDOM EDQUOT EEXIST EFAULT
EFBIG EIDRM EILSEQ EINTR EINVAL EIO EISCONN EISDIR ELOOP EMFILE EMLINK ENFILE ENODATA ENODEV ENOENT ENOEXEC ENOLCK
ENOLINK ENOMEM ENOMSG ENONET ENOSPC ENOSR ENOSTR ENOSYS ENOTBLK ENOTDIR ENOTSUP ENOTTY ENXIO EPERM EPIPE EPROTO ERANGE
EREMOTE EROFS ESPIPE ESRCH ESTALE ETIME ETIMEDOUT EUCLEAN EUNATCH EUSERS EXDEV EXFULL
"""
_MACROS = frozenset(_MACRO_LIST.split())
_MACRO_FAMILY = re.compile(
    r"(INT|UINT|SIZE|PTRDIFF|SIG_ATOMIC|WINT|WCHAR)\w*_(MAX|MIN|WIDTH|C)|(CLOCK|CPU|FP|LC|M|MOD|SEEK|STA)_[A-Z0-9_]*[A-Z0-9]",
    re.ASCII,
)
# Functions of generated code, such as do_kick() and when_kick_to_wait(), and its local variables.
_GENERATED_NAME = re.compile(r"(do|when|in)_\w*|value_\d+|argument_\d+_\w+", re.ASCII)


def escape(name: str, taken: Iterable[str] = ()) -> str:
    """The name, with a trailing `_` (`_2`, `_3`, …) if it is a keyword, a macro or taken."""
    taken = {*taken}
    free, number = name, 1
    while free in _KEYWORDS or free in taken or free in _MACROS or _MACRO_FAMILY.fullmatch(free):
        # Two `_` in a row are reserved.
        free = f"{name.rstrip('_')}_" if number == 1 and not name.endswith("_") else f"{name.rstrip('_')}_{number}"
        # `M_PI_2` is a macro too.
        free += "_" if number > 1 and _MACRO_FAMILY.fullmatch(free) else ""
        number += 1
    return free


def member_name(name: str) -> str:
    """The name of a value or used component in its class; different names stay different."""
    return _distinct(name, _is_reserved_member)


def argument_name(alias: str) -> str:
    """The name of the argument of the constructor that a data member is initialized with."""
    name = member_name(alias)
    return f"{name}0" if name.endswith("_") else f"{name}_"


def element_name(name: str) -> str:
    """The name of an element of an enumeration."""
    return _distinct(name, lambda each: escape(each) != each)


def _distinct(name: str, is_reserved: Callable[[str], bool]) -> str:
    """A reserved name gets a trailing `_`; a name that another one may get, a trailing 0."""
    base, underscore, zeros = name.rpartition("_")
    if underscore and not zeros.strip("0") and is_reserved(base):
        return f"{name}0"
    return f"{name}_" if is_reserved(name) else name


def _is_reserved_member(name: str) -> bool:
    return name in _MEMBERS or name in _STORED or escape(name) != name or bool(_GENERATED_NAME.fullmatch(name))


def state_names(component: ComponentPlan) -> dict[str, str]:
    """The elements of the enumeration of the states; a name that starts with a digit gets a leading `S`."""
    taken: set[str] = set()
    names = {}
    for state in component.states:
        name = state.name
        names[name] = escape(f"S{name}" if name[0].isdigit() or name[0] == "_" else name, taken)
        taken.add(names[name])
    return names


def world_name(value: ValuePlan) -> str:
    """The name of a method of the world, as in Python."""
    return escape(python_attribute_name(value.xabsl_name or value.name))


@dataclass(frozen=True, slots=True)
class GlobalNames:
    """The names in the namespace of the project; `members` hides some of them inside a class."""

    namespace: str
    names: dict[str, str]
    classes: dict[str, str]
    members: frozenset[str] = frozenset()

    @classmethod
    def of_project(cls, plan: ProjectPlan) -> "GlobalNames":
        # A namespace `world` of XABSL becomes a component `world_`.
        taken = _GLOBAL_NAMES | _PRIVATE | {f"{name}_" for name in _STORED}
        classes = {name: escape(name, taken | _members(plan, name)) for name in plan.project.interfaces()}
        names = {}
        taken = _GLOBAL_NAMES | _PRIVATE | _MEMBERS | set(classes.values())
        for declared in [*(item.name for item in plan.enumerations), *(item.name for item in plan.constants)]:
            names[declared] = escape(declared, taken)
            taken |= {names[declared]}
        return cls(namespace(plan.package), names, classes)

    def inside(self, members: Iterable[str]) -> "GlobalNames":
        """The names as a class with these members must write them."""
        return replace(self, members=frozenset(members))

    def declared(self, name: str) -> str:
        """An enumeration or constant."""
        return self._qualified(self.names[name])

    def class_name(self, component: str) -> str:
        return self._qualified(self.classes[component])

    def type_name(self, type_: str) -> str:
        """The C++ type of a value."""
        return _TYPES.get(type_) or self.declared(type_)

    def _qualified(self, name: str) -> str:
        return f"::{self.namespace}::{name}" if name in self.members else name


def _members(plan: ProjectPlan, component: str) -> set[str]:
    """The members of a class, which cannot have its name."""
    interface, design = plan.project.interface(component), plan.project.design(component)
    declared = (*interface.parameters, *interface.readable) if interface else ()
    own = (*(value for _section, value in design.declarations()), *declared) if design else declared
    aliases = (use.alias for use in design.uses) if design else ()
    return {member_name(name) for name in (*(value.name for value in own), *aliases)} | _MEMBERS


_TYPES = {"bool": "bool", "int": "std::int64_t", "float": "double"}
