"""Events of the bus that wait while a plan stands, as every page sees and handles them; and those that a standing node drops."""
import sys
import tempfile
import unittest

import projects
from cases import Case
from harness import listening, simulated

AESL = """<!DOCTYPE aesl-source>
<network>
<event size="1" name="go"/>
<event size="0" name="on"/>
<event size="1" name="end"/>
<keywords flag="true"/>
<node nodeId="1" name="thymio-II"><![CDATA[
var heard = 0
onevent go
	heard += 1
]]></node>
</network>
"""
HANDLER_LINE = 4  # of the script: heard += 1
# Waits for go, then for on, then for end.
PLAN = {
    "format": "vagus-plan/1", "name": "Three", "start": {"actor": "a"},
    "actors": {
        "a": {"template": "Receive", "in": {"event": "'go'"}, "states": {"Received": "b"}},
        "b": {"template": "Receive", "in": {"event": "'on'"}, "states": {"Received": "c"}},
        "c": {"template": "Receive", "in": {"event": "'end'"}, "states": {"Received": "@terminate"}},
    },
}
HELD_MAX = 1000
SHOWN_MAX = 200


class Held(Case):
    def watch_all(self, page):
        super().watch_all(page)
        self.held = page.watch("held", rate=60)

    def write_project(self, folder):
        projects.write(folder, "robot.aesl", AESL)
        projects.write(folder, "three.plan.json", PLAN)
        return {"format": "vagus-project/1", "name": "Three", "scripts": ["robot.aesl"], "plan": "three.plan.json"}

    def open_world(self):
        def make(folder):
            projects.thymio(folder)
            projects.write(folder, "vagus.json", {**self.write_project(folder), "world": "room.world.json", "target": "sim"})

        page = self.open(make)
        self.wait_node(described=True)
        return page

    def open_bus(self):
        """The robot is another program, in real time."""
        arena = self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-arena-"))
        port = listening(self.enterContext(simulated(arena, {"name": "alice", "node": 1})))

        def make(folder):
            projects.write(folder, "vagus.json", {**self.write_project(folder), "target": f"tcp:127.0.0.1:{port}"})

        page = self.open(make)
        self.wait_node(described=True)
        return page

    def actor(self):
        levels = self.plan.value["levels"]
        return levels[0]["actor"] if levels else None

    def stand_at_b(self, page):
        """The plan has heard go, and stands before its second actor."""
        page.do("plan.break.set", doc="three.plan.json", kind="actor", element="b")
        page.do("run.start")
        self.wait(lambda: self.plan.value["state"] == "running" and self.actor() == "a" and
                  any(one["set"] for one in self.breakpoints.value["plans"]), "a plan that waits")
        page.do("event.send", name="go", args=[1])
        self.wait(lambda: "stands_at" in self.plan.value and self.held.value["stands"], "a plan that stands")
        self.wait_clock("paused")

    def test_events_of_a_bus_have_the_clock_of_the_run(self):
        page = self.open_bus()
        self.stand_at_b(page)
        heard = lambda kind: [one for one in self.happenings.items if one["kind"] == kind]
        self.wait(lambda: heard("event"), "the event")
        event, appeared = heard("event")[-1], heard("appeared")[0]
        # Their second 0 is the beginning of the run, not that of the connection.
        self.assertGreater(event["wall"] - 1000 * event["t"], appeared["wall"])
        self.assertNotEqual(event["run"], appeared["run"])

    def names(self):
        return [one["name"] for one in self.held.value["events"]]

    def wait_names(self, *names):
        self.wait(lambda: self.names() == list(names), f"held: {names}")

    def send(self, page, *events):
        for name in events:
            page.do("event.send", name=name, args=[7] if name in ("go", "end") else [])

    def test_events_wait_while_a_plan_of_a_world_stands_and_go_on_with_it(self):
        page = self.open_world()
        self.assertEqual(self.held.value, {"stands": False, "events": [], "more": 0, "dropped": 0})
        self.stand_at_b(page)
        self.send(page, "on", "end")
        self.wait_names("on", "end")
        first, second = self.held.value["events"]
        self.assertEqual((first["node"], first["args"], first["after"]), (0, [], 0))
        self.assertEqual(second["args"], [7])
        self.assertAlmostEqual(first["t"], self.clock.value["t"], places=3)
        # A second page, and one that comes back, see the same.
        with self.studio.page() as other:
            seen = other.watch("held", rate=60)
            other.wait(lambda: seen.value and seen.value == self.held.value, "the same list")
        with self.studio.page() as again:
            seen = again.watch("held", rate=60)
            again.wait(lambda: seen.value and seen.value == self.held.value, "the same list")
        page.do("run.start")
        # All go at one instant: c has not begun to wait for end then.
        self.wait(lambda: self.actor() == "c", "the next actor")
        self.wait(lambda: self.held.value["events"] == [] and not self.held.value["stands"], "nothing held")
        self.send(page, "end")
        self.wait(lambda: self.plan.value["state"] == "ended", "the end")
        self.assertEqual(self.plan.value["result"], "OK")

    def test_a_held_event_is_dropped_let_go_and_stepped_with(self):
        page = self.open_world()
        self.stand_at_b(page)
        self.send(page, "end", "on", "go")
        self.wait_names("end", "on", "go")
        # The plan would hear end too early, and wait for it forever.
        page.do("plan.held.drop", number=self.held.value["events"][0]["number"])
        self.wait_names("on", "go")
        self.assertIn("does not wait any more", self.refused("conflict", "plan.held.drop", number=1))
        page.do("plan.held.step")
        self.wait(lambda: self.actor() == "c" and self.held.value["stands"], "the next actor")
        self.wait_names("go")
        self.send(page, "end")
        self.wait_names("go", "end")
        # What is let go comes first when the plan goes on, which it does not do yet.
        page.do("plan.held.go", number=self.held.value["events"][1]["number"])
        self.wait_names("go")
        self.assertEqual(self.plan.value["state"], "paused")
        page.do("plan.continue")
        self.wait(lambda: self.plan.value["state"] == "ended", "the end")
        self.assertIn("no plan runs", self.refused("unavailable", "plan.held.go"))

    def test_all_held_events_are_dropped_and_a_step_then_has_none(self):
        page = self.open_world()
        self.stand_at_b(page)
        self.send(page, "on", "end", "on")
        self.wait_names("on", "end", "on")
        page.do("plan.held.drop")
        self.wait_names()
        self.assertIn("no event of the bus waits", self.refused("conflict", "plan.held.step"))
        self.assertEqual(self.plan.value["state"], "paused")
        page.do("plan.continue")
        self.wait(lambda: not self.held.value["stands"], "a plan that goes on")
        self.assertIn("only while it is paused", self.refused("conflict", "plan.held.drop"))
        self.assertEqual(self.actor(), "b")

    def test_a_node_that_stands_says_how_many_events_it_has_dropped(self):
        page = self.open_world()
        page.do("break.set", doc=projects.DOC, line=HANDLER_LINE)
        page.do("run.start")
        self.wait(lambda: self.plan.value["state"] == "running", "a plan that runs")
        self.assertNotIn("dropped", self.node())
        self.send(page, "go")
        self.wait_node(state="paused", dropped=0)
        # Its script has no handler of end: nothing is lost by that.
        self.send(page, "go", "end", "go")
        self.wait_node(dropped=2)
        page.do("break.clear", doc=projects.DOC, line=HANDLER_LINE)
        page.do("node.run", node=1)
        self.wait_node(state="running")
        self.assertNotIn("dropped", self.node())
        self.wait_values(heard=1)

    def test_of_too_many_held_events_the_newest_are_dropped_and_counted(self):
        page = self.open_bus()
        self.stand_at_b(page)
        for _ in range(HELD_MAX + 3):
            page.do("event.send", name="on", args=[])
        self.wait(lambda: self.held.value["dropped"] == 3, "three dropped")
        self.assertEqual(len(self.held.value["events"]), SHOWN_MAX)
        self.assertEqual(self.held.value["more"], HELD_MAX - SHOWN_MAX)

    def test_events_wait_while_a_plan_on_a_bus_stands(self):
        page = self.open_bus()
        self.stand_at_b(page)
        self.send(page, "end", "on", "end")
        self.wait_names("end", "on", "end")
        times = [one["after"] for one in self.held.value["events"]]
        self.assertEqual(times, sorted(times))
        self.assertGreater(times[0], 0)
        page.do("plan.held.step", number=self.held.value["events"][1]["number"])
        self.wait(lambda: self.actor() == "c" and self.held.value["stands"], "the next actor")
        self.wait_names("end", "end")
        page.do("plan.continue")
        self.wait(lambda: self.plan.value["state"] == "ended", "the end")
        self.assertEqual(self.plan.value["result"], "OK")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:] or ["Held"])], verbosity=2, warnings="ignore")
