"""--chaos on the command line: runs with faults are recorded and run again, a planted weakness is found and shrunk to one
fault, and what is wrong with the words is said."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import run_vagus

EXAMPLES = pathlib.Path(__file__).resolve().parent.parent.parent / "examples"
WALL = EXAMPLES / "follow-wall/WallFollow.plan.json"
HALL = EXAMPLES / "follow-wall/hall.world.json"

# A node that answers what it is asked, and a plan that asks ten times, once each half second.
SCRIPT = """<!DOCTYPE aesl-source>
<network>
<event size="1" name="ask"/>
<event size="1" name="answer"/>
<node nodeId="1" name="thymio-II">onevent ask
	emit answer event.args[0]
</node>
</network>
"""
TOOLBOX = {
    "format": "vagus-toolbox/1", "name": "asking", "project": "echo.aesl",
    "templates": {"Ask": {"kind": "actor", "node": "thymio-II", "start": "ask",
                          "states": {"Answered": {"event": "answer", "help": "the node has answered"}}}},
}
WORLD = {"format": "vagus-world/1", "name": "Desk", "seed": 1, "size": [1, 1],
         "robots": [{"name": "thymio", "type": "thymio2", "at": [0.5, 0.5], "script": "echo.aesl"}]}


def plan(**ask):
    return {
        "format": "vagus-plan/1", "name": "Ask", "toolboxes": ["core", "asking"],
        "configuration": {"round": {"type": "int", "initial": 1}},
        "start": {"actor": "count"},
        "actors": {
            "count": {"template": "For", "in": {"counter": "round", "last": 10}, "out": {"counter": "round"},
                      "states": {"Loop": "ask", "Done": "@terminate"}},
            "ask": {"template": "Ask", "states": {"Answered": "rest"}, **ask},
            "rest": {"template": "Wait", "in": {"seconds": 0.5}, "states": {"Done": "count"}},
        },
    }


# The weakness: it waits for one event. Repaired: it asks again after a while.
WEAK = plan()
STRONG = plan(supervisors={"late": {"template": "Timeout", "in": {"seconds": 1}, "events": {"Timeout": "ask"}}})


class Chaos(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-chaos-")))
        self.results = self.folder / "results"
        (self.folder / "echo.aesl").write_text(SCRIPT)
        for name, content in {"asking.toolbox.json": TOOLBOX, "desk.world.json": WORLD, "Weak.plan.json": WEAK,
                              "Strong.plan.json": STRONG}.items():
            (self.folder / name).write_text(json.dumps(content))

    def write_test(self, name, **members):
        test = {"format": "vagus-test/1", "plan": f"{name}.plan.json", "world": "desk.world.json", "max_time": 30,
                "toolboxes": ["asking.toolbox.json"], **members, "expect": [{"ends": "OK"}]}
        path = self.folder / f"{name}.test.json"
        path.write_text(json.dumps(test))
        return path

    def test_a_planted_weakness_is_found_and_shrunk_to_one_fault(self):
        path = self.write_test("Weak", seeds=[3, 4])
        junit = self.folder / "junit.xml"
        output = run_vagus("test", path, "--chaos", "12:lost,doubled,delayed,unplugged", "--results", self.results, "--junit", junit,
                           status=1)
        self.assertIn("2 of 2 runs as expected", output)
        self.expect_sets(junit, int(re.search(r"survives (\d+) of 12", output)[1]))
        found = re.search(r"FAILED \S+Weak\.test\.json: survives \d+ of 12 sets of faults\n  set (\d+), with seed (\d+); .*\n"
                          r"  1 fault of (\d) left, after (\d+) runs:\n    \S+ s to \S+ s: .*\n(.*\n)+?"
                          r"  vagus replay (\S+) --until \S+\n  vagus test (\S+)", output)
        self.assertTrue(found, output)
        self.assertLessEqual(int(found[4]), 40, output)
        written = json.loads(pathlib.Path(found[7]).read_text())
        self.assertEqual(written["seeds"], [int(found[2])] * 2)
        (fault,) = written["chaos"]
        self.assertIn(fault["kind"], ("lost", "unplugged"))
        # One lost frame is enough, and the window of the fault is about as short as that.
        self.assertLessEqual(fault["until"] - fault["from"], 0.05, fault)
        # What was written breaks the plan by itself; the repaired plan survives it.
        self.assertIn("ends OK: it had not ended after its max_time", run_vagus("test", found[7], "--results", self.results, status=1))
        strong = self.write_test("Strong", chaos=written["chaos"], seeds=written["seeds"])
        self.assertIn("1 of 1 runs as expected", run_vagus("test", strong))
        self.assertIn("no difference", run_vagus("replay", found[6]))

    def expect_sets(self, junit, survived):
        """Two seeds, and twelve sets of faults."""
        # Debian's package is for Debian's Python, whichever runs this.
        read = ("import json, sys, junitparser\n"
                "(suite,) = junitparser.JUnitXml.fromfile(sys.argv[1])\n"
                "print(json.dumps([suite.tests, suite.failures, suite.errors, [[case.name, case.is_passed] for case in suite]]))")
        done = subprocess.run(["/usr/bin/python3", "-c", read, junit], capture_output=True, text=True, check=True)
        tests, failures, errors, cases = json.loads(done.stdout)
        self.assertEqual((tests, failures, errors), (14, 12 - survived, 0))
        self.assertEqual(cases[:2], [["seed 3", True], ["seed 4", True]])
        self.assertEqual([passed for _, passed in cases[2:]].count(True), survived)
        for number, (name, _) in enumerate(cases[2:]):
            self.assertRegex(name, rf"^seed {3 + number % 2} --chaos random:{number % 4 + 1}:{number + 1}:[\d.]+:lost,doubled,delayed,"
                                   "unplugged$")

    def test_the_repaired_plan_survives(self):
        path = self.write_test("Strong")
        output = run_vagus("test", path, "--chaos", "12:doubled,delayed,reordered", "--results", self.results)
        self.assertIn(f"ok     {path}: survives 12 of 12 sets of faults", output)
        self.assertFalse(list(self.results.glob("*")) if self.results.exists() else [])

    def test_the_same_sets_are_found_on_one_and_two_processors(self):
        path = self.write_test("Weak", seeds=[1, 3])
        one, two = (run_vagus("test", path, "--chaos", "6:lost", "--results", self.results, "-j", jobs, status=1)
                    for jobs in (1, 2))
        self.assertEqual(one, two)

    def test_tests_without_a_world_or_with_faults_of_their_own_are_left_alone(self):
        path = self.write_test("Strong", chaos=[{"kind": "reset", "node": "thymio-II", "at": 1}])
        self.assertNotIn("survives", run_vagus("test", path, "--chaos", 3))

    def test_a_run_with_faults_is_recorded_and_runs_again(self):
        faults = [{"kind": "unplugged", "node": "drive", "from": 4, "until": 6},
                  {"kind": "lost", "link": "main", "from": 3, "until": 5, "chance": 0.5},
                  {"kind": "noisy", "node": "range", "sensor": "sonar.distance", "from": 1, "by": 100},
                  {"kind": "hung", "node": "bumper", "at": 2}]
        (self.folder / "storm.json").write_text(json.dumps(faults))
        recording, trace = self.folder / "run.mcap", self.folder / "all.jsonl"
        run_vagus("plan", "run", WALL, "--world", HALL, "--clock", "virtual", "--quiet", "--max-time", 10, "--chaos",
                  self.folder / "storm.json", "--record", recording, "--trace-all", trace, status=4)
        told = [json.loads(line) for line in trace.read_text().splitlines() if '"kind":"chaos"' in line]
        self.assertEqual([(one["t"], one["what"], one["state"]) for one in told][:4],
                         [(1, "sonar.distance of range is noisy, by 100", "begins"), (2, "bumper hangs", "begins"),
                          (2.1, "the watchdog of bumper resets it", "ends"),
                          (3, "the link of the main computer loses 50 % of its frames", "begins")])
        (self.folder / "storm.json").unlink()  # the recording stands alone
        self.assertIn("no difference", run_vagus("replay", recording))

    def test_a_run_of_a_world_with_faults_runs_again(self):
        recording = self.folder / "sim.mcap"
        output = run_vagus("sim", EXAMPLES / "thymio/arena.world.json", "--load", EXAMPLES / "thymio/explore.aesl", "--headless",
                           "--speed", "max", "--duration", 4, "--chaos", "random:4:5:3", "--record", recording)
        self.assertRegex(output, r"\d\.\d{3} s  chaos  \S+")
        self.assertIn("no difference", run_vagus("replay", recording))

    def test_a_run_without_faults_is_as_it_was(self):
        """A fault behind the end of a run changes nothing of it."""
        traces = []
        for words in ([], ["--chaos", '[{"kind":"reset","node":"drive","at":1000}]']):
            trace = self.folder / "trace.jsonl"
            run_vagus("plan", "run", WALL, "--world", HALL, "--clock", "virtual", "--quiet", "--max-time", 15, "--trace-all",
                      trace, *words, status=5)
            traces.append(trace.read_text())
        self.assertEqual(traces[0], traces[1])
        self.assertNotIn("chaos", traces[0])

    def test_words_that_do_not_fit_are_refused_with_their_place(self):
        def refused(faults, *words):
            text = faults if isinstance(faults, str) else json.dumps(faults)
            return run_vagus("plan", "run", WALL, *(words or ("--world", HALL)), "--chaos", text, status=2)
        self.assertIn("--chaos:1:2: the world has no node \"drve\"; did you mean drive?",
                      refused([{"kind": "reset", "node": "drve", "at": 1}]))
        self.assertIn("--chaos:1:2: the node \"range\" has no sensor \"sonar.angel\"; did you mean sonar.angle?",
                      refused([{"kind": "dead", "node": "range", "sensor": "sonar.angel", "from": 1}]))
        self.assertIn("--chaos random:101: expected how many faults, 1 to 100", refused("random:101"))
        self.assertIn("there is no kind of fault \"hunk\"; did you mean hung?", refused("random:3:1:20:hunk"))
        self.assertIn("--chaos goes with --world", refused("random:3", "--clock", "virtual"))
        path = self.write_test("Strong", chaos=[{"kind": "slow", "from": 3}])
        self.assertRegex(run_vagus("test", path, status=2), rf"{path}:1:\d+: .*\"by\"")
        self.assertIn("--chaos 0: expected how many sets of faults to try, 1 to 10000", run_vagus("test", path, "--chaos", 0,
                                                                                                 status=2))


if __name__ == "__main__":
    unittest.main()
