"""Runs a component with `python -m vicode.bica`, or `python -m bica` if the package was copied."""

import sys

from .run import main

if __name__ == "__main__":
    sys.exit(main())
