"""Steps one component in a process of its own, as somebody outside asks for: inputs, steps, records of what happened.

The process is started as `python -m vicode.simulation`; user code runs nowhere else.
"""

from vicode.simulation.messages import (
    Failed,
    Inputs,
    Inspected,
    IterationResult,
    ProtocolError,
    Ready,
    Request,
    Response,
    Setup,
    StopConditions,
    Stopped,
    Stub,
    StubOutput,
    decode_response,
    encode_request,
    encode_setup,
)

__all__ = [
    "Failed",
    "Inputs",
    "Inspected",
    "IterationResult",
    "ProtocolError",
    "Ready",
    "Request",
    "Response",
    "Setup",
    "StopConditions",
    "Stopped",
    "Stub",
    "StubOutput",
    "decode_response",
    "encode_request",
    "encode_setup",
]
