"""The commands to extract the selected states as a component, and to inline the component of a state."""

from vicode.editor.panels.commands.command import Command, MenuGroup
from vicode.editor.panels.designs.design_dialogs import dialog_buttons, name_field
from vicode.editor.panels.dialogs import titled_dialog
from vicode.editor.panels.texts import sentence
from vicode.editor.panels.window_context import WindowContext
from vicode.editor.session import EditResult
from vicode.editor.session.project.extraction import extract_states, inline_state


class ExtractionCommands:
    """Acts on the selection of one window."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context

    def commands(self) -> tuple[Command, ...]:
        extract = Command("extract", "Extract component…", self.ask_name, MenuGroup.EDIT)
        return (extract, Command("inline", "Inline component", self.inline, MenuGroup.EDIT))

    @property
    def _states(self) -> list[str]:
        return [item.id for item in self._context.selected if item.kind == "states"]

    def ask_name(self) -> None:
        states, context = self._states, self._context
        with titled_dialog("Extract component") as dialog:
            name = name_field("Name of the component", "", "FollowBall")

            def extract() -> None:
                result = extract_states(context.workspace, context.document, states, name.value.strip())
                if not result.error:
                    dialog.close()
                self._show(result, f"Extracted {len(states)} {'state' if len(states) == 1 else 'states'}")

            dialog_buttons(dialog, "Extract", extract, name)

    def inline(self) -> None:
        context, state = self._context, (*self._states, "The design")[0]
        self._show(inline_state(context.workspace, context.document, state), f"Inlined {state}")

    def _show(self, result: EditResult, done: str) -> None:
        context = self._context
        if result.error:
            context.show_toast(sentence(result.error), "warning")
            return
        entry = context.document.history.current.compound
        if entry is not None:
            context.page.offer_undo(done, lambda: context.document.undo_compound(entry))
        if result.note:
            context.show_toast(sentence(result.note), "info")
        context.select(*(result.new_selection or ()))
