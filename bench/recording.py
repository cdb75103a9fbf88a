#!/usr/bin/python3
"""What recording costs: the same run with and without --record, in turns.

    ./dev bench recording [ROUNDS]       7 of each, unless told

One robot: the wall follower of examples/follow-wall, two simulated minutes. Ten robots: examples/warehouse, ten simulated minutes.
Compared is the processor time of the whole process, so what its recording thread takes is counted, too; and the time that passed.
The least of all rounds counts: other programs on the machine only add. Goal: a recorded run takes less than 1.1 of the processor
time of the same run without.
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "tests" / "support")]
from harness import VAGUS

EXAMPLES = HERE.parent / "examples"
GOAL = 1.1
WALL, HALL = EXAMPLES / "follow-wall", EXAMPLES / "warehouse/hall.world.json"
RUNS = {
    "one robot": ["plan", "run", WALL / "WallFollow.plan.json", "--world", WALL / "hall.world.json", "--set", "walldist=30",
                  "--clock", "virtual", "--quiet"],
    "ten robots": ["sim", HALL, "--headless", "--speed", "max", "--duration", "600"],
}


def cost_of(command):
    """Seconds of processor time, and seconds."""
    begin = time.monotonic()
    program = subprocess.Popen([VAGUS, *command], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, _, used = os.wait4(program.pid, 0)
    return used.ru_utime + used.ru_stime, time.monotonic() - begin


def least(costs):
    return [min(column) for column in zip(*costs)]


def main():
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 7
    missed = False
    with tempfile.TemporaryDirectory(prefix="vagus-recording-") as folder:
        file = pathlib.Path(folder) / "run.mcap"
        for name, command in RUNS.items():
            plain, recorded = [], []
            for _ in range(rounds):
                plain.append(cost_of(command))
                recorded.append(cost_of([*command, "--record", file]))
            (cpu, wall), (recorded_cpu, recorded_wall) = least(plain), least(recorded)
            missed = missed or recorded_cpu / cpu >= GOAL
            print(f"figure: recording, {name}: {recorded_cpu / cpu:.3f} of the processor time ({cpu:.2f} s without), "
                  f"{recorded_wall / wall:.3f} of the time ({wall:.2f} s), {file.stat().st_size / 1e6:.1f} MB", flush=True)
    return missed


sys.exit(main())
