"""The keeper of a fleet beside a real broker: killed in the middle of its work, started twice, without rights."""
import os
import pathlib
import random
import signal
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from fleet import Case, FLEET  # noqa: E402
from harness import Program, VAGUS, vagus  # noqa: E402

WORKERS = os.environ.get("VAGUS_FLEET_WORKERS", str(pathlib.Path(VAGUS).parent / "fleet_workers"))
HOW_MANY, TASKS = 12, 1000
SERVES = rf'keeper of the fleet "{FLEET}": serves, epoch (\d+)'


def children(process):
    text = pathlib.Path(f"/proc/{process}/task/{process}/children").read_text(encoding="ascii")
    return [int(child) for child in text.split()]


def words_of(process):
    try:
        return pathlib.Path(f"/proc/{process}/cmdline").read_bytes().decode().split("\0")
    except OSError:
        return []


class Keeper(Case):
    def keeper_of(self, broker):
        """The process of the keeper beside that broker."""
        found = [child for child in children(broker.process.pid) if "keep" in words_of(child)]
        return found[0] if found else None

    def workers(self, seed):
        return self.enterContext(Program(WORKERS, self.target, self.broker_folder, HOW_MANY, TASKS, seed))

    def keep(self, login="keeper"):
        return self.enterContext(vagus("fleet", self.target, "keep", *self.login(login)))

    def test_killed_in_the_middle_of_a_thousand_tasks(self):
        seed = random.randrange(1 << 32)
        broker = self.broker("boss", *(f"w{i}" for i in range(HOW_MANY)))
        first = int(broker.wait_line(SERVES).group(1))
        workers = self.workers(seed)
        for finished in (200, 600):
            workers.wait_line(rf"^finished {finished}$")
            os.kill(self.keeper_of(broker), signal.SIGKILL)
            broker.wait_line(r"the keeper of lab was ended by signal 9, and is started again")
        self.assertGreater(int(broker.wait_line(SERVES).group(1)), first)
        self.assertEqual(workers.wait_end(), 0, f"seed {seed}: {workers.lines}")
        self.assertIn(f"all {TASKS} tasks are finished", workers.lines)

    def test_a_second_one_stays_out_until_the_first_is_killed(self):
        self.init()
        self.serve_broker("--fleet", "other")
        first = self.keep()
        before = int(first.wait_line(SERVES).group(1))
        second = self.keep()
        second.wait_line(r"stays out: there is another keeper, keeper-[0-9a-f]+")
        first.kill()
        self.assertGreater(int(second.wait_line(SERVES).group(1)), before)

    def test_a_user_without_the_right_is_told_so(self):
        self.broker("r1")
        other = self.keep(login="r1")
        other.wait_line(r"keeper: the broker (refuses|does not pass on) what it publishes")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:])], verbosity=2, warnings="ignore")
