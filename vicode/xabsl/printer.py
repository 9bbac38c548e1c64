"""A syntax tree as text, in the one layout of `vicode xabsl format`: the tokens of the tree, and all comments."""

from collections.abc import Sequence

from vicode.xabsl import tree
from vicode.xabsl.laying import Layout

WIDTH = 110
"""Conditions and calls that make a line longer are broken."""


def print_file(file: tree.File) -> str:
    """The text of a file; reading it gives the same tree."""
    layout = Layout(file.comments, file.blanks)
    if file.initial:
        layout.word(f"/***\n{file.initial}\n*/")
    for include in file.includes:
        layout.first("include")
        layout.word(f'"{include.path}"')
        layout.word(";", "")
    for number, item in enumerate(file.body):
        if not (isinstance(item, tree.Agent) and number):
            layout.blank()
        _Printer(layout).item(item)
    return layout.text()


class _Printer:
    """Writes nodes; each method writes exactly the tokens of its node."""

    def __init__(self, layout: Layout) -> None:
        self.out = layout

    def item(self, item: tree.Option | tree.Namespace | tree.Agent) -> None:
        """Write what a file is there for."""
        self._doc(item.doc)
        match item:
            case tree.Option():
                self._option(item)
            case tree.Namespace():
                self.out.first("namespace")
                self.out.word(item.name.text)
                self._list("(", [f'"{item.title}"'], ")")
                self._open()
                for declaration in item.declarations:
                    self._declaration(declaration)
                self.out.close("}")
            case tree.Agent():
                self.out.first("agent")
                self.out.word(item.name.text)
                self._list("(", [f'"{item.title}"', item.root.text], ")")
                self.out.word(";", "")

    def _option(self, option: tree.Option) -> None:
        self.out.first("option")
        self.out.word(option.name.text)
        self._open()
        for parameter in option.parameters:
            self._parameter(parameter)
        if option.common_decision is not None:
            self.out.blank()
            self.out.first("common")
            self.out.word("decision")
            self._open()
            self._tree(option.common_decision)
            self.out.close("}")
        if option.common_actions is not None:
            self.out.blank()
            self.out.first("common")
            self._actions(option.common_actions)
        for state in option.states:
            self.out.blank()
            self._state(state)
        self.out.close("}")

    def _state(self, state: tree.State) -> None:
        words = [
            *(["initial"] if state.is_initial else []),
            *(["target"] if state.is_target else []),
            *("state", state.name.text),
            *([state.cooperation] if state.cooperation else []),
            *([state.robots] if state.robots else []),
        ]
        self.out.first(words[0])
        for word in words[1:]:
            self.out.word(word)
        self._open()
        if state.decision is not None:
            self._decision(state.decision)
        self.out.end_line()
        self._actions(state.actions)
        self.out.close("}")

    def _decision(self, decision: tree.Decision) -> None:
        self.out.first("decision")
        self._open()
        if decision.begins_with_else:
            self._doc(decision.else_doc)
            self.out.first("else")
            self._after_else(decision.tree)
        else:
            self._tree(decision.tree)
        self.out.close("}")

    def _tree(self, node: tree.Tree) -> None:
        """Write a tree from the beginning of a line."""
        match node:
            case tree.Goto():
                self.out.first("goto")
                self.out.word(node.state.text)
                self.out.word(";", "")
            case tree.Stay():
                self.out.first("stay")
                self.out.word(";", "")
            case tree.Block():
                self.out.first("{")
                self.out.depth += 1
                self._tree(node.inner)
                self.out.close("}")
            case tree.If():
                self._doc(node.doc)
                self.out.first("if")
                self._if(node)

    def _if(self, node: tree.If) -> None:
        """Write what follows the word `if`, with all that follows by `else if`."""
        current: tree.If | None = node
        while current is not None:
            self._condition(current.condition)
            self._branch(current.then)
            following = current.otherwise
            if following is None:
                return
            if current.else_doc or not isinstance(current.then, tree.Block):
                self.out.end_line()
            self._doc(current.else_doc)
            self.out.word("else")
            if isinstance(following, tree.If) and not following.doc:
                self.out.word("if")
                current = following
            else:
                self._after_else(following)
                return

    def _after_else(self, node: tree.Tree) -> None:
        if isinstance(node, tree.If) and not node.doc:
            self.out.word("if")
            self._if(node)
        else:
            self._branch(node)

    def _branch(self, node: tree.Tree) -> None:
        """Write what is done in one case: braces in the same line, or the next line indented."""
        if isinstance(node, tree.Block):
            self.out.word("{")
            self.out.depth += 1
            self._tree(node.inner)
            self.out.close("}")
        else:
            self.out.depth += 1
            self._tree(node)
            self.out.depth -= 1

    def _condition(self, condition: tree.Expression) -> None:
        length = self.out.column + len(_flat(condition)) + 4
        self.out.word("(")
        self._expression(condition, "", breaks=length > WIDTH)
        self.out.word(")", "")

    def _actions(self, actions: tree.Actions) -> None:
        self.out.word("action")
        self._open()
        for action in actions.actions:
            if isinstance(action, tree.Assignment):
                self.out.first(action.symbol.text)
                self.out.word("=")
                self._expression(action.value, " ", breaks=self.out.column + len(_flat(action.value)) > WIDTH)
            else:
                self.out.first(action.name.text)
                if action.kind:
                    self.out.word(action.kind)
                self._arguments(action.arguments, breaks=self.out.column + _length(action.arguments) > WIDTH)
            self.out.word(";", "")
        self.out.close("}")

    def _arguments(self, arguments: tree.Arguments, *, breaks: bool = False) -> None:
        self.out.word("(", "")
        self.out.depth += 1
        for number, argument in enumerate(arguments.given):
            if number:
                self.out.word(",", "")
            if breaks:
                self.out.first(argument.name.text)
            else:
                self.out.word(argument.name.text, " " if number else "")
            self.out.word("=")
            self._expression(argument.value, " ")
        if arguments.ends_with_comma:
            self.out.word(",", "")
        self.out.depth -= 1
        if breaks:
            self.out.first(")")
        else:
            self.out.word(")", "")

    def _expression(self, node: tree.Expression, gap: str, *, breaks: bool = False) -> None:
        """Write an expression; `gap` goes before its first token. Broken ones have && and || at beginnings of lines."""
        match node:
            case tree.Number(text=text) | tree.Word(text=text) | tree.Ref(name=text):
                self.out.word(text, gap)
            case tree.Function():
                self.out.word(node.name.text, gap)
                self._arguments(node.arguments)
            case tree.Parentheses():
                self.out.word("(", gap)
                self._expression(node.inner, "", breaks=breaks)
                self.out.word(")", "")
            case tree.Unary():
                self.out.word(node.operator, gap)
                # Two signs in a row are two tokens.
                self._expression(node.operand, "")
            case tree.Binary():
                self._binary(node, gap, breaks=breaks)
            case tree.Conditional():
                self._expression(node.condition, gap, breaks=breaks)
                self._part("?", node.yes, breaks=breaks)
                self._part(":", node.no, breaks=breaks)

    def _binary(self, node: tree.Binary, gap: str, *, breaks: bool) -> None:
        is_joint = node.operator in ("&&", "||")
        self._expression(node.left, gap, breaks=breaks and is_joint)
        self._part(node.operator, node.right, breaks=breaks and is_joint)

    def _part(self, operator: str, operand: tree.Expression, *, breaks: bool) -> None:
        self.out.depth += 2 * breaks
        if breaks:
            self.out.first(operator)
        else:
            self.out.word(operator)
        self._expression(operand, " ")
        self.out.depth -= 2 * breaks

    def _declaration(self, item: tree.Declaration) -> None:
        self._doc(item.doc)
        match item:
            case tree.Constant():
                self._row(["float"] * item.says_float + ["const", item.name.text, "="])
                if item.number.startswith("-"):
                    self.out.word("-")
                self.out.word(item.number.removeprefix("-"), "" if item.number.startswith("-") else " ")
                if item.unit:
                    self.out.word(f'"{item.unit}"')
            case tree.Enumeration():
                self._row(["enum", item.name.text] + ["internal"] * item.is_internal)
                self._elements(item)
            case tree.Symbol():
                self._row([*_type(item.type), item.direction, item.name.text, *_details(item)])
                if item.parameters is not None:
                    self._parameters("(", item.parameters, ")")
            case tree.Behavior():
                self._row(["behavior", item.name.text])
                self._parameters("{", item.parameters, "}")
                return
        self.out.word(";", "")

    def _elements(self, item: tree.Enumeration) -> None:
        names = [each.text for each in item.elements]
        breaks = self.out.column + sum(map(len, names)) + 2 * len(names) > WIDTH
        self.out.word("{")
        self.out.depth += 1
        for number, name in enumerate(names):
            if number:
                self.out.word(",", "")
            if breaks:
                self.out.first(name)
            else:
                self.out.word(name)
        if breaks:
            self.out.close("}")
        else:
            self.out.depth -= 1
            self.out.word("}")

    def _parameters(self, begin: str, parameters: Sequence[tree.Parameter], end: str) -> None:
        """Write parameters in one line, or a line each where they have descriptions or are many."""
        flat = sum(len(" ".join(_words(each))) + 2 for each in parameters)
        breaks = any(each.doc for each in parameters) or self.out.column + flat > WIDTH
        self.out.word(begin, " " if begin == "{" else "")
        if breaks:
            self.out.depth += 1
            for each in parameters:
                self._parameter(each)
            self.out.close(end)
            return
        for number, each in enumerate(parameters):
            for at, word in enumerate(_words(each)):
                self.out.word(word, " " if begin == "{" or number or at else "")
            self.out.word(";", "")
        self.out.word(end, " " if begin == "{" else "")

    def _parameter(self, parameter: tree.Parameter) -> None:
        self._doc(parameter.doc)
        self._row(_words(parameter))
        self.out.word(";", "")

    def _row(self, words: Sequence[str]) -> None:
        self.out.first(words[0])
        for word in words[1:]:
            self.out.word(word)

    def _list(self, begin: str, words: Sequence[str], end: str) -> None:
        self.out.word(begin, "")
        for number, word in enumerate(words):
            if number:
                self.out.word(",", "")
            self.out.word(word, " " if number else "")
        self.out.word(end, "")

    def _open(self) -> None:
        self.out.word("{")
        self.out.depth += 1

    def _doc(self, doc: str) -> None:
        if doc:
            self.out.first(f"/** {doc} */")
            self.out.end_line()


def _type(of: tree.Type | None) -> list[str]:
    if of is None:
        return []
    return [of.text, of.enum.text] if of.enum else [of.text]


def _details(item: tree.Symbol | tree.Parameter) -> list[str]:
    return [*([f"[{item.range}]"] if item.range else []), *([f'"{item.unit}"'] if item.unit else [])]


def _words(parameter: tree.Parameter) -> list[str]:
    return [*_type(parameter.type), parameter.name.text, *_details(parameter)]


def _flat(node: tree.Expression) -> str:
    """An expression in one line, without comments."""
    layout = Layout({}, ())
    _Printer(layout)._expression(node, "")
    return layout.text().strip()


def _length(arguments: tree.Arguments) -> int:
    return sum(len(each.name.text) + len(_flat(each.value)) + 5 for each in arguments.given) + 2
