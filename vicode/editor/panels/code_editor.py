"""Code editors whose colours follow the window, light or dark."""

from weakref import WeakSet

from nicegui import ui
from nicegui.elements.codemirror.constants import SUPPORTED_LANGUAGES, SUPPORTED_THEMES
from nicegui.events import CodeMirrorFocusChangeEventArguments, Handler


class CodeEditorFactory:
    """Makes the code editors of one window and keeps their colours."""

    def __init__(self) -> None:
        """Begin with light colours; the window says when it knows better."""
        self._theme: SUPPORTED_THEMES = "vscodeLight"
        self._editors: WeakSet[ui.codemirror] = WeakSet()

    def create(
        self,
        on_focus: Handler[CodeMirrorFocusChangeEventArguments] | None = None,
        language: SUPPORTED_LANGUAGES | None = "Python",
    ) -> ui.codemirror:
        """An empty editor of code in a language."""
        editor = ui.codemirror(language=language, theme=self._theme, on_focus_change=on_focus)
        self._editors.add(editor)
        return editor

    def set_dark(self, *, is_dark: bool) -> None:
        """Use dark or light colours in all of them from now on."""
        self._theme = "githubDark" if is_dark else "vscodeLight"
        for editor in tuple(self._editors):
            if not editor.is_deleted:
                editor.set_theme(self._theme)
