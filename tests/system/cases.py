"""The programs of Vagus together, as processes: what stays true when one of them dies or talks nonsense."""
import json
import os
import pathlib
import random
import signal
import socket
import struct
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import (BREAKPOINT_SET, BREAKPOINT_SET_RESULT, DESCRIPTION, DISCONNECTED, GET_EXECUTION_STATE,
                     GET_NODE_DESCRIPTION, GIVE_UP_AFTER, LIST_NODES, NODE_PRESENT, RESET, RUN, SET_BYTECODE, STATE,
                     Bus, Missing, free_port, list_nodes, listening, run_vagus, simulated, vagus)

SEED = int(os.environ.get("VAGUS_SEED", "20"))
ROUNDS = 40 if os.environ.get("VAGUS_LONG") else 8

SAVED = """<!DOCTYPE aseba-source>
<network>
<event size="1" name="hello"/>
<node nodeId="4" name="keeper">emit hello 42
onevent hello
emit hello args[0] + 1
</node>
</network>
"""

# n1 and n2 count `ping`s by 3 and by 5, in so many words that a program takes two messages to load.
PING, PONG = 0, 1
LONG = """<!DOCTYPE aseba-source>
<network>
<event size="0" name="ping"/>
<event size="1" name="pong"/>
<node nodeId="1" name="n1">var n = 0
var filler = 0
{filler}onevent ping
n += 3
emit pong n
</node>
<node nodeId="2" name="n2">var n = 0
var filler = 0
{filler}onevent ping
n += 5
emit pong n
</node>
</network>
""".replace("{filler}", "filler += 1\n" * 100)

# Section 2.10, dump 2: var100 = 2 + 3; emit event 4 with var100 and var101. Word 7 adds.
EMITS_5 = (5, 0xFFFF, 5, 0, 13, 0x1002, 0x1003, 0x8002, 0x4064, 0xB004, 100, 2, 0, 0x3065, 0x1001, 0x8002, 0x4065, 0)
ADDS = 7


def ghost_answer(kind, payload):
    """What node 1, "n1" without a variable or an event of its own, says to a host; empty: nothing."""
    def said(answer, content):
        return struct.pack("<HHH", len(content), 1, answer) + content

    if kind == LIST_NODES:
        return said(NODE_PRESENT, b"\x05\x00")
    if kind == GET_NODE_DESCRIPTION and payload[:2] == b"\x01\x00":
        return said(DESCRIPTION, b"\x02n1" + struct.pack("<7H", 5, 512, 64, 1060, 0, 0, 0))
    if kind in (SET_BYTECODE, RESET, RUN, GET_EXECUTION_STATE) and payload[:2] == b"\x01\x00":
        return said(STATE, struct.pack("<HH", 3, 1 if kind in (RUN, GET_EXECUTION_STATE) else 3))
    return b""


class System(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-system-")))
        self.random = random.Random(SEED)
        print(f"seed {SEED}")

    def start(self, program):
        return self.enterContext(program)

    def listed(self, port):
        """Ids of the nodes that the network names as connected."""
        nodes = list_nodes(port)
        return sorted(node["id"] for node in nodes if node["state"] != "disconnected")

    def wait_listed(self, port, expected):
        deadline = time.monotonic() + GIVE_UP_AFTER
        while time.monotonic() < deadline:
            found = self.listed(port)
            if found == expected:
                return
        self.fail(f"the network lists {found}, but {expected} live")

    def assert_listed(self, port, expected):
        """What died or never lived is no matter of waiting: the very next list tells the truth."""
        self.assertEqual(self.listed(port), expected)

    def start_switch(self, port=0, *targets):
        switch = self.start(vagus("switch", "--listen", f"tcp:127.0.0.1:{port}", *targets))
        return switch, listening(switch)

    def long_project(self):
        path = self.folder / "long.aesl"
        path.write_text(LONG, encoding="utf-8")
        return path

    def expect_pong(self, bus, source, step):
        bus.send(0, PING)
        n = struct.unpack("<h", bus.wait(PONG, source))[0]
        self.assertTrue(n > 0 and n % step == 0, n)
        return n

    def start_node(self, port, number, *options):
        return self.start(vagus("node", "--id", number, "--name", f"n{number}",
                                "--connect", f"tcp:127.0.0.1:{port}", *options))

    def test_whoever_is_killed_the_next_list_tells_the_truth(self):
        switch, port = self.start_switch()
        nodes = {number: self.start_node(port, number) for number in (1, 2, 3, 4)}
        self.wait_listed(port, sorted(nodes))
        for _ in range(ROUNDS):
            host = self.start(vagus("net", f"tcp:127.0.0.1:{port}", "log"))
            host.wait_line("described")
            victim = self.random.choice(sorted(nodes))
            nodes.pop(victim).kill()
            self.assert_listed(port, sorted(nodes))
            host.kill()
            self.assert_listed(port, sorted(nodes))
            if self.random.random() < 0.3:  # the switch too; the nodes come back to the new one
                switch.kill()
                switch, _ = self.start_switch(port)
                self.wait_listed(port, sorted(nodes))
            nodes[victim] = self.start_node(port, victim)
            self.wait_listed(port, sorted(nodes))

    def test_a_node_keeps_its_program_and_memory_when_the_switch_is_restarted(self):
        switch, port = self.start_switch()
        node = self.start_node(port, 1)
        self.wait_listed(port, [1])
        run_vagus("net", f"tcp:127.0.0.1:{port}", "load", self.long_project(), "n1")
        with Bus(port) as bus:
            self.assertEqual(self.expect_pong(bus, 1, 3), 3)
        switch.kill()
        self.start_switch(port)
        self.wait_listed(port, [1])
        with Bus(port) as bus:
            self.assertEqual(self.expect_pong(bus, 1, 3), 6)
        self.assertTrue(node.running())

    def test_the_switch_finds_a_node_again_that_it_connects_to(self):
        node = self.start(vagus("node", "--id", 5, "--listen", "tcp:127.0.0.1:0"))
        place = f"tcp:127.0.0.1:{listening(node)}"
        _, port = self.start_switch(0, place)
        self.wait_listed(port, [5])
        for number in (6, 7):
            node.kill()
            self.assert_listed(port, [])
            node = self.start(vagus("node", "--id", number, "--listen", place))
            listening(node)
            self.wait_listed(port, [number])

    # Loading --------------------------------------------------------------------------------------

    def test_a_host_killed_in_the_middle_of_a_load_leaves_a_node_that_can_be_loaded(self):
        _, port = self.start_switch()
        self.start_node(port, 1)
        self.wait_listed(port, [1])
        project = self.long_project()
        for _ in range(ROUNDS):
            with Bus(port) as bus:
                loader = self.start(vagus("net", f"tcp:127.0.0.1:{port}", "load", project, "n1"))
                bus.wait(SET_BYTECODE)
                loader.kill()
            self.assert_listed(port, [1])
            with Bus(port) as half:  # and for certain: the first of two messages, then nothing
                half.send(0, SET_BYTECODE, 1, 0, 3, 0xFFFF, 3, *self.random.choices(range(0x10000), k=250))
                half.wait(STATE, source=1)
                half.send(0, RUN, 1)
            self.assert_listed(port, [1])
            run_vagus("net", f"tcp:127.0.0.1:{port}", "load", project, "n1")
            with Bus(port) as bus:
                self.expect_pong(bus, 1, 3)

    def test_a_node_that_leaves_at_any_moment_of_a_load_is_an_error(self):
        _, port = self.start_switch()
        project = self.long_project()
        for replies in range(40):
            status, said = self.load_ghost(port, project, replies)
            self.assert_listed(port, [])
            if status == 0:
                self.assertGreater(replies, 6)  # present, description, state, two parts, run
                return
            self.assertEqual(status, 1, said)
            self.assertRegex(said, r"no node|node 1\b|\"n1\"|no such")
        self.fail("a ghost that answered 40 times was not loaded")

    def load_ghost(self, port, project, replies):
        """Loads what looks like node 1, but leaves with its last reply, told in one breath: (exit status, output)."""
        with Bus(port) as ghost:
            loader = self.start(vagus("net", f"tcp:127.0.0.1:{port}", "load", project, "n1"))
            ghost.socket.settimeout(0.1)
            while loader.running():
                try:
                    _, kind, payload = ghost.read()
                except TimeoutError:
                    continue
                answer = ghost_answer(kind, payload)
                if not answer:
                    continue
                if replies == 0:
                    answer += struct.pack("<HHH", 0, 1, DISCONNECTED)
                ghost.socket.sendall(answer)
                if replies == 0:
                    break
                replies -= 1
        return loader.wait_end(), "\n".join(loader.lines)

    def test_a_node_killed_while_it_is_loaded_disturbs_nobody(self):
        _, port = self.start_switch()
        self.start_node(port, 2)
        project = self.long_project()
        for _ in range(ROUNDS):
            node = self.start_node(port, 1)
            self.wait_listed(port, [1, 2])
            with Bus(port) as bus:
                loader = self.start(vagus("net", f"tcp:127.0.0.1:{port}", "load", project))
                bus.wait(SET_BYTECODE)
                node.kill()
                self.assertIn(loader.wait_end(), (0, 1))  # 0: it was done before
                self.assert_listed(port, [2])
                run_vagus("net", f"tcp:127.0.0.1:{port}", "load", project, "n2")
                self.expect_pong(bus, 2, 5)

    def test_many_hosts_at_once_each_get_their_answers(self):
        _, port = self.start_switch()
        self.start_node(port, 1)
        self.start_node(port, 2)
        self.wait_listed(port, [1, 2])
        project = self.long_project()
        commands = [("load", project, "n1"), ("load", project, "n2"), ("list", "--json"), ("describe", "n1", "--json"),
                    ("get", "n2", "timer.period", "--json"), ("set", "n1", "timer.period", 0)]
        for _ in range(ROUNDS):
            hosts = [self.start(vagus("net", f"tcp:127.0.0.1:{port}", *command)) for command in commands]
            for host in hosts:
                self.assertEqual(host.wait_end(), 0, host.arguments + host.lines)
            said = ["\n".join(host.lines) for host in hosts]
            self.assertEqual([node["name"] for node in json.loads(said[2])], ["n1", "n2"])
            self.assertEqual(len(json.loads(said[3])["natives"]), 30)
            self.assertEqual(json.loads(said[4]), {"timer.period": [0]})
            with Bus(port) as bus:
                self.expect_pong(bus, 1, 3)
                self.expect_pong(bus, 2, 5)

    # The simulator --------------------------------------------------------------------------------

    def test_a_log_sees_a_simulator_go_and_come_back(self):
        robot = {"name": "alice", "node": 6}
        sim = self.start(simulated(self.folder, robot))
        place = f"tcp:127.0.0.1:{listening(sim)}"
        _, port = self.start_switch(0, place)
        log = self.start(vagus("net", f"tcp:127.0.0.1:{port}", "log", "--json"))
        near = self.start(vagus("net", place, "log", "--json"))
        near.wait_line('"node": 6, .*"described"')
        log.wait_line('"node": 6, .*"described"')
        for _ in range(3):
            sim.kill()
            log.wait_line('"node": 6, .*"disconnected"')
            self.assert_listed(port, [])
            sim = self.start(simulated(self.folder, robot, listen=place))
            log.wait_line('"node": 6, .*"described"')
            self.assert_listed(port, [6])
        # Without a switch between them the bus itself has gone.
        self.assertEqual(near.wait_end(), 1)
        self.assertRegex(near.lines[-1], "^vagus: tcp:127.0.0.1:.*(closed|Connection reset)")

    def test_the_own_port_of_a_robot_has_one_client_whose_breakpoints_go_with_it(self):
        own = free_port()
        sim = self.start(simulated(self.folder, {"name": "alice", "node": 6, "port": own}, {"name": "bob", "node": 7}))
        common = listening(sim)
        sim.wait_line(f"^listening tcp:127.0.0.1:{own} alice$")
        self.assert_listed(common, [6, 7])
        self.assert_listed(own, [6])
        with Bus(own) as first:
            first.send(0, SET_BYTECODE, 6, 0, *EMITS_5)
            first.wait(STATE, source=6)
            first.send(0, BREAKPOINT_SET, 6, ADDS)
            self.assertEqual(first.wait(BREAKPOINT_SET_RESULT, source=6), struct.pack("<HH", ADDS, 1))
            with Bus(own) as second:
                with self.assertRaisesRegex(Missing, "closed"):
                    first.wait(RUN)
                second.send(0, RUN, 6)
                self.assertEqual(second.wait(4, source=6), struct.pack("<hh", 5, 0))
        self.assert_listed(own, [6])
        self.assert_listed(common, [6, 7])

    # Nonsense and slowness ------------------------------------------------------------------------

    def test_a_client_killed_in_the_middle_of_a_frame_harms_nobody(self):
        _, port = self.start_switch()
        self.start_node(port, 1)
        for _ in range(ROUNDS * 5):
            half = socket.create_connection(("127.0.0.1", port))
            whole = struct.pack("<HHHHH", 4, 9, 3, 1, 2)
            half.sendall(whole[:self.random.randrange(1, len(whole))])
            half.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))  # close by reset
            half.close()
        self.wait_listed(port, [1])

    def test_a_client_that_never_reads_costs_the_others_nothing(self):
        _, port = self.start_switch()
        with Bus(port), Bus(port) as sender, Bus(port) as receiver:  # the first one never reads
            sent = 60000
            for first in range(0, sent, 1000):
                frames = b"".join(struct.pack("<HHHI", 4, 9, 7, number) for number in range(first, first + 1000))
                sender.socket.sendall(frames)
                for number in range(first, first + 1000):
                    self.assertEqual(struct.unpack("<I", receiver.wait(7))[0], number)

    def test_nonsense_on_the_wire_stops_neither_switch_nor_node(self):
        switch, port = self.start_switch()
        node = self.start_node(port, 1)
        self.wait_listed(port, [1])
        self.send_nonsense(port)
        self.assertTrue(switch.running() and node.running())
        self.assert_listed(port, [1])

    def test_nonsense_on_the_wire_does_not_stop_the_simulator(self):
        own = free_port()
        sim = self.start(simulated(self.folder, {"name": "alice", "node": 1, "port": own},
                                   {"name": "eve", "type": "epuck", "node": 2}))
        port = listening(sim)
        self.send_nonsense(port)
        self.send_nonsense(own)
        self.assertTrue(sim.running())
        self.assert_listed(port, [1, 2])
        self.assert_listed(own, [1])

    def send_nonsense(self, port):
        for _ in range(ROUNDS):
            with Bus(port) as bus:
                try:
                    for _ in range(500):
                        bus.socket.sendall(self.nonsense())
                    bus.socket.sendall(self.random.randbytes(5000))
                except (BrokenPipeError, ConnectionResetError):
                    pass  # it had enough of us

    def nonsense(self):
        """A well-framed message whose content is made up, often near something that means something."""
        kind = self.random.choice([self.random.randrange(0x10000), self.random.randrange(0x9000, 0x9010),
                                   self.random.randrange(0xA000, 0xA018)])
        payload = self.random.randbytes(self.random.choice([0, 1, 2, 3, 4, 6, 8, 33, 516]))
        if self.random.random() < 0.5:
            payload = b"\x01\x00" + payload[2:]
        return struct.pack("<HHH", len(payload), self.random.randrange(0x100), kind) + payload

    def test_a_saved_program_runs_again_after_a_restart_without_a_host(self):
        flash = self.folder / "keeper.flash"
        project = self.folder / "keeper.aesl"
        project.write_text(SAVED, encoding="utf-8")
        arguments = ("node", "--id", 4, "--name", "keeper", "--flash", flash, "--listen", "tcp:127.0.0.1:0")
        node = self.start(vagus(*arguments))
        target = f"tcp:127.0.0.1:{listening(node)}"
        run_vagus("net", target, "load", project)
        run_vagus("net", target, "save", "keeper")
        node.kill()
        again = self.start(vagus(*arguments))
        with Bus(listening(again)) as bus:
            bus.send(0, 0, 99)
            self.assertEqual(struct.unpack("<h", bus.wait(0, source=4))[0], 100)

    def test_two_nodes_do_not_keep_their_programs_in_one_file(self):
        flash = self.folder / "keeper.flash"
        first = self.start(vagus("node", "--flash", flash, "--listen", "tcp:127.0.0.1:0"))
        listening(first)
        told = run_vagus("node", "--flash", flash, "--listen", "tcp:127.0.0.1:0", status=1)
        self.assertIn(f"--flash {flash}: another program uses this file; name another file", told)
        first.kill()
        listening(self.start(vagus("node", "--flash", flash, "--listen", "tcp:127.0.0.1:0")))

    def test_what_a_node_saves_replaces_no_script(self):
        script = self.folder / "keeper.aesl"
        script.write_text(SAVED, encoding="utf-8")
        told = run_vagus("node", "--flash", script, "--listen", "tcp:127.0.0.1:0", status=2)
        self.assertIn("keeper.aesl: expected a file that is not there yet", told)
        self.assertEqual(script.read_text(encoding="utf-8"), SAVED)

    def test_ctrl_c_ends_each_program_cleanly(self):
        switch, port = self.start_switch()
        node = self.start_node(port, 1)
        self.wait_listed(port, [1])
        log = self.start(vagus("net", f"tcp:127.0.0.1:{port}", "log"))
        log.wait_line("described")
        for program in (log, node, switch):
            program.signal(signal.SIGINT)
            self.assertEqual(program.wait_end(), 0, program.lines)

    def test_ctrl_c_ends_the_simulator_with_its_trace_complete(self):
        sim = self.start(simulated(self.folder, {"name": "alice"}, options=("--trace", self.folder / "trace.jsonl")))
        sim.wait_line(r"^1\.\d+ s  alice")
        sim.signal(signal.SIGINT)
        self.assertEqual(sim.wait_end(), -signal.SIGINT, sim.lines)  # so that a loop in a shell ends too
        lines = (self.folder / "trace.jsonl").read_text(encoding="utf-8").splitlines()
        self.assertGreater(len(lines), 5)
        for line in lines:
            json.loads(line)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + [f"System.{name}" for name in sys.argv[1:]], verbosity=2)
