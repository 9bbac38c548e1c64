"""The panel that simulates the open design, and what stands behind it in one window."""
