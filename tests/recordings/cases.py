"""Recordings of runs: made, run again, cut, changed, and asked why."""
import json
import os
import pathlib
import re
import select
import shutil
import signal
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from mcap import CHUNK, MAGIC, records
from harness import GIVE_UP_AFTER, VAGUS, Program, run_vagus, vagus

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
# Robots with projects of their own.
FLEETS = ["alarm/class", "warehouse/hall"]


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

    # ---- worlds whose robots have projects ----

    def run_fleet(self, world, *options, duration=20, status=0):
        return run_vagus("sim", EXAMPLES / f"{world}.world.json", "--headless", "--speed", "max", "--duration", duration,
                         "--record", self.file, *options, status=status)

    def test_fleets_run_again_without_a_difference(self):
        for world in FLEETS:
            for seed in range(1, SEEDS + 1):
                with self.subTest(world=world, seed=seed):
                    self.run_fleet(world, "--seed", seed, "--threads", 1 + seed % 2)
                    self.assertRegex(self.replays(), NO_DIFFERENCE)

    def test_an_older_processor_gives_a_fleet_the_same_bits(self):
        self.run_fleet("warehouse/hall")
        with Program(VAGUS, "replay", self.file, env={"GLIBC_TUNABLES": NO_FMA}) as program:
            self.assertEqual(program.wait_end(), 0, program.lines)

    def test_recording_a_fleet_changes_nothing(self):
        traces = []
        for record in ([], ["--record", self.file]):
            trace = self.folder / f"{len(record)}.jsonl"
            run_vagus("sim", EXAMPLES / "warehouse/hall.world.json", "--headless", "--speed", "max", "--duration", 20,
                      "--trace", trace, *record)
            traces.append(trace.read_bytes())
        self.assertEqual(*traces)

    def test_jumps_in_a_fleet_tell_each_robot_and_what_a_straight_run_tells(self):
        self.run_fleet("warehouse/hall")
        instants = self.folder / "instants"
        instants.write_text("15\n2\n9.5\n")
        told = [json.loads(line) for line in self.replays("--jumps", instants, "--json").splitlines()]
        self.assertEqual([one["t"] for one in told], [15, 2, 9.5])
        for one in told:
            self.assertEqual(sorted(one["check"]["robots"]), sorted(f"r{n}" for n in range(1, 11)))
            self.assertEqual(sorted(one["check"]["robots"]["r4"]["nodes"]), ["bumper", "drive", "head", "range"])
            self.assertIn(f"the state is {one['state']}\n", self.replays("--until", one["t"]))

    def test_a_fleet_under_faults_runs_again(self):
        faults = json.dumps([{"do": "lose", "robot": "r1", "node": "drive", "from": 1, "until": 5, "share": 0.5},
                             {"do": "reset", "robot": "r2", "node": "bumper", "at": 3}])
        self.run_fleet("warehouse/hall", "--chaos", faults)
        self.assertRegex(self.replays(), NO_DIFFERENCE)

    def test_another_script_of_a_fleet_parts_the_runs_at_its_robots(self):
        """They are loaded with another program at time 0."""
        self.run_fleet("alarm/class", duration=5)
        other = self.folder / "alarm.aesl"
        text = (EXAMPLES / "alarm/alarm.aesl").read_text()
        self.assertIn("var ", text)
        other.write_text(text.replace("var ", "var planted = 7\nvar ", 1))
        self.assertIn("differs at 0.000000 s: /robot/t1/bus/frames", self.replays("--with", other, status=1))

    def test_another_seed_of_a_fleet_is_another_run_from_its_first_draw_on(self):
        self.run_fleet("warehouse/hall")
        first, other = self.file, self.folder / "other.mcap"
        self.file = other
        self.run_fleet("warehouse/hall", "--seed", 5)
        told = run_vagus("compare", first, other, status=1)
        self.assertRegex(told, r"differs at [\d.]+ s: /robot/r\d+/node/drive/variables")

    def test_more_robots_than_a_file_has_channels_for_are_not_recorded(self):
        """A thousand are; one more is not."""
        project = self.folder / "p"
        project.mkdir()
        (project / "vagus.json").write_text(json.dumps({"format": "vagus-project/1", "name": "P", "scripts": ["s.aesl"]}))
        (project / "s.aesl").write_text("var x = 1\n")
        for robots, status in ((1000, 0), (1001, 2)):
            world = self.folder / "many.world.json"
            rows = [{"name": "t", "type": "thymio2", "at": [0.4, 0.4], "grid": [50, 20], "spacing": 0.4, "project": "p"}]
            if robots > 1000:
                rows.append({"name": "one", "type": "thymio2", "at": [20.8, 0.4], "project": "p"})
            world.write_text(json.dumps({"format": "vagus-world/1", "size": [22, 9], "robots": rows}))
            told = run_vagus("sim", world, "--headless", "--speed", "max", "--duration", 0.1, "--record", self.file,
                             status=status)
        self.assertIn("expected at most 1000 robots with a project, found 1001", told)

    # ---- again ----

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

    # ---- jumps ----

    def jumps(self, *instants, status=0):
        """What is told of these instants, in their order."""
        wanted = self.folder / "instants.txt"
        wanted.write_text("".join(f"{at}\n" for at in instants))
        lines = run_vagus("replay", self.file, "--jumps", wanted, "--json", status=status).splitlines()
        return [json.loads(line) for line in lines if line.startswith("{")]

    def state_at(self, at):
        return json.loads(self.replays("--until", at, "--json"))["state"]

    def test_jumps_find_what_a_straight_run_finds(self):
        self.follow_wall()
        told = self.jumps(82.5, 20, 119.9995, 20.0004, 0, 82.5)
        self.assertEqual([one["t"] for one in told], [82.5, 20, 120, 20.001, 0.001, 82.5])
        self.assertEqual([one["from"] for one in told], [None, 15, 82.5, 15, None, 82.5])
        for one in told:
            self.assertEqual(one["state"], self.state_at(one["t"]))
            self.assertEqual(one["check"]["t"], one["t"])

    def test_jumps_to_what_is_no_instant_are_complained_of(self):
        self.follow_wall(max_time=10)
        self.assertEqual([one["t"] for one in self.jumps("x", 2, 99, "", -1, 1, status=2)], [2, 1])
        (self.folder / "instants.txt").write_text("1 2\n99\n")
        told = run_vagus("replay", self.file, "--jumps", self.folder / "instants.txt", status=2)
        self.assertIn('line 1: expected an instant in seconds, as 82.5, found "1 2"', told)
        self.assertRegex(told, r"line 2: 99\.000000 s: .*run\.mcap has instants from 0 to 10\.\d+ s")
        self.assertIn("none: cannot be read", run_vagus("replay", self.file, "--jumps", "none", status=2))
        self.assertIn("cannot be read: Is a directory", run_vagus("replay", self.file, "--jumps", self.folder, status=2))
        self.assertIn("--until excludes --jumps",
                      run_vagus("replay", self.file, "--jumps", "-", "--until", 1, status=2))

    def descendants(self, process):
        parents = {}
        for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
            try:
                parents[int(stat.parent.name)] = int(stat.read_text().rpartition(")")[2].split()[1])
            except OSError:
                pass  # it has ended meanwhile
        found, new = set(), {process}
        while new:
            new = {child for child, parent in parents.items() if parent in new} - found
            found |= new
        return found

    def test_no_keyframe_is_left_when_the_replay_is_killed(self):
        self.follow_wall()
        with vagus("replay", self.file, "--jumps", "-", typing=True) as program:
            program.type("110")
            program.wait_line("110.000 s")
            copies = [os.pidfd_open(one) for one in self.descendants(program.process.pid)]
            self.assertGreater(len(copies), 5)
            program.kill()
            for copy in copies:
                poll = select.poll()
                poll.register(copy, select.POLLIN)
                self.assertTrue(poll.poll(1000 * GIVE_UP_AFTER))
                os.close(copy)

    def test_where_templates_are_in_a_library_there_are_no_keyframes(self):
        library = pathlib.Path(VAGUS).resolve().parent.parent / "tests/studio/hanging.so"
        if not library.exists():
            self.skipTest(f"{library} is not built")
        for name in ("follow-wall", "carbot"):
            shutil.copytree(EXAMPLES / name, self.folder / name, ignore=shutil.ignore_patterns("vagus.json"))
        shutil.copy(EXAMPLES / "vagus.json", self.folder)
        # A recording names it by its place beside the folder of its files.
        with tempfile.TemporaryDirectory(prefix="vagus-library-") as beside:
            shutil.copy(library, beside)
            plan = self.folder / "follow-wall/WallFollow.plan.json"
            run_vagus("plan", "run", plan, "--world", self.folder / "follow-wall/hall.world.json", "--clock", "virtual",
                      "--quiet", "--max-time", 10, "--set", "walldist=30", "--toolbox", f"{beside}/hanging.so",
                      "--record", self.file, status=5)
            (self.folder / "instants.txt").write_text("5\n9\n")
            told = run_vagus("replay", self.file, "--jumps", self.folder / "instants.txt")
            self.assertRegex(told, r"each jump runs again from the beginning: templates of the plan are in the shared "
                                   r"library .*hanging\.so, which may have threads of its own")
            self.assertEqual(told.count("from the beginning\n") + told.endswith("from the beginning"), 2)
            self.assertIn(self.state_at(9), told)

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

    # ---- log points ----

    def script_line(self, text, file="carbot/carbot.aesl"):
        """The number of the only line of a script that is this."""
        lines = [line.strip() for line in (EXAMPLES / file).read_text().splitlines()]
        self.assertEqual(lines.count(text), 1, text)
        return lines.index(text) + 1

    def logged(self, *points, options=()):
        """The hits, in their order; the run is the same as it was."""
        words = [word for where, values in points for word in ("--log", where, values)]
        told = self.replays("--json", *words, *options).splitlines()
        *hits, result = [json.loads(line) for line in told if line.startswith("{")]  # words for people are on stderr
        self.assertIsNone(result["difference"])
        self.assertGreater(result["compared"], 0)
        return hits

    def traced_follow_wall(self, max_time):
        """Gives what the plan and the bus said meanwhile, as the run itself wrote it."""
        trace = self.folder / "all.jsonl"
        self.follow_wall("--trace-all", trace, max_time=max_time)
        return [json.loads(line) for line in trace.read_text().splitlines()]

    def test_a_line_of_a_script_tells_its_values(self):
        """What `emit drive.arrived [token]` is reached with is what comes: by another way."""
        said = self.traced_follow_wall(130)
        arrived = [(line["t"], line["args"]) for line in said if line.get("name") == "drive.arrived"]
        self.assertGreater(len(arrived), 3)
        where = f"drive:{self.script_line('emit drive.arrived [token]')}"
        hits = self.logged((where, "token, token * 2 + 1, watch.x"))
        self.assertEqual([hit["at"] for hit in hits], [where] * len(arrived))
        self.assertEqual([[hit["values"]["token"]] for hit in hits], [args for _, args in arrived])
        for hit, (t, args) in zip(hits, arrived):
            # Over the bus it takes a moment.
            self.assertLess(0, t - hit["t"] + 1e-9)
            self.assertLess(t - hit["t"], 0.005)
            self.assertEqual(hit["values"]["token * 2 + 1"], args[0] * 2 + 1)
            self.assertEqual(len(hit["values"]["watch.x"]), 4)
        text = self.replays("--log", where, "token")
        first, token = hits[0]["t"], hits[0]["values"]["token"]
        self.assertEqual(text.splitlines()[0].split(), [f"{first:.3f}", "s", where, "token", "=", str(token)])
        self.assertRegex(text, NO_DIFFERENCE)

    def test_a_line_is_reached_before_it_does_anything(self):
        """Line by line through `sub accept`: the token is the one before, and then the event's."""
        self.follow_wall(max_time=20)
        before = f"drive:{self.script_line('token = event.args[0]')}"
        behind = f"drive:{self.script_line('touch_ended = 0')}"
        hits = self.logged((before, "token, event.args[0]"), (behind, "token, event.args[0]"))
        self.assertGreater(len(hits), 3)
        token = -1
        for one, two in zip(hits[::2], hits[1::2]):
            self.assertEqual((one["at"], two["at"]), (before, behind))
            self.assertEqual(one["t"], two["t"])
            # In between it can only have been ended.
            self.assertIn(one["values"]["token"], (token, -1))
            token = one["values"]["event.args[0]"]
            self.assertEqual(two["values"], {"token": token, "event.args[0]": token})

    def test_an_element_of_the_plan_tells_its_values(self):
        said = self.traced_follow_wall(60)
        wrote = [line["value"] for line in said if line.get("kind") == "write" and line.get("by") == "findWallAngle"]
        began = [line["t"] for line in said if line.get("kind") == "actor-start" and line["actor"] == "followWall"]
        raised = [line["t"] for line in said if line.get("kind") == "event" and line.get("supervisor") == "checkLane"]
        self.assertTrue(wrote and began and raised)
        hits = self.logged(("@findWallAngle.leave", "wallangle"), ("@followWall.enter", "walldist, if(walldist > 20, 'far', 'near')"),
                           ("@checkLane.raise", "walldist / 0"))
        at = lambda where: [hit for hit in hits if hit["at"] == where]
        self.assertEqual([hit["values"]["wallangle"] for hit in at("@findWallAngle.leave")][:len(wrote)], wrote)
        self.assertEqual([hit["t"] for hit in at("@followWall.enter")], began)
        self.assertEqual(at("@followWall.enter")[0]["values"], {"walldist": 30, "if(walldist > 20, 'far', 'near')": "far"})
        self.assertEqual([hit["t"] for hit in at("@checkLane.raise")], raised)
        self.assertIn("error", at("@checkLane.raise")[0]["values"]["walldist / 0"])

    def test_a_script_that_is_loaded_while_the_world_runs(self):
        """Its first line is reached once, before its variables have their values."""
        run_vagus("sim", EXAMPLES / "thymio/arena.world.json", "--load", EXAMPLES / "thymio/explore.aesl", "--headless",
                  "--speed", "max", "--duration", 5, "--record", self.file)
        first = f"thymio-II:{self.script_line('var running = 1', 'thymio/explore.aesl')}"
        last = f"thymio-II:{self.script_line('timer.period[0] = 3000', 'thymio/explore.aesl')}"
        hits = self.logged((first, "running, free"), (last, "running, free, timer.period"))
        self.assertEqual([(hit["at"], hit["values"]) for hit in hits],
                         [(first, {"running": 0, "free": 15}), (last, {"running": 1, "free": 15, "timer.period": [0, 0]})])
        self.assertLess(hits[0]["t"], 1)
        self.assertIn('there is no node "thymio"; did you mean thymio-II?',
                      self.replays("--log", "thymio:40", "running", status=2))

    def test_log_points_end_where_the_replay_ends(self):
        self.follow_wall(max_time=40)
        hits = self.logged((f"drive:{self.script_line('patience -= 1')}", "patience"), ("@searchFirstWall.leave", "walldist"),
                           options=("--until", 5))
        self.assertTrue(hits)
        self.assertEqual({hit["at"][0] for hit in hits}, {"d"})  # its actor runs on: nothing has left
        self.assertLessEqual(hits[-1]["t"], 5)

    def test_log_points_that_are_not_there(self):
        self.follow_wall(max_time=2)
        line = self.script_line("token = event.args[0]")
        for where, values, sentence in (
                (f"drive:{line}", "tokn", "did you mean token?"),
                ("drive:1", "token", "drive has no code at line 1 of carbot.aesl; the nearest with code: "),
                ("wheels:5", "token", 'there is no node "wheels"; there are: '),
                ("@followWal.enter", "walldist", "did you mean followWall?"),
                ("followWall", "walldist", "expected NODE:LINE, as drive:42, or @ACTOR.enter")):
            with self.subTest(where=where):
                self.assertIn(sentence, self.replays("--log", where, values, status=2))
        self.assertIn("@followWall.enter: was not reached", self.replays("--log", "@followWall.enter", "walldist"))

    # ---- another way from an instant on ----

    def goes_another_way(self, *options, at=20):
        """Gives the lanes of both runs that differ; the new recording is one as any."""
        other = self.folder / "other.mcap"
        told = self.replays("--from", at, "--record", other, *options)
        self.assertRegex(told, rf"{at:.6f} s again, \d+ messages compared: no difference")
        self.assertIn("it ends now: ", told)
        self.assertRegex(run_vagus("replay", other), NO_DIFFERENCE)
        lanes = json.loads(run_vagus("compare", self.file, other, "--json", status=1))["lanes"]
        return {lane["lane"]: lane["difference"] for lane in lanes if lane["difference"]}

    def test_a_variable_is_set_at_an_instant_of_the_past(self):
        """And the planted difference is the first that `compare` tells."""
        self.follow_wall(max_time=40)
        found = self.goes_another_way("--set", "walldist=60")
        self.assertEqual(list(found)[0], "/vagus/input")
        self.assertEqual(found["/vagus/input"]["a_t"], 20)
        self.assertEqual(found["/vagus/input"]["b"], {"do": "set", "value": "walldist=60"})
        self.assertIsNone(found["/vagus/input"]["a"])
        self.assertIn("/plan/trace", found)
        self.assertEqual(found["/plan/trace"]["a_t"], 20.001)  # the plan decides at the next instant
        self.assertEqual({key: found["/plan/trace"]["b"][key] for key in ("kind", "variable", "value")},
                         {"kind": "write", "variable": "walldist", "value": 60})

    def test_a_script_changes_at_an_instant_of_the_past(self):
        self.follow_wall(max_time=40)
        script = self.folder / "carbot.aesl"
        text = (EXAMPLES / "carbot/carbot.aesl").read_text()
        self.assertEqual(text.count("const PATIENCE = 15 "), 1)
        script.write_text(text.replace("const PATIENCE = 15 ", "const PATIENCE = 12 "))
        found = self.goes_another_way("--with", script)
        self.assertEqual(list(found)[0], "/vagus/input")
        self.assertEqual(found["/vagus/input"]["a_t"], 20)
        # The node is loaded over the bus, and begins as it does.
        drive = found["/node/drive/variables"]
        self.assertGreaterEqual(drive["a_t"], 20)
        self.assertLess(drive["a_t"], 21)

    def test_the_plan_changes_at_an_instant_of_the_past(self):
        self.follow_wall(max_time=40)
        plan = self.folder / "WallFollow.plan.json"
        text = (EXAMPLES / "follow-wall/WallFollow.plan.json").read_text()
        before = '"in": { "distance": 50, "seconds": 25 }'
        self.assertIn(before, text)
        plan.write_text(text.replace(before, '"in": { "distance": 50, "seconds": 26 }'))
        found = self.goes_another_way("--with", plan)
        self.assertEqual(list(found)[0], "/vagus/input")
        self.assertEqual(found["/plan/trace"]["a_t"], 20.001)
        self.assertEqual(found["/plan/trace"]["b"]["kind"], "change")

    def test_what_a_person_did_later_is_not_done(self):
        """Ended by a signal then; the way from 0.02 s on goes as far as it is let go."""
        with vagus("plan", "run", EXAMPLES / "follow-wall/WallFollow.plan.json", "--world",
                   EXAMPLES / "follow-wall/hall.world.json", "--headless", "--record", self.file) as program:
            program.wait_line(r"searchFirstWall")
            for _ in range(2):
                size = self.file.stat().st_size
                while self.file.stat().st_size == size and program.process.poll() is None:
                    pass
            program.signal(signal.SIGINT)
            program.wait_end()
        found = self.goes_another_way("--until", 30, at=0.02)
        self.assertIn("end", found)
        self.assertGreaterEqual(found["end"]["b"]["t"], 30)
        self.assertLess(found["end"]["a"]["t"], 30)

    def test_a_world_goes_another_way(self):
        run_vagus("sim", EXAMPLES / "thymio/arena.world.json", "--load", EXAMPLES / "thymio/explore.aesl", "--headless",
                  "--speed", "max", "--duration", 10, "--record", self.file)
        script = self.folder / "explore.aesl"
        text = (EXAMPLES / "thymio/explore.aesl").read_text()
        self.assertEqual(text.count("const CRUISE = 300"), 1)
        script.write_text(text.replace("const CRUISE = 300", "const CRUISE = 100"))
        other = self.folder / "other.mcap"
        self.assertRegex(self.replays("--from", 5, "--with", script, "--record", other), r"5\.000000 s again.*no difference")
        self.assertRegex(run_vagus("replay", other), NO_DIFFERENCE)
        lanes = json.loads(run_vagus("compare", self.file, other, "--json", status=1))["lanes"]
        self.assertEqual((lanes[0]["lane"], lanes[0]["difference"]["a_t"]), ("/vagus/input", 5))
        pose = next(lane for lane in lanes if lane["lane"] == "/world/poses robot/thymio")
        self.assertGreater(pose["difference"]["a_t"], 5)

    def test_what_cannot_change_on_the_way(self):
        self.follow_wall(max_time=5)
        world = self.folder / "hall.world.json"
        world.write_text((EXAMPLES / "follow-wall/hall.world.json").read_text())
        script = self.folder / "carbot.aesl"
        script.write_text((EXAMPLES / "carbot/carbot.aesl").read_text().replace("token = event.args[0]", "tokn = event.args[0]", 1))
        for words, sentence in (
                (["--from", 1, "--with", world], "hall.world.json cannot change while the run goes on"),
                (["--from", 1, "--with", script], "tokn"),
                (["--from", 1, "--set", "wall=3"], "wall"),
                (["--from", 9], "run.mcap ends at 5."),
                (["--set", "walldist=3"], "--set goes with --from"),
                (["--from", 2, "--until", 1], "--until comes before --from"),
                (["--until", 1, "--record", self.folder / "x.mcap"], "say from when on it is"),
                (["--record", self.file], "is the recording that is read")):
            with self.subTest(words=words):
                self.assertIn(sentence, self.replays(*words, status=2))
        self.assertRegex(self.replays(), NO_DIFFERENCE)

    # ---- side by side ----

    def compares(self, *options, status=1):
        return json.loads(run_vagus("compare", self.file, self.folder / "other.mcap", "--json", *options, status=status))

    def other_follow_wall(self, world=None, **options):
        first, self.file = self.file, self.folder / "other.mcap"
        with vagus("plan", "run", EXAMPLES / "follow-wall/WallFollow.plan.json", "--world",
                   world or EXAMPLES / "follow-wall/hall.world.json", "--set", "walldist=30", "--clock", "virtual", "--quiet",
                   "--record", self.file, *[word for name, value in options.items() for word in (f"--{name}", value)]) as program:
            program.wait_end()
        self.file = first

    def test_the_same_run_twice_has_no_difference(self):
        self.follow_wall(max_time=20)
        self.other_follow_wall(**{"max-time": 20})
        self.assertRegex(run_vagus("compare", self.file, self.folder / "other.mcap"), r"values compared: no difference$")

    def test_a_world_that_differs_at_an_instant(self):
        """The plank comes at 81 s instead of at 80 s: before, nothing differs."""
        self.follow_wall(max_time=85)
        folder = self.folder / "follow-wall"
        folder.mkdir()
        text = (EXAMPLES / "follow-wall/hall.world.json").read_text()
        self.assertEqual(text.count('"t": 80,'), 1)
        text = text.replace('"t": 80,', '"t": 81,').replace('"../carbot/carbot.aesl"', json.dumps(str(EXAMPLES / "carbot/carbot.aesl")))
        (folder / "hall.world.json").write_text(text)
        self.other_follow_wall(folder / "hall.world.json", **{"max-time": 85})
        found = self.compares()
        first = found["lanes"][0]
        self.assertEqual(first["lane"], "/world/scene")
        self.assertEqual(first["difference"]["b_t"], first["difference"]["a_t"])
        # Scenes are looked at with the poses, each 100 ms.
        self.assertLessEqual(80, first["difference"]["a_t"])
        self.assertLessEqual(first["difference"]["a_t"], 80.1)
        self.assertTrue(any(one["what"].startswith("file ") for one in found["started"]))

    def test_aligned_at_an_actor(self):
        """The second waits longer before it: from there on both do the same."""
        for seconds, file in ((2, self.file), (3.5, self.folder / "other.mcap")):
            plan = self.folder / "Wait.plan.json"
            plan.write_text(json.dumps({
                "format": "vagus-plan/1", "name": "Wait", "start": {"actor": "first"}, "actors": {
                    "first": {"template": "Wait", "in": {"seconds": seconds}, "states": {"Done": "second"}},
                    "second": {"template": "Wait", "in": {"seconds": 1}, "states": {"Done": "@terminate"}}}}))
            run_vagus("plan", "run", plan, "--clock", "virtual", "--record", file)
        self.assertEqual(self.compares("--align", "actor", "second", status=0)["aligned"], {"a": 2, "b": 3.5})
        apart = self.compares()["lanes"][0]
        self.assertEqual((apart["lane"], apart["difference"]["a_t"]), ("/plan/trace", 0))  # the input of the first
        told = run_vagus("compare", self.file, self.folder / "other.mcap", "--align", "actor", "third", status=2)
        self.assertIn('began no actor "third"; ', told)
        self.assertIn("expected start, actor NAME or event NAME",
                      run_vagus("compare", self.file, self.file, "--align", "middle", status=2))

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
        again = self.replays()
        self.assertIn("has no end", again)
        self.assertRegex(again, NO_DIFFERENCE)

    def test_a_recording_that_is_damaged_in_its_middle_is_told(self):
        """By each verb that reads it, with the place and what helps; not as another run."""
        self.follow_wall(max_time=60)
        whole = self.folder / "whole.mcap"
        shutil.copy(self.file, whole)
        content = self.file.read_bytes()
        chunks = [record for opcode, record in records(content[len(MAGIC):]) if opcode == CHUNK]
        chunk = chunks[len(chunks) // 2]
        middle = content.index(chunk) + len(chunk) // 2
        self.file.write_bytes(content[:middle] + bytes(64) + content[middle + 64:])
        repaired = self.folder / "repaired.mcap"
        for words in (["compare", whole, self.file], ["compare", self.file, whole], ["replay", self.file],
                      ["why", self.file, "end"], ["test", "new", self.file, self.folder / "run.test.json"]):
            with self.subTest(words=words):
                told = run_vagus(*words, status=2)
                at = int(re.search(rf"{self.file}: the chunk at byte (\d+) cannot be read: ", told).group(1))
                self.assertLess(at, middle)
                self.assertIn(f"`vagus replay {self.file} --repair WHOLE.mcap`", told)
        self.replays("--repair", repaired)
        run_vagus("why", repaired, "motor", "carbot", "--at", 10)
        # What is missing behind the damage is missing, and no difference; also after another repair.
        twice = self.folder / "twice.mcap"
        run_vagus("replay", repaired, "--repair", twice)
        for file in (repaired, twice):
            self.assertRegex(run_vagus("replay", file), NO_DIFFERENCE)
            self.assertIn("no difference", run_vagus("compare", file, whole))

    def test_what_is_no_recording(self):
        self.file.write_text("{}")
        self.assertIn("is no recording", self.replays(status=2))
        self.file.unlink()
        self.assertIn("cannot be read", self.replays(status=2))

    def test_a_file_that_is_read_or_is_no_recording_is_not_written(self):
        self.follow_wall(max_time=2)
        whole = self.file.read_bytes()
        self.assertIn("is the recording that is read", self.replays("--repair", self.file, status=2))
        self.assertEqual(self.file.read_bytes(), whole)
        plan = self.folder / "Mine.plan.json"
        plan.write_text("{ unfinished")
        for words in (["replay", self.file, "--record", plan], ["replay", self.file, "--repair", plan]):
            with self.subTest(words=words):
                self.assertIn("is there already, and is no recording", run_vagus(*words, status=2))
                self.assertEqual(plan.read_text(), "{ unfinished")

    def test_instants_that_are_none(self):
        self.follow_wall(max_time=2)
        for option in ("--until", "--from"):
            for seconds in ("nan", "inf", "-1", "1e300", "x"):
                with self.subTest(option=option, seconds=seconds):
                    self.assertIn(f'{option}: expected a number of seconds from 0 on, found "{seconds}"',
                                  self.replays(f"{option}={seconds}", status=2))
        self.assertIn('--at: expected a number of seconds from 0 on, found "nan"',
                      run_vagus("why", self.file, "end", "--at", "nan", status=2))

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

    def test_hosts_on_the_bus_are_heard_again(self):
        """What others say on the bus of a world: scripts are loaded, variables set, nodes stopped and let run."""
        with vagus("sim", EXAMPLES / "thymio/arena.world.json", "--load", EXAMPLES / "thymio/explore.aesl", "--headless",
                   "--listen", "tcp:127.0.0.1:0", "--duration", 600, "--record", self.file) as program:
            target = program.wait_line(r"listening (\S+)").group(1)
            run_vagus("net", target, "set", "--leave", "thymio-II", "motor.left.target", 150)
            run_vagus("net", target, "stop", "thymio-II")
            run_vagus("net", target, "load", EXAMPLES / "thymio/line.aesl")
            run_vagus("net", target, "set", "--leave", "thymio-II", "motor.right.target", 70)
            program.signal(signal.SIGINT)
            program.wait_end()
        self.assertRegex(self.replays(), NO_DIFFERENCE)
        # Another program runs than the one that the recording has: its lines are nobody's.
        chain = self.why("motor", "thymio")
        self.assertNotIn("explore.aesl", "".join(link["place"] for link in chain))

    def test_a_port_of_a_robot_is_not_recorded(self):
        world = json.loads((EXAMPLES / "thymio/arena.world.json").read_text())
        world["robots"][0] |= {"port": 0, "script": str(EXAMPLES / "thymio/explore.aesl")}
        changed = self.folder / "arena.world.json"
        changed.write_text(json.dumps(world))
        told = run_vagus("sim", changed, "--headless", "--record", self.file, status=2)
        self.assertIn("have ports of their own", told)

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
        self.assertEqual(first("event", "TouchSensorPressed", at=83), "the supervisor wallTouch raised TouchSensorPressed")
        self.assertEqual(root("event", "TouchSensorPressed", at=83), 'the timeline of the world put "plank" there')
        self.assertEqual(root("end"), 'the timeline of the world pressed the button "escape" of carbot')
        self.assertEqual(self.why("end")[0]["what"], "the plan WallFollow ended: Interrupted")
        for question, sentence in ((["actor", "followwall"], "did you mean followWall?"),
                                   (["motor", "r2d2"], "there is carbot"),
                                   (["event", "drive.arived"], "did you mean drive.arrived?"),
                                   (["event", "laneNotfree"], "did you mean LaneNotFree?"),
                                   (["event", "nothing like it"], "; there are: LaneNotFree"),
                                   (["variable", "drive.tokn"], "did you mean token?")):
            self.assertIn(sentence, run_vagus("why", self.file, *question, "--at", 20, status=1))
        self.assertIn("expected a question", run_vagus("why", self.file, "moter", "carbot", status=2))

    def test_questions_about_a_thymio(self):
        run_vagus("sim", EXAMPLES / "thymio/arena.world.json", "--load", EXAMPLES / "thymio/explore.aesl", "--headless",
                  "--speed", "max", "--duration", 20, "--record", self.file)
        chain = self.why("motor", "thymio", at=10)
        self.assertRegex(chain[0]["what"], r"^the script of thymio-II wrote motor\.(left|right)\.target$")
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
