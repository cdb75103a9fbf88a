"""What the server keeps of a run: any instant of it, what a timeline draws, and traces as files."""
import json
import pathlib
import shutil
import sys
import tempfile
import unittest

import bus_plans
import projects
from cases import Case
from harness import listening, run_vagus, simulated
from mcap import Recording
from projects import PLAN

EXAMPLES = pathlib.Path(__file__).resolve().parent.parent.parent / "examples"


def levels_of(instant):
    return instant["plan"]["levels"]


def value_of(instant, name):
    return next(one["value"] for one in levels_of(instant)[0]["variables"] if one["name"] == name)


class HistoryCase(Case):
    def open_plan(self):
        page = self.open()
        projects.write(self.folder, "Rounds.plan.json", PLAN)
        projects.write(self.folder, "vagus.json", {**json.loads((self.folder / "vagus.json").read_text(encoding="utf-8")),
                                                   "plan": "Rounds.plan.json"})
        page.do("project.open", path=str(self.folder))
        self.history = page.watch("history")
        return page

    def run_for(self, seconds):
        self.page.do("plan.start")
        self.wait(lambda: self.clock.value["t"] > seconds, f"{seconds} s of a run")

    def words(self, *names):
        described = self.page.watch("node", node=1)
        self.wait(lambda: described.value and described.value["variables"], "a description")
        places = {one["name"]: one["address"] for one in described.value["variables"]}
        return [places[name] for name in names]


class AnInstant(HistoryCase):
    def test_ThePlanOfAnInstantIsThatOfItsTrace(self):
        """A round takes 0.1 s: at 0.05 s none is done, at 0.25 s two, and the third waits since 0.2 s."""
        self.open_plan()
        self.run_for(1)
        for t, rounds, since in ((0.05, 0, 0), (0.1, 1, 0.1), (0.25, 2, 0.2), (0.999, 9, 0.9)):
            instant = self.page.do("history.at", t=t)
            self.assertEqual((instant["t"], value_of(instant, "rounds")), (t, rounds), instant)
            self.assertEqual(levels_of(instant)[0]["actor"], "wait")
            self.assertAlmostEqual(levels_of(instant)[0]["since"], since, places=6)
        # Decisions are made without time: wait ends each tenth of a second, and the four steps of a round follow at once.
        around = self.page.do("history.at", t=0.25)
        self.assertAlmostEqual(around["before"], 0.2, places=6)
        self.assertAlmostEqual(around["next"], 0.3, places=6)

    def test_AllVariablesAreKeptThoughNobodyLooked(self):
        """n counts the ticks of 10 ms, last is twice n: also at an instant, and a second later n is 100 more."""
        self.open_plan()
        n, last = self.words("n", "last")
        self.run_for(1.6)
        first, later = (self.page.do("history.at", t=t, ranges=[[1, n, 1], [1, last, 1]]) for t in (0.5, 1.5))
        values = [[one["words"][0] for one in instant["values"]] for instant in (first, later)]
        for now, twice in values:
            self.assertEqual(twice, 2 * now)
        self.assertEqual(values[1][0] - values[0][0], 100)

    def test_ARobotIsWhereItWas(self):
        self.open_plan()
        self.run_for(0.3)
        self.page.do("run.pause")
        stood = self.settled()
        self.page.do("world.move", robot="alice", at=[1.5, 1.25], angle=0)
        self.page.do("run.start")
        self.wait(lambda: self.clock.value["t"] > stood + 0.3, "time after the hand")
        before, after = (self.page.do("history.at", t=t)["robots"][0] for t in (stood - 0.05, stood + 0.2))
        self.assertEqual([round(one, 3) for one in before[1:3]], [0.5, 0.5])
        self.assertEqual([round(one, 3) for one in after[1:3]], [1.5, 1.25])

    def test_EventsOfAnInstantAreThoseUntilThen(self):
        self.open_plan()
        self.run_for(1)
        events = self.page.do("history.at", t=0.5, events=2000)["events"]
        told = [one["args"][0] for one in events if one["name"] == "told"]
        self.assertEqual(told, list(range(told[0], told[0] + len(told))))
        self.assertTrue(all(one["t"] <= 0.5 for one in events))
        # One each 10 ms: none of the last 20 ms is missing.
        self.assertGreater(events[-1]["t"], 0.48)
        few = self.page.do("history.at", t=0.5, events=3)["events"]
        self.assertEqual([one["number"] for one in few], [one["number"] for one in events[-3:]])

    def test_WhatRanStaysUntilSomethingElseGoes(self):
        self.open_plan()
        self.run_for(0.5)
        self.page.do("stop")
        self.wait_clock("none")
        run, to = self.history.value["run"], self.history.value["to"]
        self.page.do("run.reset")
        self.wait(lambda: self.clock.value["t"] == 0, "a world at its start")
        self.assertEqual(self.history.value["run"], run)
        self.assertEqual(value_of(self.page.do("history.at", t=0.25), "rounds"), 2)
        self.assertGreaterEqual(self.history.value["to"], to)
        self.page.do("plan.start")
        self.wait(lambda: self.history.value["run"] != run and self.history.value["to"] > 0.1, "another run")


class ATimeline(HistoryCase):
    def lanes(self, start, end, width, **more):
        return self.page.do("history.lanes", **{"from": start, "to": end}, width=width, **more)

    def test_BarsAreTheActivationsOfActors(self):
        self.open_plan()
        self.run_for(1)
        lanes = self.lanes(0, 1, 1000)
        actors = next(lane for lane in lanes["lanes"] if lane["kind"] == "actors")
        waits = [(round(bar["from"], 6), round(bar["to"], 6), bar["end"]) for bar in actors["bars"]
                 if bar.get("name") == "wait" and "to" in bar]
        self.assertEqual(waits[:3], [(0, 0.1, "Done"), (0.1, 0.2, "Done"), (0.2, 0.3, "Done")])

    def test_AWideWindowHasNoMoreBarsThanPixels(self):
        self.open_plan()
        self.run_for(1)
        lanes = self.lanes(0, 1000, 50, words=[[1, 0]])
        for lane in lanes["lanes"]:
            self.assertLessEqual(len(lane["bars"]) + len(lane["marks"]), 100, lane["name"])
        self.assertEqual(len(lanes["curves"][0]["high"]), 50)
        # Nothing is known of what has not been yet.
        self.assertIsNone(lanes["curves"][0]["high"][-1])

    def test_ACurveHasTheLowestAndTheHighestOfEachPixel(self):
        self.open_plan()
        [n] = self.words("n")
        self.run_for(1)
        curve = self.lanes(0.2, 0.8, 6, words=[[1, n]])["curves"][0]
        for low, high in zip(curve["low"], curve["high"]):
            # A pixel is 0.1 s, in which n grows by 10; what holds at its edge is seen from both sides, and a look is 20 ms.
            self.assertTrue(8 <= high - low <= 12, (low, high))


class Traces(HistoryCase):
    def test_ATraceIsSavedAndOpenedWithoutARun(self):
        page = self.open_plan()
        page.do("plan.start", set={"limit": 5})
        self.wait(lambda: self.plan.value["state"] == "ended", "the end of the plan")
        path = page.do("history.save")["path"]
        self.assertEqual(path, "Rounds-1.trace.jsonl")
        self.assertEqual(page.do("history.save")["path"], "Rounds-2.trace.jsonl")
        lines = [json.loads(line) for line in (self.folder / path).read_text(encoding="utf-8").splitlines()]
        self.assertEqual((lines[0]["kind"], lines[-1]["kind"], lines[-1]["t"]), ("plan-start", "plan-end", 0.5))
        page.do("target.leave")
        opened = page.do("history.open", trace=path)
        self.assertEqual(opened, {"from": 0, "to": 0.5, "lines": len(lines), "refused": 0, "plan": True})
        then = page.do("history.at", t=0.25, trace=path)
        self.assertEqual((value_of(then, "rounds"), levels_of(then)[0]["actor"]), (2, "wait"))
        self.assertEqual(page.do("history.at", t=0.5, trace=path)["plan"]["result"], "OK")
        self.assertIn("a trace tells what a plan did, and not why", self.refused("failed", "why.ask", about="end", trace=path))

    def test_AFileThatIsNoTraceSaysWhereAndWhy(self):
        page = self.open_plan()
        good = '{"t":0.000000,"plan":"Nobody","kind":"plan-start"}\n'
        for name, content in (("empty", ""), ("text", "hello\n"), ("list", "[1]\n"), ("early", '{"t":-1,"plan":"a","kind":"b"}\n'),
                              ("binary", "\x00\x01\n")):
            projects.write(self.folder, f"{name}.trace.jsonl", content)
            said = self.refused("bad_input", "history.open", trace=f"{name}.trace.jsonl")
            self.assertIn(f"{name}.trace.jsonl:1: expected", said)
        projects.write(self.folder, "half.trace.jsonl", good + good[:20] + "\n" + good)
        opened = page.do("history.open", trace="half.trace.jsonl")
        self.assertEqual((opened["lines"], opened["refused"], opened["plan"]), (2, 1, False))
        for outside in ("../vagus.json", "/etc/passwd", "no.trace.jsonl", ".vagus/state.json"):
            with self.assertRaises(Exception):
                page.do("history.open", trace=outside)

    def test_WithoutARunThereIsNothingToSave(self):
        self.open_plan()
        self.assertIn("no plan has run", self.refused("unavailable", "history.save"))


class OnABus(Case):
    open_robot, wait_plan = bus_plans.BusPlans.open_robot, bus_plans.BusPlans.wait_plan

    def test_WhatWasNotWatchedIsNotRecorded(self):
        """speed is watched from some instant on, and not any more after another; last never."""
        page = self.open_robot()
        history = page.watch("history")
        described = page.watch("node", node=1)
        self.wait(lambda: described.value and described.value["variables"], "a description")
        places = {one["name"]: one["address"] for one in described.value["variables"]}
        speed, last = places["motor.left.target"], places["motor.right.target"]
        ranges = [[1, speed, 1], [1, last, 1]]

        def at(t):
            return [one["words"][0] for one in page.do("history.at", t=t, ranges=ranges)["values"]]

        before = history.value["to"]
        watched = page.watch("variables", node=1, ranges=[[speed, 1]])
        self.wait(lambda: watched.frames, "a value")
        self.wait(lambda: at(1e6) == [0, None], "a value that is kept")
        self.assertEqual(at(before / 2), [None, None])
        page.do("unwatch", watch=len(page.topics))
        self.wait(lambda: at(1e6) == [None, None], "what nobody watches is not known")
        self.assertEqual(history.value["kind"], "bus")

    def test_ThePlanOfABusIsKept(self):
        page = self.open_robot()
        page.do("run.start", set={"limit": 3})
        self.wait_plan("ended")
        history = page.do("history.at", t=1e6)
        self.assertEqual(history["plan"]["result"], "OK")
        rounds = next(one["value"] for one in history["plan"]["levels"][0]["variables"] if one["name"] == "rounds") \
            if history["plan"]["levels"] else 3
        self.assertEqual(rounds, 3)
        lanes = page.do("history.lanes", **{"from": 0, "to": 60}, width=1000)
        names = {bar.get("name") for lane in lanes["lanes"] if lane["kind"] == "actors" for bar in lane["bars"]}
        self.assertIn("wait", names)


class ARecordingOfARobot(Case):
    """Its run cannot be run again: what was recorded is shown."""

    def open_recorded(self):
        arena = self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-arena-"))
        robot = self.enterContext(simulated(arena, {"name": "alice", "node": 1}))
        bus = f"tcp:127.0.0.1:{listening(robot)}"

        def make(folder):
            projects.bus(folder, "sim", name="thymio-II")
            projects.write(folder, "drive.plan.json", bus_plans.PLAN)
            run_vagus("plan", "run", folder / "drive.plan.json", "--bus", bus, "--project", folder / "robot.aesl", "--quiet", "--set",
                      "limit=3", "--record", folder / "monday.mcap")

        return self.open(make)

    def test_ItIsLookedAtWithoutTheRobot(self):
        page = self.open_recorded()
        told = page.do("recording.open", path="monday.mcap")
        self.assertEqual(told["again"], False)
        self.assertRegex(told["why"], "monday.mcap: is a recording of a real bus")
        opened = page.do("history.open", trace="monday.mcap")
        self.assertEqual((opened["from"], opened["refused"], opened["plan"]), (0, 0, True))
        end = page.do("history.at", t=opened["to"], events=100, trace="monday.mcap")
        self.assertEqual((end["plan"]["result"], end["plan"]["doc"]), ("OK", "drive.plan.json"))
        self.assertIn(["main", "go", [150]], [[one["source"], one["name"], one["args"]] for one in end["events"]])
        lanes = page.do("history.lanes", **{"from": 0, "to": opened["to"]}, width=1000, trace="monday.mcap")["lanes"]
        chain = page.do("why.ask", about="actor", name="wait", t=opened["to"], trace="monday.mcap")["chain"]
        self.assertEqual((chain[0]["what"], chain[0]["doc"]), ("the actor wait ended with Done", "drive.plan.json"))
        (actors,) = [lane for lane in lanes if lane["kind"] == "actors"]
        self.assertEqual(len([bar for bar in actors["bars"] if bar.get("name") == "wait"]), 3)

    def test_WithoutItsPlanOrDamagedItIsToldWhatIsThere(self):
        page = self.open_recorded()
        recording = (self.folder / "monday.mcap").read_bytes()
        (self.folder / "drive.plan.json").unlink()
        (self.folder / "cut.mcap").write_bytes(recording[:-100])
        self.assertFalse(page.do("history.open", trace="cut.mcap")["plan"])
        lanes = page.do("history.lanes", **{"from": 0, "to": 1}, width=1000, trace="cut.mcap")["lanes"]
        self.assertIn("wait", {bar.get("name") for lane in lanes if lane["kind"] == "actors" for bar in lane["bars"]})
        (self.folder / "text.mcap").write_text("hello")
        self.assertIn("text.mcap", self.refused("bad_input", "history.open", trace="text.mcap"))
        self.assertIn("there is no such file", self.refused("not_found", "history.open", trace="none.mcap"))
        self.assertIn("there is no such file", self.refused("not_found", "history.open", trace="../monday.mcap"))


class ARecordingOfAFleet(Case):
    """Ten robots, each with a plan of its own: what was recorded is shown, robot by robot."""

    def open_recorded(self):
        def make(folder):
            for name in ("carbot", "warehouse"):
                shutil.copytree(EXAMPLES / name, folder / name)
            shutil.copy(EXAMPLES / "vagus.json", folder)
            run_vagus("sim", folder / "warehouse/hall.world.json", "--headless", "--speed", "max", "--duration", 60, "--record",
                      folder / "run.mcap")

        page = self.open(make)
        self.assertIn("10 robots have projects of their own", page.do("recording.open", path="run.mcap")["why"])
        return page, Recording(self.folder / "run.mcap")

    def test_ItsWorldAndItsEventsAreThereAtAnyInstant(self):
        page, recording = self.open_recorded()
        opened = page.do("history.open", trace="run.mcap")
        names = [f"r{number}" for number in range(1, 11)]
        self.assertEqual(([one["name"] for one in opened["scene"]["robots"]], len(opened["scene"]["objects"])), (names, 6))
        self.assertEqual(opened["to"], recording.messages[-1][1])
        then = page.do("history.at", t=60, events=2000, trace="run.mcap")
        update = json.loads(next(data for topic, t, data in recording.messages if topic == "/world/poses" and t == 60))
        for entity in update["entities"]:
            place = entity["cubes"][0]["pose"]["position"]
            (pose,) = [pose for pose in then["robots"] if f"robot/{names[pose[0]]}" == entity["id"]]
            self.assertEqual([round(value, 4) for value in pose[1:3]], [round(place[axis], 4) for axis in "xy"])
        told = [[one["source"], one["name"], one["args"]] for one in then["events"]]
        for robot in names:
            events = [one for one in recording.json(f"/robot/{robot}/bus/events") if one["t"] <= 60]
            expected = [[robot if one["node"] == 0 else f"{robot}/drive", one["name"], one["args"]] for one in events]
            self.assertEqual([one for one in told if one[0].split("/")[0] == robot], expected)

    def test_ThePlanOfEachRobotIsShownAndAskedWhy(self):
        page, recording = self.open_recorded()
        for asked, robot in (({}, "r1"), ({"robot": "r2"}, "r2")):
            opened = page.do("history.open", trace="run.mcap", **asked)
            self.assertEqual((opened["robot"], opened["plan"], opened["refused"]), (robot, True, 0))
            lines = recording.json(f"/robot/{robot}/plan/trace")
            self.assertEqual(opened["lines"], len(lines))
            begun = [line for line in lines if line["kind"] == "actor-start"][-1]
            then = page.do("history.at", t=begun["t"], trace="run.mcap", **asked)
            self.assertEqual((levels_of(then)[0]["actor"], levels_of(then)[0]["doc"]), (begun["actor"], "warehouse/picker/Pick.plan.json"))
            chain = page.do("why.ask", about="actor", name=begun["actor"], t=begun["t"] + 0.001, trace="run.mcap", robot=robot)["chain"]
            self.assertEqual(chain[0]["what"], f"{robot}: the actor {begun['actor']} began")
        self.assertIn("no robot r11", self.refused("not_found", "history.open", trace="run.mcap", robot="r11"))


class Hostile(HistoryCase):
    def test_WhatCannotBeMeantIsRefusedWithItsPlace(self):
        self.open_plan()
        self.run_for(0.2)
        for fields, part in (({"t": -1}, "in.t"), ({"t": 1e13}, "in.t"), ({"t": 0, "ranges": [[1, 2]]}, "in.ranges[0]"),
                             ({"t": 0, "ranges": [[1, 0, 1], "x"]}, "in.ranges[1]"), ({"t": 0, "ranges": [[1, -1, 1]]}, "in.ranges[0]"),
                             ({"t": 0, "ranges": [[70000, 0, 1]]}, "in.ranges[0]")):
            self.assertIn(part, self.refused("bad_input", "history.at", **fields))
        for start, end, more, part in ((1, 1, {}, "in.to"), (2, 1, {}, "in.to"), (-1, 1, {}, "in.from"),
                                       (0, 1, {"words": [[1]]}, "in.words[0]"), (0, 1, {"words": [{}]}, "in.words[0]")):
            said = self.refused("bad_input", "history.lanes", **{"from": start, "to": end}, width=10, **more)
            self.assertIn(part, said)
        self.refused("bad_message", "history.lanes", **{"from": 0, "to": 1}, width=5000)
        self.refused("bad_message", "history.at", t=0, events=3000)
        # Far away, and words that no node has: unknown, not refused.
        found = self.page.do("history.at", t=1e12, ranges=[[1, 65535, 1], [9, 0, 2], [1, 65535, 65535]])
        self.assertEqual(found["values"][0]["words"], [None])
        self.assertEqual(found["values"][1]["words"], [None, None])
        self.assertLessEqual(found["t"], found["to"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:] or ["AnInstant", "ATimeline", "Traces", "OnABus", "Hostile"])], verbosity=2, warnings="ignore")
