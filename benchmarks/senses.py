"""The hand-written component that the measured state machines read."""

from vicode.bica import Component, Root


class Senses(Component):
    """Three numbers between 0 and 1, set from outside before each iteration."""

    def __init__(self, root: Root) -> None:
        super().__init__(root)
        self.a = self.b = self.c = 0.0
