"""Robots of one name: one of them is in the fleet, the others stay out, and both sides are told."""
import os
import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from fleet import PART  # noqa: E402
import projects  # noqa: E402
from harness import listening, Program, VAGUS, vagus, wait_until  # noqa: E402
from rollout import Versions, words_of_deploy  # noqa: E402

CROWD = os.environ.get("VAGUS_FLEET_CROWD", str(pathlib.Path(VAGUS).parent / "fleet_crowd"))
HOW_MANY = 100


class Twins(Versions):
    def world(self, *names):
        folder = self.folder / "class"
        projects.write(folder, "one/vagus.json", {"format": "vagus-project/1", "name": "Alarm", "fleet": PART})
        return projects.write(folder, "class.world.json", {"format": "vagus-world/1", "size": [8, 8], "robots": [
            {"name": name, "type": "thymio2", "at": [1 + i, 4], "project": "one/"} for i, name in enumerate(names)]})

    def simulated(self, world):
        return self.enterContext(vagus("sim", world, "--headless", "--fleet", self.target, "--tls-ca", self.broker_folder / "ca.crt",
                                       "--logins", self.broker_folder))

    def test_of_a_hundred_that_come_at_once_one_is_in_the_fleet(self):
        """Also when their broker is started again, and all of them ask at once."""
        broker, target = self.plain_broker()
        crowd = self.enterContext(Program(CROWD, target, HOW_MANY, 0, "r1"))
        only = rf"^1 in, {HOW_MANY - 1} out$"
        crowd.wait_line(only)
        self.assertEqual(self.command(target, "stop", "all").stdout, "r1: stopped\n1 of 1 robots: stopped\n")
        port = target.rsplit(":", 1)[1].split("/")[0]
        broker.kill()
        crowd.wait_line("^0 in, 0 out$")
        self.enterContext(Program(*broker.arguments[:2], self.folder / f"plain-{port}.conf"))
        crowd.wait_line(only)
        self.assertEqual(self.command(target, "stop", "all").stdout, "r1: stopped\n1 of 1 robots: stopped\n")

    def test_both_sides_are_told(self):
        self.broker("r1")
        first = self.joined("r1")
        second = self.robot("r1")
        second.wait_line(r'"r1" of the fleet "lab": another robot has this name, and answers; this one stays out of the fleet until '
                         r"the name is free. Give each robot a name of its own")
        first.wait_line(r'fleet: another program wants the name "r1", too, and was told to stay out')
        wait_until("who lists robots is not told", lambda: "; two programs want this name; the other one stays out" in self.do("list"))
        second.wait_line(r"the robot stops, as its project says")

    def test_worlds_that_are_started_again_and_again(self):
        """The one that is killed leaves its names to the other, and does not get them back."""
        self.broker("s1", "s2")
        world = self.world("s1", "s2")
        mine = [rf'fleet: this robot is "{name}"' for name in ("s1", "s2")]
        taken = [rf'"{name}" of the fleet "lab": another robot has this name' for name in ("s1", "s2")]
        holder = self.simulated(world)
        holder.wait_lines(*mine)
        for _ in range(3):
            other = self.simulated(world)
            other.wait_lines(*taken)
            holder.kill()
            other.wait_lines(*mine)
            holder = other
        self.assertIn("2 of 2 robots: stopped", self.do("stop", "all"))

    def test_two_of_one_name_in_a_world_are_refused(self):
        self.init("s1")
        program = self.simulated(self.world("s1", "s1", "s1"))
        self.assertEqual(program.wait_end(), 2, program.lines)
        self.assertRegex("\n".join(program.lines), r'class\.world\.json:\d+:\d+: robots\[1\]\.name: "s1" is taken; choose another')


class Numbers(Versions):
    def test_two_nodes_of_one_number_are_told_to_the_fleet(self):
        self.broker("r1")
        switch = self.enterContext(vagus("switch", "--listen", "tcp:127.0.0.1:0"))
        bus = f"tcp:127.0.0.1:{listening(switch)}"
        self.enterContext(vagus("node", "--id", 1, "--name", "rover", "--connect", bus))
        folder = projects.bus(self.folder / "rover", bus, script="", fleet={"name": "lab"})
        projects.write(folder, "pages/index.html", "<!doctype html>\n")
        robot = self.enterContext(vagus("serve", folder, "--start", "--port", 0, "--data", folder / "data", "--config", folder / "config",
                                        "--pages", folder / "pages", "--fleet", self.target, "--robot", "r1", *self.login("r1")))
        robot.wait_line("fleet: this robot is")
        self.wait_state("r1", "running")
        self.enterContext(vagus("node", "--id", 1, "--name", "twin", "--connect", bus))
        said = "; two nodes have the number 1, one of them rover; give one of them another"
        wait_until("nobody is told", lambda: said in self.do("list"))


class OneFolder(Versions):
    """Two robots that are served from one folder: one of them can be given versions, and each says what came of its own."""

    def serve_both(self, folder):
        programs = [self.joined(name, folder=folder) for name in ("r1", "r2")]
        for name in ("r1", "r2"):
            self.wait_state(name, "running")
        return programs

    def deploy(self, *arguments):
        return self.desk(*words_of_deploy(self.broker_folder, *arguments))

    def test_each_remembers_what_came_of_its_own(self):
        self.broker("r1", "r2")
        folder = self.folder / "both"
        first, second = self.serve_both(folder)
        done = self.deploy("all", "--project", self.version())
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stdout, r"(?s)r1: well.*r2: failed: refused: .*another robot that is served from this folder keeps its "
                         r"versions in it; give each robot a copy of the project.*1 of 2 robots: well")
        first.stop(), second.stop()
        self.serve_both(folder)
        # It has the version, and goes back from it; the other one has none.
        done = self.desk("deploy", "r1", "--rollback")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(self.desk("tell", "r1", "thymio-II.edition", wait=1).stdout, r"r1: not done: .*edition")

    def test_what_an_earlier_version_remembered_is_kept(self):
        """It is that of the first robot that can be given versions: the same wish is not done once more."""
        self.broker("r1")
        folder = self.folder / "one"
        first = self.joined("r1", folder=folder)
        self.wait_state("r1", "running")
        self.assertEqual(self.deploy("r1", "--project", self.version()).returncode, 0)
        first.stop()
        (folder / ".vagus/want/r1.json").rename(folder / ".vagus/want.json")
        again = self.joined("r1", folder=folder)
        self.wait_state("r1", "running")
        self.is_told("r1", "thymio-II.edition", 2)
        again.drain()
        self.assertFalse([line for line in again.lines if "roll-out" in line])
        self.assertEqual([file.name for file in (folder / ".vagus/want").iterdir()], ["r1.json"])
        self.assertFalse((folder / ".vagus/want.json").exists())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:])], verbosity=2, warnings="ignore")
