#!/usr/bin/python3
"""From the press of Stop to its frame on the bus, while the server has other things to do.

    ./dev bench stop [ROUNDS]       30 presses in each case, unless told

A simulated Thymio listens on a port, a studio drives it (in the last case `vagus serve`), and a third program on the bus notes
when the Stop frame (0xa006) for the node arrives. Both ends are this process, so one clock measures. Goals: 20 ms at the median,
100 ms at p99. Presses go on POST /stop where the page itself is busy.
"""
import contextlib
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import threading
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "tests" / part) for part in ("support", "studio")]
import projects
from field import Served
from harness import Bus, listening, run_vagus, simulated, wait_until
from page import Refused, Studio, http

STOP, NODE = 0xA006, 1
MEDIAN_MS, P99_MS = 20, 100
FLOOD_AT_ONCE = 200  # frames in one write
PAGES = 60           # beside the one that presses
TRACE_BYTES = 31 << 20     # of a trace that is opened; 32 MB is the limit
LONG_LINES = 5000          # of a script in which somebody types
DEPLOYED_FILES = (40, 512 << 10)  # number, bytes of each


class Observer(threading.Thread):
    """Notes when Stop frames for the node come by."""

    def __init__(self, port):
        super().__init__(daemon=True)
        self.bus, self.seen, self.news = Bus(port), [], threading.Condition()
        self.start()

    # Only looks for the bytes of one frame: whoever unpacked each frame would be the slowest on a bus that is flooded.
    def run(self):
        wanted = struct.pack("<HHHH", 2, 0, STOP, NODE)
        rest = b""
        with contextlib.suppress(OSError):
            while more := self.bus.socket.recv(1 << 20):
                if wanted in rest + more:
                    with self.news:
                        self.seen.append(time.monotonic())
                        self.news.notify_all()
                rest = more[-len(wanted) + 1:]

    def next_after(self, moment):
        """When the first one came that is younger than the moment; None after ten seconds."""
        with self.news:
            self.news.wait_for(lambda: self.seen and self.seen[-1] > moment, timeout=10)
            return next((one for one in self.seen if one > moment), None)


@contextlib.contextmanager
def repeated(act):
    """`act` is called again and again by another thread. It must have come to its end at least once, and never fail."""
    over, once, wrong = threading.Event(), threading.Event(), []

    def loop():
        try:
            while not over.is_set():
                act()
                once.set()
        except Exception as error:
            wrong.append(error)

    thread = threading.Thread(target=loop, daemon=True)
    thread.start()
    try:
        yield
        assert once.wait(60) and not wrong, wrong or "it never came to its end"
    finally:
        over.set()
        thread.join(timeout=60)


@contextlib.contextmanager
def flood(port, source):
    """Events of this node id, as fast as the bus takes them."""
    frames = bytes.fromhex("0200") + source.to_bytes(2, "little") + bytes.fromhex("01000000")
    with Bus(port) as bus, repeated(lambda: bus.socket.sendall(frames * FLOOD_AT_ONCE)):
        yield


@contextlib.contextmanager
def watching_pages(studio):
    with contextlib.ExitStack() as pages:
        for _ in range(PAGES):
            page = pages.enter_context(studio.page())
            for topic in ("robot", "clock", "network"):
                page.watch(topic, rate=20)
        yield


@contextlib.contextmanager
def searching(studio, page):
    """The driver searches all texts, and saves them."""
    def act():
        page.do("text.search", text="e", regex=False, case=False, whole=False)
        page.do("doc.save_all")
    with repeated(act):
        yield


@contextlib.contextmanager
def odd(disk, how, beside):
    """The disk is "slow" or "full" meanwhile."""
    (disk / how).touch()
    try:
        with beside:
            yield
    finally:
        (disk / how).unlink()


@contextlib.contextmanager
def typing(page, lines):
    """The driver types into the script, of so many lines, saves it, and puts a setting into another place."""
    page.watch("findings", rate=20)
    now = page.do("doc.open", doc=projects.DOC)
    half = range(lines // 2)
    text = "".join(f"var v{i} = {i}\n" for i in half) + "onevent go\n" + "".join(f"\tv{i} += 1\n" for i in half)
    page.edit(projects.DOC, (0, len(now["text"]), text))

    def act():
        page.edit(projects.DOC, (0, 0, "# typed\n"))
        with contextlib.suppress(Refused):  # on a full disk
            page.do("settings.put", key="bench", value=time.monotonic())
            page.do("doc.save", doc=projects.DOC)
    with repeated(act):
        yield


def write_trace(path):
    """As long as one may be."""
    line = '{{"t":{:.6f},"plan":"Rounds","kind":"write","variable":"rounds","value":{},"by":"count"}}\n'
    with open(path, "w", encoding="ascii") as file:
        file.write('{"t":0.000000,"plan":"Rounds","kind":"plan-start"}\n')
        for number in range(1 << 30):
            if file.tell() > TRACE_BYTES:
                return
            file.write("".join(line.format(number + part / 1000, number) for part in range(1000)))


@contextlib.contextmanager
def opening_a_trace(page, path):
    def act():
        os.utime(path)  # another one: it is read again
        page.do("history.open", trace=path.name)
        page.do("history.lanes", trace=path.name, **{"from": 0, "to": 100, "width": 1000})
        page.do("history.at", trace=path.name, t=50)
    with repeated(act):
        yield


@contextlib.contextmanager
def deploying(project, served):
    """`vagus deploy` again and again."""
    words = ("deploy", project, f"127.0.0.1:{served.port}", "--token-file", served.folder / "data" / "token")
    with repeated(lambda: run_vagus(*words)):
        yield


def press(page, observer):
    before = time.monotonic()
    page.do("stop")
    found = observer.next_after(before)
    return (found - before) * 1000 if found else float("inf")


def press_by_post(studio, page, observer):
    page.do("stop")  # the one before is over: a Stop that is under way serves both
    return post(studio, observer)


def post(studio, observer):
    before = time.monotonic()
    http(studio.port, "/stop", "POST", {"Authorization": f"Bearer {studio.token}", "Content-Length": "0"})
    found = observer.next_after(before)
    return (found - before) * 1000 if found else float("inf")


def tell(name, times):
    times = sorted(times)
    median, p99 = times[len(times) // 2], times[min(len(times) - 1, len(times) * 99 // 100)]
    good = median <= MEDIAN_MS and p99 <= P99_MS
    print(f"figure: stop, {name}: median {median:.1f} ms, p99 {p99:.1f} ms, longest {times[-1]:.1f} ms ({len(times)} presses)"
          + ("" if good else "  misses its goal"), flush=True)
    return good


def odd_disk(folder):
    """The environment of a program whose disk can be made slow or full: odd_disk.c."""
    library = folder / "odd_disk.so"
    subprocess.run(["cc", "-shared", "-fPIC", "-O2", "-o", library, HERE / "odd_disk.c", "-ldl"], check=True)
    disk = folder / "disk"
    disk.mkdir()
    return disk, {"LD_PRELOAD": str(library), "ODD_DISK": str(disk)}


@contextlib.contextmanager
def environment(words):
    before = dict(os.environ)
    os.environ.update(words)
    try:
        yield
    finally:
        os.environ.clear()
        os.environ.update(before)


def wait_node(page):
    people = page.watch("robot", rate=20)
    wait_until("the node never told what it is", lambda: people.value and any(one["described"] for one in people.value["nodes"]))


def measure_studio(rounds, folder, port):
    disk, words = odd_disk(folder)
    with contextlib.ExitStack() as all_of_it:
        with environment(words):
            studio = all_of_it.enter_context(Studio())
        page = all_of_it.enter_context(studio.page())
        project = projects.bus(studio.folder / "project", f"tcp:127.0.0.1:{port}", name="thymio-II")
        trace = project / "long.trace.jsonl"
        write_trace(trace)
        page.do("project.open", path=str(project))
        wait_node(page)
        observer = Observer(port)
        by_page, by_post = lambda: press(page, observer), lambda: press_by_post(studio, page, observer)
        cases = [
            ("nothing else to do", contextlib.nullcontext, by_page),
            ("by POST /stop", contextlib.nullcontext, by_post),
            (f"{PAGES} pages watch", lambda: watching_pages(studio), by_page),
            ("a flood of events of the robot's id", lambda: flood(port, NODE), by_page),
            ("a flood of events of another id", lambda: flood(port, 77), by_page),
            ("all texts searched and saved again and again", lambda: searching(studio, page), by_post),
            ("a trace of 31 MB opened again and again", lambda: opening_a_trace(page, trace), by_post),
            ("typing into 100 lines, each wait for the disk 0.4 s", lambda: odd(disk, "slow", typing(page, 100)), by_post),
            ("typing into 100 lines, the disk full", lambda: odd(disk, "full", typing(page, 100)), by_post),
            (f"typing into {LONG_LINES} lines", lambda: typing(page, LONG_LINES), by_post),
        ]
        return measured(cases, rounds)


def measure_serve(rounds, folder, port):
    project = projects.bus(folder / "robot", f"tcp:127.0.0.1:{port}", name="thymio-II")
    desk = projects.bus(folder / "desk", f"tcp:127.0.0.1:{port}", name="thymio-II")
    number, size = DEPLOYED_FILES
    for file in range(number):
        (desk / f"data-{file}.bin").write_bytes(os.urandom(size))
    with Served(project, "--start") as served, served.page() as page:
        wait_node(page)
        page.do("driver.leave")  # whoever deploys takes control
        observer = Observer(port)
        case = (f"serve, while {number * size >> 20} MB are deployed", lambda: deploying(desk, served),
                lambda: press_by_post(served, page, observer))
        return measured([case], rounds)


def measured(cases, rounds):
    good = True
    for name, beside, act in cases:
        with beside():
            good = tell(name, [act() for _ in range(rounds)]) and good
    return good


def measure(rounds):
    with contextlib.ExitStack() as all_of_it:
        folder = pathlib.Path(all_of_it.enter_context(tempfile.TemporaryDirectory(prefix="vagus-stop-")))
        robot = all_of_it.enter_context(simulated(folder, {"name": "alice", "node": NODE}))
        port = listening(robot)
        good = measure_studio(rounds, folder, port)
        return measure_serve(rounds, folder, port) and good


if __name__ == "__main__":
    sys.exit(0 if measure(int(sys.argv[1]) if len(sys.argv) > 1 else 30) else 1)
