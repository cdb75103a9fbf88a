"""`vagus conformance` over real sockets: each test is named in CMakeLists.txt."""
import json
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import listening, run_vagus, simulated, vagus


class Conformance(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-conformance-")))

    def start(self, *words):
        program = self.enterContext(vagus(*words))
        return program, f"tcp:127.0.0.1:{listening(program)}"

    def node(self, number=3, name="rover"):
        return self.start("node", "--id", number, "--name", name, "--listen", "tcp:127.0.0.1:0")

    def thymio(self):
        program = self.enterContext(simulated(self.folder, {"name": "alice", "node": 6}))
        return f"tcp:127.0.0.1:{listening(program)}"

    def conformance(self, target, *options, status=0):
        return run_vagus("conformance", target, *options, status=status)

    def test_a_software_node_passes(self):
        _, target = self.node()
        told = self.conformance(target).split("\n")
        self.assertEqual(told[0], 'vagus: examining node 3 "rover": its program is replaced, and cannot be put back; '
                                  "what it keeps in flash stays")
        self.assertRegex(told[-2], r'^1\d\d passed, 0 failed, 4 skipped: node 3 "rover"$')
        self.assertEqual(told[-1], "vagus: the node is left without a program; load yours again")
        self.assertIn("passed   operators    operator <<  (3.4)", told)

    def test_a_node_behind_a_switch_is_named_by_number_or_name(self):
        _, target = self.start("switch", "--listen", "tcp:127.0.0.1:0")
        for number, name in ((3, "rover"), (4, "arm")):
            self.enterContext(vagus("node", "--id", number, "--name", name, "--connect", target))
            run_vagus("net", target, "describe", number, "--wait", 60)
        self.assertIn("several nodes answer", self.conformance(target, status=2))
        self.assertIn('node 4 "arm"', self.conformance(target, "--node", "arm", "--only", "opcodes"))
        self.assertIn('node 3 "rover"', self.conformance(target, "--node", "3", "--only", "opcodes"))
        told = self.conformance(target, "--node", "leg", status=1)
        self.assertIn('no node leg answers on', told)
        self.assertIn('there is node 3 "rover", node 4 "arm"', told)

    def test_a_simulated_thymio_passes_and_must_be_allowed_to_drive(self):
        target = self.thymio()
        refused = self.conformance(target, status=2)
        self.assertIn("seems to have motors (motor.left.target)", refused)
        self.assertIn("--may-drive", refused)
        told = self.conformance(target, "--may-drive")
        self.assertRegex(told, r'1\d\d passed, 0 failed, 6 skipped: node 6 "thymio-II"')
        speed = json.loads(run_vagus("net", target, "get", 6, "motor.left.target", "--json"))
        self.assertEqual(speed, {"motor.left.target": [0]})

    def test_what_a_node_keeps_is_overwritten_only_if_asked_so(self):
        flash = self.folder / "rover.abo"
        _, target = self.start("node", "--flash", flash, "--listen", "tcp:127.0.0.1:0")
        told = self.conformance(target, "--only", "flash")
        self.assertIn("it would overwrite the program that the node keeps: say --flash", told)
        self.assertFalse(flash.exists())
        told = self.conformance(target, "--only", "flash", "--flash")
        self.assertIn("passed   flash        WriteBytecode leaves program and variables", told)
        self.assertIn("needs a restart by Reboot; the node ignores it", told)
        self.assertTrue(flash.exists())
        _, without = self.node()
        told = self.conformance(without, "--only", "flash", "--flash")
        self.assertIn('needs flash; the node says "Flashing failed: this node was started without --flash"', told)

    def test_a_node_is_sent_to_sleep_only_if_asked_so(self):
        _, target = self.node()
        told = self.conformance(target, "--only", "sleep")
        self.assertIn("a node that can sleep would have to be switched on: say --sleep", told)
        told = self.conformance(target, "--only", "sleep", "--sleep")
        self.assertIn("passed   sleep        SuspendToRam leaves a node awake that cannot sleep", told)

    def test_the_result_as_json(self):
        _, target = self.node()
        with vagus("conformance", target, "--json", "--only", "fragments") as program:
            self.assertEqual(program.wait_end(), 0)
            lines = [line for line in program.lines if not line.startswith("vagus: ")]
        result = json.loads("\n".join(lines))
        self.assertEqual((result["node"], result["name"], result["skipped"]), (3, "rover", 1))
        self.assertEqual(result["checks"], [{
            "group": "description", "check": "fragments of the description can be asked for", "section": "2.9",
            "result": "skipped", "found": "needs protocol version 8; the node has 5"}])

    def test_a_node_that_dies_meanwhile_is_told(self):
        # A Thymio takes seconds for the long events.
        program = self.enterContext(simulated(self.folder, {"name": "alice", "node": 6}))
        with vagus("conformance", f"tcp:127.0.0.1:{listening(program)}", "--may-drive") as examination:
            examination.wait_line("^passed   description")
            program.kill()
            self.assertEqual(examination.wait_end(), 1)
            text = "\n".join(examination.lines)
        self.assertRegex(text, r"not run  \w+ ")
        self.assertIn("lost at ", text)
        self.assertIn("the node could not be cleared; restart it", text)

    def test_words_that_are_wrong(self):
        _, target = self.node()
        self.assertIn('no check has "opcoeds"', self.conformance(target, "--only", "opcoeds", status=2))
        with vagus("switch", "--listen", "tcp:127.0.0.1:0") as empty:
            nobody = f"tcp:127.0.0.1:{listening(empty)}"
            self.assertIn(f"no node answers on {nobody}", self.conformance(nobody, status=1))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"Conformance.{name}" for name in sys.argv[1:])], verbosity=2, warnings="ignore")
