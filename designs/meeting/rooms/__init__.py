"""Where the robots meet: their world, and how they drive to a point."""
