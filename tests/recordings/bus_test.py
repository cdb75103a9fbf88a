"""Recordings of real buses: made by `vagus net record` and `vagus plan run --bus`, decided on again, asked why."""
import json
import pathlib
import signal
import sys
import tempfile
import unittest
import xml.etree.ElementTree

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import Bus, listening, patiently, run_vagus, vagus
from mcap import Recording

EXAMPLES = pathlib.Path(__file__).resolve().parent.parent.parent / "examples"

# The robot answers `go`, behind the token, with one more, and says `far` when that is much.
SCRIPT = """<network>
<event size="2" name="go"/>
<event size="2" name="gone"/>
<event size="1" name="far"/>
<node nodeId="1" name="thymio-II">var n = 0
onevent go
n = event.args[1] + 1
emit gone [event.args[0], n]
if n > 3 then
callsub tell
end

onevent button.center
emit far 0

sub tell
emit far n
</node></network>
"""
GO_LINE, GONE_LINE = 6, 8  # of the file: `onevent go`, `emit gone`
WORLD = {
    "format": "vagus-world/1", "name": "Room", "size": [1, 1],
    "robots": [{"name": "thymio", "type": "thymio2", "at": [0.5, 0.5], "script": "answer.aesl"}],
}
# Listens before it asks: whichever of the two is faster, the answer is heard.
TOOLBOX = {
    "format": "vagus-toolbox/1", "name": "asker", "help": "Asks the robot.", "project": "answer.aesl",
    "templates": {"Ask": {
        "kind": "actor", "help": "Asks for one more.", "node": "thymio-II", "in": {"n": {"type": "int", "help": "a number"}},
        "out": {"more": {"type": "int", "help": "one more"}}, "start": "go",
        "states": {"Told": {"event": "gone", "out": ["more"], "help": "it has answered"}}}},
}
# Counts to 5 together with the robot.
PLAN = {
    "format": "vagus-plan/1", "name": "Count", "toolboxes": ["asker"],
    "configuration": {"n": {"type": "int", "initial": 0}},
    "start": {"actor": "ask"},
    "actors": {
        "ask": {"template": "Ask", "in": {"n": "n"}, "out": {"more": "n"}, "states": {"Told": "more"}},
        "more": {"template": "Compare", "in": {"left": "n", "op": "'<'", "right": 5},
                 "states": {"True": "ask", "False": "@terminate"}},
    },
}
# The same, with a way that no robot makes it take.
COVER = {
    "format": "vagus-plan/1", "name": "Cover", "toolboxes": ["asker"],
    "configuration": {"n": {"type": "int", "initial": 0}},
    "start": {"actor": "ask"},
    "actors": {
        "ask": dict(PLAN["actors"]["ask"], supervisors={
            "late": {"template": "Timeout", "in": {"seconds": 60}, "events": {"Timeout": "never"}}}),
        "more": PLAN["actors"]["more"],
        "never": {"template": "Wait", "in": {"seconds": 0.1}, "states": {"Done": "@terminate"}},
    },
}
COVERED = """  actors       2 of 3
  states       3 of 4
  supervisors  0 of 1
  events       0 of 1
  pairs        2 of 3
"""
# Waits for what nobody sends.
WAITING = {
    "format": "vagus-plan/1", "name": "Wait", "start": {"actor": "hear"},
    "actors": {"hear": {"template": "Receive", "in": {"event": "'gone'"}, "states": {"Received": "@terminate"}}},
}


class BusRecordings(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-bus-")))
        self.file = self.folder / "run.mcap"
        self.script = self.folder / "answer.aesl"
        self.script.write_text(SCRIPT)
        self.world = self.write("room.world.json", WORLD)
        self.plan = self.write("Count.plan.json", PLAN)
        self.toolbox = self.write("asker.toolbox.json", TOOLBOX)

    def write(self, name, content):
        path = self.folder / name
        path.write_text(json.dumps(content, indent=1))
        return path

    def start_robot(self, world=None):
        robot = self.enterContext(vagus("sim", world or self.world, "--headless", "--listen", "tcp:127.0.0.1:0"))
        self.port = listening(robot)
        self.target = f"tcp:127.0.0.1:{self.port}"
        robot.wait_line("loaded")
        return robot

    def plan_words(self, plan=None, file=None, *more):
        return ["plan", "run", plan or self.plan, "--bus", self.target, "--project", self.script, "--quiet", "--record",
                file or self.file, *more]

    def count_words(self, file=None):
        return self.plan_words(None, file, "--toolbox", self.toolbox)

    def record_count(self):
        self.start_robot()
        run_vagus(*self.count_words())
        return Recording(self.file)

    def start_recording(self, file=None, *words):
        return self.enterContext(vagus("net", self.target, "record", file or self.file, "--project", self.script, *words))

    def wait_for(self, topic, file=None, count=1, accept=lambda message: True):
        """The recording, as soon as what is written has so many messages of that topic."""
        path = file or self.file
        for _ in patiently():
            if not path.exists() or path.stat().st_size <= 8:
                continue
            found = Recording(path)
            if len([one for one in found.json(topic) if accept(one)]) >= count:
                return found
        raise AssertionError(f"{path} never had {topic}")

    def emit(self, value):
        run_vagus("net", self.target, "emit", "go", 9, value, "--project", self.script)

    def replays(self, *options, file=None, status=0):
        return run_vagus("replay", file or self.file, *options, status=status)

    def why(self, *question, file=None):
        return json.loads(run_vagus("why", file or self.file, *question, "--json"))

    # ---- vagus net record ----

    def test_a_bus_is_recorded_with_its_frames_events_and_nodes(self):
        self.start_robot()
        recorder = self.start_recording()
        self.wait_for("/bus/nodes")
        self.emit(3)
        self.wait_for("/bus/events")
        recorder.signal(signal.SIGINT)
        self.assertEqual(recorder.wait_end(), 0, recorder.lines)
        self.assertRegex(recorder.lines[-1], r"run\.mcap: [\d.]+ s, \d+ frames$")
        recording = Recording(self.file)
        self.assertTrue(recording.complete)
        (about,) = recording.json("/vagus/run")
        self.assertEqual((about["kind"], about["verb"], about["project"]), ("bus", "net record", "answer.aesl"))
        self.assertEqual(recording.files["answer.aesl"].decode(), SCRIPT)
        self.assertEqual(json.loads(recording.files["nodes/thymio-II.json"])["name"], "thymio-II")
        (node,) = recording.json("/bus/nodes")
        self.assertEqual((node["node"], node["name"], node["file"]), (1, "thymio-II", "nodes/thymio-II.json"))
        events = recording.json("/bus/events")
        self.assertEqual([(one["name"], one["node"], one["args"]) for one in events],
                         [("go", 0, [9, 3]), ("gone", 1, [9, 4]), ("far", 1, [4])])
        frames = {number: (source, payload) for number, _, source, _, payload in recording.frames()}
        self.assertEqual(list(frames), list(range(1, len(frames) + 1)))
        self.assertEqual(frames[events[1]["frame"]], (1, b"\x09\x00\x04\x00"))
        # Variables of the description and, as the project has a script for it, of that.
        told = {name for line in recording.json("/node/thymio-II/variables") for name in line["set"]}
        self.assertLessEqual({"n", "motor.left.target", "prox.horizontal"}, told)

    def test_without_a_project_events_have_numbers(self):
        self.start_robot()
        recorder = self.enterContext(vagus("net", self.target, "record", self.file))
        self.wait_for("/bus/nodes")
        self.emit(1)
        self.wait_for("/bus/events")
        recorder.signal(signal.SIGTERM)
        self.assertEqual(recorder.wait_end(), 0, recorder.lines)
        self.assertEqual([one["name"] for one in Recording(self.file).json("/bus/events")], ["0", "1"])

    def test_it_ends_by_itself_after_wait(self):
        self.start_robot()
        self.start_recording(None, "--wait", "0.5").wait_end()
        self.assertTrue(Recording(self.file).complete)

    def test_a_dead_target_is_said_and_leaves_no_file(self):
        told = run_vagus("net", "tcp:127.0.0.1:1", "record", self.file, status=1)
        self.assertIn("127.0.0.1:1", told)
        self.assertFalse(self.file.exists())

    def test_a_target_that_goes_away_is_said_and_the_file_is_whole(self):
        robot = self.start_robot()
        recorder = self.start_recording()
        self.wait_for("/bus/nodes")
        robot.stop()
        self.assertEqual(recorder.wait_end(), 1, recorder.lines)
        self.assertIn("127.0.0.1", recorder.lines[-1])
        self.assertTrue(Recording(self.file).complete)

    def test_a_recorder_that_is_killed_leaves_all_but_the_last_second(self):
        self.start_robot()
        recorder = self.start_recording()
        self.wait_for("/bus/nodes")
        self.emit(1)
        before = self.wait_for("/bus/events")
        recorder.signal(signal.SIGKILL)
        recorder.wait_end()
        recording = Recording(self.file)
        self.assertFalse(recording.complete)
        self.assertEqual(recording.json("/bus/events")[:1], before.json("/bus/events")[:1])
        whole = self.folder / "whole.mcap"
        run_vagus("replay", self.file, "--repair", whole)
        self.assertTrue(Recording(whole).complete)
        self.assertEqual(Recording(whole).json("/bus/events"), recording.json("/bus/events"))
        self.assertIn("sent gone", self.why("event", "gone", file=whole)[0]["what"])

    def test_two_recorders_record_the_same(self):
        self.start_robot()
        other = self.folder / "other.mcap"
        recorders = [self.start_recording(), self.start_recording(other)]
        for file in (self.file, other):
            self.wait_for("/bus/nodes", file)
        self.emit(1)
        for recorder, file in zip(recorders, (self.file, other)):
            self.wait_for("/bus/events", file)
            recorder.signal(signal.SIGINT)
            self.assertEqual(recorder.wait_end(), 0, recorder.lines)
        said = [[(one["name"], one["args"]) for one in Recording(file).json("/bus/events")] for file in (self.file, other)]
        self.assertEqual(said[0], said[1])
        self.assertEqual(said[0], [("go", [9, 1]), ("gone", [9, 2])])

    def test_a_flood_of_frames_is_recorded_whole(self):
        switch = self.enterContext(vagus("switch", "--listen", "tcp:127.0.0.1:0"))
        port = listening(switch)
        self.target = f"tcp:127.0.0.1:{port}"
        recorder = self.start_recording()
        count = 5000
        with Bus(port) as bus:
            self.wait_for("/vagus/run")
            for number in range(count):
                bus.send(7, 0, number)
            self.wait_for("/bus/events", count=count)
        recorder.signal(signal.SIGINT)
        self.assertEqual(recorder.wait_end(), 0, recorder.lines)
        self.assertEqual([one["args"] for one in Recording(self.file).json("/bus/events")], [[n] for n in range(count)])

    def test_a_bus_without_a_plan_cannot_decide_again(self):
        self.start_robot()
        self.start_recording(None, "--wait", "0.2").wait_end()
        self.assertIn("is a recording of a real bus without a plan, so nothing can decide again",
                      self.replays(status=2))

    # ---- vagus plan run --bus --record ----

    def test_a_plan_decides_again_what_it_decided(self):
        recording = self.record_count()
        (about,) = recording.json("/vagus/run")
        self.assertEqual((about["kind"], about["verb"], about["plan"]), ("bus", "plan run", "Count.plan.json"))
        self.assertLessEqual({"Count.plan.json", "answer.aesl", "asker.toolbox.json", "nodes/thymio-II.json"}, set(recording.files))
        wrote = [line["value"] for line in recording.json("/plan/trace") if line["kind"] == "write"]
        self.assertEqual(wrote, [0, 1, 2, 3, 4, 5])
        self.assertRegex(self.replays(), r"messages compared: no difference$")

    def test_frames_of_the_plan_know_their_actor(self):
        recording = self.record_count()
        went = [one for one in recording.json("/bus/events") if one["name"] == "go"]
        self.assertEqual([(one["node"], one["by"], one["args"][1]) for one in went], [(0, "ask", n) for n in range(5)])
        heard = [line["frame"] for line in recording.json("/vagus/input") if line["do"] == "hear"]
        gone = [one["frame"] for one in recording.json("/bus/events") if one["name"] == "gone"]
        self.assertLessEqual(set(gone), set(heard))

    def test_another_plan_parts_from_it_at_its_first_other_line(self):
        self.record_count()
        changed = json.loads(json.dumps(PLAN))
        changed["actors"]["more"]["in"]["right"] = 3
        (self.folder / "other").mkdir()
        other = self.write("other/Count.plan.json", changed)
        told = self.replays("--with", other, status=1)
        self.assertRegex(told, r"differs at [\d.]+ s: /plan/trace, in\.right\n  then: 5\n  now:  3\n")
        self.assertIn("it ended then: ", told)
        self.assertRegex(told, r"it ends now: +OK at ")

    def test_until_and_log_of_elements(self):
        self.record_count()
        self.assertRegex(self.replays("--until", "0"), r"0\.000000 s again, \d+ messages compared: no difference$")
        told = self.replays("--log", "@ask.leave", "n")
        self.assertEqual([line.rsplit(" ", 1)[1] for line in told.splitlines()[:5]], list("12345"))

    def test_what_needs_nodes_is_refused(self):
        self.record_count()
        for words, sentence in ((["--from", 0], "its nodes cannot do anything else than they did"),
                                (["--from", 0, "--set", "n=3"], "its nodes cannot do anything else than they did"),
                                (["--from", 0, "--reseed", 3], "its nodes cannot do anything else than they did"),
                                (["--jumps", "-"], "of a real bus, whose nodes cannot be run again"),
                                (["--record", self.folder / "b.mcap"], "what the plan decides now is told, not recorded"),
                                (["--log", "thymio-II:6", "n"], "no node of this run can be run again")):
            with self.subTest(words=words):
                self.assertIn(sentence, self.replays(*words, status=2))
        self.assertIn("is a recording of a real bus, and a test runs in a world",
                      run_vagus("test", "new", self.file, self.folder / "a.test.json", status=2))
        self.assertIn("is of a real bus, whose nodes cannot be continued",
                      run_vagus("why", self.file, "--turning-point", "t > 1", status=2))

    def test_two_recordings_are_compared(self):
        self.record_count()
        other = self.folder / "other.mcap"
        run_vagus(*self.count_words(other))
        with vagus("compare", self.file, other, "--align", "actor", "ask", "--json") as program:
            self.assertIn(program.wait_end(), (0, 1), program.lines)  # the clock is a real one
            lanes = {lane["lane"]: lane for lane in json.loads("\n".join(program.lines))["lanes"]}
        self.assertIn("/plan/trace", lanes)
        self.assertIn("/bus/events", lanes)

    def test_ctrl_c_is_recorded_and_comes_again(self):
        self.start_robot()
        program = self.enterContext(vagus(*self.plan_words(self.write("Wait.plan.json", WAITING))))
        self.wait_for("/plan/trace")
        program.signal(signal.SIGINT)
        program.wait_end()
        inputs = Recording(self.file).json("/vagus/input")
        self.assertEqual(len([line for line in inputs if line["do"] == "abort"]), 1, inputs)
        self.assertRegex(self.replays(), r"no difference$")
        self.assertIn("somebody ended the run", self.why("end")[1]["what"])

    def test_a_run_that_is_killed_can_be_asked(self):
        self.start_robot()
        program = self.enterContext(vagus(*self.plan_words(self.write("Wait.plan.json", WAITING))))
        self.wait_for("/plan/trace")
        program.signal(signal.SIGKILL)
        program.wait_end()
        told = self.replays()
        self.assertIn("has no end", told)
        self.assertRegex(told, r"no difference$")
        self.assertIn("the actor hear began", self.why("actor", "hear")[0]["what"])

    def test_a_node_that_leaves_is_an_input(self):
        """The plan ends with an error that names it, and again so."""
        drive = self.write("Drive.plan.json", {
            "format": "vagus-plan/1", "name": "Drive", "toolboxes": ["drive"], "start": {"actor": "ahead"},
            "actors": {"ahead": {"template": "Forward", "in": {"distance": 1000000}, "states": {"ForwardSuccessful": "@terminate"}}}})
        hall = self.write("hall.world.json", {
            "format": "vagus-world/1", "name": "Hall", "size": [12, 2],
            "robots": [{"name": "carbot", "type": "carbot", "at": [1, 1], "script": str(EXAMPLES / "carbot/carbot.aesl")}]})
        robot = self.start_robot(hall)
        self.script = EXAMPLES / "carbot/carbot.aesl"
        program = self.enterContext(vagus(*self.plan_words(drive)))
        self.wait_for("/plan/trace")
        robot.stop()
        program.wait_end()
        ended = Recording(self.file).json("/plan/trace")[-1]
        self.assertEqual(ended["result"], "Error")
        self.assertIn({"do": "node", "name": "drive", "state": "left"},
                      [{key: line[key] for key in ("do", "name", "state")}
                       for line in Recording(self.file).json("/vagus/input") if line["do"] == "node"])
        self.assertRegex(self.replays(), r"no difference$")

    # ---- vagus plan debug --bus --record ----

    def start_debugger(self, *lines):
        words = [word for word in self.count_words() if word != "--quiet"]
        words[1] = "debug"
        program = self.enterContext(vagus(*words, typing=True))
        for line in lines:
            program.type(line)
        return program

    def test_what_a_debugger_did_is_done_again(self):
        self.start_robot()
        program = self.start_debugger("break actor more count 2", "run")
        program.wait_line("^breakpoint 1, paused at .* more ")
        for line in ("set n = 4", "delete all", "continue"):
            program.type(line)
        program.wait_line("^the run is over at .*: OK")
        program.type("quit")
        self.assertEqual(program.wait_end(), 0, program.lines)
        recording = Recording(self.file)
        self.assertEqual(recording.json("/vagus/run")[0]["verb"], "plan debug")
        wrote = [(line["value"], line["by"]) for line in recording.json("/plan/trace") if line["kind"] == "write"]
        self.assertEqual([value for value, _ in wrote], [0, 1, 2, 4, 5])
        self.assertEqual(wrote[3], (4, "outside"))
        asked = [line["do"] for line in recording.json("/vagus/input") if line["do"] not in ("hear", "node", "tokens")]
        self.assertEqual(asked, ["stop-at", "continue", "set-variable", "stop-no-more", "continue", "end"])
        self.assertRegex(self.replays(), r"no difference$")

    def test_another_plan_is_asked_what_it_decides_of_what_a_debugger_did(self):
        self.start_robot()
        program = self.start_debugger("break actor more count 2", "run")
        program.wait_line("^breakpoint 1, paused at .* more ")
        for line in ("set n = 4", "delete all", "continue"):
            program.type(line)
        program.wait_line("^the run is over at .*: OK")
        program.type("quit")
        self.assertEqual(program.wait_end(), 0, program.lines)
        (self.folder / "other").mkdir()

        def with_changed(change):
            plan = json.loads(json.dumps(PLAN))
            change(plan["actors"])
            return self.replays("--with", self.write("other/Count.plan.json", plan), status=1)

        def rename(actors):
            actors["again"] = actors.pop("more")
            actors["ask"]["states"]["Told"] = "again"
        told = with_changed(lambda actors: actors["more"]["in"].update(right=4))
        self.assertRegex(told, r"differs at [\d.]+ s: /plan/trace, in\.right\n  then: 5\n  now:  4\n")
        self.assertRegex(told, r"it ends now: +OK at ")
        # Its first other line is the one before what was written then.
        self.assertRegex(with_changed(rename), r'differs at [\d.]+ s: /plan/trace, target\n  then: "more"\n  now:  "again"\n')
        # What was set is not forgotten by a plan that decides the same.
        same = self.write("other/Count.plan.json", dict(PLAN, help="the same"))
        self.assertRegex(self.replays("--with", same), r"no difference$")
        chain = [link["what"] for link in self.why("variable", "n", "--at", self.set_at())]
        self.assertEqual(chain, ["a person gave the variable n its value"])

    def set_at(self):
        (line,) = [line for line in Recording(self.file).json("/vagus/input") if line["do"] == "set-variable"]
        return line["t"]

    def test_a_node_that_leaves_while_the_plan_is_paused_has_left_again(self):
        robot = self.start_robot()
        program = self.start_debugger("break actor ask count 2", "run")
        program.wait_line("^breakpoint 1, paused at .* ask ")
        robot.stop()
        self.wait_for("/vagus/input", accept=lambda line: line["do"] == "node" and line["state"] == "left")
        program.type("continue")
        program.wait_line("^the run is over at .*: Error")
        program.type("quit")
        self.assertNotEqual(program.wait_end(), 0)
        self.assertRegex(self.replays(), r"no difference$")

    def test_a_debugger_that_ends_before_the_run_leaves_nothing_to_compare(self):
        self.start_robot()
        program = self.start_debugger("quit")
        program.wait_end()
        self.assertEqual(Recording(self.file).json("/plan/trace"), [])
        self.assertRegex(self.replays(), r" 0 messages compared: no difference$")

    # ---- vagus test RECORDING ----

    def record_cover(self):
        self.start_robot()
        plan = self.write("Cover.plan.json", COVER)
        run_vagus(*self.plan_words(plan, None, "--toolbox", self.toolbox))

    def test_a_run_of_a_robot_counts(self):
        """ask and more five times, more to ask four times; the last way is that of False."""
        self.record_cover()
        told = run_vagus("test", self.file, "--coverage", self.folder / "coverage")
        self.assertRegex(told, r"^counted .*run\.mcap: [\d.]+ s of Cover\.plan\.json on a real bus\n")
        # `gone` comes from one line; `far` may have come from either of two.
        self.assertTrue(told.endswith("\n\nCover.plan.json\n" + COVERED + "answer.aesl\n  lines        1 that frames tell of"), told)
        drawing = xml.etree.ElementTree.parse(self.folder / "coverage/Cover.svg").getroot()
        texts = ["".join(one.itertext()) for one in drawing.iter("{http://www.w3.org/2000/svg}text")]
        counts = list(zip(texts[::2], map(int, texts[1::2])))
        for one in (("ask", 5), ("more", 5), ("never", 0), ("Told", 5), ("True", 4), ("False", 1), ("Done", 0)):
            self.assertIn(one, counts)
        listed = (self.folder / "coverage/coverage.txt").read_text()
        self.assertIn("  pairs        ask, never\n", listed)
        self.assertIn(f"\nas far as frames tell, answer.aesl:\n  line         {GONE_LINE}: 5\n", listed)
        self.assertEqual((self.folder / "coverage/scripts.info").read_text(), "")

    def test_runs_of_a_robot_and_of_tests_are_counted_together(self):
        """The test takes the only way that the robot did not."""
        self.record_cover()
        test = self.write("Cover.test.json", {
            "format": "vagus-test/1", "plan": "Cover.plan.json", "toolboxes": ["asker.toolbox.json"], "max_time": 20,
            "answers": {"Ask": [{"after": 5, "state": "Told", "out": {"more": 1}}], "late.Timeout": [{"at": 1}]},
            "expect": [{"ends": "OK"}]})
        told = run_vagus("test", test, self.file, self.file)
        self.assertIn("  actors       3 of 3\n  states       4 of 4\n  supervisors  1 of 1\n  events       1 of 1\n"
                      "  pairs        3 of 3\n", told)
        self.assertEqual(told.count("  actors  "), 1)
        self.assertTrue(told.endswith("1 of 1 runs as expected"), told)

    def test_another_version_of_the_plan_is_counted_apart(self):
        self.record_cover()
        other = self.folder / "other.mcap"
        changed = json.loads(json.dumps(COVER))
        del changed["actors"]["ask"]["supervisors"], changed["actors"]["never"]
        plan = self.write("Cover.plan.json", changed)
        run_vagus(*self.plan_words(plan, other, "--toolbox", self.toolbox))
        told = run_vagus("test", self.file, other, "--coverage", self.folder / "coverage")
        self.assertIn("\nCover.plan.json\n" + COVERED, told)
        self.assertIn(f"{other}:Cover.plan.json\n  actors       2 of 2\n  states       3 of 3\n", told)
        self.assertTrue((self.folder / "coverage/Cover-2.svg").exists())

    def test_a_recording_without_a_plan_does_not_count(self):
        self.start_robot()
        self.start_recording(None, "--wait", "0.2").wait_end()
        self.assertIn("is the recording of a run without a plan", run_vagus("test", self.file, status=2))

    # ---- vagus why ----

    def test_a_chain_goes_through_the_script_as_far_as_it_is_sure(self):
        self.record_count()
        chain = self.why("event", "gone")
        token = chain[0]["value"].split()[0]
        told = [(link["what"], link["value"].removeprefix(token + " "), link["place"], link.get("guessed", False)) for link in chain]
        self.assertEqual(told[0], ("thymio-II sent gone, probably from here", "5", f"answer.aesl:{GONE_LINE}", True))
        self.assertEqual(told[1], ("thymio-II probably heard go", "4", f"answer.aesl:{GO_LINE}", True))
        self.assertEqual(told[2][:2] + told[2][3:], ("the actor ask of the plan sent go", "4", False))
        self.assertTrue(told[2][2].startswith("Count.plan.json:"))
        self.assertEqual(told[3][0], "the actor ask began")
        self.assertTrue(chain[-1]["root"])
        self.assertIn("the plan Count began", chain[-1]["what"])
        self.assertEqual(sum("heard go" in link["what"] for link in chain), 5)
        text = run_vagus("why", self.file, "event", "gone")
        self.assertRegex(text, r"thymio-II sent gone, probably from here \(\d+ 5\)  answer\.aesl:")

    def test_what_may_have_two_causes_ends_the_chain(self):
        self.record_count()
        (link,) = self.why("event", "far")
        self.assertEqual((link["what"], link["place"], link["root"]), ("thymio-II sent far", "", True))
        self.assertNotIn("guessed", link)

    def test_an_actor_ends_by_the_event_that_it_heard(self):
        self.record_count()
        chain = self.why("actor", "ask")
        self.assertEqual(chain[0]["what"], "the actor ask ended with Told")
        self.assertEqual(chain[1]["what"], "thymio-II sent gone, probably from here")
        self.assertEqual(self.why("variable", "n")[0]["what"], "ask wrote the variable n")

    def test_what_no_frame_tells_is_said(self):
        self.record_count()
        for words, sentence in ((["variable", "thymio-II.n"], "what wrote thymio-II.n is in no frame"),
                                (["motor", "thymio"], "what commanded the wheels of a robot is in no frame"),
                                (["event", "gonne"], "did you mean gone?")):
            with self.subTest(words=words):
                self.assertIn(sentence, run_vagus("why", self.file, *words, status=1))

    def test_a_host_is_a_root(self):
        self.start_robot()
        recorder = self.start_recording()
        self.wait_for("/bus/nodes")
        self.emit(1)
        self.wait_for("/bus/events")
        recorder.signal(signal.SIGINT)
        recorder.wait_end()
        chain = self.why("event", "gone")
        self.assertEqual([link["what"] for link in chain],
                         ["thymio-II sent gone, probably from here", "thymio-II probably heard go", "a host sent go"])
        self.assertTrue(chain[-1]["root"])


if __name__ == "__main__":
    unittest.main()
