"""Writes a trace as MCAP, which viewers such as Foxglove open: a topic of JSON messages per component."""

import json
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from vicode.simulation import IterationResult

_ERRORS = "/errors"


def export_mcap(iterations: "Iterable[IterationResult]", out: Path) -> int:
    """Write a trace and return the number of messages; values are fields beside `state` and `transition`.

    Raises:
        OSError: The file cannot be written, or the package mcap is missing.
        TraceError: A line is not part of the trace.
    """
    try:
        from mcap.writer import Writer
    except ImportError as error:
        raise OSError("the package mcap is missing; install it with: pip install 'vicode[mcap]'") from error
    part = out.with_name(f"{out.name}.part")
    try:
        with part.open("wb") as stream:
            writer: Any = Writer(stream)
            writer.start(profile="", library="vicode")
            count = _write(writer, iterations)
            writer.finish()
        part.replace(out)
    finally:
        part.unlink(missing_ok=True)
    return count


def _write(writer: Any, iterations: "Iterable[IterationResult]") -> int:
    schema = writer.register_schema(name="vicode", encoding="jsonschema", data=b'{"type": "object"}')
    channels: dict[str, int] = {}
    count = 0
    for iteration in iterations:
        time_ns, number = iteration.time_ns, iteration.iteration
        for topic, message in _messages(iteration):
            if topic not in channels:
                channels[topic] = writer.register_channel(topic=topic, message_encoding="json", schema_id=schema)
            data = json.dumps(message).encode()
            writer.add_message(channels[topic], log_time=time_ns, publish_time=time_ns, sequence=number, data=data)
            count += 1
    return count


def _messages(iteration: "IterationResult") -> Iterable[tuple[str, dict[str, Any]]]:
    for component, values in iteration.inputs.items():
        yield f"/{component}", dict(values)
    for step in iteration.tree:
        own = {"state": step["state"], "transition": step.get("transition"), "worked": step.get("worked")}
        yield f"/{step['component']}", {**(step.get("values") or {}), **own}
    for error in iteration.errors:
        yield _ERRORS, error
