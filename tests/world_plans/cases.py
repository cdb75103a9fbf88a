"""Plans that talk with scripts: beside a world on one clock, and on the bus of another process."""
import json
import os
import pathlib
import sys
import tempfile
import unittest
import unittest.mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import listening, run_vagus, vagus

# The robot answers `go` with one more.
SCRIPT = """<network>
<event size="1" name="go"/>
<event size="1" name="gone"/>
<node nodeId="1" name="thymio-II">onevent go
emit gone event.args[0] + 1
</node></network>
"""
WORLD = {
    "format": "vagus-world/1", "name": "Room", "size": [1, 1],
    "robots": [{"name": "thymio", "type": "thymio2", "at": [0.5, 0.5], "script": "answer.aesl"}],
}
# Counts to 5 together with the robot.
PLAN = {
    "format": "vagus-plan/1", "name": "Count",
    "configuration": {"n": {"type": "int", "initial": 0}},
    "start": {"actor": "ask"},
    "actors": {
        "ask": {"template": "Send", "in": {"event": "'go'", "args": "n"}, "states": {"Sent": "hear"}},
        "hear": {"template": "Receive", "in": {"event": "'gone'"}, "out": {"arg0": "n"}, "states": {"Received": "more"}},
        "more": {"template": "Compare", "in": {"left": "n", "op": "'<'", "right": 5},
                 "states": {"True": "ask", "False": "@terminate"}},
    },
}
# Other code of the processor gives other bits, if anything hangs on them.
NO_FMA = "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX2_Usable,-FMA_Usable,-AVX512F"


class WorldPlans(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-plans-")))
        self.script = self.write("answer.aesl", SCRIPT)
        self.world = self.write("room.world.json", json.dumps(WORLD))
        self.plan = self.write("count.plan.json", json.dumps(PLAN))

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        return path

    def refused(self, *words):
        return run_vagus("plan", "run", self.plan, *words, status=2)

    def start_simulation(self):
        simulation = self.enterContext(vagus("sim", self.world, "--headless", "--duration", "600",
                                             "--listen", "tcp:127.0.0.1:0"))
        return simulation, f"tcp:127.0.0.1:{listening(simulation)}"

    def test_a_plan_and_a_script_count_together_in_virtual_time(self):
        # Two milliseconds for each of five rounds.
        for clock in (["--clock", "virtual"], []):
            lines = run_vagus("plan", "run", self.plan, "--world", self.world, *clock, "--trace", "-").splitlines()
            self.assertEqual(lines[-1], '{"t":0.010000,"plan":"Count","kind":"plan-end","result":"OK"}')

    def test_a_plan_and_a_script_count_together_over_tcp(self):
        _, target = self.start_simulation()
        out = run_vagus("plan", "run", self.plan, "--bus", target, "--project", self.script, "--trace", "-")
        written = [line["value"] for line in map(json.loads, out.splitlines()) if line["kind"] == "write"]
        self.assertEqual(written, [0, 1, 2, 3, 4, 5])

    def test_both_traces_stand_in_one_file_in_order(self):
        all_lines = self.folder / "all.jsonl"
        run_vagus("plan", "run", self.plan, "--world", self.world, "--clock", "virtual", "--trace-all", all_lines)
        lines = [json.loads(line) for line in all_lines.read_text(encoding="utf-8").splitlines()]
        self.assertEqual(sorted(lines, key=lambda line: line["t"]), lines)
        told = [(line["t"], line["node"], line["name"], line["args"]) for line in lines if "args" in line]
        self.assertEqual(told[:3], [(0, 0, "go", [0]), (0.001, 1, "gone", [1]), (0.002, 0, "go", [1])])

    def test_a_run_is_the_same_to_the_byte_whatever_the_processor_can_do(self):
        def trace(name, **environment):
            path = self.folder / name
            with unittest.mock.patch.dict(os.environ, environment):
                run_vagus("plan", "run", self.plan, "--world", self.world, "--clock", "virtual", "--seed", "7",
                          "--trace-all", path)
            return path.read_bytes()

        first = trace("first.jsonl")
        self.assertEqual(trace("second.jsonl"), first)
        self.assertEqual(trace("plain.jsonl", GLIBC_TUNABLES=NO_FMA), first)

    def test_what_does_not_go_together_is_said(self):
        self.assertIn("--bus with --clock virtual", self.refused("--bus", "tcp:127.0.0.1:1", "--clock", "virtual"))
        self.assertIn("--bus without --project", self.refused("--bus", "tcp:127.0.0.1:1"))
        self.assertIn("a run has one bus", self.refused("--bus", "tcp:127.0.0.1:1", "--world", self.world))
        self.assertIn("--project goes with --bus", self.refused("--project", self.script))
        self.assertIn("--trace-all goes with --world", self.refused("--trace-all", "-"))

    def test_wrong_files_are_named_with_their_places(self):
        self.write("answer.aesl", SCRIPT.replace("emit", "emt"))
        said = self.refused("--world", self.world)
        self.assertRegex(said, r"answer\.aesl:5:1: error: .* did you mean \"emit\"\?")
        self.write("answer.aesl", SCRIPT.replace("gone", "went"))
        said = self.refused("--world", self.world)
        self.assertRegex(said, r"count\.plan\.json:1: error: the event \"gone\" has no number: it is not declared by the "
                               r"scripts of .*room\.world\.json")
        self.write("room.world.json", json.dumps({**WORLD, "siz": [1, 1]}))
        self.assertRegex(self.refused("--world", self.world), r"room\.world\.json:1:\d+: .*siz")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + [f"WorldPlans.{name}" for name in sys.argv[1:]], verbosity=2)
