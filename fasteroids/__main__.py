"""`python -m fasteroids` is the command line."""

from fasteroids.cli import main

main(prog_name="fasteroids")
