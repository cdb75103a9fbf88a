"""Each command is answered once, whatever happens while it is under way: all of them at a time, and in their midst the run dies,
the node goes, the target is left or the project closed."""
import json
import os
import random
import signal
import sys
import tempfile
import unittest

import projects
from cases import Case
from harness import Missing, listening, simulated
from protocol import COMMANDS, invented_fields

# What these do is what is done to the others; folder.list reads folders that are nobody's business here.
# A page that has released control is refused all the rest.
MOMENTS = ("run.end", "target.choose", "target.leave", "project.open", "project.close", "project.example", "project.new",
           "driver.leave")
OTHERS = [command for command in COMMANDS if command not in ("hello", "watch", "unwatch", "folder.list", *MOMENTS)]
KNOWN = {"Doc": [projects.DOC, "robot.aesl", "rounds.plan.json"], "doc": [projects.DOC], "Path": ["new.aesl"], "path": ["new.aesl"], "from": ["new.aesl"], "to": ["newer.aesl"],
         "NodeId": [1], "node": [0, 1], "name": ["go", "n", "speed"], "robot": ["alice"], "object": [1], "version": [1],
         "button": ["center"], "Point": [[1, 1]], "at": [[1, 1]], "size": [[0.1, 0.1]], "kind": ["box"], "level": [0], "value": [1], "ms": [5],
         "values": [[1]], "first": [0], "args": [[5]], "line": [projects.N_LINE], "set": [{}], "target": ["sim"], "speed": [1]}


class Answers(Case):
    def setUp(self):
        seed = int(os.environ.get("VAGUS_SEED") or random.SystemRandom().randrange(1 << 32))
        print(f"seed: VAGUS_SEED={seed}")
        self.dice = random.Random(seed)

    def open_simulated(self):
        def make(folder):
            projects.write(folder, "rounds.plan.json", projects.PLAN)
            projects.thymio(folder, plan="rounds.plan.json")
        return self.open(make)

    def ask_all(self):
        """Each command, twice, in any order."""
        commands = OTHERS * 2
        self.dice.shuffle(commands)
        return [self.page.ask(command, **invented_fields(COMMANDS[command]["in"], self.dice, KNOWN)) for command in commands]

    def expect_answers(self, asked):
        page = self.page

        def unanswered():
            return {number: page.asked[number] for number in asked if number not in page.answered}

        try:
            page.wait(lambda: not unanswered(), "answers to all")
        except Missing as missing:  # which ones, before all the rest
            raise Missing(f"never answered: {unanswered()}; {missing}") from None
        page.do("driver.ask")  # nothing is on its way any more
        self.assertEqual([page.asked[number] for number in asked if page.answered[number] != 1], [])

    def kill_run(self):
        for run in self.studio.children():
            os.kill(run, signal.SIGKILL)

    def test_while_a_world_opens(self):
        page = self.open_simulated()
        for moment in (None, "target.leave", "run.end", "project.close"):
            page.do("project.open", path=str(self.folder))
            begun = page.ask("run.start")
            asked = self.ask_all()
            last = [page.ask(moment)] if moment else []
            self.expect_answers([begun, *asked, *last])

    def test_while_a_plan_runs_and_its_run_dies(self):
        page = self.open_simulated()
        for kill in (self.kill_run, lambda: page.do("run.end"), lambda: page.do("target.leave"), lambda: page.do("project.close"),
                     lambda: page.do("project.open", path=str(self.folder))):
            page.do("project.open", path=str(self.folder))
            begun = page.ask("run.start")
            page.wait(lambda: begun in page.answered, "the start")
            asked = self.ask_all()
            kill()
            self.expect_answers(asked)

    def test_a_run_is_kept_as_a_test_while_its_project_closes(self):
        page = self.open_simulated()
        page.do("run.start")
        self.expect_answers([page.ask("test.keep"), page.ask("project.close")])

    def test_a_run_that_cannot_be_kept_is_named_as_pages_name_it(self):
        page = self.open_simulated()
        page.do("target.choose", target="sim")
        self.wait_node(described=True)
        page.do("run.step")
        self.wait(lambda: self.clock.value["t"] > 0 and [*self.folder.rglob("run-*.mcap")], "the recording of a run that has begun")
        told = self.refused("failed", "test.keep")
        # One step is too short a run of scripts to say anything of it.
        self.assertRegex(told, r"^run-\d+\.mcap: the run took 0 s, in which nothing is seen; let it run for longer")

    def test_while_the_run_hangs_and_is_ended(self):
        page = self.open_simulated()
        self.wait_node(described=True)
        page.do("run.start")
        (run,) = self.studio.children()
        os.kill(run, signal.SIGSTOP)
        asked = self.ask_all()
        self.wait_clock("hanging")
        page.do("run.end")
        self.expect_answers(asked)

    def test_while_a_node_stands_at_a_breakpoint(self):
        page = self.open_simulated()
        self.wait_node(described=True)
        page.do("break.set", doc=projects.DOC, line=projects.N_LINE)
        asked = [page.ask("run.start")]
        for _ in range(30):
            # The node halts, is stepped out of its handler, and halts again ten milliseconds of its time later.
            asked += [page.ask("run.step"), page.ask("node.step", node=1), page.ask("run.step", ms=10)]
            page.wait(lambda: len(page.answered) >= asked[-1] - 3, "answers to those before")
        self.expect_answers(asked)
        self.wait_node(state="paused")

    def test_on_a_bus_whose_node_goes(self):
        arena = self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-arena-"))
        robot = self.enterContext(simulated(arena, {"name": "alice", "node": 1}))
        target = f"tcp:127.0.0.1:{listening(robot)}"

        def make(folder):
            projects.write(folder, "rounds.plan.json", projects.PLAN)
            projects.bus(folder, target, name="thymio-II")
            project = json.loads((folder / "vagus.json").read_text(encoding="utf-8"))
            projects.write(folder, "vagus.json", {**project, "plan": "rounds.plan.json"})

        page = self.open(make)
        for moment in (self.kill_run, lambda: page.do("target.leave"), lambda: page.do("project.close"), robot.kill):
            page.do("project.open", path=str(self.folder))
            self.wait_node(described=True)
            begun = page.ask("run.start")
            page.wait(lambda: begun in page.answered, "the start")
            asked = self.ask_all()
            moment()
            self.expect_answers(asked)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:] or ["Answers"])], verbosity=2, warnings="ignore")
