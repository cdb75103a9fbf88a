"""Plans of served robots that ask their fleet, over a real broker and with a real keeper; both are killed in the middle."""
import json
import os
import pathlib
import signal
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from fleet import AESL, Case, FLEET, SCRIPT  # noqa: E402
import projects  # noqa: E402
from harness import Program, free_port, listening, simulated, vagus  # noqa: E402
from keeper import children, SERVES, words_of  # noqa: E402

TASKS = 12
PART = {"name": FLEET, "send": ["alarm"], "hear": ["alarm"], "broker_lost": "continue"}


def actor(template, states, **rest):
    """One of a plan; `ins`, `out`, `watch` as a plan has them."""
    return {"template": template, "states": states, **{"in" if key == "ins" else key: value for key, value in rest.items()}}


def lost(lease, then):
    return {"template": "LeaseLost", "in": {"lease": lease}, "events": {"LeaseLost": then}}


def plan(robots):
    """Robots meet; the first gives the tasks. Who has one claims the bench, works, finishes, counts in a value that all share,
    tells how many it has done, and takes the next. Each template of the toolbox has a part in it."""
    return {
        "format": "vagus-plan/1", "name": "Work", "toolboxes": ["fleet"],
        "configuration": {
            **{name: {"type": "int", "initial": 0} for name in ("place", "given", "finished", "warned")},
            **{name: {"type": "string", "initial": ""} for name in ("task", "lease", "bench", "version")},
            "total": {"type": "float", "initial": 0}},
        "start": {"actor": "meet"},
        "actors": {
            "meet": actor("WaitForRobots", {"Met": "who", "TimeOver": "meet", "NoKeeper": "meet"},
                          ins={"robots": robots, "meeting": "'start'", "wait": 600}),
            "who": actor("RobotsOnline", {"Done": "first"}, out={"place": "place"}),
            "first": actor("Compare", {"True": "next", "False": "take"}, ins={"left": "place", "op": "'=='", "right": 1}),
            "next": actor("Assign", {"Done": "give"}, ins={"value": "given + 1"}, out={"result": "given"}),
            "give": actor("GiveTask", {"Given": "all", "Refused": "give", "NoKeeper": "give"},
                          ins={"queue": "'pick'", "task": "'task-' & given", "data": "'' & given"}),
            "all": actor("Compare", {"True": "next", "False": "take"}, ins={"left": "given", "op": "'<'", "right": TASKS}),
            "take": {**actor("TakeTask", {"Taken": "claim", "NoTask": "take", "NoKeeper": "take"},
                             ins={"queue": "'pick'", "seconds": 5, "wait": 5}, out={"task": "task", "lease": "lease"}),
                     "supervisors": {"alarm": {"template": "OnFleetEvent", "in": {"event": "'alarm'"},
                                               "events": {"FleetEvent": "warn"}}}},
            "warn": actor("Assign", {"Done": "tellWarned"}, ins={"value": "warned + 1"}, out={"result": "warned"}),
            "tellWarned": actor("Tell", {"Told": "take"}, ins={"name": "'warned'", "values": "'' & warned"}),
            "claim": {**actor("Claim", {"Claimed": "work", "NotFree": "claim", "NoKeeper": "claim"},
                              ins={"name": "'bench'", "seconds": 5, "wait": 60}, out={"lease": "bench"}),
                      "supervisors": {"lostBefore": lost("lease", "take")}},
            "work": {**actor("Wait", {"Done": "finish"}, ins={"seconds": 1}),
                     "supervisors": {"lostTask": lost("lease", "free"), "lostBench": lost("bench", "giveBack")}},
            "giveBack": actor("Release", {"Released": "take", "NoKeeper": "take"}, ins={"lease": "lease"}),
            "finish": actor("FinishTask", {"Finished": "count", "Lost": "free", "NoKeeper": "finish"},
                            ins={"lease": "lease", "result": "'done'"}),
            "count": actor("Assign", {"Done": "read"}, ins={"value": "finished + 1"}, out={"result": "finished"}),
            "read": actor("ReadShared", {"Read": "write", "Nothing": "write"}, ins={"key": "'done'"},
                          out={"number": "total", "version": "version"}),
            "write": actor("WriteShared", {"Written": "tell", "Changed": "read", "NoKeeper": "read"},
                           ins={"key": "'done'", "value": "'' & (total + 1)", "version": "version"}),
            "tell": actor("Tell", {"Told": "free"}, ins={"name": "'finished'", "values": "'' & finished"}),
            "free": actor("Release", {"Released": "take", "NoKeeper": "take"}, ins={"lease": "bench"}),
        }}


class Plans(Case):
    def keep(self):
        keeper = self.enterContext(vagus("fleet", self.target, "keep", *self.login("keeper")))
        keeper.wait_line(SERVES)
        return keeper

    def worker(self, name, robots, project=projects.thymio, **more):
        folder = self.folder / f"{name}-{free_port()}"
        project(folder, script="", plan="Work.plan.json", fleet=PART, **more)
        projects.write(folder, "robot.aesl", AESL.format(script=SCRIPT))
        projects.write(folder, "Work.plan.json", plan(robots))
        projects.write(folder, "pages/index.html", "<!doctype html>\n")
        program = self.enterContext(vagus(
            "serve", folder, "--start", "--port", 0, "--data", folder / "data", "--config", folder / "config", "--pages",
            folder / "pages", "--fleet", self.target, "--robot", name, *self.login(name)))
        program.wait_line(rf'fleet: this robot is "{name}" of the fleet')
        return program

    def records(self, topic):
        """What the keeper tells there, as it is and as it changes."""
        name, password = (self.broker_folder / "looker.login").read_text(encoding="ascii").split()
        return self.enterContext(Program(
            "mosquitto_sub", "-V", "mqttv5", "-h", "localhost", "-p", str(self.port), "--cafile", str(self.broker_folder / "ca.crt"),
            "-u", name, "-P", password, "-q", "1", "-t", f"vagus/1/{FLEET}/{topic}"))

    def wait_finished(self, tasks):
        """Until the keeper says that so many are done. None that was done is given again."""
        records, done = self.records("task/pick/+"), set()
        while len(done) < tasks:
            task = json.loads(records.wait_line(r'^\{ "work": ').string)
            self.assertFalse(task["data"] in done and task["work"] != "done", f"{task} was done: {records.lines}")
            if task["work"] == "done":
                done.add(task["data"])
        return done

    def kill_broker(self, broker):
        child, = [one for one in children(broker.process.pid) if "mosquitto" in words_of(one)[0]]
        os.kill(child, signal.SIGKILL)
        self.assertEqual(broker.wait_end(), 1)

    def test_each_template_while_the_keeper_and_the_broker_are_killed(self):
        names = ("r1", "r2", "r3")
        self.init(*names)
        broker = self.serve_broker("--fleet", "other")
        keeper = self.keep()
        watch = self.watch()
        for name in names:
            self.worker(name, len(names))
        self.wait_finished(3)
        keeper.kill()
        self.keep()
        self.wait_finished(6)
        watch.wait_lines(*(rf"^{name}: plan\.finished = \d+$" for name in names))
        self.kill_broker(broker)
        self.serve_broker("--fleet", "other")
        self.wait_state("r1", "running")
        self.wait_finished(TASKS)
        watch = self.watch()
        self.emit_alarm("r1")
        watch.wait_lines(r"^r2: plan\.warned = 1$", r"^r3: plan\.warned = 1$")
        self.assertIn("3 of 3 robots: stopped", self.do("stop", "all"))

    def test_the_plan_of_a_robot_on_a_bus_asks_its_fleet(self):
        self.broker("r1")
        world = self.folder / "world"
        world.mkdir()
        port = listening(self.enterContext(simulated(world, {"name": "r1", "node": 1})))
        watch = self.watch()
        self.worker("r1", 1, lambda folder, **more: projects.bus(folder, f"tcp:127.0.0.1:{port}", name="thymio-II", **more))
        self.wait_finished(TASKS)
        watch.wait_line(rf"^r1: plan\.finished = {TASKS}$")
        shared = json.loads(self.records("shared/done").wait_line(r"^\{.*\}$").group())
        self.assertEqual(shared["value"], str(TASKS))

    def test_simulated_robots_share_tasks_with_one_that_serves_itself(self):
        """Two robots of a world, each with a bus and a plan of its own, and a third one; another keeper comes in the middle."""
        names = ("r1", "r2", "r3")
        self.init(*names)
        self.serve_broker("--fleet", "other")
        keeper = self.keep()
        watch = self.watch()
        self.worker("r3", len(names))
        folder = self.folder / "world"
        projects.write(folder, "one/vagus.json", {"format": "vagus-project/1", "name": "Work", "plan": "Work.plan.json",
                                                  "scripts": ["robot.aesl"], "fleet": PART})
        projects.write(folder, "one/robot.aesl", AESL.format(script=SCRIPT))
        projects.write(folder, "one/Work.plan.json", plan(len(names)))
        robots = [{"name": name, "type": "thymio2", "at": [0.5 + i, 0.5], "project": "one/"} for i, name in enumerate(names[:2])]
        world = projects.write(folder, "w.world.json", {"format": "vagus-world/1", "size": [3, 1], "robots": robots})
        sim = self.enterContext(vagus("sim", world, "--headless", "--fleet", self.target, "--tls-ca", self.broker_folder / "ca.crt",
                                      "--logins", self.broker_folder))
        sim.wait_lines(r'fleet: this robot is "r1"', r'fleet: this robot is "r2"')
        self.wait_finished(3)
        keeper.kill()
        self.keep()
        self.wait_finished(TASKS)
        watch.wait_lines(*(rf"^{name}: plan\.finished = \d+$" for name in names))
        self.assertIn("3 of 3 robots: stopped", self.do("stop", "all"))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:])], verbosity=2, warnings="ignore")
