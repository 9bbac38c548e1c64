"""The web editor: `session` and `view` do not depend on NiceGUI."""
