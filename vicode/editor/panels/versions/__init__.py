"""Earlier versions, comparisons, conflicts and recovered edits."""
