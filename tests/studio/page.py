"""A page of the studio without a browser, and the server behind it: docs/protocol.md over a WebSocket of its own, so that a
test can also send what no library would, and read as slowly as it likes.

    with Studio() as studio, studio.page() as page:
        page.do("project.open", path=folder)
        clock = page.watch("clock")
        page.wait(lambda: clock.value["t"] > 1)
"""
import base64
import json
import math
import os
import pathlib
import re
import socket
import struct
import sys
import tempfile
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import GIVE_UP_AFTER, Missing, vagus
from protocol import COMMANDS, LIMITS, TOPICS, fault, fault_of_answer, fault_of_document

TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10


class Refused(Exception):
    """A command was answered by an error."""

    def __init__(self, problem):
        super().__init__(f"{problem['code']}: {problem['what']}")
        self.code, self.what, self.place = problem["code"], problem["what"], problem.get("place", "")


class Closed(Exception):
    """The other end has said goodbye, or is gone."""


# ---- bytes -------------------------------------------------------------------------------------


def frame(kind, payload, final=True, mask=b"\0\0\0\0"):
    """RFC 6455, 5.2, as a client sends it: masked, here by zeros, which change nothing."""
    size = len(payload)
    head = bytes([(0x80 if final else 0) | kind])
    if size < 126:
        head += bytes([0x80 | size])
    elif size < 65536:
        head += b"\xfe" + struct.pack(">H", size)
    else:
        head += b"\xff" + struct.pack(">Q", size)
    return head + mask + payload


def ask_for_live(port, headers=None, target="/live"):
    lines = {"Host": f"127.0.0.1:{port}", "Upgrade": "websocket", "Connection": "Upgrade",
             "Sec-WebSocket-Key": base64.b64encode(os.urandom(16)).decode(), "Sec-WebSocket-Version": "13",
             "Sec-WebSocket-Protocol": "vagus-1", "Origin": f"http://127.0.0.1:{port}", **(headers or {})}
    asked = f"GET {target} HTTP/1.1\r\n" + "".join(f"{name}: {value}\r\n" for name, value in lines.items() if value is not None)
    return (asked + "\r\n").encode()


class Wire:
    """A TCP connection that is read exactly, with a deadline."""

    begun = (0, b"")  # the pieces of a message that are there

    def __init__(self, port, small_window=False):
        self.socket = socket.socket()
        if small_window:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        self.socket.settimeout(GIVE_UP_AFTER)
        self.socket.connect(("127.0.0.1", port))
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.bytes = bytearray()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        self.socket.close()

    def send(self, data):
        self.socket.sendall(data)

    def read(self, size):
        while len(self.bytes) < size:
            try:
                more = self.socket.recv(1 << 16)
            except OSError as failed:
                raise Closed(str(failed)) from None
            if not more:
                raise Closed("the connection has ended")
            self.bytes += more
        taken = bytes(self.bytes[:size])
        del self.bytes[:size]
        return taken

    def read_head(self):
        """Of an HTTP answer: status and headers."""
        while b"\r\n\r\n" not in self.bytes:
            more = self.socket.recv(1 << 16)
            if not more:
                raise Closed("the connection has ended")
            self.bytes += more
        head, _, rest = bytes(self.bytes).partition(b"\r\n\r\n")
        self.bytes = bytearray(rest)
        first, *lines = head.decode("latin-1").split("\r\n")
        headers = dict(line.split(": ", 1) for line in lines)
        return int(first.split()[1]), {name.lower(): value for name, value in headers.items()}

    def read_answer(self):
        """Of HTTP: status, headers, body."""
        status, headers = self.read_head()
        return status, headers, self.read(int(headers.get("content-length", 0))).decode()

    def read_frame(self):
        """Of a WebSocket: kind and payload of a whole message; the server sends long ones in pieces. It does not mask."""
        while True:
            first, second = self.read(2)
            size = second & 0x7F
            if size == 126:
                size = struct.unpack(">H", self.read(2))[0]
            elif size == 127:
                size = struct.unpack(">Q", self.read(8))[0]
            kind, payload = first & 0x0F, self.read(size)
            if kind >= CLOSE:  # may come between the pieces
                return kind, payload
            self.begun = (kind or self.begun[0], self.begun[1] + payload)
            if first & 0x80:
                whole, self.begun = self.begun, (0, b"")
                return whole

    def read_to_end(self):
        """All frames until the other end says goodbye or is gone: kinds and payloads."""
        frames = []
        try:
            while not frames or frames[-1][0] != CLOSE:
                frames.append(self.read_frame())
            return frames
        except Closed:
            return frames


def http(port, target="/", method="GET", headers=None):
    with Wire(port) as wire:
        lines = {"Host": f"127.0.0.1:{port}", "Connection": "close", **(headers or {})}
        wire.send((f"{method} {target} HTTP/1.1\r\n" + "".join(f"{name}: {value}\r\n" for name, value in lines.items()) +
                   "\r\n").encode())
        if method == "HEAD":
            return *wire.read_head(), ""
        return wire.read_answer()


def open_live(port, small_window=False):
    """A WebSocket on which nothing was said yet."""
    wire = Wire(port, small_window)
    wire.send(ask_for_live(port))
    status, _ = wire.read_head()
    if status != 101:
        wire.close()
        raise Closed(f"status {status}")
    return wire


# ---- what a page sees --------------------------------------------------------------------------


def is_run(process):
    try:
        return b"run-host" in pathlib.Path(f"/proc/{process}/cmdline").read_bytes().split(b"\0")
    except FileNotFoundError:
        return False


def merged(value, patch):
    """RFC 7396."""
    if not isinstance(patch, dict):
        return patch
    value = dict(value) if isinstance(value, dict) else {}
    for key, change in patch.items():
        if change is None:
            value.pop(key, None)
        else:
            value[key] = merged(value.get(key), change)
    return value


class Topic:
    """What came of a subscription."""

    def __init__(self, name):
        self.name = name
        self.value = None  # of a document
        self.items = []    # of a stream
        self.left_out = 0
        self.frames = []   # of what flows: time and payload
        self.messages = 0

    def take(self, message):
        """What the protocol does not promise, or nothing."""
        self.messages += 1
        if "items" in message:
            self.items += message["items"]
            self.left_out += message["left_out"]
            kind = TOPICS[self.name]["item"]
            return next((found for item in message["items"] if (found := fault(item, kind, self.name))), None)
        self.value = message["whole"] if "whole" in message else merged(self.value, message["patch"])
        return fault_of_document(self.name, self.value)

    def take_bytes(self, time_of_run, payload):
        self.messages += 1
        self.frames.append((time_of_run, payload))


class Page:
    """One connection. A thread reads what comes; wait() sleeps until something did."""

    def __init__(self, port, token, client=None, name="a test", first_id=1, nonce=None):
        self.port, self.token, self.name = port, token, name
        self.client = client or os.urandom(8).hex()
        self.next_id = first_id
        self.answers, self.answered = {}, {}
        self.asked = {}    # commands by number
        self.topics = {}
        self.faults = []   # what came and is not as the protocol says
        self.closed = None  # why
        self.ahead = -math.inf  # the server's clock, before ours, in ms
        self.news, self.talks = threading.Condition(), threading.Lock()
        self.wire = open_live(port)
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()
        try:
            self.greeting = self.do("hello", token=token, client=self.client, name=name, **({"nonce": nonce} if nonce else {}))
            self.ahead = max(self.ahead, self.greeting["now"] - time.monotonic() * 1000)
        except BaseException:
            self.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, failed, *_):
        self.close()
        assert failed or not self.faults, self.faults[:5]

    def close(self):
        """Goes as a page goes whose computer is switched off."""
        try:
            self.wire.socket.shutdown(socket.SHUT_RDWR)
        except OSError:
            pass
        self.reader.join(timeout=5)
        self.wire.close()

    def _read(self):
        why = "gone"
        try:
            while True:
                kind, payload = self.wire.read_frame()
                if kind == CLOSE:
                    why = payload[2:].decode() or "goodbye"
                    break
                if kind == PING:
                    self.wire.send(frame(PONG, payload))
                    continue
                with self.news:
                    self._take(kind, payload)
                    self.news.notify_all()
        except (Closed, OSError, ValueError) as failed:
            why = str(failed)
        with self.news:
            self.closed = why
            self.news.notify_all()

    def _take(self, kind, payload):
        if kind == BINARY:
            number, time_of_run = struct.unpack_from("<Id", payload, 4)
            self.topics[number].take_bytes(time_of_run, payload[16:])
            return
        message = json.loads(payload)
        if "ping" in message:
            self.ahead = max(self.ahead, message["now"] - time.monotonic() * 1000)
            self.say({"pong": message["ping"]})
            return
        if "watch" in message:
            found = self.topics[message["watch"]].take(message)
        else:
            number = message["id"]
            found = fault_of_answer(self.asked[number], message["ok"]) if "ok" in message and number in self.asked else None
            self.answers[number] = message
            self.answered[number] = self.answered.get(number, 0) + 1
        if found:
            self.faults.append(found)

    def say(self, message):
        """A message as it stands."""
        text = message if isinstance(message, (str, bytes)) else json.dumps(message)
        with self.talks:  # the reader answers pings meanwhile
            self.wire.send(frame(TEXT, text if isinstance(text, bytes) else text.encode()))

    def ask(self, command, _id=None, **fields):
        """Sends a command; its number."""
        number = _id or self.next_id
        self.next_id = max(self.next_id, number + 1)
        self.asked[number] = command
        # What can move a robot has a deadline, in the server's time.
        act = COMMANDS.get(command, {}).get("kind") == "act"
        until = {"until": self.ahead + time.monotonic() * 1000 + LIMITS["act_ms"]["value"]} if act else {}
        self.say({"id": number, "do": command, "in": fields} | until)
        return number

    def answer(self, number):
        self.wait(lambda: number in self.answers, f"an answer to command {number}")
        answer = self.answers[number]
        if "error" in answer:
            raise Refused(answer["error"])
        return answer["ok"]

    def do(self, command, **fields):
        return self.answer(self.ask(command, **fields))

    def edit(self, doc, *changes, version=None):
        """Changes a text, each (from, to, text), as an editor does; the version that it has then."""
        now = self.do("doc.open", doc=doc)
        done = self.do("doc.edit", doc=doc, epoch=now["epoch"], version=version or now["version"], by=self.client,
                       changes=[{"from": start, "to": end, "text": text} for start, end, text in changes])
        assert "behind" not in done and "text" not in done, done
        return done["version"]

    def watch(self, topic, rate=None, **of):
        number = len(self.topics) + 1
        self.topics[number] = Topic(topic)
        self.do("watch", watch=number, topic=topic, **({"of": of} if of else {}), **({"rate": rate} if rate else {}))
        return self.topics[number]

    def wait(self, condition, what="what was waited for", closed=False):
        """Until the condition holds; what it gives. Only with `closed` may the connection end."""
        deadline = time.monotonic() + GIVE_UP_AFTER
        with self.news:
            while True:
                found = condition()
                if found:
                    return found
                if self.closed and not closed:
                    raise Closed(f"{self.closed}; waiting for {what}")
                left = deadline - time.monotonic()
                if left <= 0 or not self.news.wait(left):
                    raise Missing(f"{what} never came; documents: " +
                                  json.dumps([topic.value for topic in self.topics.values()])[:4000])

    def wait_closed(self):
        """Why it was sent away."""
        return self.wait(lambda: self.closed, "the end of the connection", closed=True)


# ---- the server --------------------------------------------------------------------------------


class Studio:
    """`vagus studio` with folders of its own, which outlive the program."""

    def __init__(self, *arguments, folder=None, **options):
        self.arguments, self.options = arguments, options
        self.own = tempfile.TemporaryDirectory(prefix="vagus-studio-")
        self.folder = pathlib.Path(folder or self.own.name)
        pages = self.folder / "pages"
        (pages / "assets").mkdir(parents=True, exist_ok=True)
        (pages / "index.html").write_text("<!doctype html><title>pages</title>", encoding="utf-8")
        (pages / "assets" / "page.js").write_text("0;", encoding="utf-8")
        self.program = None
        self.start()

    def start(self, *arguments):
        """Again, after it was killed."""
        self.program = vagus("studio", *(arguments or self.arguments), "--port", 0, "--data", self.folder / "data", "--config",
                             self.folder / "config", "--pages", self.folder / "pages", "--no-browser", cwd=self.folder, **self.options)
        found = self.program.wait_line(r"^studio (http://127\.0\.0\.1:(\d+)/#token=(\w+))$")
        self.address, self.port, self.token = found.group(1), int(found.group(2)), found.group(3)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.program.stop()
        self.program.__exit__()
        self.own.cleanup()

    def page(self, **options):
        return Page(self.port, self.token, **options)

    def kill(self):
        self.program.kill()
        self.program.__exit__()

    def children(self):
        """The processes of its runs; others look for robots in the network."""
        number = self.program.process.pid
        listed = pathlib.Path(f"/proc/{number}/task/{number}/children").read_text(encoding="ascii").split()
        return [int(child) for child in listed if is_run(child)]

    def memory(self):
        """Bytes that it holds now."""
        status = pathlib.Path(f"/proc/{self.program.process.pid}/status").read_text(encoding="ascii")
        return int(re.search(r"VmRSS:\s+(\d+) kB", status).group(1)) * 1024

    def log(self):
        self.program.drain()
        return self.program.lines
