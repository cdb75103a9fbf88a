"""The verbs of `vagus net` as a person or a script uses them: what they print, and how they end."""
import contextlib
import json
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import Bus, listening, run_vagus, vagus

PROJECT = """<!DOCTYPE aesl-source>
<network>
<event size="2" name="status"/>
<event size="0" name="count"/>
<event size="0" name="boom"/>
<constant value="3" name="STEP"/>
<node nodeId="1" name="rover">var ticks = 0
var speed[2] = [4, 5]

onevent count
  ticks += STEP
  emit status [ticks, speed[1]]

onevent boom
  ticks = 1 / (ticks - ticks)
</node>
<node nodeId="9" name="ghost">var x
</node>
</network>
"""
TICKS_LINE = 11   # of the file: `ticks += STEP`
EMIT_LINE = 12
BOOM_LINE = 15


class Net(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-net-")))
        self.project = self.folder / "rover.aesl"
        self.project.write_text(PROJECT, encoding="utf-8")
        switch = self.enterContext(vagus("switch", "--listen", "tcp:127.0.0.1:0"))
        self.port = listening(switch)
        self.target = f"tcp:127.0.0.1:{self.port}"
        self.node = self.enterContext(vagus("node", "--id", 1, "--name", "rover", "--connect", self.target))
        self.net("describe", "rover", "--wait", "60")  # until it is there

    def net(self, *words, status=0):
        return run_vagus("net", self.target, *words, status=status)

    def json(self, *words):
        return json.loads(self.net(*words, "--json"))

    def load(self):
        return self.net("load", self.project, "rover")

    def send(self, event):
        self.net("emit", event, "--project", self.project)

    def ticks(self):
        return self.json("get", "rover", "ticks", "--project", self.project)["ticks"][0]

    def test_list_names_state_protocol_and_program(self):
        entry = {"id": 1, "name": "rover", "state": "running", "protocol": 5, "program": "unknown"}
        self.assertEqual(self.json("list"), [entry])
        self.assertEqual(self.net("list"), "1  rover  running  protocol 5  program unknown")
        self.load()
        self.assertEqual(self.json("list")[0]["program"], "present")

    def test_load_tells_memory_and_what_had_no_node(self):
        told = self.net("load", self.project).split("\n")
        self.assertEqual(told[0], f'vagus: {self.project}:17: the script for "ghost" was not loaded: '
                                  "no such node is there")
        self.assertRegex(told[1], r"^1  rover  loaded, running  bytecode \d+ of 512  variables \d+ of 1060"
                                  r"  stack \d+ of 64 words$")

    def test_load_names_the_line_of_the_project_and_loads_nothing(self):
        self.project.write_text(PROJECT.replace("emit status", "emit statsu"), encoding="utf-8")
        told = self.net("load", self.project, "rover", status=1)
        self.assertRegex(told, rf'^{self.project}:{EMIT_LINE}:8: error: .*"statsu".*\[EVENT_NOT_DEFINED_GUESS\]')
        self.assertEqual(self.json("list")[0]["program"], "unknown")
        self.assertIn("cannot be read", self.net("load", self.folder / "none.aesl", status=2))

    def test_get_and_set_take_ranges(self):
        self.load()
        known = ("--project", self.project)
        self.assertEqual(self.json("get", "1", "speed", *known), {"speed": [4, 5]})
        self.net("set", "1", "speed[1]", "-7", *known)
        self.assertEqual(self.net("get", "rover", "speed[1:1]", "ticks", *known),
                         "speed[1:1] = -7\nticks      = 0")
        self.assertIn("has 2 words", self.net("get", "rover", "speed[2]", *known, status=1))
        self.assertIn("takes 1 to 1 values", self.net("set", "rover", "speed[0]", "1", "2", *known, status=1))
        self.assertIn("from -32768 to 65535", self.net("set", "rover", "ticks", "70000", *known, status=2))
        self.assertIn("did you mean ticks?", self.net("get", "rover", "tikcs", *known, status=1))

    def test_unknown_nodes_verbs_and_targets_are_said_with_a_way_out(self):
        self.assertEqual(self.net("run", "rovr", status=1),
                         'vagus: there is no node "rovr"; did you mean rover? The nodes are: 1 rover')
        self.assertEqual(self.net("stop", "7", status=1),
                         "vagus: node 7 did not answer; these did: 1 rover; if it is slow, give it more time "
                         "(--wait SECONDS)")
        self.assertIn("did you mean list?", self.net("lsit", status=2))
        self.assertIn("is not a protocol here", run_vagus("net", "udp:1", "list", status=2))

    def test_emit_checks_names_and_arguments(self):
        self.assertIn("takes 2 arguments, found 1",
                      self.net("emit", "status", "1", "--project", self.project, status=1))
        self.assertIn("did you mean status?", self.net("emit", "stauts", "--project", self.project, status=1))
        with Bus(self.port) as bus:
            self.net("emit", "300", "1", "-2")
            self.assertEqual(bus.wait(300, source=0), b"\x01\x00\xfe\xff")

    def test_events_reach_the_script(self):
        self.load()
        self.send("count")
        self.assertEqual(self.ticks(), 3)

    def test_pause_reset_step_and_run_name_the_line(self):
        self.load()
        self.assertEqual(self.net("pause", "all"), "1  rover  paused  protocol 5  program present")
        self.assertEqual(self.net("list"), "1  rover  paused  protocol 5  program present")
        known = ("--project", self.project)
        self.assertIn(f"paused at {self.project}:7", self.net("reset", "rover", *known))
        self.assertIn(f"paused at {self.project}:8", self.net("step", "rover", *known))
        self.assertIn("running", self.net("run", "rover", *known))
        self.assertIn("is running: pause it", self.net("step", "rover", status=1))

    def test_break_waits_for_its_condition_and_run_goes_on(self):
        self.load()
        place = f"{self.project}:{EMIT_LINE}"
        with vagus("net", self.target, "break", "rover", place, "if", "ticks >= 2 * STEP", "--json") as waiting:
            while waiting.running():
                self.send("count")
            self.assertEqual(waiting.wait_end(), 0)
        hit = json.loads(waiting.lines[-1])
        self.assertEqual((hit["node"], hit["kind"], hit["event"], hit["line"]), (1, "breakpoint", "hit", EMIT_LINE))
        self.assertEqual(self.ticks() % 3, 0)
        self.assertGreaterEqual(self.ticks(), 6)
        self.assertIn(f"paused at {place}", self.net("list", "--project", self.project))
        self.assertIn("running", self.net("run", "rover"))

    def test_break_says_where_there_is_code_and_when_time_is_over(self):
        self.load()
        self.assertIn(f"the next line that has is {TICKS_LINE}",
                      self.net("break", "rover", f"{self.project}:9", status=1))
        self.assertIn("did not reach", self.net("break", "rover", f"{self.project}:{BOOM_LINE}", "--wait", "0.1",
                                                status=1))
        self.assertIn("FILE:LINE", self.net("break", "rover", "nowhere", status=2))
        self.assertIn("expression, column 1", self.net("break", "rover", f"{self.project}:{TICKS_LINE}", "if",
                                                      "tocks > 1", status=1))

    def test_log_tells_events_and_faults_with_names_and_lines(self):
        self.load()
        with vagus("net", self.target, "log", "--json", "--project", self.project) as log:
            log.wait_line('"running"')
            self.send("count")
            event = json.loads(log.wait_line(r'^.*"status".*$').group(0))
            self.assertEqual((event["node"], event["kind"], event["args"]), (1, "event", [3, 5]))
            self.send("boom")
            fault = json.loads(log.wait_line(r'^.*"fault".*$').group(0))
            self.assertEqual((fault["event"], fault["line"]), ("division_by_zero", BOOM_LINE))
            log.wait_line('"stopped"')

    def test_watch_tells_changes_only(self):
        self.load()
        with vagus("net", self.target, "watch", "rover", "ticks", "--project", self.project) as watch:
            watch.wait_line(r"ticks = 0$")
            self.send("count")
            watch.wait_line(r"ticks = 3$")
            self.assertEqual(sum("ticks" in line for line in watch.lines), 2)

    def test_a_node_that_cannot_save_says_so(self):
        self.load()
        self.assertIn("did not save its program", self.net("save", "rover", status=1))


    def test_list_of_an_empty_bus_says_so_and_fails(self):
        with vagus("switch", "--listen", "tcp:127.0.0.1:0") as empty:
            target = f"tcp:127.0.0.1:{listening(empty)}"
            self.assertEqual(run_vagus("net", target, "list", status=1), f"vagus: no node answers on {target}")
            self.assertEqual(run_vagus("net", target, "list", "--json", status=1),
                             f"[]\nvagus: no node answers on {target}")

    def test_two_nodes_with_one_id_are_noticed_by_the_switch_and_by_list(self):
        with vagus("switch", "--listen", "tcp:127.0.0.1:0") as switch:
            target = f"tcp:127.0.0.1:{listening(switch)}"
            with vagus("node", "--id", 7, "--name", "twin", "--connect", target), \
                    vagus("node", "--id", 7, "--name", "twin", "--connect", target):
                while "two nodes have the id 7" not in (told := self.listed(target)):
                    pass  # until both are there
                self.assertIn("7  twin  running", told)
                links = switch.wait_line(r"^vagus: node 7 is heard on two links, (tcp:\S+) and (tcp:\S+): ")
                self.assertNotEqual(links.group(1), links.group(2))

    def listed(self, target):
        with vagus("net", target, "list") as program:
            program.wait_end()
            return "\n".join(program.lines)

    def test_a_project_that_does_not_compile_is_said(self):
        self.project.write_text(PROJECT.replace("emit status", "emit statsu"), encoding="utf-8")
        told = self.net("list", "--project", self.project).split("\n")
        self.assertRegex(told[0], rf"^{self.project}:{EMIT_LINE}:8: error: ")
        self.assertEqual(told[-2:], [f'vagus: {self.project}: the script for "rover" does not compile: '
                                     "its variables and lines are not known",
                                     "1  rover  running  protocol 5  program unknown"])

    def test_a_project_is_for_each_node_of_its_name(self):
        with contextlib.ExitStack() as others:
            for number in range(2, 6):
                others.enter_context(vagus("node", "--id", number, "--name", "rover", "--connect", self.target))
                self.net("describe", str(number), "--wait", "60")
            loaded = self.json("load", self.project, "all")
            self.assertEqual([node["id"] for node in loaded], [1, 2, 3, 4, 5])
            self.assertEqual([node["id"] for node in self.json("load", self.project, "4")], [4])
            self.send("count")
            for number in range(1, 6):
                ticks = self.json("get", str(number), "ticks", "--project", self.project)
                self.assertEqual(ticks, {"ticks": [3]}, number)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"Net.{name}" for name in sys.argv[1:])], verbosity=2, warnings="ignore")
