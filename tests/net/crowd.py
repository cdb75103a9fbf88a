"""Many robots, floods of events, lines that lose bytes: what `vagus net` and `vagus switch` promise then. Nothing here
asserts a time; how long things took is printed for whoever wants to know."""
import contextlib
import json
import math
import os
import pathlib
import random
import struct
import sys
import tempfile
import threading
import time
import tty
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import Bus, connect, listening, run_vagus, vagus

ROBOTS = int(os.environ.get("VAGUS_CROWD", "100"))
SPACING = 0.3  # metres

PROJECT = """<!DOCTYPE aesl-source>
<network>
<event size="0" name="ping"/>
<event size="1" name="pong"/>
<node nodeId="1" name="{name}">var heard = 0

onevent ping
  heard++
  emit pong [heard]
</node>
</network>
"""
PING = 0


def crowd(robots):
    """A world file with so many Thymios in rows, all called thymio-II on the bus."""
    row = math.ceil(math.sqrt(robots))
    side = SPACING * (row + 1)
    places = [[SPACING * (1 + i % row), SPACING * (1 + i // row)] for i in range(robots)]
    return {"format": "vagus-world/1", "size": [side, side],
            "robots": [{"type": "thymio2", "name": f"t{i + 1}", "node": i + 1, "at": at} for i, at in enumerate(places)]}


def event(number, *words, source=0):
    return struct.pack(f"<HHH{len(words)}h", 2 * len(words), source, number, *words)


def timed(what, *words):
    began = time.monotonic()
    told = run_vagus(*words)
    print(f"{what}: {time.monotonic() - began:.2f} s", file=sys.stderr)
    return told


class Flood:
    """A client that sends events as fast as they are taken, until it is left."""

    def __init__(self, port, number):
        self.socket = connect(port)
        self.piece = event(number, 1, 2, 3, 4) * 500
        self.sent = 0
        self.over = False
        self.thread = threading.Thread(target=self.send, daemon=True)
        self.reader = threading.Thread(target=self.read, daemon=True)

    def send(self):
        with contextlib.suppress(OSError):
            while not self.over:
                self.socket.sendall(self.piece)
                self.sent += 500

    def read(self):
        with contextlib.suppress(OSError):
            while self.socket.recv(65536):
                pass

    def __enter__(self):
        self.began = time.monotonic()
        self.thread.start()
        self.reader.start()
        return self

    def __exit__(self, *_):
        self.over = True
        print(f"flood: {self.sent / (time.monotonic() - self.began):.0f} events/s", file=sys.stderr)
        self.socket.close()


class Crowd(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-crowd-")))

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def test_every_robot_of_a_class_is_loaded_listed_and_paused(self):
        world = self.write("crowd.world.json", json.dumps(crowd(ROBOTS)))
        project = self.write("crowd.aesl", PROJECT.format(name="thymio-II"))
        sim = self.enterContext(vagus("sim", world, "--headless", "--duration", 3600, "--listen", "tcp:127.0.0.1:0",
                                      "--load", project))
        target = f"tcp:127.0.0.1:{listening(sim)}"
        # Above 20 the rest of a second is a number.
        for _ in range(20):
            sim.wait_line(r"  loaded  /")
        sim.wait_line(rf"  loaded  and {ROBOTS - 20} more")
        ids = list(range(1, ROBOTS + 1))
        listed = json.loads(timed(f"list {ROBOTS}", "net", target, "list", "--json"))
        self.assertEqual([node["id"] for node in listed], ids)
        self.assertEqual({node["name"] for node in listed}, {"thymio-II"})
        loaded = json.loads(timed("load all", "net", target, "load", project, "all", "--json"))
        self.assertEqual([node["id"] for node in loaded], ids)
        paused = json.loads(timed("pause all", "net", target, "pause", "all", "--json"))
        self.assertEqual([(node["id"], node["state"]) for node in paused], [(number, "paused") for number in ids])
        running = json.loads(timed("run all", "net", target, "run", "all", "--json"))
        self.assertEqual({node["state"] for node in running}, {"running"})

    def test_commands_get_through_a_flood_of_events(self):
        project = self.write("rover.aesl", PROJECT.format(name="rover"))
        switch = self.enterContext(vagus("switch", "--listen", "tcp:127.0.0.1:0"))
        port = listening(switch)
        target = f"tcp:127.0.0.1:{port}"
        for number in (1, 2):
            self.enterContext(vagus("node", "--id", number, "--name", "rover", "--connect", target))
            run_vagus("net", target, "describe", number, "--wait", 60)
        with Flood(port, PING):
            self.assertIn("2  rover  running", timed("list", "net", target, "list"))
            self.assertIn("loaded, running", timed("load", "net", target, "load", project, "all"))
            for verb, state in (("pause", "paused"), ("run", "running"), ("stop", "paused"), ("run", "running")):
                told = timed(verb, "net", target, verb, "all", "--json")
                self.assertEqual([node["state"] for node in json.loads(told)], [state] * 2, verb)
            timed("get", "net", target, "get", "1", "heard", "--project", project)

    def test_commands_get_through_a_flood_to_simulated_robots(self):
        world = self.write("few.world.json", json.dumps(crowd(2)))
        project = self.write("few.aesl", PROJECT.format(name="thymio-II"))
        sim = self.enterContext(vagus("sim", world, "--headless", "--duration", 3600, "--listen", "tcp:127.0.0.1:0"))
        port = listening(sim)
        target = f"tcp:127.0.0.1:{port}"
        with Flood(port, PING):
            self.assertIn("2  thymio-II", timed("sim list", "net", target, "list"))
            timed("sim load", "net", target, "load", project, "all")
            told = json.loads(timed("sim pause", "net", target, "pause", "all", "--json"))
            self.assertEqual([node["state"] for node in told], ["paused"] * 2)

    def test_nodes_that_are_not_reached_are_named(self):
        switch = self.enterContext(vagus("switch", "--listen", "tcp:127.0.0.1:0"))
        port = listening(switch)
        target = f"tcp:127.0.0.1:{port}"
        self.enterContext(vagus("node", "--id", 1, "--name", "rover", "--connect", target))
        run_vagus("net", target, "describe", 1, "--wait", 60)
        with Bus(port) as bus:  # nodes 5 and 6 say that they are there, and nothing more
            answering = threading.Thread(target=self.answer_presence, args=(bus, (5, 6)), daemon=True)
            answering.start()
            told = run_vagus("net", target, "pause", "all", status=1)
            self.assertIn("not reached, since they do not say what they are: 5, 6", told)
            self.assertIn("1  rover  paused", told)

    def answer_presence(self, bus, ids):
        with contextlib.suppress(Exception):  # the test has ended
            while True:
                _, kind, _ = bus.read()
                if kind == 0xA011:
                    for number in ids:
                        bus.send(number, 0x900C, 5)

    def test_a_serial_line_heals_after_garbage_lost_and_doubled_bytes(self):
        line, device = os.openpty()
        self.addCleanup(os.close, line)
        self.addCleanup(os.close, device)
        tty.setraw(device)
        switch = self.enterContext(vagus("switch", "--listen", "tcp:127.0.0.1:0", f"ser:{os.ttyname(device)}"))
        port = listening(switch)
        switch.wait_line("connected")
        seed = random.randrange(1 << 30)
        print(f"seed {seed}", file=sys.stderr)
        dice = random.Random(seed)
        present = struct.pack("<HHHH", 2, 3, 0x900C, 5)
        state = struct.pack("<HHHHH", 4, 3, 0x900A, 7, 0)
        with Bus(port) as bus:
            bus.ask(lambda: os.write(line, present), 0x900C, source=3)
            for number in range(20):
                whole = event(4, number, source=3)
                at = dice.randrange(len(whole))
                damage = dice.choice([b"\xffnoise\xfe", whole[:at] + whole[at + 1:], whole[:at] + whole[at:at + 1] * 2 + whole[at + 1:]])
                os.write(line, damage)
                for _ in range(5):
                    os.write(line, state)
                # Once the states pass again, so does everything.
                bus.ask(lambda: os.write(line, state), 0x900A, source=3)
                sought = struct.pack("<h", 1000 + number)
                os.write(line, state + event(5, 1000 + number, source=3) + state)
                while bus.wait(5, source=3) != sought:
                    pass
        switch.wait_line(rf"^vagus: ser:{os.ttyname(device)}\S*: skipped \d+ bytes? that belonged to no frame")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"Crowd.{name}" for name in sys.argv[1:])], verbosity=2, warnings="ignore")
