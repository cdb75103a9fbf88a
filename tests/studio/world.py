"""A world under a hand: its file is edited before and while it runs, things are put back as they were, ways are told."""
import json
import struct
import sys
import unittest
import zlib

import projects
from cases import Case, poses

FILE = "room.world.json"


def png(grey):
    """An image of 2 by 2 pixels of one grey."""
    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    head = struct.pack(">IIBBBBB", 2, 2, 8, 2, 0, 0, 0)
    rows = (b"\0" + bytes([grey] * 6)) * 2
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


class AWorldUnderAHand(Case):
    def edit(self, change):
        """Another text of the world, not saved."""
        now = self.page.do("doc.open", doc=FILE)["text"]
        world = json.loads(now)
        change(world)
        self.page.edit(FILE, (0, len(now), json.dumps(world)))

    def has_changed(self):
        return self.people.value["project"].get("world_changed", False)

    def ids(self):
        """Of the objects of the world; none before there is one."""
        return [one["id"] for one in self.scene.value.get("objects", [])]

    def post(self, world):
        world["objects"].append({"id": "post", "kind": "cylinder", "at": [1, 2], "radius": 0.1})

    def test_before_it_runs_it_shows_its_file_as_it_is_edited_and_saves_nothing(self):
        self.open()
        self.wait_node(described=True)
        saved = (self.folder / FILE).read_text(encoding="utf-8")
        self.wait(lambda: self.ids() == ["box"], "the world of the file")
        opening = self.scene.value["opening"]
        self.edit(self.post)
        self.wait(lambda: self.ids() == ["box", "post"], "the post that was drawn")
        self.assertGreater(self.scene.value["opening"], opening)
        self.wait(lambda: not self.has_changed(), "the file of the world that is there")
        self.assertEqual((self.folder / FILE).read_text(encoding="utf-8"), saved)
        # One with a mistake waits until it has none.
        self.edit(lambda world: world["objects"][1].update(radius=-1))
        self.wait(self.has_changed, "another file")
        self.assertEqual(self.ids(), ["box", "post"])
        self.edit(lambda world: world["objects"][1].update(radius=0.2, id="pole"))
        self.wait(lambda: self.ids() == ["box", "pole"], "the file without its mistake")

    def test_in_a_run_that_has_begun_it_stays_and_says_that_its_file_is_another_one(self):
        page = self.open()
        self.wait_node(described=True)
        page.do("run.start")
        self.wait_passed()
        self.assertFalse(self.has_changed())
        self.edit(self.post)
        self.wait(self.has_changed, "the mark")
        self.wait_passed()
        self.assertEqual(self.ids(), ["box"])
        page.do("run.reset")
        self.wait(lambda: self.ids() == ["box", "post"] and not self.has_changed(), "the world of the file")

    def test_what_a_hand_did_before_the_run_is_not_lost_by_an_edit(self):
        page = self.open()
        self.wait_node(described=True)
        number = page.do("world.put", kind="box", at=[1, 1], size=[0.1, 0.1])["number"]
        self.edit(self.post)
        self.wait(self.has_changed, "the mark")
        self.wait(lambda: [one["number"] for one in self.scene.value["objects"]][1:] == [number], "what was put")

    def test_what_was_taken_is_put_back_as_it_was(self):
        page = self.open()
        self.wait_node(described=True)
        before = self.wait(lambda: self.scene.value["objects"], "the box")[0]
        page.do("world.take", object=before["number"])
        self.wait(lambda: self.ids() == [], "an empty room")
        page.do("world.put", at=[2.5, 2.5], **{key: value for key, value in before.items() if key != "number"})
        after = self.wait(lambda: self.scene.value["objects"], "the box again")[0]
        self.assertEqual({**after, "number": 0}, {**before, "number": 0})

    def ground(self):
        """What the left sensor of the ground sees after an instant."""
        described = self.page.watch("node", node=1)
        self.wait(lambda: described.value and described.value["variables"], "a description")
        address = next(one["address"] for one in described.value["variables"] if one["name"] == "prox.ground.reflected")
        self.page.do("run.start")
        self.wait_passed()
        self.page.do("run.pause")
        self.wait(lambda: self.page.do("history.at", t=0.15)["to"] > 0.15, "what is kept of the run")
        return self.page.do("history.at", t=0.15, ranges=[[1, address, 1]])["values"][0]["words"][0]

    def test_another_image_on_its_ground_is_another_world(self):
        def make(folder):
            projects.thymio(folder)
            world = json.loads((folder / FILE).read_text(encoding="utf-8"))
            world["ground"] = {"image": "floor.png"}
            projects.write(folder, FILE, world)
            (folder / "floor.png").write_bytes(png(255))

        self.open(make)
        self.wait_node(described=True)
        self.wait(lambda: "opening" in self.scene.value, "the world")
        opening = self.scene.value["opening"]
        self.assertGreater(self.ground(), 500)
        self.page.do("run.reset")
        self.wait(lambda: self.scene.value["opening"] > opening and self.clock.value["t"] == 0, "a world at its start")
        opening = self.scene.value["opening"]
        (self.folder / "floor.png").write_bytes(png(0))
        self.wait(lambda: self.scene.value["opening"] > opening, "a world with the other image")
        self.wait_node(described=True)
        self.assertLess(self.ground(), 300)
        self.page.do("run.reset")
        self.wait(lambda: self.clock.value["t"] == 0, "a world at its start")
        # What is no image is told; the world comes back with one.
        (self.folder / "floor.png").write_bytes(b"no image")
        self.wait(lambda: any("PNG" in line["text"] for line in self.console.items), "why it is not opened")
        opening = self.scene.value["opening"]
        (self.folder / "floor.png").write_bytes(png(128))
        self.wait(lambda: self.scene.value["opening"] > opening, "a world again")

    def test_what_was_put_after_stop_is_there_when_a_plan_starts(self):
        """Its world is opened again for it. What was deleted stays deleted; the next run is that of the file."""
        def make(folder):
            projects.thymio(folder)
            projects.write(folder, "Rest.plan.json", {"format": "vagus-plan/1", "name": "Rest", "start": {"actor": "rest"}, "actors": {
                "rest": {"template": "WaitForever", "states": {}}}})
            project = json.loads((folder / "vagus.json").read_text(encoding="utf-8"))
            projects.write(folder, "vagus.json", {**project, "plan": "Rest.plan.json"})

        def run():
            page.do("run.start")
            self.wait(lambda: self.plan.value.get("state") == "running", "the plan")

        page = self.open(make)
        self.wait_node(described=True)
        run()
        page.do("stop")
        number = page.do("world.put", kind="cylinder", id="post", at=[1, 2], radius=0.1)["number"]
        self.wait(lambda: self.ids() == ["box", "post"], "the post")
        opening = self.scene.value["opening"]
        page.do("world.take", object=1)
        run()
        self.wait(lambda: self.ids() == ["post"], "the post alone, in the world of the run")
        self.assertEqual((self.scene.value["objects"][0]["number"], self.scene.value["opening"]), (number, opening))
        page.do("stop")
        run()
        self.wait(lambda: self.ids() == ["box"], "the world of the file")

    def test_ways_are_told_from_the_beginning(self):
        page = self.open()
        self.wait_node(described=True)
        page.do("run.start")
        page.do("event.send", name="go", args=[200])
        moves = page.watch("poses")
        self.wait(lambda: moves.frames and poses(moves.frames[-1])[0][0] > 0.6, "a robot that has driven 10 cm")
        [(index, *way)] = page.do("history.ways", **{"from": 0, "to": 1000})["ways"]
        xs = way[1::3]
        self.assertEqual((index, round(xs[0], 2)), (0, 0.5))
        self.assertGreater(xs[-1], 0.58)
        self.assertTrue(all(later - earlier >= 0.0099 for earlier, later in zip(xs, xs[1:])), xs)
        self.refused("bad_input", "history.ways", **{"from": -1, "to": 1})


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:] or ["AWorld"])], verbosity=2, warnings="ignore")
