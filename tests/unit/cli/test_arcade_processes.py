"""The game on a terminal of its own: whatever ends it, the terminal is clean and the recording is on disk."""

from __future__ import annotations

import os
import pty
import re
import shutil
import signal
import subprocess
import sys
import termios
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from fasteroids.history.recording import Recording, read, verified

PATIENCE = 60.0  # s; far more than any of these takes
COLUMNS, ROWS = 80, 24

PLAY = ["-m", "fasteroids", "play", "--seed", "3", "--arena", "ascii", "--no-sound"]

BROKEN = """
import sys
from fasteroids.tui.play import Play
went = Play.go_on
def go_on(self, elapsed):
    went(self, elapsed)
    if self.session.world.time > 1.2:
        raise ZeroDivisionError("the moon is full")
Play.go_on = go_on
from fasteroids.cli import main
main(sys.argv[1:])
"""


class Terminal:
    """A terminal, and a game on it."""

    def __init__(self, home: Path, command: list[str]) -> None:
        self.leader, follower = pty.openpty()
        termios.tcsetwinsize(follower, (ROWS, COLUMNS))
        self.follower = os.dup(follower)
        self.before = termios.tcgetattr(self.follower)
        self.seen = b""
        self.process = subprocess.Popen(
            [sys.executable, *command], stdin=follower, stdout=follower, stderr=follower,
            env=surroundings(home), start_new_session=True, preexec_fn=_controlled,
        )  # fmt: skip
        os.close(follower)

    def read(self, seconds: float = 0.1) -> None:
        """Take what the game writes."""
        from select import select

        while select([self.leader], [], [], seconds)[0]:
            try:
                piece = os.read(self.leader, 65536)
            except OSError:
                return
            if not piece:
                return
            self.seen += piece
            seconds = 0.0

    def until(self, done: Callable[[], bool]) -> None:
        """Wait for something, and take what the game writes meanwhile."""
        deadline = time.monotonic() + PATIENCE
        while not done():
            self.read()
            assert time.monotonic() < deadline, self.seen[-2000:]

    def shows(self, text: str) -> None:
        """Wait until the game writes a text."""
        self.until(lambda: text.encode() in self.seen)

    def ended(self) -> int:
        """Wait for the end; the exit code."""
        self.until(lambda: self.process.poll() is not None)
        self.read()
        return self.process.returncode

    def clean(self) -> None:
        """Is the terminal as it was?"""
        assert termios.tcgetattr(self.follower) == self.before
        for mode in (b"1049", b"25", b"1000", b"1003", b"2004"):  # screen, cursor, mouse, pastes
            settings = re.findall(rb"\x1b\[\?" + mode + rb"([hl])", self.seen)
            assert settings, mode
            assert settings[-1] == (b"h" if mode == b"25" else b"l"), mode
        # Every set of key flags that was pushed is popped (kitty keyboard protocol).
        assert len(re.findall(rb"\x1b\[>\d+u", self.seen)) <= len(re.findall(rb"\x1b\[<\d*u", self.seen))  # fmt: skip

    def close(self) -> None:
        """Leave nothing behind."""
        self.process.kill()
        self.process.wait()
        for handle in (self.leader, self.follower):
            if handle >= 0:
                os.close(handle)


def _controlled() -> None:
    """The terminal is that of the new session: its end is a hang-up."""
    import fcntl

    fcntl.ioctl(0, termios.TIOCSCTTY, 0)


def surroundings(home: Path) -> dict[str, str]:
    """The environment of a game: sizes that other tools were told would count before that of the terminal."""
    inherited = {k: v for k, v in os.environ.items() if k not in ("COLUMNS", "LINES")}
    return {
        **inherited,
        "TERM": "xterm-256color",
        "XDG_DATA_HOME": str(home / "data"),
        "XDG_CONFIG_HOME": str(home / "config"),
    }


@pytest.fixture
def terminal(tmp_path: Path) -> Iterator[Callable[..., Terminal]]:
    """Open a terminal with a game on it."""
    opened: list[Terminal] = []

    def start(*command: str) -> Terminal:
        opened.append(Terminal(tmp_path, list(command or PLAY)))
        return opened[-1]

    yield start
    for each in opened:
        each.close()


def recorded(home: Path) -> Path | None:
    """The recording, once there is something of a game in it."""
    found = list((home / "data" / "fasteroids" / "recordings").glob("*.jsonl"))
    return found[0] if found and found[0].stat().st_size > 1000 else None


def recording(home: Path) -> Recording:
    """The recording, which is lived again with the same bits."""
    place = recorded(home)
    assert place is not None
    found = read(place.read_bytes())
    assert verified(found).difference is None
    return found


def begun(at: Terminal, home: Path) -> None:
    """Begin a game of one player, and play it until something of it is on disk."""
    at.shows("Programs against each other")
    os.write(at.leader, b"\r")
    at.shows("wave 1")
    os.write(at.leader, b" ")
    at.until(lambda: recorded(home) is not None)


def test_esc_and_esc_again_leave(terminal: Any, tmp_path: Path) -> None:
    at = terminal()
    begun(at, tmp_path)
    os.write(at.leader, b"\x1b")
    time.sleep(0.5)  # two together would be something else: Alt and Esc
    os.write(at.leader, b"\x1b")
    assert at.ended() == 0
    at.clean()
    found = recording(tmp_path)
    assert found.short is None
    assert [str(type(each.what).__name__) for each in found.givens].count("Add") == 4


@pytest.mark.parametrize(
    ("number", "code"), [(signal.SIGTERM, 143), (signal.SIGHUP, 129), (signal.SIGINT, 130)]
)
def test_a_signal_ends_a_game_in_order(
    terminal: Any, tmp_path: Path, number: signal.Signals, code: int
) -> None:
    at = terminal()
    begun(at, tmp_path)
    at.process.send_signal(number)
    assert at.ended() == code
    at.clean()
    assert recording(tmp_path).short is None


def test_a_lost_terminal_ends_a_game_in_order(terminal: Any, tmp_path: Path) -> None:
    at = terminal()
    begun(at, tmp_path)
    os.close(at.follower)
    os.close(at.leader)
    at.leader = at.follower = -1
    assert at.process.wait(PATIENCE) != 0
    assert recording(tmp_path).short is None


def test_a_bug_of_ours_leaves_a_clean_terminal_and_says_so(terminal: Any, tmp_path: Path) -> None:
    at = terminal("-c", BROKEN, *PLAY[2:])
    begun(at, tmp_path)
    assert at.ended() == 3
    at.clean()
    after = at.seen[at.seen.rindex(b"\x1b[?1049l") :]
    assert b"the moon is full" in after
    assert b"this is a bug in fasteroids" in after
    assert recording(tmp_path).time > 1.0


def test_what_cannot_be_had_is_told_before_the_screen_changes(
    terminal: Any, tmp_path: Path
) -> None:
    at = terminal(*PLAY, "--ai", "nobody")
    assert at.ended() == 2
    assert at.seen.startswith(b"Error: there is no bot 'nobody'")
    assert b"1049h" not in at.seen


# A program of the system, which no package of Python brings: the script of CI installs it where it may. The other tests
# here play in a pseudo-terminal, which every system has.
@pytest.mark.skipif(shutil.which("tmux") is None, reason="tmux is not installed")
def test_a_game_in_tmux(tmp_path: Path) -> None:
    """A real terminal: keys sent, the screen captured, everything as before at the end."""
    socket = str(tmp_path / "tmux")

    def tmux(*words: str) -> str:
        return subprocess.run(
            ["tmux", "-S", socket, "-f", os.devnull, *words],
            capture_output=True, text=True, check=True, timeout=PATIENCE,
            env={**surroundings(tmp_path), "LC_ALL": "C.UTF-8"},
        ).stdout  # fmt: skip

    def shows(*texts: str, without: str = "\0") -> str:
        """Wait until the screen shows some texts, and another one no more."""
        deadline = time.monotonic() + PATIENCE
        while True:
            screen = tmux("capture-pane", "-p")
            if all(text in screen for text in texts) and without not in screen:
                return screen
            assert time.monotonic() < deadline, screen
            time.sleep(0.05)

    before, after = tmp_path / "before", tmp_path / "after"
    game = f"PYTHONPATH={Path.cwd()} {sys.executable} {' '.join(PLAY)}"
    command = f"stty -g > {before}; {game}; code=$?; stty -g > {after}; echo code $code"
    try:
        tmux("new-session", "-d", "-x", "80", "-y", "24", "env PS1='$ ' sh")
        tmux("send-keys", command, "Enter")
        last = r"|_|/_/   \_\____/ |_| |_____|_| \_\\___/___|____/|____/"
        assert shows(last, "> One player", "Quit").isascii()
        tmux("send-keys", "Enter")
        assert shows("wave 1", "seed 3", "+-----").isascii()
        tmux("send-keys", "Space")
        shows("you ^^^")
        tmux("send-keys", "?")
        shows("pause, or go on")
        tmux("send-keys", "Escape")
        shows("you ^^^", without="pause, or go on")
        tmux("send-keys", "p")
        shows("paused")
        tmux("send-keys", "Home")
        shows("0.00 s")
        tmux("send-keys", "Escape")
        shows("> One player")
        tmux("send-keys", "Escape")
        screen = shows("code 0")
        assert "One player" not in screen  # the other screen is back
        flags = tmux("display-message", "-p", "#{cursor_flag} #{alternate_on} #{mouse_any_flag}")
        assert flags.split() == ["1", "0", "0"]
        assert before.read_text() == after.read_text() != ""
        assert recording(tmp_path).short is None
    finally:
        subprocess.run(["tmux", "-S", socket, "kill-server"], capture_output=True, check=False)
