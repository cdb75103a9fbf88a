"""vagus test: conditions in worlds, seeds, places drawn, and the files that other programs read."""
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import patiently, run_vagus, vagus
from mcap import MAGIC

EXAMPLES = pathlib.Path(__file__).resolve().parent.parent.parent / "examples"

# Forward until something ends it: at 20 cm/s Carbot, whose hull begins 0.16 m before its middle, is at the wall after 4 to 5 s.
PLAN = {
    "format": "vagus-plan/1", "name": "Ahead", "toolboxes": ["carbot"],
    "configuration": {"far": {"type": "float", "initial": 1000}, "late": {"type": "float", "initial": 9}},
    "start": {"actor": "go", "supervisors": {"late": {"template": "Timeout", "in": {"seconds": "late"},
                                                      "events": {"Timeout": "@terminate"}}}},
    "actors": {"go": {"template": "Forward", "in": {"distance": "far"}, "states": {"ForwardSuccessful": "rest"}},
               "rest": {"template": "WaitForever"}},
}
WORLD = {
    "format": "vagus-world/1", "name": "Room", "seed": 1, "size": [3, 2],
    "robots": [{"name": "carbot", "type": "carbot", "at": [2, 1], "angle": 0,
                "script": str(EXAMPLES / "carbot/carbot.aesl")}],
}
# It ticks once a second, and drives.
AHEAD = """var ticks = 0
timer.period[0] = 1000
motor.left.target = 200
motor.right.target = 200
onevent timer0
ticks = ticks + 1
emit tick
"""


class Trials(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-trials-")))
        (self.folder / "Ahead.plan.json").write_text(json.dumps(PLAN))
        world = dict(WORLD, robots=[dict(WORLD["robots"][0], script="carbot.aesl")])
        (self.folder / "room.world.json").write_text(json.dumps(world))
        (self.folder / "carbot.aesl").write_text((EXAMPLES / "carbot/carbot.aesl").read_text())

    def write(self, *expect, name="t", **members):
        test = {"format": "vagus-test/1", "plan": "Ahead.plan.json", "world": "room.world.json", "max_time": 12,
                "expect": list(expect), **members}
        path = self.folder / f"{name}.test.json"
        path.write_text(json.dumps(test))
        return path

    def run_test(self, *options, status=0, file=None):
        return run_vagus("test", file or self.folder / "t.test.json", "--results", self.folder / "results", *options,
                         status=status)

    def test_signals_of_a_world(self):
        self.write({"eventually": "x > 2.5 and abs(y - 1) < 0.1 and abs(angle) < 10"}, {"eventually": "contact > 3"},
                   {"never": "y > 1.5"}, {"always": "bus >= 0 and bus <= 100"}, {"eventually": "bus > 0"},
                   {"eventually": "node('bumper', 'touch.count') > 0"}, {"always": "node(\"carbot/drive\", '_id[0]') > 0"},
                   {"ends": "Interrupted", "by": "late"})
        output = self.run_test()
        self.assertIn("1 of 1 runs as expected", output)

    def test_a_failure_tells_seed_instant_and_values_and_is_recorded(self):
        self.write({"always": "contact < 2", "help": "never presses"}, seeds=[3, 4])
        output = self.run_test(status=1)
        found = re.search(r"t\.test\.json:1:\d+: seed 3, at (\S+) s: always \"contact < 2\": contact = (\S+), actor = \"go\" "
                          r"\(never presses\)\n  vagus replay (\S+) --until (\S+)\n", output)
        self.assertTrue(found, output)
        self.assertTrue(2 <= float(found[2]) < 2.02, output)  # it is asked each 20 ms
        self.assertEqual(found[1], found[4])
        self.assertIn("0 of 2 runs as expected", output)
        # The recording is that run: it runs again, and there it touches.
        self.assertIn("no difference", run_vagus("replay", found[3]))
        self.assertRegex(run_vagus("replay", found[3], "--until", found[4]), rf"at {float(found[1]):.6f} s:\nthe state is [0-9a-f]{{16}}\ncarbot is at 2\.[789]")

    def test_robots_begin_where_the_seed_says(self):
        self.write({"always": "x >= 1.6 and x <= 2.2"}, seeds=[1, 5], max_time=0.1,
                   starts={"robot": "carbot", "within": [[1.6, 0.6], [2.1, 1.4]], "angle": "any"})
        self.run_test()
        self.write({"never": "t >= 0.04"}, seeds=[1, 5], max_time=0.1,
                   starts={"robot": "carbot", "within": [[1.6, 0.6], [2.1, 1.4]], "angle": "any"})
        self.run_test(status=1)
        begins = {run_vagus("replay", self.folder / f"results/t.seed-{seed}.mcap", "--until", 0.02) for seed in range(1, 6)}
        self.assertEqual(len(begins), 5)

    def test_a_place_without_room_is_refused(self):
        path = self.write({"ends": "OK"}, starts={"robot": "carbot", "within": [[0, 0], [0.05, 2]], "angle": 0})
        self.assertIn(f"{path}: \"within\" of \"starts\": of 1000 places drawn there none had room for the robot; the last one "
                      "stood in the border of the world", self.run_test(status=2))
        self.write({"ends": "OK"}, starts={"robot": "carbto", "within": [[0, 0], [0.05, 2]], "angle": 0})
        self.assertIn("has no robot \"carbto\"; did you mean carbot?", self.run_test(status=2))

    def test_words_that_are_not_there_are_refused(self):
        self.write({"always": "node('drve', 'speed') > 0"})
        self.assertRegex(self.run_test(status=2), r'test\.json:\d+:\d+: .*the robot has no node "drve"; did you mean drive\?')
        self.write({"always": "node('bumper', 'touch.sectors[12]') > 0"})
        self.assertIn("\"touch.sectors\" has 12 elements, counted from 0", self.run_test(status=2))

    def child_of(self, program):
        """The process of the only run that goes on."""
        for _ in patiently():
            children = pathlib.Path(f"/proc/{program.process.pid}/task/{program.process.pid}/children").read_text().split()
            if children:
                return int(children[0])
        self.fail("no run has begun")

    def test_a_crash_is_of_its_seed_only(self):
        path = self.write({"ends": "MaxTime"}, seeds=[1, 2], max_time=300, set={"late": 1e5})
        with vagus("test", path, "-j", 1, "--results", self.folder / "results") as program:
            os.kill(self.child_of(program), signal.SIGKILL)
            self.assertEqual(program.wait_end(), 1)
        output = "\n".join(program.lines)
        self.assertIn(f"{path}: seed 1: its process crashed (Killed)", output)
        self.assertIn("1 of 2 runs as expected", output)

    def test_runs_end_with_the_command(self):
        path = self.write({"ends": "MaxTime"}, max_time=80000, set={"late": 1e6})
        with vagus("test", path, "-j", 1) as program:
            child = self.child_of(program)
            program.process.kill()
            program.wait_end()
        for _ in patiently():
            stat = pathlib.Path(f"/proc/{child}/stat")
            if not stat.exists() or stat.read_text().rsplit(")", 1)[1].split()[0] == "Z":
                return
        self.fail("the run goes on")

    def test_a_signal_leaves_no_half_recording(self):
        path = self.write({"ends": "OK"}, seeds=[1, 2], max_time=3000, set={"late": 1e6})
        results = self.folder / "results"
        half, whole = results / "t.seed-1.mcap", results / "t.seed-2.mcap"
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number.name), vagus("test", path, "-j", 1, "--results", results) as program:
                for _ in patiently():
                    if half.exists() and half.stat().st_size > 0:
                        break
                whole.write_bytes(MAGIC + b"of a run before" + MAGIC)
                program.signal(number)
                self.assertEqual(program.wait_end(), -number)
                self.assertEqual(list(results.iterdir()), [whole])

    def test_files_of_other_kinds_stay(self):
        self.write({"always": "t < 1"})
        plan = self.folder / "Ahead.plan.json"
        said = self.run_test("--junit", plan, status=2)
        self.assertIn(f"{plan}: is there already, and is not a report of JUnit", said)
        said = self.run_test("--coverage", plan, status=2)
        self.assertIn(f"{plan}: is a file; --coverage expects a folder", said)
        self.assertEqual(json.loads(plan.read_text()), PLAN)
        for name in ("scripts.info", "Ahead.svg"):
            other = self.folder / name
            other.write_text("mine")
            said = self.run_test("--coverage", self.folder, status=2 if name == "scripts.info" else 1)
            self.assertIn(f"{other}: is there already, and is not a", said)
            self.assertEqual(other.read_text(), "mine")
            other.unlink()
        # Our own are replaced.
        for _ in range(2):
            self.run_test("--junit", self.folder / "junit.xml", "--coverage", self.folder / "coverage", status=1)

    def test_other_programs_read_the_files(self):
        self.write({"always": "contact < 2"}, seeds=[1, 2])
        junit, coverage = self.folder / "junit.xml", self.folder / "coverage"
        self.run_test("--junit", junit, "--coverage", coverage, status=1)
        # Debian's package is for Debian's Python, whichever runs this.
        read = ("import sys, junitparser\n"
                "print([(suite.tests, suite.failures, suite.errors) for suite in junitparser.JUnitXml.fromfile(sys.argv[1])])")
        suites = subprocess.run(["/usr/bin/python3", "-c", read, junit], capture_output=True, text=True, check=True)
        self.assertEqual(suites.stdout, "[(2, 2, 0)]\n")
        summary = subprocess.run(["lcov", "--summary", coverage / "scripts.info", "--rc", "lcov_branch_coverage=1"],
                                 capture_output=True, text=True, check=True)
        self.assertRegex(summary.stdout + summary.stderr, r"lines\.+: \d+\.\d% \((\d+) of (\d+) lines\)")
        self.assertRegex(summary.stdout + summary.stderr, r"branches\.+: \d+\.\d% \((\d+) of (\d+) branches\)")
        drawing = xml.etree.ElementTree.parse(coverage / "Ahead.svg").getroot()
        texts = ["".join(one.itertext()) for one in drawing.iter("{http://www.w3.org/2000/svg}text")]
        self.assertEqual(texts[texts.index("go") + 1], "2")
        self.assertEqual(texts[texts.index("rest") + 1], "0")
        never = (coverage / "coverage.txt").read_text()
        self.assertIn("  actors       rest\n", never)

    def counts(self, plan, world, name, **values):
        """Of a sample that ended well, by the texts of its drawing: each name with the count behind it."""
        path = self.folder / "sample.test.json"
        path.write_text(json.dumps({"format": "vagus-test/1", "plan": str(EXAMPLES / f"{plan}.plan.json"),
                                    "world": str(EXAMPLES / f"{world}.world.json"), "set": values, "max_time": 120,
                                    "expect": [{"ends": "OK"}]}))
        self.run_test("--coverage", self.folder / "coverage", file=path)
        drawing = xml.etree.ElementTree.parse(self.folder / f"coverage/{name}.svg").getroot()
        texts = ["".join(one.itertext()) for one in drawing.iter("{http://www.w3.org/2000/svg}text")]
        return list(zip(texts[::2], map(int, texts[1::2])))

    def test_coverage_of_two_samples_is_as_counted_by_hand(self):
        # Four sides, and the loop once more to its end.
        self.assertEqual(self.counts("patterns/Square", "patterns/thymio", "Square", side=30), [
            ("nextSide", 5), ("Loop", 4), ("Done", 1), ("driveSide", 4), ("ForwardSuccessful", 4), ("turnLeft", 4),
            ("TurnSuccessful", 4)])
        # Two figures, each of two circles.
        self.assertEqual(self.counts("patterns/FigureOfEight", "patterns/carbot", "FigureOfEight", times=2, radius=30), [
            ("nextFigure", 3), ("Loop", 2), ("Done", 1), ("circleLeft", 2), ("CurveSuccessful", 2), ("circleRight", 2),
            ("CurveSuccessful", 2)])
        table = (self.folder / "coverage/coverage.txt").read_text()
        self.assertIn("  pairs        3 of 3\n", table)

    def test_lines_of_scripts_are_counted(self):
        # The plan sends one speed and stops once: what only a turn reaches is not executed.
        self.write({"ends": "Interrupted"})
        self.run_test("--coverage", self.folder / "coverage")
        counts = {}
        script = (self.folder / "carbot.aesl").read_text().splitlines()
        for line in (self.folder / "coverage/scripts.info").read_text().splitlines():
            if line.startswith("DA:"):
                number, count = map(int, line[3:].split(","))
                counts[script[number - 1].strip()] = count
        self.assertTrue(any(count > 0 for count in counts.values()))
        self.assertTrue(any(count == 0 for count in counts.values()))

    def test_processors_make_no_difference(self):
        self.write({"always": "contact < 2"}, seeds=[1, 6])
        self.assertEqual(self.run_test("-j", 1, status=1), self.run_test("-j", 4, status=1))

    def test_seeds_are_chosen(self):
        self.write({"ends": "Interrupted"}, seeds=[1, 6])
        self.assertIn("2 of 2 seeds", self.run_test("--seeds", "8..9"))
        self.assertIn("1 of 1 seeds", self.run_test("--seeds", "8"))
        self.assertIn("--seeds 9..8: expected the smaller number first", self.run_test("--seeds", "9..8", status=2))

    def test_folders_are_looked_through(self):
        self.assertIn("there is no test", self.run_test(file=self.folder, status=2))
        (self.folder / "deep/.git").mkdir(parents=True)
        self.write({"ends": "Interrupted"}, name="one")
        self.write({"ends": "Interrupted"}, name="two")
        (self.folder / "deep/.git/three.test.json").write_text("{}")
        output = self.run_test(file=self.folder)
        self.assertEqual(len(re.findall(r"^ok ", output, re.M)), 2)

    def test_a_test_is_made_of_a_recording(self):
        with vagus("plan", "run", self.folder / "Ahead.plan.json", "--world", self.folder / "room.world.json", "--clock",
                   "virtual", "--quiet", "--seed", 5, "--set", "far=900", "--record", self.folder / "run.mcap") as program:
            self.assertEqual(program.wait_end(), 3)
        made = self.folder / "Made.test.json"
        run_vagus("test", "new", self.folder / "run.mcap", made)
        # 9 s and a quarter of room are 11.25, in tenths 11.3. The first actor comes at 0: a tenth of a second, and its quarter.
        self.assertEqual(json.loads(made.read_text()), {
            "format": "vagus-test/1", "help": "Made from run.mcap: trim it to what matters.", "plan": "Ahead.plan.json",
            "world": "room.world.json", "set": {"far": 900}, "seeds": [5, 5], "max_time": 11.3,
            "expect": [{"order": ["go"]}, {"within": 0.2, "eventually": "actor == 'go'"},
                       {"ends": "Interrupted", "by": "late"}]})
        self.assertIn("1 of 1 runs as expected", self.run_test(file=made))
        self.assertIn("is there already", run_vagus("test", "new", self.folder / "run.mcap", made, status=2))
        run_vagus("test", "new", self.folder / "run.mcap")
        self.assertEqual((self.folder / "run.test.json").read_text(), made.read_text())

    def test_signals_are_listed(self):
        lines = run_vagus("test", "--signals").splitlines()
        for name in ("actor", "event", "t", "x", "y", "angle", "contact", "bus"):
            self.assertTrue(any(line.split()[0] == name for line in lines), name)

    def test_a_world_without_a_plan(self):
        (self.folder / "ahead.aesl").write_text(AHEAD)
        (self.folder / "w.world.json").write_text(json.dumps(dict(WORLD, robots=[
            {"name": "thymio", "type": "thymio2", "at": [0.2, 1], "angle": 0, "script": "ahead.aesl"}])))
        path = self.folder / "t.test.json"
        test = {"format": "vagus-test/1", "world": "w.world.json", "seeds": [1, 3], "max_time": 6}
        # A Thymio at 200 of 500 drives 200 / 500 * 16.6 = 6.64 cm/s.
        path.write_text(json.dumps(dict(test, expect=[
            {"within": 2.2, "eventually": "event == 'tick' and node('thymio-II', 'ticks') == 2"},
            {"eventually": "t > 5.9 and abs(x - 0.59) < 0.06"}, {"always": "contact == 0"}, {"ends": "MaxTime"}])))
        output = self.run_test("--coverage", self.folder / "lines", "--junit", self.folder / "j.xml")
        self.assertIn(f"{self.folder}/ahead.aesl\n  lines        6 of 6\n", output)
        self.assertIn("3 of 3 runs as expected", output)
        self.assertEqual([file.name for file in sorted((self.folder / "lines").iterdir())], ["coverage.txt", "scripts.info"])
        self.assertEqual(len(list(xml.etree.ElementTree.parse(self.folder / "j.xml").iter("testcase"))), 3)
        # What it does not survive is shrunk, and written as a test that has no plan either.
        self.assertRegex(self.run_test("--chaos", "4:hung", status=1), r"  1 fault of \d left")
        (broken,) = (self.folder / "results").glob("t.chaos-*.test.json")
        made = json.loads(broken.read_text())
        self.assertEqual((made.get("plan"), made["world"], made["chaos"][0]["kind"]), (None, "../w.world.json", "hung"))
        self.assertIn("no difference", run_vagus("replay", next((self.folder / "results").glob("t.chaos-*.mcap"))))
        # An expectation of a plan has its place.
        path.write_text(json.dumps(dict(test, expect=[{"order": ["a"]}])))
        self.assertRegex(self.run_test(status=2), r"t\.test\.json:1:\d+: \"order\" of expectation 1 names actors of a plan")

    def test_a_test_is_made_of_a_recording_of_scripts(self):
        (self.folder / "ahead.aesl").write_text(AHEAD)
        (self.folder / "w.world.json").write_text(json.dumps(dict(WORLD, robots=[
            {"name": "thymio", "type": "thymio2", "at": [0.2, 1], "angle": 0}])))
        record = self.folder / "run.mcap"
        run_vagus("sim", self.folder / "w.world.json", "--load", self.folder / "ahead.aesl", "--headless", "--speed", "max",
                  "--duration", "4.05", "--seed", "7", "--record", record)
        made = self.folder / "made.test.json"
        run_vagus("test", "new", record, made)
        test = json.loads(made.read_text())
        self.assertEqual((test["world"], test["scripts"], test["seeds"], test["max_time"]),
                         ("w.world.json", ["ahead.aesl"], [7, 7], 4))
        self.assertEqual(test["expect"][0], {"always": "contact == 0", "help": "touches nothing"})
        self.assertEqual(test["expect"][1], {"within": 1.3, "eventually": "event == 'tick'"})
        self.assertRegex(test["expect"][2]["eventually"], r"^t > 3\.9 and abs\(x - 0\.4\d?\) < 0\.1 and abs\(y - ")
        self.assertEqual(test["expect"][3], {"ends": "MaxTime"})
        self.assertIn("1 of 1 runs as expected", self.run_test(file=made))


if __name__ == "__main__":
    unittest.main(verbosity=2)
