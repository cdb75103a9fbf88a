"""`vagus plan debug`, driven by lines of stdin in virtual time: every command, what it says, what it refuses."""
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
VAGUS = os.environ.get("VAGUS_BIN", str(ROOT / "build/release/bin/vagus"))

# Waits 0.5 s, counts n up to 3 and ends: at 0.5, 1.0, 1.5, 2.0 it loops, at 2.5 it is done.
COUNT = """{
  "format": "vagus-plan/1",
  "name": "Count",
  "configuration": {
    "n": { "type": "int", "initial": 0 },
    "limit": { "type": "int", "initial": 3 },
    "word": { "type": "string", "initial": "a b" }
  },
  "start": { "actor": "wait", "supervisors": {
    "tick": { "template": "Every", "in": { "seconds": 10 }, "out": { "count": "n" }, "events": { "Tick": "@terminate" } } } },
  "actors": {
    "wait": { "template": "Wait", "in": { "seconds": "0.5" }, "states": { "Done": "step" } },
    "step": { "template": "For", "in": { "counter": "n", "last": "limit" }, "out": { "counter": "n" },
      "states": { "Loop": "wait", "Done": "@terminate" } }
  }
}
"""


TWO_PULSES = """{
  "format": "vagus-plan/1", "name": "Two", "start": { "actor": "first" },
  "actors": {
    "first": { "template": "Receive", "in": { "event": "'pulse'" }, "states": { "Received": "second" } },
    "second": { "template": "Receive", "in": { "event": "'pulse'" }, "states": { "Received": "@terminate" } }
  }
}
"""
PULSE = """<network>
<event size="1" name="pulse"/>
<node nodeId="1" name="thymio-II">var n = 0
timer.period[0] = 1
onevent timer0
n++
emit pulse n
</node></network>
"""
PULSE_ROOM = """{
  "format": "vagus-world/1", "name": "Room", "size": [1, 1],
  "robots": [{ "name": "alice", "type": "thymio2", "at": [0.5, 0.5], "node": 1, "script": "pulse.aesl" }]
}
"""


class Prompt(unittest.TestCase):
    def debug(self, *lines, exit_code=0, arguments=()):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "Count.plan.json"
            path.write_text(COUNT)
            done = subprocess.run([VAGUS, "plan", "debug", path, "--clock", "virtual", *arguments], timeout=60,
                                  input="".join(line + "\n" for line in lines), capture_output=True, text=True)
        self.assertEqual(done.returncode, exit_code, done.stdout + done.stderr)
        return done.stdout, done.stderr

    def test_break_list_and_run(self):
        out, err = self.debug("break actor step count 2", "break state step Loop if n == 2", "break when n > 2",
                              "run", "run", "list", exit_code=3)
        self.assertNotIn("vagus:", err)
        self.assertEqual(out, """\
breakpoint 1 in Count actor step count 2: 0 hits
breakpoint 2 in Count state step Loop if n == 2: 0 hits
breakpoint 3 in Count when n > 2: 0 hits
breakpoint 1, paused at 1.000000, Count: step (activation 4) is about to begin
breakpoint 2, paused at 1.000000, Count: wait (activation 5) is about to begin
1 in Count actor step count 2: 2 hits
2 in Count state step Loop if n == 2: 1 hit
3 in Count when n > 2: 0 hits
""")

    def test_delete_enable_disable(self):
        out, err = self.debug("break actor step", "break actor wait", "disable 1", "list", "delete 2", "run", "list",
                              "enable all", "delete all", "list", "delete 7", "delete x", "delete")
        self.assertIn("1 in Count actor step: 0 hits, disabled\n", out)
        self.assertIn("the run is over at 2.500000: OK\n", out)
        self.assertIn("no breakpoints; `break actor NAME` sets one\n", out)
        self.assertIn("there is no breakpoint 7", err)
        self.assertIn('"x" is not the number of a breakpoint', err)
        self.assertIn("which breakpoint? its number, or all", err)

    def test_why_is_asked_of_the_run_so_far(self):
        """It waits 0.5 s, loops at 0.5 s, and is about to loop at 1 s."""
        out, err = self.debug("break actor step count 2", "run", "why actor step", "why variable n at 0.7", "why event beat",
                              "why fly", "why actor step at x", "delete all", "run", "why end", "step", "why end", exit_code=3)
        place = {name: next(i for i, line in enumerate(COUNT.splitlines(), 1) if name in line) for name in ('"start"', '"wait": {', '"step": {')}
        start, wait, step = place.values()
        looped = f"""\
      0.500 s  the actor step ended with Loop  Count.plan.json:{step}
      0.500 s  the actor step began  Count.plan.json:{step}
      0.500 s  the actor wait ended with Done  Count.plan.json:{wait}
      0.000 s  the actor wait began  Count.plan.json:{wait}
      0.000 s  the plan Count began  Count.plan.json:{start}
"""
        paused = "breakpoint 1, paused at 1.000000, Count: step (activation 4) is about to begin\n"
        again = f"      1.000 s  the actor wait ended with Done  Count.plan.json:{wait}\n      0.500 s  the actor wait began  Count.plan.json:{wait}\n"
        self.assertIn(f"{paused}{again}{looped}      0.500 s  step wrote the variable n (1)  Count.plan.json:{step}\n{looped}", out)
        self.assertIn(f"the run is over at 2.500000: OK\n      2.500 s  the plan Count ended: OK  Count.plan.json:{start}\n", out)
        self.assertIn('event "beat"', err)
        self.assertIn('found "fly"', err)
        self.assertIn("why: at x: expected seconds since the start of the run", err)
        self.assertIn("why: only the first run is recorded; leave and begin again", err)

    def test_why_of_a_robot_goes_on_to_its_script(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "two.plan.json").write_text(TWO_PULSES)
            (folder / "pulse.aesl").write_text(PULSE)
            (folder / "room.world.json").write_text(PULSE_ROOM)
            done = subprocess.run([VAGUS, "plan", "debug", "two.plan.json", "--world", "room.world.json", "--clock", "virtual"],
                                  cwd=folder, timeout=60, input="break actor second\nrun\nwhy actor second\nwhy event pulse\nquit\n",
                                  capture_output=True, text=True, check=False)
        self.assertRegex(done.stdout, r"the script of thymio-II emitted pulse \(\d+\)  pulse\.aesl:7\n")
        self.assertEqual(done.stderr, "")

    def test_why_in_real_time_says_what_it_needs(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "Count.plan.json"
            path.write_text(COUNT)
            done = subprocess.run([VAGUS, "plan", "debug", path], timeout=60, input="why end\n", capture_output=True, text=True, check=False)
        self.assertIn("why: a run in real time cannot be run again; give it a --world, or --clock virtual", done.stderr)

    def test_held_without_a_bus_says_so_and_refuses_what_it_does_not_know(self):
        out, err = self.debug("step", "held", "held step", "held go x", "held fly", "held drop", "held drop 4", "held drop all",
                              exit_code=3)
        self.assertIn("no event of the bus waits for the plan\n", out)
        self.assertIn("no event of the bus waits for the plan", err)
        self.assertIn('"x" is not the number of an event that waits; `held` shows them', err)
        self.assertEqual(err.count("expected go, go N, step, step N, drop N or drop all"), 2)
        self.assertIn("that event does not wait any more: it was let go or dropped", err)

    def test_what_a_robot_sends_at_the_instant_at_which_the_plan_stands_is_held_and_heard_next(self):
        """It counts milliseconds: the plan stands at the first that it hears, and the next one is under way."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "two.plan.json").write_text(TWO_PULSES)
            (folder / "pulse.aesl").write_text(PULSE)
            (folder / "room.world.json").write_text(PULSE_ROOM)
            words = ["two.plan.json", "--world", "room.world.json", "--clock", "virtual"]

            def run(verb, *more, lines=""):
                return subprocess.run([VAGUS, "plan", verb, *words, *more], cwd=folder, timeout=60, input=lines, check=True,
                                      capture_output=True, text=True).stdout

            plain = run("run", "--trace", "-")
            for looks in ("", "held\n"):
                out = run("debug", "--trace", "trace", lines=f"break actor second\nrun\n{looks}continue\n")
                self.assertIn("the run is over", out)
                self.assertEqual((folder / "trace").read_text(), plain)
            self.assertRegex(out, r"\n1 pulse \[\d+\] from node 1\n")
            out = run("debug", "--trace", "trace", lines="break actor second\nrun\nheld drop all\nheld\nheld drop 1\nheld\ncontinue\n")
            self.assertIn("no event of the bus waits for the plan\n", out)
            self.assertNotEqual((folder / "trace").read_text(), plain)

    def test_step_where_and_continue(self):
        out, _ = self.debug("where", "step", "step", "where", "continue")
        self.assertEqual(out, """\
before the start
paused at 0.000000, Count: wait (activation 1) is about to begin
paused at 0.500000, Count: step (activation 2) is about to begin
paused at 0.500000
0 Count: step (activation 2) is about to begin
    tick (global) watches: Tick
the run is over at 2.500000: OK
""")

    def test_print_and_set(self):
        out, err = self.debug("print n", "set n = 1", "step", "step", "print n", "set n = limit * 2", "print",
                              "print n > 3", "print in 0 word & 'c'", "set word = 'x y'", "print word",
                              "set limt = 3", "set n", "print in 3 n", "print n +", "continue")
        self.assertEqual(out, """\
paused at 0.000000, Count: wait (activation 1) is about to begin
paused at 0.500000, Count: step (activation 2) is about to begin
0
0 Count
n = 6 (int)
limit = 3 (int)
word = "a b" (string)
true
"a bc"
"x y"
the run is over at 0.500000: OK
""")
        self.assertIn("the run has not started", err)
        self.assertIn('the plan Count has no variable "limt"; did you mean limit?', err)
        self.assertIn("expected NAME = EXPRESSION", err)
        self.assertIn("there is no level 3", err)

    def test_raise_pause_and_trace(self):
        out, err = self.debug("pause 0.7", "run", "trace on", "raise tik Tick", "raise tick", "raise tick Tick count",
                              "raise tick Tick count=n+4", exit_code=3)
        self.assertEqual(out, """\
paused at 0.700000, Count: wait (activation 3) runs
{"t":0.700000,"plan":"Count","kind":"event","supervisor":"tick","event":"Tick","target":"@terminate","global":true,"activation":3}
{"t":0.700000,"plan":"Count","kind":"write","variable":"n","value":5,"by":"tick"}
{"t":0.700000,"plan":"Count","kind":"interrupted","actor":"wait","activation":3,"ran":true,"stop_us":0}
{"t":0.700000,"plan":"Count","kind":"plan-end","result":"Interrupted"}
the run is over at 0.700000: Interrupted
""")
        self.assertIn('no supervisor "tik" watches now; did you mean tick?', err)
        self.assertIn("expected SUPERVISOR EVENT", err)
        self.assertIn("expected OUTPUT=EXPRESSION", err)

    def test_trace_is_that_of_plan_run(self):
        out, _ = self.debug("step", "step", "pause 1.2", "continue", "step", "continue", arguments=("--trace", "-"))
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "Count.plan.json"
            path.write_text(COUNT)
            plain = subprocess.run([VAGUS, "plan", "run", path, "--clock", "virtual", "--trace", "-"],
                                   capture_output=True, text=True, check=True, timeout=60).stdout
        self.assertEqual([line for line in out.split("\n") if line.startswith("{")], plain.split("\n")[:-1])

    def test_runs_again_with_the_breakpoints_kept(self):
        out, _ = self.debug("run", "break actor step count 4", "run", "continue", "continue")
        self.assertIn("breakpoint 1, paused at 2.000000", out)
        self.assertEqual(out.count("the run is over at 2.500000: OK"), 2)

    def test_help_trace_quit_and_unknown_words(self):
        out, err = self.debug("help", "help step", "hlp", "r", "trace maybe", "break actr step", "break actor stp",
                              "break actor", "break actor step count 0", "break in Cont actor step", "break when",
                              "break event tick Tack", "break actor step count 2 extra", "# a comment", "", "trace off",
                              "pause x", "quit", "run")
        for command in ("break", "delete", "list", "run", "continue", "step", "pause", "print", "set", "raise", "where",
                        "trace on | off", "help", "quit"):
            self.assertIn("\n" + command, "\n" + out)
        for sentence in ('no command "hlp"; did you mean help?', '"r" can be run or raise', "expected on or off",
                         "did you mean actor?", 'no actor "stp"; did you mean step?', "the name of an actor is missing",
                         "expected a whole number from 1", 'no plan "Cont"; did you mean Count?', "needs one",
                         'no event "Tack"; did you mean Tick?', '"extra" is too much here', "expected seconds"):
            self.assertIn(sentence, err)
        self.assertNotIn("the run is over", out)


if __name__ == "__main__":
    unittest.main()
