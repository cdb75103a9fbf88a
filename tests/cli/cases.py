"""What `vagus` promises on the command line: exit codes, where words go, formats, the terminal given back.

Waiting is always for a condition; GIVE_UP_AFTER only says when to give up.
"""
import fcntl
import json
import math
import os
import pathlib
import pty
import re
import select
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
VAGUS = os.environ.get("VAGUS_BIN", str(ROOT / "build/release/bin/vagus"))
GIVE_UP_AFTER = 60.0
VERBS = re.findall(r"^VERB\((\w+)\)", (ROOT / "src/cli/verbs.def").read_text(), re.MULTILINE)

WORLD = """{
  "format": "vagus-world/1",
  "name": "yard",
  "size": [2, 1],
  "robots": [{ "name": "rob", "type": "thymio2", "at": [0.5, 0.5], "node": 7 }]
}
"""
PROJECT = """<!DOCTYPE aesl-source>
<network>
<event size="1" name="count"/>
<node nodeId="7" name="thymio-II">var n = 0
timer.period[0] = 100
onevent timer0
n += STEP
emit count n
</node>
</network>
"""
# Drives in bends that differ, hits its neighbours, and tells how often it has sensed.
RESTLESS = """var n = 0
onevent prox
n += 1
motor.left.target = (n * 37) % 500
motor.right.target = (n * 29) % 500
emit sensed n
"""
# The worked example of docs/spec/aesl-language.md, section 5.2, and the words that stand there.
ROVER = """<!DOCTYPE aesl-source>
<network>


<!--list of global events-->
<event size="1" name="setspeed"/>
<event size="2" name="status"/>


<!--list of constants-->
<constant value="40" name="PERIOD"/>
<constant value="-3" name="DRIFT"/>


<!--node rover-->
<node nodeId="1" name="rover">var speed = 0
var ticks = 0

timer.period = PERIOD

onevent timer
ticks += 1
if speed &lt; 100 and ticks > 2 then
	speed += DRIFT &amp; 0xf
end
when speed >= 50 do
	emit status [speed, ticks]
end

onevent setspeed
speed = args[0]
</node>
</network>
"""


class Screen:
    """A program on a terminal of its own; what it paints is kept as bytes."""

    def __init__(self, *arguments, columns=80, rows=24, env=None, program=VAGUS):
        self.master, self.slave = pty.openpty()
        self.resize(columns, rows)
        self.before = termios.tcgetattr(self.slave)
        self.process = subprocess.Popen([program, *map(str, arguments)], stdin=self.slave, stdout=self.slave,
                                        stderr=self.slave, start_new_session=True, preexec_fn=self._own_terminal,
                                        env={**os.environ, "TERM": "xterm-256color", "NO_COLOR": "1", "LC_ALL": "C.UTF-8",
                                             **(env or {})})
        self.bytes = b""

    def _own_terminal(self):
        fcntl.ioctl(0, termios.TIOCSCTTY, 0)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        os.close(self.master)
        os.close(self.slave)

    def resize(self, columns, rows):
        fcntl.ioctl(self.slave, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))

    def type(self, keys):
        os.write(self.master, keys.encode())

    def read(self, seconds):
        if select.select([self.master], [], [], seconds)[0]:
            self.bytes += os.read(self.master, 65536)

    def wait_for(self, text):
        """Reads until the program has painted the text; forgets what came before it."""
        deadline = time.monotonic() + GIVE_UP_AFTER
        wanted = text.encode()
        while wanted not in self.bytes:
            if time.monotonic() > deadline:
                raise AssertionError(f"never painted {text!r}; the end of what it painted: {self.bytes[-2000:]!r}")
            self.read(0.05)
        self.bytes = self.bytes[self.bytes.index(wanted) + len(wanted):]

    def wait_page(self, text):
        """Asks for the whole page (Ctrl-L) until the text stands on it: changes alone may leave letters out."""
        deadline = time.monotonic() + GIVE_UP_AFTER
        self.bytes = b""
        while text.encode() not in self.bytes:
            if time.monotonic() > deadline:
                raise AssertionError(f"never showed {text!r}; the end of what it painted: {self.bytes[-2000:]!r}")
            self.type("\x0c")
            self.read(0.05)

    def wait_until(self, condition, what):
        deadline = time.monotonic() + GIVE_UP_AFTER
        while not condition():
            if time.monotonic() > deadline:
                raise AssertionError(f"never came: {what}")
            self.read(0.05)

    def wait_end(self):
        self.wait_until(lambda: self.process.poll() is not None, "the end")
        while select.select([self.master], [], [], 0)[0]:
            self.bytes += os.read(self.master, 65536)
        return self.process.returncode

    def modes_are_back(self):
        return termios.tcgetattr(self.slave) == self.before

    def given_back(self):
        """Input modes as before, cursor visible, the page of the shell again, in this order at the end."""
        return self.modes_are_back() and self.bytes.find(b"\x1b[?25h") >= 0 and \
            self.bytes.rfind(b"\x1b[?1049l") > self.bytes.rfind(b"\x1b[?1049h")


class Cli(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-cli-")))
        self.world = self.file("yard.world.json", WORLD)
        self.script = self.file("count.aesl", PROJECT.replace("STEP", "1"))

    def file(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def run_vagus(self, *arguments, status=0, stdin=None):
        done = subprocess.run([VAGUS, *map(str, arguments)], capture_output=True, text=True, timeout=GIVE_UP_AFTER,
                              cwd=self.folder, input=stdin)
        self.assertEqual(done.returncode, status, f"{arguments}: {done.stdout}\n{done.stderr}")
        return done

    # ---- all verbs ----

    def test_help_of_every_verb_has_an_example(self):
        top = self.run_vagus("--help").stdout
        for verb in VERBS:
            self.assertIn(f"  {verb} ", top)
            page = self.run_vagus(verb, "--help")
            self.assertIn("Example", page.stdout)
            self.assertIn(f"vagus {verb} ", page.stdout.split("Example")[1])
            self.assertEqual(page.stderr, "")

    def test_a_file_that_a_world_names_and_that_is_not_there_is_named_with_its_place(self):
        for member, place in [('"robots": [{ "name": "r", "type": "thymio2", "at": [1, 1], "script": "none.aesl" }]',
                               "2:72: robots[0].script"),
                              ('"ground": { "image": "none.png" }', "2:24: ground.image")]:
            world = self.file("w.world.json", '{ "format": "vagus-world/1", "size": [2, 2],\n  ' + member + "}")
            said = self.run_vagus("sim", world, "--headless", status=2).stderr
            self.assertTrue(said.startswith(f"vagus: {world}:{place}: "), said)
            self.assertIn("cannot be read: No such file or directory", said)

    def test_version_is_one_line(self):
        self.assertRegex(self.run_vagus("--version").stdout, r"^vagus \d+\.\d+\.\d+\n$")

    def test_wrong_command_lines_end_with_2_and_a_hint(self):
        for arguments, said in [
            ((), "say what to do"),
            (("compil", "x"), 'no verb "compil" here; did you mean compile?'),
            (("sim", self.world, "--sped", "2"), 'no option "--sped" here; did you mean --speed?'),
            (("sim", self.world, "--speed", "fast"), 'expected a number from 0.01 to 1000, or max, found "fast"'),
            (("sim", self.world, "--duration", "-1"), 'expected a number of seconds above 0, found "-1"'),
            (("sim", self.world, "more"), '"more" is one argument too many'),
            (("compile",), "FILE is required"),
            (("compile", self.script, "--format", "jso"), 'found "jso"; did you mean json?'),
            (("exec", self.script), "--node is required"),
            (("net", "tcp:127.0.0.1:1"), "say what to do: list, describe, "),
            (("node", "--id", "x"), "--id: expected a whole number from 1 to 65534, found"),
            (("exec", self.script, "--node", "n", "--max-steps", "0"), "expected a whole number from 1 to"),
            (("sim", self.world, "--seed", "-1"), "expected a whole number from 0 to"),
            (("sim", self.world, "--threads", "0"), '--threads: expected a whole number from 1 to 64, found "0"'),
            (("sim", self.world, "--threads", "65"), '--threads: expected a whole number from 1 to 64, found "65"'),
            (("sim", self.world, "--threads", "all"), '--threads: expected a whole number from 1 to 64, found "all"'),
            (("sim", self.world, "--speed", "1", "--speed", "2"), "--speed is given more than once"),
            (("net", "tcp:127.0.0.1:1", "set", "1", "x", "65536"), "expected a whole number from -32768 to 65535"),
        ]:
            with self.subTest(arguments=arguments):
                done = self.run_vagus(*arguments, status=2)
                self.assertIn(said, done.stderr)
                self.assertIn("--help", done.stderr)
                self.assertEqual(done.stdout, "")

    def test_targets_that_are_none_end_with_2(self):
        for arguments in [("net", "foo", "list"), ("sim", self.world, "--headless", "--listen", "foo"),
                          ("node", "--listen", "foo"), ("switch", "foo"), ("switch", "--listen", "foo")]:
            with self.subTest(arguments=arguments):
                self.assertIn("tcp:HOST:PORT", self.run_vagus(*arguments, status=2).stderr)

    def test_files_that_cannot_be_read_end_with_2(self):
        for arguments in [("compile", "gone.aesl"), ("compile", self.script, "--node", "gone.json"), ("sim", "gone.json"),
                          ("sim", self.world, "--load", "gone.aesl")]:
            with self.subTest(arguments=arguments):
                self.assertIn("gone", self.run_vagus(*arguments, status=2).stderr)

    def test_a_reader_that_leaves_is_harmless(self):
        with subprocess.Popen([VAGUS, "sim", self.world, "--headless", "--speed", "max", "--duration", "100000"],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as program:
            program.stdout.readline()
            program.stdout.close()
            self.assertEqual(program.wait(timeout=GIVE_UP_AFTER), 0)
            self.assertEqual(program.stderr.read(), "")

    def test_a_reader_that_does_not_read_holds_up_no_bus(self):
        trace = self.folder / "unread.jsonl"
        with subprocess.Popen([VAGUS, "sim", self.world, "--headless", "--speed", "max", "--duration", "1e9", "--trace", trace,
                               "--listen", "tcp:127.0.0.1:0"], stdout=subprocess.PIPE) as program:
            try:
                target = program.stdout.readline().decode().split()[1]
                nodes = json.loads(self.run_vagus("net", target, "list", "--json").stdout)
                self.assertEqual([node["id"] for node in nodes], [7])
                # 10,000 s are 900 kB of lines: more than the pipe holds, and what may wait for it twice.
                deadline = time.monotonic() + GIVE_UP_AFTER
                while not trace.exists() or trace.stat().st_size < 8_000_000:  # ten poses a second
                    self.assertLess(time.monotonic(), deadline, "time stood still")
                    time.sleep(0.02)
                nodes = json.loads(self.run_vagus("net", target, "list", "--json").stdout)
                self.assertEqual([node["id"] for node in nodes], [7])
                lines = []
                while not lines or not lines[-1].startswith(b"vagus: "):
                    lines.append(program.stdout.readline())
                self.assertRegex(lines.pop(), rb"^vagus: [1-9]\d* lines were left out here\n$")
                for line in lines:  # whole ones around it
                    self.assertRegex(line, rb"^ *\d+\.0[01]0 s  rob  at .*\n$")
            finally:
                program.terminate()

    def test_a_trace_on_stdout_is_there_alone(self):
        run = ("sim", self.world, "--headless", "--speed", "max", "--duration", "3", "--listen", "tcp:127.0.0.1:0")
        plain = self.run_vagus(*run)
        self.assertRegex(plain.stdout, r"^listening tcp:127\.0\.0\.1:\d+\n")
        self.assertEqual(plain.stderr, "")
        done = self.run_vagus(*run, "--trace", "-")
        self.assertIn("pose", {json.loads(line)["kind"] for line in done.stdout.splitlines()})
        self.assertEqual(done.stderr.splitlines()[1:], plain.stdout.splitlines()[1:])
        self.assertRegex(done.stderr, r"^listening tcp:127\.0\.0\.1:\d+\n")

    def unread(self, *words, stdout=subprocess.DEVNULL):
        """Of a run whose trace nobody reads, in real time or with hosts on its bus: it ends all the same, and says what is missing."""
        with subprocess.Popen([VAGUS, *words], stdout=stdout, stderr=subprocess.PIPE, text=True) as program:
            if stdout == subprocess.DEVNULL:
                reader = os.open(words[-1], os.O_RDONLY)
                self.addCleanup(os.close, reader)
            else:
                fcntl.fcntl(program.stdout, fcntl.F_SETPIPE_SZ, 4096)
            try:
                status = program.wait(timeout=GIVE_UP_AFTER)
            finally:
                program.kill()
            return status, program.stderr.read()

    LEFT_OUT = r": nobody read it in time; [1-9]\d* lines were left out\n$"

    def test_a_pipe_for_a_trace_that_nobody_reads_holds_up_no_bus(self):
        fifo = self.folder / "trace"
        os.mkfifo(fifo)
        # 2,000 s are 2 MB of trace: more than the pipe holds, and what may wait for it twice.
        status, said = self.unread("sim", self.world, "--headless", "--speed", "max", "--duration", "2000", "--listen",
                                   "tcp:127.0.0.1:0", "--trace", fifo)
        self.assertEqual(status, 1)
        self.assertRegex(said, f"^vagus: {re.escape(str(fifo))}{self.LEFT_OUT}")

    def test_the_trace_of_a_plan_that_nobody_reads_holds_up_no_robot(self):
        plan = self.file("count.plan.json", json.dumps({
            "format": "vagus-plan/1", "name": "Count", "configuration": {"n": {"type": "int", "initial": 0}},
            "start": {"actor": "add"}, "actors": {
                "add": {"template": "Assign", "in": {"value": "n + 1"}, "out": {"result": "n"}, "states": {"Done": "more"}},
                "more": {"template": "Compare", "in": {"left": "n", "op": "'<'", "right": 3000},
                         "states": {"True": "add", "False": "@terminate"}}}}))
        status, said = self.unread("plan", "run", plan, "--quiet", "--trace", "-", stdout=subprocess.PIPE)
        self.assertEqual(status, 1)
        self.assertRegex(said, f"^vagus: standard output{self.LEFT_OUT}")
        fifo = self.folder / "trace"
        os.mkfifo(fifo)
        status, said = self.unread("plan", "run", plan, "--quiet", "--trace", fifo)
        self.assertEqual(status, 1)
        self.assertRegex(said, f"^vagus: {re.escape(str(fifo))}{self.LEFT_OUT}")

    def test_a_run_that_hurries_alone_loses_no_line_to_a_slow_reader(self):
        with subprocess.Popen([VAGUS, "sim", self.world, "--headless", "--speed", "max", "--duration", "10000"],
                              stdout=subprocess.PIPE) as program:
            seconds = [line.split()[0] for line in program.stdout]
        self.assertEqual(seconds, [b"0.010", *(b"%d.000" % second for second in range(1, 10001))])

    def test_more_than_twenty_robots_are_a_line_each_second(self):
        def lines_of(count):
            robots = [{"name": f"r{i}", "type": "thymio2", "at": [0.2 + 0.3 * i, 0.5]} for i in range(count)]
            world = {"format": "vagus-world/1", "size": [10, 1], "robots": robots}
            drive = self.file("drive.aesl", "motor.left.target = 200\nmotor.right.target = -200\n")
            return self.run_vagus("sim", self.file("many.world.json", json.dumps(world)), "--load", drive, "--headless",
                                  "--speed", "max", "--duration", "2").stdout.splitlines()
        self.assertEqual(len([line for line in lines_of(20) if "1.000 s  r" in line]), 20)
        many = lines_of(21)
        self.assertIn("1.000 s  21 robots  21 moving  0 at rest  21 running a script  0 stopped by a fault", many)
        self.assertEqual(len([line for line in many if "  loaded  " in line]), 21)  # twenty, "and 1 more"

    def test_output_that_is_lost_is_a_failure(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run([VAGUS, "compile", self.script], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr, "vagus: standard output: cannot be written: No space left on device\n")

    PLAN = """{
  "format": "vagus-plan/1",
  "name": "Talk",
  "start": { "actor": "say" },
  "actors": {
    "say": { "template": "Log", "in": { "text": "'a\u202eb\\u001b[2Jc'" }, "states": { "Done": "wait" } },
    "wait": { "template": "Wait", "in": { "seconds": 3 }, "states": { "Done": "@terminate" } }
  }
}
"""

    def test_a_trace_that_is_lost_is_named_with_the_reason(self):
        plan = self.file("talk.plan.json", self.PLAN)
        full = "/dev/full: cannot be written: No space left on device"
        for words in [("sim", self.world, "--headless", "--speed", "max", "--trace", "/dev/full"),
                      ("plan", "run", plan, "--clock", "virtual", "--trace", "/dev/full"),
                      ("plan", "run", plan, "--clock", "virtual", "--world", self.world, "--trace-all", "/dev/full"),
                      ("sim", self.world, "--headless", "--speed", "max", "--duration", 1, "--record", "/dev/full"),
                      ("plan", "run", plan, "--clock", "virtual", "--record", "/dev/full"),
                      ("compile", self.script, "-o", "/dev/full")]:
            with self.subTest(words=words):
                said = self.run_vagus(*words, status=1).stderr
                self.assertEqual(said.count(full), 1, said)
        for words in [("sim", self.world, "--headless", "--trace"), ("plan", "run", plan, "--trace")]:
            said = self.run_vagus(*words, f"{self.folder}/none/t", status=2).stderr
            self.assertIn("/none/t: cannot be written: No such file or directory", said)

    def test_what_stands_in_a_full_file_is_whole_lines(self):
        trace = f"{self.folder}/t.jsonl"
        command = f'ulimit -f 1; exec "{VAGUS}" sim "{self.world}" --headless --speed max --trace "{trace}"'
        done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, timeout=GIVE_UP_AFTER)
        self.assertEqual(done.returncode, 1)
        self.assertIn(f"{trace}: cannot be written: File too large", done.stderr)
        lines = pathlib.Path(trace).read_text().splitlines(keepends=True)
        self.assertTrue(lines)
        for line in lines:
            self.assertTrue(line.endswith("\n"))
            json.loads(line)

    def test_standard_output_that_is_closed_is_not_another_file(self):
        out = f"{self.folder}/out"
        done = subprocess.run(["bash", "-c", f'exec "{VAGUS}" compile "{self.script}" >&-'], capture_output=True, text=True,
                              timeout=GIVE_UP_AFTER)
        self.assertEqual(done.returncode, 1)
        self.assertIn("standard output: cannot be written: Bad file descriptor", done.stderr)
        self.assertFalse(os.path.exists(out))

    def test_an_option_is_never_the_value_of_another(self):
        for words in [("sim", self.world, "--trace", "--headless"), ("compile", self.script, "-o", "--format")]:
            with self.subTest(words=words):
                said = self.run_vagus(*words, status=2).stderr
                self.assertIn(f'expected a value, found the option "{words[-1]}"', said)
        self.assertFalse(os.path.exists("--headless"))

    # ---- names from anywhere ----

    def assert_harmless(self, text):
        self.assertNotRegex(text, "[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ufeff]")

    def test_names_that_a_terminal_would_obey_are_shown_escaped(self):
        world = self.file("evil.world.json", WORLD.replace('"rob"', '"r\\u001b[31m\\u202eb\\n"'))
        done = self.run_vagus("sim", world, "--headless", "--speed", "max", "--duration", "1")
        self.assertIn("r\\u001b[31m\\u202eb\\u000a  at", done.stdout)
        self.assert_harmless(done.stdout + done.stderr)
        plan = self.file("talk.plan.json", self.PLAN)
        done = self.run_vagus("plan", "run", plan, "--clock", "virtual", "--world", self.world)
        self.assertIn("a\\u202eb\\u001b[2Jc", done.stdout)
        self.assert_harmless(done.stdout + done.stderr)
        gone = f"{self.folder}/a\x1b[2J\u202e.aesl"
        self.assert_harmless(self.run_vagus("compile", gone, status=2).stderr)
        plan = self.file("bad.plan.json", self.PLAN.replace('"wait":', '"w\u202eit":'))
        done = self.run_vagus("plan", "check", plan, "--json", status=2)
        self.assert_harmless(done.stdout)
        self.assertTrue(any("\u202e" in finding["element"] for finding in json.loads(done.stdout)))

    # ---- files that are not what was expected ----

    def test_a_file_of_another_format_is_called_that(self):
        plan = self.file("talk.plan.json", self.PLAN)
        for words, sentence in [
                (("sim", plan, "--headless"), "2:13: this is a plan file (vagus-plan/1); a world file (vagus-world/1) was"),
                (("sim", self.script, "--headless"), "1:1: this is a script (.aesl); a world file (vagus-world/1) was"),
                (("plan", "check", self.world), "2:3: error: this is a world file (vagus-world/1); a plan file"),
                (("exec", self.script, "--node", self.world), "2:13: this is a world file (vagus-world/1); a node file was")]:
            with self.subTest(words=words):
                self.assertIn(sentence, self.run_vagus(*words, status=2).stderr)
        self.assertIn("1:1: this is a world file (vagus-world/1); a script (.aesl) was expected",
                      self.run_vagus("compile", self.world, status=1).stderr)

    def test_a_slip_in_json_has_line_and_column_in_text_and_findings(self):
        plan = self.file("slip.plan.json", self.PLAN.replace('"Talk",', '"Talk"'))
        sentence = "this is not JSON: there is no comma before this; add one at line 3, column 17"
        self.assertEqual(self.run_vagus("plan", "check", plan, status=2).stderr, f"{plan}:4:3: error: {sentence} [P0]\n")
        finding = json.loads(self.run_vagus("plan", "check", plan, "--json", status=2).stdout)[0]
        self.assertEqual((finding["line"], finding["message"]), (4, sentence + " (column 3)"))

    def test_an_angle_in_degrees_gets_a_hint(self):
        world = self.file("turn.world.json", WORLD.replace('"node": 7', '"angle": 90'))
        hint = "5:77: warning: robots[0].angle: 90 is more than a full turn; angles are in radians: 90 degrees are 1.5708"
        self.assertIn(hint, self.run_vagus("sim", world, "--headless", "--speed", "max", "--duration", "1").stderr)
        plan = self.file("talk.plan.json", self.PLAN)
        self.assertIn(hint, self.run_vagus("plan", "run", plan, "--clock", "virtual", "--world", world).stderr)

    def test_no_path_leads_out_of_a_project(self):
        inside = f"{self.folder}/in"
        os.mkdir(inside)
        self.file("in/vagus.json", '{ "format": "vagus-project/1" }')
        self.file("out.aesl", "")
        self.file("out.plan.json", self.PLAN)
        world = self.file("in/w.world.json", WORLD.replace('"node": 7', '"script": "../out.aesl"'))
        self.assertIn("out.aesl is outside of the project", self.run_vagus("sim", world, "--headless", status=2).stderr)
        ground = self.file("in/g.world.json", WORLD.replace('"robots"', '"ground": { "image": "../g.png" }, "robots"'))
        self.assertIn("g.png is outside of the project", self.run_vagus("sim", ground, "--headless", status=2).stderr)
        plan = self.file("in/p.plan.json", self.PLAN.replace('"template": "Wait", "in": { "seconds": 3 }, "states": { "Done": "@terminate" }',
                                                             '"plan": "../out.plan.json"'))
        self.assertIn("out.plan.json is outside of the project", self.run_vagus("plan", "check", plan, status=2).stderr)

    # ---- derived pages ----

    def test_completion_is_current(self):
        self.assertEqual((ROOT / "completions/vagus.bash").read_text(), self.run_vagus("page", "bash").stdout,
                         "run: vagus page bash > completions/vagus.bash")

    def test_manual_is_current(self):
        self.assertEqual((ROOT / "docs/cli.md").read_text(), self.run_vagus("page", "manual").stdout,
                         "run: vagus page manual > docs/cli.md")

    def complete(self, *words):
        """What bash would offer for the last word."""
        line = " ".join(f"'{word}'" for word in words)
        script = (f"source {ROOT}/completions/vagus.bash; COMP_WORDS=({line}); COMP_CWORD={len(words) - 1}; "
                  f"_vagus; printf '%s\\n' \"${{COMPREPLY[@]}}\"")
        done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, cwd=self.folder, check=True)
        return sorted(filter(None, done.stdout.split("\n")))

    def test_bash_completes_verbs_options_words_and_files(self):
        self.file("other.txt", "")
        self.assertEqual(self.complete("vagus", ""), sorted(VERBS))
        self.assertEqual(self.complete("vagus", "com"), ["compare", "compile"])
        self.assertEqual(self.complete("vagus", "compile", "--form"), ["--format"])
        self.assertEqual(self.complete("vagus", "compile", "--format", "l"), ["listing"])
        self.assertEqual(self.complete("vagus", "compile", "--format", ""), ["abo", "hex", "json", "listing"])
        self.assertEqual(self.complete("vagus", "compile", ""), ["count.aesl"])
        self.assertEqual(self.complete("vagus", "sim", ""), ["yard.world.json"])
        self.assertEqual(self.complete("vagus", "sim", "yard.world.json", "--load", ""), ["count.aesl"])
        self.assertEqual(self.complete("vagus", "sim", "--watch", "--sp"), ["--speed"])
        # As bash cuts the words of `vagus net tcp:localhost:33333 li`.
        target = ["tcp", ":", "localhost", ":", "33333"]
        self.assertEqual(self.complete("vagus", "net", *target, "li"), ["list"])
        self.assertEqual(self.complete("vagus", "sim", "--listen", *target, ""), ["yard.world.json"])

    # ---- compile ----

    def test_compile_writes_the_words_of_the_specification(self):
        hexes = self.run_vagus("compile", self.file("rover.aesl", ROVER), "--format", "hex").stdout.split()
        # Three vectors: setspeed at 7, timer at 10, the start at 38 in the reference; a compiler may do better.
        self.assertEqual(hexes[:5], ["0007", "0000", "0007", "fffe", "000a"])
        self.assertTrue(all(len(word) == 4 for word in hexes))
        node = json.loads(self.run_vagus("compile", "rover.aesl", "--format", "json").stdout)["nodes"][0]
        self.assertEqual(node["name"], "rover")
        self.assertEqual([f"{word:04x}" for word in node["bytecode"]], hexes)
        self.assertEqual(len(node["lines"]), len(hexes))
        self.assertEqual(node["variables"]["speed"], [36, 1])
        self.assertEqual(node["variables"]["ticks"], [37, 1])
        self.assertEqual(node["used"]["bytecode"], len(hexes))
        self.assertEqual(node["warnings"], [])

    def test_compile_replaces_no_source(self):
        for words in (["rover.aesl", "-o", "rover.aesl"], ["other.aesl", "-o", "./rover.aesl"]):
            self.file("rover.aesl", ROVER)
            self.file("other.aesl", ROVER)
            said = self.run_vagus("compile", *words, status=2).stderr
            self.assertIn("name another file for what is compiled", said)
            self.assertEqual((self.folder / "rover.aesl").read_text(), ROVER)

    def test_compile_writes_object_files(self):
        self.file("rover.aesl", ROVER)
        self.run_vagus("compile", "rover.aesl", "--format", "abo", "-o", "rover.abo")
        data = (self.folder / "rover.abo").read_bytes()
        words = self.run_vagus("compile", "rover.aesl", "--format", "hex").stdout.split()
        self.assertEqual(data[:4], b"ABO\0")
        version, protocol, _, _, node_id, _, _, count = struct.unpack("<8H", data[4:20])
        self.assertEqual((version, protocol, node_id, count), (0, 5, 1, len(words)))
        self.assertEqual([f"{word:04x}" for word in struct.unpack(f"<{count}H", data[20:20 + 2 * count])], words)

    def test_mistakes_name_line_and_column_of_the_file(self):
        # Line 19 of the file: "ticks += 1" without its "s".
        self.file("rover.aesl", ROVER.replace("ticks += 1", "tick += 1\nspeeed = 2"))
        done = self.run_vagus("compile", "rover.aesl", status=1)
        self.assertEqual(done.stdout, "")
        lines = done.stderr.strip().split("\n")
        line = ROVER.split("\n").index("ticks += 1") + 1
        self.assertRegex(lines[0], rf'^rover\.aesl:{line}:1: error: .*"tick".* \[VARIABLE_NOT_DEFINED')
        self.assertRegex(lines[1], rf'^rover\.aesl:{line + 1}:1: error: .*"speeed".*did you mean "speed"')
        self.assertEqual(len(lines), 2)

    def test_a_sentence_about_another_line_counts_as_the_file_does(self):
        self.file("rover.aesl", ROVER.replace("ticks += 1\n", "ticks += 1\nif ticks == 1 then\n"))
        line = ROVER.split("\n").index("ticks += 1") + 2
        self.assertIn(f'expected "end" for the "if" of line {line}, ',
                      self.run_vagus("compile", "rover.aesl", status=1).stderr)

    def test_errors_stand_in_the_order_of_the_text(self):
        done = self.run_vagus("compile", "-", status=1, stdin="callsub nope\nargs = 1\nemit id = 3\nvar a$\n")
        places = [int(line.split(":")[1]) for line in done.stderr.splitlines() if line.startswith("-:")]
        self.assertEqual(places, sorted(places))
        self.assertGreater(len(places), 2)

    def test_json_has_the_errors_with_their_ranges_and_fixes(self):
        done = self.run_vagus("compile", "-", "--node", "thymio-II", "--format", "json", status=1,
                              stdin="onevent prox\nmotor.left = 200\nonevent found\n")
        errors = json.loads(done.stdout)["nodes"][0]["errors"]
        self.assertEqual([error["code"] for error in errors], ["VARIABLE_NOT_DEFINED", "EVENT_NOT_DEFINED"])
        place = {"line": 2, "column": 1, "endLine": 2, "endColumn": 11}
        self.assertEqual({key: errors[0][key] for key in place}, place)
        self.assertEqual(errors[0]["fix"], {"label": 'Write "motor.left.target"',
                                            "edits": [{**place, "text": "motor.left.target"}]})
        self.assertEqual(errors[1]["fix"], {"label": 'Declare the event "found"', "edits": [],
                                            "declares": {"name": "found", "size": 0}})

    def test_a_recursion_has_a_place_for_people_and_none_for_exec(self):
        script = self.file("circle.aesl", "sub a\ncallsub b\nsub b\ncallsub a\n")
        self.assertRegex(self.run_vagus("compile", script, status=1).stderr,
                         r'circle\.aesl:4:1: error: the sub "a" of line 1 calls itself through "b"')
        node = ROOT / "testdata/golden/aesl/node.json"
        first = json.loads(self.run_vagus("exec", script, "--node", node, status=1).stdout)["error"]
        self.assertEqual(first, {"code": "STACK_OVERFLOW", "number": 1, "line": 0, "column": 0})

    def test_a_byte_order_mark_is_skipped(self):
        marked = self.file("marked.aesl", "\ufeffvar a = 5")
        self.assertEqual(self.run_vagus("compile", marked, "--format", "hex").stdout.split()[0], "0003")
        project = self.file("project.aesl", "\ufeff" + ROVER)
        self.run_vagus("compile", project)

    def test_broken_projects_are_mistakes_too(self):
        self.file("rover.aesl", "<network><node name='x'></network>")
        self.assertRegex(self.run_vagus("compile", "rover.aesl", status=1).stderr, r"^rover\.aesl:1:")

    def test_hex_of_several_nodes_needs_a_name(self):
        two = ROVER.replace("</network>", '<node nodeId="2" name="other">var x = 1</node></network>')
        self.file("two.aesl", two)
        self.assertIn("--node-name", self.run_vagus("compile", "two.aesl", "--format", "hex", status=2).stderr)
        self.assertEqual(self.run_vagus("compile", "two.aesl", "--format", "hex", "--node-name", "other").stdout[:4], "0003")
        wrong = self.run_vagus("compile", "two.aesl", "--format", "hex", "--node-name", "othr", status=2).stderr
        self.assertIn("did you mean other?", wrong)
        nodes = json.loads(self.run_vagus("compile", "two.aesl", "--format", "json").stdout)["nodes"]
        self.assertEqual([node["name"] for node in nodes], ["rover", "other"])

    def test_compile_reads_standard_input(self):
        done = self.run_vagus("compile", "-", "--format", "hex", stdin="var a = 5")
        # Table: start at 3; push 5, store at 36 (behind the 36 words of the software node), stop.
        self.assertEqual(done.stdout.split(), ["0003", "ffff", "0003", "1005", "4024", "0000"])

    def test_a_node_file_that_lists_events_lists_all(self):
        node = json.loads((ROOT / "testdata/golden/aesl/node.json").read_text())
        listed = self.file("node.json", json.dumps(node))
        done = self.run_vagus("compile", "-", "--node", listed, status=1, stdin="emit pnig\n")
        self.assertRegex(done.stderr, r"^-:1:6: error: .*ping")
        node["events"] = []
        silent = self.file("silent.json", json.dumps(node))
        self.run_vagus("compile", "-", "--node", silent, stdin="emit pnig\n")

    # ---- net ----

    def test_a_plain_script_for_a_live_node_needs_no_declarations(self):
        plain = self.file("plain.aesl", "emit both [7, 8]\nemit none\n")
        with subprocess.Popen([VAGUS, "node", "--listen", "tcp:127.0.0.1:0"], stdout=subprocess.PIPE, text=True) as node:
            try:
                place = node.stdout.readline().split()[1]
                self.assertIn("loaded, running", self.run_vagus("net", place, "load", plain).stdout)
                for written, word in (("0x10", 16), ("0b101", 5), ("0xffff", -1), ("-7", -7)):
                    self.run_vagus("net", place, "set", "1", "args[0]", written)
                    values = json.loads(self.run_vagus("net", place, "get", "1", "args[0]", "--json").stdout)
                    self.assertEqual(list(values.values()), [[word]])
                self.run_vagus("net", place, "set", "1", "args[0]", "0xg", status=2)
            finally:
                node.terminate()

    # ---- sim, plain lines ----

    def test_the_exploring_robot_never_stands_still(self):
        # In 10 seconds it leaves a disc of 3 cm, from wherever it is, with any seed.
        for seed in range(1, 21):
            self.run_vagus("sim", ROOT / "examples/thymio/arena.world.json", "--headless", "--speed", "max", "--duration",
                           "120", "--seed", seed, "--trace", "trace")
            lines = map(json.loads, (self.folder / "trace").read_text().splitlines())
            poses = [(line["x"], line["y"]) for line in lines if line["kind"] == "pose"]
            self.assertEqual(len(poses), 1200)
            for i in range(len(poses) - 100):
                still = all(math.dist(poses[i], later) < 0.03 for later in poses[i:i + 101])
                self.assertFalse(still, f"seed {seed}: stands still at {i / 10} s")
            places = {(int(x / 0.1), int(y / 0.1)) for x, y in poses}  # of 300 in the arena
            self.assertGreater(len(places), 50, f"seed {seed}")

    def test_a_robots_own_port_may_be_a_free_one(self):
        world = self.file("own.world.json", WORLD.replace('"node": 7', '"node": 7, "port": 0'))
        with subprocess.Popen([VAGUS, "sim", world, "--headless", "--duration", "600"], stdout=subprocess.PIPE,
                              text=True) as program:
            try:
                first = program.stdout.readline()
                self.assertRegex(first, r"^listening tcp:127\.0\.0\.1:[1-9]\d* rob\n$")
                nodes = json.loads(self.run_vagus("net", first.split()[1], "list", "--json").stdout)
                self.assertEqual([node["id"] for node in nodes], [7])
            finally:
                program.terminate()

    def test_without_a_terminal_it_ends_after_20_simulated_seconds(self):
        text = self.run_vagus("sim", self.world, "--load", self.script, "--speed", "max").stdout
        self.assertIn("loaded", text)
        self.assertIn("event  rob: count 1\n", text)
        poses = [line for line in text.split("\n") if "  rob  at " in line]
        self.assertEqual(len(poses), 21)  # at the start and after each second
        self.assertTrue(poses[-1].startswith("20.000 s"), poses[-1])

    def test_a_duration_that_is_over_before_the_script_is_loaded_ends(self):
        text = self.run_vagus("sim", self.world, "--load", self.script, "--speed", "max", "--duration", "0.001").stdout
        self.assertIn("loaded", text)

    def test_duration_says_otherwise(self):
        text = self.run_vagus("sim", self.world, "--headless", "--speed", "max", "--duration", "2.5").stdout
        self.assertIn("2.000 s  rob  at", text)
        self.assertNotIn("3.000 s", text)

    def test_two_traces_of_a_run_are_the_same(self):
        for name in ("a", "b"):
            self.run_vagus("sim", self.world, "--load", self.script, "--speed", "max", "--duration", "5", "--trace", name)
        first = (self.folder / "a").read_bytes()
        self.assertEqual(first, (self.folder / "b").read_bytes())
        lines = [json.loads(line) for line in first.decode().split("\n")[:-1]]
        poses = [line for line in lines if line["kind"] == "pose"]
        self.assertEqual(len(poses), 50)  # ten a second
        self.assertEqual((poses[0]["robot"], poses[0]["x"], poses[0]["y"]), ("rob", 0.5, 0.5))
        events = [line for line in lines if line["kind"] == "event"]
        self.assertEqual([event["args"][0] for event in events], list(range(1, len(events) + 1)))
        self.assertEqual((events[0]["node"], events[0]["name"]), (7, "count"))
        self.assertEqual(sorted(line["t"] for line in lines), [line["t"] for line in lines])

    def test_a_crowd_has_the_same_trace_with_one_thread_and_with_more(self):
        # 100 robots, 20 cm from each other: more than kPartsForTwo, so that two threads share them.
        robots = [{"name": f"r{i}", "type": "thymio2", "at": [0.3 + 0.2 * (i % 10), 0.3 + 0.2 * (i // 10)],
                   "angle": i, "node": i + 1} for i in range(100)]
        crowd = self.file("crowd.world.json", json.dumps({"format": "vagus-world/1", "name": "crowd", "size": [2.4, 2.4],
                                                          "robots": robots}))
        script = self.file("restless.aesl", RESTLESS)
        for threads in (1, 2, 5):
            self.run_vagus("sim", crowd, "--load", script, "--headless", "--speed", "max", "--duration", "3",
                           "--threads", threads, "--trace", f"with-{threads}")
        one = (self.folder / "with-1").read_bytes()
        kinds = [json.loads(line)["kind"] for line in one.decode().splitlines()]
        self.assertEqual(kinds.count("pose"), 100 * 30)  # ten a second
        self.assertGreater(kinds.count("event"), 100 * 25)
        self.assertIn("contact", kinds)
        self.assertEqual((self.folder / "with-2").read_bytes(), one)
        self.assertEqual((self.folder / "with-5").read_bytes(), one)

    def test_it_has_as_many_threads_as_are_asked_for(self):
        counts = []  # beside those that write lines
        for threads in (1, 4):
            with subprocess.Popen([VAGUS, "sim", self.world, "--headless", "--duration", "600", "--threads", str(threads),
                                   "--listen", "tcp:127.0.0.1:0"], stdout=subprocess.PIPE, text=True) as program:
                try:
                    target = program.stdout.readline().split()[1]
                    self.run_vagus("net", target, "list")  # all is set up once it answers
                    counts.append(len(os.listdir(f"/proc/{program.pid}/task")))
                finally:
                    program.terminate()
        self.assertEqual(counts[1] - counts[0], 3)

    def test_mistakes_in_the_script_end_the_run_with_1(self):
        self.script.write_text(PROJECT.replace("STEP", "stp"))
        done = self.run_vagus("sim", self.world, "--load", self.script, "--speed", "max", status=1)
        self.assertIn(f"{self.script}:7:", done.stderr)

    def test_a_mistake_of_two_robots_is_said_once(self):
        twins = WORLD.replace("}]", '}, { "name": "bob", "type": "thymio2", "at": [1.5, 0.5], "node": 8 }]')
        plain = self.file("plain.aesl", "var n = m\n")
        done = self.run_vagus("sim", self.file("twins.world.json", twins), "--load", plain, "--headless", status=1)
        self.assertEqual(done.stderr.count("plain.aesl:1:9: error: "), 1)

    def test_a_plain_script_needs_no_declarations(self):
        plain = self.file("plain.aesl", "timer.period[0] = 100\nonevent timer0\nemit both [7, 8]\nemit none\n")
        text = self.run_vagus("sim", self.world, "--load", plain, "--speed", "max", "--duration", "1").stdout
        self.assertIn("event  rob: both 7 8\n", text)
        self.assertIn("event  rob: none\n", text)

    def test_a_project_for_other_nodes_says_so(self):
        other = self.file("other.aesl", PROJECT.replace("STEP", "1").replace("thymio-II", "rover"))
        done = self.run_vagus("sim", self.world, "--load", other, "--speed", "max", status=1)
        self.assertIn('"rover" (node 7)', done.stderr)
        self.assertIn('"thymio-II" (node 7)', done.stderr)

    def test_listening_is_the_first_line_and_hosts_see_the_robot(self):
        with subprocess.Popen([VAGUS, "sim", self.world, "--headless", "--duration", "600", "--listen", "tcp:127.0.0.1:0"],
                              stdout=subprocess.PIPE, text=True) as program:
            try:
                first = program.stdout.readline()
                self.assertRegex(first, r"^listening tcp:127\.0\.0\.1:\d+\n$")
                nodes = json.loads(self.run_vagus("net", first.split()[1], "list", "--json").stdout)
                self.assertEqual([(node["id"], node["name"]) for node in nodes], [(7, "thymio-II")])
            finally:
                program.terminate()

    def test_a_saved_script_takes_effect_while_it_runs(self):
        with subprocess.Popen([VAGUS, "sim", self.world, "--load", self.script, "--watch", "--headless", "--duration", "600"],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as program:
            try:
                self.wait_line(program, "count 2\n")
                self.script.write_text(PROJECT.replace("STEP", "sttep"))
                self.wait_line(program, 'no variable or constant "sttep"')
                self.wait_line(program, "count")  # the old program runs on
                self.script.write_text(PROJECT.replace("STEP", "100"))
                self.wait_line(program, "count 200\n")
            finally:
                program.terminate()

    @staticmethod
    def wait_line(program, text):
        for line in program.stdout:
            if text in line:
                return
        raise AssertionError(f"never printed {text!r}")

    # ---- sim on a terminal ----

    def test_the_screen_shows_the_robot_and_q_gives_the_terminal_back(self):
        with Screen("sim", self.world, "--load", self.script) as screen:
            screen.wait_page("yard")
            screen.wait_page("thymio-II")
            screen.wait_page("count")
            screen.type(" ")
            screen.wait_page("continue")
            screen.type(" ")
            screen.wait_page("x1")
            screen.type("+")
            screen.wait_page("x2")
            screen.bytes = b""
            screen.type("q")
            self.assertEqual(screen.wait_end(), 0)
            self.assertTrue(screen.given_back(), screen.bytes[-200:])

    def test_the_page_follows_the_size_of_the_terminal(self):
        with Screen("sim", self.world) as screen:
            screen.wait_page("thymio-II")
            screen.resize(59, 16)
            screen.wait_page("needs 60 x 16")
            screen.resize(60, 16)
            screen.wait_page("thymio-II")
            screen.type("q")
            self.assertEqual(screen.wait_end(), 0)

    def test_whatever_ends_it_the_terminal_is_given_back(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGABRT, signal.SIGSEGV):
            with self.subTest(signal=number), Screen("sim", self.world) as screen:
                screen.wait_page("thymio-II")
                screen.bytes = b""
                screen.process.send_signal(number)
                self.assertEqual(screen.wait_end(), -number)
                self.assertTrue(screen.given_back(), screen.bytes[-200:])

    def test_ctrl_c_ends_it_by_the_signal_so_that_scripts_around_stop(self):
        with Screen("sim", self.world) as screen:
            screen.wait_page("thymio-II")
            screen.type("\x03")
            self.assertEqual(screen.wait_end(), -signal.SIGINT)
            self.assertTrue(screen.given_back())

    def test_ctrl_z_gives_the_terminal_back_until_fg(self):
        # A shell with job control around it, as a person has: it takes the terminal when the program stops.
        shell = 'set -m; "$@"; echo "stopped $?"; read -r; fg >/dev/null; echo "ended $?"'
        with Screen("-c", shell, "bash", VAGUS, "sim", self.world, program="bash") as screen:
            screen.wait_page("thymio-II")
            screen.type("\x1a")
            screen.wait_for("stopped 148")
            self.assertTrue(screen.modes_are_back())
            screen.type("\n")
            screen.wait_for("\x1b[?1049h")
            screen.wait_page("thymio-II")
            screen.type("q")
            screen.wait_for("ended 0")
            self.assertTrue(screen.modes_are_back())

    # ---- plan run on a terminal ----

    def plan_that_waits(self, seconds):
        return self.plan_of({"template": "Wait", "in": {"seconds": seconds}, "states": {"Done": "@terminate"}})

    def plan_of(self, actor):
        return self.file("one.plan.json", json.dumps({
            "format": "vagus-plan/1", "name": "One", "toolboxes": ["drive"],
            "configuration": {"fast": {"type": "float", "initial": 100}},
            "start": {"actor": "only"}, "actors": {"only": actor}}))

    def after_the_screen(self, screen):
        """What stands on the normal screen after the view has gone."""
        self.assertTrue(screen.given_back(), screen.bytes[-200:])
        return screen.bytes[screen.bytes.rindex(b"\x1b[?1049l"):].decode()

    def test_a_plan_that_is_over_stays_until_q_and_leaves_its_last_lines(self):
        with Screen("plan", "run", self.plan_that_waits(0.1), "--world", self.world) as screen:
            screen.wait_page("the plan is over: OK")
            screen.bytes = b""
            screen.wait_page("quit")
            self.assertNotIn(b"pause", screen.bytes)
            screen.type("q")
            self.assertEqual(screen.wait_end(), 0)
            left = self.after_the_screen(screen)
            self.assertIn("0.100 s  the plan is over: OK", left)
            self.assertIn("rob is at", left)

    def test_a_plan_that_is_over_stays_until_any_key(self):
        with Screen("plan", "run", self.plan_that_waits(0.1), "--world", self.world) as screen:
            screen.wait_page("the plan is over: OK")
            screen.type("x")
            self.assertEqual(screen.wait_end(), 0)

    def test_r_restarts_a_plan_in_the_middle_and_at_its_end(self):
        with Screen("plan", "run", self.plan_that_waits(1000), "--world", self.world) as screen:
            screen.wait_page("running")
            screen.type("r")
            screen.wait_page("restarted")
            screen.wait_page("running")
            screen.type("q")
            self.assertEqual(screen.wait_end(), 3)
        with Screen("plan", "run", self.plan_that_waits(0.1), "--world", self.world) as screen:
            for _ in range(2):
                screen.wait_page("the plan is over: OK")
                screen.bytes = b""
                screen.type("r")
                screen.wait_until(lambda: b"restarted" in screen.bytes, "the next run")
            screen.wait_page("the plan is over: OK")
            screen.bytes = b""
            screen.type("q")
            self.assertEqual(screen.wait_end(), 0)
            self.assertEqual(self.after_the_screen(screen).count("the plan is over"), 1)

    def test_of_a_plan_that_is_restarted_the_first_run_is_recorded_and_the_second_can_be_ended(self):
        recording = self.folder / "run.mcap"
        with Screen("plan", "run", self.plan_that_waits(1000), "--world", self.world, "--record", recording) as screen:
            screen.wait_page("running")
            screen.type("r")
            screen.wait_page("has the first run")
            screen.wait_page("running")
            screen.type("q")
            self.assertEqual(screen.wait_end(), 3)
        self.assertIn("no difference", self.run_vagus("replay", recording).stdout)

    def test_only_keys_of_the_robot_that_is_there_are_shown(self):
        hall = ROOT / "examples/follow-wall/hall.world.json"
        epuck = self.file("e.world.json", WORLD.replace("thymio2", "epuck"))
        for world, shown, hidden in [(self.world, ["b center button", "t tap", "arrows buttons"], ["tab ", " e "]),
                                     (hall, ["e escape button", "arrows drive", "tab node"], ["t tap", " b "]),
                                     (epuck, ["r restart"], [" b ", " e ", "t tap", "arrows", "tab "])]:
            with self.subTest(world=world), Screen("sim", world, columns=100) as screen:
                screen.wait_page("node ")
                screen.bytes = b""
                screen.type("\x0c")
                screen.wait_until(lambda: b"\x1b[?2026l" in screen.bytes.partition(b"speed")[2], "the line of keys")
                keys = screen.bytes.partition(b"space")[2].decode()
                keys = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", " ", keys)
                for text in shown:
                    self.assertIn(text, re.sub(" +", " ", keys))
                for text in hidden:
                    self.assertNotIn(text, re.sub(" +", " ", keys))

    def colours_on(self, *options, answer=None, env=None):
        """What is painted until the keys are there, on a terminal that gives this answer about its background."""
        environment = {"NO_COLOR": "", "COLORTERM": "truecolor", "COLORFGBG": "", **(env or {})}
        with Screen("sim", self.world, *options, env=environment) as screen:
            if answer:
                screen.wait_for("\x1b]11;?")
                screen.type(answer)
            screen.wait_until(lambda: b"quit" in screen.bytes, "the keys")
            return screen.bytes.decode()

    def test_a_terminal_is_asked_whether_it_is_light(self):
        on_dark = "38;2;255;210;90m+"  # the colour of keys
        white, black = "\x1b]11;rgb:ffff/ffff/ffff\x1b\\", "\x1b]11;rgb:0000/0000/0000\x07"
        end = "\x1b[?62;22c"
        self.assertIn(on_dark, self.colours_on(answer=black + end))
        self.assertNotIn(on_dark, self.colours_on(answer=white + end))
        # One that does not answer, or only says what it is.
        self.assertIn(on_dark, self.colours_on())
        self.assertIn(on_dark, self.colours_on(answer=end))
        self.assertNotIn(on_dark, self.colours_on(answer=end, env={"COLORFGBG": "0;15"}))
        self.assertIn(on_dark, self.colours_on(answer=black + end, env={"COLORFGBG": "0;15"}))
        # Who says it is not asked.
        for theme, dark in (("dark", True), ("light", False)):
            shown = self.colours_on("--theme", theme, env={"COLORFGBG": "0;15" if dark else "15;0"})
            self.assertEqual(on_dark in shown, dark)
            self.assertNotIn("\x1b]11;?", shown)

    def test_keys_that_are_typed_while_the_terminal_is_asked_count(self):
        environment = {"NO_COLOR": "", "COLORTERM": "truecolor"}
        with Screen("sim", self.world, env=environment) as screen:
            screen.wait_for("\x1b]11;?")
            screen.type("+\x1b[?62c")
            screen.wait_page("x2")
            screen.type("q")
            self.assertEqual(screen.wait_end(), 0)

    def test_a_plan_alone_prints_its_lines_beside_its_trace(self):
        plan = self.file("one.plan.json", json.dumps({
            "format": "vagus-plan/1", "name": "One", "start": {"actor": "only"}, "actors": {"only": {
                "template": "Log", "in": {"text": "'hello'"}, "states": {"Done": "@terminate"}}}}))
        lines = ["    0.000 s  only begins: text hello\n", "    0.000 s  only: hello\n",
                 "    0.000 s  only: Done → @terminate\n", "    0.000 s  the plan is over: OK\n"]
        lines[2] = lines[2].replace("@terminate", "the plan ends")
        run = ["plan", "run", plan, "--clock", "virtual"]
        done = self.run_vagus(*run)
        self.assertEqual((done.stdout, done.stderr), ("".join(lines), ""))
        done = self.run_vagus(*run, "--trace", "-")
        self.assertEqual(done.stderr, "".join(lines))
        self.assertTrue(all(line.startswith("{") for line in done.stdout.splitlines()), done.stdout)
        done = self.run_vagus(*run, "--trace", "-", "--quiet")
        self.assertEqual(done.stderr, "")
        done = self.run_vagus(*run, "--quiet")
        self.assertEqual((done.stdout, done.stderr), ("", ""))
        # Beside a world, too.
        done = self.run_vagus(*run, "--world", self.world, "--trace", "-")
        self.assertIn("only: hello", done.stderr)
        self.assertIn("rob is at", done.stderr)
        self.assertTrue(all(line.startswith("{") for line in done.stdout.splitlines()), done.stdout)

    def test_the_error_that_ends_a_plan_stands_on_the_normal_screen(self):
        plan = self.plan_of({"template": "Forward", "in": {"distance": 10, "speed": "fast"},
                             "states": {"ForwardSuccessful": "@terminate"}})
        with Screen("plan", "run", plan, "--world", ROOT / "examples/follow-wall/hall.world.json") as screen:
            screen.wait_page("the plan is over: Error")
            screen.bytes = b""
            screen.type("q")
            self.assertEqual(screen.wait_end(), 4)
            left = self.after_the_screen(screen)
            self.assertIn("the plan is over: Error", left)
            self.assertRegex(left, r"vagus: .*\"speed\" is 100")

    def test_q_in_the_middle_of_a_plan_interrupts_it(self):
        with Screen("plan", "run", self.plan_that_waits(1000), "--world", self.world) as screen:
            screen.wait_page("running")
            screen.bytes = b""
            screen.type("q")
            self.assertEqual(screen.wait_end(), 3)
            self.assertIn("the plan is over: Interrupted", self.after_the_screen(screen))

    def test_a_terminal_that_cannot_draw_gets_lines(self):
        with Screen("sim", self.world, "--speed", "max", env={"TERM": "dumb"}) as screen:
            screen.wait_for("20.000 s  rob  at")
            self.assertEqual(screen.wait_end(), 0)

    def test_mistakes_appear_on_the_screen_and_go_when_mended(self):
        with Screen("sim", self.world, "--load", self.script, "--watch", columns=100, rows=30) as screen:
            screen.wait_page("count")
            self.script.write_text(PROJECT.replace("STEP", "sttep"))
            screen.wait_page("has mistakes")
            screen.wait_page("sttep")
            self.script.write_text(PROJECT.replace("STEP", "100"))
            screen.wait_page("runs on rob")
            screen.type("q")
            self.assertEqual(screen.wait_end(), 0)

    def test_no_color_means_no_colour(self):
        for environment, coloured in (({}, False), ({"NO_COLOR": ""}, True)):
            with Screen("sim", self.world, env=environment) as screen:
                screen.wait_until(lambda: b"quit" in screen.bytes, "the keys")
                self.assertEqual(b";38;5;" in screen.bytes, coloured)


if __name__ == "__main__":
    unittest.main(verbosity=2)
