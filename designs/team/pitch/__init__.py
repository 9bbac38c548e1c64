"""A pitch for two teams of small robots: physics, team messages, and what each robot sees."""
