"""XABSL, the Extensible Agent Behavior Specification Language: compiler, formatter, engine, language server."""
