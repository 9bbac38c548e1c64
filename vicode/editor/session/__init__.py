"""Open designs: history, edits by gesture, saving and generating. Knows no NiceGUI."""

from vicode.editor.session.document import Document, Sheet
from vicode.editor.session.following import follow, follow_gesture
from vicode.editor.session.gestures import Outcome, apply_gesture, take_places
from vicode.editor.session.history import History, Step
from vicode.editor.session.library import Library
from vicode.editor.session.people import DISK, Company, People, Person, Presence
from vicode.editor.session.workspace import ChangedOnDiskError, Workspace

__all__ = [
    "DISK",
    "ChangedOnDiskError",
    "Company",
    "Document",
    "History",
    "Library",
    "Outcome",
    "People",
    "Person",
    "Presence",
    "Sheet",
    "Step",
    "Workspace",
    "apply_gesture",
    "follow",
    "follow_gesture",
    "take_places",
]
