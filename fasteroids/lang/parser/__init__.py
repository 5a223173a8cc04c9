"""From text to a tree, with every syntax error of the text: `lexer` and `_braces`, then `_parser` and its halves."""

from fasteroids.lang.parser._parser import Parsed as Parsed
from fasteroids.lang.parser._parser import decoded as decoded
from fasteroids.lang.parser._parser import parse_bytes as parse_bytes
from fasteroids.lang.parser._parser import parse_program as parse_program

__all__ = [
    "Parsed",
    "decoded",
    "parse_bytes",
    "parse_program",
]
