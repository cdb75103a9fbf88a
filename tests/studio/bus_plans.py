"""A plan on a bus: the robot is another program, the plan a process of its own that joins the bus by the studio's door."""
import json
import os
import signal
import sys
import tempfile
import unittest

import projects
from cases import Case
from harness import Bus, listening, run_vagus, simulated, wait_until
from mcap import Recording
from page import Refused

# Sends the robot off, then counts its rounds until the limit.
PLAN = {
    **projects.PLAN, "name": "Drive", "start": {"actor": "go"},
    "actors": {"go": {"template": "Send", "in": {"event": "'go'", "args": "'150'"}, "states": {"Sent": "say"}}, **projects.PLAN["actors"]},
}


class BusPlans(Case):
    def open_robot(self, plan=PLAN, **more):
        """A Thymio behind a port, and the project with a plan for it."""
        arena = self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-arena-"))
        self.robot_program = self.enterContext(simulated(arena, {"name": "alice", "node": 1}))
        self.port = listening(self.robot_program)

        def make(folder):
            projects.write(folder, "drive.plan.json", plan)
            projects.bus(folder, f"tcp:127.0.0.1:{self.port}", name="thymio-II")
            project = json.loads((folder / "vagus.json").read_text(encoding="utf-8"))
            projects.write(folder, "vagus.json", {**project, "plan": "drive.plan.json", **more})

        page = self.open(make)
        self.wait_node(described=True)
        return page

    def rounds(self):
        levels = self.plan.value["levels"]
        return next((one["value"] for one in levels[0]["variables"] if one["name"] == "rounds"), None) if levels else None

    def wait_plan(self, state):
        self.wait(lambda: self.plan.value["state"] == state, f"plan {state}")

    def wait_rounds(self, more=1):
        before = self.rounds() or 0
        self.wait(lambda: (self.rounds() or 0) >= before + more, "more rounds")

    def start(self):
        self.page.do("run.start")
        self.wait(self.rounds, "a round")

    def run_host(self):
        (process,) = self.studio.children()
        return process

    def test_a_plan_drives_a_robot_on_a_bus_to_its_end(self):
        page = self.open_robot()
        page.do("run.start", set={"limit": 3})
        self.wait_plan("ended")
        self.assertEqual((self.plan.value["result"], self.plan.value["doc"]), ("OK", "drive.plan.json"))
        self.assertEqual([line["text"] for line in self.plan.value["story"]].count("round"), 3)
        # What the plan had begun does not go on; the scripts do, and the robot still is what it was: a robot on a bus.
        self.wait_values(motor_left_target=0, motor_right_target=0)
        self.assertEqual((self.robot.value["kind"], self.robot.value["state"]), ("bus", "connected"))
        self.wait_node(state="running", program="current")
        self.wait(lambda: [event for event in self.events("go") if event["node"] == 0 and event["args"] == [150]], "what the plan said")
        self.wait_clock("none")
        # Again, from the beginning.
        page.do("run.start", set={"limit": 2})
        self.wait(lambda: self.plan.value["state"] == "ended" and [line["text"] for line in self.plan.value["story"]].count("round") == 2,
                  "the second run")

    def test_pause_step_set_continue(self):
        page = self.open_robot()
        self.start()
        page.do("plan.pause")
        self.wait_plan("paused")
        self.wait_node(state="running")  # only the plan is held
        held = self.settled()
        page.do("plan.set", level=0, name="rounds", value=1000)
        self.wait(lambda: self.rounds() == 1000, "the variable")
        self.assertEqual(self.plan.value["state"], "paused")
        self.assertEqual(self.settled(), held)
        self.assertIn("nothing", self.refused("bad_input", "plan.set", level=0, name="nothing", value=1))
        self.refused("bad_input", "plan.set", level=0, name="rounds", value="many")
        before = self.plan.value["levels"][0]["activation"]
        page.do("plan.step")
        self.wait(lambda: self.plan.value["levels"][0]["activation"] > before and self.plan.value["state"] == "paused", "the next actor")
        page.do("plan.step")
        page.do("plan.continue")  # in the middle of a step
        self.wait(lambda: self.rounds() > 1001, "more rounds")
        page.do("plan.set", level=0, name="rounds", value=5000)  # while it runs
        self.wait(lambda: self.rounds() > 5001, "rounds from there")
        self.assertEqual(self.plan.value["state"], "running")
        page.do("run.pause")
        self.wait_plan("paused")
        self.wait_node(state="paused")
        page.do("run.start")
        self.wait_plan("running")
        self.wait_node(state="running")
        self.wait_rounds(2)
        page.do("plan.pause")
        self.wait_plan("paused")
        page.do("plan.stop")  # also one that is held
        self.wait_plan("ended")
        self.assertEqual(self.plan.value["result"], "Interrupted")
        self.wait_node(state="running")
        self.refused("unavailable", "plan.set", level=0, name="rounds", value=1)

    def test_a_step_of_one_that_does_not_run_stands_at_the_first_actor(self):
        page = self.open_robot()
        page.do("plan.step")
        self.wait(lambda: self.plan.value["levels"] and self.plan.value["levels"][0]["actor"] == "go", "the first actor")
        self.wait_plan("paused")
        self.assertFalse(self.events("go"))
        page.do("plan.step")
        self.wait(lambda: self.plan.value["levels"] and self.plan.value["levels"][0]["actor"] == "say", "the second actor")
        self.wait_plan("paused")
        self.wait(lambda: [event["args"] for event in self.events("go")] == [[150]], "the event of the first actor")

    def test_stop_ends_the_plan_and_makes_nodes_and_wheels_stand(self):
        page = self.open_robot()
        for held in (False, True):
            self.start()
            self.wait_values(motor_left_target=150, motor_right_target=150)
            if held:
                page.do("plan.pause")
                self.wait_plan("paused")
            self.assertEqual(page.do("stop")["stood"], [1])
            self.wait_plan("ended")
            self.assertEqual(self.plan.value["result"], "Interrupted")
            self.wait_node(state="stopped")
            self.wait_values(motor_left_target=0, motor_right_target=0)
            self.wait_clock("none")

    def test_stop_while_the_plan_begins(self):
        page = self.open_robot()
        for _ in range(20):
            begun = page.ask("run.start")
            self.assertEqual(page.do("stop")["stood"], [1])
            with self.assertRaises(Refused) as caught:
                page.answer(begun)
            self.assertIn("stopped", caught.exception.what)
            self.wait_node(state="stopped")
        self.wait(lambda: self.plan.value["state"] in ("none", "ended"), "no plan")
        self.assertFalse(self.events("go"))

    def test_a_run_host_that_is_killed_leaves_a_robot_that_stands(self):
        page = self.open_robot()
        for _ in range(2):
            self.start()
            self.wait_values(motor_left_target=150, motor_right_target=150)
            os.kill(self.run_host(), signal.SIGKILL)
            self.wait_clock("dead")
            self.assertRegex(self.clock.value["why"], r"ended by signal 9 \(Killed\) after \d+\.\d s; the active actor was \w+\.")
            self.wait_plan("ended")
            self.assertEqual(self.plan.value["result"], "Error")
            self.wait_line("error", "the nodes were stopped")
            self.wait_node(state="stopped")
            self.wait_values(motor_left_target=0, motor_right_target=0)
            self.assertEqual(self.robot.value["state"], "connected")
        self.start()
        self.wait_node(state="running")

    def test_a_plan_with_a_mistake_says_where_and_starts_nothing(self):
        page = self.open_robot({**PLAN, "actors": {**PLAN["actors"], "wait": {"template": "Weit", "states": {"Done": "count"}}}})
        self.assertIn("Weit", self.refused("failed", "run.start"))
        self.wait_clock("none")
        self.assertFalse(self.events("go"))

    def test_a_robot_that_dies_in_the_middle_is_told_and_found_again(self):
        page = self.open_robot()
        self.start()
        self.robot_program.kill()
        self.wait(lambda: self.robot.value["state"] == "lost", "the loss of the robot")
        # The plan needs none of its nodes by name, and goes on; Stop ends it at once.
        self.wait_rounds(2)
        self.assertEqual(page.do("stop")["stood"], [])
        self.wait_plan("ended")
        self.refused("unavailable", "run.start")
        arena = self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-arena-"))
        self.robot_program = self.enterContext(simulated(arena, {"name": "alice", "node": 1}, listen=f"tcp:127.0.0.1:{self.port}"))
        listening(self.robot_program)
        self.wait_node(described=True, program="current")
        self.start()
        self.wait_values(motor_left_target=150, motor_right_target=150)

    def test_the_target_is_left_while_the_plan_runs(self):
        page = self.open_robot()
        self.start()
        page.do("target.leave")
        self.wait(lambda: not self.studio.children(), "the end of the process of the run")
        self.wait_plan("none")
        with Bus(self.port) as bus:  # the robot is there for others
            bus.leave()
        page.do("target.choose", target=f"tcp:127.0.0.1:{self.port}")
        self.wait_node(described=True)
        self.start()

    # ---- its recording ----

    def recording(self, number=1):
        return self.folder / f".vagus/recordings/run-{number}.mcap"

    def wait_whole(self, file):
        wait_until(f"{file.name} with its end", lambda: Recording(file).complete)

    def why(self, *question, file):
        return json.loads(run_vagus("why", file, *question, "--json"))

    def test_a_run_is_a_recording_that_can_be_replayed_and_asked(self):
        page = self.open_robot()
        self.start()
        page.do("plan.set", level=0, name="rounds", value=1000)
        page.do("event.send", name="go", args=[7])
        self.wait(lambda: self.rounds() > 1001, "rounds from there")
        # Also while it goes on.
        chain = page.do("why.ask", about="actor", name="wait")["chain"]
        self.assertEqual([link["doc"] for link in chain if "doc" in link][:1], ["drive.plan.json"], chain)
        page.do("stop")
        self.wait_plan("ended")
        file = self.recording()
        self.wait_whole(file)
        recording = Recording(file)
        (about,) = recording.json("/vagus/run")
        self.assertEqual((about["kind"], about["verb"], about["bus"]), ("bus", "studio", f"tcp:127.0.0.1:{self.port}"))
        self.assertLessEqual({"drive.plan.json", "robot.aesl", "nodes/thymio-II.json"}, set(recording.files))
        asked = [line["do"] for line in recording.json("/vagus/input") if line["do"] not in ("hear", "node", "tokens")]
        self.assertEqual(asked[-5:], ["pause", "set-variable", "continue", "end-plan", "end"])
        said = [(one["args"], one.get("by", "")) for one in recording.json("/bus/events") if (one["node"], one["name"]) == (0, "go")]
        self.assertEqual(said, [([150], "go"), ([7], "")])
        self.assertRegex(run_vagus("replay", file), r"messages compared: no difference$")
        self.assertIn("somebody ended the run", self.why("end", file=file)[-1]["what"])
        (at,) = [line["t"] for line in recording.json("/vagus/input") if line["do"] == "set-variable"]
        self.assertEqual(self.why("variable", "rounds", "--at", at, file=file)[0]["what"], "a person gave the variable rounds its value")

    def test_runs_before_this_one_are_listed_and_looked_at(self):
        page = self.open_robot()
        for limit in (2, 3):
            page.do("run.start", set={"limit": limit})
            self.wait(lambda: self.plan.value["state"] == "ended" and self.rounds() == limit, "its end")
        (kept,) = page.do("recording.list")["recordings"]
        self.assertEqual((kept["path"], kept["number"]), (".vagus/recordings/run-1.mcap", 1))
        opened = page.do("history.open", trace=kept["path"])
        self.assertEqual((opened["from"], opened["refused"], opened["plan"]), (0, 0, True))
        end = page.do("history.at", t=opened["to"], events=100, trace=kept["path"])
        self.assertEqual((end["plan"]["result"], end["plan"]["doc"]), ("OK", "drive.plan.json"))
        chain = page.do("why.ask", about="end", trace=kept["path"])["chain"]
        self.assertEqual(chain[0]["doc"], "drive.plan.json")
        self.wait_whole(self.recording(2))
        for number in (1, 2):
            self.assertRegex(run_vagus("replay", self.recording(number)), r"messages compared: no difference$")
        # Once the robot is left, none of them is that of a run that is there.
        page.do("target.leave")
        self.assertEqual([one["number"] for one in page.do("recording.list")["recordings"]], [2, 1])

    def test_before_its_plan_has_run_there_is_nothing_to_ask(self):
        self.open_robot()
        self.assertIn("none has begun yet", self.refused("unavailable", "why.ask", about="end"))

    def test_a_saved_plan_takes_over_in_the_recording_too(self):
        page = self.open_robot()
        self.start()
        changed = json.loads(json.dumps(PLAN))
        changed["actors"]["count"]["in"]["value"] = "rounds + 1000"
        now = page.do("doc.open", doc="drive.plan.json")["text"]
        page.edit("drive.plan.json", (0, len(now.encode("utf-16-le")) // 2, json.dumps(changed)))
        page.do("doc.save", doc="drive.plan.json")
        self.wait(lambda: self.rounds() > 2000, "rounds of the new version")
        page.do("stop")
        self.wait_plan("ended")
        self.wait_whole(self.recording())
        self.assertIn("plan-files", [line["do"] for line in Recording(self.recording()).json("/vagus/input")])
        self.assertRegex(run_vagus("replay", self.recording()), r"messages compared: no difference$")

    def test_what_a_killed_run_or_server_recorded_is_there(self):
        page = self.open_robot()
        self.start()
        file = self.recording()
        wait_until("a line on the disk", lambda: Recording(file).json("/plan/trace"))
        os.kill(self.run_host(), signal.SIGKILL)
        self.wait_clock("dead")
        told = run_vagus("replay", file)
        self.assertIn("has no end", told)
        self.assertRegex(told, r"no difference$")
        page.do("run.start")
        self.wait_plan("running")
        self.wait_rounds(2)
        wait_until("a line on the disk", lambda: Recording(self.recording(2)).json("/plan/trace"))
        self.studio.kill()
        self.assertRegex(run_vagus("replay", self.recording(2)), r"no difference$")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:] or ["BusPlans"])], verbosity=2, warnings="ignore")
