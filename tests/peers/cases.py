"""Vagus and the programs of Debian's package `aseba`, over real sockets: each test is named in CMakeLists.txt."""
import json
import pathlib
import struct
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import (BREAKPOINT_SET_RESULT, GET_NODE_DESCRIPTION, GET_VARIABLES, LIST_NODES, LOCAL_EVENT, NAMED_VARIABLE,
                     NATIVE_FUNCTION, NODE_PRESENT, ROOT, RUN, SET_BYTECODE, VARIABLES, Bus, Display, Program, foreign_switch,
                     free_port, list_nodes, listening, patiently, playground, run_vagus, simulated, vagus, variable_names)

# Line 7 is that of `onevent ping`; ping is event 0, pong is event 1.
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
PING, PONG = 0, 1


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

    def switched_node(self, number=3, name="rover"):
        """A Vagus node behind a Vagus switch; gives the switch's port."""
        _, port = self.node(number, name)
        _, switch_port = self.switch(f"tcp:127.0.0.1:{port}")
        self.wait_for_nodes(switch_port, [name])
        return switch_port

    def foreign_switch(self, *targets):
        return foreign_switch(self.start, *targets)

    def simulated_thymio(self, number):
        """A Thymio II of `vagus sim`; gives the port of the bus."""
        return listening(self.start(simulated(self.folder, {"name": "alice", "node": number})))

    def project(self, name, number):
        path = self.folder / "counter.aesl"
        path.write_text(COUNTER.format(name=name, id=number), encoding="utf-8")
        return path

    def playground(self, *ids):
        display = self.start(Display())
        ports = [free_port() for _ in ids]
        self.start(playground(display, self.folder, ports, ids))
        for port in ports:
            Bus(port).leave()
        return ports

    def net(self, port, *arguments):
        # A robot under Xvfb on a busy machine may take its time to answer.
        return run_vagus("net", f"tcp:127.0.0.1:{port}", *arguments, "--wait", 30)

    def wait_for_nodes(self, port, names):
        """Asks until the network lists exactly these names."""
        for _ in patiently():
            found = list_nodes(port)
            if sorted(node["name"] for node in found) == sorted(names):
                return found
        self.fail(f"port {port} never had the nodes {names}; last: {found}")

    def wait_value(self, port, node, variable, accept, *options):
        """Reads until the value is accepted."""
        for _ in patiently():
            words = json.loads(self.net(port, "get", node, variable, "--json", *options))[variable]
            if accept(words[0]):
                return
        self.fail(f"{variable} is {words}")

    def command(self, port, *words):
        """asebacmd, to its end."""
        with Program("asebacmd", "-t", f"tcp:127.0.0.1;{port}", *words) as command:
            self.assertEqual(command.wait_end(), 0, command.lines)

    def expect_pong(self, bus, source):
        """`ping` until the program answers: loading and starting take a moment that we do not know."""
        payload = bus.ask(lambda: bus.send(0, PING), PONG, source)
        self.assertEqual(len(payload), 2)
        n = struct.unpack("<h", payload)[0]
        self.assertTrue(n > 0 and n % 7 == 0, n)

    def expect_thymio(self, header, items, name="thymio-II"):
        """The description of spec 5.2."""
        self.assertEqual(header, (name, 5, 1534, 32, 586))
        self.assertEqual([len(items[kind]) for kind in (NAMED_VARIABLE, LOCAL_EVENT, NATIVE_FUNCTION)], [30, 17, 52])
        # Section 2.10, dump 1.
        self.assertEqual(items[NAMED_VARIABLE][0], bytes.fromhex("01 00 03 5f 69 64"))
        self.assertEqual(items[NAMED_VARIABLE][2], bytes.fromhex("20 00 0a 65 76 65 6e 74 2e 61 72 67 73"))
        self.assertEqual(variable_names(items)[-1], "sd.present")

    # asebacmd ------------------------------------------------------------------------------------

    def test_asebacmd_lists_a_vagus_node_through_the_vagus_switch(self):
        port = self.switched_node(3)
        with Bus(port) as bus:
            self.command(port, "listnodes")
            self.assertEqual(bus.wait(LIST_NODES, source=0), b"\x05\x00")
            self.assertEqual(bus.wait(NODE_PRESENT, source=3), b"\x05\x00")

    def test_asebacmd_gets_the_description_of_a_vagus_node(self):
        port = self.switched_node(3)
        with Bus(port) as bus:
            self.command(port, "getnodedescr", "3")
            self.assertEqual(bus.wait(GET_NODE_DESCRIPTION, source=0), b"\x03\x00\x05\x00")
            header, items = bus.description(3)
        self.assertEqual(header, ("rover", 5, 512, 64, 1060))  # section 5.1
        self.assertEqual(variable_names(items), ["id", "source", "args", "_productId", "timer.period", "_program"])
        self.assertEqual([len(items[kind]) for kind in (LOCAL_EVENT, NATIVE_FUNCTION)], [1, 30])

    def test_asebacmd_lists_and_describes_a_simulated_thymio(self):
        port = self.simulated_thymio(6)
        with Bus(port) as bus:
            self.command(port, "listnodes")
            self.assertEqual(bus.wait(NODE_PRESENT, source=6), b"\x05\x00")
            self.command(port, "getnodedescr", "6")
            self.expect_thymio(*bus.description(6))

    def test_asebacmd_describes_a_node_to_which_the_vagus_switch_gives_another_id(self):
        _, port = self.node(3)
        _, switch_port = self.switch(f"tcp:host=127.0.0.1;port={port};remapLocal=11;remapTarget=3")
        self.assertEqual(self.wait_for_nodes(switch_port, ["rover"])[0]["id"], 11)
        with Bus(switch_port) as bus:
            self.command(switch_port, "getnodedescr", "11")
            self.assertEqual(bus.description(11)[0][0], "rover")

    def test_asebacmd_sends_an_event_through_the_vagus_switch(self):
        port = self.switched_node(3)
        self.net(port, "load", self.project("rover", 3))
        with Bus(port) as bus:
            self.command(port, "usermsg", PING)
            self.assertEqual(bus.wait(PONG, source=3), b"\x07\x00")

    # asebaexec -----------------------------------------------------------------------------------

    def test_asebaexec_runs_a_command_when_a_vagus_node_emits_an_event(self):
        port = self.switched_node(3)
        self.net(port, "load", self.project("rover", 3))
        with Bus(port) as bus:
            # The command is itself a peer, whose message is seen on the bus.
            command = f"asebacmd -t tcp:127.0.0.1;{port} usermsg 77 5"
            self.start(Program("asebaexec", PONG, quoted(command), f"tcp:127.0.0.1;{port}"))
            self.assertEqual(bus.ask(lambda: bus.send(9, PING), 77, source=0), b"\x05\x00")

    def test_asebaexec_runs_a_command_on_an_event_of_a_simulated_thymio(self):
        port = self.simulated_thymio(6)
        self.net(port, "load", self.project("thymio-II", 6))
        with Bus(port) as bus:
            command = f"asebacmd -t tcp:127.0.0.1;{port} usermsg 77 5"
            self.start(Program("asebaexec", PONG, quoted(command), f"tcp:127.0.0.1;{port}"))
            self.assertEqual(bus.ask(lambda: bus.send(9, PING), 77, source=0), b"\x05\x00")

    # asebamassloader -----------------------------------------------------------------------------

    def expect_mass_loaded(self, port, name, number):
        with Bus(port) as bus:
            self.start(Program("asebamassloader", self.project(name, number), f"tcp:127.0.0.1;{port}"))
            self.assertEqual(bus.wait(SET_BYTECODE, source=0)[:4], struct.pack("<HH", number, 0))
            self.assertEqual(bus.wait(RUN, source=0), struct.pack("<H", number))
            self.expect_pong(bus, number)

    def test_asebamassloader_programs_a_vagus_node_through_the_vagus_switch(self):
        self.expect_mass_loaded(self.switched_node(3), "rover", 3)

    def test_asebamassloader_programs_a_vagus_node_through_asebaswitch(self):
        _, port = self.node(3)
        foreign = self.foreign_switch(f"tcp:127.0.0.1;{port}")
        self.wait_for_nodes(foreign, ["rover"])
        self.expect_mass_loaded(foreign, "rover", 3)

    def test_asebamassloader_programs_a_simulated_thymio(self):
        self.expect_mass_loaded(self.simulated_thymio(6), "thymio-II", 6)

    # asebaswitch ---------------------------------------------------------------------------------

    def test_vagus_net_sees_a_vagus_node_through_asebaswitch(self):
        _, port = self.node(number=8, name="leg")
        foreign = self.foreign_switch(f"tcp:127.0.0.1;{port}")
        self.assertEqual(self.wait_for_nodes(foreign, ["leg"])[0]["id"], 8)

    def test_vagus_net_works_with_a_node_to_which_asebaswitch_gives_another_id(self):
        _, port = self.node(number=8, name="leg")
        foreign = self.foreign_switch(f"tcp:host=127.0.0.1;port={port};remapLocal=5;remapTarget=8")
        self.assertEqual(self.wait_for_nodes(foreign, ["leg"])[0]["id"], 5)
        self.net(foreign, "set", 5, "timer.period", 1234)
        self.assertEqual(json.loads(self.net(foreign, "get", 5, "timer.period", "--json")), {"timer.period": [1234]})
        self.net(foreign, "load", self.project("leg", 5))
        with Bus(foreign) as bus:
            self.expect_pong(bus, 5)

    def test_asebaswitch_and_the_vagus_switch_join_into_one_bus(self):
        _, port = self.node(number=8, name="leg")
        _, ours = self.switch(f"tcp:127.0.0.1:{port}")
        foreign = self.foreign_switch(f"tcp:127.0.0.1;{ours}")
        self.wait_for_nodes(foreign, ["leg"])
        with Bus(ours) as here, Bus(foreign) as there:
            there.ask(lambda: here.send(40, 5, 1, 2), 5, source=40)
            here.ask(lambda: there.send(41, 6, 3), 6, source=41)

    def test_a_robot_of_vagus_sim_is_a_node_of_asebaswitch(self):
        own = free_port()
        self.start(simulated(self.folder, {"name": "alice", "node": 6, "port": own})).wait_line(f"{own} alice")
        foreign = self.foreign_switch(f"tcp:127.0.0.1;{own}")
        self.wait_for_nodes(foreign, ["thymio-II"])
        with Bus(foreign) as bus:
            bus.send(0, GET_NODE_DESCRIPTION, 6, 5)
            self.expect_thymio(*bus.description(6))
        self.net(foreign, "set", 6, "motor.left.target", 200, "--leave")
        self.wait_value(foreign, 6, "motor.left.speed", lambda speed: speed > 100)

    def test_vagus_net_log_notices_a_node_that_fell_silent_behind_asebaswitch(self):
        # asebaswitch tells nobody that a node has gone; three seconds of silence do.
        node, port = self.node(number=8, name="leg")
        foreign = self.foreign_switch(f"tcp:127.0.0.1;{port}")
        self.wait_for_nodes(foreign, ["leg"])
        log = self.start(vagus("net", f"tcp:127.0.0.1:{foreign}", "log", "--json"))
        log.wait_line('"node": 8, .*"event": "described"')
        node.kill()
        log.wait_line('"node": 8, .*"event": "disconnected"')
        self.assertEqual(list_nodes(foreign), [])

    # asebaplayground -----------------------------------------------------------------------------

    def test_vagus_net_lists_describes_and_reads_a_robot_of_asebaplayground(self):
        (port,) = self.playground(1)
        self.wait_for_nodes(port, ["thymio-II"])
        described = json.loads(self.net(port, "describe", "thymio-II", "--json"))
        self.assertEqual(described["bytecodeSize"], 1534)
        self.assertEqual(len(described["natives"]), 52)
        self.assertEqual(json.loads(self.net(port, "get", "thymio-II", "_productId", "--json")), {"_productId": [8]})

    def test_vagus_net_drives_robots_of_asebaplayground_through_asebaswitch(self):
        # asebaswitch hands on the ids as they are; two robots of one world have different ones.
        ports = self.playground(1, 2)
        foreign = self.foreign_switch(*[f"tcp:127.0.0.1;{port}" for port in ports])
        self.wait_for_nodes(foreign, ["thymio-II", "thymio-II"])
        self.net(foreign, "set", 2, "motor.left.target", 100, "--leave")
        self.wait_value(foreign, 2, "motor.left.speed", lambda speed: speed > 50)
        self.assertEqual(json.loads(self.net(foreign, "get", 1, "motor.left.target", "--json")),
                         {"motor.left.target": [0]})

    def test_robots_of_asebaplayground_with_one_id_get_two_from_the_vagus_switch(self):
        first, second = self.playground(1, 1)
        _, port = self.switch(f"tcp:127.0.0.1:{first}", f"tcp:host=127.0.0.1;port={second};remapLocal=2")
        found = self.wait_for_nodes(port, ["thymio-II", "thymio-II"])
        self.assertEqual(sorted(node["id"] for node in found), [1, 2])
        self.net(port, "set", 2, "motor.right.target", 100, "--leave")
        self.wait_value(port, 2, "motor.right.speed", lambda speed: speed > 50)
        self.assertEqual(json.loads(self.net(port, "get", 1, "motor.right.target", "--json")),
                         {"motor.right.target": [0]})

    def test_vagus_net_loads_a_program_into_a_robot_of_asebaplayground(self):
        (port,) = self.playground(1)
        self.wait_for_nodes(port, ["thymio-II"])
        project = self.project("thymio-II", 1)
        self.net(port, "load", project)
        self.net(port, "emit", "ping", "--project", project)
        self.wait_value(port, "thymio-II", "n", lambda n: n == 7, "--project", project)

    def conformance(self, port, *options):
        """The rows of `vagus conformance`, by name."""
        with vagus("conformance", f"tcp:127.0.0.1:{port}", "--may-drive", "--json", *options) as program:
            program.wait_end(within=240)  # a hundred checks of a robot in real time
            text = "\n".join(line for line in program.lines if not line.startswith("vagus: "))
            self.assertTrue(text, program.lines)
        return {row["check"]: row for row in json.loads(text)["checks"]}

    def failed(self, rows):
        return {name: row.get("defects", "") for name, row in rows.items() if row["result"] == "failed"}

    def test_what_conformance_finds_in_asebaplayground_is_in_the_list_of_defects(self):
        # Section 8 of the specification. The first row that the robot does not survive (D9) ends the run.
        (port,) = self.playground(1)
        rows = self.conformance(port)
        self.assertEqual(self.failed(rows), {
            "Reset clears what every `when` saw": "D2",
            "Reset leaves operands as they are": "D2",
            "deque.get outside tells pc, cells and index": "D3",
            "deque.pop_front of too many is told once": "D4",
            "deque.pop_back of too many is told once": "D4",
            "deque.insert in the front half": "D5",
            "a breakpoint set twice is one": "D17",
            "a breakpoint set twice takes one place": "D17",
            "all variables asked for at once come in pieces": "D22",
            "commands that are too short harm nothing": "D9 D11",
        })
        self.assertEqual([name for name, row in rows.items() if row["result"] == "skipped"],
                         ["fragments of the description can be asked for", "_program is the checksum of what was loaded",
                          "_program says when nobody knows", "WriteBytecode leaves program and variables",
                          "a saved program starts by itself after Reboot",
                          "SuspendToRam leaves a node awake that cannot sleep"])
        not_run = {row["group"] for row in rows.values() if row["result"] == "not run"}
        self.assertEqual(not_run, {"limits"})
        self.assertIn("lost at", rows["a jump out of the bytecode"]["found"])

    def test_what_asebaplayground_does_not_survive_is_in_the_list_of_defects(self):
        # One robot for each: what it dies of, or does to memory that is not its own.
        for check, defects in (("reading far outside the variables", "D9"), ("writing over the end of the variables", "D9"),
                               ("loading over the end of the bytecode", "D9"), ("a breakpoint outside the bytecode", "D9"),
                               ("an opcode that is none", "D9"), ("a stack that is full", "D9"), ("an Emit of 259 words", "D7"),
                               ("a native that works outside the variables", "D9")):
            with self.subTest(check):
                (port,) = self.playground(1)
                self.assertEqual(self.failed(self.conformance(port, "--only", check)), {check: defects})

    def test_vagus_net_debugs_a_robot_of_asebaplayground(self):
        (robot,) = self.playground(1)
        port = self.foreign_switch(f"tcp:127.0.0.1;{robot}")
        self.wait_for_nodes(port, ["thymio-II"])
        project = self.project("thymio-II", 1)
        self.net(port, "load", project)
        waiting = self.start(vagus("net", f"tcp:127.0.0.1:{port}", "break", "thymio-II", f"{project}:8", "--project", project))
        with Bus(port) as bus:
            bus.ask(lambda: bus.send(0, GET_VARIABLES, 1, 0, 1), BREAKPOINT_SET_RESULT, source=1)
            bus.send(0, PING)
            self.assertEqual(waiting.wait_end(), 0, waiting.lines)
            value = ("get", "thymio-II", "n", "--json", "--project", project)
            self.assertEqual(json.loads(self.net(port, *value)), {"n": [0]})  # before the line
            self.net(port, "step", "thymio-II", "--project", project)
            self.assertEqual(json.loads(self.net(port, *value)), {"n": [7]})  # after it
            self.net(port, "run", "thymio-II", "--project", project)
            self.assertEqual(bus.wait(PONG, source=1), b"\x07\x00")

    # asebastudio ---------------------------------------------------------------------------------

    def expect_studio_shows(self, port, node, picture):
        """asebastudio asks for the variables of the node and gets them; gives the words from address 0."""
        display = self.start(Display())
        with Bus(port) as bus:
            self.start(Program("asebastudio", f"tcp:127.0.0.1;{port}", env=display.env))
            asked, start, length = struct.unpack("<3H", bus.wait(GET_VARIABLES, source=0))
            self.assertEqual((asked, start), (node, 0))
            answer = bus.wait(VARIABLES, source=node)
            self.assertEqual(len(answer), 2 * (1 + length))
            for _ in range(2):  # it asks once a second, between two paintings: then the values are on the screen
                bus.wait(LIST_NODES, source=0)
            display.screenshot(ROOT / "build" / picture)
            return struct.unpack(f"<{length}h", answer[2:])

    def test_asebastudio_shows_the_variables_of_a_vagus_node(self):
        words = self.expect_studio_shows(self.switched_node(3), 3, "asebastudio.png")
        self.assertEqual(len(words), 38)  # two of them _program

    def test_asebastudio_shows_the_variables_of_a_simulated_thymio(self):
        words = self.expect_studio_shows(self.simulated_thymio(6), 6, "asebastudio-thymio.png")
        self.assertEqual((words[0], words[34], words[66]), (6, 8, 220))  # _id, _productId, temperature


def quoted(command):
    """asebaexec runs its command in a shell."""
    return " ".join(f"'{word}'" for word in command.split())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + [f"Peers.{name}" for name in sys.argv[1:]], verbosity=2)
