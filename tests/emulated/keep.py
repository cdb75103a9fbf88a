"""`vagus emulate --keep`: what a board said it saved is there after kill -9 of the emulator, and of vagus, at any
moment: the old program or the new one, whole."""
import os
import pathlib
import random
import signal
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from board import ERROR, WRITE, Board
from harness import connect, listening, run_vagus, vagus

USER = 44  # a variable behind those that are described
FILL = [0] * 150
# onevent 5: variable 44 = 11, or 22.
PROGRAMS = {11: [3, 5, 3, 0x100B, 0x4000 + USER, 0] + FILL, 22: [3, 5, 3, 0x1016, 0x4000 + USER, 0] + FILL}
NUMBER = 7
KILLS = 24 if os.environ.get("VAGUS_LONG") else 6
# From the command to the answer; kills come in this time, and a little later.
TURNS_MAX = 40


def seed():
    number = int(os.environ.get("VAGUS_SEED", random.SystemRandom().randrange(2**31)))
    print(f"seed {number}")
    return random.Random(number)


def child_of(process):
    words = pathlib.Path(f"/proc/{process}/task/{process}/children").read_text().split()
    return int(words[0])


class Kept(Board):
    """A board of `vagus emulate --keep`, by its listening socket."""

    def __init__(self, name, folder):  # pylint: disable=super-init-not-called
        self.name, self.number, self.bytes = name, NUMBER, b""
        self.program = vagus("emulate", name, "--id", NUMBER, "--keep", folder, "--listen", "tcp:127.0.0.1:0")
        self.line = connect(listening(self.program))

    def __exit__(self, *_):
        self.line.close()
        self.program.__exit__()

    def kill(self, whom):
        """Gives what it said before."""
        process = self.program.process.pid
        os.kill(child_of(process) if whom == "emulator" else process, signal.SIGKILL)
        said = self.bytes
        try:
            while more := self.line.recv(65536):
                said += more
        except OSError:
            pass
        self.program.wait_end()
        return said

    def answer_of(self):
        self.set_variables(USER, [0])
        self.send(5, source=3)
        self.drain()
        return self.variables(USER, 1)[0]


class Keep:
    """What every board does; a class below for each of them."""

    def setUp(self):
        self.folder = os.path.join(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-keep-")), "boards")

    def board(self):
        return Kept(self.name, self.folder)

    def save(self, value):
        with self.board() as board:
            board.load(PROGRAMS[value])
            board.command(WRITE)
            self.assertEqual(board.wait(ERROR)[3:], b"Flashing OK")
            board.kill("vagus")

    def test_what_was_saved_is_there_after_a_kill(self):
        self.save(11)
        with self.board() as again:
            self.assertEqual(again.answer_of(), 11)
            again.kill("emulator")
        with self.board() as third:
            self.assertEqual(third.answer_of(), 11)

    def test_kills_at_any_moment_leave_the_old_program_or_the_new_one(self):
        chance = seed()
        self.save(11)
        before = 11
        for i in range(KILLS):
            after, whom = 33 - before, ("emulator", "vagus")[i % 2]
            with self.board() as board:
                board.load(PROGRAMS[after])
                board.command(WRITE)
                others = []
                for _ in range(chance.randrange(TURNS_MAX)):  # time passes in the board, some milliseconds each
                    others += board.drain()
                last = board.kill(whom)
                said = b"Flashing OK" in last or any(kind == ERROR for _, kind, _ in others)
            with self.board() as again:
                found = again.answer_of()
            self.assertIn(found, (before, after), f"{i}, {whom}")
            if said:
                self.assertEqual(found, after, f"{i}, {whom}: the board said that it had saved")
            before = found

    def test_a_file_of_another_size_is_refused_with_its_place(self):
        os.mkdir(self.folder)
        file = os.path.join(self.folder, f"{self.name}-1.{self.ending}")
        pathlib.Path(file).write_bytes(b"short")
        told = run_vagus("emulate", self.name, "--keep", self.folder, "--listen", "tcp:127.0.0.1:0", status=2)
        self.assertIn(f"{file}: expected the ", told)
        self.assertIn("found 5; delete the file", told)


class KeepMicrobit(Keep, unittest.TestCase):
    name, ending = "microbit", "flash"


class KeepMps2(Keep, unittest.TestCase):
    name, ending = "mps2-an385", "flash"


class KeepAtmega(Keep, unittest.TestCase):
    name, ending = "atmega1284p", "eeprom"


if __name__ == "__main__":
    unittest.main(verbosity=2)
