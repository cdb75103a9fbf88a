#!/usr/bin/env python3
"""Measures the simulated robots of Debian's asebaplayground as a black box.

Robots are in cells of one big arena, each with a wall, a cylinder or a coloured floor at a known place; their
variables are read over TCP with GetVariables (docs/spec/aseba-wire-and-vm.md, section 2.3). Nothing but what the
program tells over its sockets is used. Prints one JSON object: the table of docs/sensors.md is made from it.

    tools/measure_playground.py > measured.json       (packages: aseba, xvfb, iproute2; runs in its own network namespace)

The playground needs a display and fixed ports, so the script starts itself again under `unshare -n`.
"""
import json
import math
import os
import select
import socket
import struct
import subprocess
import sys
import tempfile
import time

THYMIO = {"prox": (42, 7), "ambiant": (51, 2), "reflected": (53, 2), "delta": (55, 2), "speed": (59, 2),
          "pwm": (61, 2), "acc": (63, 3), "temperature": (66, 1), "mic": (69, 2)}
EPUCK = {"prox": (40, 8), "red": (48, 60), "green": (108, 60), "blue": (168, 60), "energy": (228, 1)}
SAMPLES = 12
FIRST_PORT = 45101


class Node:
    """One robot, seen through its socket."""

    def __init__(self, port, node_id):
        self.id = node_id
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=10)
        self.buffer = b""

    def send(self, kind, *words):
        payload = struct.pack("<%dH" % len(words), *[word & 0xFFFF for word in words])
        self.socket.sendall(struct.pack("<HHH", len(payload), 0, kind) + payload)

    def frame(self):
        while True:
            if len(self.buffer) >= 6:
                size, source, kind = struct.unpack_from("<HHH", self.buffer)
                if len(self.buffer) >= 6 + size:
                    payload, self.buffer = self.buffer[6:6 + size], self.buffer[6 + size:]
                    return source, kind, payload
            more = self.socket.recv(65536)
            if not more:
                raise ConnectionError("the playground closed the connection")
            self.buffer += more

    def get(self, start, length):
        self.send(0xA00B, self.id, start, length)
        while True:
            _, kind, payload = self.frame()
            if kind == 0x9005:
                return list(struct.unpack("<%dh" % (len(payload) // 2 - 1), payload[2:]))

    def set(self, start, *values):
        self.send(0xA00C, self.id, start, *values)


class Playground:
    """A running asebaplayground with `robots` (dicts: type, x, y, angle in radians) and further XML elements."""

    def __init__(self, robots, elements, size=(400, 400), floor=0.9):
        self.folder = tempfile.mkdtemp()
        lines = ['<!DOCTYPE aseba-playground>', '<aseba-playground>',
                 '<color name="white" r="1" g="1" b="1"/>', '<color name="wall" r="0.9" g="0.9" b="0.9"/>',
                 '<color name="floor" r="%g" g="%g" b="%g"/>' % (floor, floor, floor),
                 '<color name="grey" r="0.5" g="0.5" b="0.5"/>', '<color name="black" r="0" g="0" b="0"/>',
                 '<color name="red" r="1" g="0" b="0"/>',
                 '<world w="%g" h="%g" color="floor"/>' % size]
        lines += elements
        for index, robot in enumerate(robots):
            lines.append('<robot type="%s" x="%.6f" y="%.6f" angle="%.6f" port="%d" name="r%d" nodeId="1"/>' % (
                robot.get("type", "thymio2"), robot["x"], robot["y"], robot.get("angle", 0), FIRST_PORT + index, index))
        lines.append('</aseba-playground>')
        path = os.path.join(self.folder, "scene.playground")
        with open(path, "w") as file:
            file.write("\n".join(lines))
        read, write = os.pipe()
        self.display = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "320x240x24"],
                                        pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        number = os.read(read, 20).decode().strip()
        environment = dict(os.environ, DISPLAY=":" + number, LIBGL_ALWAYS_SOFTWARE="1", HOME=self.folder)
        self.program = subprocess.Popen(["asebaplayground", path], env=environment, stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL, cwd=self.folder)
        self.nodes = [self.connect(FIRST_PORT + index) for index in range(len(robots))]

    def connect(self, port):
        deadline = time.monotonic() + 60
        while True:
            try:
                return Node(port, 1)
            except OSError:
                if time.monotonic() > deadline or self.program.poll() is not None:
                    raise
                time.sleep(0.1)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for node in self.nodes:
            node.socket.close()
        for process in (self.program, self.display):
            process.terminate()
            process.wait()

    def sample(self, layout, samples=SAMPLES, settle=0.6):
        """Mean and standard deviation of every variable of `layout`, for each robot."""
        time.sleep(settle)
        sums = [{name: [[] for _ in range(size)] for name, (_, size) in layout.items()} for _ in self.nodes]
        low = min(start for start, _ in layout.values())
        high = max(start + size for start, size in layout.values())
        for _ in range(samples):
            for node, into in zip(self.nodes, sums):
                words = node.get(low, high - low)
                for name, (start, size) in layout.items():
                    for k in range(size):
                        into[name][k].append(words[start - low + k])
            time.sleep(0.11)
        return [{name: ([mean(v) for v in values], [deviation(v) for v in values]) for name, values in robot.items()}
                for robot in sums]


def mean(values):
    return round(sum(values) / len(values), 2)


def deviation(values):
    middle = sum(values) / len(values)
    return round(math.sqrt(sum((v - middle) ** 2 for v in values) / len(values)), 2)


def cells(count, side=50, per_row=10, at=60):
    """Centres of cells far enough apart that no robot sees another cell's wall."""
    return [(at + side * (i % per_row), at + side * (i // per_row)) for i in range(count)]


def arena(count, side=50, per_row=10):
    return (120 + side * per_row, 120 + side * ((count + per_row - 1) // per_row))


def wall_curve(kind, layout, distances, angle=0.0, colour="wall", length=44):
    """A long wall straight ahead of a robot that is turned by `angle`, its near face at each of the distances."""
    places = cells(len(distances))
    robots, elements = [], []
    for (x, y), distance in zip(places, distances):
        robots.append({"type": kind, "x": x, "y": y, "angle": angle})
        elements.append('<wall x="%.4f" y="%.4f" l1="1" l2="%g" h="20" color="%s"/>' % (x + distance + 0.5, y, length, colour))
    with Playground(robots, elements, arena(len(distances))) as playground:
        return [{"distance": d, **{k: v[0] for k, v in robot.items()}, "noise": robot["prox"][1]}
                for d, robot in zip(distances, playground.sample(layout))]


def main():
    steps = {name: function for name, function in globals().items() if name.startswith("measure_")}
    wanted = sys.argv[1:] or [name[len("measure_"):] for name in steps]
    print(json.dumps({name: steps["measure_" + name]() for name in wanted}, indent=1))


def measure_front():
    """Thymio, wall straight ahead: near face 8 to 27.5 cm from the point between the wheels."""
    return wall_curve("thymio2", THYMIO, [8 + 0.5 * i for i in range(40)])


def measure_back():
    """Thymio, wall straight behind."""
    return wall_curve("thymio2", THYMIO, [3 + 0.5 * i for i in range(40)], math.pi)


def measure_turned():
    """Thymio, a wall 14 cm away in every direction: where each sensor looks."""
    return turned(14.0) + turned(11.0)


def turned(distance):
    angles = [5 * i for i in range(72)]
    places = cells(len(angles))
    robots = [{"x": x, "y": y, "angle": math.radians(a)} for (x, y), a in zip(places, angles)]
    elements = ['<wall x="%.4f" y="%.4f" l1="1" l2="44" h="20" color="wall"/>' % (x + distance + 0.5, y) for x, y in places]
    with Playground(robots, elements, arena(len(angles))) as playground:
        return [{"angle": a, "distance": distance, "prox": row["prox"][0]} for a, row in zip(angles, playground.sample(THYMIO))]


def measure_colour():
    """Thymio, wall 12 cm ahead in several colours; and a cylinder instead of a wall."""
    names = ["white", "wall", "grey", "black", "red"]
    places = cells(len(names) + 1)
    elements = ['<wall x="%g" y="%g" l1="1" l2="44" h="20" color="%s"/>' % (x + 12.5, y, name)
                for (x, y), name in zip(places, names)]
    x, y = places[-1]
    elements.append('<cylinder x="%g" y="%g" r="2" h="20" mass="-1" color="wall"/>' % (x + 14, y))
    with Playground([{"x": x, "y": y} for x, y in places], elements, arena(len(places))) as playground:
        return [{"colour": name, "prox": row["prox"][0]}
                for name, row in zip(names + ["cylinder"], playground.sample(THYMIO))]


def measure_ground():
    """Thymio on grey floors: both ground sensors for reflectances 0 to 1, one arena for each."""
    rows = []
    for level in [i / 10 for i in range(11)]:
        with Playground([{"x": 50, "y": 50}], [], (100, 100), level) as playground:
            row = playground.sample(THYMIO, 40)[0]
            rows.append({"level": level, **{k: row[k][0] for k in ("ambiant", "reflected", "delta")},
                         "noise": row["reflected"][1]})
    return rows


def measure_motor():
    """Thymio: motor.*.speed after a step of the targets, every answer with its time; and a turn on the spot."""
    result = {}
    with Playground([{"x": 100, "y": 100}, {"x": 200, "y": 200}, {"x": 300, "y": 100}],
                    ['<wall x="214" y="200" l1="1" l2="10" h="20" color="wall"/>'], (400, 400)) as playground:
        time.sleep(0.5)
        for name, node, targets in (("step_500", 0, (500, 500)), ("step_minus_200", 0, (-200, -200)),
                                    ("step_1000", 0, (1000, 100)), ("stop", 0, (0, 0))):
            robot = playground.nodes[node]
            robot.set(57, *targets)
            start = time.monotonic()
            rows = []
            while time.monotonic() - start < 1:
                left, right = robot.get(59, 2)
                rows.append([round(time.monotonic() - start, 3), left, right])
                time.sleep(0.015)
            result[name] = rows
        robot = playground.nodes[1]
        for speed in (100, 250, 400):
            robot.set(57, speed, -speed)
            start = time.monotonic()
            seen = []
            while time.monotonic() - start < 30:
                seen.append((time.monotonic() - start, robot.get(44, 1)[0]))
                time.sleep(0.02)
            result["turn_%d_passes_s" % speed] = passes(seen)
    return result


def passes(seen):
    """Times at which the wall was straight ahead: middles of the stretches in which the front sensor saw it."""
    middles, stretch = [], []
    for at, value in seen:
        if value > 0:
            stretch.append(at)
        elif stretch:
            middles.append(round((stretch[0] + stretch[-1]) / 2, 3))
            stretch = []
    return middles


def measure_touch():
    """Thymio pushed against a wall ahead, behind and at its side: readings when it can go no further."""
    places = cells(2)
    elements = ['<wall x="%g" y="%g" l1="1" l2="44" h="20" color="wall"/>' % (places[0][0] + 15, places[0][1]),
                '<wall x="%g" y="%g" l1="1" l2="44" h="20" color="wall"/>' % (places[1][0] - 15, places[1][1])]
    with Playground([{"x": x, "y": y} for x, y in places], elements, arena(2)) as playground:
        time.sleep(0.5)
        playground.nodes[0].set(57, 200, 200)
        playground.nodes[1].set(57, -200, -200)
        rows = playground.sample(THYMIO, settle=4)
        return [{"way": way, "prox": row["prox"][0], "speed": row["speed"][0]} for way, row in zip(("ahead", "back"), rows)]


def measure_epuck():
    """E-puck, a wall ahead: near face 4 to 16 cm from its middle; and turned before a wall at 6 cm."""
    rows = wall_curve("e-puck", {"prox": EPUCK["prox"]}, [3.8 + 0.4 * i for i in range(32)])
    rows += wall_curve("e-puck", {"prox": EPUCK["prox"]}, [3.8 + 0.4 * i for i in range(32)], math.radians(17))
    angles = [10 * i for i in range(36)]
    places = cells(len(angles))
    robots = [{"type": "e-puck", "x": x, "y": y, "angle": math.radians(a)} for (x, y), a in zip(places, angles)]
    elements = ['<wall x="%g" y="%g" l1="1" l2="44" h="20" color="wall"/>' % (x + 6.5, y) for x, y in places]
    with Playground(robots, elements, arena(len(angles))) as playground:
        rows += [{"angle": a, "distance": 6, "prox": row["prox"][0], "noise": row["prox"][1]}
                 for a, row in zip(angles, playground.sample({"prox": EPUCK["prox"]}))]
    return rows


def measure_camera():
    """E-puck's camera: a red cylinder 15 cm away in directions -40 to 40 degrees, and a red wall 10 to 50 cm ahead."""
    angles = [-40 + 5 * i for i in range(17)]
    distances = [10, 20, 30, 40, 50]
    places = cells(len(angles) + len(distances), side=130)
    elements, robots = [], [{"type": "e-puck", "x": x, "y": y} for x, y in places]
    for (x, y), angle in zip(places, angles):
        elements.append('<cylinder x="%.4f" y="%.4f" r="1" h="20" mass="-1" color="red"/>' % (
            x + 15 * math.cos(math.radians(angle)), y + 15 * math.sin(math.radians(angle))))
    for (x, y), distance in zip(places[len(angles):], distances):
        elements.append('<wall x="%g" y="%g" l1="1" l2="80" h="20" color="red"/>' % (x + distance + 0.5, y))
    with Playground(robots, elements, (1500, 700)) as playground:
        rows = playground.sample({k: EPUCK[k] for k in ("red", "green")}, 3)
        return [{"at": at, "red": row["red"][0], "green": row["green"][0]} for at, row in zip(angles + distances, rows)]


if __name__ == "__main__":
    if os.environ.get("MEASURE_INSIDE") != "1":
        command = ["unshare", "-n", "sh", "-c", 'ip link set lo up && exec "$0" "$@"', sys.executable] + sys.argv
        os.execvpe("unshare", command, dict(os.environ, MEASURE_INSIDE="1"))
    main()
