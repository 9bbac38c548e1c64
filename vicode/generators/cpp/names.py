"""Names in generated C++: those of the design, with a trailing `_` where C++ or the runtime uses the name itself."""

import re
from collections.abc import Callable, Collection, Iterable
from dataclasses import dataclass, replace

from vicode.generators.cpp.c_names import is_c_name
from vicode.generators.plan import ComponentPlan, PackagePlan, ProjectPlan, ValuePlan
from vicode.languages import LANGUAGES
from vicode.model.names import python_attribute_name

RESERVED_MODULES = frozenset(
    {*LANGUAGES["cpp"].keywords, "bica", "components", "declarations", "interfaces", "live", "world"}
)
"""File names that no design may use."""

_KEYWORDS = LANGUAGES["cpp"].keywords
_GLOBAL_NAMES = frozenset({"Component", "Components", "State", "World", "XabslComponent", "bica", "root", "std"})
_MEMBERS = frozenset(
    [
        "Parameters",
        "State",
        "act",
        "act_common",
        "action_done_of",
        "already",
        "attempt",
        "begin_observed_step",
        "call",
        "call_id",
        "called",
        "change_state",
        "change_to",
        "conflict_of",
        "count_step",
        "decide",
        "decide_common",
        "end_observed_step",
        "enter",
        "enter_state",
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
        "code_hash",
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
        "step_large_machine",
        "step_machine",
        "step_modulated",
        "step_observed",
        "stepped_in",
        "transition",
        "visit_inputs",
        "visit_parameters",
        "visit_values",
        "visitor",
        "was_stepped",
        "will_work",
    ]
)


_CMAKE_TARGETS = frozenset(
    ["all", "clean", "edit_cache", "help", "install", "list_install_components", "package", "rebuild_cache", "test"]
)
"""Targets that CMake makes itself."""

# With a trailing `_` these are data members of generated classes.
_STORED = frozenset({"calls", "root", "state", "world"})
# Other members of bica::Component, which hide global names in its subclasses; designs may have values of these names.
_HIDING_LIST = """
action_done component_time conflict is_done modulate never_ on_error period restart restarted_in_ set_frequency state
state_time step stepped_in_ work
"""
_HIDING = frozenset(_HIDING_LIST.split())
# Private data members of bica::Component, which hide global names in its subclasses.
_PRIVATE = frozenset({"entered_ns_", "left_", "name_", "period_ns_", "started_ns_", "transition_", "worked_ns_"})


def namespace(package: PackagePlan) -> str:
    return f"{package.name}_" if is_c_name(package.name) else escape(package.name, {*_GLOBAL_NAMES, "main"})


def library(package: PackagePlan) -> str:
    """The name of the library in CMake."""
    name = namespace(package)
    return f"{name}_" if name in _CMAKE_TARGETS else name


# Macros of the standard headers and of POSIX; Arduino has more, which bica.hpp undefines.
_MACRO_LIST = """
ARDUINO BIG_ENDIAN BUFSIZ BYTE_ORDER CLOCKS_PER_SEC CSIGNAL DECIMAL_DIG EOF EXIT_FAILURE EXIT_SUCCESS FILENAME_MAX
FOPEN_MAX HAVE_INITFINI_ARRAY INFINITY LITTLE_ENDIAN L_ctermid L_cuserid L_tmpnam MAXFLOAT MB_CUR_MAX NAN NFDBITS NULL
PDP_ENDIAN P_tmpdir RAND_MAX TIME_UTC TMP_MAX WCONTINUED WEOF WEXITED WEXITSTATUS WIFCONTINUED WIFEXITED WIFSIGNALED
WIFSTOPPED WNOHANG WNOWAIT WSTOPPED WSTOPSIG WTERMSIG WUNTRACED alloca assert be16toh be32toh be64toh errno htobe16
htobe32 htobe64 htole16 htole32 htole64 iscanonical issubnormal le16toh le32toh le64toh linux math_errhandling offsetof
pthread_cleanup_pop pthread_cleanup_pop_restore_np pthread_cleanup_push pthread_cleanup_push_defer_np sched_priority
signgam stderr stdin stdout strdupa strndupa strtodf unix va_arg va_copy va_end va_start
E2BIG EACCES EADDRINUSE EADDRNOTAVAIL EADV EAFNOSUPPORT EAGAIN EALREADY EBADE EBADF EBADFD EBADMSG EBADR EBADRQC
EBADSLT EBFONT EBUSY ECANCELED ECHILD ECHRNG ECOMM ECONNABORTED ECONNREFUSED ECONNRESET EDEADLK EDEADLOCK EDESTADDRREQ
EDOM EDOTDOT EDQUOT EEXIST EFAULT EFBIG EHOSTDOWN EHOSTUNREACH EHWPOISON EIDRM EILSEQ EINPROGRESS EINTR EINVAL EIO
EISCONN EISDIR EISNAM EKEYEXPIRED EKEYREJECTED EKEYREVOKED EL2HLT EL2NSYNC EL3HLT EL3RST ELIBACC ELIBBAD ELIBEXEC
ELIBMAX ELIBSCN ELNRNG ELOOP EMEDIUMTYPE EMFILE EMLINK EMSGSIZE EMULTIHOP ENAMETOOLONG ENAVAIL ENETDOWN ENETRESET
ENETUNREACH ENFILE ENOANO ENOBUFS ENOCSI ENODATA ENODEV ENOENT ENOEXEC ENOKEY ENOLCK ENOLINK ENOMEDIUM ENOMEM ENOMSG
ENONET ENOPKG ENOPROTOOPT ENOSPC ENOSR ENOSTR ENOSYS ENOTBLK ENOTCONN ENOTDIR ENOTEMPTY ENOTNAM ENOTRECOVERABLE
ENOTSOCK ENOTSUP ENOTTY ENOTUNIQ ENXIO EOPNOTSUPP EOVERFLOW EOWNERDEAD EPERM EPFNOSUPPORT EPIPE EPROTO EPROTONOSUPPORT
EPROTOTYPE ERANGE EREMCHG EREMOTE EREMOTEIO ERESTART ERFKILL EROFS ESHUTDOWN ESOCKTNOSUPPORT ESPIPE ESRCH ESRMNT ESTALE
ESTRPIPE ETIME ETIMEDOUT ETOOMANYREFS ETXTBSY EUCLEAN EUNATCH EUSERS EWOULDBLOCK EXDEV EXFULL
"""
_MACROS = frozenset(_MACRO_LIST.split())
_MACRO_FAMILY = re.compile(
    r"(INT|UINT|SIZE|PTRDIFF|SIG_ATOMIC|WINT|WCHAR)\w*_(MAX|MIN|WIDTH|C)|(HUGE_VAL|SNAN)(|_?[FL]\d*X?)"
    r"|M_[A-Z0-9_]*[A-Z0-9](f\d*x?|l)?"
    r"|(ADJ|BICA|CLOCK|CLONE|CPU|DBL|FD|FLT|FP|LC|LDBL|MATH|MOD|PTHREAD|RENAME|SCHED|SEEK|STA|TIMER)_[A-Z0-9_]*[A-Z0-9]",
    re.ASCII,
)
# Functions of generated code, such as do_kick() and when_kick_to_wait(), and its local variables.
_GENERATED_NAME = re.compile(r"(do|when|in)_\w*|value_\d+|argument_\d+_\w+", re.ASCII)


def integer_type(count: int) -> str:
    """The type of an enumeration with so many elements."""
    return "std::uint8_t" if count <= 256 else "std::uint16_t"


def escape(name: str, taken: Collection[str] = ()) -> str:
    """The name, with a trailing `_` (`_2`, `_3`, …) if it is a keyword, a macro or taken."""
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
        classes: dict[str, str] = {}
        for name in plan.project.interfaces():
            classes[name] = escape(name, taken | _members(plan, name) | set(classes.values()))
        names = {}
        taken |= _MEMBERS | set(classes.values())
        for declared in [*(item.name for item in plan.enumerations), *(item.name for item in plan.constants)]:
            names[declared] = escape(declared, taken)
            taken |= {names[declared]}
        return cls(namespace(plan.package), names, classes)

    def inside(self, members: Iterable[str]) -> "GlobalNames":
        """The names as a class with these members must write them."""
        return replace(self, members=_HIDING.union(members))

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
    return {member_name(name) for name in (*(value.name for value in own), *aliases)} | _MEMBERS | {"work"}


_TYPES = {"bool": "bool", "int": "std::int64_t", "float": "bica::Real"}
