"""The terminal arena: play, watch, rewind (assignment section 3).

What is shown and what a key means is pure and knows no terminal: `session`, `game`, `camera`, `keys` and what they use.
The shell that knows Textual shows frames, reads keys and tells the time.
"""
