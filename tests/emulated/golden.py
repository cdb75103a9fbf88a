"""The golden programs on an emulated board: memory, events and errors as testdata/golden/aesl says, for all that fit.

    golden.py BOARD

A board has variables of its own where the programs' node has none; they are put in between, and the programs are
compiled for that. Local events come from a board itself, not from the bus: a program's local events get numbers of the bus.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

from board import ACTIVE, ERROR, GET_STATE, REBOOT, RUN, STATE, Board, words_of
from harness import ROOT, VAGUS, Missing

GOLDEN = ROOT / "testdata/golden/aesl"
# Words of the firmware behind event.args: firmware/node/face.hpp; two more where there are motors.
OWN_VARIABLES = {"microbit": 7, "mps2-an385": 7, "atmega1284p": 9}
FIRST_LOCAL = 0xFFFE
ON_THE_BUS = 0x0F00    # the number on the bus of the first local event
LINE_HOLDS = 120       # bytes of events that one handler may emit at once: the ring of firmware/node/sender.hpp
OVERSIZE_NATIVES = re.compile(r"\bsys\.")
DIVISION, ACCESS = 0x9007, 0x9006
KINDS = {DIVISION: "division_by_zero", ACCESS: "array_out_of_bounds", ERROR: "node_specific"}


def node_file(folder, board):
    node = json.loads((GOLDEN / "node.json").read_text())
    node["variables"].insert(3, {"name": "board", "size": OWN_VARIABLES[board]})
    node["variablesSize"] += OWN_VARIABLES[board]
    path = pathlib.Path(folder) / "node.json"
    path.write_text(json.dumps(node))
    return node, path


def fits(source, expected):
    if OVERSIZE_NATIVES.search(source):
        return False  # natives that no board has
    bytes_at = {}
    for emission in expected["events_emitted"]:
        bytes_at[emission["during"]] = bytes_at.get(emission["during"], 0) + 6 + 2 * len(emission["args"])
    return all(count <= LINE_HOLDS for count in bytes_at.values())


def event_number(node, name):
    for i, event in enumerate(node["localEvents"]):
        if event["name"] == name:
            return ON_THE_BUS + i
    return next(i for i, event in enumerate(node["events"]) if event["name"] == name)


def with_events_of_the_bus(bytecode):
    code = list(bytecode)
    for at in range(1, code[0], 2):
        if FIRST_LOCAL - 16 < code[at] <= FIRST_LOCAL:
            code[at] = ON_THE_BUS + FIRST_LOCAL - code[at]
    return code


class Run:
    """One program on the board, from its start to its last stimulus."""

    def __init__(self, board, node, program):
        self.board, self.node, self.program = board, node, program
        self.emitted, self.error, self.during = [], None, 0

    def start(self):
        self.board.set_variables(0, [0] * self.node["variablesSize"])
        self.board.load(with_events_of_the_bus(self.program["bytecode"]))
        self.board.drain()
        self.board.command(RUN)
        self.hear_all(self.board.answer())
        self.settle()

    def settle(self):
        """Until the event is over."""
        while True:
            others = []
            self.board.command(GET_STATE)
            flags = words_of(self.board.wait(STATE, others))[1]
            self.hear_all(others)
            if not flags & ACTIVE:
                break
        # Answers pass events that wait: those are over when one answer came without any.
        while others := self.board.drain():
            self.hear_all(others)

    def hear_all(self, frames):
        for _, kind, payload in frames:
            self.hear(kind, payload)

    def hear(self, kind, payload):
        if kind < 0x8000:
            name = self.node["events"][kind]["name"]
            self.emitted.append({"during": self.during, "event": name, "args": words_of(payload)})
        elif kind in KINDS:
            pc = words_of(payload)[0]
            self.error = {"kind": KINDS[kind], "during": self.during, "line": self.program["lines"][pc]}

    def apply(self, stimulus):
        self.during += 1
        for name, words in stimulus.get("set", {}).items():
            self.board.set_variables(self.program["variables"][name][0], words)
        if "event" not in stimulus:
            return
        source = stimulus.get("source", self.board.variables(1, 1)[0])
        self.board.send(event_number(self.node, stimulus["event"]), *stimulus.get("args", []), source=source & 0xFFFF)
        self.settle()

    def memory(self):
        values = self.board.variables(0, self.node["variablesSize"])
        named = {variable["name"] for variable in self.node["variables"]}
        memory = {}
        for name, (at, size) in self.program["variables"].items():
            words = values[at:at + size]
            if name != "board" and (name not in named or any(words)):
                memory[name] = words
        return memory


def compiled(source, node_path):
    words = [VAGUS, "compile", source, "--node", node_path, "--format", "json"]
    done = subprocess.run(list(map(str, words)), stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True)
    return json.loads(done.stdout)["nodes"][0]


def differences(board, node, path, source, expected):
    run = Run(board, node, compiled(source, path))
    if "math.rand" in source.read_text():  # begins with what it was after a start
        board.command(REBOOT)
        board.wait_until_there()
    run.start()
    for stimulus in expected.get("stimuli", []):
        if run.error:
            break
        run.apply(stimulus)
    wanted = expected.get("runtime_error")
    if wanted:
        wanted = {key: wanted[key] for key in ("kind", "during", "line")}
    pairs = [("memory", run.memory(), expected["memory"]), ("events", run.emitted, expected["events_emitted"]),
             ("error", run.error, wanted)]
    return [f"{what}: expected {good}, found {found}" for what, found, good in pairs if found != good]


def differences_once_all_came(board, *what):
    """A busy computer can give an emulator its bytes so late that the board takes a frame for broken: then once more."""
    try:
        return differences(board, *what)
    except Missing as lost:
        print(f"once more: {lost}")
        board.command(REBOOT)
        board.wait_until_there()
        return differences(board, *what)


def main():
    name, ran, left, failed = sys.argv[1], 0, 0, 0
    with tempfile.TemporaryDirectory(prefix="vagus-golden-") as folder, Board(name, report=True) as board:
        node, path = node_file(folder, name)
        for file in sorted(GOLDEN.glob("*.expected.json")):
            expected = json.loads(file.read_text())
            source = GOLDEN / (file.name.removesuffix(".expected.json") + ".aesl")
            if "error" in expected:
                continue
            if not fits(source.read_text(), expected):
                left += 1
                continue
            ran += 1
            for difference in differences_once_all_came(board, node, path, source, expected):
                print(f"{source.name}: {difference}")
                failed += 1
    print(f"figure: golden programs on {name}: {ran} ran, {left} do not fit, {failed} differences")
    return 1 if failed or ran < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
