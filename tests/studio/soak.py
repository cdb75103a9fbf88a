"""The studio under load for a while: `./dev soak [SECONDS]` (600). Ten pages watch everything, one runs, pauses, stops, edits and
kills; prints figures, and fails if the server dies, forgets somebody or grows.

Memory counts from the end of the first quarter on: what fills once (events that are kept, pages, compiled scripts) is no leak.
"""
import os
import random
import signal
import sys
import time

import projects
from page import Studio

KILLS = 200
PAGES = 10
GROWTH_MAX = 32 << 20  # bytes, from the first quarter to the end
TOPICS = ("studio", "clock", "robot", "plan", "scene", "breakpoints", "files", "findings", "scripts", "network", "console", "happenings",
          "poses", "rays")


def a_round(studio, page, clock, dice, number):
    """Start, look, change something, end or be killed."""
    page.do("run.start")
    page.wait(lambda: clock.value["state"] == "running", "a run")
    page.do("clock.speed", speed=dice.choice((1, 5, 20)))
    page.do("event.send", name="go", args=[dice.randrange(-200, 200)])
    page.edit(projects.DOC, (0, 1 if number > 0 else 0, " " if number % 2 else "\n"))
    page.do("world.put", kind="cylinder", at=[dice.uniform(1.5, 2), dice.uniform(0.5, 2)], radius=0.02)
    now = clock.value["t"]
    page.wait(lambda: clock.value["t"] > now + dice.uniform(0, 1), "time")
    if dice.random() < 0.3:
        page.do("stop")
    for run in studio.children():
        os.kill(run, signal.SIGKILL)
    page.wait(lambda: clock.value["state"] == "dead", "the death of the run")


def soak(seconds, seed):
    dice = random.Random(seed)
    with Studio() as studio:
        page = studio.page()
        clock = page.watch("clock")
        page.do("project.open", path=str(projects.thymio(studio.folder / "project")))
        others = [studio.page() for _ in range(PAGES - 1)]
        seen = [{topic: other.watch(topic) for topic in TOPICS} for other in others]
        begun, number, memory = time.monotonic(), 0, []
        rounds = max(2, round(KILLS * seconds / 600))
        for number in range(rounds):
            a_round(studio, page, clock, dice, number)
            memory.append(studio.memory())
            for topics in seen:  # what they have read is not what is measured
                for topic in topics.values():
                    topic.items.clear()
                    topic.frames.clear()
            left = begun + seconds * (number + 1) / rounds - time.monotonic()
            if left > 0:
                page.do("run.start")
                at = clock.value["t"]
                page.wait(lambda: clock.value["state"] == "running" and time.monotonic() > begun + seconds * (number + 1) / rounds
                          or clock.value["t"] < at, "the next round")
        quarter, end = memory[len(memory) // 4], memory[-1]
        messages = sum(topic.messages for topics in seen for topic in topics.values())
        print(f"figure: {rounds} runs killed in {time.monotonic() - begun:.0f} s, {len(others) + 1} pages, {messages} messages to them")
        print(f"figure: server {quarter / 1e6:.1f} MB after a quarter, {end / 1e6:.1f} MB at the end, {max(memory) / 1e6:.1f} MB at most")
        faults = [fault for one in [page, *others] for fault in one.faults[:3]]
        gone = [one.closed for one in others if one.closed]
        lost = sum(topic.left_out for topics in seen for topic in topics.values())
        print(f"figure: {lost} items left out, {len(gone)} pages lost, {len(faults)} messages that are not as promised")
        for one in [page, *others]:
            one.close()
        good = studio.program.running() and not faults and not gone and end - quarter < GROWTH_MAX
        print("soak: good" if good else f"soak: BAD {faults} {gone} {studio.log()[-5:]}")
        return good


if __name__ == "__main__":
    given_seed = int(os.environ.get("VAGUS_SEED") or random.SystemRandom().randrange(1 << 32))
    print(f"seed: VAGUS_SEED={given_seed}")
    sys.exit(0 if soak(float(sys.argv[1]) if len(sys.argv) > 1 else 600.0, given_seed) else 1)
