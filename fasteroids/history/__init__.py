"""Time travel: timelines of kept states, questions to a past, recordings (assignment 1.6 makes it exact).

A world is a value and its future a function of it, so a past state is either kept or lived again, with the same bits.
"""
