"""The game in a browser: the page that is served, and a game over its socket, as the page plays it."""

from __future__ import annotations

import asyncio
import os
import signal
import socket
import subprocess
import sys
from pathlib import Path

import aiohttp

from fasteroids.history.recording import read

PATIENCE = 60.0  # s; far more than any of these takes


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
        return port


async def played(port: int) -> tuple[str, bytes]:
    """The page, and what a game writes that is begun by Enter on the start screen."""
    address = f"http://127.0.0.1:{port}"
    seen = b""
    async with aiohttp.ClientSession() as session:
        while True:
            try:
                async with session.get(address) as answer:
                    page: str = await answer.text()
                break
            except aiohttp.ClientConnectionError:
                await asyncio.sleep(0.05)
        async with session.ws_connect(f"{address}/ws?width=80&height=24") as ws:
            begun = False
            async for message in ws:
                if message.type == aiohttp.WSMsgType.BINARY:
                    seen += message.data
                if b"Quit" in seen and not begun:
                    begun = True
                    await ws.send_json(["stdin", "\r"])
                if b"wave 1" in seen:
                    break
    return page, seen


async def recorded(home: Path) -> Path:
    """The recording of a game, once it came to its end."""
    while True:
        found = list((home / "fasteroids" / "recordings").glob("*.jsonl"))
        if found and b'"type":"result"' in found[0].read_bytes():
            return found[0]
        await asyncio.sleep(0.05)


def test_a_page_plays_a_game(tmp_path: Path) -> None:
    port = free_port()
    process = subprocess.Popen(
        [sys.executable, "-m", "fasteroids", "serve", "--port", str(port), "--seed", "3", "--arena", "ascii"],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL,
        env={**os.environ, "XDG_DATA_HOME": str(tmp_path), "XDG_CONFIG_HOME": str(tmp_path)},
    )  # fmt: skip
    try:
        page, seen = asyncio.run(asyncio.wait_for(played(port), PATIENCE))
        assert f'data-session-websocket-url="ws://127.0.0.1:{port}/ws"' in page
        assert b"One player" in seen
        ended = asyncio.run(asyncio.wait_for(recorded(tmp_path), PATIENCE))
        assert read(ended.read_bytes()).short is None  # the page is left: so is the game
        process.send_signal(signal.SIGINT)
        assert process.wait(PATIENCE) == 0
    finally:
        process.kill()
        process.wait()
