"""docs/recordings.md, followed: its commands run, and print what the page says."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.M | re.S)


def main():
    vagus = pathlib.Path(os.environ["VAGUS_BIN"])
    page = (ROOT / "docs/recordings.md").read_text()
    environment = {**os.environ, "PATH": f"{vagus.parent}:{os.environ['PATH']}"}
    commands = 0
    with tempfile.TemporaryDirectory(prefix="vagus-page-") as folder:
        os.symlink(ROOT / "examples", pathlib.Path(folder) / "examples")
        printed = ""
        for language, text in BLOCK.findall(page):
            if language == "sh":
                printed = ""
                for line in text.splitlines():
                    done = subprocess.run(["bash", "-c", line], cwd=folder, env=environment, capture_output=True, text=True,
                                          timeout=120)
                    # 3: the plan was ended by its escape button; 1: two runs part.
                    expected = 3 if "plan run" in line else 1 if "--with" in line else 0
                    if done.returncode != expected:
                        sys.exit(f"{line}\nended with {done.returncode}, not {expected}:\n{done.stdout}{done.stderr}")
                    printed += done.stdout
                    commands += 1
            elif not language and printed != text:
                sys.exit(f"the page says:\n{text}but it prints:\n{printed}")
    if commands < 9:
        sys.exit(f"only {commands} commands were found in the page")


main()
