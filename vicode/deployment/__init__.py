"""Copies a runnable program to a folder or a robot: builds its files, and puts them in place."""
