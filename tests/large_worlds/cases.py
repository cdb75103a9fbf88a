"""Worlds of many robots, some with projects of their own, run by `vagus sim` in virtual time without a broker."""
import json
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import ROOT, run_vagus

ALARM = ROOT / "examples/alarm/class.world.json"
WAREHOUSE = ROOT / "examples/warehouse/hall.world.json"
PLAN = {
    "format": "vagus-plan/1", "name": "Ask",
    "start": {"actor": "ask"},
    "actors": {
        "ask": {"template": "Send", "in": {"event": "'go'"}, "states": {"Sent": "hear"}},
        "hear": {"template": "Receive", "in": {"event": "'gone'"}, "states": {"Received": "@terminate"}},
    },
}
FAILING = {
    "format": "vagus-plan/1", "name": "Fails", "start": {"actor": "fail"},
    "actors": {"fail": {"template": "Fail", "in": {"message": "'no way'"}}},
}
SCRIPT = """<network>
<event size="0" name="go"/>
<event size="0" name="gone"/>
<node nodeId="1" name="thymio-II">onevent go
emit gone
</node></network>
"""


def sim(world, *more, status=0):
    return run_vagus("sim", world, "--headless", "--speed", "max", *more, status=status)


def lines_of(trace):
    return [json.loads(line) for line in trace.read_text().splitlines()]


class LargeWorlds(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-worlds-")))

    def write(self, name, content):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content if isinstance(content, str) else json.dumps(content, indent=2))
        return path

    def project(self, name, plan=PLAN, **more):
        self.write(f"{name}/p.plan.json", plan)
        self.write(f"{name}/s.aesl", SCRIPT)
        self.write(f"{name}/vagus.json",
                   {"format": "vagus-project/1", "plan": "p.plan.json", "scripts": ["s.aesl"], **more})

    def world(self, *robots, **more):
        return self.write("w.world.json", {"format": "vagus-world/1", "size": [9, 9], "robots": list(robots), **more})

    def trace_of(self, world, name, *more):
        trace = self.folder / name
        sim(world, "--trace", trace, *more)
        return trace

    # Who meets the line says so to its fleet; each of the other 29 runs `onevent alarm` once, and all stand.
    def test_one_of_thirty_meets_a_line_and_warns_all_others_the_same_way_each_time(self):
        first = self.trace_of(ALARM, "first.jsonl", "--duration", "10")
        second = self.trace_of(ALARM, "second.jsonl", "--duration", "10")
        self.assertTrue(first.read_bytes() == second.read_bytes(), "the second run gave other bytes")
        everybody = {f"t{number}" for number in range(1, 31)}
        events = [line for line in lines_of(first) if line["kind"] == "event"]
        alarms = [line for line in events if line["name"] == "alarm" and line["node"] == 1]
        self.assertEqual(len(alarms), 1, alarms)
        finder, at = alarms[0]["robot"], alarms[0]["t"]
        passed_on = [line for line in events if line["name"] == "alarm" and line["node"] == 0]
        self.assertEqual(sorted(line["robot"] for line in passed_on), sorted(everybody - {finder}))
        ran = {line["robot"]: line["t"] for line in events if line["name"] == "safe"}
        self.assertEqual(set(ran), everybody)
        for robot, when in ran.items():
            # Two ways of 5 to 25 ms each, and a millisecond or two at either end.
            if robot != finder:
                self.assertGreater(when, at + 0.010)
                self.assertLess(when, at + 0.060)
        last = {line["robot"]: line for line in lines_of(first) if line["kind"] == "pose" and line["t"] > 9.85}
        before = {line["robot"]: line for line in lines_of(first) if line["kind"] == "pose" and 8.85 < line["t"] < 8.95}
        self.assertEqual(set(last), everybody)
        for robot in everybody:
            self.assertEqual(last[robot]["x"], before[robot]["x"], robot)

    def test_another_seed_is_another_run(self):
        one = self.trace_of(ALARM, "one.jsonl", "--duration", "10")
        other = self.trace_of(ALARM, "other.jsonl", "--duration", "10", "--seed", "7")
        self.assertTrue(one.read_bytes() != other.read_bytes(), "both seeds gave the same bytes")

    # Node 1 is there three times: each plan hears its own only.
    def test_each_robot_has_its_bus_and_its_plan_and_the_end_of_each_is_said(self):
        self.project("asks")
        world = self.world({"name": "a", "type": "thymio2", "at": [1, 1], "project": "asks"},
                           {"name": "b", "type": "thymio2", "at": [2, 1], "project": "asks/vagus.json"},
                           {"name": "c", "type": "thymio2", "at": [3, 1]})
        trace = self.folder / "t.jsonl"
        said = sim(world, "--duration", "1", "--trace", trace)
        for robot in "ab":
            self.assertIn(f"plan  {robot}: the plan Ask has ended (OK)", said)
            ends = [line for line in lines_of(trace) if line["kind"] == "plan-end" and line["robot"] == robot]
            self.assertEqual([line["result"] for line in ends], ["OK"])
        self.assertFalse([line for line in lines_of(trace) if line["kind"] == "event" and "robot" not in line])

    def test_a_plan_that_ends_with_an_error_is_said_and_is_the_exit_status(self):
        self.project("fails", plan=FAILING)
        world = self.world({"name": "a", "type": "thymio2", "at": [1, 1], "project": "fails"})
        self.assertIn("a: the plan Fails has ended (Error): ", sim(world, "--duration", "1", status=1))

    def test_what_is_wrong_names_the_file_the_robot_and_the_fix(self):
        cases = {
            "w.world.json:": {"project": "none"},
            "robots[0].project: ": {"project": "none"},
            "write \"grid\"": {"spacing": 0.3},
        }
        for says, more in cases.items():
            self.assertIn(says, sim(self.world({"name": "a", "type": "thymio2", "at": [1, 1], **more}), status=2))
        self.project("broken", plan={**PLAN, "start": {"actor": "nobody"}})
        said = sim(self.world({"name": "a", "type": "thymio2", "at": [1, 1], "project": "broken"}), status=2)
        self.assertIn("robot a: ", said)
        self.assertIn("p.plan.json:", said)

    # A hundred robots in a line of text, on the common bus: a second is a line.
    def test_a_grid_of_a_hundred_is_told_in_one_line_a_second(self):
        self.write("spin.aesl", "motor.left.target = 100\nmotor.right.target = -100\n")
        world = self.world({"name": "t", "type": "thymio2", "at": [0.5, 0.5], "grid": [10, 10], "spacing": 0.5,
                            "script": "spin.aesl"})
        self.assertIn("100 robots  100 moving  0 at rest  100 running a script  0 stopped by a fault",
                      sim(world, "--duration", "3"))

    def test_other_commands_say_that_such_robots_stand_still(self):
        self.project("asks")
        world = self.world({"name": "a", "type": "thymio2", "at": [1, 1], "project": "asks"})
        plan = self.write("wait.plan.json", {"format": "vagus-plan/1", "name": "W", "start": {"actor": "w"},
                                             "actors": {"w": {"template": "Wait", "in": {"seconds": 1},
                                                              "states": {"Done": "@terminate"}}}})
        said = run_vagus("plan", "run", plan, "--world", world, "--clock", "virtual")
        self.assertIn("1 robot with a project of its own stands still here; `vagus sim` runs", said)

    # ---- tasks and names of a fleet ----

    def warehouse(self, *more, duration=700, timeline=()):
        """A run of the warehouse; gives the lines of its trace."""
        world = WAREHOUSE
        if timeline:
            content = json.loads(WAREHOUSE.read_text())
            for robot in content["robots"]:
                robot["project"] = str(WAREHOUSE.parent / robot["project"])
            world = self.write("w.world.json", {**content, "timeline": list(timeline)})
        trace = self.folder / "warehouse.jsonl"
        sim(world, "--duration", duration, "--trace", trace, *more)
        self.trace = trace.read_bytes()
        return lines_of(trace)

    @staticmethod
    def ended(lines, actor):
        return [line for line in lines if line["kind"] == "actor-end" and line["actor"] == actor]

    @staticmethod
    def most_in_one_aisle(lines):
        """Shelves end 3 m from the wall; aisles are 1.4 m apart. The most robots that were in one at a time."""
        most, at, inside = 0, None, {}
        for line in lines:
            if line["kind"] != "pose":
                continue
            if line["t"] != at:
                at, inside = line["t"], {}
            if line["y"] > 3.1:
                aisle = round((line["x"] + 0.05) / 1.4)
                inside[aisle] = inside.get(aisle, 0) + 1
                most = max(most, inside[aisle])
        return most

    def test_ten_robots_share_the_tasks_and_never_an_aisle(self):
        for seed in (1, 2):
            with self.subTest(seed=seed):
                lines = self.warehouse("--seed", seed)
                self.assertEqual([line["state"] for line in self.ended(lines, "finish")], ["Finished"] * 10)
                self.assertEqual(len([line for line in self.ended(lines, "takeTask") if line["state"] == "Taken"]), 10)
                self.assertGreater(len({line["robot"] for line in self.ended(lines, "finish")}), 5)
                self.assertEqual(self.most_in_one_aisle(lines), 1)
                self.assertEqual([line for line in lines if line["kind"] == "contact"], [])
                ends = [line for line in lines if line["kind"] == "plan-end"]
                self.assertEqual([line["result"] for line in ends], ["OK"] * 10)

    def test_the_warehouse_is_the_same_to_the_byte(self):
        runs = []
        for more in ([], [], ["--threads", 2]):
            self.warehouse(*more, duration=120)
            runs.append(self.trace)
        self.assertEqual(runs[0], runs[1])
        self.assertEqual(runs[0], runs[2])

    def test_a_keeper_that_is_killed_and_a_robot_that_is_cut_off(self):
        """Leases end, others take the tasks; nobody touches anybody, and each task is finished."""
        lines = self.warehouse(duration=1400, timeline=[
            {"t": 60, "do": "keeper", "on": False}, {"t": 62, "do": "keeper", "on": True},
            {"t": 150, "do": "cut", "robot": "r4"}, {"t": 156, "do": "restore", "robot": "r4"},
            {"t": 300, "do": "keeper", "on": False}, {"t": 340, "do": "keeper", "on": True}])
        self.assertEqual([line for line in lines if line["kind"] == "contact"], [])
        finished = [line for line in self.ended(lines, "finish") if line["state"] == "Finished"]
        self.assertEqual(len(finished), 10)
        lost = [line for line in lines if line["kind"] == "event" and line.get("event") == "LeaseLost"]
        self.assertGreater(len(lost), 0)

    def test_a_robot_that_stands_in_an_aisle_is_not_touched(self):
        """Cut off for longer it stops where it is, as its project says; others find its aisle taken, and turn back."""
        lines = self.warehouse(duration=800, timeline=[
            {"t": 150, "do": "cut", "robot": "r4"}, {"t": 190, "do": "restore", "robot": "r4"}])
        self.assertEqual([line for line in lines if line["kind"] == "contact"], [])
        finished = [line for line in self.ended(lines, "finish") if line["state"] == "Finished"]
        self.assertGreaterEqual(len(finished), 7)
        self.assertLess(len(finished), 10)
        self.assertGreater(len(self.ended(lines, "retreatHome")), 0)

    def test_templates_of_a_fleet_need_one(self):
        plan = {"format": "vagus-plan/1", "name": "Ask", "toolboxes": ["fleet"], "start": {"actor": "who"},
                "actors": {"who": {"template": "RobotsOnline", "states": {"Done": "@terminate"}}}}
        self.project("alone", plan)
        world = self.world({"name": "t", "type": "thymio2", "at": [1, 1], "project": "alone/"})
        for said in (sim(world, status=2), run_vagus("plan", "run", self.folder / "alone/p.plan.json", status=2)):
            self.assertIn('the plan Ask needs a fleet: the template RobotsOnline of "who" asks the other robots; name one in '
                          'the robot\'s vagus.json', said)


if __name__ == "__main__":
    unittest.main()
