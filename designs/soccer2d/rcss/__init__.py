"""A player of the RoboCup 2D soccer simulator: messages, position on the field, and the client."""
