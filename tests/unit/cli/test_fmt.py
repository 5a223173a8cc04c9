"""`fasteroids fmt`: ship programs in their one normal form."""

from __future__ import annotations

import os
import stat
from collections.abc import Callable
from pathlib import Path
from threading import Thread

import pytest
from click.testing import Result

from fasteroids.cli.check import MOST_SHOWN

Call = Callable[..., Result]

NORMAL = "fire;  // é\n"
ODD = "fire // é\r\n;turn(1);"
MENDED = "// é\nfire;\nturn 1;\n"
WRONG = "fire"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder to be in, with programs that are in normal form, not in it, and wrong."""
    for name, text in (("normal", NORMAL), ("odd", ODD), ("wrong", WRONG)):
        (tmp_path / f"{name}.ast").write_bytes(text.encode())
    monkeypatch.chdir(tmp_path)
    return tmp_path


def held(name: str) -> str:
    """What is in a file, its line ends as they are."""
    return Path(name).read_bytes().decode()


def test_a_file_is_rewritten_and_only_if_it_changes(call: Call, folder: Path) -> None:
    before = Path("normal.ast").stat()
    shown = call("fmt", "normal.ast", "odd.ast")
    assert (shown.exit_code, shown.stdout, shown.stderr) == (0, "", "odd.ast: changed\n")
    assert held("odd.ast") == MENDED
    assert Path("normal.ast").stat() == before
    assert call("fmt", "odd.ast").stderr == ""


def test_permissions_and_links_stay(call: Call, folder: Path) -> None:
    Path("odd.ast").chmod(0o640)
    Path("link.ast").symlink_to("odd.ast")
    assert call("fmt", "link.ast").exit_code == 0
    assert Path("link.ast").is_symlink()
    assert held("odd.ast") == MENDED
    assert stat.S_IMODE(Path("odd.ast").stat().st_mode) == 0o640
    assert sorted(path.name for path in folder.iterdir()) == [
        "link.ast",
        "normal.ast",
        "odd.ast",
        "wrong.ast",
    ]


@pytest.mark.parametrize(
    ("text", "new"), [(ODD, MENDED), (NORMAL, NORMAL), ("", ""), ("//c", "//c\n"), (";\n", "")]
)
def test_standard_input_goes_to_standard_output(
    call: Call, folder: Path, text: str, new: str
) -> None:
    shown = call("fmt", "-", input=text.encode())
    assert (shown.exit_code, shown.stdout_bytes.decode(), shown.stderr) == (0, new, "")


def test_check_names_what_would_change_and_writes_nothing(call: Call, folder: Path) -> None:
    shown = call("fmt", "--check", "normal.ast", "odd.ast", "-", input="skip")
    assert (shown.exit_code, shown.stdout, shown.stderr) == (1, "odd.ast\n-\n", "")
    assert held("odd.ast") == ODD
    shown = call("fmt", "--check", "normal.ast")
    assert (shown.exit_code, shown.stdout, shown.stderr) == (0, "", "")


@pytest.mark.parametrize("options", [["--diff"], ["--check", "--diff"]])
def test_diff_shows_what_would_change_and_writes_nothing(
    call: Call, folder: Path, options: list[str]
) -> None:
    shown = call("fmt", *options, "normal.ast", "odd.ast")
    assert shown.exit_code == 1
    assert shown.stderr == ""
    assert shown.stdout_bytes.decode() == (
        "--- odd.ast\n+++ odd.ast\n@@ -1,2 +1,3 @@\n"
        "-fire // é\r\n-;turn(1);\n\\ No newline at end of file\n+// é\n+fire;\n+turn 1;\n"
    )
    assert held("odd.ast") == ODD
    shown = call("fmt", *options, "normal.ast")
    assert (shown.exit_code, shown.stdout, shown.stderr) == (0, "", "")


@pytest.mark.parametrize("data", [b"\xef\xbb\xbffire;\n", b"fire;\r\n", b"fire;", b"fire;\n\n"])
def test_marks_and_line_ends_are_differences(call: Call, folder: Path, data: bytes) -> None:
    Path("odd.ast").write_bytes(data)
    assert call("fmt", "--check", "odd.ast").exit_code == 1
    assert "+fire;\n" in call("fmt", "--diff", "odd.ast").stdout or data.endswith(b"\n\n")
    assert call("fmt", "odd.ast").exit_code == 0
    assert held("odd.ast") == "fire;\n"


@pytest.mark.parametrize("options", [[], ["--check"], ["--diff"]])
def test_a_wrong_program_is_left_alone_and_the_others_are_done(
    call: Call, folder: Path, options: list[str]
) -> None:
    shown = call("fmt", *options, "wrong.ast", "none.ast", "odd.ast")
    assert shown.exit_code == 2
    assert shown.stderr.startswith("wrong.ast:1:5: error FA0")
    assert "\n1 error in wrong.ast: left as it is\nError: cannot read 'none.ast': " in shown.stderr
    assert held("wrong.ast") == WRONG
    assert held("odd.ast") == (ODD if options else MENDED)
    assert ("odd.ast" in shown.stdout) == bool(options)


def test_only_syntax_errors_matter(call: Call, folder: Path) -> None:
    shown = call("fmt", "-", input="turn(true)  ;")
    assert (shown.exit_code, shown.stdout) == (0, "turn true;\n")


def test_a_wrong_program_from_standard_input_gives_no_output(call: Call, folder: Path) -> None:
    shown = call("fmt", "-", input="fire")
    assert (shown.exit_code, shown.stdout) == (2, "")
    assert "1 error in standard input" in shown.stderr


def test_people_see_the_first_errors_and_how_many_more_there_are(call: Call, folder: Path) -> None:
    Path("wrong.ast").write_text("turn ;\n" * (MOST_SHOWN + 3))
    said = call("fmt", "wrong.ast").stderr
    assert said.count(": error FA") == MOST_SHOWN
    assert said.endswith(
        f"\n{MOST_SHOWN + 3} errors in wrong.ast; 3 more than are shown: left as it is\n"
    )


def test_bytes_that_are_no_text_are_left_alone(call: Call, folder: Path) -> None:
    Path("wrong.ast").write_bytes(b"fire; // \xff\n")
    shown = call("fmt", "wrong.ast")
    assert shown.exit_code == 2
    assert "error FA002" in shown.stderr
    assert Path("wrong.ast").read_bytes() == b"fire; // \xff\n"


def test_what_may_not_be_written_stays(
    call: Call, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("os.access", lambda *_, **__: False)
    shown = call("fmt", "odd.ast")
    assert shown.exit_code == 2
    assert shown.stderr == "Error: cannot write 'odd.ast': permission denied\n"
    assert held("odd.ast") == ODD


def test_what_is_no_plain_file_is_not_written(call: Call, folder: Path) -> None:
    os.mkfifo("pipe.ast")
    writer = Thread(target=Path("pipe.ast").write_text, args=[ODD])
    writer.start()
    shown = call("fmt", "pipe.ast")
    writer.join()
    assert shown.exit_code == 2
    assert shown.stderr == "Error: cannot write 'pipe.ast': it is no plain file\n"
