"""Recordings of runs: made, run again, cut, changed, and asked why."""
import json
import os
import pathlib
import re
import signal
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import VAGUS, Program, run_vagus, vagus

EXAMPLES = pathlib.Path(__file__).resolve().parent.parent.parent / "examples"
NO_DIFFERENCE = re.compile(r"messages compared: no difference$")
# Other code of the processor gives other bits, if anything hangs on them.
NO_FMA = "glibc.cpu.hwcaps=-AVX2,-FMA,-AVX2_Usable,-FMA_Usable,-AVX512F"
SEEDS = 20 if os.environ.get("VAGUS_LONG") else 2

# Plans beside worlds, with what their vagus.json sets.
PLANS = [
    ("find-object/DriveToObject", "find-object/room", []),
    ("follow-object/FollowRobot", "follow-object/hall", []),
    ("follow-wall/WallFollow", "follow-wall/hall", ["--set", "walldist=30"]),
    ("infrared/DriveToBeacon", "infrared/room", []),
    ("obstacle/AroundObstacle", "obstacle/carbot", []),
    ("obstacle/AroundObstacle", "obstacle/thymio", []),
    ("patterns/FigureOfEight", "patterns/carbot", []),
    ("patterns/Square", "patterns/thymio", []),
    ("rooms/GoToRoom", "rooms/flat", []),
    ("traffic-light/TrafficLight", "traffic-light/street",
     ["--toolbox", EXAMPLES / "traffic-light/light.toolbox.json"]),
]
WORLDS = [
    ("carbot/arena", "carbot/carbot.aesl"), ("epuck/colours", "epuck/seek.aesl"), ("thymio/arena", "thymio/explore.aesl"),
    ("thymio/line", "thymio/line.aesl"), ("patterns/thymio", "thymio/drive.aesl"),
]


class Recordings(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-recordings-")))
        self.file = self.folder / "run.mcap"

    def run_plan(self, plan, world, *options, max_time=40):
        """Gives the exit code; a plan may end in any way that is no error."""
        with vagus("plan", "run", EXAMPLES / f"{plan}.plan.json", "--world", EXAMPLES / f"{world}.world.json", "--clock",
                   "virtual", "--quiet", "--max-time", max_time, "--record", self.file, *options) as program:
            code = program.wait_end()
            self.assertIn(code, (0, 3, 5), program.lines)
            return code

    def follow_wall(self, *options, max_time=130):
        return self.run_plan("follow-wall/WallFollow", "follow-wall/hall", "--set", "walldist=30", *options, max_time=max_time)

    def replays(self, *options, status=0):
        return run_vagus("replay", self.file, *options, status=status)

    def why(self, *question, at=None):
        """The chain, and for each link what is written at its place."""
        words = ["why", self.file, *question, "--json", "--all"] + (["--at", at] if at is not None else [])
        return json.loads(run_vagus(*words))

    def line_at(self, link):
        name, line = link["place"].rsplit(":", 1)
        found = [path for path in EXAMPLES.rglob(pathlib.Path(name).name) if str(path).endswith(name)]
        self.assertEqual(len(found), 1, link)
        return found[0].read_text().splitlines()[int(line) - 1].strip()

    # ---- running again ----

    def test_plans_run_again_without_a_difference(self):
        for plan, world, options in PLANS:
            for seed in range(1, SEEDS + 1):
                with self.subTest(plan=plan, world=world, seed=seed):
                    self.run_plan(plan, world, "--seed", seed, *options)
                    self.assertRegex(self.replays(), NO_DIFFERENCE)

    def test_worlds_run_again_without_a_difference(self):
        for world, script in WORLDS:
            for seed in range(1, SEEDS + 1):
                with self.subTest(world=world, script=script, seed=seed):
                    run_vagus("sim", EXAMPLES / f"{world}.world.json", "--load", EXAMPLES / script, "--headless", "--speed",
                              "max", "--duration", 30, "--seed", seed, "--record", self.file)
                    self.assertRegex(self.replays(), NO_DIFFERENCE)

    def test_an_older_processor_gives_the_same_bits(self):
        self.follow_wall(max_time=30)
        with Program(VAGUS, "replay", self.file, env={"GLIBC_TUNABLES": NO_FMA}) as program:
            self.assertEqual(program.wait_end(), 0, program.lines)

    def test_recording_changes_nothing(self):
        traces = []
        for record in ([], ["--record", self.file]):
            trace = self.folder / f"{len(record)}.jsonl"
            with vagus("plan", "run", EXAMPLES / "follow-wall/WallFollow.plan.json", "--world",
                       EXAMPLES / "follow-wall/hall.world.json", "--clock", "virtual", "--quiet", "--trace", trace,
                       *record) as program:
                self.assertEqual(program.wait_end(), 3)
            traces.append(trace.read_bytes())
        self.assertEqual(*traces)

    def test_it_stands_alone(self):
        """Mailed somewhere else: no file of the run is needed."""
        plan = self.folder / "there"
        plan.mkdir()
        (plan / "Wait.plan.json").write_text(json.dumps({
            "format": "vagus-plan/1", "name": "Wait", "start": {"actor": "wait"},
            "actors": {"wait": {"template": "Wait", "in": {"seconds": 2}, "states": {"Done": "@terminate"}}}}))
        run_vagus("plan", "run", plan / "Wait.plan.json", "--clock", "virtual", "--record", self.file)
        (plan / "Wait.plan.json").unlink()
        self.assertRegex(self.replays(), NO_DIFFERENCE)

    def test_until_ends_there(self):
        self.follow_wall()
        told = self.replays("--until", 20)
        self.assertIn("at 20.000000 s:", told)
        self.assertRegex(told, r"carbot is at \d+\.\d+, \d+\.\d+ m")
        self.assertIn("drive is running: token = ", told)
        self.assertRegex(told, r"20\.000000 s again, \d+ messages compared: no difference$")

    def test_a_changed_file_parts_the_runs(self):
        self.follow_wall()
        plan = self.folder / "WallFollow.plan.json"
        text = (EXAMPLES / "follow-wall/WallFollow.plan.json").read_text()
        before = '"distance": "walldist", "margin": 10'
        self.assertIn(before, text)
        plan.write_text(text.replace(before, '"distance": 60, "margin": 10', 1))
        told = self.replays("--with", plan, status=1)
        # Twice as far away the wall is in the way earlier: before that both runs are the same.
        at = float(re.search(r"^differs at ([\d.]+) s: /plan/trace", told, re.M).group(1))
        self.assertLess(at, 7.97)
        self.assertRegex(told, r"now: .*LaneNotFree")
        self.assertIn("it ended then: ", told)
        self.assertIn("it ends now: ", told)

    def test_a_file_that_is_not_in_it(self):
        self.follow_wall(max_time=2)
        told = self.replays("--with", self.folder / "other.aesl", status=2)
        self.assertIn("no file of the recording is called so; its files are ", told)
        self.assertIn("follow-wall/hall.world.json", told)

    # ---- damage ----

    def test_a_killed_run_is_read_up_to_its_last_second(self):
        """In real time; a chunk has been written as soon as the file is not empty but for its attachments."""
        with vagus("plan", "run", EXAMPLES / "follow-wall/WallFollow.plan.json", "--world",
                   EXAMPLES / "follow-wall/hall.world.json", "--headless", "--record", self.file) as program:
            program.wait_line(r"searchFirstWall")
            for _ in range(3):
                size = self.file.stat().st_size
                while self.file.stat().st_size == size and program.process.poll() is None:
                    pass
            program.signal(signal.SIGKILL)
            program.process.wait()
        told = self.replays()
        self.assertIn("has no end", told)
        self.assertRegex(told, NO_DIFFERENCE)
        whole = self.folder / "whole.mcap"
        self.replays("--repair", whole)
        self.file = whole
        self.assertNotIn("has no end", self.replays("--until", 1))

    def test_what_is_no_recording(self):
        self.file.write_text("{}")
        self.assertIn("is no recording", self.replays(status=2))
        self.file.unlink()
        self.assertIn("cannot be read", self.replays(status=2))

    def test_what_cannot_be_recorded(self):
        plan = EXAMPLES / "patterns/Square.plan.json"
        world = EXAMPLES / "patterns/carbot.world.json"
        alone = EXAMPLES / "embed/Greet.plan.json"
        self.assertIn("a run in real time cannot be run again", run_vagus("plan", "run", alone, "--record", self.file, status=2))
        for words, sentence in (
                (["--world", world, "--listen", "tcp:127.0.0.1:0"], "not together with --listen"),
                (["--world", world, "--watch"], "not together with --watch")):
            with self.subTest(words=words):
                self.assertIn(sentence, run_vagus("plan", "run", plan, "--record", self.file, *words, status=2))
        self.assertIn("cannot be written",
                      run_vagus("plan", "run", plan, "--world", world, "--record", self.folder / "no/run.mcap", status=2))

    def test_a_person_ends_the_run(self):
        """By a signal, at whatever instant: the same run ends there again."""
        with vagus("plan", "run", EXAMPLES / "follow-wall/WallFollow.plan.json", "--world",
                   EXAMPLES / "follow-wall/hall.world.json", "--headless", "--record", self.file) as program:
            program.wait_line(r"searchFirstWall")
            program.signal(signal.SIGINT)
            program.wait_end()
        self.assertRegex(self.replays(), NO_DIFFERENCE)
        root = self.why("end")[-1]
        self.assertIn("somebody ended the run", root["what"])

    # ---- why ----

    def test_why_the_wheels_turn_after_the_bump(self):
        """From the turning wheel to the plank that the bumper touched."""
        self.follow_wall()
        chain = self.why("motor", "carbot", at=83)
        expected = [
            ("the script of drive called drive.move", "call drive.move(event.args[1], event.args[2], event.args[3])"),
            ("drive heard drive.forward", "callsub accept"),
            ("the actor backupCollision of the plan sent drive.forward", '"backupCollision": {'),
            ("the actor backupCollision began", '"backupCollision": {'),
            ("the supervisor wallTouch raised TouchSensorPressed", '"wallTouch": {'),
            ("the script of bumper emitted touch.pressed", "emit touch.pressed [watchers[at], direction]"),
            ("bumper felt touch", "for i in 0:11 do"),
            ("carbot touched \"plank\"", None),
            ("the timeline of the world put \"plank\" there", "{"),
        ]
        self.assertEqual([link["what"] for link in chain], [what for what, _ in expected])
        for link, (_, text) in zip(chain, expected):
            if text is None:
                self.assertEqual(link["place"], "")
            else:
                self.assertEqual(self.line_at(link), text)
        self.assertEqual([link["root"] for link in chain], [False] * 8 + [True])
        self.assertEqual(chain[-1]["t"], 80)
        self.assertEqual(sorted((link["t"] for link in chain), reverse=True), [link["t"] for link in chain])

    def test_questions_about_the_wall_follower(self):
        self.follow_wall()
        first = lambda *question, at=None: self.why(*question, at=at)[0]["what"]
        root = lambda *question, at=None: self.why(*question, at=at)[-1]["what"]
        self.assertEqual(first("actor", "searchFirstWall", at=5), "the actor searchFirstWall began")
        self.assertEqual(root("actor", "searchFirstWall", at=5), "the plan WallFollow began")
        self.assertEqual(first("actor", "searchFirstWall", at=9), "the actor searchFirstWall was interrupted")
        self.assertEqual(self.why("actor", "searchFirstWall", at=9)[1]["what"], "the supervisor checkLane raised LaneNotFree")
        self.assertEqual(root("actor", "searchFirstWall", at=9), "range felt echo")
        self.assertEqual(first("variable", "wallangle", at=20), "findWallAngle wrote the variable wallangle")
        self.assertEqual(self.why("variable", "wallangle", at=20)[0]["value"], "63.5")
        self.assertEqual(first("event", "drive.arrived", at=12), "the script of drive emitted drive.arrived")
        self.assertEqual(first("variable", "drive.token", at=83), "the script of drive wrote token")
        self.assertEqual(first("variable", "drive.patience", at=20.5), "the script of drive wrote patience")
        self.assertEqual(root("end"), 'the timeline of the world pressed the button "escape" of carbot')
        self.assertEqual(self.why("end")[0]["what"], "the plan WallFollow ended: Interrupted")
        for question, sentence in ((["actor", "followwall"], "did you mean followWall?"),
                                   (["motor", "r2d2"], "there is carbot"),
                                   (["event", "drive.arived"], "did you mean drive.arrived?"),
                                   (["variable", "drive.tokn"], "did you mean token?")):
            self.assertIn(sentence, run_vagus("why", self.file, *question, "--at", 20, status=1))
        self.assertIn("expected a question", run_vagus("why", self.file, "moter", "carbot", status=2))

    def test_questions_about_a_thymio(self):
        run_vagus("sim", EXAMPLES / "thymio/arena.world.json", "--load", EXAMPLES / "thymio/explore.aesl", "--headless",
                  "--speed", "max", "--duration", 20, "--record", self.file)
        chain = self.why("motor", "thymio", at=10)
        self.assertRegex(chain[0]["what"], r"^the script of thymio wrote motor\.(left|right)\.target$")
        self.assertRegex(self.line_at(chain[0]), r"^motor\.(left|right)\.target = ")
        self.assertEqual(chain[-1]["what"], "thymio-II felt prox")

    def test_what_has_not_happened_yet(self):
        self.follow_wall(max_time=5)
        self.assertEqual(self.why("variable", "head.at", at=1)[0]["what"], "no script has written at of head yet")
        self.assertIn('by then there was no event "drive.arrived"',
                      run_vagus("why", self.file, "event", "drive.arrived", "--at", 1, status=1))
        self.assertIn("by then no plan had ended", run_vagus("why", self.file, "end", "--at", 1, status=1))


if __name__ == "__main__":
    unittest.main()
