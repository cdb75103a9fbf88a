"""Starts programs, waits for what they do, and ends only what it started. Everything here is on loopback, in a
network namespace that the test run made for itself, so that the peers' fixed ports and open listeners harm nobody.

Waiting is always for a condition; the deadline below only says when to give up.
"""
import json
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
GIVE_UP_AFTER = float(os.environ.get("VAGUS_GIVE_UP_AFTER", 60))
ASK_AGAIN_AFTER = 0.1

# Types of messages, section 2 of docs/spec/aseba-wire-and-vm.md.
DESCRIPTION, NAMED_VARIABLE, LOCAL_EVENT, NATIVE_FUNCTION = 0x9000, 0x9001, 0x9002, 0x9003
DISCONNECTED, VARIABLES, STATE, BREAKPOINT_SET_RESULT, NODE_PRESENT = 0x9004, 0x9005, 0x900A, 0x900B, 0x900C
SET_BYTECODE, RESET, RUN, PAUSE, STOP, GET_EXECUTION_STATE = 0xA001, 0xA002, 0xA003, 0xA004, 0xA006, 0xA007
BREAKPOINT_SET, GET_VARIABLES = 0xA008, 0xA00B
GET_NODE_DESCRIPTION, LIST_NODES = 0xA010, 0xA011


class Missing(Exception):
    """What was waited for did not come."""


class Program:
    """A running program whose output is read line by line. Use it in a with statement."""

    def __init__(self, *arguments, env=None, cwd=None, typing=False, stderr=subprocess.STDOUT):
        self.arguments = [str(argument) for argument in arguments]
        self.lines = []
        self._queue = queue.Queue()
        self.process = subprocess.Popen(self.arguments, stdout=subprocess.PIPE, stderr=stderr, text=True,
                                        errors="replace", stdin=subprocess.PIPE if typing else subprocess.DEVNULL, cwd=cwd,
                                        env={**os.environ, **(env or {})})
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self.process.stdout:
            self._queue.put(line.rstrip("\n"))
        self._queue.put(None)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()
        if self.process.stdin:
            self.process.stdin.close()
        self._reader.join(timeout=5)  # whatever it started may hold its output open for longer
        if not self._reader.is_alive():
            self.process.stdout.close()

    def signal(self, number):
        self.process.send_signal(number)

    def type(self, line):
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def drain(self):
        """What it has printed by now counts as read."""
        while not self._queue.empty():
            line = self._queue.get()
            if line is None:
                self._queue.put(None)
                return
            self.lines.append(line)

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

    def wait_lines(self, *patterns):
        """Until each pattern was found, in whatever order."""
        missing = list(patterns)
        while missing:
            line = self.wait_line("|".join(f"(?:{pattern})" for pattern in missing)).string
            missing = [pattern for pattern in missing if not re.search(pattern, line)]

    def wait_end(self, within=GIVE_UP_AFTER):
        """The exit status, all output read."""
        status = self.process.wait(timeout=within)
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


def vagus(*arguments, **options):
    return Program(VAGUS, *arguments, **options)


def run_vagus(*arguments, status=0):
    """Runs to the end; gives what it printed on stdout and stderr together."""
    with vagus(*arguments) as program:
        found = program.wait_end()
        text = "\n".join(program.lines)
        assert found == status, f"vagus {' '.join(map(str, arguments))} ended with {found}, not {status}:\n{text}"
        return text


def patiently():
    """Turns of a loop that asks until it is told what it wants to hear, until GIVE_UP_AFTER."""
    deadline = time.monotonic() + GIVE_UP_AFTER
    while time.monotonic() < deadline:
        yield
        time.sleep(ASK_AGAIN_AFTER)


def wait_until(what, is_so):
    """Asks until it is so; `what` says what is wrong if it never is."""
    for _ in patiently():
        if is_so():
            return
    raise Missing(what)


def list_nodes(port):
    """What `vagus net list --json` prints. It ends with 1 if nobody is there."""
    with vagus("net", f"tcp:127.0.0.1:{port}", "list", "--json") as program:
        status = program.wait_end()
        text = "\n".join(program.lines)
    # Every node of every test that lists nodes so has an id of its own, however busy the machine is.
    assert "two nodes have the id" not in text, text
    if "[" not in text:  # nobody to ask, yet
        return []
    nodes = json.JSONDecoder().raw_decode(text[text.index("["):])[0]  # words for people follow
    assert status == (0 if nodes else 1), f"vagus net list ended with {status}:\n{text}"
    return nodes


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

    def ask(self, again, kind, source=None):
        """Calls `again` until a frame of that type (and source) comes, which it gives. For peers that do not say when
        they are there: what was sent before they were has gone."""
        deadline = time.monotonic() + GIVE_UP_AFTER
        while time.monotonic() < deadline:
            again()
            self.socket.settimeout(ASK_AGAIN_AFTER)
            try:
                while True:
                    frame = self.read()
                    if frame[1] == kind and source in (None, frame[0]):
                        return frame[2]
            except TimeoutError:
                continue
        raise Missing(f"no frame of type {kind:04x} came, however often it was asked for")

    def description(self, source):
        """What the node says of itself, from Description to its last native function: (header, items by type)."""
        name, rest = text_at(self.wait(DESCRIPTION, source))
        protocol, bytecode, stack, variables, *counts = struct.unpack("<7H", rest)
        items = {}
        for kind, count in zip((NAMED_VARIABLE, LOCAL_EVENT, NATIVE_FUNCTION), counts):
            items[kind] = [self.wait(kind, source) for _ in range(count)]
        return (name, protocol, bytecode, stack, variables), items


def text_at(payload):
    """A string of section 2, and what follows it."""
    return payload[1:1 + payload[0]].decode(), payload[1 + payload[0]:]


def variable_names(items):
    return [text_at(payload[2:])[0] for payload in items[NAMED_VARIABLE]]


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


def playground(display, folder, ports, ids, kind="thymio2"):
    """asebaplayground with robots of that kind, of these node ids, at these ports."""
    robots = "\n".join(f'<robot type="{kind}" x="{30 + 25 * i}" y="50" angle="0" port="{port}" name="t{i + 1}" nodeId="{ids[i]}"/>'
                       for i, port in enumerate(ports))
    scenario = pathlib.Path(folder) / "arena.playground"
    scenario.write_text(PLAYGROUND.format(robots=robots), encoding="utf-8")
    return Program("asebaplayground", scenario, env=display.env)


def foreign_switch(start, *targets):
    """asebaswitch; gives its port, somebody listens there. `start` begins a program, and ends it with the test."""
    port = free_port()
    start(Program("asebaswitch", "-p", port, *targets))
    Bus(port).leave()
    return port


def simulated(folder, *robots, listen="tcp:127.0.0.1:0", options=()):
    """vagus sim with these robots (as in a world file); its bus is where it listens."""
    world = {"format": "vagus-world/1", "size": [2, 1.5],
             "robots": [{"type": "thymio2", "at": [0.4 + 0.4 * i, 0.7], **robot} for i, robot in enumerate(robots)]}
    path = pathlib.Path(folder) / "arena.world.json"
    path.write_text(json.dumps(world), encoding="utf-8")
    return vagus("sim", path, "--headless", "--duration", 3600, "--listen", listen, *options)
