"""When was it decided? Planted failures: chance decides at an instant that is known, and shows later. Each run is recorded,
asked, and the two continuations that are kept are run again and compared."""
import json
import os
import pathlib
import signal
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import patiently, run_vagus, vagus, wait_until

# A Thymio II that looks along x at the wall of a room of 2 m. The near side of the board is 0.2 m before its middle, where the
# sensor reads 1512 on average (docs/sensors.md).
ROOM = {"format": "vagus-world/1", "name": "Room", "size": [2, 2],
        "robots": [{"name": "thymio", "type": "thymio2", "at": [1, 1], "angle": 0, "script": "go.aesl"}]}
BOARD = {"kind": "wall", "at": [1.205, 1], "size": [0.01, 0.44]}

# `vagus sim` loads scripts while time passes: this one runs from the eighth millisecond on, and its timer of 100 ms, which
# counts from the next one, runs out at 0.109 s, 0.209 s, …: `ticks` is n at 0.1 n + 0.009 s.
DRAW_AND_ACT = """var ticks = 0
var coin = 0
timer.period[0] = 100
motor.left.target = 400
motor.right.target = 400

onevent timer0
	ticks++
	if ticks == DRAW then
		call math.rand(coin)
	end
	if ticks == ACT and coin < 0 then
		motor.left.target = -100
		motor.right.target = 100
	end
"""

# The mean of 16 samples, as the differences to the first; then one more decides. A plan's world has its scripts loaded before
# time 0: sensors sample at 0.1 s, 0.2 s, …, and the timer reads them a millisecond later, at 0.101 s, 0.201 s, ….
SAMPLE = """var ticks = 0
var first
var sum = 0
timer.period[0] = 100

onevent timer0
	ticks++
	if ticks == 4 then
		first = prox.horizontal[2]
	end
	if ticks > 4 and ticks <= 20 then
		sum += prox.horizontal[2] - first
	end
	if ticks == 30 and (prox.horizontal[2] - first) * 16 > sum then
		emit near
	end
"""


def script(text, events=()):
    declared = "".join(f'<event size="0" name="{name}"/>\n' for name in events)
    return (f'<!DOCTYPE aesl-source>\n<network>\n{declared}<keywords flag="true"/>\n<node nodeId="1" name="thymio-II">'
            f"<![CDATA[{text}]]></node>\n</network>\n")


def plan(actors, start, configuration=None):
    return {"format": "vagus-plan/1", "name": "Decide", "configuration": configuration or {}, "start": {"actor": start},
            "actors": actors}


class TurningPoint(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-turning-")))
        self.file = self.folder / "run.mcap"
        self.world = self.folder / "room.world.json"
        self.world.write_text(json.dumps(ROOM))

    # ---- what is recorded ----

    def script(self, text, events=()):
        (self.folder / "go.aesl").write_text(script(text, events))

    def record_world(self, seconds=12):
        run_vagus("sim", self.world, "--headless", "--speed", "max", "--duration", seconds, "--record", self.file)

    def record_plan(self, content, *options, world=True, status=(0, 3, 5)):
        path = self.folder / "Decide.plan.json"
        path.write_text(json.dumps(content))
        beside = ["--world", self.world] if world else []
        with vagus("plan", "run", path, *beside, "--clock", "virtual", "--quiet", "--record", self.file, *options) as program:
            self.assertIn(program.wait_end(), status, program.lines)

    # ---- what is asked ----

    def ask(self, condition, *options, status=0):
        return run_vagus("why", self.file, "--turning-point", condition, "--results", self.folder / "kept", *options,
                         status=status)

    def answer(self, condition, *options):
        return json.loads(self.ask(condition, "--json", *options))

    def turned_in(self, found, at):
        """It was decided in the millisecond that ends at that instant."""
        turn = found["turn"]
        self.assertIsNotNone(turn, found)
        self.assertTrue(turn["narrowed"], turn)
        self.assertAlmostEqual(turn["before"]["t"], at - 0.001, 6, turn)
        self.assertAlmostEqual(turn["after"]["t"], at, 6, turn)
        return turn

    def both_run_again(self, turn, condition):
        """With no difference; the condition became true in one and not in the other."""
        for name, comes in (("with", True), ("without", False)):
            kept = turn[name]
            self.assertRegex(run_vagus("replay", kept["file"]), "messages compared: no difference")
            again = json.loads(run_vagus("why", kept["file"], "--turning-point", condition, "--json", "--tries", 1, "--results",
                                         self.folder / "again"))
            self.assertEqual(again["came"] is not None, comes, kept)
        if turn["with"]["from"] != turn["without"]["from"]:
            return
        told = run_vagus("compare", turn["with"]["file"], turn["without"]["file"], status=1).splitlines()
        self.assertRegex(told[0], f"differs at {turn['with']['from']:.6f} s: /vagus/input, seed")

    def places(self, turn):
        return [(link["what"], link["place"]) for link in turn["there"]]

    # ---- planted failures ----

    def test_a_script_draws_and_acts_at_once(self):
        """The 30th tick, at 3.009 s, draws a number; half of them turn the robot on the spot, with the others it drives into
        the wall, 0.9 m away, which it touches after about 7 s at 13 cm/s."""
        self.script(DRAW_AND_ACT.replace("DRAW", "30").replace("ACT", "30"))
        self.record_world()
        turn = self.turned_in(self.answer("contact >= 2"), 3.009)
        self.assertIn(("the script of thymio-II called math.rand", f"go.aesl:{self.line('math.rand')}"), self.places(turn))
        self.both_run_again(turn, "contact >= 2")

    def test_a_script_draws_long_before_it_acts(self):
        """Drawn at 1.009 s by the tenth tick, obeyed at 5.009 s by the fiftieth."""
        self.script(DRAW_AND_ACT.replace("DRAW", "10").replace("ACT", "50"))
        self.record_world()
        turn = self.turned_in(self.answer("contact >= 2"), 1.009)
        self.assertIn(("the script of thymio-II called math.rand", f"go.aesl:{self.line('math.rand')}"), self.places(turn))
        self.both_run_again(turn, "contact >= 2")

    def line(self, text):
        lines = (self.folder / "go.aesl").read_text().splitlines()
        return next(i + 1 for i, line in enumerate(lines) if text in line)

    def test_a_noisy_sensor_decides_for_a_plan(self):
        """The sample that the sensor takes at 3.0 s is above the mean of those from 0.5 s to 2.0 s, or not: half of the time.
        The script tells the plan at 3.001 s, a supervisor raises its event then."""
        self.world.write_text(json.dumps({**ROOM, "objects": [BOARD]}))
        self.script(SAMPLE, ["near"])
        self.record_plan(plan({
            "wait": {"template": "WaitForever", "supervisors": {
                "near": {"template": "OnEvent", "in": {"event": "'near'"}, "events": {"Received": "flee"}},
                "late": {"template": "Timeout", "in": {"seconds": 5}, "events": {"Timeout": "@terminate"}}}},
            "flee": {"template": "Wait", "in": {"seconds": 1}, "states": {"Done": "@terminate"}}}, "wait"), "--seed", 1)
        turn = self.turned_in(self.answer("actor == 'flee'", "--until", 6), 3.0)
        self.assertIn("the actor wait began, and was active", [link["what"] for link in turn["there"]])
        self.both_run_again(turn, "actor == 'flee'")

    def test_the_plan_draws_itself(self):
        """Wait ends at 2 s; then the plan draws 1 to 4, and only a 1 sends it to the actor `bad`."""
        self.script("var nothing\n")
        self.record_plan(plan({
            "wait": {"template": "Wait", "in": {"seconds": 2}, "states": {"Done": "draw"}},
            "draw": {"template": "Random", "in": {"low": 1, "high": 4}, "out": {"value": "drawn"}, "states": {"Done": "look"}},
            "look": {"template": "Compare", "in": {"left": "drawn", "op": "'=='", "right": 1},
                     "states": {"True": "soon", "False": "well"}},
            "soon": {"template": "Wait", "in": {"seconds": 3}, "states": {"Done": "bad"}},
            "well": {"template": "Wait", "in": {"seconds": 6}, "states": {"Done": "@terminate"}},
            "bad": {"template": "Wait", "in": {"seconds": 3}, "states": {"Done": "@terminate"}}},
            "wait", {"drawn": {"type": "int", "initial": 0}}), "--seed", 1)
        turn = self.turned_in(self.answer("actor == 'bad'"), 2.0)
        self.assertIn("the actor draw began", [link["what"] for link in turn["there"]])
        self.both_run_again(turn, "actor == 'bad'")

    # ---- no decision ----

    def test_what_always_comes_is_not_decided_by_chance(self):
        self.script("motor.left.target = 400\nmotor.right.target = 400\n")
        self.record_world()
        self.assertIn("not decided by chance: it became true in all 640 continuations", self.ask("contact >= 2"))

    def test_what_never_comes_is_not_decided_by_chance(self):
        self.script("motor.left.target = 40\nmotor.right.target = 40\n")
        self.record_world(5)
        told = self.ask("contact >= 2")
        self.assertIn("contact >= 2 did not become true by 5.000 s", told)
        self.assertIn("not decided by chance: it became true in none of 640 continuations", told)
        self.assertFalse((self.folder / "kept").exists())

    def test_the_answer_hangs_on_no_process(self):
        self.script(DRAW_AND_ACT.replace("DRAW", "30").replace("ACT", "30"))
        self.record_world(9)
        self.assertEqual(*[self.ask("contact >= 1", "--tries", 10, "-j", jobs) for jobs in (1, 3)])

    # ---- what cannot be asked ----

    def refused(self, condition, said, *options, status=2):
        self.assertIn(said, self.ask(condition, *options, status=status))

    def test_a_question_that_is_none(self):
        self.script("motor.left.target = 40\n")
        self.record_world(1)
        self.refused("contact >=", 'the condition "contact >=": expected a number')
        self.refused("conatct > 1", 'the condition "conatct > 1": ')
        self.refused("actor == 'drive'", "the condition \"actor == 'drive'\": \"actor\" is of a plan, and there is none")
        self.refused("node('thymio-II', 'speed') > 0", "the node \"thymio-II\" has no variable \"speed\"")
        self.refused("contact > 1", "expected a whole number from 1 to 1000", "--tries", 0)
        self.refused("contact > 1", "expected a whole number from 1 to 1000", "--tries", 1001)
        self.refused("contact > 1", "--turning-point", "--at", 1)
        self.refused("contact > 1", "--until: expected a number of seconds above 0", "--until=-1")
        self.assertIn("--tries", run_vagus("why", self.file, "end", "--tries", 5, status=2))
        self.assertIn("expected a question", run_vagus("why", self.file, status=2))

    def test_a_recording_that_cannot_be_continued(self):
        self.record_plan(plan({"wait": {"template": "Wait", "in": {"seconds": 2}, "states": {"Done": "@terminate"}}}, "wait"),
                         world=False)
        self.refused("t > 1", "is of a plan without a world, which cannot be continued from an instant")
        self.file.write_bytes(self.file.read_bytes()[:40])
        self.refused("t > 1", "run.mcap")

    def test_a_recording_without_its_end_is_asked_as_far_as_it_goes(self):
        self.script(DRAW_AND_ACT.replace("DRAW", "30").replace("ACT", "30"))
        self.record_world(20)
        whole = self.file.read_bytes()
        self.file.write_bytes(whole[:len(whole) * 3 // 4])
        found = self.answer("contact >= 1")
        self.assertLess(found["end"], 20)
        self.turned_in(found, 3.009)

    # ---- reseeding by hand ----

    def test_reseed_by_hand(self):
        """Different seeds give different runs, the same seed the same bytes; what is recorded runs again."""
        self.script(DRAW_AND_ACT.replace("DRAW", "30").replace("ACT", "30"))
        self.record_world(4)
        recorded = {}
        for name, seed in (("a", 5), ("b", 5), ("c", 6)):
            other = self.folder / f"{name}.mcap"
            run_vagus("replay", self.file, "--from", 2.5, "--reseed", seed, "--record", other)
            self.assertRegex(run_vagus("replay", other), "no difference")
            recorded[name] = other
        self.assertIn("no difference", run_vagus("compare", recorded["a"], recorded["b"]))
        told = run_vagus("compare", recorded["a"], recorded["c"], status=1)
        self.assertIn('{"do":"reseed","seed":5}', told)
        self.assertIn("--reseed goes with --from", run_vagus("replay", self.file, "--reseed", 5, status=2))

    def test_what_a_person_did_later_is_done_all_the_same(self):
        """Ended by a signal: so does the run that draws again from 0.2 s on, at that instant."""
        self.script("var nothing\n")
        path = self.folder / "Decide.plan.json"
        path.write_text(json.dumps(plan({"wait": {"template": "WaitForever"}}, "wait")))
        with vagus("plan", "run", path, "--world", self.world, "--headless", "--record", self.file) as program:
            wait_until("no recording was begun", self.file.exists)
            for _ in range(3):  # it is written each second
                size = self.file.stat().st_size
                wait_until("nothing is recorded", lambda: self.file.stat().st_size > size)
            program.signal(signal.SIGINT)
            program.wait_end()
        other = self.folder / "other.mcap"
        run_vagus("replay", self.file, "--from", 0.2, "--reseed", 3, "--record", other)
        ends = [json.loads(run_vagus("why", file, "end", "--json"))[-1] for file in (self.file, other)]
        self.assertEqual(ends[0]["what"], "somebody ended the run")
        self.assertEqual(ends[0]["t"], ends[1]["t"])
        self.assertEqual(ends[0]["what"], ends[1]["what"])

    # ---- ended ----

    def test_ctrl_c_leaves_nothing_behind(self):
        """Neither processes nor the folder with the files of the recording; also while the 1,000 of one instant go on."""
        self.script(DRAW_AND_ACT.replace("DRAW", "30").replace("ACT", "30"))
        self.record_world(60)
        temporary = self.folder / "tmp"
        temporary.mkdir()
        with vagus("why", self.file, "--turning-point", "t > 59", "--tries", 1000, "-j", 2,
                   env={"TMPDIR": str(temporary)}) as program:
            # The run as it was has no copies; continuations are copies of the processes of their instants.
            copies = patiently_find(lambda: [copy for child in children_of(program.process.pid) for copy in children_of(child)])
            children = children_of(program.process.pid)
            program.signal(signal.SIGINT)
            self.assertNotEqual(program.wait_end(), 0)
        self.assertEqual([child for child in children if pathlib.Path(f"/proc/{child}").exists()], [])
        self.assertEqual(os.listdir(temporary), [])
        wait_until("a copy goes on", lambda: not any(runs(copy) for copy in copies))

    def test_what_a_killed_search_left_is_deleted_by_the_next(self):
        self.script(DRAW_AND_ACT.replace("DRAW", "30").replace("ACT", "30"))
        self.record_world(60)
        temporary = self.folder / "tmp"
        temporary.mkdir()
        words = ("why", self.file, "--turning-point", "t > 59", "--tries", 1000, "-j", 2)
        with vagus(*words, env={"TMPDIR": str(temporary)}) as program:
            copies = patiently_find(lambda: [copy for child in children_of(program.process.pid) for copy in children_of(child)])
            children = children_of(program.process.pid)
            program.signal(signal.SIGKILL)
            program.wait_end()
        wait_until("a process of the search goes on", lambda: not any(runs(one) for one in children + copies))
        self.assertNotEqual(os.listdir(temporary), [])
        with vagus("replay", self.file, "--until", 0.1, env={"TMPDIR": str(temporary)}) as program:
            self.assertEqual(program.wait_end(), 0, program.lines)
        self.assertEqual(os.listdir(temporary), [])


def children_of(parent):
    found = []
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue  # it ended in between
        if int(fields[1]) == parent:
            found.append(int(stat.parent.name))
    return found


def runs(process):
    """Whoever inherits a process that has ended may leave it for a while."""
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


def patiently_find(look):
    for _ in patiently():
        found = look()
        if found:
            return found
    raise AssertionError("no process was begun")


if __name__ == "__main__":
    unittest.main()
