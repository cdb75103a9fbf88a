"""A fleet in which the calendar of some computers is wrong by years, or jumps: nothing depends on it but certificates."""
import os
import pathlib
import signal
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from rollout import Versions  # noqa: E402
from harness import Program, VAGUS, vagus, wait_until  # noqa: E402
from keeper import SERVES, WORKERS  # noqa: E402

LIBRARY = os.environ.get("VAGUS_WRONG_CLOCK", str(pathlib.Path(VAGUS).parent.parent / "tests/fleet/libwrong_clock.so"))
DAY = 24 * 3600
YEARS = 10_000 * DAY


def wrong_by(seconds, jumps=False):
    return {"LD_PRELOAD": LIBRARY, "WRONG_CLOCK_BY": str(seconds), **({"WRONG_CLOCK_JUMPS": "1"} if jumps else {})}


JUMPS = wrong_by(YEARS, jumps=True)


def can_be_wrong():
    """Programs under a sanitizer take no library before its own."""
    return subprocess.run([VAGUS, "--version"], env={**os.environ, **JUMPS}, capture_output=True, check=False).returncode == 0


@unittest.skipUnless(can_be_wrong(), "no library can be loaded into this program")
class Clocks(Versions):
    def robots(self):
        """One whose clock is right, and one whose clock jumps by years each second."""
        _, target = self.plain_broker()
        self.plain = target
        self.joined("r1", target=target)
        self.joined("r2", target=target, env=JUMPS)
        self.enterContext(vagus("fleet", target, "keep", env=JUMPS)).wait_line(r"serves, epoch \d+")

    @property
    def target(self):
        return self.plain if hasattr(self, "plain") else super().target

    def login(self, name):
        return [] if hasattr(self, "plain") else super().login(name)

    def by_wrong_clock(self, *words):
        return self.command(self.plain, *words, env=JUMPS)

    def test_robots_and_operators_whose_clocks_jump_are_as_all_others(self):
        self.robots()
        for name in ("r1", "r2"):
            self.wait_state(name, "running")
        watch = self.watch()
        self.emit_alarm("r2")
        watch.wait_line(r"^r1: thymio-II\.heard = 1$")
        self.emit_alarm("r1")
        watch.wait_line(r"^r2: thymio-II\.heard = 1$")
        for words in (("pause", "all"), ("continue", "all"), ("stop", "all"), ("start", "all"), ("list",)):
            done = self.by_wrong_clock(*words)
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertNotRegex(done.stdout, "stale|did not answer|too late")
        done = self.by_wrong_clock("deploy", "all", "--project", self.version(), "--steps", "1")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("2 of 2 robots: well", done.stdout)
        self.is_told("r2", "thymio-II.edition", 2)

    def test_a_robot_whose_clock_jumps_is_lost_and_comes_back(self):
        self.robots()
        self.wait_state("r2", "running")
        other = self.joined("r3", target=self.plain, env=JUMPS)
        self.wait_state("r3", "running")
        other.kill()
        wait_until("it is never missed", lambda: self.states()["r3"]["connection"]["state"] == "lost")
        self.joined("r3", target=self.plain, env=wrong_by(-YEARS))
        self.wait_state("r3", "running")

    def test_a_keeper_of_another_day_leaves_its_tasks_to_the_next_one(self):
        self.init("boss", *(f"w{i}" for i in range(4)))
        self.serve_broker("--fleet", "other")
        words = ("fleet", self.target, "keep", *self.login("keeper"))
        first = self.enterContext(vagus(*words, env=wrong_by(20 * DAY)))
        epoch = int(first.wait_line(SERVES).group(1))
        workers = self.enterContext(Program(WORKERS, self.target, self.broker_folder, 4, 400, 1))
        workers.wait_line(r"^finished 100$")
        first.signal(signal.SIGKILL)
        second = self.enterContext(vagus(*words))
        self.assertGreater(int(second.wait_line(SERVES).group(1)), epoch)
        self.assertEqual(workers.wait_end(), 0, workers.lines)
        self.assertIn("all 400 tasks are finished", workers.lines)

    def test_who_cannot_check_the_certificate_by_its_clock_is_told_so(self):
        self.broker("r1")
        why = r"is not valid on the date of this computer's clock"
        self.robot("r1", env=wrong_by(-YEARS)).wait_line(why)
        done = self.command(self.target, "list", *self.login("looker"), "--wait", 3, env=wrong_by(-YEARS))
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stdout, why)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:])], verbosity=2, warnings="ignore")
