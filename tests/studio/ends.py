"""Every end of a run leaves a robot that stands: a Carbot driven by a plan, a Thymio driven by its script, on a bus; ended by whoever
and whatever can end it."""
import json
import os
import shutil
import signal
import sys
import tempfile
import unittest

import projects
from cases import Case
from field import Served
from harness import ROOT, free_port, listening, patiently, run_vagus, simulated, vagus

POLLS = 200  # of a variable until it is 0, at most
# One long way. `fail`: after a second of it the plan ends in an error.
DRIVE = {"format": "vagus-plan/1", "name": "Far", "toolboxes": ["drive"], "start": {"actor": "go"},
         "actors": {"go": {"template": "Forward", "in": {"distance": 3000, "speed": 25}, "states": {"ForwardSuccessful": "@terminate"}}}}
FAIL = {**DRIVE,
        "actors": {"go": {**DRIVE["actors"]["go"], "supervisors": {"soon": {"template": "Timeout", "in": {"seconds": 1}, "events": {"Timeout": "fail"}}}},
                   "fail": {"template": "Fail", "in": {"message": "'it is broken'"}, "states": {}}}}
# It looks again and again; nothing works but a supervisor.
LOOK = {**DRIVE, "name": "Look", "toolboxes": ["carbot"], "start": {"actor": "measure"},
        "actors": {"measure": {"template": "MeasureDistance", "states": {"Measured": "measure"}}}}
WATCH = {**DRIVE, "name": "Watch",
         "start": {"actor": "rest", "supervisors": {"touch": {"template": "CheckTouchSensor", "events": {"TouchSensorPressed": "@terminate"}}}},
         "actors": {"rest": {"template": "WaitForever"}}}
THYMIO = "motor.left.target = 150\nmotor.right.target = 150\n\nonevent go\n\nonevent timer0\n"


def carbot_world(folder):
    """An empty hall in which it can drive for minutes."""
    shutil.copy(ROOT / "examples/carbot/carbot.aesl", folder)
    return projects.write(folder, "hall.world.json", {
        "format": "vagus-world/1", "name": "Hall", "size": [60, 4],
        "robots": [{"name": "carbot", "type": "carbot", "at": [1, 2], "script": "carbot.aesl"}]})


class Ends(Case):
    def simulate(self, *arguments):
        """A robot on a bus of its own: its target."""
        self.robot_program = self.enterContext(vagus("sim", *arguments, "--headless", "--duration", 3600, "--listen", "tcp:127.0.0.1:0"))
        self.target = f"tcp:127.0.0.1:{listening(self.robot_program)}"

    def carbot(self, plan=DRIVE):
        world = carbot_world(self.arena())
        self.simulate(world)
        self.watched = ("drive", "wheel.front.speed")

        def make(folder):
            folder.mkdir(exist_ok=True)
            shutil.copy(ROOT / "examples/carbot/carbot.aesl", folder)
            projects.write(folder, "far.plan.json", plan)
            projects.write(folder, "vagus.json", {"format": "vagus-project/1", "name": "Far", "scripts": ["carbot.aesl"],
                                                  "plan": "far.plan.json", "target": self.target})
        return make

    def thymio(self):
        self.robot_program = self.enterContext(simulated(self.arena(), {"name": "alice", "node": 1}))
        self.target = f"tcp:127.0.0.1:{listening(self.robot_program)}"
        self.watched = ("thymio-II", "motor.left.target")
        return lambda folder: projects.bus(folder, self.target, name="thymio-II", script=THYMIO)

    def arena(self):
        import pathlib
        return pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-arena-")))

    def value(self):
        node, name = self.watched
        return json.loads(run_vagus("net", self.target, "get", node, name, "--json"))[name][0]

    def drives(self):
        for _ in patiently():
            if self.value() > 50:
                return
        self.fail("it never drove")

    def stands(self):
        """It comes to rest, and stays so."""
        zeros = 0
        for _ in range(POLLS):
            zeros = zeros + 1 if self.value() == 0 else 0
            if zeros == 3:
                return
        self.fail(f"{self.watched} never came to 0; it is {self.value()}")

    def start(self, make):
        self.open(make)
        self.end = self.page.watch("end", rate=60)
        self.wait_all_described()
        self.page.do("run.start")
        self.drives()

    def wait_all_described(self):
        nodes = 1 if self.watched[0] == "thymio-II" else 4  # drive, range, bumper, head
        self.wait(lambda: len([node for node in self.robot.value["nodes"] if node["described"]]) >= nodes, "the nodes")

    def expect_end(self, why, **fields):
        self.wait(lambda: self.end.value and self.end.value.get("end") and self.end.value["end"]["why"] == why, f"an end by {why}")
        end = self.end.value["end"]
        for name, value in fields.items():
            self.assertEqual(end.get(name), value, end)
        self.assertFalse(self.end.value["open"], end)
        self.assertTrue(end["nodes"] and all(node["state"] == "stopped" for node in end["nodes"]), end)

    def end_by_signals(self, make):
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            with self.subTest(signal=number.name):
                self.start(make)
                self.studio.program.signal(number)
                self.assertEqual(self.studio.program.wait_end(), 0)
                self.stands()

    def end_by_commands(self, make):
        for command, why in (("stop", "stop"), ("target.leave", "target"), ("project.close", "project")):
            with self.subTest(command=command):
                self.start(make)
                answer = self.page.do(command)
                if command == "stop":
                    self.assertEqual(answer["stood"], [node["node"] for node in answer["nodes"]])
                self.expect_end(why)
                self.stands()

    # a plan ---------------------------------------------------------------------------------------

    def test_carbot_stands_after_signals_to_the_studio(self):
        self.end_by_signals(self.carbot())

    def test_carbot_stands_after_commands(self):
        self.end_by_commands(self.carbot())
        self.assertEqual(self.end.value["end"]["result"], "Interrupted")

    def test_carbot_stands_when_its_run_is_killed(self):
        self.start(self.carbot())
        (run,) = self.studio.children()
        os.kill(run, signal.SIGKILL)
        self.expect_end("died", result="Error")
        self.stands()

    def run_plan(self, plan):
        self.open(self.carbot(plan))
        self.wait_all_described()
        self.page.do("run.start")
        self.wait(lambda: self.plan.value["state"] == "running" and self.plan.value["levels"], "the plan")

    def test_a_node_that_another_host_resets_ends_the_plan(self):
        self.run_plan(WATCH)
        run_vagus("net", self.target, "reset", "bumper")
        self.wait(lambda: self.plan.value["state"] == "ended", "the end of the plan")
        self.assertEqual(self.plan.value["result"], "Error")
        self.assertIn('the node "bumper", which does the work, was stopped by somebody else', self.plan.value["message"])

    def test_a_plan_waits_for_a_node_that_a_page_debugs(self):
        self.run_plan(LOOK)
        (node,) = [one["id"] for one in self.robot.value["nodes"] if one["name"] == "range"]
        self.page.do("node.pause", node=node)
        self.wait_passed(5)  # longer than one that another host has stopped is waited for
        self.assertEqual(self.plan.value["state"], "running", self.plan.value)
        self.page.do("node.run", node=node)
        self.wait_passed(1)
        self.assertEqual(self.plan.value["state"], "running", self.plan.value)
        self.page.do("stop")
        self.wait(lambda: self.plan.value["state"] == "ended", "the end of the plan")
        self.assertEqual(self.plan.value["result"], "Interrupted")

    def test_carbot_stands_when_its_plan_fails(self):
        self.start(self.carbot(FAIL))
        self.expect_end("error", result="Error")
        self.assertIn("it is broken", self.end.value["end"]["message"])
        self.stands()

    # a script -------------------------------------------------------------------------------------

    def test_a_thymio_stands_after_signals_to_the_studio(self):
        self.end_by_signals(self.thymio())

    def test_a_thymio_stands_after_commands(self):
        self.end_by_commands(self.thymio())

    # nobody watches -------------------------------------------------------------------------------

    def serve(self, make):
        folder = self.arena() / "robot"
        folder.mkdir()
        make(folder)
        self.studio = self.enterContext(Served(folder, "--start"))
        self.served = folder
        self.drives()

    def test_a_robot_that_serves_itself_stands_after_signals(self):
        make = self.carbot()
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            with self.subTest(signal=number.name):
                self.serve(make)
                self.studio.program.signal(number)
                self.assertEqual(self.studio.program.wait_end(), 0)
                self.stands()

    def test_a_server_that_was_killed_is_followed_by_one_that_only_stops(self):
        self.serve(self.thymio())
        self.studio.program.kill()
        said = run_vagus("serve", self.served, "--stop-only")
        self.assertIn(f"{self.target}: stopped", said)
        self.stands()

    def test_stop_only_says_what_it_cannot_reach(self):
        folder = projects.bus(self.arena(), f"tcp:127.0.0.1:{free_port()}")
        self.assertIn("not reached", run_vagus("serve", folder, "--stop-only", status=1))

    def test_the_last_page_that_closes_stops_a_robot_that_is_not_to_work_alone(self):
        make = self.thymio()

        def not_alone(folder):
            make(folder)
            project = json.loads((folder / "vagus.json").read_text(encoding="utf-8"))
            projects.write(folder, "vagus.json", {**project, "when_alone": "stop"})

        self.start(not_alone)
        self.page.close()
        self.stands()

    def test_who_only_looks_stops_nothing(self):
        """A robot that drives by itself goes on, whoever comes and goes."""
        make = self.thymio()
        aesl = self.arena() / "robot.aesl"
        aesl.write_text(projects.AESL.format(node=1, name="thymio-II", script=THYMIO), encoding="utf-8")
        run_vagus("net", self.target, "load", aesl)
        self.drives()
        self.open(make)
        self.wait_all_described()
        self.page.do("target.leave")
        self.assertEqual(self.value(), 150)
        self.studio.program.signal(signal.SIGTERM)
        self.studio.program.wait_end()
        self.assertEqual(self.value(), 150)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:] or ["Ends"])], verbosity=2, warnings="ignore")
