"""SocketCAN with a `vcan` interface, where the kernel offers one: a node and a host on it, and the frames of section 1.6.

Where it does not (many kernels of containers), the program must say so and how to mend it; what it puts on a bus is then
tested against a pair of sockets alone (`Can.*` of src/net/channel_test.cpp). The line `figure: …` says which it was.
"""
import pathlib
import socket
import struct
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import GIVE_UP_AFTER, run_vagus, vagus

INTERFACE = "vcan0"
CAN_FRAME = struct.Struct("=IB3x8s")  # identifier, size, bytes: linux/can.h


def open_vcan():
    """A socket on a fresh vcan interface, or why there is none."""
    try:
        for words in (["add", INTERFACE, "type", "vcan"], ["set", INTERFACE, "up"]):
            subprocess.run(["ip", "link", *words], check=True, capture_output=True, text=True)
        bus = socket.socket(socket.PF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
        bus.settimeout(GIVE_UP_AFTER)
        bus.bind((INTERFACE,))
        return bus, ""
    except subprocess.CalledProcessError as error:
        return None, error.stderr.strip()
    except OSError as error:
        return None, str(error)


class SocketCan(unittest.TestCase):
    def test_a_node_and_a_host_on_a_can_bus(self):
        bus, why = open_vcan()
        if bus is None:
            print(f"figure: SocketCAN was tested against a pair of sockets, since this kernel has no vcan ({why})")
            self.told_that_there_is_none()
            return
        print("figure: SocketCAN was tested over vcan")
        with bus, vagus("node", "--id", 3, "--name", "rover", "--connect", f"can:{INTERFACE}"):
            self.frames_are_those_of_the_specification(bus)
            self.assertIn("rover", run_vagus("net", f"can:{INTERFACE}", "describe", 3, "--wait", 60))
            told = run_vagus("conformance", f"can:{INTERFACE}", "--node", 3)
            self.assertIn(", 0 failed, ", told)

    def frames_are_those_of_the_specification(self, bus):
        """`Stop` to node 3 from host 0, and its answer with pc 0 and flags 2: 2 + 4 bytes are one Small frame."""
        command = struct.pack("<HH", 0xA006, 3)
        found = None
        bus.settimeout(0.2)
        for _ in range(int(GIVE_UP_AFTER / 0.2)):  # until the node is there
            bus.send(CAN_FRAME.pack(0x300, len(command), command.ljust(8, b"\0")))
            try:
                found = CAN_FRAME.unpack(bus.recv(CAN_FRAME.size))
                break
            except TimeoutError:
                pass
        answer = struct.pack("<HHH", 0x900A, 0, 2)
        self.assertEqual(found, (0x303, len(answer), answer.ljust(8, b"\0")))

    def told_that_there_is_none(self):
        told = run_vagus("net", f"can:{INTERFACE}", "list", status=1)
        self.assertRegex(told, f"can:{INTERFACE}: (this kernel has no CAN sockets; .*modprobe|no such interface .*ip link show)")


if __name__ == "__main__":
    unittest.main(verbosity=2, warnings="ignore")
