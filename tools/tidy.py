#!/usr/bin/env python3
"""The rules of the house that a machine can check. Prints FILE:LINE: sentence for each breach; exit 1 if there is one.

    tools/tidy.py            check the checkout around this file
    tools/tidy.py --self     check that each rule still catches its example
"""
import os
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent

# An arrow means "may include" (docs/ARCHITECTURE.md). Nothing else may.
BELOW_SESSION = ["run", "toolbox", "sim", "debug", "net", "fleet", "keeper", "node", "hub", "plan", "aesl", "fastvm", "vm", "base", "isa", "wire"]
MAY_INCLUDE = {
    "base": [],
    "mcap": ["base"],
    "keeper": ["base"],
    "isa": [],
    "wire": [],
    "vm": ["isa", "wire"],
    "fastvm": ["vm", "isa", "wire"],
    "node": ["vm", "isa", "wire"],
    "hub": ["wire", "base"],
    "plan": ["base"],
    "aesl": ["isa", "base"],
    "fleet": ["keeper", "plan", "base"],
    "run": ["plan", "base"],
    "toolbox": ["run", "plan", "keeper", "wire", "base"],
    "embed": ["session"] + BELOW_SESSION,
    "sim": ["hub", "node", "fastvm", "vm", "isa", "wire", "base"],
    "debug": ["aesl", "wire", "base"],
    "net": ["hub", "wire", "base"],
    "conformance": ["debug", "aesl", "isa", "wire", "base"],
    "session": BELOW_SESSION,
    "record": ["embed", "session", "mcap"] + BELOW_SESSION,
    "trial": ["record", "embed", "session", "mcap"] + BELOW_SESSION,
    "serve": ["trial", "record", "embed", "session", "mcap"] + BELOW_SESSION,
    "cli": ["conformance", "serve", "trial", "record", "embed", "session", "mcap"] + BELOW_SESSION,
}
# Inside a module, too, an arrow points down: a file may include what is in its own room or in one before it. Rooms
# from the ground up; a name is that of a file without its ending, a name with / at its end that of a folder. Tests may
# include everything.
ROOMS = {
    "aesl": [
        ("values", "limits target options diagnostic program unicode suggest stimuli"),
        ("files", "abo node_file xml_scan project project_format project_text listing"),
        ("catalogue", "diagnostics fix catalogue_main"),
        ("text", "token names scan mentions"),
        ("tree", "tree fold expand sizes places"),
        ("parser", "dialect parse parse_calls parse_declarations parse_expressions parse_hints parse_slips parse_statements parser"),
        ("checks", "types warn"),
        ("code", "code code_writer emit stack link"),
        ("whole", "compile"),
    ],
    "conformance": [
        ("values", "line instructions finding standard_natives"),
        ("the bench", "bench native_call"),
        ("checks", "check checks check_breakpoints check_control check_description check_events check_faults check_flash check_sleep "
                   "check_limits check_messages check_native_faults check_natives check_opcodes check_operators check_program check_stack"),
        ("the whole", "examine report_text"),
    ],
    "sim": [
        ("values", "definitions schedule crew drawing noise cell_grid texture png ground witness frame_numbers"),
        ("bodies", "moving_grid sight spacing arena fan wheels camera"),
        ("devices", "node_variables machine robot sd_card can_bus chaos chaos_clock chaos_file chaos_line sensor_chaos node_chaos"),
        ("robots", "thymio2/ epuck/ carbot/"),
        ("files", "standing world_check robot_grid world_file"),
        ("world", "frame_notes frames_for_others node_bus inhabitants node_turns node_turns_chaos host_chaos world_insides world world_acts thread_choice world_threads"),
    ],
    "serve": [
        ("ground", "process access bytes json plan_value thrown worker"),
        ("protocol", "protocol/"),
        ("a broker", "broker/"),
        ("door", "web/"),
        ("pages", "studio/"),
        ("a fleet", "fleet/"),
        ("files", "project/"),
        ("scripts", "script/"),
        ("editing", "edit/"),
        ("target", "target/"),
        ("what a run tells", "follow/ talk/"),
        ("a run", "runner/ history/ run/"),
        ("the life of a run", "life/"),
        ("the whole", "workbench/"),
        ("on a robot", "field/"),
    ],
}

# Folders of one room that know nothing of each other: what they share is in a room below.
APART = {"serve": ["runner/ history/ run/"]}

# Modules that compile for a microcontroller: these headers and no others.
FREESTANDING = ["isa", "vm", "wire", "node"]
FREESTANDING_HEADERS = {"stdint.h", "stddef.h", "string.h"}
FLASH_HEADER = "src/isa/flash.hpp"

# The rim: only here may the program talk to the operating system.
SYSTEM_HEADERS = re.compile(r"^(sys/|netinet/|arpa/|linux/|unistd\.h|termios\.h|fcntl\.h|dlfcn\.h|poll\.h|pty\.h|signal\.h|boost/(?!context/))")
MAY_CALL_SYSTEM = ("src/net/", "src/cli/", "src/base/file.cpp", "src/base/folder.cpp", "src/base/folder_lock.cpp", "src/base/line_sink.cpp", "src/base/lost_pages.cpp", "src/base/log_lines.cpp", "src/base/one_writer.cpp", "src/base/process_copy.cpp", "src/base/temporary_folder.cpp", "src/toolbox/load.cpp",
                   "src/serve/process.cpp", "src/serve/workbench/door.cpp", "src/serve/web/", "src/serve/broker/")
# Libraries that stay behind one door.
ONE_DOOR = [
    (re.compile(r"^(rapidjson|nlohmann)/"), ("src/base/json", "src/serve/"), "JSON is read through base/json"),
    (re.compile(r"^boost/(?!context/)"), ("src/net/", "src/serve/web/"), "sockets are in net and serve/web only"),
    (re.compile(r"^boost/context/"), ("src/run/fiber.cpp",), "stacks are switched in run/fiber.cpp only"),
    (re.compile(r"^CLI/"), ("src/cli/",), "the command line is known in cli only"),
    (re.compile(r"^box2d/"), ("src/sim/",), "physics is known in sim only"),
    (re.compile(r"^pugixml"), ("src/aesl/project",), "XML is read in aesl/project only"),
    (re.compile(r"^(mosquitto|mqtt_protocol)\.h$"), ("src/serve/broker/",), "MQTT is spoken in serve/broker only"),
    (re.compile(r"^iostream$"), ("src/cli/",), "libraries give values; only cli prints"),
]
CLOCKS = re.compile(r"\b(wall_now|steady_clock|system_clock|high_resolution_clock|gettimeofday|clock_gettime)\b")
MAY_TELL_TIME = ("src/net/", "src/cli/", "src/run/real_time_parts.hpp", "src/serve/runner/runner.cpp", "src/serve/workbench/door.cpp",
                "src/serve/broker/")

LINES_MAX = 600
COLUMNS_MAX = 100
FUNCTION_LINES_MAX = 60
# Functions that may be longer, each with its reason.
LONG_FUNCTIONS = {
    "src/vm/": "the instruction loop is one picture",
}
SLEEPS = re.compile(r"\b(sleep_for|sleep_until|usleep|nanosleep)\s*\(|(?<![\w.])sleep\s*\(\s*\d")
TRY_THAT_LEAKS = re.compile(r"\bnew [\w:<>]+\([^;]*\bTRY\(|\{[^{};()\n]*,\s*TRY\(|\{\s*\"[^\"]*\", TRY\(|,\s*\.\w+ = TRY\(")
UNFINISHED = re.compile(r"\b(TODO|FIXME|XXX)\b")
# Of sentences that people read: the words to write instead are in docs/STYLE.md, "Words".
OLD_WORDS = re.compile(r"\b(anew|mend(?:s|ed|ing)?|must be fed|comes? to stand|came to stand|(?:give|gives|gave|given|giving) up"
                       r"|(?:take|takes|took|taken|taking)(?: it| them| one| some)? away)\b", re.IGNORECASE)
# Of the pages below docs, these speak of such words, or are older than the words.
MAY_SAY_OLD_WORDS = {"docs/STYLE.md", "docs/decisions", "docs/spec"}
TYPE_ALONE = re.compile(r"^\s+(const |static |mutable )*(?!default:)[\w:]+(<[^()]*>)?[&*]?$")
NAME_AND_COMMENT = re.compile(r"^\s*\w+(\{\})?( = [^;]*)?;\s*//")
EXAMPLE_LINE = re.compile(r"^\s*//     ")
TWO_STATEMENTS = re.compile(r";\s+([A-Z]\w* \w+\s*(;|=|$)|(const|if|for)\b|\w+;)")
# Folders that hold what is made, not what is written.
MADE = {"build", "node_modules", "dist", "__pycache__"}
# Of docs/ARCHITECTURE.md: names that mean any file.
EXAMPLE_PATHS = {"x.cpp", "x_test.cpp"}
SUFFIXES = {".hpp", ".cpp", ".inl", ".h"}


class Checker:
    def __init__(self, path, text):
        self.path = path
        self.lines = text.split("\n")
        self.breaches = []

    def say(self, line, sentence):
        self.breaches.append(f"{self.path}:{line}: {sentence}")

    def module(self):
        parts = self.path.split("/")
        return parts[1] if parts[0] == "src" and len(parts) > 2 else None

    def is_test(self):
        return (self.path.endswith("_test.cpp") or "/test_" in self.path  # x_test.cpp, and what tests share: test_x.hpp
                or self.path.startswith(("tests/", "bench/", "fuzz/")))

    def run(self):
        self.check_size()
        self.check_shape()
        for number, line in enumerate(self.lines, 1):
            self.check_line(number, line)
            include = re.match(r'\s*#\s*include\s*[<"]([^>"]+)[>"]', line)
            if include:
                self.check_include(number, include.group(1), '"' in line)
        if self.path.endswith(".hpp") and "#pragma once" not in self.lines:
            self.say(1, "a header begins with its sentence and #pragma once")
        if self.module() and not self.path.endswith(".inl") and not self.is_test():
            self.check_try()
            self.check_functions()
        return self.breaches

    def check_size(self):
        if len(self.lines) > LINES_MAX + 1:
            self.say(len(self.lines), f"{len(self.lines) - 1} lines; a file stops at {LINES_MAX}: split it by idea")

    def check_line(self, number, line):
        if len(line) > COLUMNS_MAX and "http" not in line:
            self.say(number, f"{len(line)} columns; a line stops at {COLUMNS_MAX}")
        if "\t" in line and self.module():
            self.say(number, "a tab; indent with spaces (in strings write \\t)")
        if UNFINISHED.search(line):
            self.say(number, "unfinished work: finish it, or put it into an issue")
        old = OLD_WORDS.search(line)
        if old:
            self.say(number, old_word(old))
        if SLEEPS.search(line) and not self.path.startswith("src/net/"):
            self.say(number, "a sleep: wait for the condition, or be told the time")
        if CLOCKS.search(line) and self.module() and not self.is_test() and not self.path.startswith(MAY_TELL_TIME):
            self.say(number, "a clock below the rim: be told the time")

    def check_include(self, number, name, quoted):
        module = self.module()
        if module is None:
            return
        first = name.split("/")[0]
        if first in MAY_INCLUDE and quoted:
            self.check_arrow(number, module, first)
            self.check_room(number, module, name)
            return
        if quoted and "/" not in name:
            self.say(number, f'write the whole path: "{module}/{name}"')
        if module in FREESTANDING and not self.is_test() and not self.is_peer(name):
            if name not in FREESTANDING_HEADERS and not (self.path == FLASH_HEADER and name == "avr/pgmspace.h"):
                self.say(number, f"<{name}> in {module}, which must build for a microcontroller: only "
                                 + ", ".join(sorted(FREESTANDING_HEADERS)))
        if SYSTEM_HEADERS.match(name) and not self.is_test() and not self.path.startswith(MAY_CALL_SYSTEM):
            self.say(number, f"<{name}>: the operating system is reached at the rim only (MAY_CALL_SYSTEM in tools/tidy.py)")
        for pattern, doors, sentence in ONE_DOOR:
            if pattern.match(name) and not self.is_test() and not self.path.startswith(doors):
                self.say(number, f"<{name}>: {sentence}")

    @staticmethod
    def is_peer(name):
        return name.startswith("gtest/")

    def check_arrow(self, number, module, other):
        if other == module or self.is_test():
            return
        if other not in MAY_INCLUDE.get(module, []):
            self.say(number, f"{module} may not include {other} (docs/ARCHITECTURE.md, layers)")

    def check_room(self, number, module, name):
        if module not in ROOMS or not name.startswith(module + "/") or self.is_test() or name.endswith(".def"):
            return
        here, there = room_of(module, self.path[len("src/"):]), room_of(module, name)
        for place, path in ((here, self.path), (there, name)):
            if place is None:
                self.say(number, f"{path} is in no room of {module}: say in ROOMS of tools/tidy.py where it belongs")
        if here is not None and there is not None and there > here:
            self.say(number, f"an arrow upwards inside {module}: the room \"{ROOMS[module][here][0]}\" may not include "
                             f"\"{ROOMS[module][there][0]}\" (ROOMS in tools/tidy.py)")
        for folders in APART.get(module, []):
            mine, other = (next((folder for folder in folders.split() if path.startswith(f"{module}/{folder}")), None)
                           for path in (self.path[len("src/"):], name))
            if mine and other and mine != other:
                self.say(number, f"{module}/{mine} may not include {module}/{other}: what both need belongs below both "
                                 f"(APART in tools/tidy.py)")

    def check_shape(self):
        """What a formatter does to declarations and examples when comments are too long for their lines."""
        for number, (line, after) in enumerate(zip(self.lines, self.lines[1:]), 1):
            deeper = len(after) - len(after.lstrip()) == len(line) - len(line.lstrip()) + 4
            if deeper and TYPE_ALONE.match(line) and (NAME_AND_COMMENT.match(after) or after.lstrip().startswith("//")):
                self.say(number, "a declaration split by its comment: put the comment in lines of its own above it")
        for number, line in enumerate(self.lines, 1):
            if EXAMPLE_LINE.match(line) and TWO_STATEMENTS.search(bare(line)):
                self.say(number, "an example that has lost its line ends: one statement a line, as in code")

    def check_try(self):
        """The memory of `new` is there before its arguments, and g++ destroys no member of a list in braces: a TRY that leaves leaks."""
        text = "\n".join(self.lines)
        for found in TRY_THAT_LEAKS.finditer(text):
            number = text[: found.start()].count("\n") + 1
            self.say(number, "TRY among the arguments of new, or in braces, leaks when it leaves: put its value into a variable before")

    def check_functions(self):
        """A function's body starts at a line that ends in `{` and is not a type or namespace, at depth 0 of its scope."""
        start = None
        for number, line in enumerate(self.lines, 1):
            if start is None and re.match(r"^( {0,4})\S.*\)\s*(const|noexcept|override|final|\s)*\{$", line):
                indent = len(line) - len(line.lstrip())
                if not re.match(r"\s*(//|(if|for|while|switch|namespace|class|struct|enum|union)\b)", line):
                    start = (number, indent)
            elif start is not None and line.startswith(" " * start[1] + "}"):
                length = number - start[0] + 1
                allowed = any(self.path.startswith(prefix) for prefix in LONG_FUNCTIONS)
                if length > FUNCTION_LINES_MAX and not allowed:
                    self.say(start[0], f"a function of {length} lines; it stops at {FUNCTION_LINES_MAX}")
                start = None


def room_of(module, path):
    """The number of the room in which a file is, or None. `path` begins with the module: aesl/scan.cpp."""
    inside = path[len(module) + 1:]
    stem = re.sub(r"\.\w+$", "", inside)
    for number, (_, names) in enumerate(ROOMS[module]):
        if any(inside.startswith(name) if name.endswith("/") else stem == name for name in names.split()):
            return number
    return None


def bare(line):
    """An example's code: without comments, texts in quotes, and what is in parentheses."""
    code = re.split(r"\s//", re.sub(r'"[^"]*"', '""', line.split("//", 1)[1]))[0]
    while re.search(r"\([^()]*\)", code):
        code = re.sub(r"\([^()]*\)", "", code)
    return code


def check_module_known(root):
    for folder in sorted((root / "src").iterdir()):
        if folder.is_dir() and folder.name not in MAY_INCLUDE:
            yield f"src/{folder.name}:1: a module that MAY_INCLUDE in tools/tidy.py does not know: say what it may include"


def old_word(found):
    return f'"{found.group(1)}" in a sentence: docs/STYLE.md, "Words", has the word for it'


def check_words(root):
    """Pages and comments speak of the project alone: no path of one machine. One word a notion, in what people read."""
    read_by_people = [root / "src/serve/protocol/protocol.json", root / "web/app/text.ts"]
    for path in sorted(root.glob("docs/**/*.md")) + sorted(root.glob("*.md")) + read_by_people:
        name = str(path.relative_to(root))
        for number, line in enumerate(path.read_text(encoding="utf-8").split("\n"), 1):
            old = OLD_WORDS.search(line)
            if old and not any(name.startswith(place) for place in MAY_SAY_OLD_WORDS):
                yield f"{name}:{number}: {old_word(old)}"
            if re.search(r"(^|[\s`(])(/work/|/root/|/home/(?!vagus))|\.\./shared", line):
                yield f"{name}:{number}: a path of one machine"


def known_paths(root):
    """All files and folders of the checkout that are not made, as paths from its root; folders end in /."""
    for folder, folders, files in os.walk(root):
        folders[:] = [name for name in folders if name not in MADE and not name.startswith(".")]
        here = str(pathlib.Path(folder).relative_to(root)) + "/"
        yield from ("/" + path.removeprefix("./") for path in [here] + [here + name for name in files])


def missing_paths(text, known):
    """(line, path) for each path in backticks that is nowhere: it may be whole, or the end of one."""
    for number, line in enumerate(text.split("\n"), 1):
        for path in re.findall(r"`([\w<>*{},./-]+)`", line):
            is_path = "/" in path.strip("/") or path.endswith("/") or re.search(r"\w\.(cpp|hpp|inl|def|md|json|py|mjs|tsx?|sh)$", path)
            if not is_path or path.startswith("/") or path in EXAMPLE_PATHS:
                continue
            pattern = re.escape(path.removeprefix("./").rstrip("/")).replace(r"\*", "[^/]*")
            pattern = re.sub(r"<\w+>", "[^/]+", pattern)
            if not any(re.search("/" + pattern + "/?$", each) for each in known):
                yield number, path


def check_map(root):
    """The map of the project leads to what is there."""
    page = root / "docs/ARCHITECTURE.md"
    for number, path in missing_paths(page.read_text(encoding="utf-8"), list(known_paths(root))):
        yield f"docs/ARCHITECTURE.md:{number}: `{path}` is not there: name the file or folder that does it now"


def check_tree(root):
    breaches = []
    for top in ("src", "tests", "bench", "fuzz", "firmware", "tools", "examples"):
        for path in sorted((root / top).rglob("*")):
            if path.suffix in SUFFIXES and "build" not in path.parts:
                name = str(path.relative_to(root))
                breaches += Checker(name, path.read_text(encoding="utf-8")).run()
    return breaches + list(check_module_known(root)) + list(check_words(root)) + list(check_map(root))


EXAMPLES = [  # path, text, what must be said of it
    ("src/vm/a.cpp", '#include "node/node.hpp"\n', "vm may not include node"),
    ("src/hub/a.cpp", '#include "net/socket.hpp"\n', "hub may not include net"),
    ("src/vm/a.cpp", "#include <vector>\n", "must build for a microcontroller"),
    ("src/sim/a.cpp", "#include <unistd.h>\n", "the rim only"),
    ("src/debug/a.cpp", "#include <nlohmann/json.hpp>\n", "base/json"),
    ("src/aesl/scan.cpp", '#include "aesl/parse.hpp"\n', "an arrow upwards inside aesl"),
    ("src/aesl/nowhere.cpp", '#include "aesl/scan.hpp"\n', "no room of aesl"),
    ("src/sim/arena.cpp", '#include "sim/world.hpp"\n', "an arrow upwards inside sim"),
    ("src/serve/runner/a.cpp", '#include "serve/history/tape.hpp"\n', "serve/runner/ may not include serve/history/"),
    ("src/serve/talk/a.cpp", '#include "serve/runner/hand.hpp"\n', "an arrow upwards inside serve"),
    ("src/hub/a.hpp", "    std::string\n        name;  // a comment\n", "split by its comment"),
    ("src/hub/a.hpp", "//     first(a); Vm vm; init(vm);\n", "lost its line ends"),
    ("src/hub/a.hpp", "// A header.\n", "#pragma once"),
    ("src/hub/a.cpp", "x" * 101 + "\n", "101 columns"),
    ("src/hub/a.cpp", "\n" * 602, "602 lines"),
    ("src/hub/a.cpp", "auto t = std::chrono::steady_clock::now();\n", "a clock below the rim"),
    ("src/hub/a.cpp", "auto t = net::wall_now();\n", "a clock below the rim"),
    ("src/hub/a_test.cpp", "std::this_thread::sleep_for(1s);\n", "a sleep"),
    ("src/hub/a.cpp", "// TO" + "DO: later\n", "unfinished"),
    ("src/hub/a.cpp", 'say("start it anew");\n', '"anew" in a sentence'),
    ("src/hub/a.cpp", "// Takes the link along.\n// Takes it away.\n", "a.cpp:2: \"Takes it away\""),
    ("src/hub/a.cpp", "void f(int a) {\n" + "    g();\n" * 60 + "}\n", "a function of 62 lines"),
    ("src/hub/a.cpp", "own.reset(new Hub(options,\n    TRY(name_of(file))));\n", "a.cpp:1: TRY among the arguments of new"),
    ("src/hub/a.cpp", "return Way{.from = from, .rest = {},\n    .to = TRY(place_of(text))};\n", "or in braces, leaks"),
    ("src/hub/a.cpp", "asked.push_back({name, TRY(place_of(name))});\n", "or in braces, leaks"),
    ("src/hub/a.cpp", '#include "hub.hpp"\n', "write the whole path"),
]


def check_self():
    failed = 0
    for path, text, sentence in EXAMPLES:
        found = Checker(path, text).run()
        if not any(sentence in breach for breach in found):
            print(f"the rule for «{sentence}» no longer catches its example; found {found}")
            failed += 1
    missed = list(missing_paths("`hub/hub.hpp`, `hub.hpp`, `src/<any>/`, `hub/hub.cpp`", ["/src/hub/", "/src/hub/hub.hpp"]))
    if missed != [(1, "hub/hub.cpp")]:
        print(f"the rule for paths of the map no longer catches its example; found {missed}")
        failed += 1
    allowed = Checker("src/hub/a.cpp", '#include "wire/frame.hpp"\n#include <vector>\n').run()
    if allowed:
        print(f"what is allowed was refused: {allowed}")
        failed += 1
    return failed


def main():
    if sys.argv[1:] == ["--self"]:
        return 1 if check_self() else 0
    breaches = check_tree(ROOT)
    for breach in breaches:
        print(breach)
    return 1 if breaches else 0


if __name__ == "__main__":
    sys.exit(main())
