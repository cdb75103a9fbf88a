"""`vagus deploy`: another version of a project for a robot that runs. It gets there whole or not at all, also when the robot loses its
power in the middle."""
import hashlib
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import time
import unittest

import projects
from field import Robots, Served
from harness import free_port, run_vagus, vagus, wait_until
from page import Page, Refused
from secure import certificate

KILLS = int(os.environ.get("VAGUS_KILLS") or 10)


def version_of(number):
    """A script that says which one it is."""
    return f"# version {number}\n" + projects.SCRIPT


def versions_of(robot):
    return robot / ".vagus" / "versions"


def whole_version(robot):
    """The script of the version in force; its files are those of its list, by their hashes."""
    link = versions_of(robot) / "current"
    if not link.is_symlink():
        return (robot / "robot.aesl").read_text(encoding="utf-8")
    place = versions_of(robot) / os.readlink(link)
    bundle = json.loads((place / "deployed.json").read_text(encoding="utf-8"))
    for file in bundle["files"]:
        content = (place / "files" / file["path"]).read_bytes()
        assert (len(content), hashlib.sha256(content).hexdigest()) == (file["size"], file["sha256"]), file
    there = {path.relative_to(place / "files").as_posix() for path in (place / "files").rglob("*") if path.is_file()}
    assert {file["path"] for file in bundle["files"]} == {path for path in there if not path.startswith(".vagus/")}
    return (place / "files" / bundle["project"] / "robot.aesl").read_text(encoding="utf-8")


class Deploy(Robots):
    def serve(self, *arguments, **options):
        page = super().serve("--start", *arguments, **options)
        self.wait_clock("running")
        page.do("driver.leave")
        return page

    def make(self, number, folder="desk", **more):
        """Version `number` of the project on the desk."""
        return projects.thymio(pathlib.Path(self.own) / folder, script=version_of(number), **more)

    def words(self, project, *options):
        return ("deploy", project, f"127.0.0.1:{self.studio.port}", "--token-file", self.studio.folder / "data" / "token", *options)

    def deploy(self, project, *options, status=0):
        return run_vagus(*self.words(project, *options), status=status)

    def wait_script(self, number):
        """It runs, and is that version."""
        self.wait_clock("running")
        self.wait_node(state="running", program="current")
        self.assertIn(f"# version {number}\n", self.page.do("doc.open", doc=projects.DOC)["text"])

    def test_another_version_takes_over(self):
        self.serve()
        self.assertEqual(self.deploy(self.make(1)), "version 1 runs")
        self.wait_script(1)
        self.assertEqual(whole_version(self.folder), (self.folder.parent / "desk" / "robot.aesl").read_text(encoding="utf-8"))
        self.assertIn("# version 1\n", whole_version(self.folder))
        self.assertNotIn("# version", (self.folder / "robot.aesl").read_text(encoding="utf-8"))  # version 0 stays as it was given
        self.assertRegex(self.deploy(self.make(2), "--list"), r"^      0 +the folder as it was given\n\*     1  \d{4}-\d\d-\d\d \d\d:\d\d  Thymio$")
        self.wait_metrics(deployed_version=1)
        started = ("vagus_deployments_total", "started")
        self.until(lambda: self.studio.metrics().get(started) == 1, "a deployment that is counted")

    def make_planned(self, number, plan):
        projects.write(pathlib.Path(self.own) / "desk", "do.plan.json", plan)
        return self.make(number, plan="do.plan.json")

    def test_how_the_plan_is_is_told(self):
        self.serve()
        self.assertEqual(self.deploy(self.make_planned(1, projects.PLAN)), "version 1 runs; its plan runs")
        short = {**projects.PLAN, "configuration": {**projects.PLAN["configuration"], "limit": {"type": "int", "initial": 1}}}
        self.assertEqual(self.deploy(self.make_planned(2, short)), "version 2 runs; its plan is over: OK")
        self.assertEqual(self.wait_metrics(deployed_version=2)[("vagus_plan_results_total", "OK")], 1)

    def test_a_plan_that_fails_at_once_is_taken_back(self):
        self.serve()
        self.deploy(self.make_planned(1, projects.PLAN))
        fails = {"format": "vagus-plan/1", "name": "Fails", "start": {"actor": "fail"},
                 "actors": {"fail": {"template": "Fail", "in": {"message": "'it is broken'"}, "states": {}}}}
        said = self.deploy(self.make_planned(2, fails), status=1)
        self.assertRegex(said, r"rolled back to version 1: (.*: )?it does not start: its plan ended in an error: .*it is broken")
        self.wait_script(1)
        values = self.wait_metrics(deployed_version=1, plan_running=1, ready=1)
        self.assertEqual((values[("vagus_deployments_total", "rolled_back")], values[("vagus_run_ends_total", "error")] > 0), (1, True))

    def test_what_was_deployed_runs_at_the_next_boot(self):
        self.serve()
        self.deploy(self.make(1))
        self.studio.program.stop()
        self.studio.start()
        with self.studio.page() as page:
            clock = page.watch("clock")
            page.wait(lambda: clock.value and clock.value["state"] == "running", "a run")
            self.assertIn("# version 1\n", page.do("doc.open", doc=projects.DOC)["text"])

    def test_a_faulty_one_is_refused_with_every_finding_and_nothing_changes(self):
        self.serve()
        faulty = self.make(1, plan="rounds.plan.json")
        projects.write(faulty, "robot.aesl", projects.AESL.format(node=1, name="thymio-II", script="onevent go\n\tmotor.lft.target = 1\n"))
        plan = json.loads(json.dumps(projects.PLAN))
        plan["actors"]["wait"]["states"]["Done"] = "nowhere"
        projects.write(faulty, "rounds.plan.json", plan)
        said = self.deploy(faulty, status=1)
        self.assertRegex(said, r"(?m)^robot\.aesl#1:2:\d+: error: .*motor\.lft\.target")
        self.assertRegex(said, r"(?m)^rounds\.plan\.json:\d+:\d+: error: .*nowhere")
        self.assertTrue(said.endswith("refused: it has mistakes; nothing was changed"), said)
        values = self.wait_metrics(deployed_version=0, runs_total=1)
        self.assertEqual(values[("vagus_deployments_total", "refused")], 1)
        self.assertEqual(list(versions_of(self.folder).iterdir()), [])
        self.wait_passed()

    def test_one_that_names_what_is_not_there_is_refused(self):
        self.serve()
        incomplete = self.make(1)
        (incomplete / "room.world.json").unlink()
        self.assertIn("room.world.json", self.deploy(incomplete, status=1))
        (incomplete / "vagus.json").unlink()
        self.assertIn("expected a vagus.json", self.deploy(incomplete, status=1))

    def test_one_that_does_not_start_is_taken_back(self):
        self.serve()
        self.deploy(self.make(1))
        elsewhere = projects.bus(pathlib.Path(self.own) / "elsewhere", f"tcp:127.0.0.1:{free_port()}", script="var n\n")
        said = self.deploy(elsewhere, status=1)
        self.assertIn("rolled back to version 1: it did not start within 10 s: waiting for nodes that are not there yet: rover", said)
        self.wait_script(1)
        self.assertEqual(sorted(one.name for one in versions_of(self.folder).iterdir()), ["1", "current"])
        self.assertEqual(self.wait_metrics(deployed_version=1)[("vagus_deployments_total", "rolled_back")], 1)

    def test_back_by_hand_and_the_last_five_stay(self):
        self.serve()
        for number in range(1, 8):
            self.assertEqual(self.deploy(self.make(number)), f"version {number} runs")
        self.assertEqual(self.deploy(self.folder, "--rollback"), "version 6 runs")
        self.wait_script(6)
        self.assertEqual(sorted(one.name for one in versions_of(self.folder).iterdir()), ["3", "4", "5", "6", "7", "current"])
        for number in (5, 4, 3):
            self.assertEqual(self.deploy(self.folder, "--rollback"), f"version {number} runs")
        self.assertEqual(self.deploy(self.folder, "--rollback"), "version 0 runs")
        self.assertIn("nothing is before it", self.deploy(self.folder, "--rollback", status=1))
        self.assertEqual(self.deploy(self.make(8)), "version 8 runs")
        self.assertEqual(self.deploy(self.folder, "--rollback"), "version 0 runs")

    def test_files_that_a_project_shares_with_its_neighbours_go_along(self):
        self.serve()
        shared = pathlib.Path(self.own) / "all"
        projects.write(shared, "vagus.json", {"format": "vagus-project/1", "name": "All"})
        one = self.make(1, folder="all/one", scripts=["../shared/robot.aesl"])
        (shared / "shared").mkdir()
        (one / "robot.aesl").rename(shared / "shared" / "robot.aesl")
        world = json.loads((one / "room.world.json").read_text(encoding="utf-8"))
        world["robots"][0]["script"] = "../shared/robot.aesl"
        projects.write(one, "room.world.json", world)
        projects.write(shared, "other/notes.txt", "nobody names this")
        projects.write(one, ".secret", "nobody sends this")
        self.assertEqual(self.deploy(one), "version 1 runs")
        files = versions_of(self.folder) / "1" / "files"
        there = [path.relative_to(files).as_posix() for path in files.rglob("*") if path.is_file()]
        self.assertEqual(sorted(path for path in there if not path.startswith(".vagus/")),
                         ["one/room.world.json", "one/vagus.json", "shared/robot.aesl", "vagus.json"])

    def test_it_is_for_who_drives(self):
        page = self.serve("--look-token-file", "look")
        page.do("driver.ask")
        project = self.make(1)
        waiting = self.enterContext(vagus(*self.words(project)))
        self.wait(lambda: (self.people.value.get("asked") or {}).get("name") == "vagus deploy", "the request for control")
        page.do("driver.answer", give=False)
        self.wait(lambda: not self.people.value.get("asked") or self.people.value["asked"]["until_wall"], "the next question")
        page.do("driver.leave")
        self.assertEqual(waiting.wait_end(), 0, waiting.lines)
        look = (self.studio.folder / "look").read_text(encoding="ascii").strip()
        with Page(self.studio.port, look) as looker:
            with self.assertRaises(Refused) as refused:
                looker.do("deploy.begin", name="x", project="", files=[])
            self.assertEqual(refused.exception.code, "not_allowed")
        wrong = self.studio.folder / "wrong"
        wrong.write_text("0" * 32, encoding="ascii")
        self.assertIn("the token is wrong", run_vagus("deploy", project, f"127.0.0.1:{self.studio.port}", "--token-file", wrong, status=1))

    def test_bytes_that_are_not_as_announced_are_refused(self):
        page = self.serve()
        page.do("driver.ask")
        content = "{}"
        announced = {"path": "vagus.json", "size": len(content), "sha256": hashlib.sha256(b"other").hexdigest()}
        for path in ("../vagus.json", "/etc/passwd", ".vagus/state.json", "a/./b"):
            self.refused("bad_input", "deploy.begin", name="x", project="", files=[{**announced, "path": path}])
        page.do("deploy.begin", name="x", project="", files=[announced])
        self.refused("bad_input", "deploy.part", path="robot.aesl", **{"from": 0, "base64": ""})
        self.refused("bad_input", "deploy.part", path="vagus.json", **{"from": 0, "base64": "e30"})
        self.assertIn("not what was announced", self.refused("bad_input", "deploy.part", path="vagus.json", **{"from": 0, "base64": "e30="}))
        outcome = page.do("deploy.commit")
        self.assertEqual((outcome["result"], outcome["version"]), ("refused", 0))
        self.wait_passed()

    def test_by_tls_only_to_who_is_who_he_says(self):
        place = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        cert, key = certificate(place, "robot", "127.0.0.1")
        self.own = place
        robot = self.enterContext(Served(projects.thymio(place / "robot"), "--start", "--tls-cert", cert, "--tls-key", key))
        words = ("deploy", self.make(1), f"https://127.0.0.1:{robot.port}/", "--token-file", robot.folder / "data" / "token")
        self.assertIn("its certificate is not accepted: self-signed certificate; name who signed it, as --tls-ca ca.crt or --tls-cert",
                      run_vagus(*words, status=1))
        other, _ = certificate(place, "other", "127.0.0.1")
        self.assertIn("its certificate is not accepted: self-signed certificate", run_vagus(*words, "--tls-cert", other, status=1))
        elsewhere, _ = certificate(place, "elsewhere", "127.0.0.2")
        self.assertIn("its certificate is not accepted: self-signed certificate", run_vagus(*words, "--tls-cert", elsewhere, status=1))
        self.assertEqual(run_vagus(*words, "--tls-cert", cert), "version 1 runs")

    def test_an_empty_folder_waits_for_its_first_project(self):
        Robots.serve(self, "--start", make=lambda folder: folder.mkdir())
        self.assertIn("note: there is no project yet; `vagus deploy` sends the first", self.studio.log())
        self.page.do("driver.leave")
        self.assertEqual(self.deploy(self.make(1)), "version 1 runs")
        self.wait_script(1)

    def test_killed_at_any_moment_it_starts_the_old_or_the_new_version_whole(self):
        seed = int(os.environ.get("VAGUS_SEED") or random.SystemRandom().randrange(1 << 32))
        print(f"seed: VAGUS_SEED={seed}")
        dice = random.Random(seed)
        self.serve()
        self.page.close()
        self.deploy(self.make(0))
        begun = time.monotonic()
        self.deploy(self.make(0))
        usual = time.monotonic() - begun
        in_force, kept = 0, 0
        for number in range(1, KILLS + 1):
            with vagus(*self.words(self.make(number))) as sending:
                try:
                    sending.process.wait(timeout=dice.uniform(0, dice.choice((0.3, 1.1)) * usual))
                except subprocess.TimeoutExpired:
                    pass
                self.studio.kill()
                sending.wait_end()
            before = whole_version(self.folder)
            self.studio.start()
            with self.studio.page() as page:
                clock = page.watch("clock")
                page.wait(lambda: clock.value and clock.value["state"] == "running", "a run after the kill")
                text = page.do("doc.open", doc=projects.DOC)["text"]
            found = next((one for one in (in_force, number) if f"# version {one}\n" in text), None)
            self.assertIsNotNone(found, text)
            self.assertEqual(whole_version(self.folder), before)
            self.assertIn(f"# version {found}\n", before)
            # The oldest version may be being deleted just now.
            parts = [versions_of(self.folder) / one for one in ("incoming", "next", "gone")]
            wait_until("parts of a version are left", lambda: not any(part.exists() for part in parts))
            kept += found == number
            in_force = found
        print(f"figure: {KILLS} kills, {kept} times the new version was in force")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:] or ["Deploy"])], verbosity=2, warnings="ignore")
