"""Starts programs, waits for what they do, and ends only what it started. Everything here is on loopback, in a
network namespace that the test run made for itself, so that the peers' fixed ports and open listeners harm nobody.

Waiting is always for a condition; the deadline below only says when to give up.
"""
import os
import pathlib
import queue
import re
import shutil
import socket
import struct
import subprocess
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
VAGUS = os.environ.get("VAGUS_BIN", str(ROOT / "build/release/bin/vagus"))
GIVE_UP_AFTER = 60.0


class Missing(Exception):
    """What was waited for did not come."""


class Program:
    """A running program whose output is read line by line. Use it in a with statement."""

    def __init__(self, *arguments, env=None, cwd=None):
        self.arguments = [str(argument) for argument in arguments]
        self.lines = []
        self._queue = queue.Queue()
        self.process = subprocess.Popen(self.arguments, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                        errors="replace", stdin=subprocess.DEVNULL, cwd=cwd,
                                        env={**os.environ, **(env or {})})
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        for line in self.process.stdout:
            self._queue.put(line.rstrip("\n"))
        self._queue.put(None)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()

    def wait_line(self, pattern):
        """The match of the next line in which the pattern is found."""
        deadline = time.monotonic() + GIVE_UP_AFTER
        while True:
            try:
                line = self._queue.get(timeout=max(0.0, deadline - time.monotonic()))
            except queue.Empty:
                line = None
            if line is None:
                raise Missing(f"{self.arguments[0]} never printed {pattern!r}; it said:\n" + "\n".join(self.lines))
            self.lines.append(line)
            found = re.search(pattern, line)
            if found:
                return found

    def wait_end(self):
        """The exit status, all output read."""
        status = self.process.wait(timeout=GIVE_UP_AFTER)
        while (line := self._queue.get(timeout=GIVE_UP_AFTER)) is not None:
            self.lines.append(line)
        return status

    def running(self):
        return self.process.poll() is None

    def stop(self):
        if not self.running():
            return
        self.process.terminate()
        try:
            self.process.wait(timeout=5)
        except subprocess.TimeoutExpired:
            self.kill()

    def kill(self):
        self.process.kill()
        self.process.wait()


def listening(program):
    """The port of a Vagus program: the first line it prints."""
    return int(program.wait_line(r"^listening tcp:127\.0\.0\.1:(\d+)$").group(1))


def vagus(*arguments):
    return Program(VAGUS, *arguments)


def run_vagus(*arguments, status=0):
    """Runs to the end; gives what it printed on stdout and stderr together."""
    with vagus(*arguments) as program:
        found = program.wait_end()
        text = "\n".join(program.lines)
        assert found == status, f"vagus {' '.join(map(str, arguments))} ended with {found}, not {status}:\n{text}"
        return text


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def connect(port):
    """A TCP connection, as soon as somebody listens there."""
    deadline = time.monotonic() + GIVE_UP_AFTER
    while True:
        try:
            return socket.create_connection(("127.0.0.1", port), timeout=GIVE_UP_AFTER)
        except ConnectionRefusedError:
            if time.monotonic() > deadline:
                raise Missing(f"nobody listens on port {port}") from None
            time.sleep(0.02)


class Bus:
    """A raw participant of the Aseba network: sends and sees frames (docs/spec/aseba-wire-and-vm.md, section 1.1)."""

    def __init__(self, port):
        self.socket = connect(port)
        self.bytes = b""

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()

    def leave(self):
        """Goes, and returns when the peer knows: asebaplayground dies of a client that comes before."""
        self.socket.shutdown(socket.SHUT_WR)
        self.socket.settimeout(GIVE_UP_AFTER)
        while self.socket.recv(65536):
            pass
        self.socket.close()

    def send(self, source, kind, *words):
        payload = struct.pack(f"<{len(words)}H", *(word & 0xFFFF for word in words))
        self.socket.sendall(struct.pack("<HHH", len(payload), source, kind) + payload)

    def read(self):
        """The next frame: source, type, payload."""
        while len(self.bytes) < 6 or len(self.bytes) < 6 + struct.unpack_from("<H", self.bytes)[0]:
            more = self.socket.recv(65536)
            if not more:
                raise Missing("the bus was closed")
            self.bytes += more
        size, source, kind = struct.unpack_from("<HHH", self.bytes)
        payload, self.bytes = self.bytes[6:6 + size], self.bytes[6 + size:]
        return source, kind, payload

    def wait(self, kind, source=None):
        """The payload of the next frame of that type (and source)."""
        deadline = time.monotonic() + GIVE_UP_AFTER
        seen = []
        while time.monotonic() < deadline:
            self.socket.settimeout(max(0.01, deadline - time.monotonic()))
            try:
                frame = self.read()
            except TimeoutError:
                break
            if frame[1] == kind and source in (None, frame[0]):
                return frame[2]
            seen.append(f"{frame[1]:04x}")
        raise Missing(f"no frame of type {kind:04x} came; there were {seen[-20:]}")


class Display:
    """A virtual screen; .env sends programs to it."""

    def __enter__(self):
        read, write = os.pipe()
        self.process = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x900x24", "-nolisten", "tcp"],
                                        pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        number = b""
        while not number.endswith(b"\n"):
            more = os.read(read, 16)
            if not more:
                raise Missing("Xvfb did not start")
            number += more
        os.close(read)
        self.home = tempfile.mkdtemp(prefix="vagus-home-")
        self.name = f":{number.decode().strip()}"
        self.env = {"DISPLAY": self.name, "HOME": self.home, "XDG_RUNTIME_DIR": self.home, "LC_ALL": "C.UTF-8",
                    "LIBGL_ALWAYS_SOFTWARE": "1"}
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()
        shutil.rmtree(self.home, ignore_errors=True)

    def screenshot(self, path):
        """Keeps a picture where ImageMagick is installed; what counts is what the frames say."""
        if shutil.which("import"):
            subprocess.run(["import", "-display", self.name, "-window", "root", str(path)], check=False)


PLAYGROUND = """<!DOCTYPE aseba-playground>
<aseba-playground>
<color name="wall" r="0.9" g="0.9" b="0.9"/>
<world w="100" h="100" color="wall"/>
<wall x="50" y="80" l1="30" l2="2" h="10" color="wall"/>
{robots}
</aseba-playground>
"""


def playground(display, folder, ports):
    """asebaplayground with a Thymio II of node id 1, 2 … at each port."""
    robots = "\n".join(f'<robot type="thymio2" x="{30 + 25 * i}" y="50" angle="0" port="{port}" name="t{i + 1}" nodeId="{i + 1}"/>'
                       for i, port in enumerate(ports))
    scenario = pathlib.Path(folder) / "arena.playground"
    scenario.write_text(PLAYGROUND.format(robots=robots), encoding="utf-8")
    return Program("asebaplayground", scenario, env=display.env)
