"""What dies, hangs or is killed: the run, the server, the other end of the bus. Nobody loses anything, everybody is told."""
import os
import pathlib
import random
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
import unittest

import projects
from cases import Case, poses
from harness import GIVE_UP_AFTER, VAGUS, Bus, Missing, free_port, list_nodes, listening, run_vagus, simulated, vagus, wait_until
from mcap import Recording
from page import Closed, Studio

KILLS = int(os.environ.get("VAGUS_KILLS") or 10)  # of each kind
HANGING_TOOLBOX = os.environ.get("VAGUS_HANGING_TOOLBOX", "build/release/tests/studio/hanging.so")
STOP = 0xA006
LIST_NODES = 0xA011


def plan_of(template):
    return {"format": "vagus-plan/1", "name": "Mistake", "toolboxes": ["hanging"],
            "start": {"actor": "first"},
            "actors": {"first": {"template": "Wait", "in": {"seconds": 0.2}, "states": {"Done": "mistake"}},
                       "mistake": {"template": template, "states": {"Done": "@terminate"}}}}


def is_gone(process):
    """Ended; a zombie counts as ended."""
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text(encoding="ascii").rpartition(")")[2].split()[0] == "Z"
    except FileNotFoundError:
        return True


class Death(Case):
    def open_mistake(self, template):
        def make(folder):
            projects.write(folder, "mistake.plan.json", plan_of(template))
            projects.thymio(folder, plan="mistake.plan.json", toolboxes=["hanging.so"])
            shutil.copy(HANGING_TOOLBOX, folder / "hanging.so")
        return self.open(make)

    # the run -------------------------------------------------------------------------------------

    def test_a_run_host_that_is_told_nonsense_says_so_and_ends(self):
        server, host = socket.socketpair()
        with server, host:
            child = subprocess.Popen(["sh", "-c", f'exec "$0" run-host 3<&{host.fileno()}', VAGUS], pass_fds=[host.fileno()],
                                     stderr=subprocess.PIPE, text=True)
            host.close()
            server.sendall(struct.pack("<IB", 3, 2) + b"odd")
            said = child.communicate(timeout=GIVE_UP_AFTER)[1]
        self.assertEqual(child.returncode, 2)
        self.assertEqual(said, "vagus: the studio sent pace.paused: expected 4 bytes more, found its end; this run is ended\n")

    def test_a_template_that_never_comes_back(self):
        page = self.open_mistake("HangForever")
        page.do("run.start")
        self.wait_clock("hanging")
        self.wait_line("warning", "does not answer")
        # Everything else goes on.
        self.assertIn("var n", page.do("doc.open", doc=projects.DOC)["text"])
        self.assertEqual(page.do("stop")["stood"], [])
        page.do("run.end")
        self.wait_clock("dead")
        self.assertRegex(self.clock.value["why"], r"signal 9 \(Killed\) after \d+\.\d s; the active actor was mistake\.")
        self.wait(lambda: self.plan.value["state"] == "ended", "the end of the plan")
        self.assertEqual(self.plan.value["result"], "Error")
        projects.write(self.folder, "mistake.plan.json", projects.PLAN)
        wait_until("the plan without the mistake never came",
                   lambda: "Rounds" in page.do("doc.open", doc="mistake.plan.json")["text"])
        page.do("run.start")
        self.wait(lambda: self.clock.value["state"] == "running" and self.plan.value["levels"], "a run that works")

    def test_a_template_that_crashes(self):
        page = self.open_mistake("Crash")
        page.do("run.start")
        self.wait_clock("dead")
        self.assertRegex(self.clock.value["why"], r"signal 11 \(Segmentation fault\).*active actor was mistake.*start over")
        self.wait(lambda: self.plan.value["state"] == "ended", "the end of the plan")
        self.wait(lambda: self.robot.value["state"] == "lost", "the loss of the robot")
        page.do("run.start")
        self.wait_clock("dead")

    def test_a_run_that_is_killed_at_any_moment_starts_again(self):
        seed = int(os.environ.get("VAGUS_SEED") or random.SystemRandom().randrange(1 << 32))
        print(f"seed: VAGUS_SEED={seed}")
        dice = random.Random(seed)
        page = self.open()
        # Its world stands from the start. Were that process killed as Run is asked for, the server may hear of the death first, and
        # Run begins another one.
        (world,) = self.wait(self.studio.children, "the world")
        os.kill(world, signal.SIGKILL)
        self.wait_clock("dead")
        for _ in range(KILLS):
            number = page.ask("run.start")
            if dice.random() < 0.6:
                page.answer(number)
                now = self.clock.value["t"]
                self.wait(lambda: self.clock.value["t"] > now + dice.uniform(0, 0.2) or self.clock.value["t"] < now, "time")
            (run,) = self.wait(self.studio.children, "a run")
            os.kill(run, signal.SIGKILL)
            self.wait(lambda: number in page.answers, "an answer")
            self.wait_clock("dead")
            self.assertIn("ended by signal 9 (Killed)", self.clock.value["why"])
            # A run that was killed before its world stood never had a robot.
            self.wait(lambda: self.robot.value["state"] in ("lost", "none"), "the loss of the robot")
        page.do("run.start")
        self.wait_clock("running")
        self.assertNotIn("why", self.clock.value)
        self.wait_passed()
        self.wait_node(state="running", program="current")
        self.assertEqual(len(self.studio.children()), 1)

    # the server ----------------------------------------------------------------------------------

    def test_a_server_that_is_killed_loses_no_text_and_leaves_no_run(self):
        page = self.open()
        page.do("run.start")
        self.wait_passed()
        (run,) = self.studio.children()
        page.edit(projects.DOC, (0, 0, "# kept \U0001f916\n"))
        page.do("break.set", doc=projects.DOC, line=14)
        journal = self.folder / ".vagus" / "journal"
        self.until(lambda: any("kept" in path.read_text(encoding="utf-8") for path in journal.rglob("*") if path.is_file())
                   if journal.is_dir() else journal.is_file() and "kept" in journal.read_text(encoding="utf-8"), "the journal")
        self.studio.kill()
        self.until(lambda: is_gone(run), "the end of the run")
        page.wait_closed()
        self.assertNotIn("kept", (self.folder / "robot.aesl").read_text(encoding="utf-8"))
        self.studio.start(self.folder)
        with self.studio.page() as again:
            self.watch_all(again)
            again.wait(lambda: self.people.value and self.people.value["recovered"], "a recovered text")
            self.assertEqual(self.people.value["recovered"], ["robot.aesl"])
            self.assertTrue(again.do("doc.open", doc=projects.DOC)["text"].startswith("# kept \U0001f916\nvar n"))
            again.wait(lambda: self.breakpoints.value["breakpoints"], "the breakpoint")
            again.do("doc.save_all")
        self.assertIn("# kept \U0001f916\nvar n", (self.folder / "robot.aesl").read_text(encoding="utf-8"))

    def test_what_was_acknowledged_when_the_server_is_killed_is_there(self):
        seed = int(os.environ.get("VAGUS_SEED") or random.SystemRandom().randrange(1 << 32))
        print(f"seed: VAGUS_SEED={seed}")
        dice = random.Random(seed)
        self.open()
        typed = self.page.do("doc.open", doc=projects.DOC)["text"]
        for _ in range(KILLS):
            self.assertEqual(self.page.do("doc.open", doc=projects.DOC)["text"], typed)
            until = time.monotonic() + dice.uniform(0, 2)
            while time.monotonic() < until:
                self.page.edit(projects.DOC, (0, 0, "#\n" if dice.random() < 0.1 else "#"))
                typed = self.page.do("doc.open", doc=projects.DOC)["text"]
                with self.page.news:  # typed fast, not faster than the server hears
                    self.page.news.wait(0.02)
            self.studio.kill()
            self.page.wait_closed()
            self.studio.start(self.folder)
            self.page = self.enterContext(self.studio.page())
            self.assertEqual(self.page.do("doc.open", doc=projects.DOC)["text"], typed)

    def until(self, condition, what):
        """For what no message tells."""
        self.page.news.acquire()
        try:
            for _ in range(int(GIVE_UP_AFTER / 0.02)):
                if condition():
                    return
                self.page.news.wait(0.02)
        finally:
            self.page.news.release()
        raise Missing(f"{what} never came")

    def recorded(self):
        """A plan runs and is recorded; the file."""
        def make(folder):
            projects.write(folder, "rounds.plan.json", projects.PLAN)
            projects.thymio(folder, plan="rounds.plan.json")
        self.open(make).do("run.start")
        self.wait(lambda: self.clock.value["t"] > 0.5 and self.plan.value["levels"], "a plan that runs")
        (file,) = (self.folder / ".vagus" / "recordings").glob("run-*.mcap")
        return file

    def assert_whole(self, file):
        recording = Recording(file)
        self.assertTrue(recording.complete)
        self.assertEqual(recording.json("/vagus/input")[-1]["do"], "end")
        self.assertEqual(recording.json("/plan/trace")[-1]["kind"], "plan-end")

    def test_a_recording_is_completed_when_the_server_is_asked_to_end(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number.name):
                file = self.recorded()
                self.studio.program.signal(number)
                self.assertEqual(self.studio.program.wait_end(), 0)
                self.assert_whole(file)

    def test_a_recording_is_completed_when_its_project_is_left(self):
        file = self.recorded()
        (run,) = self.studio.children()
        self.page.do("project.open", path=str(projects.thymio(self.studio.folder / "another")))
        self.until(lambda: is_gone(run), "the end of the run")
        self.assert_whole(file)

    def test_a_server_that_is_asked_to_end_stops_the_robot_on_its_bus(self):
        arena = self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-arena-"))
        with simulated(arena, {"name": "alice", "node": 1}) as robot:
            port = listening(robot)
            page = self.open(lambda folder: projects.bus(folder, f"tcp:127.0.0.1:{port}", name="thymio-II"))
            self.wait_node(described=True)
            self.assertEqual(page.do("node.load", node=0), {"loaded": [1], "failed": []})
            page.do("event.send", name="go", args=[200])
            self.wait_values(motor_left_target=200, motor_right_target=200)
            with Bus(port) as bus:
                bus.wait(LIST_NODES, source=0)  # the simulator asks from time to time: now we hear what passes
                self.studio.program.signal(signal.SIGTERM)
                self.assertEqual(bus.wait(STOP, source=0), b"\x01\x00")
                self.assertEqual(self.studio.program.wait_end(), 0)
            told = run_vagus("net", f"tcp:127.0.0.1:{port}", "get", "1", "motor.left.target", "motor.right.target", "--wait", 30)
            self.assertRegex(told, r"(?s)motor\.left\.target.*\b0\b.*motor\.right\.target.*\b0\b")
            self.assertNotEqual(list_nodes(port)[0]["state"], "running")

    # the bus -------------------------------------------------------------------------------------

    def test_the_other_end_dies_and_comes_back(self):
        port = free_port()
        switch = self.enterContext(vagus("switch", "--listen", f"tcp:127.0.0.1:{port}"))
        listening(switch)
        node = self.enterContext(vagus("node", "--id", 1, "--name", "rover", "--connect", f"tcp:127.0.0.1:{port}"))
        page = self.open(lambda folder: projects.bus(folder, f"tcp:127.0.0.1:{port}", script="var n = 0\nonevent go\n\tn += 1\n"))
        self.wait_node(described=True)
        page.do("node.load", node=0)
        switch.kill()
        node.kill()
        self.wait(lambda: self.robot.value["state"] in ("lost", "connecting", "failed"), "the loss of the bus")
        self.assertEqual(page.do("stop")["stood"], [])
        self.assertIn("failed", page.do("node.run", node=1))
        page.do("doc.open", doc=projects.DOC)
        switch = self.enterContext(vagus("switch", "--listen", f"tcp:127.0.0.1:{port}"))
        self.enterContext(vagus("node", "--id", 1, "--name", "rover", "--connect", f"tcp:127.0.0.1:{port}"))
        self.wait(lambda: self.robot.value["state"] == "connected", "the bus again")
        # It comes back without its script, gets it again, and stands until someone lets it run.
        self.wait_line("note", "came back without its script")
        self.wait_node(program="current")
        self.wait(lambda: self.node()["state"] in ("paused", "stopped"), "a node that stands")
        self.assertEqual(page.do("node.run", node=1), {"failed": []})
        self.wait_node(state="running")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:] or ["Death"])], verbosity=2, warnings="ignore")
