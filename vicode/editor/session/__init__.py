"""Open designs: undo history, gestures, saving and code generation, independent of NiceGUI."""

from vicode.editor.session.document import DocumentSession, SharedDocument
from vicode.editor.session.gestures.canvas_gestures import apply_layout
from vicode.editor.session.gestures.edits import EditResult, apply_edit
from vicode.editor.session.gestures.rebase import rebase_gesture, rebase_selection
from vicode.editor.session.history import HistoryEntry, UndoHistory
from vicode.editor.session.library import Library
from vicode.editor.session.presence import DISK_USER, Presence, PresenceRoom, User, UserDirectory
from vicode.editor.session.workspace import DiskConflictError, Workspace

__all__ = [
    "DISK_USER",
    "DiskConflictError",
    "DocumentSession",
    "EditResult",
    "HistoryEntry",
    "Library",
    "Presence",
    "PresenceRoom",
    "SharedDocument",
    "UndoHistory",
    "User",
    "UserDirectory",
    "Workspace",
    "apply_edit",
    "apply_layout",
    "rebase_gesture",
    "rebase_selection",
]
