"""The language server of the ship language: what an editor asks, answered from a text and a place in it.

    positions    lines and columns as editors count them
    reading      a text read once: its tree, its tokens, its variables, what is wrong with it
    hovering     what the word or sign at a place means, and the type of an expression
    completing   what could be written at a place
    navigating   where a variable is declared and used; other names for it
    mending      fixes, and the normal form
    server       the shell: the protocol, over standard input and output

All but the last are functions of values, total for any text and any place. Only `server` and `wire`, which puts their
values into the protocol's words, know the library that speaks it; it is an extra, `fasteroids[lsp]`.
"""
