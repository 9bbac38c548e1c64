"""What both faces do with a project: use cases that combine several packages."""
