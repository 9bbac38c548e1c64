"""The web editor: `session` and `view` know no NiceGUI; pages, panels and the canvas do."""
