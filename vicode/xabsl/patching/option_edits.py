"""Edits options: parameters, common decisions and actions, states."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from vicode.xabsl import tree
from vicode.xabsl.lexer import Comment
from vicode.xabsl.parser import ParsedFile
from vicode.xabsl.patching.decision_edits import DecisionEdits
from vicode.xabsl.patching.declaration_edits import edit_doc, edit_parameters
from vicode.xabsl.patching.doc_edits import edit_words, last_spans_with_words
from vicode.xabsl.patching.expression_edits import edit_arguments, edit_expression
from vicode.xabsl.patching.list_edits import ListStyle, edit_list, match_items, remove_item, text_similarity
from vicode.xabsl.patching.source_edits import SourceEdits, indented
from vicode.xabsl.printer import print_node

_DEFAULT_UNIT = "  "
_NO_ACTIONS = tree.ActionBlockNode([])


@dataclass(frozen=True, slots=True)
class OptionVersion:
    """An option with its file; `states` are its states in the order of the behavior."""

    option: tree.OptionNode
    file: ParsedFile
    states: tuple[tree.StateNode, ...]

    @property
    def comments(self) -> Mapping[int, Sequence[Comment]]:
        return self.file.file.comments

    def doc_of(self, state: tree.StateNode) -> str:
        """The text of the comments above a state."""
        lines = (comment.text for comment in self.comments.get(state.first_token, ()) if comment.own_line)
        return " ".join(" ".join(line.removeprefix("//") for line in lines).split())


def edit_option(file: SourceEdits, old: tree.OptionNode, before: OptionVersion, after: OptionVersion) -> None:
    """Change an option; `before` is the original in the form of `after`."""
    _OptionEdits(file, old, before, after).run()


class _OptionEdits:
    def __init__(self, file: SourceEdits, old: tree.OptionNode, before: OptionVersion, after: OptionVersion) -> None:
        self.file, self.old, self.before, self.after = file, old, before, after
        self.indent, self.unit = _indentation(file, old)
        self.decisions = DecisionEdits(file, self.unit, {key: [*each] for key, each in after.comments.items()})

    def run(self) -> None:
        file, old, before, after = self.file, self.old, self.before.option, self.after.option
        edit_doc(file, old, before.doc, after.doc)
        opening = old.name.last_token + 1
        style = ListStyle(opening=opening, indent=self.indent)
        edit_parameters(file, old.parameters, (before.parameters, after.parameters), style)
        self._edit_common()
        self._edit_states()

    def _edit_common(self) -> None:
        old, before, after = self.old, self.before.option, self.after.option
        if before.common_decision != after.common_decision:
            self._edit_common_decision(old.common_decision, before.common_decision, after.common_decision)
        if before.common_actions == after.common_actions:
            return
        if after.common_actions is None:
            assert old.common_actions is not None
            remove_item(self.file, old.common_actions.first_token - 2, old.common_actions.last_token)
        elif old.common_actions is None:
            text = print_node(after.common_actions, self.after.comments)
            self._add_block(old.states[0].first_token, f"common {text}")
        else:
            self._edit_actions(old.common_actions, before.common_actions or _NO_ACTIONS, after.common_actions)

    def _edit_common_decision(
        self,
        old: tree.DecisionTreeNode | None,
        before: tree.DecisionTreeNode | None,
        after: tree.DecisionTreeNode | None,
    ) -> None:
        if old is not None and before is not None and after is not None:
            self.decisions.edit(old, before, after)
        elif old is not None:
            remove_item(self.file, old.first_token - 3, old.last_token + 1)
        elif after is not None:
            inner = self.decisions.print(after).replace("\n", "\n  ")
            actions = self.old.common_actions
            first = actions.first_token - 2 if actions else self.old.states[0].first_token
            self._add_block(first, f"common decision {{\n  {inner}\n}}")

    def _add_block(self, first: int, text: str) -> None:
        """Add a block in its own lines before the item that starts with the token `first`."""
        file = self.file
        position = file.end_with_comment(first - 1)
        block = self.indent + indented(text, self.indent, self.unit)
        above = "\n" if file.tokens.kinds[first - 1] == "{" else "\n\n"
        rest = file.text[position : file.start(first)]
        if "\n" not in rest:
            # The item follows in the same line.
            file.delete(position, position + len(rest) - len(rest.lstrip(" \t")))
            file.insert(position, f"{above}{block}\n\n{self.indent}")
        else:
            is_blank = not rest.split("\n")[1].strip() and rest.count("\n") > 1
            file.insert(position, above + block + ("" if is_blank else "\n"))

    # States

    def _edit_states(self) -> None:
        file, old = self.file, self.old
        before = {state.name.text: state for state in self.before.states}
        states = self.after.states
        names = [state.name.text for state in old.states]
        matches = [names.index(state.name.text) if state.name.text in before else None for state in states]
        added = []
        for state, match in zip(states, matches, strict=True):
            if match is None:
                added.append(self._print_state(state))
            else:
                self._edit_state(old.states[match], before[state.name.text], state)
                added.append("")
        opening = self._token_before_states()
        has_blank = len(old.states) < 2 or any(
            "\n" in file.text[file.end_with_comment(one.last_token) : file.start_with_comments(two.first_token)][1:]
            for one, two in zip(old.states, old.states[1:], strict=False)
        )
        style = ListStyle(opening=opening, indent=self.indent, unit=self.unit, has_blank_lines=has_blank)
        if matches != list(range(len(old.states))):
            edit_list(file, old.states, matches, added, style)

    def _token_before_states(self) -> int:
        """The last token before the states that is not removed."""
        old, before, after = self.old, self.before.option, self.after.option
        first = old.states[0].first_token
        removes_actions = before.common_actions is not None and after.common_actions is None
        if old.common_actions is not None and removes_actions:
            first = old.common_actions.first_token - 2
        keeps_actions = old.common_actions is not None and not removes_actions
        if old.common_decision is not None and after.common_decision is None and not keeps_actions:
            first = old.common_decision.first_token - 3
        return first - 1

    def _print_state(self, state: tree.StateNode) -> str:
        return indented(print_node(state, self.after.comments), self.indent, self.unit)

    def _edit_state(self, old: tree.StateNode, before: tree.StateNode, after: tree.StateNode) -> None:
        self._edit_state_doc(old, before, after)
        if old.decision is not None and self._has_common_changed():
            self._edit_else(old.decision)
        if before == after:
            return
        self._edit_head(old, before, after)
        self._edit_decision(old, before, after)
        self._edit_actions(old.actions, before.actions, after.actions)

    def _edit_state_doc(self, old: tree.StateNode, before: tree.StateNode, after: tree.StateNode) -> None:
        was, now = self.before.doc_of(before), self.after.doc_of(after)
        if was == now:
            return
        file, first = self.file, old.first_token
        start, end = file.end_with_comment(first - 1), file.start(first)
        spans = [span for span in file.comment_spans(start, end) if file.is_first_in_line(span[0])]
        doc_spans = last_spans_with_words(file, spans, was)
        if doc_spans:
            edit_words(file, doc_spans, was, now)
            return
        lines = print_node(after, self.after.comments).split("\n")
        comments = [line for line in lines if line.startswith("//")]
        if comments:
            self._insert_before(first, f"\n{self.indent}".join(comments), self.indent)

    def _edit_head(self, old: tree.StateNode, before: tree.StateNode, after: tree.StateNode) -> None:
        """Edit what precedes the brace, except the name."""
        file = self.file
        first = old.first_token
        keyword = old.name.first_token - 1
        flags = (("initial", before.is_initial, after.is_initial), ("target", before.is_target, after.is_target))
        for word, was, now in flags:
            if now and not was:
                file.insert(file.start(first if word == "initial" else keyword), f"{word} ")
            elif was and not now:
                token = next(at for at in range(first, keyword) if file.tokens.kinds[at] == word)
                file.delete(file.start(token), file.start(token + 1))
        if (before.cooperation, before.robots) != (after.cooperation, after.robots):
            opening = file.tokens.kinds.index("{", old.name.last_token)
            words = [word for word in (after.cooperation, after.robots) if word]
            start = file.end(old.name.last_token)
            file.replace(start, file.end(opening - 1), "".join(f" {word}" for word in words))

    def _edit_decision(self, old: tree.StateNode, before: tree.StateNode, after: tree.StateNode) -> None:
        if before.decision == after.decision:
            return
        was, now = old.decision, after.decision
        if was is None:
            if now is not None:
                lines = indented(print_node(now, self.after.comments), self._inner(old), self.unit)
                # `action` is the token before the brace of the actions.
                self._insert_before(old.actions.first_token - 1, lines, self._inner(old))
        elif now is None:
            remove_item(self.file, was.first_token, was.last_token)
        elif before.decision is None:
            self.decisions.replace(was.tree, now.tree, now.else_doc)
        else:
            docs = was.else_doc, before.decision.else_doc, now.else_doc
            self.decisions.edit(was.tree, before.decision.tree, now.tree, docs)

    def _has_common_changed(self) -> bool:
        """Whether the common decision is added or removed."""
        commons = self.before.option.common_decision, self.after.option.common_decision
        return (commons[0] is None) != (commons[1] is None)

    def _edit_else(self, old: tree.DecisionNode) -> None:
        """Add or remove the `else` that follows a common decision: without one, there is none."""
        file, first = self.file, old.tree.first_token
        if self.after.option.common_decision is None:
            file.delete(file.start(first - 1), file.start(first))
        else:
            file.insert(file.start(first), "else ")

    def _inner(self, state: tree.StateNode) -> str:
        return self.file.indent_at(self.file.start(state.first_token)) + self.unit

    def _insert_before(self, token: int, lines: str, indent: str) -> None:
        file = self.file
        if file.starts_line(token):
            file.insert(file.start_with_comments(token), f"{indent}{lines}\n")
        else:
            position = file.start(token)
            file.delete(len(file.text[:position].rstrip(" \t")), position)
            file.insert(position, f"\n{indent}{lines}\n{indent}")

    # Actions

    def _edit_actions(
        self, old: tree.ActionBlockNode, before: tree.ActionBlockNode, after: tree.ActionBlockNode
    ) -> None:
        file = self.file
        keys = [print_node(action) for action in before.actions]
        new_keys = [print_node(action) for action in after.actions]
        matches = match_items(keys, new_keys, lambda one, other: _similarity(before.actions[one], after.actions[other]))
        opening = old.first_token
        indent = (
            file.indent_at(file.start(old.actions[0].first_token))
            if old.actions and file.is_first_in_line(file.start(old.actions[0].first_token))
            else file.indent_at(file.start(opening)) + self.unit
        )
        added = []
        for action, match in zip(after.actions, matches, strict=True):
            if match is None:
                added.append(indented(print_node(action, self.after.comments), indent, self.unit))
            else:
                self._edit_action(old.actions[match], before.actions[match], action)
                added.append("")
        if matches != list(range(len(old.actions))):
            style = ListStyle(opening=opening, indent=indent, unit=self.unit)
            edit_list(file, old.actions, matches, added, style)

    def _edit_action(self, old: tree.ActionNode, before: tree.ActionNode, after: tree.ActionNode) -> None:
        """Change an action that still sets the same symbol or calls the same component: others do not match."""
        file = self.file
        match old, before, after:
            case tree.AssignmentNode(), tree.AssignmentNode(), tree.AssignmentNode():
                edit_expression(file, old.value, before.value, after.value)
            case tree.CallNode(), tree.CallNode(), tree.CallNode():
                if before.kind != after.kind:
                    name = " ".join(word for word in (after.name.text, after.kind) if word)
                    file.replace(file.start(old.first_token), file.end(old.arguments.first_token - 1), name)
                if before.arguments != after.arguments and not edit_arguments(
                    file, old.arguments, before.arguments, after.arguments
                ):
                    file.replace_node(old.arguments, print_node(after.arguments))


def _similarity(old: tree.ActionNode, new: tree.ActionNode) -> float:
    """At least 0.5 if both set the same symbol or call the same component, otherwise 0."""
    match old, new:
        case (tree.AssignmentNode(symbol=old_name), tree.AssignmentNode(symbol=new_name)) | (
            tree.CallNode(name=old_name),
            tree.CallNode(name=new_name),
        ) if old_name == new_name:
            return 0.5 + 0.5 * text_similarity(print_node(old), print_node(new))
    return 0.0


def _indentation(file: SourceEdits, option: tree.OptionNode) -> tuple[str, str]:
    """The indentation of states and of one level."""
    for state in option.states:
        first = state.decision.first_token if state.decision else state.actions.first_token - 1
        outer, inner = (file.start(token) for token in (state.first_token, first))
        if file.is_first_in_line(outer) and file.is_first_in_line(inner):
            indent, deeper = file.indent_at(outer), file.indent_at(inner)
            if deeper.startswith(indent) and deeper != indent:
                return indent, deeper.removeprefix(indent)
    return _DEFAULT_UNIT, _DEFAULT_UNIT
