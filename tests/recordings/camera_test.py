"""Recordings with what the cameras of robots see."""
import base64
import json
import pathlib
import struct
import sys
import tempfile
import unittest
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
from harness import run_vagus
from mcap import Recording

# Red fills the middle of what the first one sees, half a metre ahead; behind the other one is blue.
WORLD = {
    "format": "vagus-world/1", "name": "Two", "seed": 1, "size": [4, 2],
    "objects": [{"id": "red", "kind": "wall", "at": [1.6, 1], "size": [0.2, 1], "height": 0.5, "colour": [1, 0, 0]},
                {"id": "blue", "kind": "wall", "at": [3.6, 1], "size": [0.2, 1], "height": 0.5, "colour": [0, 0, 1]}],
    "robots": [{"name": "first", "type": "carbot", "at": [0.9, 1]}, {"name": "second", "type": "carbot", "at": [2.9, 1]},
               {"name": "blind", "type": "thymio2", "at": [0.3, 0.3]}],
}


def chunks(data):
    """Of a PNG, by the public specification (RFC 2083, section 3.2)."""
    at = 8
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        yield kind, data[at + 8:at + 8 + size]
        at += 12 + size


def pixels(data):
    """Rows of (red, green, blue) of a PNG with 8 bits a part, by sections 4 and 6."""
    found = list(chunks(data))
    width, height, depth, colour, _, _, interlace = struct.unpack(">IIBBBBB", found[0][1])
    assert (data[:8], depth, colour, interlace) == (b"\x89PNG\r\n\x1a\n", 8, 2, 0)
    raw = zlib.decompress(b"".join(content for kind, content in found if kind == b"IDAT"))
    rows, before = [], bytes(3 * width)
    for y in range(height):
        filter_of, row = raw[y * (3 * width + 1)], bytearray(raw[y * (3 * width + 1) + 1:(y + 1) * (3 * width + 1)])
        for x in range(3 * width):
            left, up, corner = (row[x - 3] if x >= 3 else 0), before[x], (before[x - 3] if x >= 3 else 0)
            near = min((abs(up - corner), 0, left), (abs(left - corner), 1, up), (abs(left + up - 2 * corner), 2, corner))[2]
            row[x] = (row[x] + (0, left, up, (left + up) // 2, near)[filter_of]) & 255
        rows.append([tuple(row[x:x + 3]) for x in range(0, 3 * width, 3)])
        before = bytes(row)
    return rows


class CameraRecordings(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-camera-")))
        self.file = self.folder / "run.mcap"

    def write_world(self, **changes):
        path = self.folder / "two.world.json"
        path.write_text(json.dumps({**WORLD, **changes}))
        return path

    def sim(self, *options, status=0, **changes):
        return run_vagus("sim", self.write_world(**changes), "--headless", "--speed", "max", "--duration", 1, "--record",
                         self.file, *options, status=status)

    def test_each_camera_is_a_channel_of_ten_pictures_a_second(self):
        self.sim("--record-camera")
        recording = Recording(self.file)
        self.assertEqual({name for name in recording.topics.values() if name.startswith("/camera/")},
                         {"/camera/first", "/camera/second"})
        for name, sees in (("first", (1, 0, 0)), ("second", (0, 0, 1))):
            pictures = recording.json(f"/camera/{name}")
            self.assertEqual(len(pictures), 11)  # at 0 and each 100 ms
            self.assertEqual([one["timestamp"] for one in pictures[:3]],
                             [{"sec": 0, "nsec": 0}, {"sec": 0, "nsec": 100_000_000}, {"sec": 0, "nsec": 200_000_000}])
            self.assertEqual({(one["frame_id"], one["format"]) for one in pictures}, {(name, "png")})
            rows = pixels(base64.b64decode(pictures[0]["data"]))
            self.assertEqual((len(rows[0]), len(rows)), (160, 120))
            middle = rows[60][80]
            for part, is_bright in zip(middle, sees):
                self.assertTrue(part > 100 if is_bright else part < 50, middle)
        self.assertRegex(run_vagus("replay", self.file), r"messages compared: no difference$")

    def test_looking_changes_nothing(self):
        checks = []
        for options in ([], ["--record-camera"]):
            self.sim(*options)
            checks.append(Recording(self.file).json("/vagus/check"))
        self.assertEqual(checks[0], checks[1])

    def test_where_there_is_no_camera_is_said(self):
        told = self.sim("--record-camera", status=2, robots=[WORLD["robots"][2]])
        self.assertIn("--record-camera: no robot of this world has a camera; a carbot has one", told)
        self.assertFalse(self.file.exists())
        self.assertIn("--record", run_vagus("sim", self.write_world(), "--record-camera", status=2))


if __name__ == "__main__":
    unittest.main()
