"""The parts of the editor's page around the canvas."""
