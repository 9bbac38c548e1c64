"""Forms of what project.yaml declares."""
