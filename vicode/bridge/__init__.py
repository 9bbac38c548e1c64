"""The bridge: a server that runs behaviors for robot programs that connect over a socket (docs/bridge.md).

User code imports the declarations of a world from here; they use the standard library only.
"""

from vicode.bridge.declarations import Command, Event, Sensor, cached_per_tick
from vicode.bridge.world import World

__all__ = ["Command", "Event", "Sensor", "World", "cached_per_tick"]
