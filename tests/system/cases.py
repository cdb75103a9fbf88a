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
from harness import GIVE_UP_AFTER, Bus, listening, run_vagus, vagus

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


class System(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-system-")))
        self.random = random.Random(SEED)
        print(f"seed {SEED}")

    def start(self, program):
        return self.enterContext(program)

    def listed(self, port):
        """Ids of the nodes that the network names as connected."""
        nodes = json.loads(run_vagus("net", f"tcp:127.0.0.1:{port}", "list", "--json"))
        return sorted(node["id"] for node in nodes if node["state"] != "disconnected")

    def wait_listed(self, port, expected):
        deadline = time.monotonic() + GIVE_UP_AFTER
        while time.monotonic() < deadline:
            found = self.listed(port)
            if found == expected:
                return
        self.fail(f"the network lists {found}, but {expected} live")

    def start_node(self, port, number, *options):
        return self.start(vagus("node", "--id", number, "--name", f"n{number}",
                                "--connect", f"tcp:127.0.0.1:{port}", *options))

    def test_whoever_is_killed_the_next_list_tells_the_truth(self):
        switch = self.start(vagus("switch", "--listen", "tcp:127.0.0.1:0"))
        port = listening(switch)
        nodes = {number: self.start_node(port, number) for number in (1, 2, 3, 4)}
        self.wait_listed(port, sorted(nodes))
        for _ in range(ROUNDS):
            victim = self.random.choice(sorted(nodes))
            nodes.pop(victim).kill()
            self.wait_listed(port, sorted(nodes))
            if self.random.random() < 0.3:  # the switch too; the nodes come back to the new one
                switch.kill()
                switch = self.start(vagus("switch", "--listen", f"tcp:127.0.0.1:{port}"))
                listening(switch)
                self.wait_listed(port, sorted(nodes))
            nodes[victim] = self.start_node(port, victim)
            self.wait_listed(port, sorted(nodes))

    def test_a_client_killed_in_the_middle_of_a_frame_harms_nobody(self):
        switch = self.start(vagus("switch", "--listen", "tcp:127.0.0.1:0"))
        port = listening(switch)
        self.start_node(port, 1)
        for _ in range(ROUNDS * 5):
            half = socket.create_connection(("127.0.0.1", port))
            whole = struct.pack("<HHHHH", 4, 9, 3, 1, 2)
            half.sendall(whole[:self.random.randrange(1, len(whole))])
            half.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))  # close by reset
            half.close()
        self.wait_listed(port, [1])

    def test_a_client_that_never_reads_costs_the_others_nothing(self):
        switch = self.start(vagus("switch", "--listen", "tcp:127.0.0.1:0"))
        port = listening(switch)
        with Bus(port), Bus(port) as sender, Bus(port) as receiver:  # the first one never reads
            sent = 60000
            for first in range(0, sent, 1000):
                frames = b"".join(struct.pack("<HHHI", 4, 9, 7, number) for number in range(first, first + 1000))
                sender.socket.sendall(frames)
                for number in range(first, first + 1000):
                    self.assertEqual(struct.unpack("<I", receiver.wait(7))[0], number)

    def test_nonsense_on_the_wire_stops_neither_switch_nor_node(self):
        switch = self.start(vagus("switch", "--listen", "tcp:127.0.0.1:0"))
        port = listening(switch)
        node = self.start_node(port, 1)
        self.wait_listed(port, [1])
        for _ in range(ROUNDS):
            with Bus(port) as bus:
                for _ in range(500):
                    bus.socket.sendall(self.nonsense())
                bus.socket.sendall(self.random.randbytes(5000))
        self.assertTrue(switch.running() and node.running())
        self.wait_listed(port, [1])

    def nonsense(self):
        """A well-framed message whose content is made up, often near something that means something."""
        kind = self.random.choice([self.random.randrange(0x10000), self.random.randrange(0x9000, 0x9010),
                                   self.random.randrange(0xA000, 0xA018)])
        payload = self.random.randbytes(self.random.choice([0, 1, 2, 3, 4, 6, 8, 33, 516]))
        if self.random.random() < 0.5:
            payload = b"\x01\x00" + payload[2:]
        # Not GetNodeDescription's Reboot and its like: what ends a node by its own command is no accident.
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

    def test_ctrl_c_ends_each_program_cleanly(self):
        switch = self.start(vagus("switch", "--listen", "tcp:127.0.0.1:0"))
        port = listening(switch)
        node = self.start_node(port, 1)
        self.wait_listed(port, [1])
        for program in (node, switch):
            program.process.send_signal(signal.SIGINT)
            self.assertEqual(program.wait_end(), 0)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + [f"System.{name}" for name in sys.argv[1:]], verbosity=2)
