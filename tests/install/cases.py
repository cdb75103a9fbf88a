"""The installed package, as those meet it who have nothing else: the example and a generated program build and run."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BUILD = pathlib.Path(os.environ.get("VAGUS_BUILD", ROOT / "build/release"))
FLAGS = "-O0 -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror " + os.environ.get("VAGUS_FLAGS", "")

# Every name is one that C++, CMake or the generated code keeps for itself.
AWKWARD = {
    "format": "vagus-plan/1",
    "name": "test",
    "help": "Line one.\n\"Line\" two \\ with a ?\u00e9 " + "and a long way to go " * 8,
    "configuration": {
        "int": {"type": "int", "initial": -9223372036854775808, "help": "the lowest \\"},
        "float": {"type": "float", "initial": -0.0},
        "EOF": {"type": "string", "initial": "a\u0000b\n\u00e9"},
        "arg1": {"type": "int", "initial": 0},
        "arg0": {"type": "bool", "initial": True},
    },
    "start": {
        "actor": "while",
        "supervisors": {"core": {"template": "Timeout", "in": {"seconds": 0.25}, "events": {"Timeout": "class"}}},
    },
    "actors": {
        "while": {"template": "Assign", "in": {"value": -9223372036854775808}, "out": {"result": "int"},
                  "states": {"Done": "plan"}},
        "plan": {"template": "Log", "in": {"text": "EOF & '\"\\' & float"}, "states": {"Done": "stdout"}},
        "default": {"template": "Send", "in": {"event": "'e'", "args": "'5 6'"}, "states": {"Sent": "__x"}},
        "stdout": {"template": "Send", "in": {"event": "'e'", "args": "'5 6'"}, "states": {"Sent": "__x"},
                   "supervisors": {"while": {"template": "OnEvent", "in": {"event": "'e'"},
                                             "out": {"arg1": "arg1", "arg0": "arg0"},
                                             "events": {"Received": "default"}}}},
        "__x": {"template": "Receive", "in": {"event": "'never'"}, "out": {"arg1": "arg1", "arg0": "arg0"},
                "states": {"Received": "_X"}},
        "_X": {"plan": "test.plan.json", "states": {"OK": "@terminate", "Interrupted": "Wait", "Error": "Wait"}},
        "Wait": {"template": "Wait", "in": {"seconds": 0}, "states": {"Done": "make_test"}},
        "make_test": {"template": "Log", "in": {"text": True}, "states": {"Done": "@terminate"}},
        "class": {"template": "WaitForever",
                  "supervisors": {"_": {"template": "Every", "period_ms": 7, "in": {"seconds": "0.02"},
                                        "out": {"count": "arg1"}, "events": {"Tick": "make_test"}}}},
    },
}


def run(*words, **options):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=300, **options)
    return done.returncode, done.stdout, done.stderr


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="vagus-install-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.prefix = cls.folder / "prefix"
        code, out, err = run("cmake", "--install", BUILD, "--prefix", cls.prefix)
        assert code == 0, out + err
        cls.vagus = cls.prefix / "bin" / "vagus"

    def build(self, source):
        """Builds a folder with nothing of this checkout but what was installed; gives the build folder."""
        build = self.folder / (source.name + "-build")
        code, out, err = run("cmake", "-S", source, "-B", build, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={self.prefix}",
                             f"-DCMAKE_CXX_FLAGS={FLAGS}")
        self.assertEqual(code, 0, out + err)
        code, out, err = run("cmake", "--build", build, "-j", "2")
        self.assertEqual(code, 0, out + err)
        return build

    def test_the_example_builds_and_runs(self):
        source = self.folder / "embed"
        shutil.copytree(ROOT / "examples/embed", source)
        code, out, err = run(self.build(source) / "greet", source / "Greet.plan.json")
        self.assertEqual((code, out, err), (
            0, "called: it greeted 2 times\nHello number 1\nHello number 2\nrun: Interrupted\n", ""))

    def test_a_generated_program_is_the_plan(self):
        plan = self.folder / "test.plan.json"
        plan.write_text(json.dumps(AWKWARD))
        source = self.folder / "generated"
        code, out, err = run(self.vagus, "plan", "generate", plan, "-o", source)
        self.assertEqual((code, out), (0, ""), err)
        program = next(path for path in self.build(source).iterdir() if path.name.startswith("test"))
        for options in [["--clock", "virtual"], ["--clock=virtual", "--max-time", "0.1", "--seed", "7"],
                        ["--clock", "virtual", "--set", "float=2.5", "--set=EOF=x", "--max-time=2"]]:
            mine = run(program, *options, "--trace", "-")
            theirs = run(self.vagus, "plan", "run", plan, *options, "--trace", "-")
            self.assertEqual(mine[:2], theirs[:2])
            self.assertIn("plan-start", mine[1])
        for wrong in [["--clock", "slow"], ["--seed", "-1"], ["--set", "no=1"], ["--max-time", "0"], ["--trace"],
                      ["--what"]]:
            self.assertEqual(run(program, *wrong)[0], 2, wrong)
        code, out, err = run(program, "--help")
        self.assertEqual((code, err.count("error")), (0, 0))
        self.assertIn("--max-time SECONDS", out)

    def test_generating_again_keeps_what_a_person_changed(self):
        plan = ROOT / "examples/embed/Greet.plan.json"
        out = self.folder / "again"
        generate = [self.vagus, "plan", "generate", plan, "-o", out]
        self.assertEqual(run(*generate)[0], 0)
        self.assertEqual(run(*generate)[0], 0)
        code = out / "Greet.cpp"
        generated = code.read_text()
        code.write_text(generated + "// mine\n")
        (out / "notes.txt").write_text("of a person\n")
        status, _, err = run(*generate)
        self.assertEqual(status, 1)
        self.assertIn(f"{code}", err)
        self.assertIn("--force", err)
        self.assertTrue(code.read_text().endswith("// mine\n"))
        self.assertEqual(run(*generate, "--force")[0], 0)
        self.assertEqual(code.read_text(), generated)
        self.assertEqual((out / "notes.txt").read_text(), "of a person\n")

    def test_a_renamed_plan_takes_its_old_files_away(self):
        plan = self.folder / "renamed.plan.json"
        text = (ROOT / "examples/embed/Greet.plan.json").read_text()
        out = self.folder / "renamed"
        plan.write_text(text)
        self.assertEqual(run(self.vagus, "plan", "generate", plan, "-o", out)[0], 0)
        (out / "Greet.hpp").write_text("// mine\n")
        plan.write_text(text.replace('"Greet"', '"Salute"'))
        self.assertEqual(run(self.vagus, "plan", "generate", plan, "-o", out)[0], 0)
        self.assertEqual(sorted(path.name for path in out.iterdir()),
                         [".vagus-generated.json", "CMakeLists.txt", "Greet.hpp", "Salute.cpp", "Salute.hpp",
                          "main.cpp"])

    def test_a_folder_of_somebody_else_is_left_alone(self):
        plan = ROOT / "examples/embed/Greet.plan.json"
        out = self.folder / "theirs"
        out.mkdir()
        (out / "main.cpp").write_text("int main() {}\n")
        status, _, err = run(self.vagus, "plan", "generate", plan, "-o", out, "--force")
        self.assertEqual(status, 2)
        self.assertIn("holds other files", err)
        self.assertEqual([path.name for path in out.iterdir()], ["main.cpp"])
        (out / ".vagus-generated.json").write_text("{ not json")
        self.assertEqual(run(self.vagus, "plan", "generate", plan, "-o", out)[0], 2)
        self.assertEqual(run(self.vagus, "plan", "generate", plan, "-o", out / "main.cpp")[0], 2)
        self.assertEqual((out / "main.cpp").read_text(), "int main() {}\n")

    def test_a_plan_with_errors_generates_nothing(self):
        plan = self.folder / "wrong.plan.json"
        plan.write_text('{ "format": "vagus-plan/1", "name": "Wrong", "actors": {} }')
        out = self.folder / "nothing"
        status, _, err = run(self.vagus, "plan", "generate", plan, "-o", out)
        self.assertEqual(status, 2)
        self.assertIn("[P15]", err)
        self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[1:]])
