"""The modelled link of worlds beside a real broker: the same stories of a fleet are heard the same."""
import os
import pathlib
import random
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from fleet import Case  # noqa: E402
from harness import Program, VAGUS  # noqa: E402

AGREEMENT = os.environ.get("VAGUS_FLEET_AGREEMENT", str(pathlib.Path(VAGUS).parent / "fleet_agreement"))
RUNS = 200 if os.environ.get("VAGUS_LONG") else 5
ROBOTS = 6


class Agreement(Case):
    def test_what_is_heard_over_the_modelled_link_is_heard_over_a_broker(self):
        seed = int(os.environ.get("VAGUS_SEED", random.randrange(1 << 32)))
        self.broker(*(f"r{i}" for i in range(ROBOTS)))
        program = self.enterContext(Program(AGREEMENT, self.target, self.broker_folder, RUNS, seed))
        for run in range(seed, seed + RUNS):
            program.wait_line(rf"^run {run}: ")
        status = program.wait_end()
        self.assertEqual(status, 0, f"seed {seed}: {program.lines}")
        heard = next((line for line in program.lines if line.startswith(f"{RUNS} runs, ")), None)
        self.assertIsNotNone(heard, f"seed {seed}: {program.lines}")
        print(f"figure: fleet, modelled link and broker: {heard} (seed {seed})")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:])], verbosity=2, warnings="ignore")
