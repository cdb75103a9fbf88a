"""A link that is held: a switch between the studio and its robot that answers nothing any more, and does not go away either."""
import json
import os
import signal
import sys
import tempfile
import unittest

import projects
from cases import Case
from harness import listening, run_vagus, simulated, vagus
from page import Studio, http

SCRIPT = "timer.period[0] = 20\nonevent timer0\n  motor.left.target = 150\n  motor.right.target = 150\n"


class Frozen(Case):
    def open_robot(self, plan=None):
        """A Thymio behind a switch, driven by its script; with a plan beside it."""
        arena = self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-arena-"))
        robot = listening(self.enterContext(simulated(arena, {"name": "alice", "node": 1})))
        self.switch = self.enterContext(vagus("switch", "--listen", "tcp:127.0.0.1:0", f"tcp:127.0.0.1:{robot}"))
        port = listening(self.switch)

        def make(folder):
            projects.bus(folder, f"tcp:127.0.0.1:{port}", name="thymio-II", script=SCRIPT)
            if plan:
                projects.write(folder, "rounds.plan.json", plan)
                project = json.loads((folder / "vagus.json").read_text(encoding="utf-8"))
                projects.write(folder, "vagus.json", {**project, "plan": "rounds.plan.json"})

        page = self.open(make)
        self.wait_node(described=True)
        page.do("run.start")
        self.wait_values(motor_left_target=150, motor_right_target=150)
        return page

    def hold(self, on):
        os.kill(self.switch.process.pid, signal.SIGSTOP if on else signal.SIGCONT)

    def test_a_switch_that_is_held_is_a_lost_link_and_stop_says_who_is_silent(self):
        page = self.open_robot()
        self.hold(True)
        self.addCleanup(self.hold, False)
        # At once: what is known is that nobody has answered.
        self.assertEqual(page.do("stop")["nodes"], [{"node": 1, "name": "thymio-II", "state": "silent"}])
        self.wait(lambda: self.robot.value["state"] == "lost", "the loss of the link")
        self.assertIn("no answer on this link for 3 s", self.robot.value["why"])
        answer = page.do("stop")
        self.assertEqual(answer, {"stood": [], "nodes": [{"node": 1, "name": "thymio-II", "state": "silent"}]})
        self.wait_node(stop="silent")
        # It is asked again by itself.
        self.hold(False)
        self.wait(lambda: self.robot.value["state"] == "connected", "the link")
        self.wait_node(stop="stopped")
        self.wait_values(motor_left_target=0, motor_right_target=0)

    def test_so_it_is_while_a_plan_runs_whose_process_speaks_on_our_side(self):
        page = self.open_robot(projects.PLAN)
        self.hold(True)
        self.addCleanup(self.hold, False)
        self.wait(lambda: self.robot.value["state"] == "lost", "the loss of the link")
        self.assertEqual(page.do("stop")["nodes"], [{"node": 1, "name": "thymio-II", "state": "silent"}])
        self.hold(False)
        self.wait(lambda: self.robot.value["state"] == "connected", "the link")
        self.wait_node(stop="stopped")
        self.wait_values(motor_left_target=0, motor_right_target=0)


class Unread(Case):
    """Nobody reads the log: a terminal that is held by Ctrl+S, a pipe that is full."""

    def test_stop_and_the_end_do_not_wait_for_who_reads_the_log(self):
        arena = self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-arena-"))
        robot = listening(self.enterContext(simulated(arena, {"name": "alice", "node": 1})))
        unread, log = os.pipe()
        self.addCleanup(os.close, unread)
        os.set_blocking(log, False)
        for piece in (b"-" * 4096, b"-"):
            try:
                while True:
                    os.write(log, piece)
            except BlockingIOError:
                pass
        os.set_blocking(log, True)  # as it is for a program that a shell starts
        studio = Studio(stderr=log)
        os.close(log)
        page = self.open(lambda folder: projects.bus(folder, f"tcp:127.0.0.1:{robot}", name="thymio-II", script=SCRIPT), studio=studio)
        self.wait_node(described=True)
        page.do("run.start")
        self.wait_values(motor_left_target=150, motor_right_target=150)
        # It is logged, and so is a command that comes too late.
        status, _, _ = http(studio.port, "/stop", "POST", {"Authorization": f"Bearer {studio.token}", "Content-Length": "0"})
        self.assertEqual(status, 202)
        self.wait_values(motor_left_target=0, motor_right_target=0)
        page.do("run.start")
        self.wait_values(motor_left_target=150, motor_right_target=150)
        studio.program.signal(signal.SIGTERM)
        self.assertEqual(studio.program.wait_end(), 0)
        target = f"tcp:127.0.0.1:{robot}"
        self.assertEqual(json.loads(run_vagus("net", target, "get", "thymio-II", "motor.left.target", "--json")), {"motor.left.target": [0]})


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:] or ["test_"])], verbosity=2, warnings="ignore")
