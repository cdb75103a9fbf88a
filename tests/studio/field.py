"""`vagus serve`: a project that runs on a robot from its boot on, without anybody watching."""
import os
import pathlib
import re
import signal
import socket
import struct
import sys
import tempfile
import unittest

import projects
from cases import Case
from harness import GET_EXECUTION_STATE, GIVE_UP_AFTER, STATE, Bus, free_port, listening, vagus
from page import Studio, http

SCRIPT = "var n = 0\n\nonevent go\n\tn += 1\n"
STEP_BY_STEP = 2  # of the flags of a node's state: it was stopped (docs/spec/aseba-wire-and-vm.md, 3.2)
METRIC = re.compile(r'([a-z_:][a-z0-9_:]*)(?:\{([a-z_]+)="([^"\\\n]*)"\})? (\S+)\Z')


def read_metrics(text):
    """What stands in a page of metrics, by the text form of Prometheus (0.0.4), read strictly: each family once, HELP, then TYPE, then
    its samples; every sample a number."""
    assert text.endswith("\n"), text[-50:]
    values, types, family, helped = {}, {}, None, None
    for line in text[:-1].split("\n"):
        if line.startswith("# HELP "):
            _, _, helped, sentence = line.split(" ", 3)
            assert sentence and helped not in types, line
        elif line.startswith("# TYPE "):
            _, _, family, kind = line.split(" ")
            assert family == helped and kind in ("counter", "gauge"), line
            assert kind != "counter" or family.endswith("_total"), line
            types[family] = kind
        else:
            found = METRIC.match(line)
            assert found and found.group(1) == family, line
            name = family if found.group(2) is None else (family, found.group(3))
            assert name not in values, line
            values[name] = float(found.group(4))
    assert all(any(name == one or name[0] == one for name in values) for one in types), text
    return values, types


class Served(Studio):
    """`vagus serve` of a folder, in the place of `vagus studio`."""

    def __init__(self, project, *arguments, env=None):
        self.project, self.env = project, env or {}
        super().__init__(*arguments)

    def start(self, *arguments):
        self.program = vagus("serve", self.project, *(arguments or self.arguments), "--port", 0, "--data", self.folder / "data", "--config",
                             self.folder / "config", "--pages", self.folder / "pages", cwd=self.folder, env=self.env)
        self.port = int(self.program.wait_line(r"^serve https?://127\.0\.0\.1:(\d+)/$").group(1))
        self.token = (self.folder / "data" / "token").read_text(encoding="ascii").strip()

    def metrics(self):
        status, headers, body = http(self.port, "/metrics", headers={"Authorization": f"Bearer {self.token}"})
        assert (status, headers["content-type"]) == (200, "text/plain; version=0.0.4; charset=utf-8"), (status, headers, body)
        return read_metrics(body)[0]


class Manager:
    """The socket of a service manager."""

    def __init__(self, folder):
        self.path = str(pathlib.Path(folder) / "notify")
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.socket.bind(self.path)
        self.socket.settimeout(60)
        self.heard = []

    def wait(self, line):
        while line not in self.heard:
            self.heard += self.socket.recv(4096).decode().split("\n")

    def close(self):
        self.socket.close()


class Robots(Case):
    def serve(self, *arguments, make=projects.thymio, env=None, **options):
        """A robot that serves itself, and one page that looks."""
        self.own = self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-field-"))
        self.folder = pathlib.Path(self.own) / "robot"
        make(self.folder, **options)
        self.studio = self.enterContext(Served(self.folder, *arguments, env=env))
        self.page = self.enterContext(self.studio.page())
        self.watch_all(self.page)
        return self.page

    def until(self, condition, what):
        """For what no message tells."""
        for _ in range(int(GIVE_UP_AFTER / 0.05)):
            if condition():
                return
            with self.page.news:
                self.page.news.wait(0.05)
        self.fail(f"{what} never came")

    def wait_metrics(self, **expected):
        """Until the page of metrics says so. It is made anew once a second."""
        values = {}

        def as_expected():
            values.update(self.studio.metrics())
            return all(values.get(f"vagus_{name}") == value for name, value in expected.items())

        self.until(as_expected, f"metrics {expected}")
        return values


class Field(Robots):
    def test_a_world_runs_from_the_boot_on(self):
        self.serve("--start")
        self.wait_clock("running")
        self.wait_node(state="running", program="current")
        self.assertEqual(self.people.value["project"]["name"], "Thymio")
        self.wait_passed()

    def test_a_plan_runs_from_the_boot_on(self):
        def make(folder):
            projects.write(folder, "rounds.plan.json", projects.PLAN)
            projects.thymio(folder, plan="rounds.plan.json")
        self.serve("--start", make=make)
        self.wait(lambda: self.plan.value["state"] == "running" and self.plan.value["levels"], "the plan")
        values = self.wait_metrics(plan_running=1, runs_total=1, ready=1)
        self.assertEqual(values["vagus_deployed_version"], 0)

    def test_without_start_it_stands_until_a_page_says_run(self):
        page = self.serve()
        self.wait_node(described=True)
        self.assertEqual(self.clock.value["state"], "none")
        page.do("run.start")
        self.wait_clock("running")
        page.do("stop")

    def test_a_run_that_dies_begins_anew(self):
        self.serve("--start")
        self.wait_clock("running")
        self.wait_metrics(runs_total=1)
        for process in self.studio.children():
            os.kill(process, signal.SIGKILL)
        self.wait_metrics(run_deaths_total=1, runs_total=2)
        self.wait_clock("running")

    def test_it_serves_one_project_and_one_target(self):
        page = self.serve()
        for command, fields in (("project.open", {"path": "/etc"}), ("project.example", {"id": "follow-wall"}), ("project.close", {}),
                                ("project.new", {"name": "a", "robot": "thymio2", "plan": False}), ("folder.list", {"path": "/"}),
                                ("project.forget", {"path": "/etc"}), ("target.choose", {"target": "sim"}), ("target.leave", {})):
            self.assertIn("serves one project", self.refused("not_allowed", command, **fields))
        text = page.do("doc.open", doc=projects.DOC)
        self.assertIn("onevent go", text["text"])

    def test_it_waits_for_nodes_that_are_not_there_and_stops_them_at_its_end(self):
        port = free_port()
        manager = Manager(self.enterContext(tempfile.TemporaryDirectory()))
        self.addCleanup(manager.close)
        self.serve("--start", "--target", f"tcp:127.0.0.1:{port}", make=lambda folder: projects.bus(folder, "sim", script=SCRIPT),
                   env={"NOTIFY_SOCKET": manager.path, "WATCHDOG_USEC": "200000"})
        self.studio.program.wait_line("note: waiting for nodes that are not there yet: rover")
        manager.wait("WATCHDOG=1")
        self.assertNotIn("READY=1", manager.heard)
        self.assertEqual(self.wait_metrics(missing_nodes=1)["vagus_ready"], 0)
        node = self.enterContext(vagus("node", "--id", 1, "--name", "rover", "--listen", f"tcp:127.0.0.1:{port}"))
        listening(node)
        self.wait_node(state="running", program="current")
        manager.wait("READY=1")
        self.wait_metrics(missing_nodes=0, ready=1)
        self.studio.program.signal(signal.SIGTERM)
        self.assertEqual(self.studio.program.wait_end(), 0)
        manager.wait("STOPPING=1")
        with Bus(port) as bus:
            _, flags = struct.unpack("<HH", bus.ask(lambda: bus.send(0, GET_EXECUTION_STATE, 1), STATE, 1))
            self.assertEqual(flags & STEP_BY_STEP, STEP_BY_STEP)

    def test_stop_is_not_undone_by_the_robot_itself(self):
        page = self.serve("--start")
        self.wait_clock("running")
        page.do("stop")
        self.wait_clock("none")
        before = self.wait_metrics(runs_total=1)
        self.assertEqual(before["vagus_plan_running"], 0)

    def test_metrics_are_for_who_has_a_token(self):
        self.serve("--start")
        for headers in ({}, {"Authorization": "Bearer " + "0" * 32}, {"Authorization": self.studio.token}):
            status, answered, _ = http(self.studio.port, "/metrics", headers=headers)
            self.assertEqual((status, answered["www-authenticate"]), (401, "Bearer"))
        self.studio.program.wait_line("warning: refused: /metrics without the right token")
        self.wait_node(state="running")
        self.until(lambda: self.studio.metrics()["vagus_events_total"] > 3, "events")
        values = self.studio.metrics()
        self.assertEqual(values["vagus_clients"], 1)
        self.assertEqual(values[("vagus_nodes", "running")], 1)
        self.assertLess(values["vagus_lateness_seconds"], 60)
        self.assertEqual(http(self.studio.port, "/metrics", method="POST")[0], 405)
        self.assertEqual(http(self.studio.port, "/healthz")[0::2], (200, "ok\n"))

    def test_a_studio_shows_no_metrics(self):
        self.open()
        self.assertEqual(http(self.studio.port, "/metrics")[0], 404)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:] or ["Field"])], verbosity=2, warnings="ignore")
