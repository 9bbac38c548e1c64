"""Experiments with simulated robots: runs of several seeds, and a page with their figures."""
