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

    def test_a_trace_on_stdout_has_it_for_itself(self):
        """What else a generated program says is on stderr then, as with `vagus plan run`."""
        patterns = ROOT / "examples/patterns"
        source = self.folder / "traced"
        self.assertEqual(run(self.vagus, "plan", "generate", patterns / "Square.plan.json", "-o", source)[0], 0)
        program = next(path for path in self.build(source).iterdir() if path.name == "Square")
        options = ["--world", patterns / "carbot.world.json", "--listen", "tcp:127.0.0.1:0", "--max-time", "0.5"]
        place = r"(?m)^listening tcp:127\.0\.0\.1:\d+$"
        for trace in ("--trace", "--trace-all"):
            _, out, err = run(program, *options, trace, "-")
            self.assertRegex(err, place)
            self.assertIn("plan-start", [json.loads(line).get("kind") for line in out.splitlines()])
        _, out, err = run(program, *options)
        self.assertRegex(out, place)
        self.assertNotRegex(err, place)

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


    # ---- toolboxes as shared libraries ----

    def example_toolbox(self):
        if not hasattr(type(self), "countdown"):
            source = self.folder / "toolbox"
            shutil.copytree(ROOT / "examples/toolbox", source)
            type(self).launch = source / "Launch.plan.json"
            type(self).countdown = self.build(source) / "countdown.so"
        return self.launch, self.countdown

    def texts(self, trace):
        return [line["text"] for line in map(json.loads, trace.splitlines()) if line["kind"] == "log"]

    def test_the_toolbox_of_the_example_builds_and_runs(self):
        plan, library = self.example_toolbox()
        run_it = [self.vagus, "plan", "run", plan, "--clock", "virtual", "--trace", "-"]
        code, out, err = run(*run_it, "--toolbox", library)
        self.assertEqual((code, self.texts(out)), (0, ["3", "2", "1", "lift-off"]), err)
        code, out, err = run(*run_it, "--toolbox", library, "--set", "fuel=5")
        self.assertEqual((code, self.texts(out)), (0, ["no fuel"]), err)
        # Its code is stopped at a wait, by an exception that the program throws.
        code, out, err = run(*run_it, "--toolbox", library, "--max-time", "1.5")
        self.assertEqual((code, self.texts(out)), (5, ["3", "2"]), err)
        code, out, err = run(self.vagus, "plan", "run", plan, "--toolbox", library, "--trace", "-", "--max-time", "0.7")
        self.assertEqual((code, self.texts(out)), (5, ["3"]), err)

    def test_a_plan_whose_toolbox_is_not_given_says_so(self):
        plan, library = self.example_toolbox()
        code, _, err = run(self.vagus, "plan", "check", plan)
        self.assertEqual(code, 2)
        self.assertIn('there is no toolbox "countdown"', err)
        self.assertIn("--toolbox", err)
        self.assertEqual(run(self.vagus, "plan", "check", plan, "--toolbox", library), (0, "", ""))
        code, out, err = run(self.vagus, "toolbox", "show", "CountDown", "--toolbox", library)
        self.assertEqual((code, err), (0, ""))
        self.assertIn("CountDown  actor of countdown", out)
        self.assertIn("from  int  default 10  0 to 100  the first number", out)

    def test_what_is_wrong_with_a_shared_library_is_said(self):
        plan, library = self.example_toolbox()

        def refuse(toolboxes, sentence):
            options = [word for path in toolboxes for word in ("--toolbox", path)]
            code, out, err = run(self.vagus, "plan", "check", plan, *options)
            self.assertEqual((code, out), (2, ""), err)
            self.assertIn(str(toolboxes[-1]), err)
            self.assertIn(sentence, err)

        def built(name, code):
            source, made = self.folder / (name + ".cpp"), self.folder / (name + ".so")
            source.write_text(code)
            status, _, err = run("c++", "-std=c++20", "-shared", "-fPIC", f"-I{self.prefix}/include",
                                 f"-I{self.prefix}/include/vagus", source, "-o", made)
            self.assertEqual(status, 0, err)
            return made

        refuse([library, library], 'there is a toolbox named "countdown" already')
        refuse([self.folder / "none.so"], "it cannot be loaded as a shared library")
        text = self.folder / "text.so"
        text.write_text("no library\n")
        refuse([text], "it cannot be loaded as a shared library")
        refuse([plan], "expected a file NAME.toolbox.json or a shared library NAME.so")
        refuse([built("empty", "int nothing;")], "it has no function vagus_toolbox_version")
        version = """#include <toolbox/plugin.hpp>
            extern "C" void vagus_toolbox_version(vagus::toolbox::PluginVersion& v) { %s }
            extern "C" void vagus_toolbox_make(vagus::toolbox::Plugin& p, const vagus::toolbox::Parts&) { %s }"""
        refuse([built("old", version % ('v.version = "0.0.1";', ""))], "it was built for another Vagus (0.0.1")
        refuse([built("size", version % ("v.sizes[2] = 1;", ""))], "it was built for another Vagus")
        refuse([built("half", 'extern "C" void vagus_toolbox_version() {}')], "it has no function vagus_toolbox_make")
        make = "#include <toolbox/plugin.hpp>\n#include <stdexcept>\nusing namespace vagus;\n" \
               "static toolbox::Plugin make(const toolbox::Parts&) { %s }\nVAGUS_TOOLBOX(make)\n"
        refuse([built("throws", make % 'throw std::runtime_error("no lamp");')], "its code failed: no lamp")
        refuse([built("name", make % 'return {.name = "my box"};')], 'cannot be the name of a toolbox')
        refuse([built("core", make % 'return {.name = "core"};')], 'there is a toolbox named "core" already')
        refuse([built("code", make % 'return {.name = "n", .templates = {{{.name = "T"}, {}, {}}}};')],
               'the template "T" must have the code of an actor')
        refuse([built("twice", make % 'run::Coded one{{.name = "T"}, [] { return std::unique_ptr<run::Actor>(); }, {}};'
                                      'return {.name = "n", .templates = {one, one}};')],
               'a template named "T" twice')

    # ---- generated code with toolboxes ----

    def test_the_wall_following_plan_builds(self):
        source = self.folder / "wall"
        code, _, err = run(self.vagus, "plan", "generate", ROOT / "testdata/plans/WallFollow.plan.json", "-o", source)
        self.assertEqual((code, err), (0, ""))
        code, out, err = run(self.build(source) / "WallFollow", "--clock", "virtual")
        self.assertEqual((code, out), (2, ""))
        self.assertIn("the plan WallFollow needs a bus", err)

    def test_a_generated_program_drives_a_robot_as_its_plan_does(self):
        plan, source = ROOT / "examples/patterns/Square.plan.json", self.folder / "square"
        code, _, err = run(self.vagus, "plan", "generate", plan, "-o", source)
        self.assertEqual((code, err), (0, ""))
        program = self.build(source) / "Square"
        for robot in ["carbot", "thymio"]:
            world = ROOT / f"examples/patterns/{robot}.world.json"
            options = ["--clock", "virtual", "--world", world, "--trace-all", "-"]
            theirs = run(self.vagus, "plan", "run", plan, *options, "--quiet")
            self.assertEqual(run(program, *options), theirs)
            self.assertIn('"kind":"pose"', theirs[1])

    def test_a_generated_program_takes_toolboxes(self):
        plan, library = self.example_toolbox()
        source = self.folder / "launch"
        code, _, err = run(self.vagus, "plan", "generate", plan, "-o", source, "--toolbox", library)
        self.assertEqual((code, err), (0, ""))
        self.assertTrue((source / "countdown.hpp").exists())
        program = self.build(source) / "Launch"
        options = ["--clock", "virtual", "--trace", "-", "--toolbox", library]
        theirs = run(self.vagus, "plan", "run", plan, *options, "--quiet")
        self.assertEqual(run(program, *options), theirs)
        self.assertIn("lift-off", theirs[1])
        code, out, err = run(program)
        self.assertEqual((code, out), (2, ""))
        self.assertIn('there is no toolbox "countdown"', err)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[1:]])
