"""A line of states and transitions typed into the command palette, such as "Idle -order-> Drive -20 s-> Idle"."""

from vicode.editor.pages import texts
from vicode.editor.panels.commands.command import TypedCommand
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.view import ItemRef
from vicode.model.transition_line import TransitionLine, add_line, is_transition_line, parse_transition_line


class LineCommand:
    """Offers to create what a typed line describes."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context

    def interpret(self, text: str) -> TypedCommand | None:
        """The command that creates the line, or the reason why not; None if the text is no line."""
        if not is_transition_line(text):
            return None
        design = self._context.design
        line = parse_transition_line(text, design.time_unit)
        if isinstance(line, str):
            return TypedCommand(label="This line cannot be read", detail=line)
        states, transitions = line.missing_states(design), line.missing_transitions(design)
        if not states and not transitions:
            return TypedCommand(label="These states and transitions exist already", detail=text.strip())
        label = texts.create_line(states, len(transitions))
        return TypedCommand(label=label, detail=text.strip(), handler=lambda: self._create(line))

    def _create(self, line: TransitionLine) -> None:
        context = self._context
        states, transitions = line.missing_states(context.design), line.missing_transitions(context.design)
        was_empty = not context.design.states
        label = texts.create_line(states, len(transitions))
        context.edit(label[:1].lower() + label[1:], lambda design: add_line(design, line))
        created = tuple(ItemRef(kind="states", id=name) for name in states if context.design.state(name) is not None)
        if created:
            context.select(*created)
        if was_empty:
            context.page.run_canvas_command("fit")
        else:
            context.page.reveal((*created, ItemRef(kind="states", id=line.states[-1]))[0])
