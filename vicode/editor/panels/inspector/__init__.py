"""What the inspector shows for the selection."""
