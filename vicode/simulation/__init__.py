"""Steps one component in a process of its own, as somebody outside asks for: inputs, steps, records of what happened.

The process is started as `python -m vicode.simulation`; user code runs nowhere else.
"""

from vicode.simulation.messages import (
    Answer,
    Failed,
    Inputs,
    Looked,
    Moment,
    ProtocolError,
    Ready,
    Request,
    Rested,
    Setup,
    StandIn,
    StandInOutput,
    Stops,
    decode_answer,
    encode_request,
    encode_setup,
)

__all__ = [
    "Answer",
    "Failed",
    "Inputs",
    "Looked",
    "Moment",
    "ProtocolError",
    "Ready",
    "Request",
    "Rested",
    "Setup",
    "StandIn",
    "StandInOutput",
    "Stops",
    "decode_answer",
    "encode_request",
    "encode_setup",
]
