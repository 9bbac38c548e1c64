"""Pure functions that edit what only diagrams show: frames, notes and colors."""

from collections.abc import Collection, Iterable, Mapping
from dataclasses import replace

from vicode.model.design import Design, DiagramFrame, Point


def set_color(design: Design, states: Collection[str], frames: Collection[str], color: str) -> Design:
    """Set the color of states and frames; "" for none."""
    return replace(
        design,
        states=tuple(replace(state, color=color) if state.name in states else state for state in design.states),
        frames=tuple(replace(frame, color=color) if frame.name in frames else frame for frame in design.frames),
    )


def move_notes(design: Design, places: Mapping[str, Point]) -> Design:
    """Set the centers of notes."""
    return replace(design, notes=tuple(replace(note, at=places.get(note.name, note.at)) for note in design.notes))


def remove_notes(design: Design, names: Collection[str]) -> Design:
    return replace(design, notes=tuple(note for note in design.notes if note.name not in names))


def add_frame(design: Design, name: str, states: Iterable[str]) -> Design:
    return replace(design, frames=(*design.frames, DiagramFrame(name=name, states=tuple(states))))


def set_frame_states(design: Design, name: str, states: tuple[str, ...]) -> Design:
    frames = tuple(replace(frame, states=states) if frame.name == name else frame for frame in design.frames)
    return replace(design, frames=frames)


def rename_frame(design: Design, old: str, new: str) -> Design:
    """Change the title of a frame, which no other frame may have."""
    if design.frame(new) is not None:
        return design
    frames = tuple(replace(frame, name=new) if frame.name == old else frame for frame in design.frames)
    return replace(design, frames=frames)


def remove_frames(design: Design, names: Collection[str]) -> Design:
    """Remove frames; their states stay."""
    return replace(design, frames=tuple(frame for frame in design.frames if frame.name not in names))
