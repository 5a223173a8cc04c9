"""Make a virtual environment with what `requirements.lock` names and this project in it.

    python3 tools/environment.py [--version X.Y] [FOLDER]

Standard library only, and plain enough for any Python 3.7: it runs before anything is installed,
perhaps with a Python too old for the project, and then finds a newer one. FOLDER is `.venv` unless
given. Two calls of pip: the lock with its hashes, then the project, editable, from what is there.

Two stamp files, each written after its step, hold a digest of what that step was made from. So an
environment that is half made, whose lock changed, that was moved or copied, or whose interpreter is
gone is made again from nothing; a changed `pyproject.toml` only installs the project again.
"""

import argparse
import hashlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

OLDEST = (3, 11)
NEWEST = (3, 13)
ROOT = Path(__file__).resolve().parent.parent
LOCK = ROOT / "requirements.lock"
PROJECT = ROOT / "pyproject.toml"


def answers(python):
    """The (major, minor) that this command says it is, or None if it does not run."""
    ask = [str(python), "-c", "import sys; print('%d.%d' % sys.version_info[:2])"]
    try:
        said = subprocess.check_output(ask, stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return tuple(int(part) for part in said.decode().split("."))
    except (OSError, ValueError, subprocess.CalledProcessError):
        return None


def find(version):
    """A command that runs Python `version`, from the search path or from pyenv; or None."""
    name = "python%d.%d" % version
    pyenv = Path(os.environ.get("PYENV_ROOT") or Path.home() / ".pyenv")
    candidates = [name, *sorted(pyenv.glob("versions/*/bin/" + name), reverse=True)]
    if version == sys.version_info[:2]:
        candidates.insert(0, sys.executable)
    return next((str(python) for python in candidates if answers(python) == version), None)


def choose():
    """The Python to use when none was asked for: this one, or else the newest supported one."""
    if sys.version_info[:2] >= OLDEST:
        return sys.executable
    newest_first = [(OLDEST[0], minor) for minor in range(NEWEST[1], OLDEST[1] - 1, -1)]
    return next(filter(None, map(find, newest_first)), None)


def digest(folder, *files):
    """What an installation depends on: the place it is in and the bytes of `files`."""
    total = hashlib.sha256(str(folder).encode())
    for file in files:
        total.update(file.read_bytes())
    return total.hexdigest()


def holds(stamp, wanted):
    """Whether the step that leaves this stamp was finished, from the same sources."""
    return stamp.is_file() and stamp.read_text().strip() == wanted


def run(*command):
    """Run a command that is silent unless it fails; its failure is ours."""
    environ = dict(os.environ, PIP_DISABLE_PIP_VERSION_CHECK="1")
    environ.pop("PYTHONPATH", None)
    done = subprocess.run(
        [str(part) for part in command],
        cwd=str(ROOT),
        env=environ,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    if done.returncode != 0:
        sys.stderr.write(done.stdout.decode(errors="replace"))
        sys.exit("could not make the environment; failed: " + " ".join(map(str, command)))


def make(folder, version=None):
    """Bring the environment in `folder` up to date; return at once if it is."""
    folder = ROOT / folder
    python = folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    locked, installed = folder / ".locked", folder / ".installed"
    lock, project = digest(folder, LOCK), digest(folder, LOCK, PROJECT)

    has = answers(python)
    right = has is not None and (has == version if version else has >= OLDEST)
    if right and holds(installed, project):
        return
    if not (right and holds(locked, lock)):
        base = find(version) if version else choose()
        if base is None:
            wanted = "%d.%d" % (version or OLDEST) + ("" if version else " or newer")
            sys.exit("Fasteroids needs Python %s; found none on the path or in pyenv." % wanted)
        print("making %s with %s ..." % (folder.name, base), file=sys.stderr, flush=True)
        if folder.exists():
            shutil.rmtree(str(folder))
        run(base, "-m", "venv", folder)
        run(python, "-m", "pip", "install", "--quiet", "--require-hashes", "-r", LOCK.name)
        locked.write_text(lock + "\n")
    run(python, "-m", "pip", "install", "--quiet", "--no-deps", "--no-build-isolation", "-e", ".")
    installed.write_text(project + "\n")


def main():
    """Read the command line and obey it."""
    parser = argparse.ArgumentParser(description="Make or repair a virtual environment.")
    parser.add_argument("folder", nargs="?", default=".venv", help="by default .venv")
    parser.add_argument("--version", metavar="X.Y", help="by default this Python, or a newer one")
    options = parser.parse_args()
    version = tuple(int(part) for part in options.version.split(".")) if options.version else None
    make(options.folder, version)


if __name__ == "__main__":
    main()
