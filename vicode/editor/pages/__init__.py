"""The pages of the editor and their look."""
