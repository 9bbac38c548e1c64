"""The bridge: a server that runs behaviors for robot programs that connect over a socket (docs/bridge.md)."""
