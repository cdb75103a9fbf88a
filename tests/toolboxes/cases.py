"""`vagus toolbox`, and the other verbs with toolboxes, as a user meets them."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
VAGUS = os.environ.get("VAGUS_BIN", ROOT / "build/release/bin/vagus")

LAMP = """{
  "format": "vagus-toolbox/1",
  "name": "lamp",
  "help": "Lamps.",
  "project": "lamp.aesl",
  "templates": {
    "Shine": { "kind": "actor", "node": "lamp", "help": "Shines.", "icon": "M1 1h1",
      "in": { "bright": { "type": "float", "unit": "lm", "default": 2.5, "range": [0, 10], "scale": 10 } },
      "start": "lamp.on", "states": { "Done": { "event": "lamp.done", "help": "it is dark again" } } }
  }
}
"""
PROJECT = """<!DOCTYPE aesl-source>
<network>
<event size="2" name="lamp.on"/>
<event size="1" name="lamp.done"/>
</network>
"""
PLAN = """{ "format": "vagus-plan/1", "name": "P", "toolboxes": ["lamp"], "start": { "actor": "shine" },
  "actors": { "shine": { "template": "Shine", "states": { "Done": "@terminate" } } } }
"""


def vagus(*words):
    done = subprocess.run([str(VAGUS), *[str(word) for word in words]], capture_output=True, text=True, timeout=60)
    return done.returncode, done.stdout, done.stderr


class Toolboxes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="vagus-toolbox-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.lamp = self.folder / "lamp.toolbox.json"
        self.lamp.write_text(LAMP)
        (self.folder / "lamp.aesl").write_text(PROJECT)
        self.plan = self.folder / "p.plan.json"
        self.plan.write_text(PLAN)

    def test_list_has_a_line_for_each_template(self):
        code, out, err = vagus("toolbox", "list")
        self.assertEqual((code, err), (0, ""))
        lines = out.splitlines()
        self.assertIn("core: Templates for every platform: waiting, counting, comparing, bus events.", lines)
        self.assertEqual(sum(line.split()[0] == "Forward" for line in lines if line), 2)  # of drive and of carbot
        self.assertTrue(any(line.split()[:2] == ["Timeout", "supervisor"] for line in lines if line))
        code, out, _ = vagus("toolbox", "list", "--json")
        boxes = json.loads(out)
        self.assertEqual([box["name"] for box in boxes], ["core", "drive", "carbot", "fleet"])
        self.assertEqual(boxes[0]["templates"][0],
                         {"name": "Wait", "kind": "actor", "help": "Waits so long."})

    def test_show_tells_all_that_a_template_declares(self):
        code, out, err = vagus("toolbox", "show", "lamp.Shine", "--toolbox", self.lamp)
        self.assertEqual((code, err), (0, ""))
        self.assertEqual(out, "Shine  actor of lamp\n  Shines.\n"
                              "  in  bright  float  lm  default 2.5  0 to 10\n"
                              "  states  Done  it is dark again\n"
                              "  bus  lamp.on, lamp.done\n"
                              "  icon  M1 1h1\n")
        code, out, _ = vagus("toolbox", "show", "lamp", "--json", "--toolbox", self.lamp)
        self.assertEqual(json.loads(out), [{"name": "lamp", "help": "Lamps.", "templates": [{
            "name": "Shine", "kind": "actor", "help": "Shines.", "icon": "M1 1h1",
            "in": [{"name": "bright", "type": "float", "unit": "lm", "help": "", "default": 2.5, "range": [0, 10]}],
            "out": [], "states": [{"name": "Done", "help": "it is dark again"}],
            "bus_events": ["lamp.on", "lamp.done"]}]}])

    def test_show_of_supervisors_tells_their_period(self):
        _, out, _ = vagus("toolbox", "show", "Timeout")
        self.assertIn("  period  10 ms\n", out)
        _, out, _ = vagus("toolbox", "show", "CheckEscapeButton")
        self.assertIn("  period  none: it waits for events\n", out)
        _, out, _ = vagus("toolbox", "show", "CheckEscapeButton", "--json")
        template = json.loads(out)[0]["templates"][0]
        self.assertEqual((template["period_ms"], [event["name"] for event in template["events"]]),
                         (0, ["EscapeButtonPressed"]))

    def test_show_without_a_name_shows_all(self):
        code, out, _ = vagus("toolbox", "show", "--json")
        listed = json.loads(vagus("toolbox", "list", "--json")[1])
        self.assertEqual([[one["name"] for one in box["templates"]] for box in json.loads(out)],
                         [[one["name"] for one in box["templates"]] for box in listed])

    def test_a_name_that_there_is_not_is_answered_with_a_near_one(self):
        code, out, err = vagus("toolbox", "show", "Forwart")
        self.assertEqual((code, out), (2, ""))
        self.assertEqual(err, 'vagus: there is no toolbox or template "Forwart"; did you mean "Forward"?\n')

    def test_a_template_of_a_toolbox_that_the_plan_does_not_list_is_found_there(self):
        self.plan.write_text(PLAN.replace('"toolboxes": ["lamp"], ', ""))
        code, _, err = vagus("plan", "check", self.plan, "--toolbox", self.lamp)
        self.assertEqual(code, 2)
        self.assertEqual(err, f'{self.plan}:2:26: error: shine: the template "Shine" is in the toolbox lamp, which this '
                              'plan does not use; add lamp to the toolboxes of the plan [P2]\n')

    def test_a_large_plan_with_a_mistake_in_every_actor_is_checked(self):
        actors = {f"a{i}": {"template": "Wait", "in": {"seconds": 1}, "states": {"Done": "b"}} for i in range(60000)}
        self.plan.write_text(json.dumps({"format": "vagus-plan/1", "name": "P", "start": {"actor": "a0"},
                                         "actors": actors}))
        code, out, _ = vagus("plan", "check", "--json", self.plan)
        self.assertEqual((code, len(json.loads(out))), (2, len(actors)))

    def test_a_long_chain_of_actors_is_checked(self):
        actors = {f"a{i}": {"template": "Wait", "in": {"seconds": 1}, "states": {"Done": f"a{i + 1}"}}
                  for i in range(60000)}
        actors["a60000"] = {"template": "Wait", "in": {"seconds": 1}, "states": {"Done": "@terminate"}}
        self.plan.write_text(json.dumps({"format": "vagus-plan/1", "name": "P", "start": {"actor": "a0"},
                                         "actors": actors}))
        self.assertEqual(vagus("plan", "check", "--json", self.plan), (0, "[]\n", ""))

    def test_plans_are_checked_with_the_toolboxes_that_are_given(self):
        code, _, err = vagus("plan", "check", self.plan)
        self.assertEqual(code, 2)
        self.assertIn("there is no toolbox \"lamp\"", err)
        self.assertEqual(vagus("plan", "check", self.plan, "--toolbox", self.lamp), (0, "", ""))
        code, _, err = vagus("plan", "check", self.plan, "--toolbox", self.lamp, "--toolbox", self.lamp)
        self.assertEqual(code, 2)
        self.assertIn('there is a toolbox named "lamp" already', err)

    def test_every_verb_refuses_a_toolbox_that_is_wrong(self):
        self.lamp.write_text(LAMP.replace('"lamp.on"', '"lamp.onn"'))
        sentence = f'{self.lamp}:9:16: the event "lamp.onn", "start" of template "Shine", is not in the project ' \
                   f'{self.folder}/lamp.aesl; did you mean "lamp.on"?'
        for words in [["plan", "check", self.plan], ["plan", "run", self.plan], ["plan", "debug", self.plan],
                      ["plan", "generate", self.plan, "-o", self.folder / "made"], ["toolbox", "list"],
                      ["toolbox", "show"]]:
            code, out, err = vagus(*words, "--toolbox", self.lamp)
            self.assertEqual((code, out, err), (2, "", f"vagus: {sentence}\n"), words)

    def test_a_plan_that_works_on_nodes_needs_a_bus(self):
        for verb in ["run", "debug"]:
            code, out, err = vagus("plan", verb, self.plan, "--toolbox", self.lamp)
            self.assertEqual((code, out), (2, ""))
            self.assertIn('the plan P needs a bus: the template Shine of "shine" works on a node; ', err)
            self.assertIn("--world", err)

    def test_the_example_of_the_page_is_right(self):
        page = (ROOT / "docs/toolboxes.md").read_text()
        self.lamp.write_text(page.split("```json\n")[1].split("```")[0])
        sizes = {"lamp.fade": 3, "lamp.stop": 1, "lamp.stopped": 1, "lamp.done": 1, "dark.watch": 1, "dark.unwatch": 1,
                 "dark.now": 1}
        events = "".join(f'<event size="{size}" name="{name}"/>\n' for name, size in sizes.items())
        (self.folder / "lamp.aesl").write_text(f"<!DOCTYPE aesl-source>\n<network>\n{events}</network>\n")
        code, out, err = vagus("toolbox", "show", "lamp", "--toolbox", self.lamp)
        self.assertEqual((code, err), (0, ""))
        self.assertIn("Fade  actor of lamp", out)

    def test_the_papers_plan_has_no_findings(self):
        plan = ROOT / "testdata/plans/WallFollow.plan.json"
        self.assertEqual(vagus("plan", "check", "--json", plan), (0, "[]\n", ""))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[1:]])
