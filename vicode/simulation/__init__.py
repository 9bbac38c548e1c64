"""Runs one component in a separate process: takes inputs, steps, and reports a record of each iteration.

The process is started as `python -m vicode.simulation`. All modules that run user code are listed in
`tests/architecture/test_user_code.py`.
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
    Start,
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
    "Start",
    "StopConditions",
    "Stopped",
    "Stub",
    "StubOutput",
    "decode_response",
    "encode_request",
    "encode_setup",
]
