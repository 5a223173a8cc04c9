"""The language server of the ship language: what an editor asks, answered from a text and a place in it.

    positions    lines and columns as editors count them
    reading      a text read once: its tree, its tokens, its variables, what is wrong with it
    hovering     what the word or sign at a place means, and the type of an expression
    completing   what could be written at a place
    navigating   where a variable is declared and used; other names for it
    mending      fixes, and the normal form

These are functions of values, total for any text and any place. The shell around them speaks the protocol, with a
library that is an extra, `fasteroids[lsp]`; nothing else knows it:

    wire         their values in the words of the protocol
    session      the texts that an editor has open
    server       what is answered to what, over standard input and output
"""
