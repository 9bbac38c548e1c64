"""What the commands of the design page do."""

from nicegui import background_tasks, run

from vicode.diagram.layout import lay_out
from vicode.editor.pages.drawing import Drawing
from vicode.editor.pages.look import Theme
from vicode.editor.panels.command import Command, Place
from vicode.editor.panels.desk import Desk
from vicode.editor.panels.save_dialog import ask_about_disk
from vicode.editor.session import ChangedOnDiskError, take_places


class Actions:
    """The commands of one window."""

    def __init__(self, desk: Desk, drawing: Drawing, theme: Theme) -> None:
        """Work on what this window shows."""
        self.desk, self.drawing, self.theme = desk, drawing, theme
        self.links_shown = True

    def commands(self) -> tuple[Command, ...]:
        """All of them, in the order in which they are listed."""
        document = self.desk.document
        design, edit, view = Place.DESIGN, Place.EDIT, Place.VIEW
        return (
            Command(
                name="save",
                label="Save",
                act=self.save,
                place=design,
                icon="save",
                keys=("Ctrl+S",),
                while_typing=True,
            ),
            Command(name="generate", label="Generate", act=self.generate, place=design, icon="bolt"),
            Command(name="undo", label="Undo", act=document.undo, place=edit, icon="undo", keys=("Ctrl+Z",)),
            Command(
                name="redo",
                label="Redo",
                act=document.redo,
                place=edit,
                icon="redo",
                keys=("Ctrl+Shift+Z", "Ctrl+Y"),
            ),
            Command(
                name="lay-out",
                label="Lay out what is selected, or everything",
                act=self.lay_out,
                place=edit,
                icon="auto_awesome_mosaic",
            ),
            Command(
                name="links",
                label="Show or hide links to components",
                act=self.toggle_links,
                place=view,
                icon="hub",
            ),
            Command(
                name="theme",
                label="Light, dark, or as the system",
                act=self.toggle_theme,
                place=view,
                icon="contrast",
            ),
        )

    def save(self) -> bool:
        """Write the design into its file; false if it was not."""
        desk = self.desk
        try:
            desk.workspace.save(desk.document)
        except ChangedOnDiskError:
            ask_about_disk(desk)
            return False
        except (OSError, ValueError) as error:
            # A design may hold for a while what no file can: two declarations of one name.
            desk.say(f"Not saved: {error}", "negative")
            return False
        desk.say("Saved", "positive")
        return True

    def generate(self) -> None:
        """Write the code, after saving."""
        if self.desk.document.is_saved or self.save():
            background_tasks.create(self._write_code(), name="generate")

    async def lay_out(self) -> None:
        """Place the selected states, or all; one edit, so that undo takes it back."""
        desk = self.desk
        only = [thing.id for thing in desk.selected if thing.of == "states"] or None
        # Graphviz works beside the server.
        layout = await run.io_bound(lay_out, desk.design, only=only)
        if layout is None or self.drawing.canvas.is_deleted:
            return
        desk.edit("lay out", lambda design: take_places(design, layout.placement, only))
        if layout.note:
            desk.say(layout.note, "info")
        self.drawing.canvas.fit()

    def toggle_links(self) -> None:
        """Show or hide what states require and modulate."""
        self.links_shown = not self.links_shown
        self.drawing.canvas.show_links(self.links_shown)

    def toggle_theme(self) -> None:
        """Go on to the next of system, dark and light."""
        self.desk.say(self.theme.toggle(), "info")

    async def _write_code(self) -> None:
        desk, canvas = self.desk, self.drawing.canvas
        try:
            outcome = await run.io_bound(desk.workspace.generate, desk.document)
        except ChangedOnDiskError:
            with canvas.client:
                ask_about_disk(desk)
            return
        except OSError as error:
            with canvas.client:
                desk.say(f"Not generated: {error}", "negative")
            return
        if outcome is None or canvas.is_deleted:
            return
        with canvas.client:
            desk.say(outcome.words, "positive" if outcome.is_sound else "negative")
