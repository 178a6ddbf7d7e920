# SPDX-License-Identifier: BSD-3-Clause
"""A server of pages of the program, as a test starts and asks it."""
import contextlib
import http.client
import re
import signal
import subprocess

from checks import require


class PageServer:
    """A command of the program that serves pages until it is told to end; `ask` returns status and body."""

    def __init__(self, *command):
        self.process = subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        found = re.search(r"http://(127\.0\.0\.1:(\d+))/#([0-9a-f]{32}) ", line)
        require(found, f"no address in {line!r}")
        self.host, self.port, self.token = found[1], int(found[2]), found[3]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.send_signal(signal.SIGTERM)
        require(self.process.wait(20) == 0, "the server ends with code 0 on SIGTERM")

    def ask(self, target, body=None, token=None, host=None, **heads):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        connection.putrequest("GET" if body is None else "POST", target, skip_host=True)
        heads = {name.replace("_", "-"): value for name, value in heads.items()}
        heads = {"Host": host or self.host, "X-Whipple-Token": self.token if token is None else token, **heads}
        if body is not None:
            heads = {"Content-Type": "application/json", "Content-Length": str(len(body.encode())), **heads}
        for name, value in heads.items():
            connection.putheader(name, value)
        with contextlib.suppress(BrokenPipeError, ConnectionResetError):  # a question that is too long is answered before its end
            connection.endheaders(None if body is None else body.encode())
        with contextlib.closing(connection):
            answer = connection.getresponse()
            self.heads = dict(answer.getheaders())
            return answer.status, answer.read()
