"""Writes a trace as MCAP, which viewers such as Foxglove open: a topic of JSON messages per component."""

import json
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from vicode.simulation import IterationResult

_ERRORS = "/errors"
_STEP_FIELDS = {"state": "", "transition": None, "worked": False}
"""The fields of each message, with the values of a component that was not stepped."""


def export_mcap(iterations: "Iterable[IterationResult]", out: Path) -> int:
    """Write a trace and return the number of messages: one per component and iteration, all with the same fields.

    Values are fields beside `state`, `transition` and `worked`.

    Raises:
        OSError: The file cannot be written, or the package mcap is missing.
        TraceError: A line is not part of the trace.
    """
    try:
        from mcap.writer import Writer
    except ImportError as error:
        raise OSError("the package mcap is missing; install it with: pip install 'vicode-fsm[mcap]'") from error
    part = out.with_name(f"{out.name}.part")
    try:
        part.unlink(missing_ok=True)
        with part.open("xb") as stream:
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
    # Of a component that was stepped several times, the last step counts.
    steps = {str(step["component"]): step for step in iteration.tree}
    for component, values in iteration.values().items():
        step = steps.get(component, {})
        own = {name: step.get(name, default) for name, default in _STEP_FIELDS.items()}
        yield f"/{component}", {**(values or {}), **own}
    for error in iteration.errors:
        yield _ERRORS, error
