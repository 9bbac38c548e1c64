"""The language server: what text editors ask of a behavior while somebody writes it."""
