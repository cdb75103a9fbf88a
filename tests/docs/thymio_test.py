#!/usr/bin/env python3
"""Does what docs/aesl.md and docs/thymio.md tell a user of a Thymio to do, and compares the tables of docs/thymio.md with
what the simulated robot says about itself.

Marks in the pages: `<!-- file NAME -->` the block is saved under that name and must compile without error or warning,
`<!-- wrong: TEXT -->` its first error says TEXT, `<!-- shell -->` every line is run (without a terminal it ends by itself),
`<!-- net -->` every line is run against a simulated robot in the place of the real one.
"""

import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
VAGUS = os.environ["VAGUS_BIN"]
BLOCK = re.compile(r"<!-- (file|wrong:|shell|net) ?(.*?) ?-->\n```\w+\n(.*?)```", re.S)
ROW = re.compile(r"^\| `([^`]+)` \|(.*)$", re.M)
TARGET = re.compile(r"(ser:/dev/ttyACM0|tcp:127\.0\.0\.1:33333)")
MAX_SECONDS = 100


def vagus(words, folder, text=None):
    return subprocess.run([VAGUS] + words, cwd=folder, capture_output=True, text=True, input=text, timeout=MAX_SECONDS)


def check_compiles(name, text, folder):
    (folder / name).write_text(text)
    done = vagus(["compile", "--node", "thymio-II", name], folder)
    assert done.returncode == 0 and not done.stderr, f"{text}\n{done.stderr}"


def check_is_wrong(sentence, text, folder):
    done = vagus(["compile", "--node", "thymio-II", "-"], folder, text)
    assert done.returncode == 1 and sentence in done.stderr.splitlines()[0], f"{text}\n{done.stderr}"


def check_runs(command, folder, target):
    words = shlex.split(TARGET.sub(target, command) if target else command)
    assert words[0] == "./run", command
    done = vagus(words[1:], folder)
    assert done.returncode == 0, f"{command}\nexit status {done.returncode}\n{done.stdout}{done.stderr}"


class Robot:
    """A simulated Thymio on a port of its own, as long as the `with` lasts."""

    def __init__(self, folder):
        world = "examples/thymio/arena.world.json"
        self.process = subprocess.Popen([VAGUS, "sim", world, "--headless", "--listen", "tcp:127.0.0.1:0",
                                         "--duration", "600"], cwd=folder, stdout=subprocess.PIPE, text=True)

    def __enter__(self):
        first = self.process.stdout.readline()
        assert first.startswith("listening "), first
        return first.split()[1]

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()


def follow(page, folder, target):
    done = 0
    for what, name, text in BLOCK.findall((ROOT / "docs" / page).read_text()):
        if what == "file":
            check_compiles(name, text, folder)
        elif what == "wrong:":
            check_is_wrong(name, text, folder)
        else:
            for command in text.splitlines():
                check_runs(command, folder, target if what == "net" else None)
        done += 1
    marked = len(re.findall(r"^```aesl", (ROOT / "docs" / page).read_text(), re.M))
    assert done >= marked, f"{page}: {marked} examples, {done} of all blocks have a mark"
    return done


def rows_of(page, heading):
    section = page.split(f"## {heading}\n", 1)[1].split("\n## ", 1)[0]
    return [(name, [cell.strip() for cell in rest.split("|")]) for name, rest in ROW.findall(section)]


def check_tables(target, folder):
    node = json.loads(vagus(["net", target, "describe", "thymio-II", "--json"], folder).stdout)
    page = (ROOT / "docs/thymio.md").read_text()
    variables = [(name, int(cells[0])) for name, cells in rows_of(page, "Variables")]
    assert variables == [(v["name"], v["size"]) for v in node["variables"]], "the table of variables has drifted"
    events = [name for name, _ in rows_of(page, "Events")]
    assert events == [event["name"] for event in node["localEvents"]], "the table of events has drifted"
    functions = sorted(name for name, _ in rows_of(page, "Functions of the robot"))
    described = sorted(n["name"] + "(" + ", ".join(p["name"] for p in n["params"]) + ")" for n in node["natives"])
    assert functions == described, f"functions differ: {set(functions) ^ set(described)}"


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        shutil.copytree(ROOT / "examples", folder / "examples")
        with Robot(folder) as target:
            check_tables(target, folder)
            done = follow("aesl.md", folder, target) + follow("thymio.md", folder, target)
    assert done >= 20, f"only {done} blocks found in the pages: are the marks still there?"
    print(f"{done} blocks of the guide did what the pages say")


if __name__ == "__main__":
    sys.exit(main())
