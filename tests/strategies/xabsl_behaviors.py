"""Valid XABSL behaviors as syntax trees."""

from collections.abc import Callable

from hypothesis import strategies as st

from vicode.xabsl import tree

DECIMALS, BOOLS, SIDES = ("in.d1", "in.d2"), ("in.b1", "in.b2"), ("in.e1",)
OUT = {"d": ("out.d", "int.d"), "b": ("out.b", "int.b"), "e": ("out.e", "int.e")}
ELEMENTS = ("left", "side.right", "top")
_KINDS = {"d": "float", "b": "bool", "e": "enum"}
Draw = Callable[..., object]


def name(text: str) -> tree.NameNode:
    return tree.NameNode(text)


def make_type(kind: str) -> tree.TypeNode:
    return tree.TypeNode("enum", name("side")) if kind == "e" else tree.TypeNode(_KINDS[kind])


def functions() -> list[tree.DeclarationNode]:
    """Input symbols with parameters."""
    parameters = [tree.ParameterNode(name(f"a.{kind}"), make_type(kind)) for kind in "edb"]
    one = [tree.ParameterNode(name("a"), make_type("d"))]
    return [
        tree.SymbolNode("input", name("fun.d"), make_type("d"), parameters=parameters),
        tree.SymbolNode("input", name("fun.b"), make_type("b"), parameters=one),
        tree.SymbolNode("input", name("fun.e"), make_type("e"), parameters=one),
    ]


def symbols(*, with_functions: bool = False) -> tree.NamespaceNode:
    """The symbols of every random behavior."""
    declarations: list[tree.DeclarationNode] = [
        tree.EnumerationNode(name("side"), [name("left"), name("right"), name("top")]),
        tree.ConstantNode(name("limit"), "-2.5"),
    ]
    for kind, inputs in (("d", DECIMALS), ("b", BOOLS), ("e", SIDES)):
        declarations += [tree.SymbolNode("input", name(symbol), make_type(kind)) for symbol in inputs]
        output, internal = OUT[kind]
        declarations.append(tree.SymbolNode("output", name(output), make_type(kind)))
        declarations.append(tree.SymbolNode("internal", name(internal), make_type(kind)))
    declarations += functions() if with_functions else []
    return tree.NamespaceNode(name("symbols"), "Symbols", declarations)


def basic_behaviors() -> tree.NamespaceNode:
    """The basic behaviors of every random behavior."""
    parameters = [tree.ParameterNode(name(f"p.{kind}"), make_type(kind)) for kind in "dbe"]
    declarations: list[tree.DeclarationNode] = [
        tree.BehaviorNode(name("act"), parameters),
        tree.BehaviorNode(name("rest"), []),
    ]
    return tree.NamespaceNode(name("acts"), "Acts", declarations)


class _OptionBuilder:
    """Draws the parts of one option. `own` are the kinds of its parameters, `callees` those of later options."""

    def __init__(
        self, draw: Callable, own: str, callees: dict[str, str], states: list[str], *, has_functions: bool = False
    ) -> None:
        self.draw, self.own, self.callees, self.states = draw, own, callees, states
        self.has_functions = has_functions

    def pick(self, *choices: object) -> object:
        return self.draw(st.sampled_from(choices))

    def expression(self, kind: str, depth: int) -> tree.ExpressionNode:
        """An expression of a kind, in parentheses where precedence requires them."""
        if depth > 0 and self.has_functions and self.pick(0, 1):
            return self.function(kind, depth - 1)
        if depth <= 0 or self.pick(0, 0, 1):
            return self.leaf(kind)
        if kind == "e" or self.pick(0, 0, 0, 1):
            inner = tree.ConditionalNode(
                self.expression("b", depth - 1) if depth > 1 else self.leaf("b"),
                *(self.operand(kind, depth - 1) for _ in range(2)),
            )
            return tree.ParenthesizedNode(inner)
        return self.decimal(depth) if kind == "d" else self.boolean(depth)

    def decimal(self, depth: int) -> tree.ExpressionNode:
        if self.pick(0, 0, 1):
            return tree.UnaryNode("-", self.operand("d", depth - 1))
        return tree.BinaryNode(str(self.pick(*"+-*/%")), *(self.operand("d", depth - 1) for _ in range(2)))

    def boolean(self, depth: int) -> tree.ExpressionNode:
        match self.pick("not", "join", "compare", "equal"):
            case "not":
                return tree.UnaryNode("!", self.operand("b", depth - 1))
            case "join":
                return tree.BinaryNode(str(self.pick("&&", "||")), *(self.operand("b", depth - 1) for _ in range(2)))
            case "compare":
                operator = str(self.pick("<", "<=", ">", ">=", "==", "!="))
                return tree.BinaryNode(operator, *(self.operand("d", depth - 1) for _ in range(2)))
        left = tree.ReferenceNode(str(self.pick(*SIDES, *OUT["e"])))
        return tree.BinaryNode(str(self.pick("==", "!=")), left, self.leaf("e"))

    def function(self, kind: str, depth: int) -> tree.ExpressionNode:
        """An input symbol with some of its arguments, which may contain calls of the same symbol."""
        parameters = {"d": (("a.e", "e"), ("a.d", "d"), ("a.b", "b"))}.get(kind, (("a", "d"),))
        arguments = [
            tree.ArgumentNode(name(parameter), self.expression(parameter_kind, depth))
            for parameter, parameter_kind in parameters
            if self.pick(0, 1, 1)
        ]
        return tree.FunctionCallNode(name(f"fun.{kind}"), tree.ArgumentListNode(arguments))

    def operand(self, kind: str, depth: int) -> tree.ExpressionNode:
        """An expression that can be an operand of any operator."""
        node = self.expression(kind, depth)
        is_compound = isinstance(node, tree.UnaryNode | tree.BinaryNode | tree.ConditionalNode)
        return tree.ParenthesizedNode(node) if is_compound else node

    def leaf(self, kind: str) -> tree.ExpressionNode:
        parameters = [f"@p{index}" for index, own_kind in enumerate(self.own) if own_kind == kind]
        if kind == "d":
            numbers = [tree.NumberNode(text) for text in ("0", "1", "7.25", "40", "100")]
            keywords = [tree.KeywordNode("state_time"), tree.KeywordNode("option_time")]
            references = [tree.ReferenceNode(symbol) for symbol in (*DECIMALS, *OUT["d"], *parameters, "limit")]
            return self.pick(*numbers, *keywords, *references)  # type: ignore[return-value]
        if kind == "b":
            keywords = [tree.KeywordNode(keyword) for keyword in ("true", "false", "action_done")]
            references = [tree.ReferenceNode(symbol) for symbol in (*BOOLS, *OUT["b"], *parameters)]
            return self.pick(*keywords, *references)  # type: ignore[return-value]
        return tree.ReferenceNode(str(self.pick(*ELEMENTS, *SIDES, *OUT["e"], *parameters)))

    def decision(self, depth: int) -> tree.DecisionTreeNode:
        """A decision in which every branch ends in goto or stay."""
        if depth <= 0 or self.pick(0, 1):
            gotos = [tree.GotoNode(name(state)) for state in self.states]
            node: tree.DecisionTreeNode = self.pick(tree.StayNode(), *gotos)  # type: ignore[assignment]
        else:
            node = tree.IfNode(
                self.expression("b", 2),
                self.decision(depth - 1),
                self.decision(depth - 1),
                str(self.pick("", "reason")),
            )
        return tree.BlockNode(node) if self.pick(0, 0, 1) else node

    def actions(self) -> tree.ActionBlockNode:
        return tree.ActionBlockNode([self.action() for _ in range(self.draw(st.integers(0, 3)))])

    def action(self) -> tree.ActionNode:
        action = self.pick("set", "act", *(["call"] if self.callees else []))
        if action == "set":
            kind = str(self.pick(*"dbe"))
            return tree.AssignmentNode(name(str(self.pick(*OUT[kind]))), self.expression(kind, 2))
        if action == "act":
            callee, kinds, prefix = "act", "dbe", "p."
            parameters = [f"{prefix}{kind}" for kind in kinds]
        else:
            callee = str(self.pick(*self.callees))
            kinds = self.callees[callee]
            parameters = [f"p{index}" for index in range(len(kinds))]
        arguments = [
            tree.ArgumentNode(name(parameter), self.expression(kind, 1))
            for parameter, kind in zip(parameters, kinds, strict=True)
            if self.pick(0, 1)
        ]
        return tree.CallNode(
            name(callee), tree.ArgumentListNode(arguments, bool(arguments) and bool(self.pick(0, 0, 1)))
        )


@st.composite
def behaviors(draw: Callable, *, with_functions: bool = False) -> dict[str, tree.FileNode]:
    """The files of a behavior, with its agents in agents.xabsl."""
    names = [f"o{number}" for number in range(draw(st.integers(1, 3)))]
    kinds = {option: draw(st.text("dbe", max_size=2)) if number else "" for number, option in enumerate(names)}
    files = {
        "symbols.xabsl": tree.FileNode(body=[symbols(with_functions=with_functions)]),
        "acts.xabsl": tree.FileNode(body=[basic_behaviors()]),
    }
    for number, option in enumerate(names):
        states = [f"s{index}" for index in range(draw(st.integers(1, 3)))]
        later = {callee: kinds[callee] for callee in names[number + 1 :]}
        files[f"{option}.xabsl"] = tree.FileNode(
            body=[_option(draw, option, kinds[option], later, states, has_functions=with_functions)]
        )
    includes = [tree.IncludeNode(file) for file in files]
    agent = tree.AgentNode(name("main"), "Main", name("o0"))
    return {**files, "agents.xabsl": tree.FileNode(includes=includes, body=[agent])}


def _option(
    draw: Callable, own: str, kinds: str, later: dict[str, str], states: list[str], *, has_functions: bool
) -> tree.OptionNode:
    builder = _OptionBuilder(draw, kinds, later, states, has_functions=has_functions)
    has_common = draw(st.booleans())
    common = None
    if has_common:
        goto = tree.GotoNode(name(str(builder.pick(*states))))
        common = tree.IfNode(builder.expression("b", 1), goto, None)
    state_nodes = [
        tree.StateNode(
            name(state),
            builder.actions(),
            tree.DecisionNode(builder.decision(2), has_common) if draw(st.booleans()) else None,
            is_initial=not number,
            is_target=draw(st.booleans()),
        )
        for number, state in enumerate(states)
    ]
    parameters = [tree.ParameterNode(name(f"@p{index}"), make_type(kind)) for index, kind in enumerate(kinds)]
    actions = builder.actions() if draw(st.booleans()) else None
    return tree.OptionNode(
        name(own), parameters, state_nodes, common, actions, doc=str(builder.pick("", "does something"))
    )
