"""XABSL, the Extensible Agent Behavior Specification Language: read, checked, compiled, printed and run."""
