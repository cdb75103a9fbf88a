"""Scripts on a bus without a plan: each run of them is a recording, which the server makes itself."""
import json
import sys
import tempfile
import unittest

import projects
from cases import Case
from harness import Bus, listening, run_vagus, simulated, wait_until
from mcap import Recording

# Answers `go n` with `told n n+1`, from line 5; it can be told from nowhere else.
SCRIPT = """var n
onevent go
	n = event.args[0]
	motor.left.target = n
	emit told [n, n + 1]
"""
# The same answer, two lines further down.
LATER = SCRIPT.replace("onevent go", "var more\nmore = 0\nonevent go")


class BusScripts(Case):
    def open_robot(self):
        arena = self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-arena-"))
        self.robot_program = self.enterContext(simulated(arena, {"name": "alice", "node": 1}))
        self.port = listening(self.robot_program)

        def make(folder):
            projects.bus(folder, f"tcp:127.0.0.1:{self.port}", name="thymio-II", script=SCRIPT)
            projects.write(folder, "rounds.plan.json", projects.PLAN)  # which the project does not name

        self.open(make)
        self.wait_node(described=True)
        return self.page

    def start(self):
        self.page.do("run.start")
        self.wait_node(state="running", program="current")

    def say(self, number):
        self.page.do("event.send", name="go", args=[number])
        self.wait(lambda: [event for event in self.events("told") if event["args"] == [number, number + 1]], f"the answer to {number}")

    def file(self, number=1):
        return self.folder / f".vagus/recordings/run-{number}.mcap"

    def files(self):
        return sorted(path.name for path in (self.folder / ".vagus/recordings").glob("*"))

    def wait_whole(self, number=1):
        wait_until(f"run-{number}.mcap with its end", lambda: Recording(self.file(number)).complete)
        return Recording(self.file(number))

    def inputs(self, recording):
        return [line["do"] for line in recording.json("/vagus/input")]

    def test_a_run_from_run_to_stop_is_a_recording(self):
        page = self.open_robot()
        self.assertIn("none has begun yet", self.refused("unavailable", "why.ask", about="event", name="told"))
        self.start()
        self.say(7)
        # Also while it goes on.
        chain = page.do("why.ask", about="event", name="told")["chain"]
        self.assertEqual([(link["what"], link.get("doc"), link.get("line")) for link in chain[:2]],
                         [("thymio-II sent told, probably from here", projects.DOC, 5), ("thymio-II probably heard go", projects.DOC, 2)])
        page.do("stop")
        recording = self.wait_whole()
        (about,) = recording.json("/vagus/run")
        self.assertEqual((about["kind"], about["verb"], about["bus"], about["project"]),
                         ("bus", "studio", f"tcp:127.0.0.1:{self.port}", "robot.aesl"))
        self.assertEqual(about["plan"], "")
        self.assertLessEqual({"robot.aesl", "nodes/thymio-II.json"}, set(recording.files))
        said = [(one["node"], one["name"], one["args"]) for one in recording.json("/bus/events")]
        self.assertEqual(said, [(0, "go", [7]), (1, "told", [7, 8])])
        # What happened after Stop is in none.
        page.do("event.send", name="go", args=[9])
        self.wait(lambda: [event for event in self.events("go") if event["args"] == [9]], "the event")
        self.assertEqual(len(Recording(self.file()).json("/bus/events")), 2)
        told = run_vagus("replay", self.file(), status=2)
        self.assertIn("is a recording of a real bus without a plan, so nothing can decide again", told)

    def test_the_clock_of_the_recording_is_that_of_the_timeline(self):
        page = self.open_robot()
        history = page.watch("history")
        self.wait(lambda: history.value and history.value["to"] > 0.5, "time before the run")
        self.start()
        self.say(3)
        (told,) = self.events("told")
        page.do("stop")
        (recorded,) = [one for one in self.wait_whole().json("/bus/events") if one["name"] == "told"]
        self.assertAlmostEqual(told["t"], recorded["t"], delta=0.05)
        lived = page.do("history.at", t=1e6, events=100)["events"]
        (kept,) = [one for one in lived if one["name"] == "told"]
        self.assertAlmostEqual(kept["t"], recorded["t"], delta=0.05)

    def test_scripts_that_are_loaded_again_are_the_same_run(self):
        page = self.open_robot()
        self.start()
        self.say(1)
        now = page.do("doc.open", doc=projects.DOC)["text"]
        page.edit(projects.DOC, (0, len(now.encode("utf-16-le")) // 2, LATER))
        self.start()
        self.say(2)
        page.do("stop")
        recording = self.wait_whole()
        self.assertEqual(self.files(), ["run-1.mcap"])
        self.assertEqual(self.inputs(recording), ["script", "script", "end"])
        told = [one for one in recording.json("/bus/events") if one["name"] == "told"]
        self.assertEqual([one["args"] for one in told], [[1, 2], [2, 3]])
        # Lines of the file: the script begins in its sixth.
        places = [json.loads(run_vagus("why", self.file(), "event", "told", "--at", one["t"], "--json"))[0]["place"] for one in told]
        self.assertEqual(places, ["robot.aesl:10", "robot.aesl:12"])

    def test_each_run_has_its_own_file_and_those_before_are_looked_at(self):
        page = self.open_robot()
        for number in (1, 2):
            self.start()
            self.say(number)
            page.do("stop")
            self.wait_node(state="stopped")
        (kept,) = page.do("recording.list")["recordings"]
        self.assertEqual(kept["path"], ".vagus/recordings/run-1.mcap")
        opened = page.do("history.open", trace=kept["path"])
        self.assertEqual((opened["from"], opened["refused"]), (0, 0))
        end = page.do("history.at", t=opened["to"], events=100, trace=kept["path"])
        self.assertEqual([one["args"] for one in end["events"] if one["name"] == "told"], [[1, 2]])
        told = page.do("why.ask", about="event", name="told")["chain"]  # of the last
        self.assertEqual(told[0]["value"], "2 3")

    def test_a_value_that_does_not_change_is_known_from_the_beginning_on(self):
        page = self.open_robot()
        described = page.watch("node", node=1)
        self.wait(lambda: described.value and described.value["variables"], "a description")
        place = {one["name"]: one["address"] for one in described.value["variables"]}["timer.period"]
        watched = page.watch("variables", node=1, ranges=[[place, 2]])
        self.wait(lambda: watched.frames, "a value")
        self.start()
        words = page.do("history.at", t=0, ranges=[[1, place, 2]])["values"][0]["words"]
        self.assertEqual(words, [0, 0])

    def test_who_leaves_the_robot_ends_the_run(self):
        page = self.open_robot()
        self.start()
        page.do("target.leave")
        self.assertEqual(self.inputs(self.wait_whole())[-1], "end")
        self.wait(lambda: self.robot.value["kind"] == "none", "no robot")
        page.do("target.choose", target=f"tcp:127.0.0.1:{self.port}")
        self.wait_node(described=True)
        self.start()
        self.assertEqual(self.files(), ["run-1.mcap", "run-2.mcap"])

    def test_a_plan_that_is_started_ends_the_run_of_scripts(self):
        page = self.open_robot()
        self.start()
        self.say(1)
        page.do("plan.start", doc="rounds.plan.json")
        self.wait(lambda: self.plan.value["state"] == "running", "the plan")
        self.assertEqual(self.inputs(self.wait_whole())[-1], "end")
        page.do("stop")
        (about,) = self.wait_whole(2).json("/vagus/run")
        self.assertEqual(about["plan"], "rounds.plan.json")

    def test_what_others_sent_is_in_it_and_a_lost_bus_leaves_it_whole(self):
        self.open_robot()
        self.start()
        self.say(1)
        with Bus(self.port) as other:  # hears all, too
            other.send(7, 0, 5)
            self.wait(lambda: [event for event in self.events("told") if event["args"] == [5, 6]], "the answer to another")
        self.robot_program.stop()
        self.wait(lambda: self.robot.value["state"] == "lost", "a lost bus")
        self.page.do("stop")
        recording = self.wait_whole()
        self.assertEqual([(one["node"], one["args"]) for one in recording.json("/bus/events") if one["name"] == "go"], [(0, [1]), (7, [5])])

    def test_what_a_killed_server_recorded_is_there(self):
        self.open_robot()
        self.start()
        self.say(1)
        wait_until("an event on the disk", lambda: len(Recording(self.file()).json("/bus/events")) == 2)
        self.studio.kill()
        self.assertFalse(Recording(self.file()).complete)
        whole = self.studio.folder / "whole.mcap"
        run_vagus("replay", self.file(), "--repair", whole)
        self.assertEqual(json.loads(run_vagus("why", whole, "event", "told", "--json"))[0]["value"], "1 2")

    def test_a_folder_that_cannot_be_written_is_said_and_the_scripts_run(self):
        page = self.open_robot()
        projects.write(self.folder, ".vagus/recordings", "in the way")
        self.start()
        self.wait_line("warning", "this run is not recorded")
        self.say(1)
        page.do("stop")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:] or ["BusScripts"])], verbosity=2, warnings="ignore")
