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
    count = 0
    part = out.with_name(f"{out.name}.part")
    try:
        with part.open("wb") as stream:
            writer: Any = Writer(stream)
            writer.start(profile="", library="vicode")
            schema = writer.register_schema(name="vicode", encoding="jsonschema", data=b'{"type": "object"}')
            channels: dict[str, int] = {}
            for iteration in iterations:
                for topic, message in _messages(iteration):
                    if topic not in channels:
                        channels[topic] = writer.register_channel(
                            topic=topic, message_encoding="json", schema_id=schema
                        )
                    data = json.dumps(message).encode()
                    time_ns = iteration.time_ns
                    writer.add_message(
                        channel_id=channels[topic],
                        log_time=time_ns,
                        publish_time=time_ns,
                        sequence=iteration.iteration,
                        data=data,
                    )
                    count += 1
            writer.finish()
        part.replace(out)
    finally:
        part.unlink(missing_ok=True)
    return count


def _messages(iteration: "IterationResult") -> Iterable[tuple[str, dict[str, Any]]]:
    for component, values in iteration.inputs.items():
        yield f"/{component}", dict(values)
    for step in iteration.tree:
        own = {"state": step["state"], "transition": step.get("transition"), "worked": step.get("worked")}
        yield f"/{step['component']}", {**(step.get("values") or {}), **own}
    for error in iteration.errors:
        yield _ERRORS, error
