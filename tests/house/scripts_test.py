#!/usr/bin/env python3
"""What ./run and ./test say and build, on a stand-in checkout: their own scripts around a project of four targets, so
that nothing real is built. CMake, ninja, ctest and the terminal are the real ones."""
import os
import pathlib
import pty
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/support"))
from harness import Program  # noqa: E402

# Each program is a file; `slow` is what --quick and modules must not build. The steps of `vagus` wait until the file
# `go` is there.
PROJECT = """cmake_minimum_required(VERSION 3.25)
project(StandIn LANGUAGES NONE)
set(VAGUS_MODULES base hub)
enable_testing()
set(bin ${CMAKE_BINARY_DIR}/bin)
file(MAKE_DIRECTORY ${bin})
foreach(program base_test hub_test slow)
  add_custom_command(OUTPUT ${bin}/${program} COMMAND ${CMAKE_COMMAND} -E touch ${bin}/${program})
  add_custom_target(${program} ALL DEPENDS ${bin}/${program})
endforeach()
add_custom_command(OUTPUT ${bin}/vagus COMMAND sh ${CMAKE_SOURCE_DIR}/build_vagus ${bin}/vagus
  DEPENDS ${CMAKE_SOURCE_DIR}/build_vagus)
add_custom_target(vagus ALL DEPENDS ${bin}/vagus)
add_test(NAME base_test.Good COMMAND ${CMAKE_COMMAND} -E true)
add_test(NAME hub_test.Good COMMAND ${CMAKE_COMMAND} -E true)
add_test(NAME hub_test.Other COMMAND ${CMAKE_COMMAND} -E true)
add_test(NAME slow.Bad COMMAND ${CMAKE_COMMAND} -E false)
"""
PRESETS = """{ "version": 6, "configurePresets": [
  { "name": "release", "generator": "Ninja", "binaryDir": "${sourceDir}/build/${presetName}" } ] }
"""
BUILD_VAGUS = """printf '#!/bin/sh\\necho vagus "$@"\\n' >"$1" && chmod +x "$1"
"""
WAIT_FOR_GO = """while [ ! -e "$(dirname "$0")/go" ]; do sleep 0.05; done
"""


class Scripts(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="vagus-scripts-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.checkout = self.folder / "checkout"
        (self.checkout / "tools").mkdir(parents=True)
        for name in ("run", "test", "tools/setup.sh"):
            shutil.copy(ROOT / name, self.checkout / name)
        self.write("CMakeLists.txt", PROJECT)
        self.write("CMakePresets.json", PRESETS)
        self.write("build_vagus", BUILD_VAGUS)
        self.environment = {**os.environ, "VAGUS_NO_INSTALL": "1", "TERM": "xterm"}

    def write(self, name, text):
        (self.checkout / name).write_text(text)

    def call(self, *words, checkout=None):
        """Exit status, stdout and stderr, without a terminal."""
        checkout = checkout or self.checkout
        done = subprocess.run([str(checkout / words[0]), *words[1:]], cwd=checkout, env=self.environment, text=True,
                              capture_output=True, stdin=subprocess.DEVNULL, timeout=120)
        return done.returncode, done.stdout, done.stderr

    def on_terminal(self, *words):
        """Exit status, and all that appears on a terminal."""
        master, slave = pty.openpty()
        process = subprocess.Popen([str(self.checkout / words[0]), *words[1:]], cwd=self.checkout, env=self.environment,
                                   stdin=slave, stdout=slave, stderr=slave, start_new_session=True)
        os.close(slave)
        shown = b""
        while True:
            try:
                part = os.read(master, 4096)
            except OSError:  # the last who had the terminal open is gone
                break
            if not part:
                break
            shown += part
        os.close(master)
        return process.wait(timeout=120), shown.decode()

    def built(self, name):
        return (self.checkout / "build/release/bin" / name).exists()

    # ---- ./run ----

    def test_the_first_run_says_how_long_it_takes_and_later_runs_say_nothing(self):
        status, out, err = self.call("./run", "help")
        self.assertEqual((status, out), (0, "vagus help\n"), err)
        self.assertRegex(err, r"^vagus: building, about \w+ minutes the first time")
        self.assertEqual(self.call("./run", "help"), (0, "vagus help\n", ""))

    def test_a_terminal_shows_the_steps_of_ninja_and_nothing_where_all_is_built(self):
        status, shown = self.on_terminal("./run", "help")
        self.assertEqual(status, 0, shown)
        self.assertIn("[1/1] ", shown)
        self.assertEqual(self.on_terminal("./run", "help"), (0, "vagus help\r\n"))

    def test_without_a_terminal_a_line_from_time_to_time_says_how_far_it_is(self):
        self.write("build_vagus", WAIT_FOR_GO + BUILD_VAGUS)
        with Program(self.checkout / "run", "help", cwd=self.checkout,
                     env={**self.environment, "VAGUS_PROGRESS_EVERY": "0.2"}) as run:
            run.wait_line(r"^vagus: building release, (\d+/\d+, )?\d+:\d\d$")
            self.write("go", "")
            self.assertEqual(run.wait_end(), 0, run.lines)
            self.assertEqual(run.lines[-1], "vagus help")

    def test_a_build_that_fails_says_what_to_do(self):
        self.write("build_vagus", "echo it is broken >&2; exit 1\n")
        status, out, err = self.call("./run", "help")
        self.assertEqual((status, out), (1, ""))
        self.assertIn("it is broken\n", err)
        self.assertRegex(err, r"vagus: the build of release failed; the first error above is the one to read.*build\.log\n$")

    def test_a_build_folder_that_came_along_from_another_place_is_made_anew(self):
        self.assertEqual(self.call("./run", "help")[0], 0)
        copy = self.folder / "copy"
        shutil.copytree(self.checkout, copy)
        status, out, err = self.call("./run", "help", checkout=copy)
        self.assertEqual((status, out), (0, "vagus help\n"), err)
        self.assertIn(f"vagus: build/release was made in another place ({self.checkout}", err)
        self.assertEqual(self.call("./run", "help", checkout=copy), (0, "vagus help\n", ""))
        moved = self.folder / "moved"
        self.checkout.rename(moved)
        status, out, err = self.call("./run", "help", checkout=moved)
        self.assertEqual((status, out), (0, "vagus help\n"), err)
        # The same folder by another name is no other place.
        self.checkout.symlink_to(moved)
        self.assertEqual(self.call("./run", "help"), (0, "vagus help\n", ""))

    # ---- the studio's pages ----

    def pages(self, npm):
        """Sources of pages, and a Node and npm that stand in for the real ones."""
        tools = self.folder / "tools"
        for folder in (tools, self.checkout / "web", self.checkout / "src/serve/protocol"):
            folder.mkdir(parents=True)
        self.write("web/package-lock.json", "{}")
        self.write("src/serve/protocol/protocol.json", "{}")
        for name, text in (("node", "echo 22\n"), ("npm", npm)):
            (tools / name).write_text("#!/bin/sh\n" + text)
            (tools / name).chmod(0o755)
        self.environment["PATH"] = f"{tools}:{os.environ['PATH']}"

    def test_on_a_terminal_it_builds_the_pages_and_opens_the_studio(self):
        self.pages("""case $1 in ci) mkdir -p node_modules; touch node_modules/.package-lock.json ;;
run) mkdir -p dist; echo page >dist/index.html ;; esac
""")
        status, shown = self.on_terminal("./run")
        self.assertEqual(status, 0, shown)
        self.assertIn("building the studio's pages beside the program", shown)
        self.assertTrue(shown.endswith("vagus studio --example follow-wall\r\n"), shown)
        # Once they are there nothing is said; options are the studio's.
        self.assertEqual(self.on_terminal("./run", "--port", "0"), (0, "vagus studio --example follow-wall --port 0\r\n"))
        self.assertTrue(self.on_terminal("./run", "show")[1].startswith("vagus plan run examples/follow-wall/"))

    def test_without_npm_packages_it_says_so_and_shows_the_terminal(self):
        self.pages("echo no network >&2; exit 1\n")
        status, shown = self.on_terminal("./run")
        self.assertEqual(status, 0, shown)
        self.assertIn("no network", shown)
        self.assertIn("the packages of web/package-lock.json", shown)
        self.assertIn("without its pages there is no studio", shown)
        self.assertRegex(shown, r"vagus plan run examples/follow-wall/\S+ --world \S+\r\n$")

    def test_without_a_terminal_it_prints_the_lines_of_the_run(self):
        self.pages("exit 1\n")
        status, out, err = self.call("./run")
        self.assertEqual(status, 0, err)
        self.assertRegex(out, r"^vagus plan run examples/follow-wall/\S+ --world \S+ --clock virtual\n$")
        self.assertNotIn("pages", err)

    # ---- ./test ----

    def test_everything_counts_and_names_what_failed(self):
        status, out, err = self.call("./test")
        self.assertEqual(status, 1, err)
        self.assertEqual(out.splitlines()[-1], "3 passed, 1 failed")
        self.assertIn("slow.Bad", err)
        self.assertRegex(err, r"about \d+ minutes")

    def test_what_talks_has_a_second_try_and_is_named(self):
        races = "".join(f'''
add_test(NAME {name} COMMAND sh -c "test -e tried-{name} || {{ touch tried-{name}; false; }}")
set_tests_properties({name} PROPERTIES LABELS {label})''' for name, label in (("talk.Races", "system"),
                                                                            ("unit.Races", "unit")))
        self.write("CMakeLists.txt", PROJECT + races)
        status, out, err = self.call("./test", "Races")
        self.assertEqual((status, out.splitlines()[-1]), (1, "1 passed, 1 failed"), err)
        self.assertIn("vagus: passed at the second try only: talk.Races\n", err)
        self.assertNotIn("second try only: unit", err)
        self.assertEqual(self.call("./test", "Races")[:2], (0, "2 passed, 0 failed\n"))

    def test_many_that_fail_have_no_second_try(self):
        self.write("CMakeLists.txt", PROJECT + "".join(f'''
add_test(NAME talk.Broken{n} COMMAND sh -c "test -e tried{n} || {{ touch tried{n}; false; }}")
set_tests_properties(talk.Broken{n} PROPERTIES LABELS system)''' for n in range(6)))
        status, out, err = self.call("./test", "Broken")
        self.assertEqual((status, out.splitlines()[-1]), (1, "0 passed, 6 failed"), err)

    def test_quick_builds_and_runs_the_units_only(self):
        status, out, err = self.call("./test", "--quick")
        self.assertEqual((status, out), (0, "3 passed, 0 failed\n"), err)
        self.assertTrue(self.built("base_test") and self.built("hub_test"))
        self.assertFalse(self.built("slow") or self.built("vagus"))

    def test_the_name_of_a_module_builds_and_runs_its_tests_only(self):
        status, out, err = self.call("./test", "hub")
        self.assertEqual((status, out), (0, "2 passed, 0 failed\n"), err)
        self.assertFalse(self.built("base_test") or self.built("slow"))

    def test_anything_else_is_a_pattern(self):
        status, out, err = self.call("./test", "Other|base")
        self.assertEqual((status, out), (0, "2 passed, 0 failed\n"), err)

    def test_the_last_line_is_the_same_whatever_goes_wrong(self):
        for words, says in ((["nowhere"], 'no test has a name that matches "nowhere"'),
                            (["--quik"], "no option --quik"), (["hub", "base"], "one word, found 2")):
            status, out, err = self.call("./test", *words)
            self.assertEqual((status, out.splitlines()[-1]), (1, "0 passed, 1 failed"), err)
            self.assertIn(says, err)
        self.write("build_vagus", "exit 1\n")
        status, out, err = self.call("./test")
        self.assertEqual((status, out), (1, "0 passed, 1 failed\n"), err)

    def test_help_is_the_head_of_the_file(self):
        status, out, _ = self.call("./test", "--help")
        self.assertEqual(status, 0)
        self.assertIn("./test --quick", out)
        self.assertFalse((self.checkout / "build").exists())


if __name__ == "__main__":
    unittest.main()
