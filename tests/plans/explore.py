"""`vagus plan explore` as a process: exit codes, text, JSON, a path that is played (docs/explore.md)."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
VAGUS = os.environ.get("VAGUS_BIN", str(ROOT / "build/release/bin/vagus"))

# `stop` leads to its own remedy, which has no states, while it rests.
TRAP = """{ "format": "vagus-plan/1", "name": "Trap",
  "start": { "actor": "go", "supervisors": {
    "stop": { "template": "OnEvent", "in": { "event": "'stop'" }, "events": { "Received": "wait" } },
    "end": { "template": "OnEvent", "in": { "event": "'end'" }, "events": { "Received": "@terminate" } } } },
  "actors": {
    "go": { "template": "Wait", "in": { "seconds": 5 }, "states": { "Done": "compare" } },
    "compare": { "template": "Compare", "in": { "left": 1, "op": "'=='", "right": 2 },
                 "states": { "True": "stuck", "False": "go" } },
    "wait": { "template": "Wait", "in": { "seconds": 1 }, "states": { "Done": "go" } },
    "stuck": { "template": "WaitForever", "supervisors": {
      "never": { "template": "Timeout", "in": { "seconds": 1 }, "events": { "Timeout": "@ignore" } } } } },
  "layout": { "go": [0, 0] } }"""
GOOD = """{ "format": "vagus-plan/1", "name": "Good", "start": { "actor": "go" },
  "actors": { "go": { "template": "Wait", "in": { "seconds": 5 }, "states": { "Done": "@terminate" } } } }"""
OUTER = """{ "format": "vagus-plan/1", "name": "Outer", "start": { "actor": "call" },
  "actors": { "call": { "plan": "b.plan.json",
    "states": { "OK": "@terminate", "Interrupted": "lost", "Error": "@terminate" } },
    "lost": { "template": "WaitForever" } } }"""
# Without the supervisor of the outer plan this one never ends.
ENDLESS = """{ "format": "vagus-plan/1", "name": "Endless", "start": { "actor": "a" },
  "actors": { "a": { "template": "Wait", "in": { "seconds": 1 }, "states": { "Done": "a" } } } }"""


class Explore(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, text, name="a.plan.json"):
        (self.folder / name).write_text(text)

    def explore(self, text, *arguments):
        self.write(text)
        return subprocess.run([VAGUS, "plan", "explore", "a.plan.json", *arguments], cwd=self.folder, capture_output=True,
                              text=True, timeout=120)

    def test_a_plan_without_faults_has_exit_code_0(self):
        done = self.explore(GOOD)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, "1 situation seen, 0 things found; these are all that there are\n")

    def test_what_was_found_is_told_with_place_and_path(self):
        done = self.explore(TRAP.replace('"end": { "template": "OnEvent"', '"end": { "template": "OnEvent", "help": "-"')
                            .replace('"Received": "@terminate"', '"Received": "@ignore"'))
        self.assertEqual(done.returncode, 1, done.stderr)
        lines = done.stdout.splitlines()
        self.assertIn("a.plan.json:6:5: 1: go: the plan never ends by itself: no way leads to the end from its start; "
                      'nor from what follows: "compare", "wait" and "stuck" [no-end]', lines)
        self.assertTrue(any(line.startswith('a.plan.json:4:5: 2: end: "end" can never win: ') for line in lines), done.stdout)
        self.assertTrue(any(line.startswith('a.plan.json:11:7: 3: never: "never" can never win: ') for line in lines), done.stdout)
        self.assertTrue(lines[-1].endswith("3 things found; these are all that there are"), lines[-1])

    def test_json_says_the_same(self):
        done = self.explore(TRAP, "--json")
        found = json.loads(done.stdout)
        self.assertEqual(done.returncode, 1)
        self.assertTrue(found["complete"])
        self.assertFalse(found["skipped"])
        self.assertEqual(found["trapped"], 0)  # `end` watches everywhere
        self.assertEqual([(one["kind"], one["element"]) for one in found["findings"]], [("never-wins", "never")])
        good = self.explore(GOOD, "--json")
        self.assertEqual(good.returncode, 0)
        self.assertEqual(json.loads(good.stdout)["findings"], [])

    def test_a_plan_that_is_not_valid_has_exit_code_2(self):
        done = self.explore(GOOD.replace('"Wait"', '"Wiat"'))
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("[P2]", done.stderr)
        for words in ["--depth", "0"], ["--depth", "65"], ["--play", "0"], ["--play", "2"], ["--play", "1", "--json"]:
            self.assertEqual(self.explore(GOOD, *words).returncode, 2, words)

    def test_a_path_is_played(self):
        # `stop`, which waits for an event of the bus, leads to an actor that waits for ever, and `end` ignores its event.
        plan = TRAP.replace('"Received": "wait"', '"Received": "stuck"').replace('"Received": "@terminate"', '"Received": "@ignore"')
        plan = plan.replace('"False": "go"', '"False": "@terminate"')
        found = json.loads(self.explore(plan, "--json").stdout)["findings"]
        trap = next(number for number, one in enumerate(found, 1) if one["kind"] == "no-end")
        self.assertEqual([(step["element"], step["outcome"], step["target"]) for step in found[trap - 1]["path"]],
                         [("stop", "Received", "stuck")])
        done = self.explore(plan, "--play", str(trap))
        self.assertEqual((done.returncode, done.stderr), (1, ""))
        trace = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual([(line["t"], line["actor"]) for line in trace if line["kind"] == "actor-start"], [(0, "go"), (1, "stuck")])
        self.assertEqual((trace[-1]["t"], trace[-1]["kind"]), (1, "plan-end"))

    def test_sub_plans_are_looked_into(self):
        self.write(ENDLESS, "b.plan.json")
        deep = json.loads(self.explore(OUTER, "--json").stdout)
        self.assertEqual([(one["kind"], one["element"]) for one in deep["findings"]],
                         [("unreached", "lost"), ("no-end", "call")])
        flat = self.explore(OUTER, "--depth", "1")
        self.assertIn("--depth looks deeper", flat.stdout)
        self.assertIn("runs a sub-plan beyond the depth, which ends with Interrupted", flat.stdout)
        self.assertEqual(self.explore(OUTER, "--depth", "1", "--play", "1").returncode, 1)


if __name__ == "__main__":
    unittest.main()
