"""The language server for XABSL."""
