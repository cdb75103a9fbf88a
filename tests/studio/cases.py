"""What a person does with a simulated robot in the studio, and what every page sees of it."""
import copy
import json
import struct
import sys
import unittest

import projects
from page import Refused, Studio
from projects import DOC, EMIT_LINE, LAST_LINE, N_LINE, PLAN, ROBOT


class Case(unittest.TestCase):
    """A studio with folders of its own, and one page."""

    def open(self, make=projects.thymio, studio=None, **options):
        self.studio = self.enterContext(studio or Studio())
        self.folder = self.studio.folder / "project"
        make(self.folder, **options)
        self.page = self.enterContext(self.studio.page())
        self.watch_all(self.page)
        self.page.do("project.open", path=str(self.folder))
        return self.page

    def watch_all(self, page):
        self.people = page.watch("studio", rate=60)
        for topic in ("clock", "robot", "plan", "scene", "breakpoints"):
            setattr(self, topic, page.watch(topic, rate=60))
        self.console, self.happenings = page.watch("console", last=100), page.watch("happenings", last=1000)

    def refused(self, code, command, **fields):
        with self.assertRaises(Refused) as caught:
            self.page.do(command, **fields)
        self.assertEqual(caught.exception.code, code, caught.exception)
        return caught.exception.what

    def wait(self, condition, what="what was waited for"):
        return self.page.wait(condition, what)

    def wait_clock(self, state):
        self.wait(lambda: self.clock.value["state"] == state, f"clock {state}")

    def wait_passed(self, seconds=0.2):
        """Until so much time of the run has passed."""
        now = self.clock.value["t"]
        self.wait(lambda: self.clock.value["t"] > now + seconds, "time")

    def settled(self):
        """The time of a clock that stands: three times the same."""
        seen = {}

        def same():
            seen[self.clock.messages] = self.clock.value["t"]
            return len(seen) >= 3 and len(set(list(seen.values())[-3:])) == 1

        self.wait(same, "a clock that stands")
        return self.clock.value["t"]

    def node(self, number=1):
        return next((node for node in self.robot.value["nodes"] if node["id"] == number), {})

    def wait_node(self, number=1, **fields):
        self.wait(lambda: all(self.node(number).get(key) == value for key, value in fields.items()), f"node {number} with {fields}")

    def wait_line(self, kind, part):
        self.wait(lambda: [line for line in self.console.items if line["kind"] == kind and part in line["text"]],
                  f"{kind} … {part} … on the console")

    def wait_values(self, node=1, **expected):
        """Until variables of a node are told to be so."""
        described = self.page.watch("node", node=node)
        self.wait(lambda: described.value and described.value["variables"], "a description")
        places = {one["name"]: one["address"] for one in described.value["variables"]}
        addresses = {places[name.replace("_", ".")]: value for name, value in expected.items()}
        watched = self.page.watch("variables", node=node, ranges=[[address, 1] for address in addresses])

        def as_expected():
            found = {}
            for _, payload in watched.frames:
                for at in range(0, len(payload), 6):
                    address, _, found[address] = struct.unpack_from("<HHh", payload, at)
            return found == addresses

        self.wait(as_expected, f"{expected} of node {node}")

    def events(self, name):
        return [item for item in self.happenings.items if item["kind"] == "event" and item["name"] == name]


def poses(frame):
    """Of robots: (x, y, angle) each."""
    robots, _ = struct.unpack_from("<HH", frame[1])
    return [struct.unpack_from("<3f", frame[1], 4 + 12 * i) for i in range(robots)]


class Runs(Case):
    def test_time_passes_and_robots_move(self):
        page = self.open()
        self.wait_node(described=True, doc=DOC, program="current", robot="alice")
        self.wait_clock("none")
        self.assertEqual(self.clock.value["t"], 0)
        self.wait(lambda: [robot["name"] for robot in self.scene.value["robots"]] == ["alice"], "the robot in the scene")
        moves = page.watch("poses")
        page.do("run.start")
        self.wait_clock("running")
        page.do("event.send", name="go", args=[300])
        self.wait(lambda: moves.frames and poses(moves.frames[-1])[0][0] > 0.55, "the robot further right")
        times = [t for t, _ in moves.frames]
        self.assertEqual(times, sorted(times))
        self.wait(lambda: len(self.events("told")) > 10, "events of the robot")
        first, second = (event["args"][0] for event in self.events("told")[:2])
        self.assertEqual(second, first + 1)

    def test_pause_step_speed(self):
        page = self.open()
        page.do("run.start")
        self.wait_passed()
        self.refused("unavailable", "run.step", ms=50)
        page.do("run.pause")
        self.wait_clock("paused")
        stood = self.settled()
        for span in (50, 1, None):
            page.do("run.step", **({"ms": span} if span else {}))
            self.wait(lambda: self.clock.value["t"] > stood, "another instant")
            now = self.settled()
            self.assertAlmostEqual(now, stood + (span or 10) / 1000, places=6)
            stood = now
        page.do("clock.speed", speed=0)
        page.do("run.start")
        self.wait_passed(20)
        page.do("clock.speed", speed=1e-9)
        self.wait(lambda: self.clock.value["speed"] == 1e-9 and self.clock.value["real"] < 1, "a clock that crawls")
        page.do("clock.speed", speed=20)
        self.wait_passed(2)

    def test_stop_makes_nodes_and_wheels_stand_and_start_goes_on(self):
        page = self.open()
        moves = page.watch("poses")
        page.do("run.start")
        page.do("event.send", name="go", args=[300])
        self.wait(lambda: moves.frames and poses(moves.frames[-1])[0][0] > 0.52, "a robot that drives")
        self.assertEqual(page.do("stop")["stood"], [1])
        self.wait_node(state="stopped")
        self.wait_clock("none")
        # A hand from above makes a frame; the wheels stood before time did.
        self.wait_values(motor_left_target=0, motor_right_target=0)
        stopped, _ = moves.frames[-1]
        page.do("run.step", ms=500)
        self.wait(lambda: moves.frames[-1][0] > stopped + 0.4, "poses after half a second")
        then = moves.frames[-1]
        page.do("run.step", ms=500)
        self.wait(lambda: moves.frames[-1][0] > stopped + 0.9, "poses after another")
        self.assertEqual(poses(moves.frames[-1]), poses(then))
        page.do("run.start")
        self.wait_clock("running")
        self.wait_node(state="running")
        self.wait_passed()
        page.do("run.reset")
        self.wait(lambda: self.clock.value["t"] == 0 and self.clock.value["state"] == "none", "the start again")
        self.wait(lambda: abs(poses(moves.frames[-1])[0][0] - 0.5) < 1e-6, "the robot where the file puts it")

    def test_a_variable_is_set_and_seen(self):
        page = self.open()
        self.wait_node(described=True)
        page.do("variable.set", node=1, name="speed", first=0, values=[77])
        self.wait_values(speed=77)
        page.do("variable.set", node=1, name="timer.period", first=1, values=[123])
        self.assertIn("speedo", self.refused("not_found", "variable.set", node=1, name="speedo", first=0, values=[1]))
        self.refused("not_found", "variable.set", node=9, name="speed", first=0, values=[1])
        self.refused("bad_input", "variable.set", node=1, name="timer.period", first=1, values=[1, 2, 3])

    def test_plotted_words_are_told_also_after_a_new_start(self):
        page = self.open()
        self.wait_node(described=True)
        described = page.watch("node", node=1)
        place = {one["name"]: one["address"] for one in self.wait(lambda: described.value and described.value["variables"])}["n"]
        plot = page.watch("samples", words=[[1, place], "nonsense", [1, 2, 3]])
        page.do("run.start")
        self.wait_passed(0.5)
        self.wait(lambda: len(plot.frames) > 2, "samples")
        page.do("run.reset")
        there = len(plot.frames)
        page.do("run.start")
        self.wait(lambda: len(plot.frames) > there + 2, "samples of the new run")
        t, index, value = struct.unpack_from("<dHh", plot.frames[-1][1])
        self.assertLess(t, 0.5)
        self.assertEqual(index, 0)
        self.assertGreater(value, 0)

    def test_events_need_a_name_and_their_arguments(self):
        page = self.open()
        self.wait_node(described=True)
        self.refused("not_found", "event.send", name="went", args=[])
        self.refused("bad_input", "event.send", name="go", args=[1, 2])
        page.do("event.send", name="go", args=[5])
        self.assertEqual(self.wait(lambda: self.events("go"), "the event itself")[0]["args"], [5])

    def test_a_hand_moves_puts_takes_and_presses(self):
        page = self.open()
        self.wait_node(described=True)
        moves = page.watch("poses")
        page.do("world.move", robot="alice", at=[2, 1], angle=1.5)
        self.wait(lambda: moves.frames and abs(poses(moves.frames[-1])[0][0] - 2) < 1e-6, "the robot there")
        number = page.do("world.put", kind="cylinder", at=[1, 2], radius=0.1)["number"]
        here = self.wait(lambda: [one for one in self.scene.value["objects"] if one["number"] == number], "the cylinder")
        self.assertEqual((here[0]["kind"], round(here[0]["radius"], 6)), ("cylinder", 0.1))
        page.do("world.take", object=number)
        self.wait(lambda: all(one["number"] != number for one in self.scene.value["objects"]), "no cylinder")
        page.do("run.start")
        page.do("world.press", robot="alice", button="center", down=True)
        self.refused("bad_input", "world.move", at=[1, 1])
        self.refused("bad_input", "world.move", robot="alice", at=[99, 1])
        self.refused("bad_input", "world.put", kind="box", at=[1e300, 1], size=[1, 1])
        self.refused("bad_input", "world.put", kind="box", at=[1], size=[1, 1])
        self.refused("bad_input", "world.put", kind="box", at=[1, 1], size=[])
        self.refused("bad_input", "world.put", kind="patch", at=[1, 1], radius=1, colour=[1, 1])
        self.assertIn("object", self.refused("bad_input", "world.take", object=4711))
        self.assertIn("robot", self.refused("bad_input", "world.press", robot="bob", button="center", down=True))
        self.assertIn("forward", self.refused("bad_input", "world.press", robot="alice", button="nose", down=True))
        self.wait_passed()

    def test_three_robots_of_one_kind_share_a_script_and_nothing_else(self):
        robots = [{**ROBOT, "name": name, "at": [0.5, 0.5 + i], "node": 1 + i} for i, name in enumerate(("alice", "bob", "carol"))]
        page = self.open(lambda folder: projects.thymio(folder, *robots))
        self.wait(lambda: len(self.robot.value["nodes"]) == 3 and all(node["program"] == "current" for node in self.robot.value["nodes"]),
                  "three nodes with the script")
        self.assertEqual([(node["id"], node["name"], node["robot"], node["doc"]) for node in self.robot.value["nodes"]],
                         [(1, "thymio-II", "alice", DOC), (2, "thymio-II", "bob", DOC), (3, "thymio-II", "carol", DOC)])
        page.do("run.start")
        page.do("node.pause", node=2)
        self.wait_node(2, state="paused", why="asked")
        page.do("variable.set", node=3, name="speed", first=0, values=[9])
        for node, speed in ((1, 0), (2, 0), (3, 9)):
            self.wait_values(node, speed=speed)
        page.do("node.run", node=2)
        self.wait_node(2, state="running")
        page.do("break.set", doc=DOC, line=LAST_LINE, condition="n > 50 and _id == 3")
        self.wait_clock("paused")
        self.wait_node(3, state="paused", why="breakpoint")
        self.wait_node(1, state="running")
        self.wait_node(2, state="running")
        self.assertEqual(page.do("stop")["stood"], [1, 2, 3])

    def test_each_camera_that_is_watched_is_seen(self):
        # One looks at a red box half a metre ahead, the other along an empty room.
        robots = [{"name": "red", "type": "carbot", "at": [2, 1], "node": 1}, {"name": "empty", "type": "carbot", "at": [2, 7], "node": 21}]

        def make(folder):
            projects.write(folder, "room.world.json", {
                "format": "vagus-world/1", "name": "Room", "size": [8, 8], "robots": robots,
                "objects": [{"kind": "box", "at": [2.8, 1], "size": [0.2, 1], "height": 0.6, "colour": [1, 0, 0]}]})
            projects.write(folder, "vagus.json", {"format": "vagus-project/1", "name": "Cameras", "world": "room.world.json", "target": "sim"})

        page = self.open(make)
        seen = {robot["name"]: page.watch("picture", robot=robot["name"]) for robot in robots}
        nobody = page.watch("picture", robot="nobody")
        self.wait(lambda: all(watched.frames for watched in seen.values()), "a picture of each camera")

        def share_of_red(name):
            payload = seen[name].frames[-1][1]
            width, height = struct.unpack_from("<HH", payload)
            self.assertEqual(len(payload), 4 + 3 * width * height)
            pixels = [payload[at:at + 3] for at in range(4, len(payload), 3)]
            return len([pixel for pixel in pixels if pixel[0] > 2 * pixel[1] and pixel[0] > 2 * pixel[2]]) / len(pixels)

        self.assertGreater(share_of_red("red"), 0.1)
        self.assertEqual(share_of_red("empty"), 0)
        page.do("unwatch", watch=[number for number, topic in page.topics.items() if topic is seen["red"]][0])
        there = len(seen["empty"].frames)
        page.do("run.start")
        self.wait(lambda: len(seen["empty"].frames) > there + 2, "more of the camera that is still watched")
        self.assertFalse(nobody.frames)

    def test_a_hundred_robots(self):
        robots = [{**ROBOT, "name": f"r{i}", "at": [0.2 + 0.2 * (i % 10), 0.2 + 0.2 * (i // 10)], "node": i + 1} for i in range(100)]
        page = self.open(lambda folder: projects.thymio(folder, *robots))
        self.wait(lambda: len([node for node in self.robot.value["nodes"] if node["program"] == "current"]) == 100, "a hundred nodes")
        moves = page.watch("poses")
        page.do("run.start")
        page.do("event.send", name="go", args=[50])
        self.wait_passed(0.3)
        self.wait(lambda: moves.frames and len(poses(moves.frames[-1])) == 100, "poses of all")
        self.assertEqual(page.do("stop")["stood"], list(range(1, 101)))
        self.wait_clock("none")


class Breakpoints(Case):
    def test_the_clock_stands_where_a_script_does(self):
        page = self.open()
        self.assertEqual(page.do("break.set", doc=DOC, line=N_LINE - 1), {"line": N_LINE})
        page.do("run.start")
        self.wait_node(state="paused", why="breakpoint", at={"line": N_LINE, "column": 1})
        self.wait_clock("paused")
        stood = self.clock.value["t"]
        for line in (LAST_LINE, EMIT_LINE):
            page.do("run.step")
            self.wait_node(state="paused", why="step", at={"line": line, "column": 1})
        page.do("break.clear", doc=DOC, line=N_LINE)
        self.wait(lambda: not self.breakpoints.value["breakpoints"], "no breakpoint")
        page.do("run.start")
        self.wait_clock("running")
        self.assertGreaterEqual(self.clock.value["t"], stood)
        self.wait_passed()
        self.assertEqual(self.node()["state"], "running")

    def test_two_breakpoints_of_one_moment_stop_the_clock_twice(self):
        page = self.open()
        page.do("break.set", doc=DOC, line=N_LINE)
        page.do("break.set", doc=DOC, line=EMIT_LINE)
        for n in range(1, 6):
            for line in (N_LINE, EMIT_LINE):
                page.do("run.start")
                self.wait_node(state="paused", why="breakpoint", at={"line": line, "column": 1})
                self.wait_clock("paused")
            self.wait_values(n=n)

    def test_a_condition_and_hits_that_are_let_pass(self):
        page = self.open()
        page.do("break.set", doc=DOC, line=LAST_LINE, condition="n == 20")
        page.do("run.start")
        self.wait_node(state="paused", why="breakpoint")
        self.wait_values(n=20, last=38)
        page.do("break.clear")
        page.do("break.set", doc=DOC, line=EMIT_LINE, ignore=3)
        page.do("run.start")
        self.wait_node(state="paused", why="breakpoint", at={"line": EMIT_LINE, "column": 1})
        self.wait_values(n=23)
        # Hits are told behind the state of the node.
        self.wait(lambda: [one["hits"] for one in self.breakpoints.value["breakpoints"]] == [4], "its fourth hit")
        (there,) = self.breakpoints.value["breakpoints"]
        self.assertEqual((there["line"], there["set"]), (EMIT_LINE, True))

    def test_it_stays_without_a_robot_and_over_a_restart(self):
        page = self.open()
        page.do("break.set", doc=DOC, line=N_LINE, condition="n > 5")
        page.do("target.leave")
        page.do("project.close")
        page.do("project.open", path=str(self.folder))
        self.wait(lambda: self.breakpoints.value["breakpoints"], "the breakpoint of before")
        self.assertEqual(self.breakpoints.value["breakpoints"][0]["condition"], "n > 5")
        self.refused("not_found", "break.set", doc="nowhere.aesl#1", line=1)
        self.refused("bad_input", "break.set", doc=DOC, line=1000)


class Plans(Case):
    def open_plan(self, **more):
        def make(folder):
            projects.write(folder, "rounds.plan.json", PLAN)
            projects.thymio(folder, plan="rounds.plan.json", **more)
        return self.open(make)

    def rounds(self):
        levels = self.plan.value["levels"]
        return next((one["value"] for one in levels[0]["variables"] if one["name"] == "rounds"), None) if levels else None

    def wait_plan(self, state):
        self.wait(lambda: self.plan.value["state"] == state, f"plan {state}")

    def test_a_project_with_a_plan_runs_it_and_tells_its_story(self):
        page = self.open_plan()
        page.do("run.start", set={"limit": 5})
        self.wait_plan("ended")
        self.assertEqual((self.plan.value["result"], self.plan.value["doc"]), ("OK", "rounds.plan.json"))
        story = [line["text"] for line in self.plan.value["story"]]
        self.assertEqual(story.count("round"), 5)
        self.assertIn("Rounds is over: OK", story[-1])

    def test_pause_step_set_stop(self):
        page = self.open_plan()
        self.refused("unavailable", "plan.pause")
        page.do("run.start")
        self.wait(lambda: self.rounds() not in (None, 0), "a round")
        page.do("plan.pause")
        self.wait_plan("paused")
        page.do("plan.set", level=0, name="rounds", value=1000)
        self.wait(lambda: self.rounds() in (1000, 1001), "the variable")  # an instant passes while it is set
        self.assertIn("nothing", self.refused("bad_input", "plan.set", level=0, name="nothing", value=1))
        self.refused("bad_input", "plan.set", level=0, name="rounds", value="many")
        before = self.plan.value["levels"][0]["activation"]
        page.do("plan.step")
        self.wait(lambda: self.plan.value["state"] == "paused" and self.plan.value["levels"][0]["activation"] > before, "the next actor")
        page.do("plan.continue")
        self.wait(lambda: self.rounds() > 1003, "more rounds")
        page.do("plan.stop")
        self.wait_plan("ended")
        self.assertEqual(self.plan.value["result"], "Interrupted")

    def test_stop_ends_the_plan_and_it_starts_again(self):
        page = self.open_plan()
        page.do("run.start")
        self.wait(lambda: self.rounds(), "a round")
        page.do("stop")
        self.wait(lambda: self.plan.value["state"] in ("ended", "none"), "the end of the plan")
        self.wait_clock("none")
        page.do("run.start")
        self.wait(lambda: self.plan.value["state"] == "running" and self.rounds(), "rounds again")

    def test_a_plan_steps_from_its_beginning(self):
        page = self.open_plan()
        page.do("plan.step")
        self.wait(lambda: self.plan.value["levels"] and self.plan.value["levels"][0]["actor"], "an actor")
        self.wait_plan("paused")

    def plan_breakpoint(self):
        (there,) = self.breakpoints.value["plans"]
        return there

    def test_a_plan_stands_at_its_breakpoint_and_the_world_with_it(self):
        page = self.open_plan()
        number = page.do("plan.break.set", doc="rounds.plan.json", kind="actor", element="say", stop_at=2)["number"]
        page.do("run.start")
        self.wait(lambda: self.plan.value.get("stands_at") == [number], "the breakpoint")
        self.wait_plan("paused")
        self.wait_clock("paused")
        level = self.plan.value["levels"][0]
        self.assertEqual((level["actor"], level["activation"]), ("say", 5))  # say, wait, count, enough, say
        stood = self.clock.value["t"]
        self.wait(lambda: self.plan_breakpoint()["hits"] == 2 and self.plan_breakpoint()["set"], "two hits")
        self.wait_node(state="running")  # and it answers
        page.do("plan.set", level=0, name="rounds", value=100)
        self.wait(lambda: self.rounds() == 100, "the variable")
        self.assertEqual((self.plan.value["state"], self.clock.value["t"]), ("paused", stood))
        page.do("plan.break.set", doc="rounds.plan.json", kind="actor", element="say", enabled=False)
        page.do("plan.continue")
        self.wait(lambda: self.rounds() > 101, "rounds from there")
        self.assertNotIn("stands_at", self.plan.value)
        page.do("plan.break.set", doc="rounds.plan.json", kind="state", element="say", outcome="Done")  # while it runs
        self.wait(lambda: self.plan.value.get("stands_at"), "the second breakpoint")
        page.do("plan.step")
        self.wait(lambda: "stands_at" not in self.plan.value and self.plan.value["state"] == "paused", "the next actor")
        page.do("stop")  # also from where it stands
        self.wait(lambda: self.plan.value["state"] in ("ended", "none"), "the end of the plan")
        page.do("plan.break.clear")
        self.wait(lambda: not self.breakpoints.value["plans"], "no breakpoint")

    def test_a_plan_stands_at_its_first_actor_before_the_world_begins(self):
        page = self.open_plan()
        page.do("plan.break.set", doc="rounds.plan.json", kind="actor", element="say")
        page.do("run.start")  # is answered when the nodes are ready
        self.wait(lambda: self.plan.value.get("stands_at"), "the breakpoint")
        self.wait_clock("paused")
        self.assertEqual((self.clock.value["t"], self.plan.value["levels"][0]["activation"]), (0, 1))
        page.do("run.start")
        self.wait(lambda: self.plan.value["levels"][0]["activation"] == 5, "the second round")
        self.wait_clock("paused")

    def test_breakpoints_of_a_plan_are_kept_and_those_that_do_not_fit_say_why(self):
        page = self.open_plan()
        self.assertIn("needs one", self.refused("bad_input", "plan.break.set", doc="rounds.plan.json", kind="condition"))
        page.do("plan.break.set", doc="rounds.plan.json", kind="condition", condition="rounds == 3")
        page.do("project.close")
        page.do("project.open", path=str(self.folder))
        self.wait(lambda: self.breakpoints.value["plans"], "the breakpoint of before")
        self.assertFalse(self.plan_breakpoint()["set"])
        page.do("run.start")
        self.wait(lambda: self.plan.value.get("stands_at"), "the condition")
        self.assertEqual(self.rounds(), 3)
        # Set newly, it must be there; one that was set before stays, and says why it does not fit.
        why = self.refused("not_found", "plan.break.set", doc="rounds.plan.json", kind="actor", element="sey")
        self.assertIn("did you mean say?", why)
        self.refused("not_found", "plan.break.set", doc="none.plan.json", kind="actor", element="say")
        page.do("plan.break.set", doc="rounds.plan.json", kind="actor", element="wait")
        page.do("stop")
        pause = PLAN["actors"]["wait"]
        page.do("doc.patch", doc="rounds.plan.json", version=page.do("doc.open", doc="rounds.plan.json")["version"], steps=[
            {"do": "set", "at": ["actors", "pause"], "value": pause},
            {"do": "set", "at": ["actors", "say", "states", "Done"], "value": "pause"},
            {"do": "remove", "at": ["actors", "wait"]}])
        page.do("doc.save", doc="rounds.plan.json")
        page.do("run.start")
        self.wait(lambda: any('has no actor "wait"' in one.get("why", "") for one in self.breakpoints.value["plans"]), "why it is not set")

    def test_an_event_is_raised_by_hand(self):
        def make(folder):
            late = {"template": "Timeout", "in": {"seconds": 1000}, "events": {"Timeout": "@terminate"}}
            projects.write(folder, "rounds.plan.json", projects.PLAN | {"start": {"actor": "say", "supervisors": {"late": late}}})
            projects.thymio(folder, plan="rounds.plan.json")
        page = self.open(make)
        self.refused("unavailable", "plan.raise", supervisor="late", event="Timeout")
        page.do("run.start")
        self.wait(lambda: self.rounds(), "a round")
        self.assertIn("late", self.refused("bad_input", "plan.raise", supervisor="lat", event="Timeout"))
        page.do("plan.raise", supervisor="late", event="Timeout")
        self.wait_plan("ended")
        self.assertEqual(self.plan.value["result"], "Interrupted")
        self.assertIn("late: Timeout → @terminate", [line["text"] for line in self.plan.value["story"]])

    def test_a_plan_goes_on_into_the_handler_of_its_event(self):
        def make(folder):
            send = {"template": "Send", "in": {"event": "'go'", "args": "'0'"}, "states": {"Sent": "say"}}
            plan = copy.deepcopy(PLAN)
            plan["actors"]["say"]["states"]["Done"] = "send"
            plan["actors"]["send"] = send | {"states": {"Sent": "wait"}}
            projects.write(folder, "rounds.plan.json", plan)
            projects.thymio(folder, plan="rounds.plan.json")
        page = self.open(make)
        (spot,) = page.do("script.handlers", events=["go"])["spots"]
        self.assertEqual((spot["doc"], spot["at"], spot["line_text"]), (DOC, {"line": 7, "column": 9}, "onevent go"))
        self.refused("unavailable", "plan.into", events=["go"])
        page.do("plan.break.set", doc="rounds.plan.json", kind="actor", element="send")
        page.do("run.start")
        self.wait(lambda: self.plan.value.get("stands_at"), "the breakpoint")
        self.assertIn("no script", self.refused("not_found", "plan.into", events=["gone"]))
        self.assertEqual(page.do("plan.into", events=["go"])["spots"], [spot])
        self.wait_node(state="paused", why="breakpoint", at={"line": 8, "column": 1})
        self.wait_clock("paused")
        self.assertEqual(self.breakpoints.value["breakpoints"], [])  # nobody has set one
        page.do("plan.break.clear")
        page.do("run.start")
        self.wait(lambda: self.rounds() and self.rounds() > 2, "rounds: it stood once")

    def test_run_lets_a_node_go_that_stands_at_a_line_beside_a_plan(self):
        page = self.open_plan()
        page.do("break.set", doc=DOC, line=N_LINE)
        page.do("run.start")
        for n in range(3):  # the line counts when it has been executed
            self.wait_node(state="paused", why="breakpoint", at={"line": N_LINE, "column": 1})
            self.wait_clock("paused")
            self.wait_values(n=n)
            page.do("run.start")
        page.do("break.clear")
        page.do("run.start")
        self.wait(lambda: self.rounds() and self.rounds() > 2, "rounds")
        self.wait_node(state="running")

    def test_templates_of_ones_own_run_on_a_thymio_as_they_are(self):
        def make(folder):
            projects.write(folder, "rounds.plan.json", PLAN)
            projects.thymio(folder, plan="rounds.plan.json")
        page = self.open(make)
        page.do("template.new", name="Purr", kind="actor", script=DOC, help="")
        page.do("template.new", name="Notice", kind="supervisor", script=DOC, help="")
        plan = {"format": "vagus-plan/1", "name": "Own", "toolboxes": ["own"],
                "configuration": {"rounds": {"type": "int", "initial": 0}},
                "start": {"actor": "purr"},
                "actors": {
                    "purr": {"template": "Purr", "states": {"Done": "count"},
                             "supervisors": {"notice": {"template": "Notice", "events": {"Raised": "@terminate"}}}},
                    "count": {"template": "Assign", "in": {"value": "rounds + 1"}, "out": {"result": "rounds"}, "states": {"Done": "enough"}},
                    "enough": {"template": "Compare", "in": {"left": "rounds", "op": "'>='", "right": 3},
                               "states": {"True": "@terminate", "False": "purr"}}}}
        text = page.do("doc.open", doc="rounds.plan.json")["text"]
        page.edit("rounds.plan.json", (0, len(text), json.dumps(plan)))
        page.do("run.start")
        self.wait_plan("ended")
        # The node counts half a second for each turn, and its supervisor stops none.
        story = [line["text"] for line in self.plan.value["story"]]
        self.assertEqual((self.plan.value["result"], story.count("purr: Done → count")), ("OK", 3))
        self.assertGreater(self.plan.value["t"], 1.5)

    def test_turns_are_counted_and_the_arrow_taken_is_told(self):
        page = self.open_plan()
        page.do("plan.break.set", doc="rounds.plan.json", kind="actor", element="say", stop_at=3)
        page.do("run.start")
        self.wait(lambda: self.plan.value.get("stands_at"), "the breakpoint")
        level = self.plan.value["levels"][0]
        counts = {one["name"]: (one["is"], one["times"]) for one in level["counts"]}
        self.assertEqual(counts, {name: ("actor", 2) for name in ("say", "wait", "count", "enough")})
        taken = level["taken"]
        self.assertEqual((taken["is"], taken["element"], taken["outcome"], taken["target"]), ("state", "enough", "False", "say"))

    def test_a_plan_with_a_mistake_says_where(self):
        page = self.open_plan()
        at = page.do("doc.open", doc="rounds.plan.json")["text"].index('"Wait"')
        page.edit("rounds.plan.json", (at, at + 6, '"Weit"'))
        self.assertIn("Weit", self.refused("failed", "run.start"))
        self.wait_clock("none")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:])], verbosity=2, warnings="ignore")
