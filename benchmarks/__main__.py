"""`python -m benchmarks` measures the runtime; the canvas, which needs a browser, has a command of its own."""

from benchmarks.runtime import main

main()
