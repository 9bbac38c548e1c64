"""Compares languages for the editor: `python -m vicode.conformance`, in the sandbox of simulations.

The request is a line on standard input: a dictionary, pickled by the editor and encoded in base64. The answers are
lines of JSON on standard output: the name of each language before it runs, then the result.
"""

import base64
import json
import os
import pickle
import sys
from dataclasses import asdict
from pathlib import Path
from typing import Any

from vicode.conformance.comparison import choose_inputs, compare_languages
from vicode.simulation.limits import limit_memory

# Compilers need more than the code of a design.
_MEMORY_BYTES = 2 << 30


def main() -> int:
    """Answer the request; what user code prints goes to standard error."""
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)

    def send(answer: dict[str, Any]) -> None:
        answers.write(f"{json.dumps(answer)}\n")
        answers.flush()

    # The editor, which runs with all rights of the user, wrote it.
    request = pickle.loads(base64.b64decode(sys.stdin.buffer.readline()))  # noqa: S301
    limit_memory(_MEMORY_BYTES)
    runs = choose_inputs(request["project"], request["root"], iterations=request["iterations"], seed=request["seed"])
    folder, modules = Path(request["folder"]), Path(request["modules"])
    result = compare_languages(runs, folder, modules, lambda language: send({"language": language}))
    send({"result": asdict(result)})
    return 0


if __name__ == "__main__":
    sys.exit(main())
