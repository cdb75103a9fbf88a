"""The studio on buses of Debian's Aseba programs: a node behind asebaswitch that is unplugged and comes back, a Thymio of
asebaplayground. (asebadummynode dies when it is asked for its description; `vagus node` stands in for it.)"""
import sys
import tempfile
import unittest

import projects
from cases import Case
from harness import Bus, Display, Program, free_port, listening, playground, vagus
from projects import DOC

SCRIPT = """var n = 0
var last = 0

onevent go
	n += 1
	last = n * 2
	emit told [n, last]
"""
LAST_LINE, EMIT_LINE = 6, 7


class Peers(Case):
    def foreign_switch(self, *targets):
        """asebaswitch; its port, somebody listens there."""
        port = free_port()
        self.enterContext(Program("asebaswitch", "-p", port, *targets))
        Bus(port).leave()
        return port

    def expect_debugging(self, node, name):
        """Describe, load, break, step, watch: on any node that runs SCRIPT."""
        page = self.page
        self.wait_node(node, described=True, name=name, doc=DOC)
        self.assertEqual(page.do("node.load", node=0), {"loaded": [node], "failed": []})
        self.wait_node(node, program="current", state="running")
        page.do("break.set", doc=DOC, line=LAST_LINE)
        self.wait(lambda: [one for one in self.breakpoints.value["breakpoints"] if one["set"]], "a breakpoint that the node knows")
        page.do("event.send", name="go", args=[0])
        self.wait_node(node, state="paused", why="breakpoint", at={"line": LAST_LINE, "column": 1})
        self.wait_values(node, n=1, last=0)
        page.do("node.step", node=node)
        self.wait_node(node, state="paused", why="step", at={"line": EMIT_LINE, "column": 1})
        self.wait_values(node, last=2)
        page.do("break.clear")
        page.do("node.run", node=node)
        self.assertEqual(self.wait(lambda: self.events("told"), "the event of the script")[0]["args"], [1, 2])

    def test_a_node_behind_asebaswitch_is_unplugged_and_plugged_in_again(self):
        port = free_port()
        words = ("node", "--id", 1, "--name", "rover", "--listen", f"tcp:127.0.0.1:{port}")
        node = self.enterContext(vagus(*words))
        listening(node)
        ours = self.enterContext(vagus("switch", "--listen", "tcp:127.0.0.1:0", f"tcp:127.0.0.1:{port}"))
        foreign = self.foreign_switch(f"tcp:127.0.0.1;{listening(ours)}")
        page = self.open(lambda folder: projects.bus(folder, f"tcp:127.0.0.1:{foreign}", script=SCRIPT))
        self.expect_debugging(1, "rover")
        (failed,) = page.do("node.save", node=1)["failed"]
        self.assertIn("without --flash", failed["why"])
        page.do("break.set", doc=DOC, line=EMIT_LINE)
        node.kill()
        self.wait(lambda: self.node().get("state", "gone") == "gone", "the loss of the node")
        listening(self.enterContext(vagus(*words)))
        self.wait_line("note", "came back without its script")
        self.wait_node(program="current")
        self.wait(lambda: self.node()["state"] in ("paused", "stopped"), "a node that stands")
        page.do("node.run", node=1)
        page.do("event.send", name="go", args=[0])
        self.wait_node(state="paused", why="breakpoint", at={"line": EMIT_LINE, "column": 1})

    def test_a_node_that_keeps_its_program_goes_on_with_it(self):
        port = free_port()
        flash = self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-flash-")) + "/rover.abo"
        words = ("node", "--id", 1, "--name", "rover", "--flash", flash, "--listen", f"tcp:127.0.0.1:{port}")
        node = self.enterContext(vagus(*words))
        listening(node)
        page = self.open(lambda folder: projects.bus(folder, f"tcp:127.0.0.1:{port}", script=SCRIPT))
        self.expect_debugging(1, "rover")
        saved = page.do("node.save", node=1)
        self.assertEqual((saved["failed"], [note["node"] for note in saved["notes"]]), ([], [1]))
        page.do("break.set", doc=DOC, line=EMIT_LINE)
        node.kill()
        self.wait(lambda: self.robot.value["state"] != "connected" and not self.node(), "the loss of the node")
        listening(self.enterContext(vagus(*words)))
        self.wait_node(state="running", program="current")
        self.wait(lambda: [one for one in self.breakpoints.value["breakpoints"] if one["set"]], "the breakpoint")
        page.do("event.send", name="go", args=[0])
        self.wait_node(state="paused", why="breakpoint", at={"line": EMIT_LINE, "column": 1})
        self.assertFalse([line for line in self.console.items if "came back" in line["text"]])

    def test_a_thymio_of_asebaplayground(self):
        display = self.enterContext(Display())
        port = free_port()
        arena = self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-arena-"))
        self.enterContext(playground(display, arena, [port], [1]))
        Bus(port).leave()
        page = self.open(lambda folder: projects.bus(folder, f"tcp:127.0.0.1:{port}", name="thymio-II", script=SCRIPT))
        self.expect_debugging(1, "thymio-II")
        page.do("variable.set", node=1, name="motor.left.target", first=0, values=[100])
        self.wait_values(motor_left_target=100)
        self.assertEqual(page.do("stop")["stood"], [1])
        self.wait_node(state="stopped")
        self.wait_values(motor_left_target=0, motor_right_target=0)
        page.do("run.start")
        self.wait_node(state="running")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:] or ["Peers"])], verbosity=2, warnings="ignore")
