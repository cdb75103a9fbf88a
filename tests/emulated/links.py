"""The emulated boards and their lines: what is saved, what starts by itself, and lines on which things go wrong."""
import os
import random
import tempfile
import unittest

from board import (ACTIVE, BYTES_OF_A_SECOND, ERROR, LIST, PRESENT, REBOOT, RUN, SET_BYTECODE, STATE, STOP, WRITE, Board,
                   frame, words_of)

USER = 44  # a variable behind those that are described
DROPPED = 34
PERIOD, SILENT_MS = 38, 400  # timer.period; a line that is pulled and put in is silent for longer
TICK = 6
# onevent 5: variable 44 = 11
ON_FIVE = [3, 5, 3, 0x100B, 0x4000 + USER, 0]
# The same; onevent timer: emit event 6
ON_FIVE_AND_TIMER = [5, 5, 5, 0xFFFE, 8, 0x100B, 0x4000 + USER, 0, 0xB000 + TICK, 0, 0, 0]
# init: emit event 9 with 2 variables, for ever
EMITS_FOREVER = [3, 0xFFFF, 3, 0xB009, USER, 2, 0x9FFD, 0]


def seed():
    number = int(os.environ.get("VAGUS_SEED", random.SystemRandom().randrange(2**31)))
    print(f"seed {number}")
    return random.Random(number)


class Links:
    """What every board does; a class below for each of them."""

    def setUp(self):
        self.board = self.enterContext(Board(self.name))

    def answers(self):
        """Within a second of good bytes: asked each 100 ms, ten times."""
        for _ in range(10):
            self.board.send(LIST, 5)
            while (got := self.board.read(0.1)) is not None:
                if got[1] == PRESENT:
                    return True
        # A machine that is too busy to emulate gets the time it needs, but no more bytes.
        return (got := self.board.read()) is not None and got[1] == PRESENT

    def test_saved_program_and_number_start_by_themselves(self):
        self.board.load(ON_FIVE)
        self.board.set_variables(0, [21])
        self.board.command(WRITE)
        self.assertEqual(self.board.wait(ERROR)[3:], b"Flashing OK")
        self.board.command(REBOOT)
        self.board.number = 21
        self.board.wait_until_there()
        self.board.drain()
        self.board.send(5, source=3)
        self.board.drain()
        self.assertEqual(self.board.variables(0, 2), [21, 3])
        self.assertEqual(self.board.variables(USER, 1), [11])

    def test_script_that_emits_without_end_can_be_stopped(self):
        self.board.load(EMITS_FOREVER)
        self.board.command(RUN)
        self.board.fill_line()
        self.board.command(STOP)
        others = []
        while words_of(self.board.wait(STATE, others))[1] & ACTIVE:
            pass
        self.assertLess(len(others), 5000)
        self.assertGreater(self.board.variables(DROPPED, 1)[0] & 0xFFFF, 0)

    def test_link_pulled_at_any_moment_of_an_upload(self):
        """The bytes end anywhere, then another host comes: it finds a node that answers, and no program of the pieces."""
        self.board.load(ON_FIVE_AND_TIMER)
        self.board.set_variables(PERIOD, [SILENT_MS])
        self.board.command(RUN)
        whole = frame(0, SET_BYTECODE, 7, 0, *[3, 5, 3] + [0x1063, 0x4000 + USER, 0] * 20)
        for cut in sorted(seed().sample(range(1, len(whole)), 12)):
            self.board.put(whole[:cut])
            for _ in range(2):  # by the board's own clock: a machine that is too busy to emulate lets it stand
                self.board.wait(TICK)
            self.assertTrue(self.answers(), cut)
            self.board.send(5, source=3)
            self.board.drain()
            self.assertEqual(self.board.variables(USER, 1), [11], cut)
            self.board.set_variables(USER, [0])

    def test_noise_and_flipped_bits(self):
        """What a busy line carries in so many seconds, as noise, in six pieces, and good frames with flipped bits before."""
        chance = seed()
        self.board.load(ON_FIVE)
        for round_number in range(6):
            good = b"".join(frame(0, LIST, 5) + frame(2, 3, 1, 2, 3) for _ in range(20))
            for bit in chance.sample(range(8 * len(good)), 10):
                good = good[:bit // 8] + bytes([good[bit // 8] ^ (1 << bit % 8)]) + good[bit // 8 + 1:]
            noise = bytes(chance.choice((0, chance.randrange(256))) for _ in range(self.noise_seconds * BYTES_OF_A_SECOND // 6))
            self.board.put(good + noise)
            self.assertTrue(self.answers(), round_number)
        self.board.wait_until_there()


class Microbit(Links, unittest.TestCase):
    name = "microbit"
    noise_seconds = 60 if os.environ.get("VAGUS_LONG") else 10


class Mps2(Links, unittest.TestCase):
    name = "mps2-an385"
    noise_seconds = 60 if os.environ.get("VAGUS_LONG") else 10


class Atmega(Links, unittest.TestCase):
    name = "atmega1284p"
    noise_seconds = 2  # its line is as slow as a real one

    def test_power_cut_in_a_save(self):
        """The power goes in the middle, here and there: what then starts by itself is the old program or the new one."""
        folder = self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-eeprom-"))
        chance = seed()
        programs = {11: ON_FIVE + [0] * 150, 22: [3, 5, 3, 0x1016, 0x4000 + USER, 0] + [0] * 150}
        eeprom, before = os.path.join(folder, "eeprom"), 11
        with Board(self.name, eeprom=eeprom) as first:
            first.load(programs[before])
            first.command(WRITE)
            first.wait(ERROR)
        for _ in range(5):
            after = 33 - before
            with Board(self.name, eeprom=eeprom) as cut:
                cut.load(programs[after])
                cut.command(WRITE)
                for _ in range(chance.randrange(40)):  # time passes in the board, some milliseconds each
                    cut.drain()
            with Board(self.name, eeprom=eeprom) as again:
                again.send(5, source=3)
                again.drain()
                before = again.variables(USER, 1)[0]
                self.assertIn(before, programs)


if __name__ == "__main__":
    unittest.main(verbosity=2)
