#!/usr/bin/python3
"""What a fleet costs, and how late its events and its Stop are: Debian's mosquitto, and members that are real ones.

    ./dev bench fleet [--members 1000] [--robots 100] [--seconds 20] [--events 300] [--rounds 30]

Members: connections with state at 1 Hz and three variables at 5 Hz; processor and memory of broker, keeper and members.
Events: from one bus to another, both with `vagus serve`; beside it one `vagus switch`, and mosquitto_pub and mosquitto_sub.
Robots: `vagus serve` with a simulated Thymio each; from `stop all` to the last answer, which says that all nodes stand. Goal: 300 ms
at p99 with a hundred.
"""
import argparse
import contextlib
import os
import pathlib
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "tests" / part) for part in ("support", "studio", "fleet")]
import projects
from harness import VAGUS, Bus, Program, free_port, listening, simulated, vagus, wait_until

LOAD = os.environ.get("VAGUS_FLEET_LOAD", str(pathlib.Path(VAGUS).parent / "fleet_load"))
FLEET, EVENT, NODE = "lab", 0, 1
SOON = 1.0  # what has not come by then counts as lost
STOP_P99_MS = 300
TICKS = os.sysconf("SC_CLK_TCK")
PART = {"name": FLEET, "send": ["alarm"], "hear": ["alarm"], "broker_lost": "continue"}


def percentiles(times):
    times = sorted(times)
    return times[len(times) // 2], times[min(len(times) - 1, len(times) * 99 // 100)]


def figure(name, text):
    print(f"figure: fleet, {name}: {text}", flush=True)


class Broker:
    def __init__(self, stack, robots):
        self.folder = pathlib.Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="vagus-fleet-")))
        self.broker, self.port = self.folder / "broker", free_port()
        self.pages = self.folder / "pages"
        projects.write(self.pages, "index.html", "<!doctype html>\n")
        names = [word for robot in robots for word in ("--robot", robot)]
        subprocess.run([VAGUS, "fleet", "init", self.broker, "--port", str(self.port), "--web-port", str(free_port()), *names],
                       check=True, stdout=subprocess.DEVNULL)
        self.program = stack.enter_context(vagus("fleet", "serve", self.broker))
        self.program.wait_line(r": serves, epoch")
        self.target = f"mqtts://localhost:{self.port}/{FLEET}"

    def login(self, name):
        return ["--tls-ca", self.broker / "ca.crt", "--login", self.broker / f"{name}.login"]

    def child(self, word):
        """The process of mosquitto, or of the keeper."""
        process = self.program.process.pid
        children = pathlib.Path(f"/proc/{process}/task/{process}/children").read_text(encoding="ascii").split()
        return next(child for child in children
                    if word in pathlib.Path(f"/proc/{child}/cmdline").read_bytes().decode().replace("\0", " "))


def seconds_used(process):
    fields = pathlib.Path(f"/proc/{process}/stat").read_text(encoding="ascii").rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / TICKS


def megabytes(process):
    status = pathlib.Path(f"/proc/{process}/status").read_text(encoding="ascii")
    return next(int(line.split()[1]) for line in status.splitlines() if line.startswith("VmRSS")) / 1024


def measure_members(count, seconds):
    with contextlib.ExitStack() as stack:
        broker = Broker(stack, [f"m{i}" for i in range(count)])
        crowd = stack.enter_context(Program(LOAD, broker.target, broker.broker, "members", count))
        begun = time.monotonic()
        crowd.wait_line(r"^all \d+ members are in the fleet$")
        figure(f"{count} members", f"in the fleet {time.monotonic() - begun:.1f} s after they began at once")
        processes = {"mosquitto": broker.child("mosquitto -c"), "keeper": broker.child(" keep "), "members": crowd.process.pid}
        before = {name: seconds_used(process) for name, process in processes.items()}
        begun = time.monotonic()
        time.sleep(seconds)
        took = time.monotonic() - begun
        for name, process in processes.items():
            share, parts = (seconds_used(process) - before[name]) / took, count if name == "members" else 1
            each = f", {1000 * share / parts:.2f} ms a second and {1024 * megabytes(process) / parts:.0f} KB each" if parts > 1 else ""
            figure(f"{count} members", f"{name}: {100 * share:.1f} % of a core, {megabytes(process):.1f} MB{each}")


def late(send, hears, count):
    """Milliseconds from sending to hearing, one after the other, at most 15 a second (20 of a name are passed on)."""
    wait_until("nothing that was sent was ever heard", lambda: send(0) or hears(0))
    times, lost = [], 0
    for number in range(1, count + 1):
        begun = time.monotonic()
        send(number)
        if hears(number):
            times.append(1000 * (time.monotonic() - begun))
        else:
            lost += 1
        time.sleep(max(0.0, 1 / 15 - (time.monotonic() - begun)))
    return times, lost


def hears_event(bus, number):
    """Whether that event comes soon."""
    until = time.monotonic() + SOON
    while (left := until - time.monotonic()) > 0:
        bus.socket.settimeout(left)
        with contextlib.suppress(TimeoutError):
            _, kind, payload = bus.read()
            if kind == EVENT and payload == number.to_bytes(2, "little"):
                return True
    return False


def measure_events(count):
    with contextlib.ExitStack() as stack:
        broker = Broker(stack, ["r1", "r2"])
        buses = {}
        for name in ("r1", "r2"):
            (broker.folder / name).mkdir()
            world = stack.enter_context(simulated(broker.folder / name, {"name": name, "node": NODE}))
            port = listening(world)
            project = projects.bus(broker.folder / f"{name}-project", f"tcp:127.0.0.1:{port}", name="thymio-II", script="", fleet=PART)
            projects.write(project, "robot.aesl", '<!DOCTYPE aesl-source>\n<network>\n<event size="1" name="alarm"/>\n'
                           f'<node nodeId="{NODE}" name="thymio-II"><![CDATA[]]></node>\n</network>\n')
            serve = stack.enter_context(vagus(
                "serve", project, "--start", "--port", 0, "--data", broker.folder / f"{name}-data", "--config",
                broker.folder / f"{name}-config", "--pages", broker.pages, "--fleet", broker.target, "--robot", name,
                *broker.login(name)))
            serve.wait_line(rf'this robot is "{name}"')
            buses[name] = stack.enter_context(Bus(port))
        tell("from bus to bus over the broker", lambda number: buses["r1"].send(NODE, EVENT, number),
             lambda number: hears_event(buses["r2"], number), count)
        switch = stack.enter_context(vagus("switch", "--listen", "tcp:127.0.0.1:0"))
        port = listening(switch)
        first, second = (stack.enter_context(Bus(port)) for _ in range(2))
        tell("over one vagus switch", lambda number: first.send(NODE, EVENT, number), lambda number: hears_event(second, number), count)
        measure_bare(stack, broker, count)


def measure_bare(stack, broker, count):
    name, password = (broker.broker / "r1.login").read_text(encoding="ascii").split()
    words = ["-V", "mqttv5", "-h", "localhost", "-p", str(broker.port), "--cafile", str(broker.broker / "ca.crt"), "-u", name, "-P",
             password, "-q", "1", "-t", f"vagus/1/{FLEET}/robot/r1/event/bare"]
    hears = stack.enter_context(Program("mosquitto_sub", *words))
    sends = stack.enter_context(Program("mosquitto_pub", *words, "-l", typing=True))
    wait_until("mosquitto_sub never heard anything", lambda: sends.type("x") or hears.drain() or "x" in hears.lines)
    tell("from mosquitto_pub to mosquitto_sub", lambda number: sends.type(str(number)),
         lambda number: hears.wait_line(rf"^{number}$"), count)


def tell(name, send, hears, count):
    times, lost = late(send, hears, count)
    median, p99 = percentiles(times)
    figure(f"an event {name}", f"median {median:.2f} ms, p99 {p99:.2f} ms ({count} events, {lost} not heard)")


def measure_stop(robots, rounds):
    with contextlib.ExitStack() as stack:
        names = [f"r{i}" for i in range(robots)]
        broker = Broker(stack, names)
        programs = []
        for name in names:
            project = broker.folder / name
            projects.thymio(project, script="var n\ntimer.period[0] = 100\nonevent timer0\n\tn += 1\n", fleet=PART)
            programs.append(stack.enter_context(vagus(
                "serve", project, "--port", 0, "--data", project / "data", "--config", project / "config", "--pages", broker.pages,
                "--fleet", broker.target, "--robot", name, *broker.login(name))))
        for name, program in zip(names, programs):
            program.wait_line(rf'this robot is "{name}"')
        desk = stack.enter_context(Program(LOAD, broker.target, broker.broker, "stop", rounds))
        found = [desk.wait_line(r"^stop ([\d.]+) (\d+) (\d+)$") for _ in range(rounds)]
        median, p99 = percentiles([float(one.group(1)) for one in found])
        missed = sum(int(one.group(3)) - int(one.group(2)) for one in found)
        figure(f"stop all, {robots} robots", f"median {median:.1f} ms, p99 {p99:.1f} ms ({rounds} rounds; {missed} answers missing)")
        return p99 <= STOP_P99_MS


def main():
    options = argparse.ArgumentParser()
    for name, value in (("members", 1000), ("robots", 100), ("seconds", 20), ("events", 300), ("rounds", 30)):
        options.add_argument(f"--{name}", type=int, default=value, help="0: not at all")
    chosen = options.parse_args()
    if chosen.members:
        measure_members(chosen.members, chosen.seconds)
    if chosen.events:
        measure_events(chosen.events)
    return 0 if not chosen.robots or measure_stop(chosen.robots, chosen.rounds) else 1


if __name__ == "__main__":
    sys.exit(main())
