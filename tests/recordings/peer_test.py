"""Recordings of a real bus with a foreign robot: a Thymio II of Debian's `asebaplayground`, directly and behind a switch.
What the chains must say is worked out by hand from SCRIPT and from what was sent."""
import json
import pathlib
import signal
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import (Bus, Display, foreign_switch, free_port, list_nodes, listening, patiently, playground, run_vagus, vagus)
from mcap import Recording

# Answers `go`, behind the token, with one more; counts by itself; repeats what another robot counts.
SCRIPT = """<!DOCTYPE aseba-source>
<network>
<event size="2" name="go"/>
<event size="2" name="gone"/>
<event size="1" name="tick"/>
<event size="1" name="tock"/>
{nodes}
</network>
"""
NODE = """<node nodeId="{id}" name="thymio-II">var n = 0
var ticks = 0
timer.period[0] = 500
onevent go
n = event.args[1] + 1
emit gone [event.args[0], n]
onevent timer0
ticks += 1
emit tick ticks
onevent tick
emit tock event.args[0]
</node>"""
# The e-puck of asebaplayground with the id 1; the name of each has its number, counted from 0. It feels its sensors by itself.
EPUCK = """<node nodeId="{id}" name="e-puck{number}">var n = 0
var ticks = 0
onevent go
n = args[1] + 1
speed.left = n
emit gone [args[0], n]
onevent ir_sensors
ticks += 1
emit tick ticks
</node>"""
EPUCK_GO, EPUCK_GONE = 9, 12  # lines of the first; those of the second are 10 further down
# Lines of the first node; those of the second are 12 further down.
GO, GONE, TIMER, TICK, HEAR_TICK, TOCK = (f"answer.aesl:{line}" for line in (10, 12, 13, 15, 16, 17))
SECOND = {place: f"answer.aesl:{int(place.rpartition(':')[2]) + 12}" for place in (GO, GONE, TIMER, TICK, HEAR_TICK, TOCK)}
TOOLBOX = {
    "format": "vagus-toolbox/1", "name": "asker", "help": "Asks the robot.", "project": "answer.aesl",
    "templates": {"Ask": {
        "kind": "actor", "help": "Asks for one more.", "node": "thymio-II", "in": {"n": {"type": "int", "help": "a number"}},
        "out": {"more": {"type": "int", "help": "one more"}}, "start": "go",
        "states": {"Told": {"event": "gone", "out": ["more"], "help": "it has answered"}}}},
}
# Counts to 3 together with the robot.
COUNT = {
    "format": "vagus-plan/1", "name": "Count", "toolboxes": ["asker"],
    "configuration": {"n": {"type": "int", "initial": 0}},
    "start": {"actor": "ask"},
    "actors": {
        "ask": {"template": "Ask", "in": {"n": "n"}, "out": {"more": "n"}, "states": {"Told": "more"}},
        "more": {"template": "Compare", "in": {"left": "n", "op": "'<'", "right": 3},
                 "states": {"True": "ask", "False": "@terminate"}},
    },
}
# Hears what the robot answers to somebody else.
HEAR = {
    "format": "vagus-plan/1", "name": "Hear", "start": {"actor": "hear"},
    "actors": {"hear": {"template": "Receive", "in": {"event": "'gone'"}, "states": {"Received": "@terminate"}}},
}
# Asks for what nobody answers, so that it runs until something happens to its robot.
WAIT = {
    "format": "vagus-plan/1", "name": "Wait", "toolboxes": ["waiter"], "start": {"actor": "ask"},
    "actors": {"ask": {"template": "AskTwice", "states": {"Told": "@terminate"}}},
}
WAITER = {
    "format": "vagus-toolbox/1", "name": "waiter", "help": "Asks the robot for what it does not have.", "project": "answer.aesl",
    "templates": {"AskTwice": {
        "kind": "actor", "help": "Asks, and is never answered.", "node": "thymio-II", "start": "tock",
        "states": {"Told": {"event": "go", "help": "it has answered"}}}},
}


class PeerRecordings(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-peer-")))
        self.file = self.folder / "run.mcap"
        self.script = self.folder / "answer.aesl"

    def write(self, name, content):
        path = self.folder / name
        path.write_text(json.dumps(content, indent=1))
        return path

    def start(self, program):
        return self.enterContext(program)

    # ---- the bus ----

    def start_robots(self, *ids, kind="thymio2", node=NODE):
        """asebaplayground; gives the port of each robot."""
        self.ids = ids
        ports = [free_port() for _ in ids]
        self.peer = self.start(playground(self.start(Display()), self.folder, ports, ids, kind))
        for port in ports:
            Bus(port).leave()
        self.script.write_text(SCRIPT.format(nodes="\n".join(node.format(id=one, number=one - 1) for one in ids)))
        return ports

    def join(self, port):
        """The bus is there from now on; its robots run SCRIPT."""
        self.target = f"tcp:127.0.0.1:{port}"
        for _ in patiently():
            if [node["id"] for node in list_nodes(port)] == sorted(self.ids):
                break
        run_vagus("net", self.target, "load", self.script, "--wait", 30)

    def behind_asebaswitch(self, *ids):
        ports = self.start_robots(*ids)
        self.join(foreign_switch(self.start, *(f"tcp:127.0.0.1;{port}" for port in ports)))

    def behind_the_vagus_switch(self, *ids):
        ports = self.start_robots(*ids)
        switch = self.start(vagus("switch", "--listen", "tcp:127.0.0.1:0", *(f"tcp:127.0.0.1:{port}" for port in ports)))
        self.join(listening(switch))

    def emit(self, *words):
        run_vagus("net", self.target, "emit", *words, "--project", self.script)

    # ---- the recording ----

    def start_recorder(self):
        recorder = self.start(vagus("net", self.target, "record", self.file, "--project", self.script))
        self.wait_for("/bus/nodes", len(self.ids))
        return recorder

    def end(self, recorder):
        recorder.signal(signal.SIGINT)
        self.assertEqual(recorder.wait_end(), 0, recorder.lines)

    def plan_words(self, plan, *toolboxes):
        words = ["plan", "run", self.write(f"{plan['name']}.plan.json", plan), "--bus", self.target, "--project", self.script,
                 "--quiet", "--record", self.file]
        for toolbox in toolboxes:
            words += ["--toolbox", self.write(f"{toolbox['name']}.toolbox.json", toolbox)]
        return words

    def wait_for(self, topic, count=1, accept=lambda message: True):
        """As soon as what is written has so many messages of that topic."""
        for _ in patiently():
            if self.file.exists() and self.file.stat().st_size > 8:
                found = [one for one in Recording(self.file).json(topic) if accept(one)]
                if len(found) >= count:
                    return found
        raise AssertionError(f"{self.file} never had {topic}")

    def wait_for_event(self, name, count=1):
        return self.wait_for("/bus/events", count, lambda event: event["name"] == name)

    def expect_whole(self):
        recording = Recording(self.file)
        self.assertTrue(recording.complete)
        numbers = [number for number, *_ in recording.frames()]
        self.assertEqual(numbers, list(range(1, len(numbers) + 1)))
        return recording

    def expect_no_difference(self):
        self.assertRegex(run_vagus("replay", self.file), r"messages compared: no difference$")

    def why(self, *question):
        """What, where, value and whether it is guessed, of each link; the last is the root."""
        chain = json.loads(run_vagus("why", self.file, *question, "--json"))
        self.assertEqual([link["root"] for link in chain], [False] * (len(chain) - 1) + [True])
        return [(link["what"], link["place"], link["value"], link.get("guessed", False)) for link in chain]

    def ask_and_record(self):
        recorder = self.start_recorder()
        self.wait_for_event("tick")
        self.emit("go", 9, 3)
        self.wait_for_event("gone")
        self.end(recorder)
        self.expect_whole()

    # ---- vagus net record ----

    def expect_chains_of_one_robot(self):
        self.assertEqual(self.why("event", "gone"),
                         [("thymio-II sent gone, probably from here", GONE, "9 4", True),
                          ("thymio-II probably heard go", GO, "9 3", True),
                          ("a host sent go", "", "9 3", False)])
        (sent, felt) = self.why("event", "tick")
        self.assertEqual((sent[0], sent[1], sent[3]), ("thymio-II sent tick, probably from here", TICK, True))
        self.assertEqual(felt, ("thymio-II probably felt timer0", TIMER, "", True))

    def test_a_robot_of_asebaplayground_behind_asebaswitch(self):
        self.behind_asebaswitch(1)
        self.ask_and_record()
        self.expect_chains_of_one_robot()

    def test_a_robot_of_asebaplayground_behind_the_vagus_switch(self):
        self.behind_the_vagus_switch(1)
        self.ask_and_record()
        self.expect_chains_of_one_robot()

    def test_e_pucks_of_asebaplayground(self):
        ports = self.start_robots(1, 2, kind="e-puck", node=EPUCK)
        self.join(foreign_switch(self.start, *(f"tcp:127.0.0.1;{port}" for port in ports)))
        recorder = self.start_recorder()
        self.wait_for("/bus/events", 1, lambda event: event["name"] == "tick" and event["node"] == 1)
        self.wait_for("/bus/events", 1, lambda event: event["name"] == "tick" and event["node"] == 2)
        self.emit("go", 9, 300)
        self.wait_for_event("gone", 2)
        moved = self.wait_for("/node/e-puck0/variables", 1, lambda line: line["set"].get("speed.left") == 301)
        self.end(recorder)
        recording = self.expect_whole()
        self.assertEqual({(one["node"], one["name"]) for one in recording.json("/bus/nodes")}, {(1, "e-puck0"), (2, "e-puck1")})
        self.assertEqual({one["node"] for one in recording.json("/bus/events") if one["name"] == "gone"}, {1, 2})
        # The two may answer in one millisecond, and in any order: it is asked about the last one.
        gone = [one for one in recording.json("/bus/events") if one["name"] == "gone"][-1]
        who = f"e-puck{gone['node'] - 1}"
        place = lambda line: f"answer.aesl:{line + 10 * (gone['node'] - 1)}"  # noqa: E731
        self.assertEqual(self.why("event", "gone", "--at", gone["t"]),
                         [(f"{who} sent gone, probably from here", place(EPUCK_GONE), "9 301", True),
                          (f"{who} probably heard go", place(EPUCK_GO), "9 300", True),
                          ("a host sent go", "", "9 300", False)])
        self.assertIn("prox", {name.split("[")[0] for line in moved for name in line["set"]} | self.told("e-puck0", recording))
        sent, felt = self.why("event", "tick")
        self.assertRegex(sent[0], r"^e-puck[01] sent tick, probably from here$")
        self.assertRegex(felt[0], r"^e-puck[01] probably felt ir_sensors$")

    @staticmethod
    def told(node, recording):
        """The variables of the node that were recorded."""
        return {name for line in recording.json(f"/node/{node}/variables") for name in line["set"]}

    def test_two_robots_with_one_name_are_told_apart(self):
        self.behind_asebaswitch(1, 2)
        recorder = self.start_recorder()
        self.wait_for_event("tock", 4)
        self.end(recorder)
        recording = self.expect_whole()
        self.assertEqual({one["node"]: one["file"] for one in recording.json("/bus/nodes")}.keys(), {1, 2})
        topics = {name for name in recording.topics.values() if name.startswith("/node/")}
        self.assertEqual(len(topics), 2, topics)
        tock = [one for one in recording.json("/bus/events") if one["name"] == "tock"][-1]
        here, there = tock["node"], 3 - tock["node"]
        place = lambda node, of: of if node == 1 else SECOND[of]  # noqa: E731
        count = str(tock["args"][0])
        self.assertEqual(self.why("event", "tock"),
                         [(f"thymio-II (node {here}) sent tock, probably from here", place(here, TOCK), count, True),
                          (f"thymio-II (node {here}) probably heard tick", place(here, HEAR_TICK), count, True),
                          (f"thymio-II (node {there}) sent tick, probably from here", place(there, TICK), count, True),
                          (f"thymio-II (node {there}) probably felt timer0", place(there, TIMER), "", True)])

    def test_a_robot_that_takes_one_host_only_tells_the_recorder_that_it_is_over(self):
        """Each robot of asebaplayground has room for one host: a second one ends the connection of the first."""
        (port,) = self.start_robots(1)
        self.join(port)
        recorder = self.start_recorder()
        self.wait_for_event("tick", 2)
        Bus(port).leave()
        self.assertEqual(recorder.wait_end(), 1, recorder.lines)
        self.assertIn(self.target, recorder.lines[-1])
        self.expect_whole()
        self.assertEqual([link[0] for link in self.why("event", "tick")],
                         ["thymio-II sent tick, probably from here", "thymio-II probably felt timer0"])

    def test_a_killed_robot_leaves_a_whole_recording(self):
        (port,) = self.start_robots(1)
        self.join(port)
        recorder = self.start_recorder()
        self.wait_for_event("tick")
        self.peer.kill()
        self.assertEqual(recorder.wait_end(), 1, recorder.lines)
        self.assertIn(self.target, recorder.lines[-1])
        end = self.expect_whole().json("/vagus/input")[-1]
        self.assertEqual(end["do"], "end")
        self.assertIn(self.target, end["why"])

    def test_a_robot_killed_behind_asebaswitch_is_missed(self):
        """asebaswitch tells nobody that a node has gone; silence does. The recorder goes on, for others may be there."""
        self.behind_asebaswitch(1)
        recorder = self.start_recorder()
        self.wait_for_event("tick")
        self.peer.kill()
        (left,) = self.wait_for("/bus/nodes", 1, lambda node: node.get("state") == "left")
        self.assertEqual((left["node"], left["name"]), (1, "thymio-II"))
        recorder.wait_line(r"node 1 thymio-II has left, or it is silent")
        self.end(recorder)
        self.expect_whole()

    # ---- vagus plan run --bus --record ----

    def expect_count(self):
        self.assertEqual(run_vagus(*self.plan_words(COUNT, TOOLBOX)), "")
        recording = self.expect_whole()
        wrote = [line["value"] for line in recording.json("/plan/trace") if line["kind"] == "write"]
        self.assertEqual(wrote, [0, 1, 2, 3])
        self.expect_no_difference()
        chain = self.why("event", "gone")
        values = [value.split(" ", 1)[-1] for _, _, value, _ in chain]
        once = ["thymio-II sent gone, probably from here", "thymio-II probably heard go", "the actor ask of the plan sent go",
                "the actor ask began"]
        again = ["the actor more ended with True", "the actor more began", "the actor ask ended with Told"]
        self.assertEqual([link[0] for link in chain], 2 * (once + again) + once + ["the plan Count began"])
        self.assertEqual([link[3] for link in chain[:4]], [True, True, False, False])
        self.assertEqual(values[:3] + values[7:10] + values[14:17], ["3", "2", "2", "2", "1", "1", "1", "0", "0"])
        self.assertEqual([link[1] for link in chain[:2]], [GONE, GO])

    def test_a_plan_at_a_robot_of_asebaplayground(self):
        (port,) = self.start_robots(1)
        self.join(port)
        self.expect_count()

    def test_a_plan_at_a_robot_behind_asebaswitch(self):
        self.behind_asebaswitch(1)
        self.expect_count()

    def test_a_plan_ends_by_what_a_person_sent_to_the_robot(self):
        self.behind_asebaswitch(1)
        program = self.start(vagus(*self.plan_words(HEAR)))
        self.wait_for("/plan/trace")
        self.emit("go", 9, 7)
        self.assertEqual(program.wait_end(), 0, program.lines)
        self.expect_whole()
        self.expect_no_difference()
        chain = self.why("end")
        self.assertEqual([link[0] for link in chain],
                         ["the plan Hear ended: OK", "the actor hear ended with Received",
                          "thymio-II sent gone, probably from here", "thymio-II probably heard go", "a host sent go"])
        self.assertEqual([link[2] for link in chain[2:]], ["9 8", "9 7", "9 7"])
        self.assertEqual([link[3] for link in chain], [False, False, True, True, False])

    def expect_an_end_with_the_robot(self):
        program = self.start(vagus(*self.plan_words(WAIT, WAITER)))
        self.wait_for("/plan/trace", 2)
        self.peer.kill()
        self.assertNotEqual(program.wait_end(), 0)
        recording = self.expect_whole()
        ended = recording.json("/plan/trace")[-1]
        self.assertEqual(ended["result"], "Error", recording.json("/plan/trace"))
        self.assertIn("thymio-II", ended["message"])
        self.expect_no_difference()
        self.assertIn("thymio-II", self.why("end")[0][2])

    def test_a_plan_whose_robot_is_killed(self):
        (port,) = self.start_robots(1)
        self.join(port)
        self.expect_an_end_with_the_robot()

    def test_a_plan_whose_robot_is_killed_behind_asebaswitch(self):
        self.behind_asebaswitch(1)
        self.expect_an_end_with_the_robot()


if __name__ == "__main__":
    unittest.main()
