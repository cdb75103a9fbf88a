"""Another version for robots of a fleet, in steps: fetched, checked, started, and taken back."""
import json
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from fleet import AESL, Case, PART, SCRIPT  # noqa: E402
import projects  # noqa: E402
from harness import GIVE_UP_AFTER, vagus, wait_until  # noqa: E402
from page import Refused, Studio  # noqa: E402


def words_of_deploy(broker, *arguments):
    return ["deploy", *arguments, "--serve-cert", broker / "broker.crt", "--serve-key", broker / "broker.key"]


class Versions(Case):
    def version(self, script="var edition = 2\n" + SCRIPT, **more):
        """A folder with another version of the project of the robots; `more` is of its key "fleet"."""
        folder = self.folder / "version"
        projects.thymio(folder, script="", fleet={**PART, **more})
        projects.write(folder, "robot.aesl", AESL.format(script=script))
        return folder

    def name(self, folder, name):
        file = folder / "vagus.json"
        file.write_text(json.dumps({**json.loads(file.read_text(encoding="utf-8")), "name": name}), encoding="utf-8")
        return folder


class Rollout(Versions):
    def words(self, *arguments):
        return words_of_deploy(self.broker_folder, *arguments)

    def deploy(self, *arguments, **options):
        return self.desk(*self.words(*arguments), **options)

    def edition(self, robot):
        """What that robot tells of the variable that only the other version has."""
        return self.desk("tell", robot, "thymio-II.edition", wait=1).stdout

    def two_robots(self):
        self.broker("r1", "r2")
        for name in ("r1", "r2"):
            self.joined(name)
            self.wait_state(name, "running")

    def test_all_get_it_in_steps_and_give_it_back(self):
        self.two_robots()
        done = self.deploy("all", "--project", self.version())
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(done.stdout, r"(?s)r1: wanted.*r1: well.*r2: wanted.*r2: well.*2 of 2 robots: well")
        self.is_told("r2", "thymio-II.edition", 2)
        done = self.desk("deploy", "all", "--rollback")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("2 of 2 robots: well", done.stdout)
        self.assertRegex(self.edition("r2"), r'r2: not done: .*edition')

    def test_what_is_taken_back_is_one_roll_out(self):
        """A robot that did not get it would lose the version that it had before."""
        self.two_robots()
        self.assertEqual(self.deploy("all", "--project", self.version()).returncode, 0)
        self.assertEqual(self.deploy("r1", "--project", self.version(script="var edition = 3\n" + SCRIPT)).returncode, 0)
        done = self.desk("deploy", "all", "--rollback")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stdout, r"versions of 2 roll-outs, and nothing was changed: that of r[12]; that of r[12]\. Name those")
        self.assertEqual(self.desk("deploy", "r1", "--rollback").returncode, 0)
        self.is_told("r1", "thymio-II.edition", 2)
        done = self.desk("deploy", "all", "--rollback")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(done.stdout, r"(?s)^r1: as it was: no version of a roll-out is in force there.*r2: well.*1 of 1 robots: well")
        self.is_told("r1", "thymio-II.edition", 2)
        done = self.desk("deploy", "all", "--rollback")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("there is nothing to take back, and nothing was changed", done.stdout)

    def test_a_login_that_may_not_is_told_so(self):
        self.broker("r1")
        self.joined("r1")
        self.wait_state("r1", "running")
        done = self.desk(*self.words("r1", "--project", self.version()), by="looker")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stdout, r"(?i)the broker does not pass it on: not authori[sz]ed; use the --login of an operator")

    def test_a_robot_says_the_name_of_the_project_that_it_runs(self):
        self.two_robots()

        def names():
            lines = self.desk("list", "all", "--json").stdout.splitlines()
            return [json.loads(line)["description"]["project"] for line in lines]

        before = names()
        self.deploy("all", "--project", self.name(self.version(), "Second exercise"))
        wait_until("the name stayed", lambda: names() == ["Second exercise"] * 2)
        self.desk("deploy", "all", "--rollback")
        wait_until("the name did not come back", lambda: names() == before)

    def test_the_first_that_is_not_well_stops_it(self):
        self.two_robots()
        done = self.deploy("all", "--project", self.version(script="onevent nobody.knows.this\n\tx = 1\n"))
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stdout, r"r1: failed: refused: it has mistakes; nothing was changed; robot\.aesl#1:\d+: ")
        self.assertRegex(done.stdout, r"(?s)r2: as it was.*0 of 2 robots: well")
        self.assertEqual(self.state("r1"), "running")

    def test_a_robot_is_well_when_its_own_condition_was_true(self):
        self.two_robots()
        condition = "node('thymio-II', 'edition') == {}"
        done = self.deploy("all", "--project", self.version(healthy={"condition": condition.format(2), "for": 1}))
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("2 of 2 robots: well", done.stdout)
        done = self.deploy("all", "--project", self.version(healthy={"condition": condition.format(3), "for": 1}), wait=6)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("r1: failed: not well within 6 s of its start: its condition node('thymio-II', 'edition') == 3 is not true: "
                      "node('thymio-II', 'edition') = 2", done.stdout)
        self.assertRegex(done.stdout, r"(?s)r2: as it was.*0 of 2 robots: well")

    def test_a_condition_with_a_name_that_is_none_is_refused(self):
        self.two_robots()
        version = self.version(healthy={"condition": "node('thymio-II', 'editon') == 2"})
        done = self.deploy("all", "--project", version)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stdout, r'r1: failed: refused: .*vagus\.json:\d+: "condition" of "healthy": .*did you mean edition\?')

    def test_what_is_wrong_with_the_certificate_of_the_version_is_told(self):
        self.broker("r1")
        self.joined("r1")
        self.wait_state("r1", "running")
        done = self.deploy("r1", "--project", self.version(), "--listen", "127.0.0.2:0", "--host", "127.0.0.2")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("its certificate is not accepted: it is not for the name 127.0.0.2; name one that is", done.stdout)
        self.assertEqual(self.state("r1"), "running")

    def test_a_robot_that_was_away_finds_it_when_it_is_back(self):
        self.broker("r1")
        first = self.joined("r1")
        self.wait_state("r1", "running")
        first.kill()
        with vagus("fleet", self.target, *self.words("r1", "--project", self.version()), *self.login("operator"), "--wait",
                   GIVE_UP_AFTER) as program:
            program.wait_line(r"^r1: wanted$")
            self.joined("r1")
            program.wait_line(r"^r1: well$")
            self.assertEqual(program.wait_end(), 0)

    def test_a_roll_out_says_what_it_cannot_do(self):
        self.broker("r1")
        for words, what in ((("r1", "--project", self.version(), "--steps", "1,0"), "--steps 1,0: expected numbers of robots"),
                            (("r1", "--project", self.version(), "--listen", "0.0.0.0"), "--listen 0.0.0.0: expected ADDRESS:PORT"),
                            (("r1",), "which version?"), (("all", "--project", self.folder / "none"), "no robot is there")):
            done = self.desk("deploy", *words)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(what, done.stdout)
        done = self.desk("deploy", "r1", "--project", self.version(), "--listen", "0.0.0.0:0")
        self.assertIn("by HTTPS alone", done.stdout)


class FromTheStudio(Versions):
    """The same as a page of a studio orders it, over HTTPS."""

    def studio(self, version, *arguments):
        certificate = ("--deploy-cert", self.broker_folder / "broker.crt", "--deploy-key", self.broker_folder / "broker.key")
        return self.enterContext(Studio(version, "--fleet", self.target, *self.login("operator"), "--deploy-listen", "127.0.0.1:0",
                                        "--deploy-host", "localhost", *certificate, *arguments))

    def page(self, studio):
        page = self.enterContext(studio.page())
        page.do("driver.ask")
        fleet, rollout = page.watch("fleet"), page.watch("rollout")
        page.wait(lambda: fleet.value and fleet.value["state"] == "connected", "the broker")
        return page, fleet, rollout

    def test_a_robot_that_was_away_fetches_it_from_the_studio(self):
        self.broker("r1")
        first = self.joined("r1")
        self.wait_state("r1", "running")
        first.kill()
        page, fleet, rollout = self.page(self.studio(self.version()))
        page.wait(lambda: "r1" in fleet.value["robots"], "the robot that was there")
        page.do("fleet.deploy", robots=["r1"])
        page.wait(lambda: rollout.value["robots"].get("r1", {}).get("is") == "wanted", "the wish")
        self.assertEqual(rollout.value["state"], "running")
        self.joined("r1")
        page.wait(lambda: rollout.value["state"] == "well", "the end")
        self.assertTrue(rollout.value["robots"]["r1"]["has"])
        self.is_told("r1", "thymio-II.edition", 2)

    def test_a_robot_becomes_well_after_the_studio_was_killed(self):
        """Its table tells it, although the roll-out is left."""
        self.broker("r1")
        self.joined("r1")
        self.wait_state("r1", "running")
        healthy = {"condition": "node('thymio-II', 'edition') > 2", "for": 1}
        studio = self.studio(self.version(healthy=healthy))
        page, fleet, rollout = self.page(studio)
        page.wait(lambda: "r1" in fleet.value["robots"], "the robot")
        page.do("fleet.deploy", robots=["r1"])
        page.wait(lambda: "is not true" in rollout.value["robots"].get("r1", {}).get("why", ""), "what it lacks")
        studio.kill()
        studio.start()
        page, fleet, rollout = self.page(studio)
        page.wait(lambda: rollout.value and "is not true" in rollout.value["robots"]["r1"]["why"], "what it lacks")
        self.assertEqual(rollout.value["state"], "left")
        self.do("set", "r1", "thymio-II.edition", 3)
        page.wait(lambda: rollout.value["robots"]["r1"]["is"] == "well", "that it is well")
        self.assertEqual(rollout.value["robots"]["r1"]["why"], "")

    def test_unsaved_changes_are_left_out_only_by_name(self):
        self.broker("r1")
        self.joined("r1")
        self.wait_state("r1", "running")
        page, fleet, rollout = self.page(self.studio(self.version()))
        page.wait(lambda: "r1" in fleet.value["robots"], "the robot")
        page.edit("robot.aesl", (0, 0, "\n"))
        with self.assertRaisesRegex(Refused, "robot.aesl has unsaved changes"):
            page.do("fleet.deploy", robots=["r1"])
        page.do("fleet.deploy", robots=["r1"], without=["robot.aesl"])
        page.wait(lambda: rollout.value["state"] == "well", "the end")

    def test_who_may_only_look_is_told_why(self):
        self.broker("r1")
        self.joined("r1")
        self.wait_state("r1", "running")
        studio = self.enterContext(Studio(self.version(), "--fleet", self.target, *self.login("looker")))
        page, fleet, rollout = self.page(studio)
        page.wait(lambda: fleet.value["robots"].get("r1", {}).get("state"), "the robot")
        page.do("fleet.deploy")
        page.wait(lambda: rollout.value["state"] == "left", "the refusal")
        self.assertIn("open the fleet with the login of an operator", rollout.value["why"])


class Tell(Case):
    def test_a_variable_is_told_because_somebody_asks(self):
        self.broker("r1")
        self.joined("r1", tell=[])
        self.wait_state("r1", "running")
        self.is_told("r1", "thymio-II.heard", 0)
        done = self.desk("tell", "r1", "thymio-II.nothing")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout, r"r1: not done: .*nothing")

    def test_a_robot_identifies_itself_as_its_project_says(self):
        self.broker("r1", "r2")
        declared = AESL.replace('<event size="1" name="alarm"/>', '<event size="1" name="alarm"/>\n<event size="0" name="identify"/>')
        script = SCRIPT + "\nonevent identify\n\tlast = 99\n"
        self.joined("r1", script=script, aesl=declared), self.joined("r2")
        self.wait_state("r1", "running"), self.wait_state("r2", "running")
        watch = self.watch()
        self.do("identify", "r1")
        watch.wait_line(r"^r1: thymio-II\.last = 99$")
        done = self.desk("identify", "r2")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout, r"r2: not done: .*identify")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:])], verbosity=2, warnings="ignore")
