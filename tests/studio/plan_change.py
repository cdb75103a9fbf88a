"""A plan is edited and saved while it runs (P31 of docs/plans.md): it takes over, or the reasons are said."""
import copy
import json
import os
import random
import sys
import unittest

import projects
from bus_plans import PLAN as BUS_PLAN
from bus_plans import BusPlans
from cases import Case

FILE = "rounds.plan.json"
KILLS = int(os.environ.get("VAGUS_KILLS") or 5)
# One actor that is always active, so that what a test says of it is true at any moment.
WAIT = {
    "format": "vagus-plan/1", "name": "Waits",
    "configuration": {"seconds": {"type": "float", "initial": 1000}},
    "start": {"actor": "wait"},
    "actors": {"wait": {"template": "Wait", "in": {"seconds": "seconds"}, "states": {"Done": "@terminate"}}},
}


def changed(plan, **members):
    """The plan with a member of its configuration, actors, … more."""
    plan = copy.deepcopy(plan)
    for key, more in members.items():
        plan[key].update(more)
    return plan


class Changes(Case):
    plan_file = FILE

    def open_plan(self, plan):
        def make(folder):
            projects.write(folder, FILE, plan)
            projects.thymio(folder, plan=FILE)

        page = self.open(make)
        self.wait_node(described=True)
        page.do("run.start")
        self.wait(lambda: self.plan.value["levels"], "a plan that runs")
        return page

    def edit(self, plan):
        """The text anew, not saved."""
        text = json.dumps(plan, indent=2)
        now = self.page.do("doc.open", doc=self.plan_file)["text"]
        self.page.edit(self.plan_file, (0, len(now.encode("utf-16-le")) // 2, text))

    def save(self, plan, state):
        """Saves it, and waits for what comes of it."""
        before = self.plan.value.get("change", {}).get("number", 0)
        self.edit(plan)
        self.page.do("doc.save", doc=self.plan_file)
        self.wait(lambda: self.plan.value.get("change", {}).get("number", 0) > before, "what came of the save")
        change = self.plan.value["change"]
        self.assertEqual((change["state"], change["docs"]), (state, [self.plan_file]), change["reasons"])
        return change["reasons"]

    def check(self):
        return self.page.do("plan.check_change", doc=self.plan_file)

    def variables(self):
        levels = self.plan.value["levels"]
        return {one["name"]: one["value"] for one in levels[0]["variables"]} if levels else {}

    def test_a_plan_that_is_saved_takes_over_and_keeps_its_variables(self):
        self.open_plan(projects.PLAN)
        self.wait(lambda: self.variables().get("rounds", 0) >= 2, "rounds")
        before = self.variables()["rounds"]
        new = changed(projects.PLAN, configuration={"more": {"type": "string", "initial": "new"}},
                      actors={"count": {**projects.PLAN["actors"]["count"], "in": {"value": "rounds + 100"}}})
        self.save(new, "taken")
        self.wait(lambda: self.variables().get("rounds", 0) >= before + 100, "rounds as they are counted now")
        self.assertEqual(self.variables()["more"], "new")
        self.assertEqual(self.plan.value["state"], "running")
        self.assertIn("Rounds: the new version runs", [line["text"] for line in self.plan.value["story"]])

    def test_what_cannot_take_over_is_said_before_and_after_and_the_plan_runs_on(self):
        self.open_plan(WAIT)
        self.assertEqual(self.check(), {"runs": True, "reasons": []})
        other = changed(WAIT, actors={"wait": {"template": "Log", "in": {"text": "seconds"}, "states": {"Done": "@terminate"}}})
        self.edit(other)
        said = self.check()["reasons"]
        self.assertEqual(len(said), 2)  # another template, other inputs
        self.assertIn('Waits: the actor "wait" is active as Wait, and the new version makes it Log', said[0])
        self.assertEqual(self.save(other, "refused"), said)
        self.wait_line("warning", "it continues unchanged")
        self.assertEqual((self.plan.value["state"], self.plan.value["levels"][0]["template"]), ("running", "Wait"))
        # Mistakes are reasons, too; what is fixed takes over.
        wrong = changed(WAIT, actors={"wait": {**WAIT["actors"]["wait"], "states": {"Done": "nobody"}}})
        self.assertIn("nobody", self.save(wrong, "refused")[0])
        self.assertEqual(self.save(changed(WAIT, configuration={"more": {"type": "int"}}), "taken"), [])
        self.wait(lambda: "more" in self.variables(), "the new variable")

    def test_a_plan_that_is_paused_is_changed_too(self):
        page = self.open_plan(WAIT)
        page.do("run.pause")
        self.wait_clock("paused")
        self.edit(changed(WAIT, configuration={"more": {"type": "int", "initial": 4}}))
        stands = self.settled()
        self.assertEqual(self.check(), {"runs": True, "reasons": []})
        self.assertEqual(self.clock.value["t"], stands)  # a question lets no time pass
        self.save(changed(WAIT, configuration={"more": {"type": "int", "initial": 4}}), "taken")
        self.wait(lambda: self.variables().get("more") == 4, "the new variable")
        self.assertEqual(self.plan.value["state"], "paused")

    def test_files_that_do_not_run_are_no_matter(self):
        page = self.open_plan(WAIT)
        page.do("file.new", path="other.plan.json", kind="plan")
        self.assertEqual(page.do("plan.check_change", doc="other.plan.json"), {"runs": False, "reasons": []})
        page.do("plan.stop")
        self.wait(lambda: self.plan.value["state"] == "ended", "the end")
        self.assertEqual(self.check(), {"runs": False, "reasons": []})
        self.assertNotIn("change", self.plan.value)

    def test_a_caller_and_its_inner_plan_that_are_saved_together_are_one_change(self):
        inner = {**copy.deepcopy(WAIT), "name": "Inner"}
        outer = {"format": "vagus-plan/1", "name": "Outer", "configuration": {}, "start": {"actor": "call"},
                 "actors": {"call": {"plan": "inner.plan.json",
                                     "states": {"OK": "@terminate", "Interrupted": "@terminate", "Error": "@terminate"}}}}

        def make(folder):
            projects.write(folder, "inner.plan.json", inner)
            projects.write(folder, FILE, outer)
            projects.thymio(folder, plan=FILE)

        page = self.open(make)
        self.wait_node(described=True)
        page.do("run.start")
        self.wait(lambda: len(self.plan.value["levels"]) == 2, "both plans")
        # Neither alone would be right: the shared variable needs the caller's.
        self.plan_file = "inner.plan.json"
        self.edit(changed(inner, configuration={"both": {"type": "int", "access": "shared"}}))
        self.assertIn("both", self.check()["reasons"][0])
        self.plan_file = FILE
        self.edit({**outer, "configuration": {"both": {"type": "int", "initial": 6}}})
        page.do("doc.save_all")
        self.wait(lambda: self.plan.value.get("change"), "what came of it")
        change = self.plan.value["change"]
        self.assertEqual((change["state"], sorted(change["docs"])), ("taken", ["inner.plan.json", FILE]), change)
        self.wait(lambda: {"name": "both", "type": "int", "value": 6, "unit": ""} in self.plan.value["levels"][0]["variables"], "the variable")

    def test_a_run_begins_at_any_actor_with_any_values(self):
        page = self.open_plan(projects.PLAN)
        page.do("plan.start", doc=FILE, **{"from": "enough", "set": {"rounds": 7, "limit": 7}})
        self.wait(lambda: self.plan.value["state"] == "ended", "the end, since there are enough")
        self.assertEqual(self.plan.value["result"], "OK")
        self.assertNotIn("round", [line["text"] for line in self.plan.value["story"]])
        self.assertIn('has no actor "enuf"', self.refused("failed", "plan.start", doc=FILE, **{"from": "enuf"}))

    def test_a_studio_that_is_killed_in_the_middle_of_a_change_leaves_nothing_half(self):
        seed = int(os.environ.get("VAGUS_SEED") or random.SystemRandom().randrange(1 << 32))
        print(f"seed: VAGUS_SEED={seed}")
        dice = random.Random(seed)
        self.open_plan(projects.PLAN)
        before = (self.folder / FILE).read_text(encoding="utf-8")
        for number in range(KILLS):
            new = changed(projects.PLAN, configuration={f"more{number}": {"type": "int", "initial": number}})
            self.edit(new)
            numbers = [self.page.ask("doc.save", doc=FILE)]
            if dice.random() < 0.5:
                self.page.answer(numbers[0])
            self.studio.kill()
            self.page.wait_closed()
            saved = (self.folder / FILE).read_text(encoding="utf-8")
            self.assertIn(saved, (before, json.dumps(new, indent=2)))
            self.studio.start(self.folder)
            self.page = self.enterContext(self.studio.page())
            self.watch_all(self.page)
            self.wait_node(described=True)
            # Whatever was kept, saved or as what was not saved: it runs, and takes the next version.
            text = self.page.do("doc.open", doc=FILE)["text"]
            self.assertIn(text, (before, json.dumps(new, indent=2)))
            self.page.do("run.start")
            self.wait(lambda: self.plan.value["levels"], "a plan that runs")
            before = (self.folder / FILE).read_text(encoding="utf-8")
            self.assertEqual(before, text)  # Run saves


class OnBus(Case):
    """The same for a plan that drives a robot on a bus: in real time, by its debugger."""
    plan_file = "drive.plan.json"
    open_robot, start, rounds = BusPlans.open_robot, BusPlans.start, BusPlans.rounds
    wait_plan, wait_rounds = BusPlans.wait_plan, BusPlans.wait_rounds
    edit, save, check, variables = Changes.edit, Changes.save, Changes.check, Changes.variables

    def test_on_a_bus_a_plan_that_is_saved_takes_over_also_while_it_is_held(self):
        page = self.open_robot()
        self.start()
        new = changed(BUS_PLAN, configuration={"more": {"type": "int", "initial": 3}})
        self.edit(new)
        self.assertEqual(self.check(), {"runs": True, "reasons": []})
        self.save(new, "taken")
        self.wait(lambda: self.variables().get("more") == 3, "the new variable")
        page.do("plan.pause")
        self.wait_plan("paused")
        self.save(changed(new, configuration={"last": {"type": "int", "initial": 5}}), "taken")
        self.wait(lambda: self.variables().get("last") == 5, "the new variable of a plan that is held")
        other = changed(new, configuration={"rounds": {"type": "string", "initial": ""}})
        self.assertIn('the variable "rounds"', " ".join(self.save(other, "refused")))
        page.do("plan.continue")
        self.wait_rounds()


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:] or ["Changes", "OnBus"])], verbosity=2, warnings="ignore")
