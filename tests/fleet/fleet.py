"""Robots of a fleet: served simulated Thymios, a broker (Debian's mosquitto), and somebody who tells them what to do."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "tests/support"), str(ROOT / "tests/studio")]

import projects  # noqa: E402
from harness import GIVE_UP_AFTER, Program, VAGUS, connect, free_port, vagus, wait_until  # noqa: E402

FLEET = "lab"
# Emits alarm when it is told to, and counts those that come.
SCRIPT = """var go = 0
var heard = 0
var last = 0

timer.period[0] = 20

onevent timer0
	if go == 1 then
		go = 0
		emit alarm [7]
	end

onevent alarm
	heard += 1
	last = event.args[0]
"""
AESL = """<!DOCTYPE aesl-source>
<network>
<event size="1" name="alarm"/>
<keywords flag="true"/>
<node nodeId="1" name="thymio-II"><![CDATA[{script}]]></node>
</network>
"""
PART = {"name": FLEET, "groups": ["red"], "send": ["alarm"], "hear": ["alarm"], "tell": ["thymio-II.heard", "thymio-II.last"]}


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-fleet-")))
        self.broker_folder, self.port = self.folder / "broker", free_port()

    # ---- the broker ----

    def init(self, *robots, folder=None):
        words = [word for robot in robots for word in ("--robot", robot)]
        folder = folder or self.broker_folder
        if not (folder / "mosquitto.conf").exists():
            words += ["--port", self.port, "--web-port", free_port()]
        done = self.command("init", folder, *words)
        self.assertEqual(done.returncode, 0, done.stdout)

    def serve_broker(self, *arguments):
        program = self.enterContext(vagus("fleet", "serve", self.broker_folder, *arguments))
        program.wait_line(rf"^fleet mqtts://localhost:{self.port}$")
        return program

    def broker(self, *robots):
        self.init(*robots)
        return self.serve_broker()

    def plain_broker(self):
        """One without TLS, which everybody may use; its target."""
        port = free_port()
        configuration = self.folder / f"plain-{port}.conf"
        configuration.write_text(f"user root\nallow_anonymous true\nlistener {port} localhost\n", encoding="ascii")
        broker = self.enterContext(Program(shutil.which("mosquitto") or "/usr/sbin/mosquitto", "-c", configuration))
        connect(port).close()
        return broker, f"mqtt://localhost:{port}/{FLEET}"

    @property
    def target(self):
        return f"mqtts://localhost:{self.port}/{FLEET}"

    def login(self, name):
        return ["--tls-ca", self.broker_folder / "ca.crt", "--login", self.broker_folder / f"{name}.login"]

    # ---- robots ----

    def robot(self, name, *arguments, login=None, script=SCRIPT, aesl=AESL, target=None, folder=None, env=None, **part):
        """With a login of its own, if the broker has logins; in a folder of its own, unless it is told."""
        folder = folder or self.folder / f"{name}-{free_port()}"
        projects.thymio(folder, script="", fleet={**PART, **part})
        projects.write(folder, "robot.aesl", aesl.format(script=script))
        projects.write(folder, "pages/index.html", "<!doctype html>\n")
        program = self.enterContext(vagus(
            "serve", folder, "--start", "--port", 0, "--data", folder / f"data-{name}", "--config", folder / "config", "--pages",
            folder / "pages", "--fleet", target or self.target, "--robot", name,
            *([] if self.is_plain(target) else self.login(login or name)), *arguments, env=env))
        program.wait_line(r"^serve http")
        return program

    def joined(self, name, *arguments, **options):
        program = self.robot(name, *arguments, **options)
        program.wait_line(rf'fleet: this robot is "{name}" of the fleet')
        return program

    @staticmethod
    def is_plain(target):
        return target is not None and target.startswith("mqtt:")

    # ---- who tells them ----

    def command(self, *arguments, env=None):
        return subprocess.run([VAGUS, "fleet", *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              timeout=4 * GIVE_UP_AFTER, check=False, env={**os.environ, **(env or {})})

    def desk(self, *arguments, by="operator", wait=GIVE_UP_AFTER):
        return self.command(self.target, *arguments, *self.login(by), "--wait", wait)

    def do(self, *arguments, **options):
        done = self.desk(*arguments, **options)
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def is_told(self, robot, variable, value):
        """Somebody asks for a variable, and waits until the robot tells that value."""
        with vagus("fleet", self.target, "tell", robot, variable, *self.login("operator"), "--wait", GIVE_UP_AFTER) as program:
            program.wait_line(rf"^{robot}: {re.escape(variable)} = {value}$")

    def states(self):
        """What each robot shows, by name."""
        done = self.desk("list", "--json")
        robots = [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]
        return {robot["robot"]: robot for robot in robots}

    def state(self, name):
        return self.states().get(name, {}).get("state", {}).get("state")

    def wait_state(self, name, state):
        wait_until(f"{name} never was {state}", lambda: self.state(name) == state)

    def watch(self):
        return self.enterContext(vagus("fleet", self.target, "watch", *self.login("looker")))

    def emit_alarm(self, name):
        self.do("set", name, "thymio-II.go", 1)


class Fleet(Case):
    def test_the_alarm_of_one_is_heard_by_the_other(self):
        self.broker("r1", "r2")
        self.joined("r1"), self.joined("r2")
        self.wait_state("r1", "running"), self.wait_state("r2", "running")
        watch = self.watch()
        self.emit_alarm("r1")
        watch.wait_lines(r"^r2: thymio-II\.heard = 1$", r"^r2: thymio-II\.last = 7$")
        self.emit_alarm("r2")
        watch.wait_line(r"^r1: thymio-II\.heard = 1$")
        self.assertFalse([line for line in watch.lines if "heard = 2" in line], "an event went round")

    def test_only_those_of_the_group_are_heard(self):
        self.broker("r1", "r2", "r3")
        self.joined("r1"), self.joined("r2", groups=["blue"])
        self.joined("r3", hear=[{"event": "alarm", "from": "blue"}])
        for name in ("r1", "r2", "r3"):
            self.wait_state(name, "running")
        watch = self.watch()
        self.emit_alarm("r1")
        watch.wait_line(r"^r2: thymio-II\.heard = 1$")
        self.emit_alarm("r2")
        watch.wait_lines(r"^r3: thymio-II\.heard = 1$", r"^r1: thymio-II\.heard = 1$")
        self.assertFalse([line for line in watch.lines if line.startswith("r3") and "heard = 2" in line])

    def test_stop_all_names_who_did_not_answer(self):
        self.broker("r1", "r2")
        self.joined("r1")
        second = self.joined("r2")
        self.wait_state("r1", "running"), self.wait_state("r2", "running")
        self.assertRegex(self.do("stop", "all"), r"(?m)^r1: stopped$[\s\S]*^r2: stopped$[\s\S]*^2 of 2 robots: stopped$")
        self.wait_state("r1", "stopped"), self.wait_state("r2", "stopped")
        second.kill()
        done = self.desk("stop", "all", wait=2)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stdout, r"(?m)^r1: stopped$[\s\S]*^r2: did not answer \(lost\)$[\s\S]*^1 of 2 robots: stopped$")

    def test_start_pause_and_continue(self):
        self.broker("r1")
        self.joined("r1")
        self.wait_state("r1", "running")
        self.do("pause", "r1")
        self.wait_state("r1", "paused")
        self.do("continue", "r1")
        self.wait_state("r1", "running")
        self.do("stop", "all")
        done = self.desk("continue", "r1")
        self.assertEqual(done.returncode, 1)
        self.assertIn("r1: not done: it is not paused", done.stdout)
        done = self.desk("start")
        self.assertEqual(done.returncode, 2)
        self.assertIn("which robots? Write a name, all, or --group GROUP", done.stdout)
        self.do("start", "--group", "red")
        self.wait_state("r1", "running")
        self.assertIn('no robot of the group "blue" of the fleet', self.desk("list", "--group", "blue").stdout)

    def test_events_are_logged_and_emitted(self):
        self.broker("r1", "r2")
        self.joined("r1"), self.joined("r2")
        self.wait_state("r1", "running"), self.wait_state("r2", "running")
        log = self.enterContext(vagus("fleet", self.target, "log", *self.login("looker")))
        watch = self.watch()
        self.do("emit", "r1", "alarm", 3)
        watch.wait_line(r"^r1: thymio-II\.last = 3$")
        self.emit_alarm("r2")
        log.wait_line(r"^r2: alarm 7$")
        self.assertFalse([line for line in log.lines if line.startswith("r1")], "what an operator emits is no event of the robot")

    def test_a_robot_without_a_broker_stops_as_its_project_says(self):
        broker = self.broker("r1", "r2")
        first, second = self.joined("r1"), self.joined("r2", broker_lost="continue")
        self.wait_state("r1", "running"), self.wait_state("r2", "running")
        broker.stop()
        first.wait_line(r"not in the fleet .* the robot stops, as its project says")
        second.wait_line(r"this robot goes on, as its project says")
        self.serve_broker()
        for program, name in ((first, "r1"), (second, "r2")):
            program.wait_line(rf'fleet: this robot is "{name}"')
        self.wait_state("r1", "stopped"), self.wait_state("r2", "running")
        self.do("start", "r1")
        self.wait_state("r1", "running")

    def test_a_script_that_does_not_start_is_a_fault_that_says_why(self):
        self.broker("r1")
        self.joined("r1", script="timer.period[0] = 20\n\nonevent timer0\n\twhile 1 == 1 do\n\tend\n")
        self.wait_state("r1", "fault")
        self.assertRegex(self.do("list"), r"r1: online, fault for \d+ s \(Thymio\); it does not start: node 1: line 4: .*never end")
        self.assertIn("1 of 1 robots: stopped", self.do("stop", "all"))
        self.wait_state("r1", "stopped")

    def test_a_robot_that_dies_is_lost_and_comes_back(self):
        self.broker("r1")
        first = self.joined("r1")
        first.kill()
        wait_until("the broker never missed it", lambda: self.states()["r1"]["connection"]["state"] == "lost")
        self.joined("r1")
        self.wait_state("r1", "running")

    def test_who_says_good_bye_is_offline_and_can_be_forgotten(self):
        self.broker("r1")
        first = self.joined("r1")
        first.stop()
        wait_until("it never was offline", lambda: "no robot of the fleet" in self.desk("list").stdout)
        self.assertIn("offline", self.desk("list", "r1").stdout)
        done = self.desk("forget", "r1", by="operator")
        self.assertEqual(done.returncode, 1)
        self.assertIn("the broker refuses", done.stdout)
        self.do("forget", "r1", by="r1")
        self.assertEqual(self.states(), {})


class Names(Case):
    def test_a_name_taken_twice(self):
        self.broker("r1")
        self.joined("r1")
        second = self.robot("r1")
        second.wait_line(r"another robot has this name, and answers; this one stays out of the fleet")
        self.assertEqual(self.states()["r1"]["connection"]["state"], "online")
        self.assertIn("1 of 1 robots: stopped", self.do("stop", "all"))

    def test_the_name_is_free_when_its_robot_goes(self):
        self.broker("r1")
        first = self.joined("r1")
        second = self.robot("r1")
        second.wait_line(r"stays out of the fleet")
        first.stop()
        second.wait_line(r'fleet: this robot is "r1" of the fleet')


class Rights(Case):
    def test_nobody_writes_below_the_name_of_another(self):
        self.broker("r1", "r2")
        intruder = self.robot("r2", login="r1")
        intruder.wait_line(r"the broker does not pass on what this robot says")
        self.assertEqual(self.states(), {})

    def test_who_only_looks_may_stop_and_nothing_else(self):
        self.broker("r1")
        self.joined("r1")
        self.wait_state("r1", "running")
        self.assertIn("1 of 1 robots: stopped", self.do("stop", "all", by="looker"))
        done = self.desk("start", "all", by="looker", wait=3)
        self.assertEqual(done.returncode, 1)
        self.assertIn("r1: did not answer", done.stdout)
        self.assertRegex(done.stdout, r"(?i)the broker does not pass it on: not authori[sz]ed; use the --login of an operator")
        self.assertEqual(self.state("r1"), "stopped")

    def test_a_robot_tells_no_other_what_to_do(self):
        self.broker("r1", "r2")
        self.joined("r1")
        self.wait_state("r1", "running")
        self.assertEqual(self.desk("stop", "all", by="r2", wait=3).returncode, 1)
        self.assertEqual(self.state("r1"), "running")

    def test_another_authority_is_not_trusted(self):
        self.broker("r1")
        self.init(folder=self.folder / "other")
        done = self.command(self.target, "list", "--tls-ca", self.folder / "other" / "ca.crt", "--login",
                            self.broker_folder / "looker.login", "--wait", 3)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn(f"no connection to mqtts://localhost:{self.port}/lab", done.stdout)

    def test_a_port_of_another_kind_is_named(self):
        self.broker()
        web, = [port for port in re.findall(r"(?m)^listener (\d+)$", (self.broker_folder / "mosquitto.conf").read_text(encoding="utf-8"))
                if int(port) != self.port]
        self.assertIn(f"what answers at port {web} does not speak MQTT; is that the port for WebSockets?",
                      self.refused_at(f"mqtts://localhost:{web}/{FLEET}"))
        self.assertIn("Does the broker want TLS? Then write mqtts://", self.refused_at(f"mqtt://localhost:{self.port}/{FLEET}", tls=False))

    def test_a_port_without_tls_is_named(self):
        self.init()
        port = int(re.search(r":(\d+)/", self.plain_broker()[1]).group(1))
        self.assertIn(f"what answers at port {port} does not speak TLS; does the broker want mqtt://?", self.refused_at(f"mqtts://localhost:{port}/{FLEET}"))

    def refused_at(self, target, tls=True):
        done = self.command(target, "list", *self.login("looker")[0 if tls else 2:], "--wait", 3)
        self.assertEqual(done.returncode, 1, done.stdout)
        return done.stdout

    def test_who_watches_is_told_that_the_broker_has_another_authority(self):
        self.init()
        old = self.folder / "old"
        shutil.copytree(self.broker_folder, old)
        broker = self.serve_broker()
        watch = self.enterContext(vagus("fleet", self.target, "watch", "--tls-ca", old / "ca.crt", "--login", old / "looker.login"))
        wait_until("it never connected", lambda: broker.running() and self.desk("list").returncode == 0)
        broker.stop()
        watch.wait_line(rf"^vagus: no connection to mqtts://localhost:{self.port}/lab: .*; trying again$")
        for name in ("ca.crt", "ca.key", "broker.crt", "broker.key"):
            (self.broker_folder / name).unlink()
        self.init()
        broker = self.serve_broker()
        watch.wait_line(rf"TLS failed: the broker's certificate is not signed by {re.escape(str(old / 'ca.crt'))}")
        broker.stop()
        for name in ("ca.crt", "ca.key", "broker.crt", "broker.key"):
            shutil.copy(old / name, self.broker_folder / name)
        self.serve_broker()
        watch.wait_line(r"^vagus: connected again$")

    def test_a_wrong_password_is_refused(self):
        self.broker("r1")
        wrong = self.folder / "wrong.login"
        wrong.write_text("looker\nnot this\n", encoding="ascii")
        done = self.command(self.target, "list", "--tls-ca", self.broker_folder / "ca.crt", "--login", wrong, "--wait", 3)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertRegex(done.stdout, r"refused: (?i:not authori[sz]ed)")

    def test_secrets_are_for_their_owner_alone(self):
        self.init("r1")
        for file in self.broker_folder.rglob("*"):
            if file.is_file() and file.name != "broker.ext":
                self.assertEqual(file.stat().st_mode & 0o077, 0, file)
        before = (self.broker_folder / "r1.login").read_text(encoding="ascii")
        self.init("r1", "r2")
        self.assertEqual((self.broker_folder / "r1.login").read_text(encoding="ascii"), before)
        users = [line.split(":")[0] for line in (self.broker_folder / "passwords").read_text(encoding="ascii").splitlines()]
        self.assertEqual(users, ["operator", "looker", "keeper", "r1", "r2"])

    # The first init of many people comes before `apt-get install mosquitto`.
    def test_logins_that_an_earlier_init_left_are_finished(self):
        without = self.folder / "bin"
        without.mkdir()
        (without / "openssl").symlink_to(shutil.which("openssl"))
        first = subprocess.run([str(word) for word in (VAGUS, "fleet", "init", self.broker_folder, "--port", self.port,
                                                       "--web-port", free_port())],
                               env={**os.environ, "PATH": str(without)}, capture_output=True, text=True, timeout=GIVE_UP_AFTER)
        if first.returncode == 0:
            self.skipTest("mosquitto_passwd is in /usr/sbin")
        self.assertIn("mosquitto_passwd is not installed", first.stderr)
        self.init()
        self.serve_broker()
        done = self.command(self.target, "list", *self.login("looker"))
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_a_further_host_is_in_the_certificate_after_another_init(self):
        self.init("r1")
        first = (self.broker_folder / "broker.crt").read_bytes()
        self.init("r2")
        self.assertEqual((self.broker_folder / "broker.crt").read_bytes(), first)
        done = self.command("init", self.broker_folder, "--host", "127.0.0.2")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("broker.crt is new", done.stdout)
        self.assertIn("start `vagus fleet serve` again", done.stdout)
        self.serve_broker()
        target = f"mqtts://127.0.0.2:{self.port}/{FLEET}"
        self.assertEqual(self.command(target, "list", *self.login("looker")).returncode, 0)

    def test_init_replaces_no_authority_that_robots_trust(self):
        """What is lost is made by what is left of it, or named."""
        self.init()
        kept = {name: (self.broker_folder / name).read_bytes() for name in ("ca.crt", "ca.key", "broker.crt", "broker.key")}
        old = self.folder / "old.crt"
        old.write_bytes(kept["ca.crt"])

        def lose(*names):
            for name, content in kept.items():
                (self.broker_folder / name).write_bytes(content)
            for name in names:
                (self.broker_folder / name).unlink()
        lose("ca.key")
        self.init()
        self.assertEqual((self.broker_folder / "ca.crt").read_bytes(), kept["ca.crt"])
        refused = self.command("init", self.broker_folder, "--host", "127.0.0.2")
        self.assertEqual(refused.returncode, 1, refused.stdout)
        self.assertIn("ca.key is lost", refused.stdout)
        lose("ca.crt", "ca.key")
        refused = self.command("init", self.broker_folder)
        self.assertEqual(refused.returncode, 1, refused.stdout)
        self.assertIn("ca.crt and ca.key are lost, and broker.crt is signed by them", refused.stdout)
        lose("ca.crt")
        self.init()
        self.assertEqual((self.broker_folder / "ca.key").read_bytes(), kept["ca.key"])
        self.serve_broker()
        for authority in (old, self.broker_folder / "ca.crt"):
            done = self.command(self.target, "list", "--tls-ca", authority, "--login", self.broker_folder / "looker.login")
            self.assertEqual(done.returncode, 0, done.stdout)

    def test_a_lost_key_of_the_broker_keeps_its_names(self):
        self.init()
        self.assertEqual(self.command("init", self.broker_folder, "--host", "127.0.0.2").returncode, 0)
        (self.broker_folder / "broker.key").unlink()
        done = self.command("init", self.broker_folder)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(done.stdout, r"broker.crt is new, for the names .*IP:127\.0\.0\.2")

    def test_init_refuses_what_it_would_not_do(self):
        self.init()
        other = self.command("init", self.broker_folder, "--port", 1)
        self.assertEqual(other.returncode, 2, other.stdout)
        self.assertIn(f"--port 1: the broker of {self.broker_folder} has the ports {self.port}, ", other.stdout)
        wrong = self.command("init", self.broker_folder, "--host", "a,DNS:b")
        self.assertEqual(wrong.returncode, 2, wrong.stdout)
        self.assertIn('--host "a,DNS:b": expected the name of a computer', wrong.stdout)

    def test_a_name_and_a_group_are_not_given_together(self):
        done = self.command("mqtt://localhost:1/lab", "stop", "r1", "--group", "red")
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn("found a name and a --group", done.stdout)

    def test_init_says_what_it_cannot_do(self):
        def refused(status, *words):
            done = self.command("init", self.broker_folder, *words)
            self.assertEqual(done.returncode, status, done.stdout)
            self.assertFalse(self.broker_folder.exists())
            return done.stdout
        self.assertIn("cannot be the name of a robot", refused(2, "--robot", "all"))
        self.assertIn("cannot be the name of a robot", refused(2, "--robot", "operator"))
        self.assertIn("--robot t9..t1: expected two numbers, the smaller one first", refused(2, "--robot", "t9..t1"))
        many = [word for i in range(1001) for word in ("--robot", f"r{i}")]
        self.assertIn("--robot: 1000 at a time at most, found 1001", refused(1, *many))
        missing = self.command("serve", self.broker_folder)
        self.assertEqual(missing.returncode, 2)
        self.assertIn("vagus fleet init", missing.stdout)

    def test_mosquitto_and_keeper_end_with_the_program(self):
        broker = self.broker()
        children = pathlib.Path(f"/proc/{broker.process.pid}/task/{broker.process.pid}/children")
        wait_until("there was no keeper", lambda: len(children.read_text(encoding="ascii").split()) == 2)
        both = children.read_text(encoding="ascii").split()
        broker.kill()
        for child in both:
            wait_until("mosquitto or the keeper went on", lambda: not pathlib.Path(f"/proc/{child}").exists() or
                       "Z" in pathlib.Path(f"/proc/{child}/stat").read_text(encoding="ascii").rsplit(")", 1)[1][:3])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:])], verbosity=2, warnings="ignore")
