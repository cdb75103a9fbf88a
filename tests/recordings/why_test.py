"""Asks the questions of why_questions.py of runs of the samples: each chain, link by link, with the lines that it names."""
import json
import pathlib
import re
import signal
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import run_vagus, vagus
from why_questions import QUESTIONS, RUNS

EXAMPLES = pathlib.Path(__file__).resolve().parent.parent.parent / "examples"
HERE = pathlib.Path(__file__).resolve().parent
# What the last link of a chain says, by the kind of its root.
ROOTS = {
    "beginning": r"^the plan \S+ began$|its initial value$|^no script has |^the script of \S+ began$",
    "contact": r" touched \"",
    "person": r"^a person |^a host set |^somebody ended the run$",
    "sensor": r" felt |itself sets ",
    "time": r"^the time of the run was over$",
    "timeline": r"^the timeline of the world ",
    "timer": r"^a timer of | raised Timeout",
}
# What the line of a link holds, by its sentence.
LINES = [
    (r"the script of \S+ called (\S+)$", "call {}("),
    (r"the script of \S+ emitted (\S+)$", "emit {}"),
    (r"the script of \S+ wrote (\S+)$", "{}"),
    (r"\S+ (?:heard|felt) (\S+)$", "onevent"),
    (r"a timer of \S+ ran out: (\S+)$", "onevent"),
    (r"the (?:plan|actor \S+) gave the variable (\S+) ", '"{}": {{'),
    (r"the (?:actor|supervisor) (\S+) ", '"{}": {{'),
    (r"(\S+) wrote the variable ", '"{}": {{'),
    (r"(\S+) failed$", '"{}": {{'),
    (r"the plan (\S+) (?:began|ended)", '"start": {{'),
    (r"the timeline of the world (put|pressed)", "{{"),
]


def placed(word):
    """A path of the samples, or of this folder, as one that can be opened."""
    for folder in (EXAMPLES, HERE):
        if "." in word and (folder / word).exists():
            return str(folder / word)
    return word


def questions_of(text):
    """(question, instant or None, kind of its root, links) of each block; a link is (sentence, value, file, line's text)."""
    for block in text.strip().split("\n\n"):
        head, *lines = block.splitlines()
        question, root = head.split(" -> ")
        question, _, at = question.partition(" @ ")
        links = []
        for line in lines:
            said, _, place = line.strip().partition(" @ ")
            sentence, _, value = said.partition(" = ")
            file, _, there = place.partition(" | ")
            links.append((sentence, value, file, there))
        yield question.split(), float(at) if at else None, root, links


class WhyQuestions(unittest.TestCase):
    def record(self, name):
        """One run for all questions about it."""
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-why-")))
        self.file = folder / "run.mcap"
        words = [placed(word) for word in RUNS[name].split()]
        words += ["--clock", "virtual", "--quiet"] if words[0] == "plan" else ["--headless", "--speed", "max"]
        with vagus(*words, "--record", self.file) as program:
            self.assertIn(program.wait_end(), (0, 3, 4, 5), program.lines)

    def chain(self, question, at):
        return json.loads(run_vagus("why", self.file, *question, "--json", "--all", *(["--at", at] if at is not None else [])))

    def file_of(self, name):
        found = [one for folder in (EXAMPLES, HERE / "plans") for one in folder.rglob(pathlib.Path(name).name)
                 if str(one).endswith(name)]
        self.assertEqual(len(found), 1, name)
        return found[0]

    def line_at(self, place):
        """(name of the file, its line) at "follow-wall/WallFollow.plan.json:61"."""
        path, line = place.rsplit(":", 1)
        file = self.file_of(path)
        return file.name, file.read_text().splitlines()[int(line) - 1].strip()

    def check_link(self, link, expected):
        sentence, value, file, there = expected
        self.assertEqual(link["what"], sentence)
        if value:
            self.assertEqual(link["value"], value)
        if file:
            self.assertEqual(self.line_at(link["place"]), (file, there))
        else:
            self.assertEqual(link["place"], "")

    def check_line(self, link):
        """Whatever the chain: the line that a link names holds what the link says."""
        if not link["place"]:
            self.assertNotRegex(link["what"], r"emitted|called|heard| felt |^the actor |^the supervisor |^the plan |^the timeline ")
            return
        path, line = link["place"].rsplit(":", 1)
        lines, at = self.file_of(path).read_text().splitlines(), int(line) - 1
        for pattern, text in LINES:
            found = re.match(pattern, link["what"])
            if not found:
                continue
            if text == "onevent":  # the handler around it
                at = max(i for i in range(at + 1) if lines[i].strip().startswith("onevent"))
                self.assertEqual(lines[at].split("#")[0].split()[-1], found[1], link)
            else:
                self.assertIn(text.format(found[1].split("[")[0]), lines[at], link)
            return
        self.fail(f"a sentence that is not in LINES: {link}")

    def check_chain(self, chain, root, links):
        self.assertEqual([link["root"] for link in chain], [False] * (len(chain) - 1) + [True])
        self.assertEqual(sorted((link["t"] for link in chain), reverse=True), [link["t"] for link in chain])
        self.assertRegex(chain[-1]["what"], ROOTS[root])
        for link in chain:
            self.check_line(link)
        cut = next((i for i, link in enumerate(links) if link[0] == "..."), None)
        first, last = (links, []) if cut is None else (links[:cut], links[cut + 1:])
        if cut is None:
            self.assertEqual([link["what"] for link in chain], [sentence for sentence, *_ in links])
        for link, expected in zip(chain, first, strict=cut is None):
            self.check_link(link, expected)
        for link, expected in zip(chain[::-1], last[::-1]):
            self.check_link(link, expected)

    def asks(self, name):
        self.record(name)
        for question, at, root, links in questions_of(QUESTIONS[name]):
            with self.subTest(run=name, question=" ".join(question), at=at):
                self.check_chain(self.chain(question, at), root, links)

    def test_there_are_enough(self):
        """Of each kind of root, and with losers."""
        self.assertEqual(set(RUNS), set(QUESTIONS))
        asked = [one for text in QUESTIONS.values() for one in questions_of(text)]
        self.assertGreaterEqual(len(asked), 40)
        self.assertEqual({root for _, _, root, _ in asked}, set(ROOTS))
        self.assertTrue(any("won against" in sentence for *_, links in asked for sentence, *_ in links))

    def test_wall(self):
        self.asks("wall")

    def test_wall_cut(self):
        self.asks("wall-cut")

    def test_light(self):
        self.asks("light")

    def test_rooms(self):
        self.asks("rooms")

    def test_obstacle(self):
        self.asks("obstacle")

    def test_square(self):
        self.asks("square")

    def test_explore(self):
        self.asks("explore")

    def test_colours(self):
        self.asks("colours")

    def test_ties(self):
        self.asks("ties")

    def test_inner(self):
        self.asks("inner")

    def test_touches(self):
        self.asks("touches")

    def test_a_host(self):
        """Of a node that it has stopped; what the script wrote before is over."""
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-why-")))
        self.file = folder / "run.mcap"
        with vagus("sim", EXAMPLES / "thymio/arena.world.json", "--load", EXAMPLES / "thymio/explore.aesl", "--headless",
                   "--listen", "tcp:127.0.0.1:0", "--duration", 600, "--record", self.file) as program:
            target = program.wait_line(r"listening (\S+)").group(1)
            run_vagus("net", target, "stop", "thymio-II")
            run_vagus("net", target, "set", "--leave", "thymio-II", "motor.right.target", 70)
            program.signal(signal.SIGINT)
            program.wait_end()
        for question in (["motor", "thymio"], ["variable", "thymio-II.motor.right.target"]):
            chain = self.chain(question, None)
            self.check_chain(chain, "person", [("a host set motor.right.target of thymio-II", "70", "", "")])
        self.assertEqual(self.chain(["variable", "thymio-II.running"], None)[0]["what"], "the script of thymio-II wrote running")

    def test_a_person_on_another_way(self):
        self.record("wall-cut")
        other = self.file.parent / "other.mcap"
        run_vagus("replay", self.file, "--from", 2, "--set", "walldist=45", "--record", other)
        self.file = other
        chain = self.chain(["variable", "walldist"], None)
        self.check_chain(chain, "person", [("a person gave the variable walldist its value", "45", "", "")])
        self.assertEqual(chain[0]["t"], 2.001)

    def test_an_element_that_is_not_there(self):
        self.record("obstacle")
        for name, sentence in (("thymio-II.way[2]", "way of thymio-II has 2 elements, from 0 on; found way[2]"),
                               ("thymio-II.wy[0]", "did you mean way?")):
            self.assertIn(sentence, run_vagus("why", self.file, "variable", name, status=1))

    def test_losers_in_json(self):
        self.record("ties")
        tie = self.chain(["actor", "first"], 2.5)[1]
        self.assertEqual([(one.get("supervisor"), one.get("event"), one.get("actor"), one.get("state")) for one in tie["lost"]],
                         [("bell", "Timeout", None, None), (None, None, "first", "Done")])
        for loser in tie["lost"]:
            self.assertRegex(self.line_at(loser["place"])[1], rf'^"{loser.get("supervisor") or loser["actor"]}": {{')
        self.assertNotIn("lost", self.chain(["actor", "second"], 5.5)[1])


if __name__ == "__main__":
    unittest.main()
