#!/usr/bin/env python3
"""Does what docs/tutorial.md tells a newcomer to do, command by command, and expects that each succeeds.

Marks in the page: `<!-- file NAME -->` the block is the text of that file, `<!-- edit NAME -->` its first line's member
takes the place of the member of the same name in the file, `<!-- shell -->` every line is run.
"""

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
BLOCK = re.compile(r"<!-- (file|edit|shell)(?: (\S+))? -->\n```\w+\n(.*?)```", re.S)
ENDED_WELL = {0, 3, 5}  # OK, Interrupted, --max-time
MAX_SECONDS = 100


def replace_member(text, member):
    """A member ends where a line closes at the indentation of its first line."""
    lines, new = text.splitlines(), member.splitlines()
    key = re.match(r'\s*"\w+":', new[0]).group()
    first = next(i for i, line in enumerate(lines) if line.startswith(key))
    indentation = re.match(r" *", key).group()
    last = first
    if not re.search(r"[}\]\"\d],?$", lines[first]) or lines[first].rstrip().endswith("{"):
        last = next(i for i in range(first + 1, len(lines)) if re.match(indentation + r"[}\]]", lines[i]))
    if not lines[last].endswith(","):
        new[-1] = new[-1].removesuffix(",")
    return "\n".join(lines[:first] + new + lines[last + 1 :]) + "\n"


def run(command, folder):
    words = shlex.split(command)
    assert words[0] == "./run", command
    done = subprocess.run([VAGUS] + words[1:], cwd=folder, capture_output=True, text=True, timeout=MAX_SECONDS)
    assert done.returncode in ENDED_WELL, f"{command}\nexit status {done.returncode}\n{done.stderr}"
    assert "error" not in done.stderr, f"{command}\n{done.stderr}"
    return done.stdout


def main():
    done = 0
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        shutil.copytree(ROOT / "examples", folder / "examples")
        output = {}
        for what, name, text in BLOCK.findall((ROOT / "docs/tutorial.md").read_text()):
            if what == "file":
                (folder / name).write_text(text)
            elif what == "edit":
                (folder / name).write_text(replace_member((folder / name).read_text(), text))
            else:
                for command in text.splitlines():
                    output[command] = run(command, folder)
                    done += 1
    interrupted = [text for command, text in output.items() if "way=500" in command]
    assert '"event":"TouchSensorPressed","target":"backOff"' in interrupted[-1], interrupted[-1][-2000:]
    assert done >= 9, f"only {done} commands found in the page: are the marks still there?"
    print(f"{done} commands of the tutorial did what the page says")


if __name__ == "__main__":
    sys.exit(main())
