"""Keys of decisions: a text for the path of a decision, as the editor, records and traces use it."""

from vicode.findings import DesignPath


def transition_key(path: DesignPath) -> str:
    """The key of a decision: "Kick/0", "Kick/2/then/1", "@common/0"."""
    source, rest = ("@common", path[2:]) if path[0] == "common" else (path[1], path[3:])
    return "/".join(str(part) for part in (source, *rest))


def parse_transition_key(key: str) -> DesignPath:
    """The path of a decision from its key."""
    source, *rest = key.split("/")
    start: DesignPath = ("common", "transitions") if source == "@common" else ("states", source, "transitions")
    return (*start, *(int(part) if part.isdecimal() else part for part in rest))
