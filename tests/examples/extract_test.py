#!/usr/bin/env python3
"""What extract.py makes of small headers, and what it refuses; the compiler is the real one."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent

LAMP = """// A lamp.
//
//     Lamp lamp;
//     lamp.toggle();
#pragma once

namespace vagus::light {
struct Lamp {
    void toggle();
};
}  // namespace vagus::light
"""


class Extract(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name in ("src/light", "contexts"):
            (self.folder / name).mkdir(parents=True)

    def write(self, header, context):
        (self.folder / "src/light/lamp.hpp").write_text(header)
        (self.folder / "contexts/light.context").write_text(context)

    def extract(self):
        done = subprocess.run([sys.executable, HERE / "extract.py", "--source", self.folder / "src",
                               "--contexts", self.folder / "contexts", "--out", self.folder / "out"],
                              capture_output=True, text=True)
        return done.returncode, done.stderr

    # What the compiler says of the source file that was made; empty: nothing.
    def compile(self):
        self.assertEqual(self.extract(), (0, ""))
        done = subprocess.run([os.environ.get("CXX", "c++"), "-std=c++20", "-w", "-fsyntax-only", f"-I{self.folder / 'src'}",
                               f"-I{HERE}", self.folder / "out/light.cpp"], capture_output=True, text=True)
        self.assertEqual(done.returncode == 0, done.stderr == "", done.stderr)
        return done.stderr

    def test_an_example_that_matches_compiles(self):
        self.write(LAMP, "for light\n\n[light/lamp.hpp]\n")
        self.assertEqual(self.compile(), "")

    def test_a_name_that_drifted_is_an_error_at_its_line_of_the_header(self):
        self.write(LAMP.replace("    void toggle", "    void turn_on"), "for light\n\n[light/lamp.hpp]\n")
        self.assertRegex(self.compile(), r"src/light/lamp\.hpp:4:\d+: error: .*toggle")

    def test_an_example_without_a_context_is_refused_by_name(self):
        self.write(LAMP, "for light\n")
        status, said = self.extract()
        self.assertEqual(status, 1)
        self.assertIn("src/light/lamp.hpp:3: this example is not compiled: write [light/lamp.hpp] into", said)
        self.assertIn("light.context", said)

    def test_each_example_of_a_header_needs_its_own(self):
        self.write(LAMP.replace("#pragma once", "//\n// Or:\n//\n//     Lamp().toggle();\n#pragma once"),
                   "for light\n\n[light/lamp.hpp]\n")
        self.assertIn("src/light/lamp.hpp:8: this example is not compiled: write [light/lamp.hpp 2] into", self.extract()[1])

    def test_a_context_without_an_example_is_refused(self):
        self.write(LAMP, "for light\n\n[light/lamp.hpp]\n\n[light/candle.hpp]\n")
        self.assertIn("light.context:5: src/light/candle.hpp has no example 1: delete this section", self.extract()[1])

    def test_an_unknown_mark_is_refused(self):
        self.write(LAMP, "for light\n\n[light/lamp.hpp] not C\n")
        self.assertIn("light.context:3: [light/lamp.hpp] not C: a mark is one of", self.extract()[1])

    def test_what_is_not_cpp_is_not_compiled(self):
        self.write(LAMP.replace("lamp.toggle();", '{ "lamp": on }'), "for light\n\n[light/lamp.hpp] not C++\n")
        self.assertEqual(self.compile(), "")

    def test_parameters_declarations_and_a_result_come_from_the_context(self):
        self.write(LAMP.replace("//     Lamp lamp;", "//     if (!lamp_of(number)) return 3;").replace("lamp.", "lamp_of(number)->"),
                   "for light\n\n[light/lamp.hpp]\nLamp* lamp_of(int number);\n(int number) -> int\n")
        self.assertEqual(self.compile(), "")

    def test_three_dots_are_a_value_or_nothing(self):
        self.write(LAMP.replace("lamp.toggle();", 'const int n = …, m[] = {1, …}; if (n) … // "…" and …'),
                   "for light\n\n[light/lamp.hpp]\n")
        self.assertEqual(self.compile(), "")

    def test_an_example_for_users_stands_in_no_namespace(self):
        header = LAMP.replace("//     Lamp lamp;", "//     #include <vector>\n//     void f(std::vector<vagus::light::Lamp>& all) {")
        self.write(header.replace("//     lamp.toggle();", "//         all[0].toggle();\n//     }"),
                   "for light\n\n[light/lamp.hpp] declarations global\n")
        self.assertEqual(self.compile(), "")


if __name__ == "__main__":
    unittest.main()
