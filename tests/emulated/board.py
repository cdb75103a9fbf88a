"""One emulated board, its serial line in the hands of a test: every byte in and out, and when the line is pulled."""
import fcntl
import pathlib
import select
import socket
import struct
import subprocess
import sys
import tempfile
import termios
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import ASK_AGAIN_AFTER, GIVE_UP_AFTER, Missing, VAGUS

BUILD = pathlib.Path(VAGUS).resolve().parent.parent
IMAGES = BUILD / "share/vagus/firmware"
BOARDS = ("microbit", "mps2-an385", "atmega1284p")
# A real line carries 11,520 bytes a second; an emulator takes all that there is. So much is a second of a busy line.
BYTES_OF_A_SECOND = 11520

KILLED, ERROR, STATE, PRESENT, VARIABLES = 0x9008, 0x9009, 0x900A, 0x900C, 0x9005
SET_BYTECODE, RESET, RUN, PAUSE, STEP, STOP, GET_STATE = 0xA001, 0xA002, 0xA003, 0xA004, 0xA005, 0xA006, 0xA007
GET_VARIABLES, SET_VARIABLES, WRITE, REBOOT, LIST = 0xA00B, 0xA00C, 0xA00D, 0xA00E, 0xA011
ACTIVE = 1


def frame(source, kind, *words):
    payload = struct.pack(f"<{len(words)}H", *(word & 0xFFFF for word in words))
    return struct.pack("<HHH", len(payload), source, kind) + payload


def words_of(payload):
    return list(struct.unpack(f"<{len(payload) // 2}h", payload[:len(payload) // 2 * 2]))


class Board:
    def __init__(self, name, number=7, eeprom=None, report=False):
        self.name, self.number, self.bytes = name, number, b""
        self.line, far = socket.socketpair()
        image = str(IMAGES / f"{name}.elf")
        qemu = ["qemu-system-arm", "-icount", "shift=6", "-display", "none", "-monitor", "none", "-serial", "stdio", "-kernel", image]
        self._id = tempfile.NamedTemporaryFile(prefix="vagus-id-")
        self._id.write(struct.pack("<I", number))
        self._id.flush()
        command = {
            "microbit": [*qemu, "-M", "microbit", "-device", f"loader,addr=0x3dffc,file={self._id.name},force-raw=on"],
            "mps2-an385": [*qemu, "-M", "mps2-an385", "-device", f"loader,addr=0x3ffffc,data={number},data-len=4"],
            "atmega1284p": [str(BUILD / "bin/vagus-avr"), image, "--id", str(number), *(["--eeprom", eeprom] if eeprom else []),
                            *(["--report"] if report else [])],
        }[name]
        self.process = subprocess.Popen(command, stdin=far, stdout=far)
        far.close()

    def __enter__(self):
        self.wait_until_there()
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()
        self.line.close()
        self._id.close()

    def put(self, data):
        self.line.sendall(data)

    def send(self, kind, *words, source=0):
        self.put(frame(source, kind, *words))

    def command(self, kind, *words):
        self.send(kind, self.number, *words)

    def read(self, seconds=GIVE_UP_AFTER):
        """The next frame: source, type, payload. None if none comes within so long."""
        deadline = time.monotonic() + seconds
        while len(self.bytes) < 6 or len(self.bytes) < 6 + struct.unpack_from("<H", self.bytes)[0]:
            left = deadline - time.monotonic()
            if left <= 0 or not select.select([self.line], [], [], left)[0]:
                return None
            more = self.line.recv(65536)
            if not more:
                raise Missing(f"the emulator of {self.name} has ended")
            self.bytes += more
        size, source, kind = struct.unpack_from("<HHH", self.bytes)
        payload, self.bytes = self.bytes[6:6 + size], self.bytes[6 + size:]
        return source, kind, payload

    def wait(self, kind, others=None):
        """The payload of the next frame of this type; what came before goes to `others`."""
        while (got := self.read()) is not None:
            if got[1] == kind:
                return got[2]
            if others is not None:
                others.append(got)
        raise Missing(f"{self.name} never sent {kind:04x}")

    def wait_until_there(self):
        """A board that starts does not say so: it is asked until it answers."""
        deadline = time.monotonic() + GIVE_UP_AFTER
        while time.monotonic() < deadline:
            self.send(LIST, 5)
            while (got := self.read(0.2)) is not None:
                if got[1] == PRESENT:
                    return
        raise Missing(f"{self.name} never answered")

    def answer(self):
        """What came before the answer to a command that is answered with the state."""
        others = []
        self.wait(STATE, others)
        return others

    def drain(self):
        """Whatever is under way has come when this returns: a question at its end was answered."""
        self.command(GET_STATE)
        return self.answer()

    def fill_line(self):
        """Nobody reads, until no more bytes come: the line is full, or the board has nothing to say."""
        waiting = -1
        while waiting != (waiting := int.from_bytes(fcntl.ioctl(self.line, termios.FIONREAD, bytes(4)), sys.byteorder)):
            select.select([], [], [], ASK_AGAIN_AFTER)

    def load(self, program):
        for start in range(0, len(program), 200):
            self.command(SET_BYTECODE, start, *program[start:start + 200])
            self.wait(STATE)

    def variables(self, start, count):
        self.command(GET_VARIABLES, start, count)
        values = []
        while len(values) < count:
            values += words_of(self.wait(VARIABLES))[1:]
        return values

    def set_variables(self, start, values):
        for at in range(0, len(values), 200):
            self.command(SET_VARIABLES, start + at, *values[at:at + 200])
