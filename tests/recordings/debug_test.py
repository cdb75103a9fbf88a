"""Recordings of runs with a debugger: what a person did there is done again at the same places of the run."""
import json
import pathlib
import signal
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import patiently, run_vagus, vagus
from mcap import Recording

EXAMPLES = pathlib.Path(__file__).resolve().parent.parent.parent / "examples"
# Rests for half a second and adds one, three times.
STEPS = {
    "format": "vagus-plan/1", "name": "Steps",
    "configuration": {"n": {"type": "int", "initial": 0}},
    "start": {"actor": "rest"},
    "actors": {
        "rest": {"template": "Wait", "in": {"seconds": 0.5}, "states": {"Done": "add"},
                 "supervisors": {"soon": {"template": "Timeout", "in": {"seconds": 9}, "events": {"Timeout": "add"}}}},
        "add": {"template": "Assign", "in": {"value": "n + 1"}, "out": {"result": "n"}, "states": {"Done": "more"}},
        "more": {"template": "Compare", "in": {"left": "n", "op": "'<'", "right": 3},
                 "states": {"True": "rest", "False": "@terminate"}},
    },
}


class DebugRecordings(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-debug-")))
        self.file = self.folder / "run.mcap"
        self.plan = self.folder / "Steps.plan.json"
        self.plan.write_text(json.dumps(STEPS, indent=1))

    def start(self, *words):
        return self.enterContext(vagus("plan", "debug", *words, "--clock", "virtual", "--record", self.file, typing=True))

    def debug(self, lines, *words, status=0):
        program = self.start(*(words or [self.plan]))
        for line in lines:
            program.type(line)
        program.type("quit")
        self.assertEqual(program.wait_end(), status, program.lines)
        return Recording(self.file)

    def wrote(self, recording, name="n"):
        return [line["value"] for line in recording.json("/plan/trace") if line["kind"] == "write" and line["variable"] == name]

    def expect_no_difference(self, *options):
        self.assertRegex(run_vagus("replay", self.file, *options), r"messages compared: no difference$")

    def test_a_variable_that_was_set_is_set_again(self):
        """Paused at 1 s, where n is 1: 7 + 1 is enough."""
        recording = self.debug(["break actor add count 2", "run", "set n = 7", "continue"])
        self.assertEqual(self.wrote(recording), [0, 1, 7, 8])
        self.assertEqual(recording.json("/plan/trace")[-1]["t"], 1)
        self.assertEqual([line["do"] for line in recording.json("/vagus/input")],
                         ["stop-at", "continue", "set-variable", "continue"])
        self.expect_no_difference()
        told = run_vagus("why", self.file, "variable", "n", "--at", "1")
        self.assertIn("add wrote the variable n", told)

    def test_breakpoints_pauses_and_steps_alone_change_nothing(self):
        recording = self.debug(["break state rest", "run", "step", "step", "pause 0.7", "continue", "continue",
                                "delete all", "continue"])
        self.assertEqual(self.wrote(recording), [0, 1, 2, 3])
        plain = self.folder / "plain.mcap"
        run_vagus("plan", "run", self.plan, "--clock", "virtual", "--quiet", "--record", plain)
        self.assertEqual(recording.json("/plan/trace"), Recording(plain).json("/plan/trace"))
        self.expect_no_difference()

    def test_an_event_that_was_raised_is_raised_again(self):
        """At 0.2 s instead of 9 s: rest is interrupted, and add begins then."""
        recording = self.debug(["pause 0.2", "run", "raise soon Timeout", "continue"])
        (raised,) = [line for line in recording.json("/plan/trace") if line["kind"] == "event"]
        self.assertEqual((raised["t"], raised["supervisor"], raised["event"]), (0.2, "soon", "Timeout"))
        self.assertEqual(recording.json("/plan/trace")[-1]["t"], 1.2)
        self.expect_no_difference()
        told = run_vagus("why", self.file, "actor", "rest", "--at", "0.2")
        self.assertIn("a person raised it in the debugger of the plan", told)

    def test_a_run_that_was_left_ends_there_again(self):
        recording = self.debug(["break actor add", "run"], status=3)
        self.assertEqual(recording.json("/vagus/input")[-1]["do"], "end-plan")
        self.assertEqual(recording.json("/plan/trace")[-1]["result"], "Interrupted")
        self.expect_no_difference()

    def test_a_debugger_that_is_killed_leaves_what_was(self):
        program = self.start(self.plan)
        program.type("break actor add count 2")
        program.type("run")
        program.wait_line("^breakpoint 1, paused at 1")
        for _ in patiently():
            if self.file.stat().st_size > 8 and self.wrote(Recording(self.file)) == [0, 1]:
                break
        program.signal(signal.SIGKILL)
        program.wait_end()
        told = run_vagus("replay", self.file)
        self.assertIn("has no end", told)
        self.assertRegex(told, r"no difference$")

    def test_beside_a_world(self):
        """From the second turn on its sides have 10 cm."""
        plan, world = (EXAMPLES / "patterns" / name for name in ("Square.plan.json", "thymio.world.json"))
        recording = self.debug(["break actor turnLeft count 2", "run", "set side = 10", "step", "where", "delete all",
                                "continue"], plan, "--world", world)
        self.assertIn(10, self.wrote(recording, "side"))
        self.expect_no_difference()
        self.expect_no_difference("--until", "3")
        other = self.folder / "other.mcap"
        run_vagus("replay", self.file, "--from", "2", "--set", "side=5", "--record", other)
        self.assertRegex(run_vagus("replay", other), r"messages compared: no difference$")

    def test_what_cannot_be_recorded_is_refused(self):
        for words, sentence in (([self.plan, "--record", self.file], "a run in real time cannot be run again"),
                                ([self.plan, "--clock", "virtual", "--record", self.file, "--record-camera"],
                                 "only a simulated world has cameras to record")):
            with self.subTest(words=words):
                self.assertIn(sentence, run_vagus("plan", "debug", *words, status=2))


if __name__ == "__main__":
    unittest.main()
