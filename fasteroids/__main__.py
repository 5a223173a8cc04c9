"""`python -m fasteroids` is the command line."""

from fasteroids.cli import main

if __name__ == "__main__":
    main(prog_name="fasteroids")
