"""Commands to a fleet whose broker is gone, hangs, or hangs later: each ends within its time, and says what it waited for."""
import pathlib
import signal
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from fleet import Case, FLEET  # noqa: E402
from harness import free_port, vagus  # noqa: E402
from proxy import Proxy  # noqa: E402
import projects  # noqa: E402

VERBS = (["list"], ["watch"], ["log"], ["stop", "all"], ["start", "all"], ["set", "r1", "thymio-II.go", "1"],
         ["raise", "r1", "guard", "Danger"], ["emit", "all", "alarm"], ["tell", "r1", "thymio-II.go"], ["identify", "r1"], ["forget", "r1"],
         ["deploy", "all", "--rollback"])


class Silent(Case):
    def each_says(self, target, why, verbs=VERBS):
        for words in verbs:
            with self.subTest(words[0]):
                done = self.command(target, *words, "--wait", 1)
                self.assertEqual((done.returncode, done.stdout), (1, f"vagus: no connection to {target}: {why}\n"))

    def test_a_broker_that_is_gone(self):
        self.each_says(f"mqtt://localhost:{free_port()}/{FLEET}", "Connection refused")

    def test_a_broker_that_hangs(self):
        broker, target = self.plain_broker()
        broker.signal(signal.SIGSTOP)
        self.each_says(target, "it did not answer within 1 s; is the broker stopped, or something else at that port?")
        broker.kill()

    def test_a_broker_with_tls_that_hangs(self):
        self.init()
        self.serve_broker()
        proxy = self.enterContext(Proxy(self.port))
        proxy.holds = True
        done = self.command(f"mqtts://localhost:{proxy.port}/{FLEET}", "list", *self.login("looker"), "--wait", 1)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn(f"no connection to mqtts://localhost:{proxy.port}/{FLEET}: it did not answer within 1 s", done.stdout)

    def test_a_broker_that_hangs_while_something_is_ordered(self):
        """Who ordered it is told of each robot, and of the broker when the link counts as broken."""
        self.init("r1")
        self.serve_broker()
        proxy = self.enterContext(Proxy(self.port))
        through = f"mqtts://localhost:{proxy.port}/{FLEET}"
        self.joined("r1")
        self.wait_state("r1", "running")
        with vagus("fleet", through, "deploy", "all", "--project", projects.thymio(self.folder / "next", script=""), "--serve-cert",
                   self.broker_folder / "broker.crt", "--serve-key", self.broker_folder / "broker.key", *self.login("operator"), "--wait",
                   20) as program:
            program.wait_line("^r1: wanted$")
            proxy.holds = True
            program.wait_line(rf"^vagus: no connection to {through}: .*; trying again$")
            program.wait_line("^r1: failed: did not answer; it finds it when it is back$")
            self.assertEqual(program.wait_end(), 1)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:])], verbosity=2, warnings="ignore")
