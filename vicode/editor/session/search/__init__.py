"""What the palette and the search find."""
