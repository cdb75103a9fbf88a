"""A robot is at rest, however a plan that drives it ends: signals, an error, its own end; and `net stop`, `net set`."""
import json
import pathlib
import re
import shutil
import signal
import socket
import struct
import sys
import tempfile
import threading
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import (DESCRIPTION, GET_EXECUTION_STATE, GET_NODE_DESCRIPTION, GET_VARIABLES, LIST_NODES, NAMED_VARIABLE,
                     NODE_PRESENT, PAUSE, RUN, STATE, STOP, VARIABLES, Bus, Missing, listening, patiently, run_vagus, vagus, wait_until)

EXAMPLES = pathlib.Path(__file__).resolve().parent.parent.parent / "examples"
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)

# Ten metres ahead.
DRIVE = {
    "format": "vagus-plan/1", "name": "Drive", "toolboxes": ["drive"],
    "start": {"actor": "ahead"},
    "actors": {"ahead": {"template": "Forward", "in": {"distance": 1000}, "states": {"ForwardSuccessful": "@terminate"}}},
}
# A Thymio that does what it hears, and looks after nothing.
WHEELS = """<!DOCTYPE aesl-source>
<network>
<event size="1" name="wheels"/>
<node nodeId="1" name="thymio-II">onevent wheels
  motor.left.target = event.args[0]
  motor.right.target = event.args[0]
</node>
</network>
"""


def send_then(after):
    """Drives for a moment, then comes what follows."""
    return {
        "format": "vagus-plan/1", "name": "Send", "start": {"actor": "go"},
        "actors": {
            "go": {"template": "Send", "in": {"event": "'wheels'", "args": "'200'"}, "states": {"Sent": "drive"}},
            "drive": {"template": "Wait", "in": {"seconds": 0.5}, "states": {"Done": after}},
            "fail": {"template": "Fail", "in": {"message": "'wrong'"}},
            "forever": {"template": "WaitForever"}}}


class MuteThymio:
    """Node 1, "thymio-II". Until it is told to stop, it answers everybody but who asks for its variables."""

    def __init__(self, port, on_run=lambda: None):
        self.bus = Bus(port)
        self.commands = []
        self.on_run = on_run
        self.stopped = False
        self.thread = threading.Thread(target=self.serve, daemon=True)

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.bus.socket.shutdown(socket.SHUT_RDWR)
        self.thread.join()
        self.bus.socket.close()

    def serve(self):
        try:
            while True:
                _, kind, payload = self.bus.read()
                if kind == LIST_NODES or payload[:2] == b"\x01\x00":
                    self.commands.append(kind)
                    self.answer(kind, payload)
        except (Missing, OSError):
            pass  # the end of the test

    def answer(self, kind, payload):
        if kind == LIST_NODES:
            self.bus.send(1, NODE_PRESENT, 5)
        elif kind == GET_NODE_DESCRIPTION:
            self.say(DESCRIPTION, text("thymio-II") + struct.pack("<7H", 5, 512, 64, 600, 2, 0, 0))
            for name in ("motor.left.target", "motor.right.target"):
                self.say(NAMED_VARIABLE, struct.pack("<H", 1) + text(name))
        elif kind in (RUN, GET_EXECUTION_STATE, STOP):
            self.stopped |= kind == STOP
            if kind == RUN:
                self.on_run()
            self.bus.send(1, STATE, 3, 2 if kind == STOP else 0)
        elif kind == GET_VARIABLES and self.stopped:
            _, first, count = struct.unpack("<3H", payload)
            self.bus.send(1, VARIABLES, first, *[0] * count)

    def say(self, kind, content):
        self.bus.socket.sendall(struct.pack("<HHH", len(content), 1, kind) + content)


def text(words):
    return bytes([len(words)]) + words.encode()


class Rest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-rest-")))

    def write(self, name, content):
        path = self.folder / name
        path.write_text(content if isinstance(content, str) else json.dumps(content), encoding="utf-8")
        return path

    def simulate(self, kind, script):
        world = self.write("hall.world.json", {
            "format": "vagus-world/1", "name": "Hall", "size": [12, 4],
            "robots": [{"name": "robot", "type": kind, "at": [2, 2], "node": 1, "script": script.name}]})
        program = self.enterContext(vagus("sim", world, "--headless", "--duration", "3600", "--listen", "tcp:127.0.0.1:0"))
        self.target = f"tcp:127.0.0.1:{listening(program)}"
        self.script = script

    def thymio(self, script=WHEELS):
        self.simulate("thymio2", self.write("wheels.aesl", script))

    def read(self, node, *variables):
        values = json.loads(run_vagus("net", self.target, "get", node, *variables, "--json"))
        return [values[name][0] for name in variables]

    def run_plan(self, plan):
        return self.enterContext(vagus("plan", "run", self.write("plan.plan.json", plan), "--bus", self.target,
                                       "--project", self.script))

    def wait_moving(self, node, variable):
        for _ in patiently():
            if self.read(node, variable)[0] > 30:
                return
        self.fail(f"{variable} never moved")

    def targets(self):
        return self.read("thymio-II", "motor.left.target", "motor.right.target")

    # plans ---------------------------------------------------------------------------------------

    def test_carbot_is_read_back_at_rest_after_each_signal(self):
        script = self.folder / "carbot.aesl"
        shutil.copy(EXAMPLES / "carbot/carbot.aesl", script)
        self.simulate("carbot", script)
        for number in SIGNALS:
            with self.subTest(number):
                program = self.run_plan(DRIVE)
                self.wait_moving("drive", "wheel.front.speed")
                program.signal(number)
                self.assertEqual(program.wait_end(), 3, program.lines)
                said = "\n".join(program.lines)
                self.assertIn(f"{number.name} has ended the plan (Interrupted); the robot was stopped", said)
                self.assertRegex(said, r"at rest: [^;]*drive \(1\)")
                self.assertEqual(self.read("drive", "wheel.front.speed", "wheel.rear.speed"), [0, 0])
                self.assertIn("paused", run_vagus("net", self.target, "list"))

    def test_a_thymio_is_read_back_at_rest_after_each_signal(self):
        self.thymio()
        for number in SIGNALS:
            with self.subTest(number):
                program = self.run_plan(send_then("forever"))
                self.wait_moving("thymio-II", "motor.left.target")
                program.signal(number)
                self.assertEqual(program.wait_end(), 3, program.lines)
                self.assertIn("at rest: thymio-II (1)", "\n".join(program.lines))
                self.assertEqual(self.targets(), [0, 0])

    def test_an_error_stops_the_robot(self):
        self.thymio()
        program = self.run_plan(send_then("fail"))
        self.assertEqual(program.wait_end(), 4, program.lines)
        self.assertIn("the plan has ended (Error); the robot was stopped; at rest: thymio-II (1)", "\n".join(program.lines))
        self.assertEqual(self.targets(), [0, 0])
        self.assertIn("paused", run_vagus("net", self.target, "list"))

    def test_an_error_stops_the_robot_also_while_an_actor_does_not_end(self):
        self.thymio()
        plan = send_then("hang")
        plan["actors"]["hang"] = {
            "template": "Stubborn", "in": {"seconds": 1000, "linger": 1000}, "states": {"Done": "@terminate"},
            "supervisors": {"late": {"template": "Timeout", "in": {"seconds": 0.1}, "events": {"Timeout": "@terminate"}}}}
        program = self.run_plan(plan)
        program.wait_line("the plan is over: Error")
        for _ in patiently():
            if self.targets() == [0, 0]:
                break
        self.assertEqual(self.targets(), [0, 0])
        self.assertIn("paused", run_vagus("net", self.target, "list"))
        self.assertTrue(program.running())
        program.kill()

    def test_an_end_by_itself_leaves_the_script_running_and_the_wheels_at_rest(self):
        self.thymio()
        program = self.run_plan(send_then("@terminate"))
        self.assertEqual(program.wait_end(), 0, program.lines)
        self.assertIn("the plan has ended (OK); at rest: thymio-II (1)", "\n".join(program.lines))
        self.assertEqual(self.targets(), [0, 0])
        self.assertIn("running", run_vagus("net", self.target, "list"))

    def test_a_robot_that_moves_is_stopped_before_the_plan_begins_and_its_script_goes_on(self):
        self.thymio()
        run_vagus("net", self.target, "set", "thymio-II", "motor.left.target", "100", "--leave")
        program = self.run_plan(send_then("@terminate"))
        program.wait_line("was moving: it was stopped before the plan begins; at rest: thymio-II")
        self.wait_moving("thymio-II", "motor.right.target")  # the script hears the plan
        self.assertEqual(program.wait_end(), 0, program.lines)

    def test_a_robot_that_does_not_say_how_it_is_is_stopped_before_the_plan_begins(self):
        self.script = self.write("wheels.aesl", WHEELS)
        switch = self.enterContext(vagus("switch", "--listen", "tcp:127.0.0.1:0"))
        port = listening(switch)
        self.target = f"tcp:127.0.0.1:{port}"
        node = self.enterContext(MuteThymio(port))
        program = self.run_plan(send_then("@terminate"))
        program.wait_line("did not say how it is: it was stopped before the plan begins; at rest: thymio-II")
        self.assertEqual(program.wait_end(), 0, program.lines)
        self.assertLess(node.commands.index(STOP), node.commands.index(RUN))

    def test_what_came_to_a_stopped_robot_is_not_obeyed_when_a_plan_begins(self):
        self.thymio()
        run_vagus("net", self.target, "stop", "all")
        run_vagus("net", self.target, "--project", self.script, "emit", "wheels", "200")
        program = self.run_plan({
            "format": "vagus-plan/1", "name": "Idle", "start": {"actor": "idle"}, "actors": {
                "idle": {"template": "Wait", "in": {"seconds": 0.3}, "states": {"Done": "rest"}}, "rest": {"template": "WaitForever"}}})
        program.wait_line("rest begins")
        self.assertEqual(self.targets(), [0, 0])
        self.assertIn("running", run_vagus("net", self.target, "list"))

    def test_an_end_right_behind_a_command_leaves_the_wheels_at_rest(self):
        # The script has the command in hand while it is made safe.
        self.thymio()
        plan = send_then("@terminate")
        plan["actors"]["go"]["states"]["Sent"] = "@terminate"
        for _ in range(3):
            program = self.run_plan(plan)
            self.assertEqual(program.wait_end(), 0, program.lines)
            self.assertIn("at rest: thymio-II (1)", "\n".join(program.lines))
            self.assertEqual(self.targets(), [0, 0])

    def drives_when_it_runs(self):
        """A stopped Thymio whose script drives as soon as it runs."""
        self.thymio(WHEELS.replace("onevent wheels", "timer.period[0] = 5\nonevent timer0\n  motor.left.target = 90\nonevent wheels"))
        self.wait_moving("thymio-II", "motor.left.target")
        run_vagus("net", self.target, "stop", "all")
        self.assertEqual(self.targets(), [0, 0])

    def test_a_plan_that_cannot_begin_lets_nothing_run(self):
        self.drives_when_it_runs()
        plan = self.write("plan.plan.json", send_then("forever"))
        wrong = self.write("wrong.plan.json", json.dumps(send_then("forever")).replace("'wheels'", "'wheel'"))
        for name, words in ((plan, ["--trace", self.folder / "no/such/folder"]), (wrong, [])):
            with self.subTest(name.name):
                run_vagus("plan", "run", name, "--bus", self.target, "--project", self.script, *words, status=2)
                self.assertIn("paused", run_vagus("net", self.target, "list"))
                self.assertEqual(self.targets(), [0, 0])

    def test_a_signal_right_behind_the_scripts_start_stops_them(self):
        self.script = self.write("wheels.aesl", WHEELS)
        port = listening(self.enterContext(vagus("switch", "--listen", "tcp:127.0.0.1:0")))
        self.target = f"tcp:127.0.0.1:{port}"
        for number in SIGNALS:
            with self.subTest(number), MuteThymio(port, lambda number=number: program.signal(number)) as node:
                program = self.run_plan(send_then("forever"))
                self.assertEqual(program.wait_end(), 3, program.lines)
                self.assertIn(f"{number.name} has ended the plan", "\n".join(program.lines))
                self.assertIn(STOP, node.commands[node.commands.index(RUN):])

    def test_a_paused_sensor_stops_a_robot_that_a_plan_drives(self):
        script = self.folder / "carbot.aesl"
        shutil.copy(EXAMPLES / "carbot/carbot.aesl", script)
        self.simulate("carbot", script)
        program = self.run_plan(DRIVE)
        self.wait_moving("drive", "wheel.front.speed")
        with Bus(int(self.target.rsplit(":", 1)[1])) as other:
            other.send(0, PAUSE, 2)  # the bumper, by somebody who looks after nothing
            program.wait_line(r"bumper \(2\) does not run: what moves is paused until it does: drive \(1\)")
            wait_until("Carbot never came to rest", lambda: self.read("drive", "wheel.front.speed", "wheel.rear.speed") == [0, 0])
            self.assertRegex(run_vagus("net", self.target, "list"), r"1  drive +paused")
            other.send(0, RUN, 2)
            wait_until("drive was never let run again",
                       lambda: re.search(r"1  drive +running", run_vagus("net", self.target, "list")) or not program.running())
        program.stop()

    def test_the_project_says_what_brings_its_robot_to_rest(self):
        self.thymio()
        self.write("vagus.json", {"format": "vagus-project/1", "safe_stop": {"thymio-II": {
            "set": {"motor.left.target": 0, "motor.right.target": 0, "timer.period": [7, 8]}}}})
        program = self.run_plan(send_then("@terminate"))
        self.assertEqual(program.wait_end(), 0, program.lines)
        values = json.loads(run_vagus("net", self.target, "get", "thymio-II", "timer.period", "--json"))
        self.assertEqual(values, {"timer.period": [7, 8]})

    # a world that others have joined --------------------------------------------------------------

    def test_a_world_that_ends_brings_who_joined_it_to_rest_as_its_project_says(self):
        self.thymio()  # the guest
        here = self.folder / "here"
        here.mkdir()
        world = here / "here.world.json"
        world.write_text(json.dumps({"format": "vagus-world/1", "name": "Here", "size": [2, 2],
                                     "robots": [{"name": "puck", "type": "epuck", "at": [1, 1], "node": 9}]}))
        idle = here / "idle.plan.json"
        idle.write_text(json.dumps({"format": "vagus-plan/1", "name": "Idle", "start": {"actor": "idle"},
                                    "actors": {"idle": {"template": "WaitForever"}}}))
        for number, words in enumerate((["sim", world, "--duration", "3600"], ["plan", "run", idle, "--world", world])):
            periods = [7, 8 + number]
            (here / "vagus.json").write_text(json.dumps({"format": "vagus-project/1", "safe_stop": {"thymio-II": {
                "set": {"motor.left.target": 0, "motor.right.target": 0, "timer.period": periods}}}}))
            with self.subTest(words[0]), vagus(*words, "--headless", "--listen", "tcp:127.0.0.1:0") as program:
                joined = f"tcp:127.0.0.1:{listening(program)}"
                self.enterContext(vagus("switch", "--listen", "tcp:127.0.0.1:0", joined, self.target))
                run_vagus("net", joined, "run", "thymio-II", "--wait", "20")
                run_vagus("net", joined, "set", "thymio-II", "motor.left.target", "100", "--leave")
                program.signal(signal.SIGTERM)
                program.wait_end()
                self.assertIn("the nodes that had joined this bus were stopped; at rest: thymio-II (1)", "\n".join(program.lines))
                self.assertEqual(self.targets(), [0, 0])
                values = json.loads(run_vagus("net", self.target, "get", "thymio-II", "timer.period", "--json"))
                self.assertEqual(values, {"timer.period": periods})

    def test_a_plan_that_ends_well_leaves_who_joined_its_world_at_rest_too(self):
        self.thymio()  # the guest
        world = self.write("here.world.json", {"format": "vagus-world/1", "name": "Here", "size": [2, 2], "robots": [
            {"name": "thymio", "type": "thymio2", "at": [1, 1], "node": 9, "script": "here.aesl"}]})
        project = self.write("here.aesl", WHEELS.replace('nodeId="1"', 'nodeId="9"').replace(
            '<event size="1" name="wheels"/>', '<event size="1" name="wheels"/><event size="0" name="over"/>'))
        plan = self.write("short.plan.json", {
            "format": "vagus-plan/1", "name": "Short", "start": {"actor": "hear"}, "actors": {
                "hear": {"template": "Receive", "in": {"event": "'over'"}, "states": {"Received": "@terminate"}}}})
        with vagus("plan", "run", plan, "--world", world, "--headless", "--listen", "tcp:127.0.0.1:0") as program:
            joined = f"tcp:127.0.0.1:{listening(program)}"
            self.enterContext(vagus("switch", "--listen", "tcp:127.0.0.1:0", joined, self.target))
            wait_until("the guest never joined", lambda: "1  thymio-II" in run_vagus("net", joined, "list"))
            run_vagus("net", self.target, "set", "1", "motor.left.target", "100", "--leave")
            run_vagus("net", joined, "--project", project, "emit", "over")
            self.assertEqual(program.wait_end(), 0, program.lines)
            self.assertIn("the nodes that had joined this bus were made safe; at rest: thymio-II (1)", "\n".join(program.lines))
        wait_until("the guest never left", lambda: "9  thymio" not in run_vagus("net", self.target, "list"))
        self.assertEqual(self.targets(), [0, 0])
        self.assertIn("running", run_vagus("net", self.target, "list"))

    # net -----------------------------------------------------------------------------------------

    def test_net_set_of_a_driving_variable_lasts_until_a_signal(self):
        self.thymio()
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.subTest(number), vagus("net", self.target, "set", "thymio-II", "motor.left.target", "100") as program:
                program.wait_line("is driven by hand as long as this command runs")
                self.assertEqual(self.targets(), [100, 0])
                program.signal(number)
                self.assertEqual(program.wait_end(), 0, program.lines)
                self.assertIn("at rest: thymio-II (1)", program.lines)
                self.assertEqual(self.targets(), [0, 0])

    def test_net_set_of_what_does_not_drive_returns(self):
        self.thymio()
        for words in (["motor.left.target", "0"], ["timer.period", "9"], ["motor.left.target", "80", "--leave"]):
            run_vagus("net", self.target, "set", "thymio-II", *words)
        self.assertEqual(self.targets(), [80, 0])

    def test_net_pause_of_a_sensor_brakes_what_moves(self):
        script = self.folder / "carbot.aesl"
        shutil.copy(EXAMPLES / "carbot/carbot.aesl", script)
        self.simulate("carbot", script)
        for verb in ("pause", "reset", "stop"):
            with self.subTest(verb):
                said = run_vagus("net", self.target, verb, "2")
                self.assertIn("paused too, and made safe: drive (1)", said)
                self.assertRegex(run_vagus("net", self.target, "list"), r"1  drive +paused[^\n]*\n2  bumper +paused")
                run_vagus("net", self.target, "run", "all")
        self.assertNotIn("made safe", run_vagus("net", self.target, "pause", "all"))

    def test_net_stop_reads_back_and_fails_if_a_node_still_moves(self):
        self.thymio()
        run_vagus("net", self.target, "set", "thymio-II", "motor.left.target", "100", "--leave")
        self.assertEqual(run_vagus("net", self.target, "stop", "all"), "1  thymio-II  paused  protocol 5  program unknown")
        self.assertEqual(self.targets(), [0, 0])
        project = self.write("vagus.json", {"format": "vagus-project/1", "safe_stop": {"thymio-II": {"read": ["temperature"]}}})
        said = run_vagus("net", self.target, "--project", self.script, "stop", "all", "--wait", "0.5", status=1)
        self.assertIn('node 1 "thymio-II" still moves', said)
        project.unlink()


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + [f"Rest.{name}" for name in sys.argv[1:]], verbosity=2)
