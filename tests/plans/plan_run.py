"""What `vagus plan` promises about formulas, seeds, times and plans that only fire (docs/plans.md, section 6)."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
VAGUS = os.environ.get("VAGUS_BIN", str(ROOT / "build/release/bin/vagus"))

DRAW = """{ "format": "vagus-plan/1", "name": "Draw", "toolboxes": [],
  "configuration": { "n": { "type": "int", "access": "out" } },
  "start": { "actor": "draw" },
  "actors": { "draw": { "template": "Random", "in": { "low": 0, "high": 1000000000 }, "out": { "value": "n" },
                        "states": { "Done": "@terminate" } } } }"""

# `near` raises every 10 ms, and what it leads to changes nothing.
FIRE = """{ "format": "vagus-plan/1", "name": "Fire",
  "start": { "actor": "go", "supervisors": {
    "end": { "template": "Timeout", "in": { "seconds": 5 }, "events": { "Timeout": "@terminate" } } } },
  "actors": {
    "go": { "template": "WaitForever", "supervisors": {
      "near": { "template": "Watch", "in": { "left": 1, "op": "'=='", "right": 1 }, "events": { "True": "back" } } } },
    "back": { "template": "Wait", "in": { "seconds": SECONDS }, "states": { "Done": "go" } } } }"""

# Nothing in it ever falls due.
IDLE = """{ "format": "vagus-plan/1", "name": "Idle", "start": { "actor": "wait" },
  "actors": { "wait": { "template": "WaitForever" } } }"""


class PlanRun(unittest.TestCase):
    def vagus(self, plan, *arguments, verb="run"):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "p.plan.json"
            path.write_text(plan)
            return subprocess.run([VAGUS, "plan", verb, path, *arguments], capture_output=True, text=True, timeout=60)

    def trace(self, plan, *arguments):
        return self.vagus(plan, "--clock", "virtual", "--quiet", "--trace", "-", *arguments)

    def test_a_seed_is_digits_below_2_to_the_64(self):
        ten = self.trace(DRAW, "--seed", "10").stdout
        self.assertNotEqual(ten, self.trace(DRAW, "--seed", "8").stdout)
        self.assertEqual(ten, self.trace(DRAW, "--seed", "010").stdout)
        self.assertEqual(ten, self.trace(DRAW, "--seed", "1", "--seed", "10").stdout)
        self.assertEqual(self.trace(DRAW).stdout, self.trace(DRAW, "--seed", "1").stdout)
        for good in "0", "18446744073709551615":
            self.assertEqual(self.trace(DRAW, "--seed", good).returncode, 0, good)
        for bad in "18446744073709551616", "-1", "-0", "+1", "0x10", "1e3", "1.0", "", " 1", "ten":
            done = self.trace(DRAW, f"--seed={bad}")
            self.assertEqual(done.returncode, 2, bad)
            self.assertIn("--seed", done.stderr)

    def test_a_time_that_never_comes_is_none(self):
        for never in "1000000000001", "1e300":
            done = self.trace(IDLE, "--max-time", never)
            self.assertEqual(done.returncode, 5)
            self.assertIn('{"t":0.000000,"plan":"Idle","kind":"plan-end"', done.stdout)
        done = self.trace(IDLE, "--max-time", "1000000000000")
        self.assertIn('{"t":1000000000000.000000,"plan":"Idle","kind":"plan-end"', done.stdout)
        self.assertEqual(self.trace(IDLE, "--max-time", "0").returncode, 2)

    def test_a_plan_that_does_nothing_but_fire_is_told_so_once(self):
        done = self.trace(FIRE.replace("SECONDS", "0.01"))
        self.assertEqual(done.returncode, 3)
        notes = [line for line in done.stderr.splitlines() if "note: " in line]
        self.assertEqual(len(notes), 1, done.stderr)
        for part in "True", "100 times", "back", "period_ms", "@ignore":
            self.assertIn(part, notes[0])
        self.assertEqual(self.trace(FIRE.replace("SECONDS", "0.2")).stderr, "")

    def test_from_an_actor_is_the_plan_that_starts_there(self):
        wall_follow = (ROOT / "examples/follow-wall/WallFollow.plan.json").read_text()
        self.assertEqual(wall_follow.count('"actor": "searchFirstWall"'), 1)
        world = ("--world", ROOT / "examples/follow-wall/hall.world.json", "--max-time", "60")
        for actor in ("followWall", "backupCollision"):
            there = wall_follow.replace('"actor": "searchFirstWall"', f'"actor": "{actor}"')
            expected = self.trace(there, *world)
            begun = [line for line in expected.stdout.splitlines() if f'"{actor}"' in line]
            self.assertTrue(begun, expected.stderr)
            self.assertEqual(self.trace(wall_follow, *world, "--from", actor).stdout, expected.stdout)

    def test_words_of_formulas_are_listed(self):
        text = subprocess.run([VAGUS, "plan", "formulas"], capture_output=True, text=True, check=True).stdout
        self.assertIn("clamp(x, low, high)", text)
        words = json.loads(subprocess.run([VAGUS, "plan", "formulas", "--json"], capture_output=True, text=True,
                                          check=True).stdout)
        self.assertEqual(words["words"], ["true", "false", "and", "or", "not"])
        self.assertEqual(words["functions"][0]["form"], "if(condition, a, b)")

    def test_a_constant_outside_of_a_declared_range_is_an_error(self):
        plan = """{ "format": "vagus-plan/1", "name": "Fast", "toolboxes": ["fast"], "start": { "actor": "go" },
          "actors": { "go": { "template": "Go", "in": { "speed": 300 }, "states": { "Done": "@terminate" } } } }"""
        toolbox = """{ "format": "vagus-toolbox/1", "name": "fast", "project": "fast.aesl",
          "templates": { "Go": { "kind": "actor", "node": "n",
          "in": { "speed": { "type": "int", "range": [-200, 200] } }, "start": "go", "ICON"
          "states": { "Done": { "event": "done" } } } } }"""
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "fast.toolbox.json"
            (pathlib.Path(folder) / "fast.aesl").write_text(
                '<!DOCTYPE aesl-source>\n<network><event size="2" name="go"/><event size="1" name="done"/></network>\n')
            path.write_text(toolbox.replace('"ICON"', '"icon": "M4 4h16",'))
            done = self.vagus(plan, "--toolbox", path, verb="check")
            self.assertEqual(done.returncode, 2)
            self.assertIn("must be from -200 to 200, but is 300", done.stderr)
            done = self.vagus(plan.replace("300", "200"), "--toolbox", path, verb="check")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            path.write_text(toolbox.replace('"ICON"', '"icon": "picture.png",'))
            done = self.vagus(plan.replace("300", "200"), "--toolbox", path, verb="check")
            self.assertEqual(done.returncode, 2)
            self.assertIn("SVG path data", done.stderr)


if __name__ == "__main__":
    unittest.main()
