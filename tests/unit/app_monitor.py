#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The monitor of runs: who may ask, what a page can see and change, a run that is started, paused, killed and continued.

Usage: app_monitor.py WHIPPLE CASE.toml FOLDER
"""
import contextlib
import gzip
import http.client
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import time

from checks import require
from page_server import PageServer
from processes import end_runs_in, runs_in

WHIPPLE, CASE, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])


def wait_for(condition, what, seconds=60):
    deadline = time.monotonic() + seconds
    while True:
        found = condition()
        if found:
            return found
        require(time.monotonic() < deadline, f"waited in vain for {what}")
        time.sleep(0.05)


class Monitor(PageServer):
    """A monitor of a folder."""

    def __init__(self, folder, *options):
        super().__init__(WHIPPLE, "monitor", folder, *options)

    def get(self, target):
        status, body = self.ask(target)
        require(status == 200, f"{target}: {status} {body[:200]}")
        return json.loads(body)

    def post(self, target, wish):
        return self.ask(target, json.dumps(wish))


def check_access(monitor):
    """Foreign pages, other names of this machine and programs without the key are turned away."""
    expectations = [
        ("the page", 200, "/", {}), ("its script", 200, "/main.js", {"token": ""}),
        ("the viewer's module", 200, "/viewer/viewer.js", {"token": ""}),
        ("data", 200, "/runs", {}), ("data without key", 401, "/runs", {"token": ""}),
        ("data with a wrong key", 401, "/runs", {"token": "0" * 32}),
        ("another name of the machine", 403, "/", {"host": f"localhost:{monitor.port}"}),
        ("another name with the key", 403, "/runs", {"host": "evil.example"}),
        ("another origin", 403, "/runs", {"Origin": "http://evil.example"}),
        ("its own origin", 200, "/runs", {"Origin": f"http://{monitor.host}"}),
        ("a page of another site", 403, "/runs", {"Sec_Fetch_Site": "cross-site"}),
        ("a path out of the folder", 401, "/../src/app/main.cpp", {"token": ""}),
        ("a coded path out of the folder", 404, "/%2e%2e/%2e%2e/etc/passwd", {}),
        ("a file that is no page", 404, "/viewer/tests/cloud.js", {}),
        ("nothing", 404, "/nothing", {}), ("a run that does not exist", 400, "/run?run=none", {}),
        ("a path as a run", 400, "/run?run=../..", {}), ("a query without keys", 400, "/run", {}),
        ("a number that is none", 400, "/cloud?run=none&index=x&particles=1", {}),
        ("a form", 415, "/steer", {"body": "a=b", "Content_Type": "application/x-www-form-urlencoded"}),
        ("no JSON", 400, "/steer", {"body": "{"}), ("JSON of another kind", 400, "/steer", {"body": "[1]"}),
        ("a post without key", 401, "/steer", {"body": "{}", "token": ""}),
        ("a long post", 413, "/steer", {"body": " " * 100000}),
        ("a case that does not exist", 400, "/start", {"body": '{"case": "none", "run": "a", "set": []}'}),
        ("a name out of the folder", 400, "/start", {"body": '{"case": "small_impact", "run": "../a", "set": []}'}),
        ("an option as a value", 400, "/start", {"body": '{"case": "small_impact", "run": "a", "set": ["--force"]}'}),
    ]
    for what, status, target, heads in expectations:
        found, body = monitor.ask(target, **heads)
        require(found == status, f"{what}: {found} instead of {status}, {body[:200]}")
    monitor.ask("/")
    policy = monitor.heads.get("Content-Security-Policy", "")
    require("default-src 'none'" in policy and "frame-ancestors 'none'" in policy, f"policy {policy}")
    require("Access-Control-Allow-Origin" not in monitor.heads, "no other origin may read")


def check_many(monitor):
    """Connections that say nothing, or half a question, do not keep others waiting."""
    silent = []
    for n in range(60):
        silent.append(socket.create_connection(("127.0.0.1", monitor.port)))
        if n % 2:
            silent[-1].sendall(b"GET /runs HTTP/1.1\r\nHost: ")
    begin = time.monotonic()
    require(monitor.ask("/")[0] == 200, "a page beside silent connections")
    require(time.monotonic() - begin < 3, "it comes at once")
    for connection in silent:
        connection.close()
    # More of them than are served: the oldest give way.
    silent = [socket.create_connection(("127.0.0.1", monitor.port)) for _ in range(200)]
    begin = time.monotonic()
    require(monitor.ask("/")[0] == 200 and monitor.get("/runs")["runs"] == [], "a page beside 200 silent connections")
    require(time.monotonic() - begin < 3, "it comes at once")
    for connection in silent:
        connection.close()
    with socket.create_connection(("127.0.0.1", monitor.port)) as connection:
        connection.sendall(b"\x00\xff nonsense\r\n\r\n")
        connection.settimeout(5)
        connection.recv(100)
    require(monitor.ask("/")[0] == 200, "a page after nonsense")
    for address in subprocess.run(["hostname", "-I"], capture_output=True, text=True).stdout.split():
        with contextlib.suppress(OSError):
            socket.create_connection((address, monitor.port), timeout=1).close()
            raise SystemExit(f"FAILED: the monitor answers on {address}")


def check_end(folder):
    """The monitor ends with code 0 while connections are open, with a question and without one."""
    with contextlib.ExitStack() as open_ones:
        with Monitor(folder) as monitor:
            for question in (b"", b"GET /runs HTTP/1.1\r\nHost: ", f"GET / HTTP/1.1\r\nHost: {monitor.host}\r\n\r\n".encode()):
                open_ones.enter_context(socket.create_connection(("127.0.0.1", monitor.port))).sendall(question)
            require(monitor.ask("/")[0] == 200, "a page: the others are accepted by now")


def check_run(monitor, folder):
    """A run is started, watched, paused, changed, killed, continued."""
    status, body = monitor.post("/start", {"case": "small_impact", "run": "ball", "set": ["domain.cell_size='0.3 mm'", "time.end='2 us'"]})
    require(status == 202, f"start: {status} {body}")
    run = "/run?run=ball"
    wait_for(lambda: any(entry["name"] == "ball" and entry["step"] > 3 for entry in monitor.get("/runs")["runs"]), "steps of the run")
    require(monitor.post("/start", {"case": "small_impact", "run": "ball", "set": []})[0] == 400, "not twice")

    answer = monitor.post("/steer", {"run": "ball", "request": "pause", "value": ""})
    require(answer[0] == 202, f"pause: {answer}")
    wait_for(lambda: monitor.get(run)["status"]["state"] == "paused", "the pause")
    step = monitor.get(run)["status"]["step"]
    time.sleep(0.5)
    wait_for(lambda: monitor.get(run)["answers"], "the answer to it")
    described = monitor.get(run)
    rows = described["rows"]
    require(described["status"]["step"] == step and rows > 1, f"no step in the pause: {step}, {described['status']}, {rows} rows")
    require(described["answers"][-1]["request"] == "pause" and described["answers"][-1]["answer"] == "accepted", f"{described['answers']}")
    require("A ball" not in described["title"] and described["log"], "title and log")
    require(not any(" debug: " in line for line in described["log"]), f"what is for developers: {described['log']}")
    status, body = monitor.post("/steer", {"run": "ball", "request": "snapshot_every", "value": "3 s/m"})
    require(status == 400 and b"unit" in body, f"a wrong unit: {status} {body}")
    require(monitor.post("/steer", {"run": "ball", "request": "snapshot_every", "value": "0.01 us"})[0] == 202, "an interval")
    wait_for(lambda: monitor.get(run)["answers"][-1]["request"] == "snapshot_every", "the answer")

    heads = described["tables"]["history"]
    curves = monitor.get("/curves?run=ball&table=history&x=time%20%5Bs%5D&y=kinetic_energy+%5BJ%5D&y=momentum_z%20%5Bkg%20m%2Fs%5D&points=100")
    energy = curves["kinetic_energy [J]"]
    require("kinetic_energy [J]" in heads and len(energy["x"]) == len(energy["y"]) >= rows // 2 > 1, f"{len(energy['x'])} of {rows}")
    require(energy["x"] == sorted(energy["x"]) and 0 < energy["y"][-1] <= energy["y"][0] * (1 + 1e-12), f"an energy that does not rise: {energy['y']}")
    require(monitor.ask("/curves?run=ball&table=history&x=time%20%5Bs%5D&y=none&points=9")[0] == 400, "a column that does not exist")
    status, cloud = monitor.ask("/cloud?run=ball&index=0&particles=1000")
    require(status == 200 and gzip.decompress(cloud)[:4] == b"WPV1", f"a snapshot: {status}")
    require(monitor.ask("/cloud?run=ball&index=999&particles=1000")[0] == 400, "a snapshot that does not exist")

    require(monitor.post("/steer", {"run": "ball", "request": "resume", "value": ""})[0] == 202, "resume")
    wait_for(lambda: monitor.get(run)["rows"] > rows, "further steps")
    require(monitor.post("/steer", {"run": "ball", "request": "checkpoint", "value": ""})[0] == 202, "a checkpoint")
    wait_for(lambda: monitor.get(run)["answers"][-1]["request"] == "checkpoint", "the checkpoint")
    holder = runs_in(folder)
    require(len(holder) == 1, f"one process: {holder}")
    os.kill(holder[0], signal.SIGKILL)
    begin = time.monotonic()
    wait_for(lambda: monitor.get(run)["status"]["state"] == "lost", "notice of the killed run", 5)
    print(f"a killed run is noticed after {time.monotonic() - begin:.1f} s")
    require(monitor.post("/resume", {"run": "ball"})[0] == 202, "it goes on")
    wait_for(lambda: monitor.get(run)["status"]["state"] == "running", "the run continued")
    require(monitor.post("/resume", {"run": "ball"})[0] == 400, "not while it goes on")
    require(monitor.post("/steer", {"run": "ball", "request": "end", "value": ""})[0] == 202, "end")
    wait_for(lambda: monitor.get(run)["status"]["state"] in ("done", "stopped"), "the end")
    require(monitor.post("/steer", {"run": "ball", "request": "pause", "value": ""})[0] == 400, "a run that has ended takes no request")


def check_links(folder):
    """What lies elsewhere is not shown through a link in a run folder."""
    secret = FOLDER / "secret"
    secret.write_text("secret\n")
    (folder / "ball" / "notes").mkdir()
    (folder / "ball" / "notes" / "link").symlink_to(secret)
    with Monitor(folder) as monitor:
        require(monitor.ask("/run?run=ball")[0] == 200, "a link beside the files of a run, of which none is read")
        snapshot = min((folder / "ball").glob("*.particles.*.hdf"))
        kept = snapshot.rename(snapshot.with_suffix(".kept"))
        snapshot.symlink_to(kept)
        require(monitor.ask("/cloud?run=ball&index=0&particles=9")[0] == 200, "a link inside of the folder of the run")
        snapshot.unlink()
        snapshot.symlink_to(shutil.copy(kept, FOLDER / "snapshot.hdf"))
        status, body = monitor.ask("/cloud?run=ball&index=0&particles=9")
        require(status == 400 and b"is a link" in body, f"a snapshot that lies elsewhere: {status} {body[:200]}")
        snapshot.unlink()
        kept.rename(snapshot)
    (folder / "ball" / "log.txt").unlink()
    (folder / "ball" / "log.txt").symlink_to(secret)
    with Monitor(folder, "--cases", str(FOLDER / "cases")) as monitor:
        status, body = monitor.ask("/run?run=ball")
        require(status == 400 and b"is a link" in body and b"secret\n" not in body, f"a link out of a run: {status} {body}")
        (FOLDER / "elsewhere").mkdir()
        shutil.copy(folder / "ball" / "status.json", FOLDER / "elsewhere")
        (folder / "linked").symlink_to(FOLDER / "elsewhere")
        require([run["name"] for run in monitor.get("/runs")["runs"]] == ["ball"], "a run that lies elsewhere")
        for set_keys in (None, {}, 3, "time.end=1"):
            require(monitor.post("/start", {"case": "small_impact", "run": "new", "set": set_keys})[0] == 400, f"set {set_keys}")
        require(not (folder / "new").exists(), "nothing is started")
    refused = subprocess.run([WHIPPLE, "run", "--restart", str(folder / "ball")], capture_output=True, text=True)
    require(refused.returncode == 2 and "symbolic link" in refused.stderr and secret.read_text() == "secret\n", f"{refused}")


def main():
    shutil.rmtree(FOLDER, ignore_errors=True)
    cases, runs = FOLDER / "cases", FOLDER / "Läufe mit Leerzeichen"
    (cases / "small_impact").mkdir(parents=True)
    shutil.copy(CASE, cases / "small_impact" / "case.toml")
    runs.mkdir()
    with Monitor(runs, "--cases", str(cases)) as monitor:
        require(monitor.get("/runs")["runs"] == [] and monitor.get("/runs")["cases"] == ["small_impact"], "a folder without runs")
        check_access(monitor)
        check_many(monitor)
        check_run(monitor, runs)
    check_end(runs)
    with Monitor(runs / "ball", "--read-only") as monitor:
        require([run["name"] for run in monitor.get("/runs")["runs"]] == ["."], "a run directory itself")
        require(monitor.get("/run?run=.")["rows"] > 1, "its history")
        require(monitor.post("/steer", {"run": ".", "request": "pause", "value": ""})[0] == 403, "it only shows")
    with Monitor(runs / "ball", "--cases", str(FOLDER / "cases")) as monitor:
        require(monitor.get("/runs")["cases"] == [], "no cases to start inside of a run")
        status, body = monitor.post("/start", {"case": "small_impact", "run": "inside", "set": []})
        require(status == 400 and not (runs / "ball" / "inside").exists(), f"no run inside of a run: {status} {body}")
    check_links(runs)
    taken = socket.create_server(("127.0.0.1", 0))
    refused = subprocess.run([WHIPPLE, "monitor", str(runs), "--port", str(taken.getsockname()[1])], capture_output=True, text=True)
    require(refused.returncode == 2 and "cannot be used" in refused.stderr, f"a port in use: {refused}")
    refused = subprocess.run([WHIPPLE, "monitor", str(FOLDER / "none")], capture_output=True, text=True)
    require(refused.returncode == 2 and "no such folder" in refused.stderr, f"a missing folder: {refused}")


try:
    main()
finally:
    end_runs_in(FOLDER)
