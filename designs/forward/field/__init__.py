"""A small simulated football field and the hand-written components that sense and act on it.

Millimetres, degrees and seconds everywhere; x points to the opponent's goal, y to the left, angles grow to the left.
"""
