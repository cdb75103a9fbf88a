"""Several pages at one studio: who drives, who looks, what happens when a connection is lost, and when a page reads slowly."""
import json
import socket
import sys
import unittest

import projects
from cases import Case
from harness import vagus, listening, Bus
from page import BINARY, TEXT, Closed, Refused, Studio, frame, open_live


class People(Case):
    def refused_on(self, page, code, command, **fields):
        with self.assertRaises(Refused) as caught:
            page.do(command, **fields)
        self.assertEqual(caught.exception.code, code)
        return caught.exception.what

    def test_one_drives_the_other_looks_and_asks_for_the_wheel(self):
        first = self.open()
        second = self.enterContext(self.studio.page(name="another"))
        seen = second.watch("studio")
        self.assertTrue(first.greeting["driver"])
        self.assertEqual((second.greeting["driver"], second.greeting["role"]), (False, "drive"))
        self.assertIn("a test has control", self.refused_on(second, "not_driver", "run.start"))
        self.assertEqual(second.do("driver.ask"), {"driver": False})
        asked = first.wait(lambda: self.people.value.get("asked"), "the question")
        self.assertEqual((asked["client"], asked["name"]), (second.greeting["number"], "another"))
        first.do("driver.answer", give=False)
        second.wait(lambda: "asked" not in seen.value, "the answer")
        self.refused_on(second, "not_driver", "run.start")
        second.do("driver.ask")
        first.do("driver.answer", give=True)
        second.wait(lambda: seen.value["driver"] == second.greeting["number"], "control")
        second.do("run.start")
        self.refused_on(first, "not_driver", "run.pause")
        first.do("stop")
        second.do("driver.leave")
        self.assertEqual(first.do("driver.ask"), {"driver": True})

    def test_a_token_that_only_looks(self):
        look = self.enterContext(Studio())
        folder = projects.thymio(look.folder / "project")
        look.program.stop()
        look.program.__exit__()
        look.start(folder, "--look-token-file", look.folder / "look")
        token = (look.folder / "look").read_text(encoding="utf-8").strip()
        self.assertEqual((look.folder / "look").stat().st_mode & 0o777, 0o600)
        self.assertEqual((look.folder / "data" / "token").stat().st_mode & 0o777, 0o600)
        driver, looker = self.enterContext(look.page()), self.enterContext(look.page())
        looker.close()
        looker = self.enterContext(type(driver)(look.port, token))
        self.assertEqual(looker.greeting["role"], "look")
        for command, fields in (("run.start", {}), ("driver.ask", {}), ("doc.save_all", {}), ("event.send", {"name": "go", "args": [1]}),
                                ("folder.list", {"path": "/"}), ("project.open", {"path": "/"}), ("driver.leave", {})):
            self.refused_on(looker, "not_allowed", command, **fields)
        clock = looker.watch("clock")
        self.assertIn("var n", looker.do("doc.open", doc="robot.aesl#1")["text"])
        driver.do("run.start")
        looker.wait(lambda: clock.value["state"] == "running", "a run")
        self.assertEqual(looker.do("stop")["stood"], [1])

    def test_a_command_that_comes_twice_is_done_once(self):
        page = self.open()
        robots = page.watch("scene")
        self.wait_node(described=True)
        number = page.ask("world.put", kind="box", at=[1, 1], size=[0.1, 0.1])
        page.answer(number)
        page.ask("world.put", _id=number, kind="box", at=[1, 1], size=[0.1, 0.1])
        page.wait(lambda: page.answered.get(number) == 2, "two answers")
        there = page.answers[number]
        page.do("world.put", kind="box", at=[2, 2], size=[0.1, 0.1])
        page.wait(lambda: len(robots.value["objects"]) == 3, "two boxes more")
        # The same client comes back on another connection, and asks again.
        again = self.enterContext(self.studio.page(client=page.client, first_id=page.next_id))
        self.assertEqual(page.wait_closed(), "the same page has connected again")
        self.assertEqual(again.greeting["number"], page.greeting["number"])
        self.assertTrue(again.greeting["driver"])
        again.ask("world.put", _id=number, kind="box", at=[1, 1], size=[0.1, 0.1])
        again.wait(lambda: number in again.answers, "the answer of before")
        self.assertEqual(again.answers[number], there)
        seen = again.watch("scene")
        again.wait(lambda: seen.value, "the scene")
        self.assertEqual(len(seen.value["objects"]), 3)

    def test_an_answer_finds_its_page_after_a_lost_connection(self):
        page = self.open()
        page.do("run.start")
        number = page.ask("stop")
        page.close()
        again = self.enterContext(self.studio.page(client=page.client, first_id=number + 1))
        again.ask("stop", _id=number)
        self.assertEqual(again.answer(number)["stood"], [1])

    def test_ten_pages_see_the_same(self):
        page = self.open()
        pages = [page] + [self.enterContext(self.studio.page()) for _ in range(9)]
        seen = [[one.watch(topic) for topic in ("robot", "clock", "scene", "happenings")] + [one.watch("poses")] for one in pages[1:]]
        page.do("clock.speed", speed=10)
        page.do("run.start")
        self.wait_passed(5)
        page.do("stop")
        self.wait_clock("none")
        for one, (robot, clock, scene, happenings, poses) in zip(pages[1:], seen):
            one.wait(lambda: clock.value["state"] == "none" and robot.value["nodes"][0]["state"] == "stopped", "the end")
            self.assertEqual(scene.value, self.scene.value)
            self.assertTrue(poses.frames)
            self.assertTrue(happenings.items)
            self.assertEqual(happenings.left_out, 0)

    def test_a_page_that_does_not_read_harms_nobody(self):
        page = self.open()
        page.do("clock.speed", speed=5)
        page.do("run.start")
        with open_live(self.studio.port, small_window=True) as deaf:
            say = lambda number, command, **fields: deaf.send(frame(TEXT, json.dumps({"id": number, "do": command, "in": fields}).encode()))
            say(1, "hello", token=self.studio.token, client="deaf")
            self.wait(lambda: self.people.value["clients"] == 2, "another page")
            # The same many times over: soon more than the system's own buffers hold.
            for number, topic in enumerate(["happenings"] * 60 + ["robot", "clock", "poses"], start=2):
                say(number, "watch", watch=number, topic=topic, rate=60)
            # Others hear everything meanwhile, and get answers.
            for _ in range(3):
                self.wait_passed(1)
                page.do("state.put", key="one", value=1)
            self.assertEqual(self.happenings.left_out, 0)
            # What waits for it is bounded: it is sent away, unread or not; what it then reads is in order.
            self.wait(lambda: self.people.value["clients"] == 1, "the end of the one that does not read")
            frames = deaf.read_to_end()
        streams = [json.loads(payload) for kind, payload in frames if kind == TEXT]
        numbers = [item["number"] for message in streams if message.get("watch") == 2 for item in message["items"]]
        self.assertEqual(numbers, sorted(set(numbers)))
        self.assertLess(sum(len(payload) for _, payload in frames), 16 << 20)
        page.do("stop")
        self.assertLess(len(numbers), len(self.happenings.items))

    def test_a_page_that_only_asks_and_never_reads_is_sent_away(self):
        page = self.open()
        page.edit("robot.aesl#1", (0, 0, "# " + "x" * 200000 + "\n"))
        before = self.studio.memory()
        with open_live(self.studio.port, small_window=True) as deaf:
            deaf.send(frame(TEXT, json.dumps({"id": 1, "do": "hello", "in": {"token": self.studio.token, "client": "deaf"}}).encode()))
            self.wait(lambda: self.people.value["clients"] == 2, "another page")
            try:
                for number in range(2, 1000):
                    deaf.send(frame(TEXT, json.dumps({"id": number, "do": "doc.open", "in": {"doc": "robot.aesl#1"}}).encode()))
            except OSError:
                pass
            self.wait(lambda: self.people.value["clients"] == 1, "the end of the one that does not read")
            self.assertLess(self.studio.memory() - before, 64 << 20)
        page.do("stop")

    def test_a_flood_of_events_while_pages_are_open(self):
        switch = self.enterContext(vagus("switch", "--listen", "tcp:127.0.0.1:0"))
        port = listening(switch)
        self.enterContext(vagus("node", "--id", 1, "--name", "rover", "--connect", f"tcp:127.0.0.1:{port}")) 
        script = "var n = 0\nonevent go\n\tn += 1\n"
        page = self.open(lambda folder: projects.bus(folder, f"tcp:127.0.0.1:{port}", script=script))
        others = [self.enterContext(self.studio.page()) for _ in range(3)]
        seen = [other.watch("happenings", kinds=["event"]) for other in others]
        self.wait_node(described=True)
        self.assertEqual(page.do("node.load", node=0)["loaded"], [1])
        with Bus(port) as bus:
            for i in range(10000):
                bus.send(40, 0, i)
        with Bus(port) as bus:
            bus.send(41, 0, 4711)
            for other, happenings in zip(others, seen):
                other.wait(lambda: [item for item in happenings.items if item["args"] == [4711] and item["node"] == 41], "the last event")
                numbers = [item["number"] for item in happenings.items]
                self.assertEqual(numbers, sorted(set(numbers)))
        page.do("node.pause", node=1)
        self.wait(lambda: self.node()["state"] != "running", "a node that stands")
        self.assertEqual(page.do("stop")["stood"], [1])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:] or ["People"])], verbosity=2, warnings="ignore")
