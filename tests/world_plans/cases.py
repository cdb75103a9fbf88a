"""Plans that talk with scripts: beside a world on one clock, and on the bus of another process."""
import json
import os
import pathlib
import shutil
import signal
import socket
import sys
import tempfile
import threading
import unittest
import unittest.mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import listening, run_vagus, vagus

EXAMPLES = pathlib.Path(__file__).resolve().parent.parent.parent / "examples"

# The robot answers `go` with one more.
SCRIPT = """<network>
<event size="1" name="go"/>
<event size="1" name="gone"/>
<node nodeId="1" name="thymio-II">onevent go
emit gone event.args[0] + 1
</node></network>
"""
WORLD = {
    "format": "vagus-world/1", "name": "Room", "size": [1, 1],
    "robots": [{"name": "thymio", "type": "thymio2", "at": [0.5, 0.5], "script": "answer.aesl"}],
}
# Counts to 5 together with the robot.
PLAN = {
    "format": "vagus-plan/1", "name": "Count",
    "configuration": {"n": {"type": "int", "initial": 0}},
    "start": {"actor": "ask"},
    "actors": {
        "ask": {"template": "Send", "in": {"event": "'go'", "args": "n"}, "states": {"Sent": "hear"}},
        "hear": {"template": "Receive", "in": {"event": "'gone'"}, "out": {"arg0": "n"}, "states": {"Received": "more"}},
        "more": {"template": "Compare", "in": {"left": "n", "op": "'<'", "right": 5},
                 "states": {"True": "ask", "False": "@terminate"}},
    },
}
# Four metres ahead, in a hall that is long enough.
HALL = {
    "format": "vagus-world/1", "name": "Hall", "size": [12, 2],
    "robots": [{"name": "carbot", "type": "carbot", "at": [1, 1], "script": "carbot.aesl"}],
}
DRIVE = {
    "format": "vagus-plan/1", "name": "Drive", "toolboxes": ["drive"],
    "start": {"actor": "ahead"},
    "actors": {"ahead": {"template": "Forward", "in": {"distance": 1000}, "states": {"ForwardSuccessful": "@terminate"}}},
}
STANDS_WITHIN = 0.5  # simulated seconds after its commander has gone
# Other code of the processor gives other bits, if anything hangs on them.
NO_FMA = "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX2_Usable,-FMA_Usable,-AVX512F"


class WorldPlans(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-plans-")))
        self.script = self.write("answer.aesl", SCRIPT)
        self.world = self.write("room.world.json", json.dumps(WORLD))
        self.plan = self.write("count.plan.json", json.dumps(PLAN))

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def refused(self, *words):
        return run_vagus("plan", "run", self.plan, *words, status=2)

    def start_simulation(self):
        simulation = self.enterContext(vagus("sim", self.world, "--headless", "--duration", "600",
                                             "--listen", "tcp:127.0.0.1:0"))
        return simulation, f"tcp:127.0.0.1:{listening(simulation)}"

    def test_a_plan_and_a_script_count_together_in_virtual_time(self):
        # Two milliseconds for each of five rounds.
        for clock in (["--clock", "virtual"], []):
            lines = run_vagus("plan", "run", self.plan, "--world", self.world, *clock, "--trace", "-",
                              "--quiet").splitlines()
            self.assertEqual(lines[-1], '{"t":0.010000,"plan":"Count","kind":"plan-end","result":"OK"}')

    def test_a_plan_and_a_script_count_together_over_tcp(self):
        _, target = self.start_simulation()
        out = run_vagus("plan", "run", self.plan, "--bus", target, "--project", self.script, "--trace", "-", "--quiet")
        written = [line["value"] for line in map(json.loads, out.splitlines()) if line["kind"] == "write"]
        self.assertEqual(written, [0, 1, 2, 3, 4, 5])

    def test_both_traces_stand_in_one_file_in_order(self):
        all_lines = self.folder / "all.jsonl"
        run_vagus("plan", "run", self.plan, "--world", self.world, "--clock", "virtual", "--trace-all", all_lines)
        lines = [json.loads(line) for line in all_lines.read_text(encoding="utf-8").splitlines()]
        self.assertEqual(sorted(lines, key=lambda line: line["t"]), lines)
        told = [(line["t"], line["node"], line["name"], line["args"]) for line in lines if "args" in line]
        self.assertEqual(told[:3], [(0, 0, "go", [0]), (0.001, 1, "gone", [1]), (0.002, 0, "go", [1])])

    def test_a_run_is_the_same_to_the_byte_whatever_the_processor_can_do(self):
        def trace(name, **environment):
            path = self.folder / name
            with unittest.mock.patch.dict(os.environ, environment):
                run_vagus("plan", "run", self.plan, "--world", self.world, "--clock", "virtual", "--seed", "7",
                          "--trace-all", path)
            return path.read_bytes()

        first = trace("first.jsonl")
        self.assertEqual(trace("second.jsonl"), first)
        self.assertEqual(trace("plain.jsonl", GLIBC_TUNABLES=NO_FMA), first)

    def test_a_run_is_the_same_to_the_byte_with_any_number_of_threads(self):
        traces = []
        for threads in (1, 3):
            path = self.folder / f"{threads}.jsonl"
            run_vagus("plan", "run", self.plan, "--world", self.world, "--clock", "virtual", "--threads", threads,
                      "--trace-all", path)
            traces.append(path.read_bytes())
        self.assertEqual(traces[0], traces[1])
        for wrong in ("0", "65", "-1", "two", "2.5"):
            said = self.refused("--world", self.world, f"--threads={wrong}")
            self.assertIn(f"--threads {wrong}: expected a whole number from 1 to 64", said)

    def test_carbot_drives_the_same_bits_whatever_the_processor_can_do(self):
        def trace(name, **environment):
            path = self.folder / name
            with unittest.mock.patch.dict(os.environ, environment):
                run_vagus("plan", "run", EXAMPLES / "follow-wall/WallFollow.plan.json", "--world",
                          EXAMPLES / "follow-wall/hall.world.json", "--clock", "virtual", "--seed", "3", "--max-time", "60",
                          "--trace-all", path, status=5)
            return path.read_bytes()

        first = trace("first.jsonl")
        self.assertGreater(first.count(b'"kind":"pose"'), 590)
        self.assertEqual(trace("second.jsonl"), first)
        self.assertEqual(trace("plain.jsonl", GLIBC_TUNABLES=NO_FMA), first)

    def test_what_does_not_go_together_is_said(self):
        self.assertIn("--bus with --clock virtual", self.refused("--bus", "tcp:127.0.0.1:1", "--clock", "virtual"))
        self.assertIn("--bus without --project", self.refused("--bus", "tcp:127.0.0.1:1"))
        self.assertIn("a run has one bus", self.refused("--bus", "tcp:127.0.0.1:1", "--world", self.world))
        self.assertIn("--project goes with --bus", self.refused("--project", self.script))
        self.assertIn("--trace-all goes with --world", self.refused("--trace-all", "-"))
        self.assertIn("--threads goes with --world", self.refused("--threads", "2"))

    def test_wrong_files_are_named_with_their_places(self):
        self.write("answer.aesl", SCRIPT.replace("emit", "emt"))
        said = self.refused("--world", self.world)
        self.assertRegex(said, r"answer\.aesl:5:1: error: .* did you mean \"emit\"\?")
        self.write("answer.aesl", SCRIPT.replace("gone", "went"))
        said = self.refused("--world", self.world)
        self.assertRegex(said, r"count\.plan\.json:1:\d+: error: hear: the event \"gone\" has no number: it is not declared by "
                               r"the scripts of .*room\.world\.json")
        self.write("room.world.json", json.dumps({**WORLD, "siz": [1, 1]}))
        self.assertRegex(self.refused("--world", self.world), r"room\.world\.json:1:\d+: .*siz")


class Proxy:
    """A line between two programs that can go dead without a word, as a cable does."""

    def __init__(self, port):
        self.alive = True
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.target = f"tcp:127.0.0.1:{self.listener.getsockname()[1]}"
        self.sockets = []
        threading.Thread(target=self.serve, args=(port,), daemon=True).start()

    def serve(self, port):
        near, _ = self.listener.accept()
        far = socket.create_connection(("127.0.0.1", port))
        self.sockets += [near, far]
        for source, sink in ((near, far), (far, near)):
            threading.Thread(target=self.carry, args=(source, sink), daemon=True).start()

    def carry(self, source, sink):
        try:
            while data := source.recv(65536):
                if self.alive:
                    sink.sendall(data)
        except OSError:
            pass  # closed at the end of the test

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for one in [self.listener, *self.sockets]:
            one.close()


class WhoDrivesDies(unittest.TestCase):
    """In the middle of Forward the drive node hears no more of the plan: the wheels stand within half a second."""

    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-dies-")))
        self.script = self.folder / "carbot.aesl"
        shutil.copy(EXAMPLES / "carbot/carbot.aesl", self.script)
        world = self.folder / "hall.world.json"
        world.write_text(json.dumps(HALL), encoding="utf-8")
        self.plan = self.folder / "drive.plan.json"
        self.plan.write_text(json.dumps(DRIVE), encoding="utf-8")
        self.simulation = self.enterContext(vagus("sim", world, "--headless", "--duration", "600", "--trace", "-",
                                                  "--listen", "tcp:127.0.0.1:0"))
        self.port = listening(self.simulation)

    def next_pose(self):
        line = self.simulation.wait_line(r'"kind":"pose"').string
        pose = json.loads(line)
        return pose["t"], (pose["x"], pose["y"], pose["angle"])

    def words(self, target):
        return [self.plan, "--bus", target, "--project", self.script]

    def wait_until_it_drives(self):
        before = self.next_pose()[1]
        driven = 0
        while driven < 3:  # tenths of a second in a row
            now = self.next_pose()[1]
            driven = driven + 1 if now[0] > before[0] + 0.01 else 0
            before = now

    def assert_stands_soon(self):
        """What comes now has been simulated after the end of the plan."""
        self.simulation.drain()
        first, _ = self.next_pose()
        t, place = first, None
        while t < first + STANDS_WITHIN + 1.5:
            t, now = self.next_pose()
            if t < first + STANDS_WITHIN - 1e-6:
                continue
            self.assertIn(place, (None, now), f"it still moves at {t}, {t - first:.1f} s after the end")
            place = now

    def test_its_process_is_killed(self):
        plan = self.enterContext(vagus("plan", "run", *self.words(f"tcp:127.0.0.1:{self.port}")))
        self.wait_until_it_drives()
        plan.kill()
        self.assert_stands_soon()

    def test_its_process_hangs(self):
        plan = self.enterContext(vagus("plan", "run", *self.words(f"tcp:127.0.0.1:{self.port}")))
        self.wait_until_it_drives()
        plan.signal(signal.SIGSTOP)
        self.assert_stands_soon()
        plan.kill()

    def test_its_link_is_cut(self):
        line = self.enterContext(Proxy(self.port))
        self.enterContext(vagus("plan", "run", *self.words(line.target)))
        self.wait_until_it_drives()
        line.alive = False
        self.assert_stands_soon()

    def test_the_switch_between_is_killed(self):
        switch = self.enterContext(vagus("switch", "--listen", "tcp:127.0.0.1:0", f"tcp:127.0.0.1:{self.port}"))
        target = f"tcp:127.0.0.1:{listening(switch)}"
        self.enterContext(vagus("plan", "run", *self.words(target)))
        self.wait_until_it_drives()
        switch.kill()
        self.assert_stands_soon()

    def test_a_debugger_pauses_it(self):
        debugger = self.enterContext(vagus("plan", "debug", *self.words(f"tcp:127.0.0.1:{self.port}"), typing=True))
        debugger.type("run &")
        self.wait_until_it_drives()
        debugger.type("pause")
        debugger.wait_line("paused")
        self.assert_stands_soon()
        # Goes on where it was.
        debugger.type("run &")
        self.wait_until_it_drives()

    def test_the_robot_leaves_and_the_plan_says_so(self):
        plan = self.enterContext(vagus("plan", "run", *self.words(f"tcp:127.0.0.1:{self.port}")))
        self.wait_until_it_drives()
        self.simulation.kill()
        self.assertEqual(plan.wait_end(), 4)
        self.assertRegex("\n".join(plan.lines), r'vagus: .*ahead.*"drive".* has left the bus')

    def test_its_terminal_ends_it(self):
        plan = self.enterContext(vagus("plan", "run", *self.words(f"tcp:127.0.0.1:{self.port}")))
        self.wait_until_it_drives()
        plan.signal(signal.SIGINT)
        self.assert_stands_soon()


if __name__ == "__main__":
    classes = {name: one.__name__ for one in (WorldPlans, WhoDrivesDies) for name in vars(one)}
    unittest.main(argv=[sys.argv[0]] + [f"{classes[name]}.{name}" for name in sys.argv[1:]], verbosity=2)
