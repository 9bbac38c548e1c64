"""Shows and controls running robots, and writes tuned values back."""
