"""Robots of a simulated world as members of a fleet, at a real broker, beside a robot that serves itself."""
import json
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from fleet import AESL, Case, PART, ROOT, SCRIPT  # noqa: E402
import projects  # noqa: E402
from harness import vagus, wait_until  # noqa: E402


class Worlds(Case):
    def world(self):
        """Two Thymios that run a project each, and one that runs none."""
        folder = self.folder / "world"
        projects.write(folder, "one/vagus.json", {"format": "vagus-project/1", "name": "Alarm", "scripts": ["robot.aesl"], "fleet": PART})
        projects.write(folder, "one/robot.aesl", AESL.format(script=SCRIPT))
        robots = [{"name": name, "type": "thymio2", "at": [0.5 + i, 0.5], "project": "one/"} for i, name in enumerate(("s1", "s2"))]
        return projects.write(folder, "class.world.json", {
            "format": "vagus-world/1", "size": [4, 2], "robots": [*robots, {"name": "other", "type": "thymio2", "at": [3, 1]}]})

    def simulated(self, *arguments):
        program = self.enterContext(vagus("sim", self.world(), "--headless", "--duration", 3600, "--fleet", self.target, "--tls-ca",
                                          self.broker_folder / "ca.crt", "--logins", self.broker_folder, *arguments))
        program.wait_lines(r'fleet: this robot is "s1"', r'fleet: this robot is "s2"')
        return program

    def test_they_hear_and_are_heard_and_stop(self):
        self.broker("r1", "s1", "s2")
        self.joined("r1")
        self.simulated()
        for name in ("r1", "s1", "s2"):
            self.wait_state(name, "running")
        self.assertEqual(set(self.states()), {"r1", "s1", "s2"})
        watch = self.watch()
        self.emit_alarm("r1")
        watch.wait_lines(r"^s1: thymio-II\.heard = 1$", r"^s2: thymio-II\.last = 7$")
        self.do("emit", "s1", "alarm", 5)
        watch.wait_line(r"^s1: thymio-II\.last = 5$")
        self.assertIn("3 of 3 robots: stopped", self.do("stop", "all"))
        self.wait_state("s1", "stopped")

    def test_a_class_of_thirty(self):
        """`examples/alarm`, with thirty logins by one word. Robots are listed as they are counted."""
        world = ["sim", ROOT / "examples/alarm/class.world.json", "--headless", "--fleet", f"mqtts://localhost:{self.port}/lab",
                 "--tls-ca", self.broker_folder / "ca.crt", "--logins", self.broker_folder]
        self.init()
        with vagus(*world) as without:
            self.assertEqual(without.wait_end(), 2)
            self.assertRegex("\n".join(without.lines), r"robot t1: .*there is no such login; `vagus fleet init .* --robot t1` makes it")
        self.init("t1..t30")
        self.serve_broker()
        self.enterContext(vagus(*world))
        wait_until("not all were there", lambda: len(self.states()) == 30)
        lines = self.do("stop", "all").splitlines()
        self.assertEqual(lines, [*(f"t{number}: stopped" for number in range(1, 31)), "30 of 30 robots: stopped"])

    def test_they_say_good_bye(self):
        self.broker("s1", "s2")
        self.simulated().stop()
        self.assertEqual({robot["connection"]["state"] for robot in map(self.one, ("s1", "s2"))}, {"offline"})

    def one(self, name):
        """What is known of a robot, also of one that has gone."""
        return json.loads(self.desk("list", name, "--json").stdout.splitlines()[0])

    def test_a_simulation_says_what_it_cannot_do(self):
        world = self.world()
        done = vagus("sim", world, "--headless", "--fleet", "mqtt://localhost:1/lab", "--speed", 2)
        with done:
            self.assertEqual(done.wait_end(), 2)
            self.assertIn("--fleet needs real time", "\n".join(done.lines))
        projects.write(self.folder, "plain.world.json", {"format": "vagus-world/1", "size": [2, 2], "robots": [
            {"name": "r1", "type": "thymio2", "at": [1, 1]}]})
        with vagus("sim", self.folder / "plain.world.json", "--headless", "--fleet", "mqtt://localhost:1/lab") as plain:
            self.assertEqual(plain.wait_end(), 2)
            self.assertIn('no robot of this world has a "project"', "\n".join(plain.lines))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:])], verbosity=2, warnings="ignore")
