"""`vagus emulate`: boards of two families on one bus, seen by the tools that see every other bus."""
import os
import pathlib
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import (GET_EXECUTION_STATE, GIVE_UP_AFTER, STATE, VAGUS, Bus, Program, list_nodes, listening, run_vagus, vagus,
                     wait_until)

NODES = 5
# Each node hears the token of the one before it, adds its own number, and passes it on.
SCRIPT = """var sum
var rounds = 0
onevent token
  if event.args[0] == _id then
    sum = event.args[1] + _id
    rounds += 1
    emit token [_id + 1, sum]
  end
"""
NAMES = {1: "microbit", 2: "microbit", 3: "mps2-an385", 4: "atmega1284p", 5: "atmega1284p"}
PROJECT = '<!DOCTYPE aesl-source>\n<network>\n<event size="2" name="token"/>\n' + "".join(
    f'<node nodeId="{number}" name="{name}">{SCRIPT}</node>\n' for number, name in NAMES.items()) + "</network>\n"


def children_of(process):
    return [int(word) for word in pathlib.Path(f"/proc/{process}/task/{process}/children").read_text().split()]


class Network(unittest.TestCase):
    def emulate(self, *words):
        return self.enterContext(vagus("emulate", *words, "--listen", "tcp:127.0.0.1:0"))

    def test_three_and_two_boards_pass_an_event_round(self):
        port = listening(self.emulate("microbit:2", "mps2-an385", "atmega1284p:2"))
        target = f"tcp:127.0.0.1:{port}"
        wait_until("not all boards are there", lambda: len(list_nodes(port)) == NODES)
        wait_until(f"the network never had {NAMES}",
                   lambda: {node["id"]: node["name"] for node in list_nodes(port)} == NAMES)
        folder = self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-emulate-"))
        project = os.path.join(folder, "round.aesl")
        pathlib.Path(project).write_text(PROJECT, encoding="utf-8")
        for number in NAMES:
            run_vagus("net", target, "load", project, str(number), "--wait", GIVE_UP_AFTER)
        with Bus(port) as bus:
            # The descriptions of all have gone to all: who answers has read them.
            for number in NAMES:
                bus.ask(lambda node=number: bus.send(0, GET_EXECUTION_STATE, node), STATE, number)
            bus.send(0, 0, 1, 0)
            sums = [bus.wait(0, source) for source in NAMES]
        self.assertEqual([int.from_bytes(words[2:4], "little") for words in sums], [1, 3, 6, 10, 15])
        self.assertEqual([int.from_bytes(words[0:2], "little") for words in sums], [2, 3, 4, 5, 6])

    def test_three_commands_one_behind_the_other_see_no_two_nodes_of_one_id(self):
        port = listening(self.emulate("microbit:2", "mps2-an385", "atmega1284p:2"))
        target = f"tcp:127.0.0.1:{port}"
        wait_until("not all boards are there", lambda: len(list_nodes(port)) == NODES)
        said = []
        for _ in range(3):
            said.append(run_vagus("net", target, "list", "--json"))
            said.append(run_vagus("net", target, "save", "3"))
            said.append(run_vagus("net", target, "get", "5", "_id"))
        self.assertNotIn("two nodes have the id", "\n".join(said))

    def examine(self, board):
        port = listening(self.emulate(board))
        wait_until("the board is not there", lambda: len(list_nodes(port)) == 1)
        told = run_vagus("conformance", f"tcp:127.0.0.1:{port}", "--flash", "--sleep", "--may-drive")
        # Description in fragments, and events that are longer than its room to send.
        self.assertRegex(told, rf'\n198 passed, 0 failed, 2 skipped: node 1 "{board}"')

    def test_conformance_finds_no_fault_in_a_microbit(self):
        self.examine("microbit")

    def test_conformance_finds_no_fault_in_an_mps2(self):
        self.examine("mps2-an385")

    def test_conformance_finds_no_fault_in_an_atmega(self):
        self.examine("atmega1284p")

    def test_boards_end_with_the_command_that_is_killed(self):
        program = self.emulate("microbit", "atmega1284p", "--count", 1)
        listening(program)
        boards = children_of(program.process.pid)
        self.assertEqual(len(boards), 2)
        program.kill()
        wait_until("a board outlives the command", lambda: not any(pathlib.Path(f"/proc/{board}").exists() for board in boards))

    def test_command_ends_with_a_board_that_is_lost(self):
        program = self.emulate("mps2-an385", "--id", 9)
        listening(program)
        os.kill(children_of(program.process.pid)[0], 9)
        program.wait_line(r"mps2-an385 9.*its emulator has ended")
        self.assertEqual(program.wait_end(), 1)

    def test_what_is_no_board_is_said_with_those_there_are(self):
        self.assertIn("microbits: no such board; there are microbit, mps2-an385, atmega1284p. Did you mean microbit?",
                      run_vagus("emulate", "microbits", status=2))
        self.assertIn("expected a number from 1 to 32 behind the colon", run_vagus("emulate", "microbit:33", status=2))
        self.assertIn("more than 32 boards", run_vagus("emulate", "microbit:32", "microbit", status=2))

    def test_what_is_not_installed_is_said_with_where_to_get_it(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-emulate-")))
        (folder / "bin").mkdir()
        program = folder / "bin/vagus"
        shutil.copy(VAGUS, program)
        self.says(program, "there is no .*/share/vagus/firmware/microbit.elf; ./dev firmware", "microbit")
        (folder / "share/vagus/firmware").mkdir(parents=True)
        for board in ("microbit", "atmega1284p"):
            (folder / f"share/vagus/firmware/{board}.elf").touch()
        self.says(program, "there is no .*/bin/vagus-avr; apt-get install libsimavr-dev", "atmega1284p")
        self.says(program, "qemu-system-arm is not installed; apt-get install qemu-system-arm", "microbit", path="")

    def says(self, program, sentence, board, path=None):
        env = {} if path is None else {"PATH": path}
        with Program(program, "emulate", board, "--listen", "tcp:127.0.0.1:0", env=env) as emulate:
            emulate.wait_line(sentence)
            self.assertEqual(emulate.wait_end(), 1)

    def test_one_folder_is_of_one_command(self):
        folder = self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-keep-"))
        listening(self.enterContext(vagus("emulate", "microbit", "--keep", folder, "--listen", "tcp:127.0.0.1:0")))
        told = run_vagus("emulate", "microbit", "--keep", folder, "--listen", "tcp:127.0.0.1:0", status=1)
        self.assertIn(f"--keep {folder}: another vagus emulate keeps its boards there", told)

    def test_boards_join_a_switch_again_when_it_comes_back(self):
        with vagus("switch", "--listen", "tcp:127.0.0.1:0") as switch:
            port = listening(switch)
            boards = self.enterContext(vagus("emulate", "microbit", "atmega1284p", "--connect", f"tcp:127.0.0.1:{port}"))
            boards.wait_line("connected")
            wait_until("the boards are not there", lambda: len(list_nodes(port)) == 2)
        boards.wait_line("trying to reach it again")
        again = self.enterContext(vagus("switch", "--listen", f"tcp:127.0.0.1:{port}"))
        self.assertEqual(listening(again), port)
        wait_until("the boards never came back", lambda: len(list_nodes(port)) == 2)

    def test_targets_that_cannot_be_are_refused_with_their_place(self):
        self.assertIn("nonsense", run_vagus("emulate", "microbit", "--connect", "nonsense", status=2))
        told = run_vagus("emulate", "microbit", "--listen", "tcp:127.0.0.1:33399", "--connect", "tcp:localhost:33399", status=2)
        self.assertIn("--connect tcp:localhost:33399: these boards listen there themselves", told)


if __name__ == "__main__":
    unittest.main(verbosity=2)
