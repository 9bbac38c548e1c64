"""Recorded runs: reads and indexes traces (docs/traces.md), counts states and transitions, exports MCAP."""
