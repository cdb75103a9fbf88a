#!/usr/bin/env python3
"""The examples in the comments of the headers as source files, so that the compiler says which of them no longer match
their API. Nothing of it is linked or run.

    extract.py --source CHECKOUT/src --contexts CHECKOUT/tests/examples --out FOLDER

An example is a run of comment lines `//     code`, five spaces in front of it. What it takes for granted stands in a
context file, NAME.context, which becomes one source file, NAME.cpp. It begins with the folders of src/ that it is for:

    for base isa serve/web

then has a section for each example, headed by the path of the header, and a number from the second one of a header on:

    [net/client.hpp]
    #include "base/file.hpp"                          for the top of the source file
    extern const wire::Frame list_nodes;              declarations, in front of the function
    (const Target& target) -> Status                  its parameters, and what it returns if that is not void

    [wire/frame.hpp 2]
    [vm/vm.hpp 2] declarations                        the example is no statements: no function around it
    [embed/plan_code.hpp] declarations global         … and in no namespace, as users write it
    [wire/frame.hpp] not C++                          JSON, a grammar, output: not compiled

Common names (show, send, …) are in prelude.hpp. `…` is a value of any type where a value is expected (behind `=`, `(`,
`,` or `return`), else no statement at all."""
import argparse
import pathlib
import re
import sys

LINE = re.compile(r"\s*//     (.*)")
BLANK = re.compile(r"\s*//\s*")
TITLE = re.compile(r"\[([^\] ]+)(?: (\d+))?\]\s*(.*)")
MARKS = {"", "not C++", "declarations", "declarations global"}
# A comment, a text, a raw text, or the three dots.
WORDS = re.compile(r'//.*|R"\((?:.|\n)*?\)"|"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'|…')


class Wrong(Exception):
    pass


class Example:
    def __init__(self, header, number, line):
        self.header, self.number, self.line = header, number, line
        self.lines = []

    def key(self):
        return (self.header, self.number)

    def title(self):
        return f"[{self.header}]" if self.number == 1 else f"[{self.header} {self.number}]"

    def name(self):
        return "example_" + re.sub(r"\W", "_", self.header) + (f"_{self.number}" if self.number > 1 else "")


class Section:
    def __init__(self, context, line, mark):
        self.context, self.line, self.mark = context, line, mark
        self.includes, self.declarations, self.parameters = [], [], []

    def take(self, line):
        if line.startswith("#include"):
            self.includes.append(line)
        elif self.parameters or line.startswith("("):
            self.parameters.append(line)
        else:
            self.declarations.append(line)

    # "(int a)" and "void"
    def signature(self):
        text = " ".join(self.parameters) or "()"
        parameters, arrow, result = text.rpartition(" -> ")
        return (parameters, result) if arrow else (text, "void")


def examples_of(header, text):
    found, current, blank = [], None, []
    for number, line in enumerate(text.splitlines(), 1):
        match = LINE.fullmatch(line)
        if match:
            if current is None:
                current = Example(header, len(found) + 1, number)
                found.append(current)
            current.lines += blank + [match[1]]
            blank = []
        elif current is not None and BLANK.fullmatch(line):
            blank.append("")
        else:
            current, blank = None, []
    return found


# The header's namespace: that of its module, if it opens it; in C++14 that stands inside of `vagus`.
def namespace_of(header, text):
    opened = set(re.findall(r"^namespace ([\w:]+) \{", text, re.MULTILINE))
    module = header.split("/")[0]
    of_module = f"vagus::{module}"
    if of_module in opened or {"vagus", module} <= opened:
        return of_module
    return min((name for name in opened if name.startswith("vagus")), default="vagus")


def without_dots(code):
    def replaced(match):
        if match[0] != "…":
            return match[0]
        before = code[:match.start()].rstrip()
        return "Any{}" if re.search(r"(=|\(|,|\breturn)$", before) else ";"
    return WORDS.sub(replaced, code)


def read_contexts(folder):
    sections, folders = {}, {}
    for path in sorted(folder.glob("*.context")):
        section = None
        for number, line in enumerate(path.read_text().splitlines(), 1):
            title = TITLE.fullmatch(line)
            if number == 1 and line.startswith("for "):
                folders.update({name: path.stem for name in line.split()[1:]})
            elif title:
                key = (title[1], int(title[2] or 1))
                if title[3] not in MARKS or key in sections:
                    raise Wrong(f"{path}:{number}: {line}: a mark is one of {sorted(MARKS - {''})}, a header stands here once")
                section = sections[key] = Section(path.stem, number, title[3])
            elif line and section:
                section.take(line)
            elif line:
                raise Wrong(f"{path}:{number}: expected [HEADER] first, found: {line}")
    return sections, folders


def context_for(header, folders):
    fitting = [name for name in folders if header.startswith(name + "/")]
    return folders[max(fitting, key=len)] if fitting else None


def check(examples, sections, folders, contexts):
    known = {example.key() for example in examples}
    for example in examples:
        if example.key() not in sections:
            name = context_for(example.header, folders)
            place = contexts / f"{name}.context" if name else f"a file of {contexts}, and its folder in the line `for` there"
            raise Wrong(f"src/{example.header}:{example.line}: this example is not compiled: write {example.title()} into "
                        f"{place}, and below it what the example takes for granted, or `not C++` behind it")
    for (header, number), section in sections.items():
        if (header, number) not in known:
            raise Wrong(f"{contexts / section.context}.context:{section.line}: src/{header} has no example {number}: "
                        f"delete this section")


def wrapped(example, section, namespace):
    out, body = [], []
    for line in without_dots("\n".join(example.lines)).split("\n"):
        include = line.startswith("#include")
        if include:
            section.includes.append(re.sub(r"<vagus/(.*)>", r'"\1"', line))
        body.append("" if include else line)
    name = example.name()
    is_global = section.mark.endswith("global")
    if not is_global:
        out.append(f"namespace {namespace}::{name} {{")
    out.append("using namespace ::vagus::examples;")
    out.append(f'#line {section.line + 1} "tests/examples/{section.context}.context"')
    out += section.declarations
    parameters, result = section.signature()
    function = not section.mark.startswith("declarations")
    if function:
        out.append(f"{result} {name}{parameters} {{")
    out.append(f'#line {example.line} "src/{example.header}"')
    out += body
    return out + ["}"] * (function + (not is_global)) + [""]


def source_file(examples, sections, namespaces):
    parts, includes = [], []
    for example in examples:
        section = sections[example.key()]
        parts += wrapped(example, section, namespaces[example.header])
        includes += [f'#include "{example.header}"'] + section.includes
    top = ["// Made by tests/examples/extract.py from the comments of the headers.", '#include "prelude.hpp"']
    return "\n".join(top + list(dict.fromkeys(includes)) + [""] + parts)


def make(source, contexts):
    sections, folders = read_contexts(contexts)
    examples, namespaces = [], {}
    for path in sorted(source.rglob("*.hpp")):
        header = path.relative_to(source).as_posix()
        text = path.read_text()
        examples += examples_of(header, text)
        namespaces[header] = namespace_of(header, text)
    check(examples, sections, folders, contexts)
    files = {name: [] for name in folders.values()}
    for example in examples:
        section = sections[example.key()]
        if section.mark != "not C++":
            files[section.context].append(example)
    return {name: source_file(of, sections, namespaces) for name, of in files.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--source", type=pathlib.Path, required=True)
    parser.add_argument("--contexts", type=pathlib.Path, required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    options = parser.parse_args()
    try:
        files = make(options.source, options.contexts)
    except Wrong as wrong:
        sys.exit(f"extract.py: {wrong}")
    options.out.mkdir(parents=True, exist_ok=True)
    for name, text in files.items():
        path = options.out / f"{name}.cpp"
        if not path.exists() or path.read_text() != text:
            path.write_text(text)


if __name__ == "__main__":
    main()
