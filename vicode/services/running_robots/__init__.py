"""Running robots: the connection, what was received of them, and the commands of the console."""
