"""A simulated robot: a world in 2D with laser, odometry and contacts, and a client of the bridge."""
