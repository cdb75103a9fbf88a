"""A TCP proxy on loopback whose link can be cut, hold what it carries, or carry it later."""
import selectors
import socket
import threading
import time

STEP = 0.02


class Link:
    """One connection through the proxy."""

    def __init__(self, client, port):
        self.client, self.server = client, socket.create_connection(("127.0.0.1", port))
        self.held = []  # (when it may go on, to whom, bytes)
        for one in (self.client, self.server):
            one.setblocking(False)

    def close(self):
        self.client.close()
        self.server.close()


class Proxy:
    def __init__(self, port):
        self.to, self.delay = port, 0.0
        self.is_cut = self.holds = False
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.listener.setblocking(False)
        self.port = self.listener.getsockname()[1]
        self.links = []
        self._ends = False
        self._thread = threading.Thread(target=self._run, daemon=True)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._ends = True
        self._thread.join()
        for link in self.links:
            link.close()
        self.listener.close()

    def _run(self):
        while not self._ends:
            with selectors.DefaultSelector() as ready:
                ready.register(self.listener, selectors.EVENT_READ)
                if not self.holds:
                    for link in self.links:
                        ready.register(link.client, selectors.EVENT_READ, (link, link.server))
                        ready.register(link.server, selectors.EVENT_READ, (link, link.client))
                found = [key for key, _ in ready.select(STEP)]
            self._turn(found)

    def _turn(self, found):
        for key in found:
            if key.data is None:
                self._accept()
            else:
                self._read(key.fileobj, *key.data)
        if self.is_cut:
            for link in self.links:
                link.close()
            self.links = []
        for link in list(self.links):
            self._pass_on(link)

    def _accept(self):
        client, _ = self.listener.accept()
        try:
            if self.is_cut:
                raise OSError
            self.links.append(Link(client, self.to))
        except OSError:
            client.close()

    def _read(self, source, link, target):
        try:
            data = source.recv(65536)
        except BlockingIOError:
            return
        except OSError:
            data = b""
        link.held.append((time.monotonic() + self.delay, target, data))

    def _pass_on(self, link):
        while link.held and not self.holds and link.held[0][0] <= time.monotonic():
            _, target, data = link.held.pop(0)
            try:
                if not data:
                    raise OSError
                target.setblocking(True)
                target.sendall(data)
                target.setblocking(False)
            except OSError:
                link.close()
                self.links.remove(link)
                return
