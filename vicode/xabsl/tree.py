"""The syntax tree of a file: all that was written but white space, so that printing it gives the same tokens again.

Nodes know the numbers of their first and last token (`at`, `to`; -1 when they were not read from a text). Those, and
only those, do not count when nodes are compared. The classes are not frozen: a file is read in half the time so.
"""

from dataclasses import dataclass, field

from vicode.xabsl.lexer import Comment


@dataclass(slots=True, kw_only=True)
class SyntaxNode:
    """Anything in a file."""

    first_token: int = field(default=-1, compare=False)
    last_token: int = field(default=-1, compare=False)


@dataclass(slots=True)
class NameNode(SyntaxNode):
    """A word where it is declared or used; names of option parameters begin with @ in the option."""

    text: str


# Expressions


@dataclass(slots=True)
class NumberNode(SyntaxNode):
    """A number without sign, as it was written."""

    text: str


@dataclass(slots=True)
class KeywordNode(SyntaxNode):
    """`true`, `false`, `state_time`, `option_time`, `action_done` or `conflict`."""

    text: str


@dataclass(slots=True)
class ReferenceNode(SyntaxNode):
    """A symbol, parameter, constant or element of an enumeration."""

    name: str


@dataclass(slots=True)
class ArgumentNode(SyntaxNode):
    """A parameter by its name, and what it is given."""

    name: NameNode
    value: "ExpressionNode"


@dataclass(slots=True)
class ArgumentListNode(SyntaxNode):
    """What stands between parentheses; a comma may follow the last."""

    items: list[ArgumentNode]
    has_trailing_comma: bool = False


@dataclass(slots=True)
class FunctionCallNode(SyntaxNode):
    """An input symbol with parentheses."""

    name: NameNode
    arguments: ArgumentListNode


@dataclass(slots=True)
class ParenthesizedNode(SyntaxNode):
    """An expression in parentheses."""

    inner: "ExpressionNode"


@dataclass(slots=True)
class UnaryNode(SyntaxNode):
    """`-` or `!` before an operand."""

    operator: str
    operand: "ExpressionNode"


@dataclass(slots=True)
class BinaryNode(SyntaxNode):
    """Two operands; `operator_token` is the number of the operator's token."""

    operator: str
    left: "ExpressionNode"
    right: "ExpressionNode"
    operator_token: int = field(default=-1, compare=False)


@dataclass(slots=True)
class ConditionalNode(SyntaxNode):
    """`condition ? yes : no`."""

    condition: "ExpressionNode"
    yes: "ExpressionNode"
    no: "ExpressionNode"


ExpressionNode = (
    NumberNode
    | KeywordNode
    | ReferenceNode
    | FunctionCallNode
    | ParenthesizedNode
    | UnaryNode
    | BinaryNode
    | ConditionalNode
)

# Decisions and actions


@dataclass(slots=True)
class GotoNode(SyntaxNode):
    """`goto state;`."""

    state: NameNode


@dataclass(slots=True)
class StayNode(SyntaxNode):
    """`stay;`."""


@dataclass(slots=True)
class IfNode(SyntaxNode):
    """A condition with a tree for each answer; no `otherwise` at the open end of a common decision.

    `doc` stood before `if`, `else_doc` before `else`.
    """

    condition: ExpressionNode
    then: "DecisionTreeNode"
    otherwise: "DecisionTreeNode | None"
    doc: str = ""
    else_doc: str = ""


@dataclass(slots=True)
class BlockNode(SyntaxNode):
    """A tree in braces."""

    inner: "DecisionTreeNode"


DecisionTreeNode = GotoNode | StayNode | IfNode | BlockNode


@dataclass(slots=True)
class DecisionNode(SyntaxNode):
    """What stands in `decision { }`; `begins_with_else` where a common decision goes before it."""

    tree: DecisionTreeNode
    begins_with_else: bool = False
    else_doc: str = ""


@dataclass(slots=True)
class AssignmentNode(SyntaxNode):
    """`symbol = value;`."""

    symbol: NameNode
    value: ExpressionNode


@dataclass(slots=True)
class CallNode(SyntaxNode):
    """A call of an option or a basic behavior; `kind` is "", "option" or "behavior"."""

    name: NameNode
    arguments: ArgumentListNode
    kind: str = ""


ActionNode = AssignmentNode | CallNode


@dataclass(slots=True)
class ActionBlockNode(SyntaxNode):
    """What stands in `action { }`."""

    actions: list[ActionNode]


# Declarations


@dataclass(slots=True)
class TypeNode(SyntaxNode):
    """`float`, `bool` or `enum NAME`."""

    text: str
    enum: NameNode | None = None


@dataclass(slots=True)
class ParameterNode(SyntaxNode):
    """A parameter of an option, a function or a basic behavior; without a type it is a decimal."""

    name: NameNode
    type: TypeNode | None = None
    range: str = ""
    unit: str = ""
    doc: str = ""


@dataclass(slots=True)
class ConstantNode(SyntaxNode):
    """`float const name = 3 "m";`, the number with its sign; `float` may be missing."""

    name: NameNode
    number: str
    unit: str = ""
    doc: str = ""
    has_float_keyword: bool = True


@dataclass(slots=True)
class EnumerationNode(SyntaxNode):
    """`enum name { a, b };`, its values the engine's own where it is internal."""

    name: NameNode
    elements: list[NameNode]
    is_internal: bool = False
    doc: str = ""


@dataclass(slots=True)
class SymbolNode(SyntaxNode):
    """An input, output or internal symbol (`direction`); `parameters` is None without parentheses."""

    direction: str
    name: NameNode
    type: TypeNode | None = None
    range: str = ""
    unit: str = ""
    parameters: list[ParameterNode] | None = None
    doc: str = ""


@dataclass(slots=True)
class BehaviorNode(SyntaxNode):
    """A basic behavior, which the robot program implements."""

    name: NameNode
    parameters: list[ParameterNode]
    doc: str = ""


DeclarationNode = ConstantNode | EnumerationNode | SymbolNode | BehaviorNode


@dataclass(slots=True)
class NamespaceNode(SyntaxNode):
    """A page of symbols or of basic behaviors; it does not change their names."""

    name: NameNode
    title: str
    declarations: list[DeclarationNode]
    doc: str = ""


@dataclass(slots=True)
class StateNode(SyntaxNode):
    """A state of an option; `cooperation` is "", "capacity" or "synchronized", `robots` the number behind it."""

    name: NameNode
    actions: ActionBlockNode
    decision: DecisionNode | None = None
    is_initial: bool = False
    is_target: bool = False
    cooperation: str = ""
    robots: str = ""


@dataclass(slots=True)
class OptionNode(SyntaxNode):
    """A state machine."""

    name: NameNode
    parameters: list[ParameterNode]
    states: list[StateNode]
    common_decision: DecisionTreeNode | None = None
    common_actions: ActionBlockNode | None = None
    doc: str = ""


@dataclass(slots=True)
class AgentNode(SyntaxNode):
    """A name for a root option."""

    name: NameNode
    title: str
    root: NameNode
    doc: str = ""


@dataclass(slots=True)
class IncludeNode(SyntaxNode):
    """Another file that belongs to the program; `path` as it was written."""

    path: str


@dataclass(slots=True)
class FileNode:
    """All that a file holds. `header` is its first comment without signs; `comments` stand before tokens.

    `after_blank_lines` are tokens with an empty line before them.
    """

    includes: list[IncludeNode] = field(default_factory=list)
    body: list[OptionNode | NamespaceNode | AgentNode] = field(default_factory=list)
    header: str = ""
    comments: dict[int, list[Comment]] = field(default_factory=dict)
    after_blank_lines: frozenset[int] = field(default=frozenset(), compare=False)
