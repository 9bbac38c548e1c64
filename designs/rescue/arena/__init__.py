"""Where the rescue robot drives: a corridor with walls that its laser sees."""
