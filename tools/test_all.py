"""Run the tests with every supported Python that this machine has.

    python3 tools/test_all.py [PYTEST ARGUMENT ...]

A Python X.Y counts as there if `pythonX.Y` runs, be it on the search path or in pyenv. Each gets an
environment of its own, `.venv-X.Y`. The last lines name what passed, what failed and what was left
out, and why. Exit code 0 if at least one ran and none failed. Standard library only.
"""

import os
import subprocess
import sys

from environment import NEWEST, OLDEST, ROOT, find


def verdict(version, arguments):
    """Test with one version; its outcome in one word, and what there is to say about it."""
    python = find(version)
    if python is None:
        return "skipped", "no python%d.%d that runs, on the search path or in pyenv" % version
    name = "%d.%d" % version
    folder = ROOT / (".venv-" + name)
    environment = str(ROOT / "tools" / "environment.py")
    made = subprocess.run([sys.executable, environment, "--version", name, folder.name])
    if made.returncode != 0:
        return "failed", "its environment could not be made"
    tests = [str(folder / "bin" / "python"), "-m", "pytest", *arguments]
    environ = dict(os.environ, FASTEROIDS_PROFILE="ci")
    tested = subprocess.run(tests, cwd=str(ROOT), env=environ, stdin=subprocess.DEVNULL)
    if tested.returncode != 0:
        return "failed", "pytest exited with code %d" % tested.returncode
    return "passed", "with %s" % python


def main():
    """Test with each version in turn, then say how each went."""
    outcomes = []
    for version in [(OLDEST[0], minor) for minor in range(OLDEST[1], NEWEST[1] + 1)]:
        print("== Python %d.%d" % version, flush=True)
        outcomes.append((version, *verdict(version, sys.argv[1:] or ["-n", "2"])))
    print("\n== summary")
    for version, outcome, why in outcomes:
        print("Python %d.%d: %s (%s)" % (*version, outcome, why))
    words = [outcome for _, outcome, _ in outcomes]
    sys.exit(0 if "passed" in words and "failed" not in words else 1)


if __name__ == "__main__":
    main()
