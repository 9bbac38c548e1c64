"""Serve one simulation: `python -m vicode.simulation`, with the protocol on standard input and output."""

import os
import sys
import traceback

from vicode.simulation.worker import main

if __name__ == "__main__":
    try:
        code = main()
    except Exception:
        traceback.print_exc(file=sys.__stderr__)
        code = 2
    # Threads started by user code must not keep the process alive.
    os._exit(code)
