#!/usr/bin/env python3
"""Measures the simulated robots of Debian's asebaplayground as a black box.

Robots stand in cells of one big arena, each with a wall, a cylinder or a coloured floor at a known place; their
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
import zlib

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

    def __init__(self, robots, elements, size=(400, 400), texture=None):
        self.folder = tempfile.mkdtemp()
        ground = ' groundTexture="%s"' % texture if texture else ""
        lines = ['<!DOCTYPE aseba-playground>', '<aseba-playground>',
                 '<color name="white" r="1" g="1" b="1"/>', '<color name="wall" r="0.9" g="0.9" b="0.9"/>',
                 '<color name="grey" r="0.5" g="0.5" b="0.5"/>', '<color name="black" r="0" g="0" b="0"/>',
                 '<color name="red" r="1" g="0" b="0"/>',
                 '<world w="%g" h="%g" color="wall"%s/>' % (size[0], size[1], ground)]
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


if __name__ == "__main__":
    if os.environ.get("MEASURE_INSIDE") != "1":
        command = ["unshare", "-n", "sh", "-c", 'ip link set lo up && exec "$0" "$@"', sys.executable] + sys.argv
        os.execvpe("unshare", command, dict(os.environ, MEASURE_INSIDE="1"))
    main()
