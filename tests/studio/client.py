"""examples/client: what a client of one's own looks like, run against a studio."""
import os
import sys
import unittest

import projects
from cases import Case, PLAN
from harness import Program
from protocol import ROOT

# The package python3-websockets is Debian's, and so is this Python.
PYTHON = "/usr/bin/python3"
CLIENT = ROOT / "examples/client/run_plan.py"


class Client(Case):
    def open_rounds(self, limit):
        def make(folder):
            projects.write(folder, "rounds.plan.json", PLAN)
            projects.thymio(folder, plan="rounds.plan.json", start={"plan": True, "set": {"limit": limit}})
        return self.open(make)

    def run_client(self, *arguments):
        return self.enterContext(Program(PYTHON, CLIENT, *arguments, env={**os.environ, "PYTHONUNBUFFERED": "1"}))

    def test_the_client_of_the_examples_runs_a_plan_and_prints_its_events(self):
        page = self.open_rounds(limit=3)
        page.do("driver.leave")
        for _ in range(2):  # the second time after a run that is over
            client = self.run_client(self.studio.address, "--speed", 1)
            self.assertEqual(client.wait_end(), 0, client.lines)
            rounds = [line for line in client.lines if line.split()[1:] == ["round"]]
            self.assertEqual(len(rounds), 3, client.lines)
            self.assertRegex("\n".join(client.lines), r"\d\.\d\d\d  thymio-II: told \d+ \d+")
            self.assertIn("Rounds is over: OK", client.lines[-1])

    def test_the_client_of_the_examples_says_what_was_refused(self):
        page = self.open_rounds(limit=1)
        client = self.run_client(self.studio.address)
        self.assertEqual(client.wait_end(), 1)
        self.assertIn("has control; request control first", client.lines[-1])
        client = self.run_client(self.studio.address[:-1] + "~")
        self.assertEqual(client.wait_end(), 1)
        self.assertIn("the token is wrong", client.lines[-1])
        page.do("run.start")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:] or ["test_the_client"])], verbosity=2, warnings="ignore")
