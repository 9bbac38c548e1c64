"""XABSL as a target language: names in XABSL, and unsupported features of designs."""
