"""The syntax tree of a file. It keeps everything except white space, so that printing gives the same tokens.

Nodes hold the numbers of their first and last token, or -1 if they were not parsed from a text. Comparison ignores
token numbers. The classes are not frozen, which halves the time to parse a file.
"""

from dataclasses import dataclass, field

from vicode.xabsl.lexer import Comment


@dataclass(slots=True, kw_only=True)
class SyntaxNode:
    """Base class of all nodes."""

    first_token: int = field(default=-1, compare=False)
    last_token: int = field(default=-1, compare=False)


@dataclass(slots=True)
class NameNode(SyntaxNode):
    """A declared or used name. Inside an option, the names of its parameters start with @."""

    text: str


# Expressions


@dataclass(slots=True)
class NumberNode(SyntaxNode):
    """A number without sign, as written."""

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
    """The name of a parameter with its value in a call."""

    name: NameNode
    value: "ExpressionNode"


@dataclass(slots=True)
class ArgumentListNode(SyntaxNode):
    """The arguments of a call in parentheses."""

    items: list[ArgumentNode]
    has_trailing_comma: bool = False


@dataclass(slots=True)
class FunctionCallNode(SyntaxNode):
    """An input symbol with arguments."""

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
    """An infix operator with two operands; `operator_token` is the number of its token."""

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
    """A condition with two branches; `otherwise` is None at the open end of a common decision.

    `doc` is the description before `if`, `else_doc` the one before `else`.
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
    """The content of `decision { }`; `begins_with_else` is set after a common decision."""

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
    """The content of `action { }`."""

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
    """`float const name = 3 "m";`. `number` includes the sign; `float` is optional."""

    name: NameNode
    number: str
    unit: str = ""
    doc: str = ""
    has_float_keyword: bool = True


@dataclass(slots=True)
class EnumerationNode(SyntaxNode):
    """`enum name { a, b };`. The engine numbers the elements of an internal one."""

    name: NameNode
    elements: list[NameNode]
    is_internal: bool = False
    doc: str = ""


@dataclass(slots=True)
class SymbolNode(SyntaxNode):
    """A symbol; `direction` is input, output or internal, `parameters` is None without parentheses."""

    direction: str
    name: NameNode
    type: TypeNode | None = None
    range: str = ""
    unit: str = ""
    parameters: list[ParameterNode] | None = None
    doc: str = ""


@dataclass(slots=True)
class BehaviorNode(SyntaxNode):
    """A basic behavior, implemented by the robot program."""

    name: NameNode
    parameters: list[ParameterNode]
    doc: str = ""


DeclarationNode = ConstantNode | EnumerationNode | SymbolNode | BehaviorNode


@dataclass(slots=True)
class NamespaceNode(SyntaxNode):
    """A group of symbols or of basic behaviors; it does not change their names."""

    name: NameNode
    title: str
    declarations: list[DeclarationNode]
    doc: str = ""


@dataclass(slots=True)
class StateNode(SyntaxNode):
    """A state of an option; `cooperation` is "", "capacity" or "synchronized", `robots` the number after it."""

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
    """An agent with its root option."""

    name: NameNode
    title: str
    root: NameNode
    doc: str = ""


@dataclass(slots=True)
class IncludeNode(SyntaxNode):
    """An include; `path` as written."""

    path: str


@dataclass(slots=True)
class FileNode:
    """The content of a file. `header` is the text of its first comment.

    `comments` precede the token of the given number; `after_blank_lines` are the tokens that follow an empty line.
    """

    includes: list[IncludeNode] = field(default_factory=list)
    body: list[OptionNode | NamespaceNode | AgentNode] = field(default_factory=list)
    header: str = ""
    comments: dict[int, list[Comment]] = field(default_factory=dict)
    after_blank_lines: frozenset[int] = field(default=frozenset(), compare=False)
