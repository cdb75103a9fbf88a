"""A lesson with a class of simulated robots at a real broker, as a teacher gives it: stop all, start all, the next exercise for
everyone, and the pupils' robots as they are: one in an endless loop, one unplugged, one whose Wi-Fi comes and goes."""
import json
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from fleet import AESL, FLEET, PART, ROOT, SCRIPT  # noqa: E402
import projects  # noqa: E402
from harness import GIVE_UP_AFTER, vagus, wait_until  # noqa: E402
from proxy import Proxy  # noqa: E402
from rollout import Versions, words_of_deploy  # noqa: E402

# Drives and counts; `edition` says which exercise it is.
EXERCISE = "var edition = {edition}\n" + SCRIPT.replace("\nonevent", "motor.left.target = 100\nmotor.right.target = 100\n\nonevent", 1)
# The compiler cannot know that nothing makes `go` another value.
ENDLESS = EXERCISE.replace("onevent timer0\n", "onevent timer0\n\twhile go == 0 do\n\t\tgo = 0\n\tend\n", 1)
# It begins before the first event, and none has a handler that would end it.
SILENT = "var go = 0\nvar heard = 0\nvar last = 0\n\nwhile go == 0 do\n\tgo = 0\nend\n"


class Lesson(Versions):
    def exercise(self, name, script=EXERCISE, edition=1, aesl=AESL, **part):
        """A folder with a project for robots."""
        folder = self.folder / name
        projects.write(folder, "vagus.json", {"format": "vagus-project/1", "name": name, "scripts": ["robot.aesl"],
                                              "fleet": {**PART, **part}})
        projects.write(folder, "robot.aesl", aesl.format(script=script.replace("{edition}", str(edition))))
        return folder

    def world(self, name="class", **robots):
        """Thymios with the folder of the project of each."""
        return projects.write(self.folder, f"{name}.world.json", {"format": "vagus-world/1", "size": [8, 8], "robots": [
            {"name": robot, "type": "thymio2", "at": [0.5 + i, 4], "project": project.name}
            for i, (robot, project) in enumerate(robots.items())]})

    def simulated(self, world, *arguments, target=None):
        """As soon as all its robots are members."""
        names = [robot["name"] for robot in json.loads(world.read_text(encoding="utf-8"))["robots"]]
        program = self.enterContext(vagus("sim", world, "--headless", "--fleet", target or self.target, "--tls-ca",
                                          self.broker_folder / "ca.crt", "--logins", self.broker_folder, *arguments))
        program.wait_lines(*(rf'fleet: this robot is "{name}"' for name in names))
        return program

    def deploy(self, *arguments, **options):
        return self.desk(*words_of_deploy(self.broker_folder, *arguments), **options)

    def running(self, *names):
        for name in names:
            self.wait_state(name, "running")

    def refused(self, *words, **options):
        done = self.desk(*words, **options)
        self.assertEqual(done.returncode, 1, done.stdout)
        return done.stdout


class Commands(Lesson):
    """What an operator tells robots of a world, one by one."""

    def setUp(self):
        super().setUp()
        self.broker("s1", "s2")
        one = self.exercise("one")
        self.program = self.simulated(self.world(s1=one, s2=one))
        self.running("s1", "s2")

    def test_what_is_stopped_is_at_rest_until_it_is_started(self):
        """A Thymio's motors keep their targets when its program is stopped: stopped means that they were set to 0."""
        self.assertIn("2 of 2 robots: stopped", self.do("stop", "all"))
        self.wait_state("s1", "stopped")
        self.is_told("s1", "thymio-II.motor.left.target", 0)
        self.do("set", "s1", "thymio-II.heard", 7)
        self.do("start", "s1")
        self.running("s1")
        self.is_told("s1", "thymio-II.motor.left.target", 100)
        self.is_told("s1", "thymio-II.heard", 0)
        self.assertEqual(self.state("s2"), "stopped")
        self.do("start", "--group", "red")
        self.running("s2")

    def test_pause_and_continue(self):
        self.do("set", "s1", "thymio-II.heard", 7)
        self.do("pause", "s1")
        self.wait_state("s1", "paused")
        self.is_told("s1", "thymio-II.motor.left.target", 0)
        self.do("continue", "s1")
        self.running("s1")
        self.is_told("s1", "thymio-II.heard", 7)
        self.assertIn("s1: not done: it is not paused", self.refused("continue", "s1"))

    def test_variables_are_set_and_told(self):
        watch = self.watch()
        self.emit_alarm("s1")
        watch.wait_line(r"^s2: thymio-II\.heard = 1$")
        self.is_told("s2", "thymio-II.go", 0)
        self.assertRegex(self.refused("set", "s1", "thymio-II.goo", 1), r"s1: not done: .*goo.*go")
        self.assertRegex(self.refused("tell", "s1", "thymio-II.nothing"), r"s1: not done: .*nothing")
        wait_until("its nodes were never told", lambda: self.states()["s1"]["description"]["nodes"] == ["thymio-II"])
        self.assertIn("s1: not done: no plan runs; name the node", self.refused("set", "s1", "n", 1))
        self.assertRegex(self.refused("identify", "s1"), r"s1: not done: .*identify")
        self.assertIn("s1: not done: no plan runs", self.refused("raise", "s1", "watch", "Seen"))


class NextExercise(Lesson):
    def edition(self, robot):
        """What that robot tells of the variable that says which exercise it has."""
        found = re.search(r"edition = (\d+)", self.desk("tell", robot, "thymio-II.edition", wait=1).stdout)
        return int(found.group(1)) if found else None

    def test_everyone_gets_it_in_steps_and_gives_it_back(self):
        self.broker("s1", "s2")
        one = self.exercise("one")
        self.simulated(self.world(s1=one, s2=one))
        self.running("s1", "s2")
        done = self.deploy("all", "--project", self.exercise("two", edition=2, send=[], hear=[]), "--steps", "1")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(done.stdout, r"(?s)s1: wanted.*s1: well.*s2: wanted.*s2: well.*2 of 2 robots: well")
        self.is_told("s2", "thymio-II.edition", 2)
        self.assertEqual(self.states()["s2"]["description"].get("hear", []), [], "it joined again as its project says")
        done = self.desk("deploy", "all", "--rollback", "--steps", "100%")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.is_told("s1", "thymio-II.edition", 1)

    def test_one_with_mistakes_changes_nothing(self):
        self.broker("s1", "s2")
        one = self.exercise("one")
        self.simulated(self.world(s1=one, s2=one))
        self.running("s1", "s2")
        done = self.deploy("all", "--project", self.exercise("two", script="onevent nobody.knows.this\n\tx = 1\n"))
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stdout, r"s1: failed: refused: it has mistakes; nothing was changed; robot\.aesl#1:\d+: ")
        self.assertRegex(done.stdout, r"(?s)s2: as it was.*0 of 2 robots: well")
        self.assertEqual(self.state("s1"), "running")
        self.is_told("s1", "thymio-II.edition", 1)

    def test_a_plan_comes_with_it(self):
        self.broker("s1")
        self.simulated(self.world(s1=self.exercise("one")))
        self.running("s1")
        two = self.exercise("two", edition=2, healthy={"condition": "rounds > 2 and node('thymio-II', 'edition') == 2", "for": 1})
        project = json.loads((two / "vagus.json").read_text(encoding="utf-8"))
        projects.write(two, "vagus.json", {**project, "plan": "rounds.plan.json"})
        projects.write(two, "rounds.plan.json", projects.PLAN)
        done = self.deploy("s1", "--project", two)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("1 of 1 robots: well", done.stdout)
        self.do("pause", "s1")
        self.wait_state("s1", "paused")
        self.assertRegex(self.refused("raise", "s1", "nobody", "Seen"), r"s1: not done: .*nobody")
        self.do("continue", "s1")
        self.running("s1")
        self.do("set", "s1", "limit", 3)  # it ends with the round that runs
        self.do("stop", "s1")
        self.wait_state("s1", "stopped")
        self.do("start", "s1")
        self.running("s1")

    def test_one_that_was_stopped_waits_until_it_is_started(self):
        self.broker("s1")
        self.simulated(self.world(s1=self.exercise("one")))
        self.running("s1")
        self.do("stop", "s1")
        done = self.deploy("s1", "--project", self.exercise("two", edition=2))
        self.assertEqual(done.returncode, 0, done.stdout)
        self.running("s1")


class Pupils(Lesson):
    def test_one_in_an_endless_loop(self):
        """The compiler accepts it. It is named with its line, stopped with all others, and gets the next exercise."""
        self.broker("s1", "s2")
        one, loop = self.exercise("one"), self.exercise("loop", script=ENDLESS)
        self.simulated(self.world(s1=loop, s2=one))
        self.running("s2")
        self.wait_state("s1", "fault")
        self.assertRegex(self.do("list", "s1"), rf"s1: online, fault .*thymio-II: .*robot\.aesl:\d+: .*")
        self.assertIn("2 of 2 robots: stopped", self.do("stop", "all"))
        self.wait_state("s1", "stopped")
        done = self.deploy("all", "--project", self.exercise("two", edition=2), "--steps", "100%")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.running("s1", "s2")
        done = self.deploy("all", "--project", loop, "--steps", "1")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stdout, r"(?s)s1: failed: a fault: thymio-II: .*s2: as it was.*0 of 2 robots: well")
        self.assertIn("2 of 2 robots: stopped", self.do("stop", "all"))

    def test_one_in_a_loop_that_no_event_ends(self):
        """Nothing tells of it: a world counts instructions, a robot that serves itself asks its nodes."""
        self.broker("s1", "r1")
        self.simulated(self.world(s1=self.exercise("loop", script=SILENT)))
        self.joined("r1", script=SILENT)
        for name in ("s1", "r1"):
            self.wait_state(name, "fault")
            self.assertRegex(self.do("list", name), rf"{name}: online, fault .*thymio-II.*: .*it may be in an endless loop")
        self.assertIn("2 of 2 robots: stopped", self.do("stop", "all"))

    def test_one_that_is_unplugged(self):
        """Nobody says that it has stopped, or that it has the exercise; all others have."""
        self.broker("s1", "s2")
        one = self.exercise("one")
        self.simulated(self.world(s1=one, s2=one), "--chaos", '[{"kind": "unplugged", "node": "s2/thymio-II", "from": 1}]')
        self.wait_state("s2", "fault")
        self.assertIn("thymio-II is away", self.do("list", "s2"))
        stopped = self.refused("stop", "all")
        self.assertRegex(stopped, r"(?m)^s1: stopped$[\s\S]*^s2: .*thymio-II[\s\S]*^1 of 2 robots: stopped$")
        done = self.deploy("all", "--project", self.exercise("two", edition=2), "--steps", "100%")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("s1: well", done.stdout)
        self.assertRegex(done.stdout, r"s2: failed: rolled back: it did not start within 10 s: waiting for nodes .*thymio-II")
        self.assertIn("1 of 2 robots: well", done.stdout)

    def test_one_whose_wifi_comes_and_goes(self):
        """It stops without its broker, as its project says, and finds the exercise when it is back."""
        self.broker("s1", "s2")
        proxy = self.enterContext(Proxy(self.port))
        one = self.exercise("one")
        self.simulated(self.world(s1=one))
        away = self.simulated(self.world("away", s2=one), target=f"mqtts://localhost:{proxy.port}/{FLEET}")
        self.running("s1", "s2")
        proxy.is_cut = True
        away.wait_line(r"not in the fleet .* the robot stops, as its project says")
        self.assertRegex(self.refused("stop", "all", wait=2), r"(?m)^s2: did not answer \(lost\)$")
        with vagus("fleet", self.target, *words_of_deploy(self.broker_folder, "all", "--project", self.exercise("two", edition=2)),
                   "--steps", "100%", *self.login("operator"), "--wait", GIVE_UP_AFTER) as program:
            program.wait_lines(r"^s1: well$", r"^s2: wanted$")
            proxy.is_cut = False
            program.wait_line(r"^s2: well$")
            self.assertEqual(program.wait_end(), 0)
        self.is_told("s2", "thymio-II.edition", 2)


class Class(Lesson):
    def test_thirty_are_stopped_and_get_the_next_exercise(self):
        """`examples/alarm`, with thirty logins by one word. Robots are listed as they are counted."""
        self.init("t1..t30")
        self.serve_broker()
        self.enterContext(vagus("sim", ROOT / "examples/alarm/class.world.json", "--headless", "--fleet", self.target, "--tls-ca",
                                self.broker_folder / "ca.crt", "--logins", self.broker_folder))
        wait_until("not all were there", lambda: len(self.states()) == 30)
        lines = self.do("stop", "all").splitlines()
        self.assertEqual(lines, [*(f"t{number}: stopped" for number in range(1, 31)), "30 of 30 robots: stopped"])
        wait_until("not all were stopped", lambda: all(one["state"]["state"] == "stopped" for one in self.states().values()))
        lines = self.do("start", "t9..t11").splitlines()
        self.assertEqual(lines, ["t9: done", "t10: done", "t11: done", "3 of 3 robots: done"])
        self.assertRegex(self.desk("start", "t3..t1").stdout, r"t3\.\.t1: expected two numbers, the smaller one first")
        self.assertIn("30 of 30 robots: ", self.do("start", "all"))
        wait_until("not all ran", lambda: all(one["state"]["state"] == "running" for one in self.states().values()))
        done = self.deploy("all", "--project", self.exercise("two", edition=2))
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("30 of 30 robots: well", done.stdout)
        self.is_told("t30", "thymio-II.edition", 2)
        self.assertIn("30 of 30 robots: stopped", self.do("stop", "all"))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:])], verbosity=2, warnings="ignore")
