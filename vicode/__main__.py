"""`python -m vicode` is the command `vicode`."""

import sys

from vicode.cli import main

sys.exit(main())
