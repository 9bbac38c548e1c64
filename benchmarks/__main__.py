"""`python -m benchmarks` measures the runtime; the canvas, which needs a browser, has a separate command."""

from benchmarks.runtime import main

main()
