"""A page of docs/, followed: its commands run, and print what the page says. One that ends with another exit status than 0
says so: `vagus test . # ends with 1`. Usage: page_test.py PAGE COMMANDS, the number of commands that it has at least."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.M | re.S)
ENDS_WITH = re.compile(r"# ends with (\d+)$")


def main():
    vagus = pathlib.Path(os.environ["VAGUS_BIN"])
    page = (ROOT / "docs" / sys.argv[1]).read_text()
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
                    says = ENDS_WITH.search(line)
                    expected = int(says[1]) if says else 0
                    if done.returncode != expected:
                        sys.exit(f"{line}\nended with {done.returncode}, not {expected}:\n{done.stdout}{done.stderr}")
                    printed += done.stdout
                    commands += 1
            elif not language and printed != text:
                sys.exit(f"the page says:\n{text}but it prints:\n{printed}")
    if commands < int(sys.argv[2]):
        sys.exit(f"only {commands} commands were found in the page")


main()
