"""Recordings of worlds whose robots have projects of their own: compared robot by robot, asked why across robots, with log
points, and continued until something was decided."""
import json
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import run_vagus

EXAMPLES = pathlib.Path(__file__).resolve().parent.parent.parent / "examples"

# A member asks 3 s long whether another one has its name, so what it sends before waits: this timer runs out for the 50th time
# at 5.001 s. The event is on the bus then, and the host hears it at 5.002 s; each of the two ways takes 5 ms, so another robot
# has it at 5.012 s, and its node hears it at 5.013 s.
CALL = """var ticks = 0
timer.period[0] = 100

onevent timer0
	ticks++
	if ticks == 50 then
		emit alarm(ticks)
	end
"""
HEAR = """var got = 0

onevent alarm
	got = event.args[0]
	motor.left.target = 100
"""
ACT = """var n = 0

onevent go
	motor.left.target = event.args[0]
"""
# Before it hears the alarm it is idle; it obeys a2 alone.
OBEY = {"format": "vagus-plan/1", "name": "Obey", "toolboxes": ["fleet"], "start": {"actor": "idle"}, "actors": {
    "idle": {"template": "Wait", "in": {"seconds": 60}, "states": {"Done": "@terminate"}, "supervisors": {
        "called": {"template": "OnFleetEvent", "in": {"event": "'alarm'", "from": "'a2'"}, "events": {"FleetEvent": "act"}}}},
    "act": {"template": "Send", "in": {"event": "'go'", "args": "7"}, "states": {"Sent": "rest"}},
    "rest": {"template": "Wait", "in": {"seconds": 60}, "states": {"Done": "@terminate"}}}}
# A new keeper answers from 13 s on.
CLAIM = {"format": "vagus-plan/1", "name": "Claim", "toolboxes": ["fleet"],
         "configuration": {"lease": {"type": "string", "initial": ""}, "seen": {"type": "int", "initial": 5}},
         "start": {"actor": "claim"}, "actors": {
    "claim": {"template": "Claim", "in": {"name": "'dock'", "seconds": 10, "wait": 60}, "out": {"lease": "lease"},
              "states": {"Claimed": "hold", "NotFree": "claim", "NoKeeper": "claim"}},
    "hold": {"template": "Wait", "in": {"seconds": 3}, "states": {"Done": "release"}},
    "release": {"template": "Release", "in": {"lease": "lease"}, "states": {"Released": "rest", "NoKeeper": "rest"}},
    "rest": {"template": "Wait", "in": {"seconds": 100}, "states": {"Done": "@terminate"}}}}
PLAIN = "var n = 0\nmotor.left.target = 30\n"


def script(text, *events):
    declared = "".join(f'<event size="1" name="{name}"/>\n' for name in events)
    return (f'<!DOCTYPE aesl-source>\n<network>\n{declared}<keywords flag="true"/>\n<node nodeId="1" name="thymio-II">'
            f"<![CDATA[{text}]]></node>\n</network>\n")


class FleetRecordings(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-fleets-")))
        self.file = self.folder / "run.mcap"
        self.hall = self.folder / "hall"

    # ---- what is recorded ----

    def project(self, name, text, *events, plan=None, **fleet):
        """A folder beside the world, with one script and perhaps a plan."""
        folder = self.hall / name
        folder.mkdir(parents=True, exist_ok=True)
        (folder / f"{name}.aesl").write_text(script(text, *events))
        about = {"format": "vagus-project/1", "name": name, "scripts": [f"{name}.aesl"], "fleet": {"name": "hall", **fleet}}
        if plan:
            (folder / f"{plan['name']}.plan.json").write_text(json.dumps(plan, indent=1))
            about["plan"] = f"{plan['name']}.plan.json"
        (folder / "vagus.json").write_text(json.dumps(about))

    def make_hall(self, robots, timeline=()):
        self.project("call", CALL, "alarm", send=["alarm"])
        self.project("hear", HEAR, "alarm", hear=["alarm"])
        self.project("obey", ACT, "alarm", "go", plan=OBEY, hear=["alarm"])
        self.project("claim", "var n = 0\n", plan=CLAIM)
        (self.hall / "vagus.json").write_text(json.dumps({"format": "vagus-project/1", "name": "Hall"}))
        (self.hall / "plain.aesl").write_text(PLAIN)
        rows = [{"name": name, "type": "thymio2", "at": [0.5 + 0.5 * i, 1],
                 **({"project": of} if of else {"script": "plain.aesl"})} for i, (name, of) in enumerate(robots)]
        (self.hall / "hall.world.json").write_text(json.dumps(
            {"format": "vagus-world/1", "size": [10, 2], "robots": rows, "fleet": {"latency": 0.005, "jitter": 0},
             "timeline": list(timeline)}, indent=1))

    def record(self, seconds, *options, world=None, file=None):
        run_vagus("sim", world or self.hall / "hall.world.json", "--headless", "--speed", "max", "--duration", seconds,
                  "--record", file or self.file, *options)

    def record_alarm(self, seconds=6):
        """Two robots with one script call at the same instant; d has no project."""
        self.make_hall([("a1", "call"), ("a2", "call"), ("b", "hear"), ("p", "obey"), ("d", "")])
        self.record(seconds)

    # ---- what is asked ----

    def chain(self, *question):
        return json.loads(run_vagus("why", self.file, *question, "--json", "--all"))

    def told(self, *question):
        """(s, robot, sentence, value, place) of each link; a place as (file, what is written there)."""
        links = []
        for link in self.chain(*question):
            path, _, line = link["place"].rpartition(":")
            there = (self.hall / path).read_text().splitlines()[int(line) - 1].strip() if path else ""
            links.append((link["t"], link.get("robot", ""), link["what"], link["value"], path, there))
        return links

    def refused(self, *question, status=1):
        return run_vagus("why", self.file, *question, status=status)

    def hits(self, *options):
        lines = run_vagus("replay", self.file, *options, "--json").splitlines()
        self.assertIsNone(json.loads(lines[-1])["difference"])
        return [json.loads(line) for line in lines[:-1]]

    def line_of(self, file, text):
        lines = (self.hall / file).read_text().splitlines()
        return next(i + 1 for i, line in enumerate(lines) if text in line)

    # ---- why, across robots ----

    CALLED = [("call/call.aesl", "emit alarm(ticks)"), ("call/call.aesl", "ticks++")]

    def calls(self, robot):
        return [(5.001, robot, "the script of thymio-II emitted alarm", "50", *self.CALLED[0]),
                (5.001, robot, "a timer of thymio-II ran out: timer0", "The first timer: every timer.period[0] ms",
                 *self.CALLED[1])]

    def test_an_event_of_the_fleet_leads_to_the_robot_that_sent_it(self):
        """Both call with the same bytes at the same instant: the second one's comes last, and is the one that counts."""
        self.record_alarm()
        brought = (5.012, "b", "the fleet brought alarm from a2", "50", "", "")
        wheels = self.told("motor", "b")
        self.assertEqual(wheels, [
            (5.013, "b", "the script of thymio-II wrote motor.left.target", "100", "hear/hear.aesl", "motor.left.target = 100"),
            (5.013, "b", "thymio-II heard alarm", "50", "hear/hear.aesl", "got = event.args[0]"),
            brought, *self.calls("a2")])
        self.assertEqual(self.told("event", "alarm", "--robot", "b"), [brought, *self.calls("a2")])
        self.assertEqual(self.told("variable", "b/thymio-II.got"), [
            (5.013, "b", "the script of thymio-II wrote got", "50", "hear/hear.aesl", "got = event.args[0]"), *wheels[1:]])
        self.assertEqual([link["root"] for link in self.chain("motor", "b")], [False] * 4 + [True])
        for robot in ("a1", "a2"):
            self.assertEqual(self.told("event", f"{robot}/alarm"), self.calls(robot))

    def test_a_plan_that_hears_the_fleet(self):
        """It obeys a2, whose call comes behind that of a1 at one instant."""
        self.record_alarm()
        chain = self.told("motor", "p")
        self.assertEqual([one[:4] for one in chain], [
            (5.013, "p", "the script of thymio-II wrote motor.left.target", "7"),
            (5.013, "p", "thymio-II heard go", "7"),
            (5.012, "p", "the actor act of the plan sent go", "7"),
            (5.012, "p", "the actor act began", ""),
            (5.012, "p", "the supervisor called raised FleetEvent", ""),
            (5.012, "p", "the fleet brought alarm from a2", "50"),
            *[one[:4] for one in self.calls("a2")]])
        self.assertEqual([one[4] for one in chain[:5]], ["obey/obey.aesl"] * 2 + ["obey/Obey.plan.json"] * 3)
        self.assertIn('"called": {', chain[4][5])
        told = run_vagus("why", self.file, "actor", "act")
        self.assertIn("      5.012 s  p: the supervisor called raised FleetEvent  obey/Obey.plan.json:", told)
        self.assertIn("      5.001 s  a2: the script of thymio-II emitted alarm (50)  call/call.aesl:", told)

    def test_a_name_that_another_robot_gave_back(self):
        """Both ask from the beginning; the keeper serves from 13 s on, k1 has the name 3 s long, k2 asks each second."""
        self.make_hall([("k1", "claim"), ("k2", "claim")])
        self.record(25)
        chain = self.told("actor", "hold", "--robot", "k2")
        self.assertEqual([one[1:3] for one in chain], [
            ("k2", "the actor hold ended with Done"), ("k2", "the actor hold began"),
            ("k2", "the actor claim ended with Claimed"),
            ("k2", "the keeper of the fleet answered, done: the name dock"),
            ("k1", "the actor release of the plan gave the name dock back"), ("k1", "the actor release began"),
            ("k1", "the actor hold ended with Done"), ("k1", "the actor hold began"),
            ("k1", "the actor claim ended with Claimed"), ("k1", "the keeper of the fleet answered, done: the name dock"),
            ("k1", "the actor claim began"), ("k1", "the plan Claim began")])
        self.assertEqual({one[4] for one in chain if one[4]}, {"claim/Claim.plan.json"})
        had, gave = chain[7][0], chain[4][0]
        self.assertAlmostEqual(gave - had, 3, 6)
        self.assertGreater(had, 13)
        self.assertLess(chain[3][0], gave + 1.1)
        self.assertIn("by then 2 robots had an actor \"hold\": k1 and k2; say which one, as --robot k1",
                      self.refused("actor", "hold"))

    def test_a_robot_that_its_fleet_has_lost(self):
        """Cut off at 8 s: the broker misses it after 7.5 s, and it stops 5 s later."""
        self.make_hall([("p", "obey"), ("q", "obey")], [{"t": 8, "do": "cut", "robot": "p"}])
        self.record(22)
        self.assertEqual([one[1:4] for one in self.told("end")], [
            ("p", "the plan Obey ended: Interrupted", ""),
            ("p", 'p stopped by itself: not in the fleet "hall" for 5 s', ""),
            ("", "the timeline of the world cut the way of p to the fleet", "")])
        self.assertIn("by then no plan had ended", self.refused("end", "--robot", "q"))

    # ---- which robot ----

    def test_who_is_asked(self):
        self.record_alarm(5.5)
        self.assertIn("by then 4 robots had an event \"alarm\": a1, a2, b and p; say which one, as --robot a1",
                      self.refused("event", "alarm"))
        for question in (["event", "alarm", "--robot", "zz"], ["motor", "zz"]):
            self.assertIn('there is no robot "zz" in this run; there are: a1, a2, b, p, d', self.refused(*question))
        self.assertIn('by then there was no variable of thymio-II "gott" of b; did you mean got?',
                      self.refused("variable", "thymio-II.gott", "--robot", "b"))
        self.assertIn('by then there was no actor "actt"; did you mean act?', self.refused("actor", "actt"))
        self.assertIn("--robot b: motor p names its robot already", self.refused("motor", "p", "--robot", "b"))

    def test_a_robot_without_a_project(self):
        self.record_alarm(1)
        wheels = [(0, "d", "the script of thymio-II wrote motor.left.target", "30", "plain.aesl", "motor.left.target = 30"),
                  (0, "d", "the script of thymio-II began", "", "", "")]
        self.assertEqual(self.told("motor", "d"), wheels)
        self.assertEqual(self.told("variable", "thymio-II.motor.left.target", "--robot", "d"), wheels)
        for question in (["actor", "idle"], ["end"]):
            self.assertIn("d has no plan", self.refused(*question, "--robot", "d"))
        self.assertIn("b has no plan", self.refused("actor", "b/idle"))

    def test_a_run_of_one_bus_has_no_robot_to_choose(self):
        run_vagus("sim", EXAMPLES / "thymio/arena.world.json", "--load", EXAMPLES / "thymio/explore.aesl", "--headless", "--speed",
                  "max", "--duration", 1, "--record", self.file)
        self.assertIn("this run has one bus", self.refused("motor", "thymio", "--robot", "thymio"))

    def test_a_hundred_robots(self):
        """One calls, ninety-nine hear it."""
        self.make_hall([])
        (self.hall / "hall.world.json").write_text(json.dumps({
            "format": "vagus-world/1", "size": [6, 6], "fleet": {"latency": 0.005, "jitter": 0}, "robots": [
                {"name": "a", "type": "thymio2", "at": [5.5, 5.5], "project": "call"},
                {"name": "h", "type": "thymio2", "at": [0.4, 0.4], "grid": [11, 9], "spacing": 0.4, "project": "hear"}]}))
        self.record(5.2)
        for robot in ("h1", "h99"):
            self.assertEqual([one[:4] for one in self.told("event", "alarm", "--robot", robot)],
                             [(5.012, robot, "the fleet brought alarm from a", "50"), *[one[:4] for one in self.calls("a")]])
        self.assertIn('by then 100 robots had an event "alarm": a, h1, h2, h3, h4, h5, h6, h7, h8, h9 and 90 more',
                      self.refused("event", "alarm"))
        self.assertIn('there is no robot "h100" in this run; did you mean h10?', self.refused("event", "alarm", "--robot", "h100"))
        hits = self.hits("--log", f"thymio-II:{self.line_of('hear/hear.aesl', 'got = event')}", "got, event.args[0]")
        self.assertEqual(sorted(hit["at"].split("/")[0] for hit in hits), sorted(f"h{n}" for n in range(1, 100)))
        self.assertEqual({(hit["t"], *hit["values"].values()) for hit in hits}, {(5.013, 0, 50)})

    # ---- log points ----

    def test_log_points_of_each_robot_and_of_one(self):
        self.record_alarm()
        line = self.line_of("call/call.aesl", "ticks++")
        expected = [(round(0.1 * n + 0.001, 6), f"{robot}/thymio-II:{line}", n - 1) for n in range(1, 60) for robot in ("a1", "a2")]
        hits = self.hits("--log", f"thymio-II:{line}", "ticks")
        self.assertEqual([(hit["t"], hit["at"], hit["values"]["ticks"]) for hit in hits], expected)
        of_one = self.hits("--log", f"a2/thymio-II:{line}", "ticks", "--log", "@act.enter", "1 + 1")
        self.assertEqual([(hit["t"], hit["at"], *hit["values"].values()) for hit in of_one],
                         sorted([one for one in expected if "a2" in one[1]] + [(5.012, "p/@act.enter", 2)]))

    def test_log_points_of_plans(self):
        self.make_hall([("k1", "claim"), ("k2", "claim")])
        self.record(20)
        begins = {robot: next(link["t"] for link in self.chain("actor", "hold", "--robot", robot)
                              if link["what"] == "the actor hold began") for robot in ("k1", "k2")}
        hits = self.hits("--log", "@hold.enter", "seen, lease")
        self.assertEqual([(hit["t"], hit["at"], hit["values"]["seen"]) for hit in hits],
                         [(begins[robot], f"{robot}/@hold.enter", 5) for robot in ("k1", "k2")])
        leases = [hit["values"]["lease"] for hit in hits]
        self.assertNotEqual(*leases)
        self.assertEqual([(hit["at"], hit["values"]["lease"]) for hit in self.hits("--log", "k2/@claim.leave", "lease")],
                         [("k2/@claim.leave", leases[1])])

    def test_log_points_that_are_not_there(self):
        self.record_alarm(1)
        line = self.line_of("call/call.aesl", "ticks++")
        for where, values, sentence in [
                ("zz/@act.enter", "1", 'there is no robot "zz"; there are: a1, a2, b, p, d'),
                ("b/@act.enter", "1", "b has no plan"),
                ("@actt.enter", "1", 'the plan has no actor "actt"; did you mean act?'),
                ("p/@act.go", "1", "or of one as r4/drive:42 or r4/@ACTOR.enter"),
                ("c/thymio-II:8", "n", 'there is no node "c/thymio-II"'),
                (f"thymio-II:{line}", "tickz", 'has no variable "tickz"; did you mean ticks?'),
                ("thymio-II:900", "ticks", "has no code at line 900")]:
            self.assertIn(sentence, run_vagus("replay", self.file, "--log", where, values, status=2), where)

    # ---- compare ----

    def test_each_robot_has_lanes_of_its_own(self):
        """In the other run both call a tick later: a1, a2 and who hears them differ, the others do not."""
        self.make_hall([("a1", "call"), ("a2", "call"), ("b", "hear"), ("p", "obey"), ("k1", "claim")])
        self.record(6)
        other = self.folder / "other.mcap"
        (self.hall / "call/call.aesl").write_text(script(CALL.replace("== 50", "== 51"), "alarm"))
        self.record(6, file=other)
        told = run_vagus("compare", self.file, other, status=1)
        self.assertIn("started with another file call/call.aesl\n", told)
        for at, lane in (("5.002000", "/robot/a1/bus/events"), ("5.002000", "/robot/a2/bus/events"),
                         ("5.012000", "/robot/p/plan/trace")):
            self.assertIn(f"differs at {at} s: {lane}\n", told)
        self.assertRegex(told, r"differs at 5\.020000 s: /robot/b/node/thymio-II/variables, ")
        last = told.splitlines()[-1]
        self.assertTrue(last.startswith("no difference: "), last)
        self.assertIn("/robot/k1", last.split(": ")[1].split(", "))
        self.assertNotIn("/robot/b,", last)
        lanes = {lane["lane"]: lane for lane in json.loads(run_vagus("compare", self.file, other, "--json", status=1))["lanes"]}
        for robot in ("a1", "a2", "b", "p", "k1"):
            for lane in ("plan/trace", "bus/events", "vagus/check", "node/thymio-II/variables"):
                self.assertIn(f"/robot/{robot}/{lane}", lanes)
        self.assertGreater(lanes["/robot/k1/plan/trace"]["compared"], 1)

    def test_fleets_are_aligned_at_a_robot(self):
        self.make_hall([("a1", "call"), ("a2", "call"), ("p", "obey")])
        self.record(6)
        other = self.folder / "other.mcap"
        (self.hall / "call/call.aesl").write_text(script(CALL.replace("== 50", "== 51"), "alarm"))
        self.record(6, file=other)
        for align in (["actor", "p/act"], ["actor", "act"]):
            found = json.loads(run_vagus("compare", self.file, other, "--align", *align, "--json", status=1))
            self.assertEqual(found["aligned"], {"a": 5.012, "b": 5.112})
            trace = next(lane for lane in found["lanes"] if lane["lane"] == "/robot/p/plan/trace")
            self.assertIsNone(trace["difference"])
        told = run_vagus("compare", self.file, other, "--align", "actor", "p/actt", status=2)
        self.assertIn('began no actor "p/actt"; did you mean p/act?', told)

    def test_the_same_fleet_has_no_difference(self):
        for name in ("one.mcap", "other.mcap"):
            self.record(20, world=EXAMPLES / "warehouse/hall.world.json", file=self.folder / name)
        told = run_vagus("compare", self.folder / "one.mcap", self.folder / "other.mcap")
        self.assertRegex(told, r"values compared: no difference$")

    # ---- the samples ----

    def test_who_was_warned_by_whom(self):
        """In the class a robot that stands was warned, or met the line itself; the chain tells by whom."""
        self.record(12, world=EXAMPLES / "alarm/class.world.json")
        warned = 0
        for robot in ("t1", "t11", "t15", "t30"):
            chain = self.chain("motor", robot)
            by = chain[-1]["robot"]
            self.assertEqual(chain[-1]["what"], "thymio-II felt prox")
            self.assertTrue(all(link["place"].startswith("alarm/alarm.aesl:") for link in chain if link["place"]))
            if by == robot:
                continue
            warned += 1
            self.assertEqual([(link["robot"], link["what"]) for link in chain[1:4]], [
                (robot, "thymio-II heard alarm"), (robot, f"the fleet brought alarm from {by}"),
                (by, "the script of thymio-II emitted alarm")])
            self.assertEqual(self.chain("motor", by)[-1]["robot"], by)
        self.assertGreater(warned, 0)

    def test_why_a_picker_crosses_the_hall(self):
        """One at a time: whoever waited for the name `hall` has it from the one that gave it back."""
        self.record(60, world=EXAMPLES / "warehouse/hall.world.json")
        for number in range(1, 11):
            chain = self.chain("motor", f"r{number}")
            self.assertEqual(sorted((link["t"] for link in chain), reverse=True), [link["t"] for link in chain])
            crossings = [(one, other) for one, other in zip(chain, chain[1:]) if one["robot"] != other["robot"]
                         and one["what"] == "the keeper of the fleet answered, done: the name hall"]
            for _, other in crossings:
                self.assertRegex(other["what"], r"^the actor (giveHall|leaveHall|freeHall) of the plan gave the name hall back$")
                self.assertTrue(other["place"].startswith("warehouse/picker/Pick.plan.json:"), other)
            if crossings:
                return
        self.fail("nobody has waited for the hall")

    # ---- when was it decided ----

    def test_the_turning_point_of_one_robot(self):
        """The 30th tick of c, at 3.001 s, draws a number; half of them turn it on the spot, with the others it drives on and
        meets the wall. n, with the same script, draws the same way and is not asked about."""
        coin = ("var ticks = 0\nvar coin = 0\ntimer.period[0] = 100\nmotor.left.target = 400\nmotor.right.target = 400\n\n"
                "onevent timer0\n\tticks++\n\tif ticks == 30 then\n\t\tcall math.rand(coin)\n\t\tif coin < 0 then\n"
                "\t\t\tmotor.left.target = -100\n\t\t\tmotor.right.target = 100\n\t\tend\n\tend\n")
        self.project("coin", coin)
        (self.hall / "vagus.json").write_text(json.dumps({"format": "vagus-project/1", "name": "Hall"}))
        (self.hall / "hall.world.json").write_text(json.dumps({
            "format": "vagus-world/1", "size": [2, 2], "robots": [
                {"name": name, "type": "thymio2", "at": [1, y], "angle": 0, "project": "coin"}
                for name, y in (("n", 0.5), ("c", 1.5))]}))
        self.record(12)
        ask = ["--turning-point", "contact >= 2", "--results", self.folder / "kept"]
        self.assertIn("2 robots of this run have projects of their own; say so, as --robot n", self.refused(*ask, status=2))
        self.assertIn('there is no robot "x" in this run', self.refused(*ask, "--robot", "x", status=2))
        found = json.loads(run_vagus("why", self.file, *ask, "--robot", "c", "--tries", 10, "--json"))
        self.assertEqual(found["robot"], "c")
        turn = found["turn"]
        self.assertAlmostEqual(turn["after"]["t"], 3.001, 6)
        self.assertIn(("c", "the script of thymio-II called math.rand", f"coin/coin.aesl:{self.line_of('coin/coin.aesl', 'math.rand')}"),
                      [(link.get("robot"), link["what"], link["place"]) for link in turn["there"]])
        for name in ("with", "without"):
            self.assertRegex(run_vagus("replay", turn[name]["file"]), "messages compared: no difference")

    # ---- a test of it ----

    def test_a_fleet_is_no_test_of_a_plan(self):
        self.record_alarm(1)
        told = run_vagus("test", "new", self.file, self.folder / "new.test.json", status=2)
        self.assertIn("is of a world in which 4 robots have projects of their own; a test is of one robot, with a plan or without", told)


if __name__ == "__main__":
    unittest.main()
