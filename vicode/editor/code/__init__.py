"""Extensions of NiceGUI's code editor: completion by the server, marks under the text, keyboard access."""

from vicode.editor.code.element import CodeAssist

__all__ = ["CodeAssist"]
