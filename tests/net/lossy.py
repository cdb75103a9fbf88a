"""`vagus net load` over a line that loses bytes of a program: the cut frame is completed by the bytes behind it, and answered like
any other. The checksum that the node tells is another, so the program is sent again, and is not run."""
import json
import os
import pathlib
import socket
import struct
import sys
import tempfile
import threading
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import connect, listening, run_vagus, vagus

SET_BYTECODE = 0xA001
LIST_NODES = struct.pack("<HHHH", 2, 0, 0xA011, 5)
NODE = 3
# Whatever eight bytes of it are lost, it is another program.
SCRIPT = "var x = 11\nvar y = 22\nvar z = 33\nvar w\nw = x + y + z\n"


def without_eight_bytes(frame):
    """They are lost in the middle; a question of another host, as long as they were, completes the frame."""
    middle = len(frame) // 2
    return frame[:middle - 4] + frame[middle + 4:] + LIST_NODES


PROJECT = f'<!DOCTYPE aesl-source>\n<network><node nodeId="{NODE}" name="rover">\n{SCRIPT}</node></network>\n'


class LossyLine:
    """Between hosts and a node: of so many SetBytecode frames bytes are lost."""

    def __init__(self, port, losses):
        self.port, self.losses, self.programs = port, losses, 0
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.thread = threading.Thread(target=self.serve, daemon=True)
        self.thread.start()

    @property
    def target(self):
        return f"tcp:127.0.0.1:{self.listener.getsockname()[1]}"

    def close(self):
        self.listener.close()

    def serve(self):
        while True:
            try:
                host = self.listener.accept()[0]
            except OSError:
                return
            node = connect(self.port)
            back = threading.Thread(target=self.pass_on, args=(node, host), daemon=True)
            back.start()
            self.pass_frames_on(host, node)
            back.join()

    @staticmethod
    def pass_on(source, sink):
        try:
            while data := source.recv(65536):
                sink.sendall(data)
        except OSError:
            pass
        for end in (source, sink):
            end.close()

    def pass_frames_on(self, host, node):
        have = b""
        try:
            while data := host.recv(65536):
                have += data
                while len(have) >= 6 and len(have) >= (size := 6 + struct.unpack_from("<H", have)[0]):
                    frame, have = have[:size], have[size:]
                    if struct.unpack_from("<H", frame, 4)[0] == SET_BYTECODE:
                        self.programs += 1
                        if self.losses > 0:
                            self.losses -= 1
                            frame = without_eight_bytes(frame)
                    node.sendall(frame)
            node.shutdown(socket.SHUT_RDWR)
        except OSError:
            pass


class Lossy(unittest.TestCase):
    def setUp(self):
        node = self.enterContext(vagus("node", "--id", NODE, "--name", "rover", "--listen", "tcp:127.0.0.1:0"))
        self.port = listening(node)
        folder = self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-lossy-"))
        self.script = os.path.join(folder, "rover.aesl")
        pathlib.Path(self.script).write_text(PROJECT, encoding="utf-8")

    def line(self, losses):
        line = LossyLine(self.port, losses)
        self.addCleanup(line.close)
        return line

    def test_a_program_that_lost_bytes_is_sent_again(self):
        line = self.line(2)
        run_vagus("net", line.target, "load", self.script, NODE)
        self.assertEqual(line.programs, 3)
        # The sum behind the described variables: only the whole program makes it.
        values = run_vagus("net", line.target, "get", NODE, "w", "--json", "--project", self.script)
        self.assertEqual(json.loads(values), {"w": [66]})

    def test_a_line_that_always_loses_bytes_is_said_and_nothing_runs(self):
        line = self.line(1000)
        told = run_vagus("net", line.target, "load", self.script, NODE, status=1)
        self.assertIn('node 3 "rover" does not have the program that was sent to it 3 times: expected the checksum ', told)
        self.assertIn("the program was not run", told)
        self.assertEqual(line.programs, 3)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:])], verbosity=2, warnings="ignore")
