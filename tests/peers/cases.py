"""Vagus and the programs of Debian's package `aseba`, over real sockets: each test is named in CMakeLists.txt."""
import json
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import (ROOT, Bus, Display, Program, free_port, listening, playground, run_vagus, vagus)

COUNTER = """<!DOCTYPE aseba-source>
<network>
<event size="0" name="ping"/>
<event size="1" name="pong"/>
<constant value="7" name="STEP"/>
<node nodeId="{id}" name="{name}">var n = 0
onevent ping
n += STEP
emit pong n
</node>
</network>
"""

RUN = 0xA003
GET_DESCRIPTION = 0xA010
LIST_NODES = 0xA011


class Peers(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-peer-")))

    def start(self, program):
        return self.enterContext(program)

    def node(self, number=3, name="rover"):
        """A Vagus node; gives program and port."""
        program = self.start(vagus("node", "--id", number, "--name", name, "--listen", "tcp:127.0.0.1:0"))
        return program, listening(program)

    def switch(self, *targets):
        program = self.start(vagus("switch", "--listen", "tcp:127.0.0.1:0", *targets))
        return program, listening(program)

    def foreign_switch(self, *targets):
        port = free_port()
        program = self.start(Program("asebaswitch", "-p", port, *targets))
        return program, port

    def project(self, name, number):
        path = self.folder / "counter.aesl"
        path.write_text(COUNTER.format(name=name, id=number), encoding="utf-8")
        return path

    def playground(self, count):
        display = self.start(Display())
        ports = [free_port() for _ in range(count)]
        program = self.start(playground(display, self.folder, ports))
        for port in ports:
            Bus(port).leave()
        return program, ports

    def wait_for_nodes(self, target, names):
        """Asks until the network lists exactly these names."""
        for _ in range(60):
            found = json.loads(run_vagus("net", target, "list", "--json"))
            if sorted(node["name"] for node in found) == sorted(names):
                return found
        self.fail(f"{target} never had the nodes {names}; last: {found}")

    # asebacmd ------------------------------------------------------------------------------------

    def test_asebacmd_lists_a_vagus_node(self):
        _, port = self.node()
        with Program("asebacmd", "-t", f"tcp:127.0.0.1;{port}", "listnodes") as command:
            with_status = command.wait_end()
        self.assertEqual(with_status, 0)

    def test_asebacmd_sends_an_event_through_the_vagus_switch(self):
        node, port = self.node()
        _, switch_port = self.switch(f"tcp:127.0.0.1:{port}")
        self.wait_for_nodes(f"tcp:127.0.0.1:{switch_port}", ["rover"])
        run_vagus("net", f"tcp:127.0.0.1:{switch_port}", "load", self.project("rover", 3))
        with Bus(switch_port) as bus:
            with Program("asebacmd", "-t", f"tcp:127.0.0.1;{switch_port}", "usermsg", "0") as command:
                self.assertEqual(command.wait_end(), 0)
            self.assertEqual(bus.wait(1, source=3), b"\x07\x00")

    # asebaexec -----------------------------------------------------------------------------------

    def test_asebaexec_runs_a_command_on_an_event_through_the_vagus_switch(self):
        _, port = self.switch()
        witness = self.folder / "witness"
        with Program("asebaexec", "5", f"touch {witness}", f"tcp:127.0.0.1;{port}"):
            with Bus(port) as bus:
                for _ in range(600):
                    bus.send(9, 5)
                    if witness.exists():
                        return
                    self.pause()
        self.fail("asebaexec never ran its command")

    # asebamassloader -----------------------------------------------------------------------------

    def test_asebamassloader_programs_a_vagus_node_through_the_vagus_switch(self):
        _, port = self.node()
        _, switch_port = self.switch(f"tcp:127.0.0.1:{port}")
        self.wait_for_nodes(f"tcp:127.0.0.1:{switch_port}", ["rover"])
        with Bus(switch_port) as bus:
            with Program("asebamassloader", self.project("rover", 3), f"tcp:127.0.0.1;{switch_port}"):
                bus.wait(RUN)
                self.expect_pong(bus, source=3)

    def expect_pong(self, bus, source):
        """`ping` until the program answers: loading and starting take a moment that we do not know."""
        for _ in range(600):
            bus.send(0, 0)
            self.pause()
            bus.socket.settimeout(0.05)
            try:
                while True:
                    frame = bus.read()
                    if frame[:2] == (source, 1):
                        self.assertEqual(frame[2][0] % 7, 0)
                        return
            except TimeoutError:
                continue
        self.fail("the program never answered")

    @staticmethod
    def pause():
        """Lets the peer work a moment between two looks at a condition."""
        import select
        select.select([], [], [], 0.05)

    # asebaswitch ---------------------------------------------------------------------------------

    def test_vagus_net_sees_a_vagus_node_through_asebaswitch(self):
        _, port = self.node(number=8, name="leg")
        _, foreign = self.foreign_switch(f"tcp:127.0.0.1;{port}")
        Bus(foreign).leave()
        found = self.wait_for_nodes(f"tcp:127.0.0.1:{foreign}", ["leg"])
        self.assertEqual(found[0]["id"], 8)

    def test_asebaswitch_and_the_vagus_switch_join_into_one_bus(self):
        _, port = self.node(number=8, name="leg")
        _, ours = self.switch(f"tcp:127.0.0.1:{port}")
        _, foreign = self.foreign_switch(f"tcp:127.0.0.1;{ours}")
        self.wait_for_nodes(f"tcp:127.0.0.1:{foreign}", ["leg"])

    # asebaplayground -----------------------------------------------------------------------------

    def test_vagus_net_lists_describes_and_reads_a_robot_of_asebaplayground(self):
        _, (port,) = self.playground(1)
        target = f"tcp:127.0.0.1:{port}"
        self.wait_for_nodes(target, ["thymio-II"])
        described = json.loads(run_vagus("net", target, "describe", "thymio-II", "--json"))
        self.assertEqual(described["bytecodeSize"], 1534)
        self.assertEqual(len(described["natives"]), 52)
        self.assertEqual(json.loads(run_vagus("net", target, "get", "thymio-II", "_productId", "--json")),
                         {"_productId": [8]})

    def test_vagus_net_drives_robots_of_asebaplayground_through_asebaswitch(self):
        # asebaswitch hands on the ids as they are; two robots of one world have different ones.
        _, ports = self.playground(2)
        _, foreign = self.foreign_switch(*[f"tcp:127.0.0.1;{port}" for port in ports])
        Bus(foreign).leave()
        target = f"tcp:127.0.0.1:{foreign}"
        self.wait_for_nodes(target, ["thymio-II", "thymio-II"])
        run_vagus("net", target, "set", "2", "motor.left.target", "100")
        for _ in range(60):
            speed = json.loads(run_vagus("net", target, "get", "2", "motor.left.speed", "--json"))
            if speed["motor.left.speed"][0] > 50:
                break
        self.assertGreater(speed["motor.left.speed"][0], 50)
        still = json.loads(run_vagus("net", target, "get", "1", "motor.left.target", "--json"))
        self.assertEqual(still["motor.left.target"], [0])

    def test_vagus_net_loads_a_program_into_a_robot_of_asebaplayground(self):
        _, (port,) = self.playground(1)
        target = f"tcp:127.0.0.1:{port}"
        self.wait_for_nodes(target, ["thymio-II"])
        run_vagus("net", target, "load", self.project("thymio-II", 1))
        run_vagus("net", target, "emit", "ping", "--project", self.folder / "counter.aesl")
        for _ in range(60):
            got = json.loads(run_vagus("net", target, "get", "thymio-II", "n", "--project",
                                       self.folder / "counter.aesl", "--json"))
            if got == {"n": [7]}:
                return
        self.fail(f"n is {got}, not 7")

    # asebastudio ---------------------------------------------------------------------------------

    def test_asebastudio_shows_the_variables_of_a_vagus_node(self):
        _, port = self.node()
        _, switch_port = self.switch(f"tcp:127.0.0.1:{port}")
        self.wait_for_nodes(f"tcp:127.0.0.1:{switch_port}", ["rover"])
        display = self.start(Display())
        with Bus(switch_port) as bus:
            with Program("asebastudio", f"tcp:127.0.0.1;{switch_port}", env=display.env):
                self.assertEqual(bus.wait(0xA00B, source=0)[:2], b"\x03\x00")  # GetVariables, for node 3
                self.assertGreater(len(bus.wait(0x9005, source=3)), 2)         # and its Variables
                display.screenshot(ROOT / "build/asebastudio.png")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + [f"Peers.{name}" for name in sys.argv[1:]], verbosity=2)
