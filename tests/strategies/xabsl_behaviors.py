"""Whole XABSL behaviors that are valid, as syntax trees."""

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
    declared: list[tree.DeclarationNode] = [
        tree.EnumerationNode(name("side"), [name("left"), name("right"), name("top")]),
        tree.ConstantNode(name("limit"), "-2.5"),
    ]
    for kind, inputs in (("d", DECIMALS), ("b", BOOLS), ("e", SIDES)):
        declared += [tree.SymbolNode("input", name(each), make_type(kind)) for each in inputs]
        output, internal = OUT[kind]
        declared.append(tree.SymbolNode("output", name(output), make_type(kind)))
        declared.append(tree.SymbolNode("internal", name(internal), make_type(kind)))
    declared += functions() if with_functions else []
    return tree.NamespaceNode(name("symbols"), "Symbols", declared)


def basic_behaviors() -> tree.NamespaceNode:
    """The basic behaviors of every random behavior."""
    parameters = [tree.ParameterNode(name(f"p.{kind}"), make_type(kind)) for kind in "dbe"]
    declared: list[tree.DeclarationNode] = [
        tree.BehaviorNode(name("act"), parameters),
        tree.BehaviorNode(name("rest"), []),
    ]
    return tree.NamespaceNode(name("acts"), "Acts", declared)


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
        """An expression of a kind, in parentheses where precedence wants them."""
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
        """An input symbol with some of its arguments, among which it may stand again."""
        takes = {"d": (("a.e", "e"), ("a.d", "d"), ("a.b", "b"))}.get(kind, (("a", "d"),))
        given = [tree.ArgumentNode(name(word), self.expression(of, depth)) for word, of in takes if self.pick(0, 1, 1)]
        return tree.FunctionCallNode(name(f"fun.{kind}"), tree.ArgumentListNode(given))

    def operand(self, kind: str, depth: int) -> tree.ExpressionNode:
        """An expression that can be an operand of anything."""
        found = self.expression(kind, depth)
        return (
            tree.ParenthesizedNode(found)
            if isinstance(found, tree.UnaryNode | tree.BinaryNode | tree.ConditionalNode)
            else found
        )

    def leaf(self, kind: str) -> tree.ExpressionNode:
        own = [f"@p{at}" for at, each in enumerate(self.own) if each == kind]
        if kind == "d":
            numbers = [tree.NumberNode(each) for each in ("0", "1", "7.25", "40", "100")]
            words = [tree.KeywordNode("state_time"), tree.KeywordNode("option_time")]
            refs = [tree.ReferenceNode(each) for each in (*DECIMALS, *OUT["d"], *own, "limit")]
            return self.pick(*numbers, *words, *refs)  # type: ignore[return-value]
        if kind == "b":
            words = [tree.KeywordNode(each) for each in ("true", "false", "action_done")]
            return self.pick(*words, *(tree.ReferenceNode(each) for each in (*BOOLS, *OUT["b"], *own)))  # type: ignore[return-value]
        return tree.ReferenceNode(str(self.pick(*ELEMENTS, *SIDES, *OUT["e"], *own)))

    def decision(self, depth: int) -> tree.DecisionTreeNode:
        """A decision that ends in goto or stay on every way."""
        if depth <= 0 or self.pick(0, 1):
            found: tree.DecisionTreeNode = self.pick(
                tree.StayNode(), *(tree.GotoNode(name(each)) for each in self.states)
            )  # type: ignore[assignment]
        else:
            found = tree.IfNode(
                self.expression("b", 2), self.decision(depth - 1), self.decision(depth - 1), str(self.pick("", "why"))
            )
        return tree.BlockNode(found) if self.pick(0, 0, 1) else found

    def actions(self) -> tree.ActionBlockNode:
        return tree.ActionBlockNode([self.action() for _ in range(self.draw(st.integers(0, 3)))])

    def action(self) -> tree.ActionNode:
        what = self.pick("set", "act", *(["call"] if self.callees else []))
        if what == "set":
            kind = str(self.pick(*"dbe"))
            return tree.AssignmentNode(name(str(self.pick(*OUT[kind]))), self.expression(kind, 2))
        if what == "act":
            callee, kinds, prefix = "act", "dbe", "p."
            words = [f"{prefix}{kind}" for kind in kinds]
        else:
            callee = str(self.pick(*self.callees))
            kinds = self.callees[callee]
            words = [f"p{at}" for at in range(len(kinds))]
        given = [
            tree.ArgumentNode(name(word), self.expression(kind, 1))
            for word, kind in zip(words, kinds, strict=True)
            if self.pick(0, 1)
        ]
        return tree.CallNode(name(callee), tree.ArgumentListNode(given, bool(given) and bool(self.pick(0, 0, 1))))


@st.composite
def behaviors(draw: Callable, *, with_functions: bool = False) -> dict[str, tree.FileNode]:
    """The files of a behavior, its agents in agents.xabsl; with or without input symbols that take arguments."""
    names = [f"o{number}" for number in range(draw(st.integers(1, 3)))]
    kinds = {each: draw(st.text("dbe", max_size=2)) if number else "" for number, each in enumerate(names)}
    files = {
        "symbols.xabsl": tree.FileNode(body=[symbols(with_functions=with_functions)]),
        "acts.xabsl": tree.FileNode(body=[basic_behaviors()]),
    }
    for number, each in enumerate(names):
        states = [f"s{at}" for at in range(draw(st.integers(1, 3)))]
        later = {callee: kinds[callee] for callee in names[number + 1 :]}
        files[f"{each}.xabsl"] = tree.FileNode(
            body=[_option(draw, each, kinds[each], later, states, has_functions=with_functions)]
        )
    includes = [tree.IncludeNode(each) for each in files]
    agent = tree.AgentNode(name("main"), "Main", name("o0"))
    return {**files, "agents.xabsl": tree.FileNode(includes=includes, body=[agent])}


def _option(
    draw: Callable, own: str, kinds: str, later: dict[str, str], states: list[str], *, has_functions: bool
) -> tree.OptionNode:
    make = _OptionBuilder(draw, kinds, later, states, has_functions=has_functions)
    has_common = draw(st.booleans())
    common = None
    if has_common:
        goto = tree.GotoNode(name(str(make.pick(*states))))
        common = tree.IfNode(make.expression("b", 1), goto, None)
    built = [
        tree.StateNode(
            name(each),
            make.actions(),
            tree.DecisionNode(make.decision(2), has_common) if draw(st.booleans()) else None,
            is_initial=not number,
            is_target=draw(st.booleans()),
        )
        for number, each in enumerate(states)
    ]
    parameters = [tree.ParameterNode(name(f"@p{at}"), make_type(kind)) for at, kind in enumerate(kinds)]
    actions = make.actions() if draw(st.booleans()) else None
    return tree.OptionNode(name(own), parameters, built, common, actions, doc=str(make.pick("", "does something")))
