"""Prints a syntax tree with its comments in the canonical format of `vicode xabsl format`."""

from collections.abc import Callable, Mapping, Sequence

from vicode.xabsl import tree
from vicode.xabsl.formatter import TokenFormatter
from vicode.xabsl.lexer import Comment

MAX_WIDTH = 110
"""Longer conditions and calls are broken into several lines."""


def print_file(file: tree.FileNode) -> str:
    """Print a file; parsing the text gives the same tree."""
    layout = TokenFormatter(file.comments, file.after_blank_lines)
    if file.header:
        layout.write(f"/***\n{file.header}\n*/")
    for include in file.includes:
        layout.write_on_new_line("include")
        layout.write(f'"{include.path}"')
        layout.write(";", "")
    for number, item in enumerate(file.body):
        if not (isinstance(item, tree.AgentNode) and number):
            layout.blank_line()
        _Printer(layout).item(item)
    return layout.text()


def print_node(node: tree.SyntaxNode, comments: Mapping[int, Sequence[Comment]] | None = None) -> str:
    """Print one node without indentation and without a final line break.

    Args:
        node: An option, a state, a parameter, a declaration, a decision, an action or an expression.
        comments: The comments of the file that the node was parsed from; those inside the node are printed.
    """
    own = {
        number - node.first_token: list(group)
        for number, group in (comments or {}).items()
        if node.first_token <= number <= node.last_token
    }
    layout = TokenFormatter(own, ())
    _Printer(layout).node(node)
    return layout.text().removesuffix("\n")


class _Printer:
    """Prints syntax nodes; each method writes exactly the tokens of its node."""

    def __init__(self, layout: TokenFormatter) -> None:
        self.out = layout

    def node(self, node: tree.SyntaxNode) -> None:
        writers: dict[type, Callable[..., None]] = {
            **dict.fromkeys((tree.OptionNode, tree.NamespaceNode, tree.AgentNode), self.item),
            **dict.fromkeys((tree.GotoNode, tree.StayNode, tree.IfNode, tree.BlockNode), self._tree),
            **dict.fromkeys((tree.AssignmentNode, tree.CallNode), self._action),
            **dict.fromkeys(
                (tree.ConstantNode, tree.EnumerationNode, tree.SymbolNode, tree.BehaviorNode), self._declaration
            ),
            tree.StateNode: self._state,
            tree.DecisionNode: self._decision,
            tree.ActionBlockNode: self._actions,
            tree.ParameterNode: self._parameter,
            tree.ArgumentNode: self._argument,
            tree.ArgumentListNode: self._arguments,
        }
        writers.get(type(node), self._expression)(node)

    def item(self, item: tree.OptionNode | tree.NamespaceNode | tree.AgentNode) -> None:
        self._doc(item.doc)
        match item:
            case tree.OptionNode():
                self._option(item)
            case tree.NamespaceNode():
                self.out.write_on_new_line("namespace")
                self.out.write(item.name.text)
                self._list("(", [f'"{item.title}"'], ")")
                self._open()
                for declaration in item.declarations:
                    self._declaration(declaration)
                self.out.close_block("}")
            case tree.AgentNode():
                self.out.write_on_new_line("agent")
                self.out.write(item.name.text)
                self._list("(", [f'"{item.title}"', item.root.text], ")")
                self.out.write(";", "")

    def _option(self, option: tree.OptionNode) -> None:
        self.out.write_on_new_line("option")
        self.out.write(option.name.text)
        self._open()
        for parameter in option.parameters:
            self._parameter(parameter)
        if option.common_decision is not None:
            self.out.blank_line()
            self.out.write_on_new_line("common")
            self.out.write("decision")
            self._open()
            self._tree(option.common_decision)
            self.out.close_block("}")
        if option.common_actions is not None:
            self.out.blank_line()
            self.out.write_on_new_line("common")
            self._actions(option.common_actions)
        for state in option.states:
            self.out.blank_line()
            self._state(state)
        self.out.close_block("}")

    def _state(self, state: tree.StateNode) -> None:
        keywords = [
            *(["initial"] if state.is_initial else []),
            *(["target"] if state.is_target else []),
            *("state", state.name.text),
            *([state.cooperation] if state.cooperation else []),
            *([state.robots] if state.robots else []),
        ]
        self.out.write_on_new_line(keywords[0])
        for keyword in keywords[1:]:
            self.out.write(keyword)
        self._open()
        if state.decision is not None:
            self._decision(state.decision)
        self.out.end_line()
        self._actions(state.actions)
        self.out.close_block("}")

    def _decision(self, decision: tree.DecisionNode) -> None:
        self.out.write_on_new_line("decision")
        self._open()
        if decision.begins_with_else:
            self._doc(decision.else_doc)
            self.out.write_on_new_line("else")
            self._after_else(decision.tree)
        else:
            self._tree(decision.tree)
        self.out.close_block("}")

    def _tree(self, node: tree.DecisionTreeNode) -> None:
        """Write a decision tree from the start of a line."""
        match node:
            case tree.GotoNode():
                self.out.write_on_new_line("goto")
                self.out.write(node.state.text)
                self.out.write(";", "")
            case tree.StayNode():
                self.out.write_on_new_line("stay")
                self.out.write(";", "")
            case tree.BlockNode():
                self.out.write_on_new_line("{")
                self.out.depth += 1
                self._tree(node.inner)
                self.out.close_block("}")
            case tree.IfNode():
                self._doc(node.doc)
                self.out.write_on_new_line("if")
                self._if(node)

    def _if(self, node: tree.IfNode) -> None:
        """Write what follows the keyword `if`, including the chain of `else if`."""
        current: tree.IfNode | None = node
        while current is not None:
            self._condition(current.condition)
            self._branch(current.then)
            following = current.otherwise
            if following is None:
                return
            if current.else_doc or not isinstance(current.then, tree.BlockNode):
                self.out.end_line()
            self._doc(current.else_doc)
            self.out.write("else")
            if isinstance(following, tree.IfNode) and not following.doc:
                self.out.write("if")
                current = following
            else:
                self._after_else(following)
                return

    def _after_else(self, node: tree.DecisionTreeNode) -> None:
        if isinstance(node, tree.IfNode) and not node.doc:
            self.out.write("if")
            self._if(node)
        else:
            self._branch(node)

    def _branch(self, node: tree.DecisionTreeNode) -> None:
        """Write one branch: braces in the same line, or the next line indented."""
        if isinstance(node, tree.BlockNode):
            self.out.write("{")
            self.out.depth += 1
            self._tree(node.inner)
            self.out.close_block("}")
        else:
            self.out.depth += 1
            self._tree(node)
            self.out.depth -= 1

    def _condition(self, condition: tree.ExpressionNode) -> None:
        length = self.out.column + len(_flat(condition)) + 4
        self.out.write("(")
        self._expression(condition, "", breaks=length > MAX_WIDTH)
        self.out.write(")", "")

    def _actions(self, actions: tree.ActionBlockNode) -> None:
        self.out.write("action")
        self._open()
        for action in actions.actions:
            self._action(action)
        self.out.close_block("}")

    def _action(self, action: tree.ActionNode) -> None:
        if isinstance(action, tree.AssignmentNode):
            self.out.write_on_new_line(action.symbol.text)
            self.out.write("=")
            self._expression(action.value, " ", breaks=self.out.column + len(_flat(action.value)) > MAX_WIDTH)
        else:
            self.out.write_on_new_line(action.name.text)
            if action.kind:
                self.out.write(action.kind)
            self._arguments(action.arguments, breaks=self.out.column + _length(action.arguments) > MAX_WIDTH)
        self.out.write(";", "")

    def _arguments(self, arguments: tree.ArgumentListNode, *, breaks: bool = False) -> None:
        self.out.write("(", "")
        self.out.depth += 1
        for number, argument in enumerate(arguments.items):
            if number:
                self.out.write(",", "")
            if breaks:
                self.out.end_line()
            self._argument(argument, " " if number and not breaks else "")
        if arguments.has_trailing_comma:
            self.out.write(",", "")
        self.out.depth -= 1
        if breaks:
            self.out.write_on_new_line(")")
        else:
            self.out.write(")", "")

    def _argument(self, argument: tree.ArgumentNode, gap: str = "") -> None:
        self.out.write(argument.name.text, gap)
        self.out.write("=")
        self._expression(argument.value, " ")

    def _expression(self, node: tree.ExpressionNode, gap: str = "", *, breaks: bool = False) -> None:
        """Write an expression; `gap` precedes its first token. With `breaks`, lines start with && and ||."""
        match node:
            case tree.NumberNode(text=text) | tree.KeywordNode(text=text) | tree.ReferenceNode(name=text):
                self.out.write(text, gap)
            case tree.FunctionCallNode():
                self.out.write(node.name.text, gap)
                self._arguments(node.arguments)
            case tree.ParenthesizedNode():
                self.out.write("(", gap)
                self._expression(node.inner, "", breaks=breaks)
                self.out.write(")", "")
            case tree.UnaryNode():
                self.out.write(node.operator, gap)
                # Two consecutive signs are two tokens.
                self._expression(node.operand, "")
            case tree.BinaryNode():
                self._binary(node, gap, breaks=breaks)
            case tree.ConditionalNode():
                self._expression(node.condition, gap, breaks=breaks)
                self._operator_and_operand("?", node.yes, breaks=breaks)
                self._operator_and_operand(":", node.no, breaks=breaks)

    def _binary(self, node: tree.BinaryNode, gap: str, *, breaks: bool) -> None:
        is_joint = node.operator in ("&&", "||")
        self._expression(node.left, gap, breaks=breaks and is_joint)
        self._operator_and_operand(node.operator, node.right, breaks=breaks and is_joint)

    def _operator_and_operand(self, operator: str, operand: tree.ExpressionNode, *, breaks: bool) -> None:
        self.out.depth += 2 * breaks
        if breaks:
            self.out.write_on_new_line(operator)
        else:
            self.out.write(operator)
        self._expression(operand, " ")
        self.out.depth -= 2 * breaks

    def _declaration(self, item: tree.DeclarationNode) -> None:
        self._doc(item.doc)
        match item:
            case tree.ConstantNode():
                self._line(["float"] * item.has_float_keyword + ["const", item.name.text, "="])
                if item.number.startswith("-"):
                    self.out.write("-")
                self.out.write(item.number.removeprefix("-"), "" if item.number.startswith("-") else " ")
                if item.unit:
                    self.out.write(f'"{item.unit}"')
            case tree.EnumerationNode():
                self._line(["enum", item.name.text] + ["internal"] * item.is_internal)
                self._elements(item)
            case tree.SymbolNode():
                self._line([*_type(item.type), item.direction, item.name.text, *_details(item)])
                if item.parameters is not None:
                    self._parameters("(", item.parameters, ")")
            case tree.BehaviorNode():
                self._line(["behavior", item.name.text])
                self._parameters("{", item.parameters, "}")
                return
        self.out.write(";", "")

    def _elements(self, item: tree.EnumerationNode) -> None:
        names = [element.text for element in item.elements]
        breaks = self.out.column + sum(map(len, names)) + 2 * len(names) > MAX_WIDTH
        self.out.write("{")
        self.out.depth += 1
        for number, name in enumerate(names):
            if number:
                self.out.write(",", "")
            if breaks:
                self.out.write_on_new_line(name)
            else:
                self.out.write(name)
        if breaks:
            self.out.close_block("}")
        else:
            self.out.depth -= 1
            self.out.write("}")

    def _parameters(self, begin: str, parameters: Sequence[tree.ParameterNode], end: str) -> None:
        """Write parameters in one line, or in one line each if they have descriptions or exceed the width."""
        flat = sum(len(" ".join(_parameter_tokens(parameter))) + 2 for parameter in parameters)
        breaks = any(parameter.doc for parameter in parameters) or self.out.column + flat > MAX_WIDTH
        self.out.write(begin, " " if begin == "{" else "")
        if breaks:
            self.out.depth += 1
            for parameter in parameters:
                self._parameter(parameter)
            self.out.close_block(end)
            return
        for number, parameter in enumerate(parameters):
            for index, word in enumerate(_parameter_tokens(parameter)):
                self.out.write(word, " " if begin == "{" or number or index else "")
            self.out.write(";", "")
        self.out.write(end, " " if begin == "{" else "")

    def _parameter(self, parameter: tree.ParameterNode) -> None:
        self._doc(parameter.doc)
        self._line(_parameter_tokens(parameter))
        self.out.write(";", "")

    def _line(self, words: Sequence[str]) -> None:
        self.out.write_on_new_line(words[0])
        for word in words[1:]:
            self.out.write(word)

    def _list(self, begin: str, words: Sequence[str], end: str) -> None:
        self.out.write(begin, "")
        for number, word in enumerate(words):
            if number:
                self.out.write(",", "")
            self.out.write(word, " " if number else "")
        self.out.write(end, "")

    def _open(self) -> None:
        self.out.write("{")
        self.out.depth += 1

    def _doc(self, doc: str) -> None:
        if doc:
            self.out.write_on_new_line(f"/** {doc} */")
            self.out.end_line()


def _type(type_node: tree.TypeNode | None) -> list[str]:
    if type_node is None:
        return []
    return [type_node.text, type_node.enum.text] if type_node.enum else [type_node.text]


def _details(item: tree.SymbolNode | tree.ParameterNode) -> list[str]:
    return [*([f"[{item.range}]"] if item.range else []), *([f'"{item.unit}"'] if item.unit else [])]


def _parameter_tokens(parameter: tree.ParameterNode) -> list[str]:
    return [*_type(parameter.type), parameter.name.text, *_details(parameter)]


def _flat(node: tree.ExpressionNode) -> str:
    """Format an expression in one line, without comments."""
    layout = TokenFormatter({}, ())
    _Printer(layout)._expression(node, "")
    return layout.text().strip()


def _length(arguments: tree.ArgumentListNode) -> int:
    return sum(len(argument.name.text) + len(_flat(argument.value)) + 5 for argument in arguments.items) + 2
