"""The studio behind TLS, on an address of its own: pages by HTTPS, live by wss, and what does not fit is told clearly."""
import json
import pathlib
import socket
import ssl
import subprocess
import sys
import tempfile
import unittest

from page import CLOSE, TEXT, Closed, Wire, ask_for_live, frame
from harness import GIVE_UP_AFTER, run_vagus, vagus

HOST = "127.0.0.2"


def certificate(folder, name, host=HOST):
    """A key and a certificate that it has signed itself, as anyone makes them."""
    cert, key = folder / f"{name}.pem", folder / f"{name}.key"
    subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-days", "2",
                    "-subj", f"/CN={name}", "-addext", f"subjectAltName=IP:{host}", "-keyout", key, "-out", cert],
                   check=True, capture_output=True)
    return cert, key


class Secured(Wire):
    """A connection to the studio, by TLS if a context is given."""

    def __init__(self, port, context):
        self.socket = socket.create_connection((HOST, port), timeout=GIVE_UP_AFTER)
        self.bytes = bytearray()
        if context:
            self.socket = context.wrap_socket(self.socket, server_hostname=HOST)


class Secure(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="vagus-secure-")))
        (self.folder / "pages" / "assets").mkdir(parents=True)
        (self.folder / "pages" / "index.html").write_text("<!doctype html><title>pages</title>", encoding="utf-8")
        self.cert, self.key = certificate(self.folder, "robot")
        self.context = ssl.create_default_context(cafile=self.cert)

    def words(self, cert, key):
        return ("studio", "--listen", HOST, "--port", 0, "--token-file", self.folder / "token", "--tls-cert", cert, "--tls-key", key,
                "--data", self.folder / "data", "--config", self.folder / "config", "--pages", self.folder / "pages", "--no-browser")

    def start(self):
        self.program = self.enterContext(vagus(*self.words(self.cert, self.key), cwd=self.folder))
        found = self.program.wait_line(r"^studio https://127\.0\.0\.2:(\d+)/#token=(\w+)$")
        self.port, self.token = int(found.group(1)), found.group(2)
        self.address = f"{HOST}:{self.port}"

    def connection(self, context=None):
        return self.enterContext(Secured(self.port, context))

    def get(self, context, **headers):
        wire = self.connection(context)
        lines = {"Host": self.address, "Connection": "close", **headers}
        wire.send(("GET / HTTP/1.1\r\n" + "".join(f"{name}: {value}\r\n" for name, value in lines.items()) + "\r\n").encode())
        return wire.read_answer()

    def live(self, token, origin="https"):
        """A WebSocket that has said hello, and what it was answered."""
        wire = self.connection(self.context)
        wire.send(ask_for_live(self.port, {"Host": self.address, "Origin": f"{origin}://{self.address}"}))
        status, _ = wire.read_head()
        if status != 101:
            return status, wire
        wire.send(frame(TEXT, json.dumps({"id": 1, "do": "hello", "in": {"token": token, "client": "secure"}}).encode()))
        return self.message(wire), wire

    def message(self, wire):
        """The next one that is no ping."""
        while "ping" in (message := json.loads(wire.read_frame()[1])):
            pass
        return message

    def test_pages_by_https_and_live_by_wss(self):
        self.start()
        status, headers, body = self.get(self.context)
        self.assertEqual((status, body), (200, "<!doctype html><title>pages</title>"))
        self.assertIn("default-src 'none'", headers["content-security-policy"])
        self.assertEqual(headers["strict-transport-security"], "max-age=31536000")
        answer, wire = self.live(self.token)
        self.assertEqual((answer["ok"]["role"], answer["ok"]["driver"]), ("drive", True))
        wire.send(frame(TEXT, json.dumps({"id": 2, "do": "watch", "in": {"watch": 1, "topic": "studio"}}).encode()))
        self.assertEqual(self.message(wire), {"id": 2, "ok": {}})
        self.assertEqual(self.message(wire)["whole"]["clients"], 1)
        answer, wire = self.live("0" * 32)
        self.assertEqual((answer["error"]["code"], answer["error"]["place"]), ("not_allowed", "in.token"))
        self.assertEqual(wire.read_frame()[0], CLOSE)
        self.assertEqual(self.live(self.token, origin="http")[0], 403)
        self.assertEqual(self.get(self.context, Host="127.0.0.1")[0], 403)
        self.assertEqual((self.folder / "token").stat().st_mode & 0o777, 0o600)

    def test_plain_http_hears_what_to_type(self):
        self.start()
        status, _, body = self.get(None)
        self.assertEqual((status, body), (400, "this port speaks HTTPS; open the address with https://\n"))
        for nonsense in (b"\x16\x03\x01\x00\x05hello", b"\x16" * 2000, b"\x00\x01\x02\x03\r\n"):
            wire = self.connection()
            wire.send(nonsense)
            with self.assertRaises(Closed):
                wire.read(1 << 20)
        self.assertEqual(self.get(self.context)[0], 200)

    def test_old_versions_of_tls_are_refused(self):
        self.start()
        old = ssl.create_default_context(cafile=self.cert)
        old.set_ciphers("ALL:@SECLEVEL=0")
        old.minimum_version, old.maximum_version = ssl.TLSVersion.TLSv1, ssl.TLSVersion.TLSv1_1
        with self.assertRaises((ssl.SSLError, ConnectionError)):
            self.connection(old)
        self.assertEqual(self.get(self.context)[0], 200)

    def test_a_handshake_that_does_not_go_on_is_cut_off(self):
        self.start()
        silent, slow = self.connection(), self.connection()
        slow.send(b"\x16\x03\x01")
        self.assertEqual(self.get(self.context)[0], 200)  # others do not wait for them
        for wire in (silent, slow):
            with self.assertRaises(Closed) as caught:
                wire.read(1)
            self.assertNotIn("timed out", str(caught.exception))

    def test_files_that_do_not_fit_are_named(self):
        other, other_key = certificate(self.folder, "other")
        nonsense = self.folder / "nonsense.pem"
        nonsense.write_text("no certificate", encoding="utf-8")
        missing = self.folder / "missing.pem"
        for cert, key, expected in ((nonsense, self.key, r"nonsense\.pem: expected a certificate in PEM form: "),
                                    (self.key, self.key, r"robot\.key: expected a certificate in PEM form: "),
                                    (self.cert, nonsense, r"nonsense\.pem: expected the private key of .*robot\.pem in PEM form: "),
                                    (self.cert, other_key, r"other\.key: expected the private key of .*robot\.pem in PEM form: .*mismatch"),
                                    (missing, self.key, r"missing\.pem"), (self.cert, missing, r"missing\.pem")):
            with vagus(*self.words(cert, key), cwd=self.folder) as program:
                self.assertNotEqual(program.wait_end(), 0)
                self.assertRegex("\n".join(program.lines), expected)
        self.assertIn("--tls-cert and --tls-key go together", run_vagus("studio", "--tls-cert", self.cert, status=2))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(f"-k{name}" for name in sys.argv[1:] or ["Secure"])], verbosity=2, warnings="ignore")
