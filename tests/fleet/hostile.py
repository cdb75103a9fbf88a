"""A fleet whose link breaks, whose broker is killed, and in which somebody floods or speaks in the name of others."""
import os
import pathlib
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from fleet import Case, FLEET  # noqa: E402
from harness import Program, vagus, wait_until  # noqa: E402
from keeper import children, SERVES, words_of, WORKERS  # noqa: E402
from proxy import Proxy  # noqa: E402

# The times of the task, not of a judgement: how long the link is cut, how late it is.
CUT, LATE = 5, 1
# Sends its alarms in order, as soon as go is 1; counts those that come, and those that come out of order.
SCRIPT = """var go = 0
var sent = 0
var heard = 0
var wrong = 0

timer.period[0] = 250

onevent timer0
	if go == 1 and sent < {events} then
		sent += 1
		emit alarm [sent]
	end

onevent alarm
	heard += 1
	if event.args[0] != heard then
		wrong += 1
	end
"""
TELL = [f"thymio-II.{name}" for name in ("sent", "heard", "wrong")]


class Links(Case):
    def setUp(self):
        super().setUp()
        self.init("r1", "r2")
        self.serve_broker()
        self.proxy = self.enterContext(Proxy(self.port))
        self.direct, self.robots_target = self.target, f"mqtts://localhost:{self.proxy.port}/{FLEET}"

    def alarms_come(self, events, trouble):
        """Two robots behind the proxy; one sends that many alarms while the link is in trouble."""
        for name in ("r1", "r2"):
            self.joined(name, script=SCRIPT.format(events=events), tell=TELL, broker_lost="continue", target=self.robots_target)
            self.wait_state(name, "running")
        watch = self.watch()
        self.do("set", "r1", "thymio-II.go", 1)
        watch.wait_line(r"^r2: thymio-II\.heard = ([3-9]|\d\d)$")  # at least three: not each value is told
        trouble()
        watch.wait_line(rf"^r2: thymio-II\.heard = {events}$")
        self.assertFalse([line for line in watch.lines if line.startswith("r2: thymio-II.wrong") and not line.endswith("= 0")],
                         "an alarm came twice, or before another")

    def test_a_link_that_is_cut_loses_no_event(self):
        def cut():
            self.proxy.is_cut = True
            time.sleep(CUT)
            self.proxy.is_cut = False
        self.alarms_come(60, cut)

    def test_a_link_that_carries_nothing_for_a_while_loses_no_event(self):
        def hold():
            self.proxy.holds = True
            time.sleep(CUT)
            self.proxy.holds = False
        self.alarms_come(60, hold)

    def test_a_link_that_is_late_loses_no_event(self):
        def be_late():
            self.proxy.delay = LATE
        self.alarms_come(40, be_late)
        self.assertIn("2 of 2 robots: stopped", self.do("stop", "all"))

    def test_a_command_that_comes_too_late_is_refused(self):
        self.joined("r1", target=self.robots_target)
        self.wait_state("r1", "running")
        self.proxy.delay = 2  # each way: the state that tells the clock, and the command; a command has 3 s
        done = self.desk("pause", "r1")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stdout, r"r1: (not done: it came \d+ ms too late|did not answer)")
        self.proxy.delay = 0.0
        wait_until("its state never came", lambda: self.state("r1") == "running")


class Killed(Case):
    def kill_broker(self, broker):
        child, = [one for one in children(broker.process.pid) if "mosquitto" in words_of(one)[0]]
        os.kill(child, signal.SIGKILL)
        self.assertEqual(broker.wait_end(), 1)
        self.assertTrue([line for line in broker.lines if "mosquitto was ended by signal 9" in line])

    def test_owners_publish_again_what_the_broker_has_lost(self):
        broker = self.broker("r1")
        self.joined("r1", broker_lost="continue")
        self.wait_state("r1", "running")
        self.kill_broker(broker)  # it saves once a minute: this one has saved nothing
        self.serve_broker()
        self.wait_state("r1", "running")
        robot = self.states()["r1"]
        self.assertEqual((robot["connection"]["state"], robot["description"]["groups"]), ("online", ["red"]))
        wait_until("its nodes were never told", lambda: self.states()["r1"]["description"]["nodes"] == ["thymio-II"])

    def test_the_keeper_publishes_again_what_the_broker_has_lost(self):
        self.init("boss", *(f"w{i}" for i in range(4)))
        broker = self.serve_broker("--fleet", "other")
        keeper = self.enterContext(vagus("fleet", self.target, "keep", *self.login("keeper")))
        keeper.wait_line(SERVES)
        workers = self.enterContext(Program(WORKERS, self.target, self.broker_folder, 4, 400, 1))
        workers.wait_line(r"^finished 100$")
        self.kill_broker(broker)
        self.serve_broker("--fleet", "other")
        self.assertEqual(workers.wait_end(), 0, workers.lines)
        self.assertIn("all 400 tasks are finished", workers.lines)


class Others(Case):
    def publish(self, user, topic, lines, *options):
        """What Debian's mosquitto_pub says in that user's name, one message a line; its exit status."""
        name, password = (self.broker_folder / f"{user}.login").read_text(encoding="ascii").split()
        return subprocess.run(
            ["mosquitto_pub", "-V", "mqttv5", "-h", "localhost", "-p", str(self.port), "--cafile",
             str(self.broker_folder / "ca.crt"), "-u", name, "-P", password, "-q", "1", "-t", f"vagus/1/{FLEET}/{topic}", "-l",
             *options], input="".join(line + "\n" for line in lines), text=True, capture_output=True, check=False)

    def test_a_flood_of_one_leaves_the_others_their_stop(self):
        self.broker("r1", "r2", "flood")
        self.joined("r1"), self.joined("r2")
        self.wait_state("r1", "running"), self.wait_state("r2", "running")
        watch = self.watch()
        events = [f'{{"number": {i}, "epoch": 1, "groups": [], "args": [1]}}' for i in range(1, 5001)]
        self.publish("flood", "robot/flood/event/alarm", events)
        self.publish("flood", "robot/flood/event/alarm", ["no JSON", "{}", "[" * 5000])
        self.assertIn("2 of 2 robots: stopped", self.do("stop", "all"))
        wait_until("what was left out is not told", lambda: self.states()["r1"]["state"]["left_out"] > 0)
        watch.drain()
        heard = [int(line.rsplit(" ", 1)[1]) for line in watch.lines if line.startswith("r1: thymio-II.heard =")]
        self.assertLess(max(heard, default=0), 5000)

    def test_a_robot_writes_below_its_own_name_alone(self):
        self.broker("r1", "r2")
        self.joined("r2")
        self.wait_state("r2", "running")
        watch = self.watch()
        watch.wait_line(r"^r2: online")
        stop = '{"id": "c1", "reply": "r1"}'
        for topic in ("robot/r2/connection", "robot/r2/want", "shared/map", "task/q/t", "keeper/beat", "keeper/answer/r2"):
            self.publish("r1", topic, ['{"state": "lost", "instance": "i", "epoch": 1}'], "-r")
        for topic in ("cmd/r2/stop", "cmd/all/stop", "cmd/group/red/stop"):
            self.publish("r1", topic, [stop])
        # One more, that is allowed, has passed behind them.
        self.publish("r1", "robot/r1/event/alarm", ['{"number": 1, "epoch": 1, "groups": [], "args": [7]}'])
        watch.wait_line(r"^r2: thymio-II\.heard = 1$")
        self.assertEqual(self.state("r2"), "running")
        self.assertEqual(self.states()["r2"]["connection"]["state"], "online")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:])], verbosity=2, warnings="ignore")
