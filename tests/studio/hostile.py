"""Who wishes the studio ill, or is broken: other pages of the same browser, guesses, floods, nonsense. Each is refused with a
sentence, the refusal is logged, and everybody else is served on."""
import json
import os
import random
import socket
import struct
import sys
import unittest

import projects
from cases import Case
from page import BINARY, CLOSE, TEXT, Closed, Page, Refused, Wire, ask_for_live, frame, http, open_live
from protocol import COMMANDS, LIMITS, invented_fields

LEAVES_THE_PROJECT = ["../secret", "/etc/passwd", "a/../../secret", "outside", "outside/passwd", "./../secret", "..", "a\\..\\..\\secret",
                      "secret\u0000.aesl"]


class Hostile(Case):
    def setUp(self):
        self.open()
        (self.studio.folder / "secret").write_text("secret", encoding="utf-8")
        os.symlink("/etc", self.folder / "outside")

    def still_serves(self):
        self.assertEqual(http(self.studio.port, "/healthz")[0::2], (200, "ok\n"))
        self.page.do("state.put", key="still", value="there")
        with self.studio.page() as another:
            another.watch("clock")

    def logged(self, part):
        """The line of the log; it may take a moment."""
        self.studio.program.wait_line(part)

    # HTTP ----------------------------------------------------------------------------------------

    def test_only_this_host_and_this_origin(self):
        port = self.studio.port
        for host in ("evil.example", f"evil.example:{port}", "127.0.0.1", f"127.0.0.2:{port}", "", f"localhost.evil.example:{port}"):
            status, _, body = http(port, headers={"Host": host})
            self.assertEqual(status, 403, host)
            self.assertIn("is not this server", body)
        for origin in ("http://evil.example", "null", f"https://127.0.0.1:{port}", "http://127.0.0.1:1"):
            status, _, body = http(port, headers={"Origin": origin})
            self.assertEqual((status, "is another page" in body), (403, True), origin)
            with Wire(port) as wire:
                wire.send(ask_for_live(port, {"Origin": origin}))
                self.assertEqual(wire.read_answer()[0], 403)
        self.logged("refused: Origin")
        self.assertEqual(http(port, headers={"Host": f"localhost:{port}"})[0], 200)
        self.still_serves()

    def test_pages_and_nothing_else(self):
        port = self.studio.port
        status, headers, body = http(port)
        self.assertEqual((status, body), (200, "<!doctype html><title>pages</title>"))
        self.assertIn("default-src 'none'", headers["content-security-policy"])
        self.assertIn("frame-ancestors 'none'", headers["content-security-policy"])
        self.assertEqual(headers["x-content-type-options"], "nosniff")
        self.assertNotIn("access-control-allow-origin", headers)
        for target in ("/../secret", "/assets/../../secret", "/%2e%2e/secret", "/..%2fsecret", "//etc/passwd", "/assets", "/token",
                       "/data/token", "/index.html/..", "/?x", "/assets/page.js%00", "*", "http://127.0.0.1/secret"):
            status, _, body = http(port, target)
            self.assertEqual((status, body), (404, "there is no such page\n"), target)
        for method in ("POST", "PUT", "DELETE", "OPTIONS", "TRACE"):
            self.assertEqual(http(port, method=method)[0], 405)
        self.assertEqual(http(port, "/live")[0], 400)
        self.assertEqual(http(port, method="HEAD")[0], 200)

    def test_requests_that_are_none(self):
        port = self.studio.port
        for asked, status in ((b"nonsense\r\n\r\n", 400), (b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + b"\r\n\r\n", 400),
                              (b"GET / HTTP/9.9\r\n\r\n", 400), (b"GET / HTTP/1.1\r\nno colon\r\n\r\n", 400),
                              (b"GET / HTTP/1.1\r\nX: " + b"x" * 20000 + b"\r\n\r\n", 431),
                              (b"POST / HTTP/1.1\r\nContent-Length: 99999999\r\n\r\n", 431),
                              (b"GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n", 400),
                              (b"GET / HTTP/1.1\r\nTransfer-Encoding: gzip\r\n\r\n", 400)):
            with Wire(port) as wire:
                wire.send(asked)
                self.assertEqual(wire.read_answer()[0], status, asked[:40])
        self.still_serves()

    def test_a_thousand_connections_keep_nobody_out(self):
        port = self.studio.port
        held = []
        try:
            for i in range(1000):
                wire = Wire(port)
                held.append(wire)
                try:
                    if i % 3 == 1:
                        wire.send(b"GET / HTTP/1.1\r\nX-Slow: ")
                    elif i % 3 == 2:
                        wire.send(f"GET /healthz HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n".encode())
                except OSError:
                    pass  # it made room already
            self.still_serves()
            lives = [self.enterContext(open_live(port)) for _ in range(80)]
            self.still_serves()
            self.assertEqual(len(lives), 80)
        finally:
            for wire in held:
                wire.close()
        self.assertIsNone(self.page.closed)

    def test_stop_over_http_with_a_token_alone(self):
        port = self.studio.port
        self.page.do("run.start")
        self.page.wait(lambda: self.clock.value["state"] == "running", "a run")
        self.assertEqual(http(port, "/stop", method="POST")[0], 401)
        self.assertEqual(http(port, "/stop", method="POST", headers={"Authorization": "Bearer " + "0" * 32})[0], 401)
        right = {"Authorization": f"Bearer {self.studio.token}"}
        self.assertEqual(http(port, "/stop", method="POST", headers=right | {"Origin": "http://evil.example"})[0], 403)
        self.assertEqual(self.clock.value["state"], "running")
        self.assertEqual(http(port, "/stop", method="POST", headers=right)[0], 202)
        self.page.wait(lambda: self.clock.value["state"] == "none", "the end of the run")
        self.logged("POST /stop")

    def test_a_command_that_comes_too_late_is_not_done(self):
        page = self.page
        for late in ({}, {"until": 0}, {"until": 1e18}):
            page.next_id += 1
            page.say({"id": page.next_id, "do": "run.start", "in": {}} | late)
            answer = page.wait(lambda: page.answers.get(page.next_id), "a refusal")
            self.assertEqual(answer["error"]["code"], "late", answer)
        self.assertNotEqual(self.clock.value["state"], "running")
        self.logged("run.start")

    # the door of the WebSocket -------------------------------------------------------------------

    def test_a_wrong_token_is_slowed_down_and_logged(self):
        port, good = self.studio.port, self.studio.token
        for wrong in ("", "x", good[:-1], good + "0", good.upper() + "\n", "0" * 200):
            with self.assertRaises(Refused) as caught:
                Page(port, wrong)
            self.assertIn(caught.exception.code, ("not_allowed", "bad_message"))
        self.logged("a wrong token")
        # Twenty that have not heard yet that theirs is wrong, and one at the same address that has the right one.
        guessers = [self.enterContext(open_live(port)) for _ in range(20)]
        hello = {"id": 1, "do": "hello", "in": {"token": "0" * 32, "client": "guesser"}}
        for guesser in guessers:
            guesser.send(frame(TEXT, json.dumps(hello).encode()))
        self.still_serves()
        for guesser in guessers:
            told, goodbye = guesser.read_to_end()
            self.assertEqual(json.loads(told[1])["error"]["place"], "in.token")
            self.assertEqual(goodbye[0], CLOSE)

    def test_nothing_is_answered_before_hello(self):
        for say in ({"id": 1, "do": "run.start", "in": {}}, {"id": 1, "do": "watch", "in": {"watch": 1, "topic": "studio"}}, {"id": 1}):
            with open_live(self.studio.port) as live:
                # The goodbye comes behind the answer; what is said meanwhile is not heard.
                live.send(frame(TEXT, json.dumps(say).encode()) +
                          frame(TEXT, json.dumps({"id": 2, "do": "hello", "in": {"token": self.studio.token, "client": "late"}}).encode()))
                frames = live.read_to_end()
            self.assertEqual([kind for kind, _ in frames], [TEXT, CLOSE])
            self.assertIn("error", json.loads(frames[0][1]))
            self.assertIn(b"expected the command hello", frames[1][1])
        self.assertEqual(self.people.value["clients"], 1)

    def test_other_protocols_and_frames_are_refused(self):
        port = self.studio.port
        for changed in ({"Sec-WebSocket-Protocol": "other"}, {"Sec-WebSocket-Protocol": None}):
            with Wire(port) as wire:
                wire.send(ask_for_live(port, changed))
                status, _, body = wire.read_answer()
                self.assertEqual((status, "vagus-1" in body), (400, True))
        with open_live(port) as live:
            live.send(frame(BINARY, b"\0" * 100))
            self.assertIn(b"expected text", dict(live.read_to_end())[CLOSE])
        self.logged("binary ones only come from here")
        for bad in (b"\x81\x05hello",                       # not masked
                    b"\xf1\x80\0\0\0\0",                    # reserved bits
                    frame(0, b"a continuation of nothing"),
                    frame(TEXT, b"\xff\xfe\xfd"),           # not UTF-8
                    frame(3, b"a reserved kind"),
                    frame(9, b"x" * 200)):                  # a ping that is too long
            with open_live(port) as live:
                live.send(bad)
                self.assertNotIn(TEXT, dict(live.read_to_end()))
        with open_live(port) as live:
            try:
                live.send(frame(TEXT, b"x" * (LIMITS["message_bytes"]["value"] + 1)))
            except OSError:
                pass
            live.read_to_end()
        self.logged("a message above the limit")
        self.still_serves()

    def test_more_pages_than_may_be(self):
        for _ in range(LIMITS["clients"]["value"] - 1):
            self.enterContext(self.studio.page())
        with self.assertRaises(Refused) as caught:
            self.studio.page()
        self.assertEqual(caught.exception.code, "limit")
        self.page.do("state.put", key="still", value="there")

    def test_two_tabs_of_one_name_both_stay(self):
        first = self.enterContext(self.studio.page(client="tab", nonce="one"))
        second = self.enterContext(self.studio.page(client="tab", nonce="two"))
        self.assertEqual(first.greeting["client"], "tab")
        self.assertNotEqual(second.greeting["client"], "tab")
        for page in (first, second):
            page.watch("clock")
            self.assertIsNone(page.closed)

    def test_a_new_token_is_the_only_one(self):
        other = self.studio.page()
        token = self.page.do("access.renew")["token"]
        self.assertIn("new token", other.wait_closed())
        with self.assertRaises(Refused):
            self.studio.page()
        self.studio.token = token
        self.still_serves()
        self.assertEqual((self.studio.folder / "data" / "token").read_text(encoding="ascii"), token + "\n")

    # the folder ----------------------------------------------------------------------------------

    def test_links_that_loop_and_pipes_in_the_folder(self):
        files, console = self.page.watch("files"), self.page.watch("console", last=100)
        os.symlink("loop", self.folder / "loop")
        os.mkfifo(self.folder / "pipe.aesl")
        (self.folder / "zeta.txt").write_text("after them", encoding="utf-8")
        self.page.wait(lambda: any(file["path"] == "zeta.txt" for file in files.value["files"]), "the file behind them")
        for what in ("loop: passed over: a link that leads to itself", "pipe.aesl: passed over"):
            self.page.wait(lambda: any(what in line["text"] for line in console.items), what)
        self.still_serves()

    # messages ------------------------------------------------------------------------------------

    def test_messages_that_are_none(self):
        page = self.page
        deep = LIMITS["message_depth"]["value"] + 1
        for say in ("", "nonsense", "[]", "null", '"x"', "{}", '{"id":-1}', '{"id":1.5,"do":"stop"}', '{"id":1e99,"do":"stop"}',
                    "[" * deep + "]" * deep, '{"id":1,' * 100000, "\u0000", "{" * 500000):
            page.say(say)
            page.wait(lambda: page.answers.pop(0, None), f"a refusal of {say[:20]}")
        number = 100000
        for do, fields, code in (("run.explode", {}, "unknown_command"), ("run.strat", {}, "unknown_command"),
                                 ("stop", {"now": True}, "bad_message"), ("stop", [], "bad_message"),
                                 ("clock.speed", {"speed": "fast"}, "bad_message"), ("clock.speed", {"speed": 1001}, "bad_message"),
                                 ("clock.speed", {}, "bad_message"), ("node.run", {"node": 1.5}, "bad_message"),
                                 ("doc.open", {"doc": "x" * 513}, "bad_message"), ("doc.open", {"doc": "a\nb"}, "bad_message"),
                                 ("run.start", {"set": 5}, "bad_message"), ("world.press", {"robot": "alice", "button": "a", "down": 1}, "bad_message")):
            number += 1
            page.say({"id": number, "do": do, "in": fields})
            answer = page.wait(lambda: page.answers.get(number), do)
            self.assertEqual(answer["error"]["code"], code, answer)
            self.assertTrue(answer["error"]["what"])
        page.say({"id": number + 1, "do": "hello", "in": {"token": self.studio.token, "client": "another"}})
        self.assertEqual(page.wait(lambda: page.answers.get(number + 1))["error"]["code"], "conflict")
        self.logged("refused a message")
        self.still_serves()

    def test_subscriptions_that_are_none(self):
        for fields, code in (({"topic": "nothing"}, "not_found"), ({"topic": "doc"}, "bad_message"), ({"topic": "doc", "of": 5}, "bad_message"),
                             ({"topic": "variables", "of": {"node": 1, "ranges": [["x"]] * 300}}, "bad_message"),
                             ({"topic": "clock", "rate": 0}, "bad_message"), ({"topic": "clock", "rate": 1e9}, "bad_message")):
            self.refused(code, "watch", watch=900, **fields)
        for of in ([5, None, "x", [], [1], [-1, 5], [0, 70000], [1.5, 2], [[0, 1], [0, 1]]],):
            self.page.topics[901] = type(self.clock)("variables")
            self.page.do("watch", watch=901, topic="variables", of={"node": 1, "ranges": of})
        for number in range(1000, 1000 + LIMITS["watches"]["value"]):
            self.page.topics[number] = type(self.clock)("clock")
            last = self.page.ask("watch", watch=number, topic="clock")
        with self.assertRaises(Refused) as caught:
            self.page.answer(last)
        self.assertEqual(caught.exception.code, "limit")
        self.still_serves()

    def test_documents_outside_the_project(self):
        page = self.page
        for path in LEAVES_THE_PROJECT:
            for command, fields in (("doc.open", {"doc": path}), ("file.bytes", {"path": path}), ("file.delete", {"path": path}),
                                    ("file.new", {"path": path, "kind": "text"}), ("file.rename", {"path": "robot.aesl", "to": path}),
                                    ("file.rename", {"path": path, "to": "mine.aesl"}),
                                    ("doc.edit", {"doc": path, "epoch": "x", "version": 1, "by": "me", "changes": [{"from": 0, "to": 0, "text": "x"}]}),
                                    ("doc.save", {"doc": path}), ("define.add", {"file": path, "kind": "event", "name": "x", "value": 1}),
                                    ("break.set", {"doc": path + "#1", "line": 1})):
                with self.assertRaises(Refused, msg=f"{command} {fields}"):
                    page.do(command, **fields)
        self.assertEqual((self.studio.folder / "secret").read_text(encoding="utf-8"), "secret")
        self.assertEqual(sorted(path.name for path in self.studio.folder.iterdir()), ["data", "pages", "project", "secret"])
        self.assertEqual(sorted(path.name for path in self.folder.iterdir() if path.name != ".vagus"),
                         ["outside", "robot.aesl", "room.world.json", "vagus.json"])
        for path in ("outside", "robot.aesl/x", "vagus.json/.."):
            self.refused_some(path)
        self.still_serves()

    def refused_some(self, path):
        with self.assertRaises(Refused):
            self.page.do("file.bytes", path=path)

    def test_commands_with_whatever_values_kill_neither_server_nor_run(self):
        seed = int(os.environ.get("VAGUS_SEED") or random.SystemRandom().randrange(1 << 32))
        print(f"seed: VAGUS_SEED={seed}")
        dice = random.Random(seed)
        page = self.page
        for topic in ("start", "targets", "files", "findings", "scripts", "network", "state", "poses", "rays"):
            page.watch(topic)
        self.wait_node(described=True)
        known = {"Doc": [projects.DOC, "robot.aesl", "room.world.json", "vagus.json"], "Path": ["robot.aesl", "new.aesl", "folder"],
                 "NodeId": [1, 2], "node": [0, 1], "Name": ["go", "n", "speed"], "name": ["go", "n", "speed"], "robot": ["alice"],
                 "object": [1, 2, 3], "version": [1, 2, 3], "button": ["center"], "Point": [[1, 1], [0, 0], [1e9, 1], [1e300, -1e300]],
                 "Place": [{"line": 1, "column": 1}, {"line": 13, "column": 3}], "target": ["sim", "nonsense"], "speed": [0, 1, 10],
                 "path": [str(self.folder), "robot.aesl", "new.aesl"], "id": ["thymio", "nothing"]}
        # run.end ends the run: that is what it is for.
        commands = [command for command in COMMANDS if command not in ("hello", "watch", "unwatch", "run.end", "folder.list", "access.renew")]
        rare = ("project.", "target.", "file.")
        for _ in range(300):
            command = dice.choice(commands)
            if command.startswith(rare) and dice.random() < 0.8:
                continue
            fields = invented_fields(COMMANDS[command]["in"], dice, known)
            try:
                page.do(command, **fields)
            except Refused as refused:
                self.assertTrue(refused.what, command)
            self.assertNotEqual(self.clock.value["state"], "dead", (command, fields, self.clock.value, self.studio.log()[-5:]))
        self.assertNotIn("terminate", "\n".join(self.studio.log()))
        self.assertFalse(page.faults)

    def test_a_flood_of_commands_is_braked(self):
        page = self.page
        numbers = [page.ask("driver.ask") for _ in range(10000)]
        page.wait(lambda: numbers[-1] in page.answers, "an answer to the last")
        codes = [page.answers[number].get("error", {}).get("code") for number in numbers]
        self.assertEqual(set(codes), {None, "limit"})
        self.assertLess(codes.count(None), 9000)
        with self.studio.page() as another:
            another.watch("clock")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:] or ["Hostile"])], verbosity=2, warnings="ignore")
