"""vicode: design robot state machines in the browser, check them, and generate the code that runs them."""

__version__ = "0.1.0"
