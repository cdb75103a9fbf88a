"""Runs of plans as processes: how signals end them, two of them on one bus, several robots of which one is meant."""
import json
import os
import pathlib
import shutil
import signal
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import VAGUS, Program, listening, run_vagus, vagus

EXAMPLES = pathlib.Path(__file__).resolve().parent.parent.parent / "examples"
DRIVE_PROGRAM = os.environ.get("VAGUS_DRIVE_PROGRAM", "")
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)

WAIT = {"format": "vagus-plan/1", "name": "Idle", "start": {"actor": "idle"}, "actors": {"idle": {"template": "WaitForever"}}}
# Ten metres ahead, watching the bumper.
DRIVE = {
    "format": "vagus-plan/1", "name": "Drive", "toolboxes": ["drive"],
    "start": {"actor": "ahead"},
    "actors": {"ahead": {
        "template": "Forward", "in": {"distance": 1000}, "states": {"ForwardSuccessful": "@terminate"},
        "supervisors": {"touch": {"template": "CheckTouchSensor", "events": {"TouchSensorPressed": "@terminate"}}}}},
}


def carbot(name, node, y):
    return {"name": name, "type": "carbot", "at": [1, y], "node": node, "script": "carbot.aesl"}


def hall(*robots):
    return {"format": "vagus-world/1", "name": "Hall", "size": [12, 2 + len(robots)], "robots": list(robots)}


class Runs(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-runs-")))
        self.script = self.folder / "carbot.aesl"
        shutil.copy(EXAMPLES / "carbot/carbot.aesl", self.script)
        self.world = self.write("hall.world.json", hall(carbot("carbot", 1, 1)))
        self.drive = self.write("drive.plan.json", DRIVE)
        self.trace = self.folder / "trace.jsonl"

    def write(self, name, content):
        path = self.folder / name
        path.write_text(content if isinstance(content, str) else json.dumps(content), encoding="utf-8")
        return path

    def simulation(self, world):
        """A world in a process of its own: the program, and where its bus listens."""
        program = self.enterContext(vagus("sim", world, "--headless", "--duration", "3600", "--trace", "-",
                                          "--listen", "tcp:127.0.0.1:0"))
        return program, f"tcp:127.0.0.1:{listening(program)}"

    def assert_aborted(self, program, lines):
        """The plan ended as by an abort: P28."""
        self.assertEqual(program.wait_end(), 3, program.lines)
        last = [json.loads(line) for line in lines() if line.startswith("{")][-1]
        self.assertEqual((last["kind"], last["result"]), ("plan-end", "Interrupted"))
        self.assertFalse([line for line in lines() if '"kind":"event","supervisor"' in line])

    def wait_for_start(self, program):
        program.wait_line(r'"kind":"actor-start"')

    def traced(self):
        return self.trace.read_text(encoding="utf-8").splitlines()


class Signals(Runs):
    """The first is an abort: actors and supervisors are told to stop, the trace ends with plan-end, exit status 3."""

    def test_a_plan_alone(self):
        plan = self.write("idle.plan.json", WAIT)
        for number in SIGNALS:
            with self.subTest(number), vagus("plan", "run", plan, "--quiet", "--trace", "-") as program:
                self.wait_for_start(program)
                program.signal(number)
                self.assert_aborted(program, lambda: program.lines)

    def test_beside_a_world(self):
        for number in SIGNALS:
            for command in ([VAGUS, "plan", "run", self.drive, "--quiet"], [DRIVE_PROGRAM]):
                with self.subTest(number, command=command), \
                        Program(*command, "--world", self.world, "--trace-all", self.trace, "--trace", "-") as program:
                    self.wait_for_start(program)
                    program.signal(number)
                    self.assert_aborted(program, self.traced)
                    self.assertEqual(sorted(self.host_events(self.traced())[-2:]), ["drive.stop", "touch.unwatch"])

    def host_events(self, lines):
        """What the plan said to its nodes, but for its signs of life."""
        events = [json.loads(line) for line in lines if '"kind":"event","node":0,' in line]
        return [one["name"] for one in events if one["name"] != "drive.alive"]

    def test_on_a_bus(self):
        simulation, target = self.simulation(self.world)
        for number in SIGNALS:
            for command in ([VAGUS, "plan", "run", self.drive, "--quiet"], [DRIVE_PROGRAM]):
                with self.subTest(number, command=command), \
                        Program(*command, "--bus", target, "--project", self.script, "--trace", "-") as program:
                    self.wait_for_start(program)
                    simulation.wait_line(r'"node":0,"name":"drive\.forward"')
                    program.signal(number)
                    # The robot has heard it before the process is gone. Its script was stopped: it does not answer.
                    simulation.wait_lines(r'"node":0,"name":"drive\.stop"', r'"node":0,"name":"touch\.unwatch"')
                    self.assert_aborted(program, lambda: program.lines)

    def test_an_actor_that_does_not_stop_gives_4(self):
        plan = self.write("stubborn.plan.json", {
            "format": "vagus-plan/1", "name": "Stubborn", "start": {"actor": "a"},
            "actors": {"a": {"template": "Stubborn", "in": {"seconds": 1000, "linger": 3}, "states": {"Done": "@terminate"}}}})
        with vagus("plan", "run", plan, "--trace", "-") as program:
            self.wait_for_start(program)
            program.signal(signal.SIGTERM)
            self.assertEqual(program.wait_end(), 4)
            last = [json.loads(line) for line in program.lines if line.startswith("{")][-1]
            self.assertEqual((last["kind"], last["result"]), ("plan-end", "Error"))

    def test_a_second_one_ends_it_at_once(self):
        plan = self.write("stubborn.plan.json", {
            "format": "vagus-plan/1", "name": "Stubborn", "start": {"actor": "a"},
            "actors": {"a": {"template": "Stubborn", "in": {"seconds": 1000, "linger": 1000}, "states": {"Done": "@terminate"}}}})
        for number in SIGNALS:
            with self.subTest(number), vagus("plan", "run", plan, "--trace", "-") as program:
                self.wait_for_start(program)
                program.signal(number)
                program.wait_line(r'"kind":"plan-end","result":"Error"')  # after its grace time; it still lingers
                program.signal(number)
                self.assertEqual(program.wait_end(), -number)

    def test_in_virtual_time_too(self):
        # A loop of activations that lasts for a simulated age.
        plan = self.write("loop.plan.json", {
            "format": "vagus-plan/1", "name": "Loop", "start": {"actor": "a"},
            "actors": {"a": {"template": "Wait", "in": {"seconds": 0.001}, "states": {"Done": "a"}}}})
        with vagus("plan", "run", plan, "--clock", "virtual", "--trace", self.trace) as program:
            while not self.trace.exists() or self.trace.stat().st_size == 0:
                self.assertTrue(program.running())
            program.signal(signal.SIGINT)
            self.assert_aborted(program, self.traced)

    def test_in_the_debugger_the_first_ctrl_c_pauses_and_the_end_aborts(self):
        plan = self.write("idle.plan.json", WAIT)
        with vagus("plan", "debug", plan, typing=True) as program:
            program.type("trace on")
            program.type("run")
            self.wait_for_start(program)
            program.signal(signal.SIGINT)
            program.wait_line(r"^paused at ")
            program.type("where")
            program.wait_line("idle")
            program.signal(signal.SIGTERM)
            self.assertEqual(program.wait_end(), 3, program.lines)
            self.assertIn('"kind":"plan-end","result":"Interrupted"', program.lines[-1])


class TwoPlans(Runs):
    """On one bus, in two processes."""

    def test_plans_for_different_nodes_run_to_their_ends(self):
        # One drives, one looks around: the tokens of both began at 1 once, and each ended the other's actors.
        look = self.write("look.plan.json", {
            "format": "vagus-plan/1", "name": "Look", "toolboxes": ["carbot"],
            "configuration": {"n": {"type": "int", "initial": 0}},
            "start": {"actor": "measure"},
            "actors": {
                "measure": {"template": "MeasureDistance", "states": {"Measured": "again"}},
                "again": {"template": "For", "in": {"counter": "n", "last": 20}, "out": {"counter": "n"},
                          "states": {"Loop": "measure", "Done": "@terminate"}}}})
        drive = self.write("short.plan.json", json.dumps(DRIVE).replace("1000", "30"))
        _, target = self.simulation(self.world)
        words = ["--bus", target, "--project", self.script, "--trace", "-"]
        with vagus("plan", "run", drive, *words) as one, vagus("plan", "run", look, *words) as other:
            self.assertEqual((one.wait_end(), other.wait_end()), (0, 0), one.lines + other.lines)
            self.assertNotIn("commands the same nodes", "\n".join(one.lines + other.lines))

    def test_one_whose_robot_another_plan_takes_ends_with_an_error_that_says_so(self):
        _, target = self.simulation(self.world)
        words = ["--bus", target, "--project", self.script]
        with vagus("plan", "run", self.drive, *words, "--trace", "-") as first:
            self.wait_for_start(first)
            # The second does not know who drives: it stops the robot first.
            short = self.write("short.plan.json", json.dumps(DRIVE).replace("1000", "5"))
            with vagus("plan", "run", short, *words) as second:
                second.wait_line("was moving: it was stopped before the plan begins; at rest: ")
                first.wait_line('the node "drive" has ended the work by itself')
                self.assertEqual(first.wait_end(), 4, first.lines)
                # The end of the first stops the robot, perhaps before the second has driven so far.
                status = second.wait_end()
                said = "\n".join(second.lines)
                self.assertIn(status, (0, 4), said)
                if status == 4:
                    self.assertRegex(said, 'the node "drive".* was stopped by somebody else|has ended the work by itself')

    def test_one_whose_nodes_somebody_stops_ends_with_an_error_that_names_a_node(self):
        def plan(supervised, actors):
            start = {"actor": next(iter(actors)), "supervisors": supervised}
            return {"format": "vagus-plan/1", "name": "Stopped", "toolboxes": ["drive"], "start": start, "actors": actors}

        touch = {"touch": {"template": "CheckTouchSensor", "events": {"TouchSensorPressed": "@terminate"}}}
        drives = {"template": "Forward", "in": {"distance": 1000}, "states": {"ForwardSuccessful": "@terminate"}}
        # While it drives; while nothing but a supervisor works there; while an actor waits that works on no node.
        rests = {"rest": {"template": "WaitForever"}}
        for verb, supervised, actors, node in (
                ("stop", {}, {"ahead": drives}, "drive"),
                ("stop", touch, rests, "bumper"),
                ("stop", {}, {"look": {"template": "Receive", "in": {"event": "'touched'"}, "states": {"Received": "ahead"}},
                              "ahead": drives}, "drive"),
                # Paused before the first line, which nobody lets run.
                ("reset", {}, {"ahead": drives}, "drive"),
                ("reset", touch, rests, "bumper")):
            with self.subTest(verb=verb, actors=actors):
                _, target = self.simulation(self.world)
                path = self.write("stopped.plan.json", plan(supervised, actors))
                with vagus("plan", "run", path, "--bus", target, "--project", self.script, "--trace", "-") as program:
                    self.wait_for_start(program)
                    run_vagus("net", target, verb, "all")
                    self.assertEqual(program.wait_end(), 4, program.lines)
                    self.assertIn(f'the node "{node}", which does the work, was stopped by somebody else',
                                  "\n".join(program.lines))


class ManyRobots(Runs):
    """A plan is for one robot."""

    def setUp(self):
        super().setUp()
        self.two = self.write("two.world.json", hall(carbot("left", 1, 1), carbot("right", 5, 3)))

    def test_of_two_candidates_one_must_be_chosen(self):
        for command in ([VAGUS, "plan", "run", self.drive], [DRIVE_PROGRAM], [VAGUS, "plan", "debug", self.drive]):
            with self.subTest(command), Program(*command, "--world", self.two, "--clock", "virtual") as program:
                self.assertEqual(program.wait_end(), 2)
                self.assertRegex("\n".join(program.lines), r"could drive 2 robots of .*two\.world\.json: left and right; "
                                                           r"choose one, as --robot left")

    def test_a_robot_that_is_not_there_or_lacks_a_node_is_refused(self):
        words = ["plan", "run", self.drive, "--clock", "virtual"]
        self.assertIn("did you mean right?", run_vagus(*words, "--world", self.two, "--robot", "rihgt", status=2))
        mixed = self.write("mixed.world.json", hall(
            carbot("carbot", 1, 1), {"name": "puck", "type": "epuck", "at": [3, 1], "node": 9}))
        self.assertIn('the plan needs a node "bumper", and that robot has only e-puck8',
                      run_vagus(*words, "--world", mixed, "--robot", "puck", status=2).replace('"drive"', '"bumper"'))
        self.assertIn("--robot goes with --world", run_vagus(*words, "--robot", "left", status=2))

    def test_only_the_chosen_one_drives(self):
        for robot, other in (("left", "right"), ("right", "left")):
            run_vagus("plan", "run", self.drive, "--world", self.two, "--robot", robot, "--clock", "virtual", "--max-time",
                      "3", "--trace-all", self.trace, status=5)
            poses = [json.loads(line) for line in self.traced() if '"kind":"pose"' in line]
            last = {one["robot"]: one["x"] for one in poses}
            self.assertGreater(last[robot], 1.3)
            self.assertAlmostEqual(last[other], 1.0, places=3)

    def test_a_single_candidate_needs_no_choice(self):
        mixed = self.write("mixed.world.json", hall(
            carbot("carbot", 1, 1), {"name": "puck", "type": "epuck", "at": [3, 3], "node": 9}))
        run_vagus("plan", "run", self.drive, "--world", mixed, "--clock", "virtual", "--max-time", "1", status=5)

    def test_two_robots_on_one_bus_are_refused(self):
        _, target = self.simulation(self.two)
        said = run_vagus("plan", "run", self.drive, "--bus", target, "--project", self.script, status=2)
        self.assertRegex(said, r'the plan needs one node "drive", but on tcp:\S+ there are 2, with the ids 1 and 5; a plan is '
                               r"for one robot, and a robot has a bus of its own")


class BesideAWorld(Runs):
    """Before, during and after a run in a world: what is missing, who may join, what was saved, where the robot stands."""

    def test_events_that_the_scripts_lack_are_found_before_the_run(self):
        lacking = self.script.read_text(encoding="utf-8").replace('name="touch.watch"', 'name="touch.wach"') \
            .replace("touch.watch", "touch.wach")
        self.write("carbot.aesl", lacking)
        pretty = self.write("drive.plan.json", json.dumps(DRIVE, indent=1))
        line = 1 + next(i for i, text in enumerate(pretty.read_text().splitlines()) if "CheckTouchSensor" in text)
        expected = rf'drive\.plan\.json:{line}:\d+: error: touch: the template CheckTouchSensor works by events, and the event ' \
                   r'"touch\.watch" has no number: .*did you mean "touch\.wach"\?'
        for where in (["--world", self.world], ["--project", self.script]):
            self.assertRegex(run_vagus("plan", "check", pretty, *where, status=2), expected)
            found = json.loads(run_vagus("plan", "check", pretty, *where, "--json", status=2))
            self.assertEqual([(one["element"], one["line"]) for one in found], [("touch", line)])
        self.assertRegex(run_vagus("plan", "run", pretty, "--world", self.world, "--clock", "virtual", status=2), expected)

    def test_check_finds_nothing_where_all_is_there(self):
        for where in (["--world", self.world], ["--project", self.script]):
            self.assertEqual(run_vagus("plan", "check", self.drive, *where), "")

    def test_others_can_join_its_bus(self):
        with vagus("plan", "run", self.drive, "--world", self.world, "--headless", "--listen", "tcp:127.0.0.1:0") as program:
            target = f"tcp:127.0.0.1:{listening(program)}"
            self.assertIn("bumper", run_vagus("net", target, "list"))
            program.signal(signal.SIGTERM)
            self.assertEqual(program.wait_end(), 3)
        said = run_vagus("plan", "run", self.drive, "--world", self.world, "--clock", "virtual", "--listen", "tcp:127.0.0.1:0",
                         status=2)
        self.assertIn("--listen with --clock virtual", said)

    def test_it_starts_anew_when_a_file_is_saved(self):
        drive = self.write("short.plan.json", json.dumps(DRIVE).replace("1000", "1"))
        with vagus("plan", "run", drive, "--world", self.world, "--headless", "--watch") as program:
            program.wait_line("the plan is over")
            self.write("short.plan.json", json.dumps(DRIVE).replace("@terminate", "nowhere"))
            program.wait_line(r"short\.plan\.json was saved: the plan starts again")
            program.wait_line(r"short\.plan\.json:1:\d+: error: .*nowhere")
            self.write("short.plan.json", json.dumps(DRIVE))
            program.wait_line("was saved")
            program.wait_line("ahead")
            # It drives; now the script that its robot runs is saved.
            self.script.write_text(self.script.read_text(encoding="utf-8") + "\n", encoding="utf-8")
            program.wait_line(r"Interrupted")
            program.wait_line(r"carbot\.aesl was saved")
            program.signal(signal.SIGTERM)
            self.assertEqual(program.wait_end(), 3)

    def test_the_debugger_says_where_the_robot_stands(self):
        with vagus("plan", "debug", self.drive, "--world", self.world, "--clock", "virtual", typing=True) as program:
            for line in ("pause 0.000001", "run", "where", "quit"):
                program.type(line)
            self.assertEqual(program.wait_end(), 3)
            self.assertEqual(program.lines.count("carbot is at 1.00, 1.00 m, 0 deg"), 2, program.lines)


if __name__ == "__main__":
    classes = {name: one.__name__ for one in (Signals, TwoPlans, ManyRobots, BesideAWorld) for name in vars(one)}
    unittest.main(argv=[sys.argv[0]] + [f"{classes[name]}.{name}" for name in sys.argv[1:]], verbosity=2)
