"""`vagus plan diff` as a process: exit codes, text, JSON, and in git as docs/explore.md says."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
VAGUS = os.environ.get("VAGUS_BIN", str(ROOT / "build/release/bin/vagus"))

PLAN = """{ "format": "vagus-plan/1", "name": "Good", "start": { "actor": "go" },
  "actors": { "go": { "template": "Wait", "in": { "seconds": 5 }, "states": { "Done": "@terminate" } } },
  "layout": { "go": [0, 0] } }"""


class Diff(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, text, name="a.plan.json"):
        (self.folder / name).write_text(text)

    def vagus(self, verb, *arguments):
        return subprocess.run([VAGUS, "plan", verb, *arguments], cwd=self.folder, capture_output=True, text=True, timeout=120)

    def diff(self, before, after, *arguments):
        self.write(before)
        self.write(after, "b.plan.json")
        return self.vagus("diff", "a.plan.json", "b.plan.json", *arguments)

    def test_the_same_plan_has_exit_code_0_however_it_is_written(self):
        done = self.diff(PLAN, json.dumps(json.loads(PLAN), indent=1))
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        self.assertEqual(self.diff(PLAN, PLAN, "--json").stdout, "[]\n")

    def test_differences_are_told_by_element(self):
        done = self.diff(PLAN, PLAN.replace('"seconds": 5', '"seconds": "2 * 3"'))
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stdout, '--- a.plan.json\n+++ b.plan.json\nactor go\n  - in.seconds: 5\n  + in.seconds: "2 * 3"\n')
        said = json.loads(self.diff(PLAN, PLAN.replace('"seconds": 5', '"seconds": 6'), "--json").stdout)
        self.assertEqual(said, [{"kind": "changed", "element": "actor go", "part": "in.seconds",
                                 "path": ["actors", "go", "in", "seconds"], "before": 5, "after": 6}])

    def test_places_do_not_count_unless_asked_for(self):
        moved = PLAN.replace("[0, 0]", "[9, 9]")
        done = self.diff(PLAN, moved)
        self.assertEqual(done.returncode, 0)
        self.assertIn("1 element stands elsewhere (--places lists them)", done.stdout)
        asked = self.diff(PLAN, moved, "--places")
        self.assertEqual(asked.returncode, 1)
        self.assertIn("  + layout.go: [9, 9]", asked.stdout)

    def test_what_is_no_plan_has_exit_code_2(self):
        done = self.diff(PLAN, "{")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("b.plan.json:1:", done.stderr)
        self.assertEqual(self.vagus("diff", "a.plan.json", "none.plan.json").returncode, 2)

    def test_a_version_that_is_not_there(self):
        self.write(PLAN)
        done = self.vagus("diff", "/dev/null", "a.plan.json")
        self.assertEqual(done.returncode, 1)
        self.assertIn('  + actors.go.template: "Wait"', done.stdout)

    def test_git_shows_it_as_the_page_says(self):
        page = (ROOT / "docs/explore.md").read_text()
        command = next(line for line in page.splitlines() if line.startswith("git config diff.vagus.command"))
        environment = {**os.environ, "PATH": f"{pathlib.Path(VAGUS).parent}:{os.environ['PATH']}", "HOME": str(self.folder),
                       "GIT_CONFIG_NOSYSTEM": "1"}

        def shell(line):
            return subprocess.run(["bash", "-c", line], cwd=self.folder, env=environment, capture_output=True, text=True,
                                  timeout=60, check=True).stdout
        self.write(PLAN)
        shell("git init -q . && echo '*.plan.json diff=vagus' > .gitattributes && git add -A && "
              "git -c user.name=a -c user.email=a@example.org commit -qm first")
        shell(command)
        self.write(PLAN.replace('"seconds": 5', '"seconds": 6'))
        self.assertIn("actor go\n  - in.seconds: 5\n  + in.seconds: 6\n", shell("git diff"))
        tool = next(line for line in page.splitlines() if line.startswith("git config difftool.vagus.cmd"))
        shell(tool)
        self.assertIn("  + in.seconds: 6\n", shell("git difftool -y -t vagus"))


if __name__ == "__main__":
    unittest.main()
