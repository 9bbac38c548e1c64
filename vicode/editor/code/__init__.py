"""What our code editors add to NiceGUI's: completion asked of the server, marks under characters, ways by keyboard."""

from vicode.editor.code.element import CodeAssist

__all__ = ["CodeAssist"]
