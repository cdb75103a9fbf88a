"""Reads a file of MCAP 1 by its public specification (https://mcap.dev/spec), also one without its end."""
import ctypes
import ctypes.util
import json
import struct

MAGIC = b"\x89MCAP0\r\n"
CHANNEL, MESSAGE, CHUNK, ATTACHMENT = 0x04, 0x05, 0x06, 0x09
ZSTD = ctypes.CDLL(ctypes.util.find_library("zstd") or "libzstd.so.1")
ZSTD.ZSTD_decompress.restype = ctypes.c_size_t


def records(data):
    """Whole records only: opcode, content."""
    at = 0
    while at + 9 <= len(data):
        opcode, size = struct.unpack_from("<BQ", data, at)
        if at + 9 + size > len(data):
            return
        yield opcode, data[at + 9:at + 9 + size]
        at += 9 + size


def text(data, at):
    (size,) = struct.unpack_from("<I", data, at)
    return data[at + 4:at + 4 + size].decode(), at + 4 + size


def decompressed(chunk):
    (size,) = struct.unpack_from("<Q", chunk, 16)
    name, at = text(chunk, 28)
    (length,) = struct.unpack_from("<Q", chunk, at)
    packed = chunk[at + 8:at + 8 + length]
    if name != "zstd":
        return packed
    room = ctypes.create_string_buffer(max(size, 1))
    got = ZSTD.ZSTD_decompress(room, ctypes.c_size_t(size), packed, ctypes.c_size_t(len(packed)))
    if got != size:
        raise ValueError("a chunk is not what its length says")
    return room.raw[:size]


class Recording:
    """`messages`: (topic, seconds, data) in the order of the file; `files`: attachments by name."""

    def __init__(self, path):
        data = path.read_bytes()
        if not data.startswith(MAGIC):
            raise ValueError(f"{path} is no MCAP file")
        self.complete = len(data) > len(MAGIC) * 2 and data.endswith(MAGIC)
        self.messages, self.files, self.topics = [], {}, {}
        self._see(data[len(MAGIC):])

    def _see(self, data):
        for opcode, content in records(data):
            if opcode == CHUNK:
                self._see(decompressed(content))
            elif opcode == CHANNEL:
                (number,) = struct.unpack_from("<H", content)
                self.topics[number] = text(content, 4)[0]
            elif opcode == MESSAGE:
                number, _, log_time = struct.unpack_from("<HIQ", content)
                self.messages.append((self.topics[number], log_time / 1e9, content[22:]))
            elif opcode == ATTACHMENT:
                name, at = text(content, 16)
                _, at = text(content, at)
                (size,) = struct.unpack_from("<Q", content, at)
                self.files[name] = content[at + 8:at + 8 + size]

    def json(self, topic):
        return [json.loads(data) for name, _, data in self.messages if name == topic]

    def frames(self):
        """(number, cause, source, type, payload) of each."""
        found = []
        for name, _, data in self.messages:
            if name == "/bus/frames":
                number, cause, source = struct.unpack_from("<IIH", data)
                size, again, kind = struct.unpack_from("<HHH", data, 10)
                if size != len(data) - 16 or again != source:
                    raise ValueError("a frame is not what its header says")
                found.append((number, cause, source, kind, data[16:]))
        return found
