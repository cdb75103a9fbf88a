"""A link that is held: a switch between the studio and its robot that answers nothing any more, and does not go away either."""
import os
import signal
import sys
import tempfile
import unittest

import projects
from cases import Case
from harness import listening, simulated, vagus

SCRIPT = "timer.period[0] = 20\nonevent timer0\n  motor.left.target = 150\n  motor.right.target = 150\n"


class Frozen(Case):
    def open_robot(self):
        """A Thymio behind a switch, driven by its script."""
        arena = self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-arena-"))
        robot = listening(self.enterContext(simulated(arena, {"name": "alice", "node": 1})))
        self.switch = self.enterContext(vagus("switch", "--listen", "tcp:127.0.0.1:0", f"tcp:127.0.0.1:{robot}"))
        port = listening(self.switch)
        page = self.open(lambda folder: projects.bus(folder, f"tcp:127.0.0.1:{port}", name="thymio-II", script=SCRIPT))
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


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:] or ["test_"])], verbosity=2, warnings="ignore")
