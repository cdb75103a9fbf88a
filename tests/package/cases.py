"""The Debian package: made, unpacked into a bare folder, and used from there. Nothing of the checkout helps it."""
import gzip
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = pathlib.Path(os.environ.get("VAGUS_BUILD", ROOT / "build/release"))
sys.path[:0] = [str(ROOT / "tests" / "support"), str(ROOT / "tests" / "studio")]
from harness import Program
from page import Page, http


def run(*words, **options):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=250, **options)
    return done.returncode, done.stdout, done.stderr


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="vagus-package-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        for words in (("cmake", "--build", BUILD, "--target", "vagus", "manual"),
                      ("cpack", "--config", BUILD / "CPackConfig.cmake", "-B", cls.folder / "made")):
            code, out, err = run(*words)
            assert code == 0, out + err
        (cls.deb,) = (cls.folder / "made").glob("*.deb")
        cls.bare = cls.folder / "bare"
        code, out, err = run("dpkg", "-x", cls.deb, cls.bare)
        assert code == 0, out + err
        cls.vagus = cls.bare / "usr/bin/vagus"

    def field(self, name):
        code, out, err = run("dpkg-deb", "--field", self.deb, name)
        self.assertEqual(code, 0, err)
        return out.strip()

    def test_its_fields_say_what_it_is_and_what_it_needs(self):
        version = run(self.vagus, "--version")[1].split()[-1]
        self.assertEqual((self.field("Package"), self.field("Version")), ("vagus", version))
        self.assertEqual(self.field("Architecture"), run("dpkg", "--print-architecture")[1].strip())
        self.assertRegex(self.field("Maintainer"), r"^[^<]+ <\S+@\S+>$")
        needs = self.field("Depends")
        for library in ("libc6", "libssl3", "libbox2d", "libboost-context1.81.0", "libfmt", "libpugixml"):
            self.assertIn(library, needs)
        self.assertTrue(self.field("Description").split("\n")[0])
        self.assertGreater(int(self.field("Installed-Size")), 1000)

    def test_it_holds_what_a_robot_needs_and_nothing_of_the_checkout(self):
        files = {path.relative_to(self.bare).as_posix() for path in self.bare.rglob("*") if path.is_file()}
        for path in ("usr/bin/vagus", "usr/share/vagus/examples/follow-wall/vagus.json", "usr/share/man/man1/vagus.1.gz",
                     "usr/share/bash-completion/completions/vagus", "usr/share/doc/vagus/copyright",
                     "usr/lib/systemd/system/vagus.service", "usr/lib/sysusers.d/vagus.conf"):
            self.assertIn(path, files)
        pages = set(re.findall(r"\]\((docs/[^)#]+)", (self.bare / "usr/share/doc/vagus/README.md").read_text()))
        self.assertGreaterEqual(pages, {"docs/field.md", "docs/recordings.md"})
        self.assertEqual([page for page in sorted(pages) if f"usr/share/doc/vagus/{page}" not in files], [])
        if (ROOT / "web/dist/index.html").exists():
            self.assertIn("usr/share/vagus/pages/index.html", files)
        self.assertFalse([path for path in files if path.endswith((".hpp", ".a", ".cmake")) or "/.vagus/" in path or "__pycache__" in path])
        self.assertNotIn(str(ROOT).encode(), self.vagus.read_bytes())

    def test_it_runs_from_wherever_it_is(self):
        elsewhere = self.folder / "opt"
        shutil.copytree(self.bare / "usr", elsewhere, dirs_exist_ok=True)
        home = self.folder / "home"
        home.mkdir()
        pages = [] if (elsewhere / "share/vagus/pages/index.html").exists() else self.pages()
        robot = self.folder / "robot"
        shutil.copytree(elsewhere / "share/vagus/examples/thymio", robot)
        with Program(elsewhere / "bin/vagus", "serve", robot, "--start", "--port", 0, *pages, cwd=home, env={"HOME": str(home)}) as served:
            port = int(served.wait_line(r"^serve http://127\.0\.0\.1:(\d+)/$").group(1))
            status, _, body = http(port)
            self.assertEqual(status, 200)
            self.assertIn("<!doctype html>", body.lower())
            token = (home / ".local/share/vagus/token").read_text(encoding="ascii").strip()
            with Page(port, token) as page:
                clock = page.watch("clock")
                page.wait(lambda: clock.value and clock.value["state"] == "running", "a run")
                start = page.watch("start")
                self.assertIn("follow-wall", page.wait(lambda: start.value and [one["id"] for one in start.value["examples"]], "the examples"))
            served.process.terminate()
            self.assertEqual(served.wait_end(), 0)

    def pages(self):
        """For where the studio's pages could not be built."""
        folder = self.folder / "pages"
        folder.mkdir()
        (folder / "index.html").write_text("<!doctype html>", encoding="utf-8")
        return ["--pages", folder]

    def test_its_manual_page_can_be_read(self):
        page = gzip.decompress((self.bare / "usr/share/man/man1/vagus.1.gz").read_bytes()).decode()
        self.assertRegex(page, r"(?m)^\.TH VAGUS 1 ")
        for verb in ("studio", "serve", "deploy", "net load", "plan run"):
            self.assertIn(f'.SS "vagus {verb}"\n', page)
        self.assertFalse(re.findall(r"(?m)^[.'](?!\\\"|TH |SH |SS |nf$|fi$|B |I |TP$).*$", page), "requests that are none")
        self.assertEqual(page.count("\n.nf\n"), page.count("\n.fi\n"))
        if shutil.which("man"):
            file = self.folder / "vagus.1"
            file.write_text(page, encoding="utf-8")
            code, out, err = run("man", "--warnings", "-l", file, env={**os.environ, "MANWIDTH": "110", "LC_ALL": "C.UTF-8"})
            self.assertEqual((code, err), (0, ""))
            self.assertIn("vagus deploy PROJECT ADDRESS", out)

    def test_the_completion_is_bash(self):
        self.assertEqual(run("bash", "-n", self.bare / "usr/share/bash-completion/completions/vagus")[0], 0)

    def test_the_unit_is_one_and_shuts_the_service_in(self):
        unit = (self.bare / "usr/lib/systemd/system/vagus.service").read_text(encoding="utf-8")
        for line in ("Type=notify", "User=vagus", "NoNewPrivileges=yes", "ProtectSystem=strict", "Restart=on-failure", "WatchdogSec=30",
                     "StateDirectory=vagus vagus/robot", "SupplementaryGroups=dialout", "StartLimitBurst=5"):
            self.assertIn(f"\n{line}\n", unit)
        # Whatever it was started with, it is stopped with.
        started = re.search(r"(?m)^ExecStart=(.*) --start (.*)$", unit)
        self.assertIn(f"\nExecStopPost=-{started.group(1)} --stop-only {started.group(2)}\n", unit)
        if shutil.which("systemd-analyze"):
            here = self.folder / "vagus.service"
            here.write_text(unit.replace("/usr/bin/vagus", str(self.vagus)).replace("Documentation=man:vagus(1)\n", ""), encoding="utf-8")
            code, out, err = run("systemd-analyze", "verify", "--man=no", here)
            self.assertEqual((code, [line for line in (out + err).split("\n") if "vagus" in line]), (0, []))

    def test_its_scripts_are_shell(self):
        control = self.folder / "control"
        self.assertEqual(run("dpkg-deb", "-e", self.deb, control)[0], 0)
        for name in ("postinst", "prerm", "postrm"):
            self.assertTrue(os.access(control / name, os.X_OK))
            self.assertEqual(run("sh", "-n", control / name)[0], 0)


if __name__ == "__main__":
    unittest.main(verbosity=2, warnings="ignore")
