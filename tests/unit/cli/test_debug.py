"""`fasteroids debug`, as far as it needs no terminal: what it opens, and what it refuses."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from attrs import field, frozen
from click.testing import Result

from fasteroids.cli import _arcade as arcade
from fasteroids.cli._arcade import Screen
from fasteroids.tui.launching import Launched, Recorded, SceneGame
from fasteroids.tui.session import Session

Call = Callable[..., Result]

SCENE = """
[world]
width = 400
height = 200
[[ship]]
name = "red"
x = 60
y = 100
radius = 10
mass = 5e15
program-text = "while (true) { fire; skip; }"
[[ship]]
name = "blue"
x = 200
y = 100
radius = 10
mass = 5e15
"""


@frozen
class Opened:
    """What was shown, each time."""

    found: list[tuple[Launched, Screen]] = field(factory=list)

    @property
    def session(self) -> Session:
        [(begun, _)] = self.found
        return begun.session


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch) -> Opened:
    """A terminal is there, and shows nothing."""
    told = Opened()

    def show(begun: Launched, shown: Screen) -> int:
        told.found.append((begun, shown))
        return 0

    monkeypatch.setattr(arcade, "on_terminal", lambda: True)
    monkeypatch.setattr(arcade, "opened", show)
    return told


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of the last games."""
    monkeypatch.setattr("fasteroids.tui._store.data_folder", lambda: tmp_path / "data")
    folder = tmp_path / "data" / "recordings"
    folder.mkdir(parents=True)
    return folder


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    place = tmp_path / "guns.toml"
    place.write_text(SCENE)
    return place


@pytest.fixture
def recording(call: Call, scene: Path) -> Path:
    place = scene.with_name("game.jsonl")
    assert call("record", str(scene), "--for", "5", "-o", str(place)).exit_code == 0
    return place


def test_a_scene_opens_at_its_beginning_in_a_pause(call: Call, opened: Opened, scene: Path) -> None:
    assert call("debug", str(scene), "--arena", "ascii").exit_code == 0
    [(begun, shown)] = opened.found
    assert isinstance(begun.wanted, SceneGame)
    session = begun.session
    assert (session.world.time, session.running, session.selected) == (0.0, 0, 1)
    assert session.live
    assert shown.arena == "ascii"


def test_a_scene_lives_up_to_a_time(call: Call, opened: Opened, scene: Path) -> None:
    assert call("debug", str(scene), "--at", "1.5", "--ship", "blue").exit_code == 0
    assert opened.session.timeline.world.time == 1.5
    assert opened.session.selected == 2


def test_a_recording_opens_at_its_end(call: Call, opened: Opened, recording: Path) -> None:
    assert call("debug", str(recording)).exit_code == 0
    [(begun, _)] = opened.found
    assert begun.wanted == Recorded(recording)
    assert begun.session.place == begun.session.timeline.last.place
    assert begun.session.selected == 1


def test_a_recording_opens_where_the_ship_is_about_to_die(
    call: Call, opened: Opened, recording: Path
) -> None:
    assert call("debug", str(recording), "--ship", "blue").exit_code == 0
    session = opened.session
    assert session.selected == 2
    assert 2 in session.world
    after = next(session.timeline.forwards(session.place))
    assert 2 in after.died


def test_a_recording_of_the_list_is_meant_by_its_number(
    call: Call, opened: Opened, recording: Path, home: Path
) -> None:
    kept = home / "20300101-000000.fast.jsonl"
    kept.write_bytes(recording.read_bytes())
    assert call("debug", "1", "--at", "2").exit_code == 0
    [(begun, _)] = opened.found
    assert begun.wanted == Recorded(kept)
    assert begun.session.world.time == 2.0


@pytest.mark.parametrize(
    ("args", "told"),
    [
        (["nowhere"], "there is no scene 'nowhere'"),
        (["{recording}", "--at", "9"], "this recording goes from 0.0 s to 5.0 s; there is no 9.0 s in it"),
        (["{recording}", "--ship", "bleu"], "there is no ship 'bleu' (did you mean 'blue'?); there are red, blue"),
        (["{scene}", "--ship", "7"], "there is no ship '7'"),
        (["pilot", "--ship", "nobody"], "there is no ship 'nobody'; there is pilot"),
        (["{broken}"], "cannot be read"),
        (["{recording}", "--seed", "3"], "--bots, --seed and --model are for scenes"),
        (["-"], "standard input has the keys"),
        (["{scene}", "--at", "-1"], "a finite number of seconds"),
    ],
)  # fmt: skip
def test_what_cannot_be_had_is_told(
    call: Call, opened: Opened, scene: Path, recording: Path, home: Path, args: list[str], told: str
) -> None:
    broken = scene.with_name("broken.jsonl")
    broken.write_text('{"format": ')
    assert home.is_dir()
    given = [each.format(scene=scene, recording=recording, broken=broken) for each in args]
    shown = call("debug", *given)
    assert shown.exit_code == 2
    assert told in " ".join(shown.stderr.split())
    assert opened.found == []


def test_without_a_terminal_nothing_is_lived(call: Call, scene: Path) -> None:
    shown = call("debug", str(scene), "--at", "1e9")
    assert shown.exit_code == 2
    assert "there is no terminal" in shown.stderr
