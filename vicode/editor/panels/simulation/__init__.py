"""The simulation panel of the open design and its controller."""
