"""`vagus plan run --watch`: what is saved while the plan runs takes over, or every reason is said (P31 of docs/plans.md)."""
import json
import os
import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/support"))
from harness import Program  # noqa: E402

VAGUS = os.environ.get("VAGUS_BIN", str(ROOT / "build/release/bin/vagus"))


def rounds(text, **more):
    """Says a word every 50 ms; under a supervisor that never raises."""
    return json.dumps({
        "format": "vagus-plan/1", "name": "Rounds", "configuration": {"n": {"type": "int", "initial": 0}, **more},
        "start": {"actor": "wait", "supervisors": {
            "late": {"template": "Timeout", "in": {"seconds": 100000}, "events": {"Timeout": "@terminate"}}}},
        "actors": {
            "wait": {"template": "Wait", "in": {"seconds": 0.05}, "states": {"Done": "count"}},
            "count": {"template": "Assign", "in": {"value": "n + 1"}, "out": {"result": "n"}, "states": {"Done": "say"}},
            "say": {"template": "Log", "in": {"text": text}, "states": {"Done": "wait"}}}}, indent=1)


class Watch(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-watch-")))
        self.file = self.folder / "r.plan.json"

    def save(self, text):
        """As editors do: another file takes its place."""
        other = self.folder / "r.plan.json~"
        other.write_text(text, encoding="utf-8")
        other.replace(self.file)

    def run_watched(self, text, *arguments):
        self.save(text)
        return self.enterContext(Program(VAGUS, "plan", "run", str(self.file), "--watch", *arguments))

    def test_a_plan_that_is_saved_takes_over_in_real_time(self):
        program = self.run_watched(rounds("'old ' & n"))
        program.wait_line(r"say: old 2")
        self.save(rounds("'new ' & n & ' ' & more", more={"type": "int", "initial": 7}))
        program.wait_lines(r"a new version of the plan runs", r"more = 7", r"was saved: the new version runs", r"say: new \d+ 7")

    def test_what_cannot_take_over_is_said_with_every_reason_and_tried_again_at_the_next_save(self):
        program = self.run_watched(rounds("'old ' & n"))
        program.wait_line(r"say: old 2")
        other = json.loads(rounds("'new ' & n", n={"type": "float", "initial": 0}))
        del other["start"]["supervisors"]["late"]
        self.save(json.dumps(other))
        program.wait_line(r'Rounds: the variable "n" holds a value of the type int, and the new version says float')
        program.wait_line(r'Rounds: the global supervisor "late" watches, and in the new version there is none')
        program.wait_line(r"the plan as it was runs on")
        program.wait_line(r"say: old \d+")
        # Half a file is a finding.
        half = rounds("'new ' & n")
        self.save(half[:len(half) // 2])
        program.wait_line(r"r\.plan\.json:\d+:\d+: error: .*\[P0\]")
        program.wait_line(r"the plan as it was runs on")
        self.save(half)
        program.wait_lines(r"was saved: the new version runs", r"say: new \d+")

    def test_an_inner_plan_and_one_that_comes_with_a_version_take_over_too(self):
        inner = self.folder / "inner.plan.json"
        inner.write_text(rounds("'inner ' & n").replace('"Rounds"', '"Inner"'), encoding="utf-8")
        calls = {"format": "vagus-plan/1", "name": "Calls", "start": {"actor": "call"}, "actors": {"call": {
            "plan": "inner.plan.json", "states": {"OK": "@terminate", "Interrupted": "@terminate", "Error": "@terminate"}}}}
        program = self.run_watched(json.dumps(calls))
        program.wait_line(r"say: inner 1")
        inner.write_text(rounds("'other ' & n").replace('"Rounds"', '"Inner"'), encoding="utf-8")
        program.wait_line(r"say: other \d+")
        # Another plan, that nothing calls yet, is watched from now on.
        later = self.folder / "later.plan.json"
        later.write_text(rounds("'later ' & n"), encoding="utf-8")
        calls["actors"]["next"] = {**calls["actors"]["call"], "plan": "later.plan.json"}
        calls["actors"]["call"]["states"]["OK"] = "next"
        self.save(json.dumps(calls))
        # With the slash: what is said of inner.plan.json may come only now.
        program.wait_line(r"/r\.plan\.json was saved: the new version runs")
        later.write_text(rounds("'even later ' & n"), encoding="utf-8")
        program.wait_line(r"later\.plan\.json was saved: the new version runs")

    def test_after_the_end_a_save_starts_anew(self):
        once = json.loads(rounds("'once'"))
        once["actors"]["say"]["states"]["Done"] = "@terminate"
        program = self.run_watched(json.dumps(once))
        program.wait_line(r"the plan is over: OK")
        self.save(json.dumps(once, indent=2))
        program.wait_line(r"was saved: the plan starts again")
        program.wait_line(r"the plan is over: OK")


if __name__ == "__main__":
    unittest.main(verbosity=2)
