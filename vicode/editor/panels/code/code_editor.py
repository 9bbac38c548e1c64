"""Code editors that follow the light or dark theme of the window."""

from weakref import WeakSet

from nicegui import ui
from nicegui.elements.codemirror.constants import SUPPORTED_LANGUAGES, SUPPORTED_THEMES


class CodeEditorFactory:
    """Creates the code editors of one window and switches their theme."""

    def __init__(self) -> None:

        self._theme: SUPPORTED_THEMES = "vscodeLight"
        self._editors: WeakSet[ui.codemirror] = WeakSet()

    def create(self, language: SUPPORTED_LANGUAGES | None = "Python") -> ui.codemirror:
        editor = ui.codemirror(language=language, theme=self._theme)
        self._editors.add(editor)
        return editor

    def set_dark(self, *, is_dark: bool) -> None:
        self._theme = "githubDark" if is_dark else "vscodeLight"
        for editor in tuple(self._editors):
            if not editor.is_deleted:
                editor.set_theme(self._theme)
