"""The syntax tree of a file: all that was written but white space, so that printing it gives the same tokens again.

Nodes know the numbers of their first and last token (`at`, `to`; -1 when they were not read from a text). Those, and
only those, do not count when nodes are compared. The classes are not frozen: a file is read in half the time so.
"""

from dataclasses import dataclass, field

from vicode.xabsl.lexer import Comment


@dataclass(slots=True, kw_only=True)
class Node:
    """Anything in a file."""

    at: int = field(default=-1, compare=False)
    to: int = field(default=-1, compare=False)


@dataclass(slots=True)
class Name(Node):
    """A word where it is declared or used; names of option parameters begin with @ in the option."""

    text: str


# Expressions


@dataclass(slots=True)
class Number(Node):
    """A number without sign, as it was written."""

    text: str


@dataclass(slots=True)
class Word(Node):
    """`true`, `false`, `state_time`, `option_time`, `action_done` or `conflict`."""

    text: str


@dataclass(slots=True)
class Ref(Node):
    """A symbol, parameter, constant or element of an enumeration."""

    name: str


@dataclass(slots=True)
class Argument(Node):
    """A parameter by its name, and what it is given."""

    name: Name
    value: "Expression"


@dataclass(slots=True)
class Arguments(Node):
    """What stands between parentheses; a comma may follow the last."""

    given: list[Argument]
    ends_with_comma: bool = False


@dataclass(slots=True)
class Function(Node):
    """An input symbol with parentheses."""

    name: Name
    arguments: Arguments


@dataclass(slots=True)
class Parentheses(Node):
    """An expression in parentheses."""

    inner: "Expression"


@dataclass(slots=True)
class Unary(Node):
    """`-` or `!` before an operand."""

    operator: str
    operand: "Expression"


@dataclass(slots=True)
class Binary(Node):
    """Two operands; `sign` is the number of the operator's token."""

    operator: str
    left: "Expression"
    right: "Expression"
    sign: int = field(default=-1, compare=False)


@dataclass(slots=True)
class Conditional(Node):
    """`condition ? yes : no`."""

    condition: "Expression"
    yes: "Expression"
    no: "Expression"


Expression = Number | Word | Ref | Function | Parentheses | Unary | Binary | Conditional

# Decisions and actions


@dataclass(slots=True)
class Goto(Node):
    """`goto state;`."""

    state: Name


@dataclass(slots=True)
class Stay(Node):
    """`stay;`."""


@dataclass(slots=True)
class If(Node):
    """A condition with a tree for each answer; no `otherwise` at the open end of a common decision.

    `doc` stood before `if`, `else_doc` before `else`.
    """

    condition: Expression
    then: "Tree"
    otherwise: "Tree | None"
    doc: str = ""
    else_doc: str = ""


@dataclass(slots=True)
class Block(Node):
    """A tree in braces."""

    inner: "Tree"


Tree = Goto | Stay | If | Block


@dataclass(slots=True)
class Decision(Node):
    """What stands in `decision { }`; `begins_with_else` where a common decision goes before it."""

    tree: Tree
    begins_with_else: bool = False
    else_doc: str = ""


@dataclass(slots=True)
class Assignment(Node):
    """`symbol = value;`."""

    symbol: Name
    value: Expression


@dataclass(slots=True)
class Call(Node):
    """A call of an option or a basic behavior; `kind` is "", "option" or "behavior"."""

    name: Name
    arguments: Arguments
    kind: str = ""


Action = Assignment | Call


@dataclass(slots=True)
class Actions(Node):
    """What stands in `action { }`."""

    actions: list[Action]


# Declarations


@dataclass(slots=True)
class Type(Node):
    """`float`, `bool` or `enum NAME`."""

    text: str
    enum: Name | None = None


@dataclass(slots=True)
class Parameter(Node):
    """A parameter of an option, a function or a basic behavior; without a type it is a decimal."""

    name: Name
    type: Type | None = None
    range: str = ""
    unit: str = ""
    doc: str = ""


@dataclass(slots=True)
class Constant(Node):
    """`float const name = 3 "m";`, the number with its sign; `float` may be missing."""

    name: Name
    number: str
    unit: str = ""
    doc: str = ""
    says_float: bool = True


@dataclass(slots=True)
class Enumeration(Node):
    """`enum name { a, b };`, its values the engine's own where it is internal."""

    name: Name
    elements: list[Name]
    is_internal: bool = False
    doc: str = ""


@dataclass(slots=True)
class Symbol(Node):
    """An input, output or internal symbol (`direction`); `parameters` is None without parentheses."""

    direction: str
    name: Name
    type: Type | None = None
    range: str = ""
    unit: str = ""
    parameters: list[Parameter] | None = None
    doc: str = ""


@dataclass(slots=True)
class Behavior(Node):
    """A basic behavior, which the robot program implements."""

    name: Name
    parameters: list[Parameter]
    doc: str = ""


Declaration = Constant | Enumeration | Symbol | Behavior


@dataclass(slots=True)
class Namespace(Node):
    """A page of symbols or of basic behaviors; it does not change their names."""

    name: Name
    title: str
    declarations: list[Declaration]
    doc: str = ""


@dataclass(slots=True)
class State(Node):
    """A state of an option; `cooperation` is "", "capacity" or "synchronized", `robots` the number behind it."""

    name: Name
    actions: Actions
    decision: Decision | None = None
    is_initial: bool = False
    is_target: bool = False
    cooperation: str = ""
    robots: str = ""


@dataclass(slots=True)
class Option(Node):
    """A state machine."""

    name: Name
    parameters: list[Parameter]
    states: list[State]
    common_decision: Tree | None = None
    common_actions: Actions | None = None
    doc: str = ""


@dataclass(slots=True)
class Agent(Node):
    """A name for a root option."""

    name: Name
    title: str
    root: Name
    doc: str = ""


@dataclass(slots=True)
class Include(Node):
    """Another file that belongs to the program; `path` as it was written."""

    path: str


@dataclass(slots=True)
class File:
    """All that a file holds. `initial` is its first comment without signs; `comments` stand before tokens.

    `blanks` are tokens with an empty line before them.
    """

    includes: list[Include] = field(default_factory=list)
    body: list[Option | Namespace | Agent] = field(default_factory=list)
    initial: str = ""
    comments: dict[int, list[Comment]] = field(default_factory=dict)
    blanks: frozenset[int] = field(default=frozenset(), compare=False)
