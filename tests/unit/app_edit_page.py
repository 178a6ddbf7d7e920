#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The page of `whipple edit` as a browser asks for it: who may ask, texts that change, checks and previews, the file.

Usage: app_edit_page.py WHIPPLE CASE.toml FOLDER
"""
import http.client
import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import time

from checks import require
from page_server import PageServer

WHIPPLE, CASE, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])


class Editor(PageServer):
    """The server of the page of a case."""

    def __init__(self, case, *options):
        super().__init__(WHIPPLE, "edit", case, *options)

    def post(self, target, **wish):
        status, body = self.ask(target, json.dumps(wish))
        require(status in (200, 202), f"{target}: {status} {body[:300]}")
        return json.loads(body)

    def check(self, text):
        """What `whipple check` finds in a text, with the number of the job."""
        job = self.post("/check", text=text)["job"]
        deadline = time.monotonic() + 240
        while not (result := self.post("/result", job=job))["done"]:
            require(time.monotonic() < deadline, "the check does not end")
            time.sleep(0.1)
        return job, result


def check_access(editor):
    expectations = [
        ("the page", 200, "/", {"token": ""}), ("its script", 200, "/main.js", {"token": ""}),
        ("the viewer's module", 200, "/viewer/viewer.js", {"token": ""}), ("the monitor's", 200, "/monitor/server.js", {"token": ""}),
        ("the case", 200, "/case", {}), ("the case without key", 401, "/case", {"token": ""}),
        ("the case with a wrong key", 401, "/case", {"token": "0" * 32}), ("the schema without key", 401, "/schema", {"token": ""}),
        ("another name of the machine", 403, "/case", {"host": f"localhost:{editor.port}"}),
        ("another origin", 403, "/case", {"Origin": "http://evil.example"}),
        ("its own origin", 200, "/case", {"Origin": f"http://{editor.host}"}),
        ("a page of another site", 403, "/case", {"Sec_Fetch_Site": "cross-site"}),
        ("a path out of the folder", 404, "/../src/app/main.cpp", {}), ("a file as a path", 404, "/case.toml", {}),
        ("nothing", 404, "/nothing", {}), ("a form", 415, "/save", {"body": "a=b", "Content_Type": "application/x-www-form-urlencoded"}),
        ("a post without key", 401, "/save", {"body": "{}", "token": ""}), ("no JSON", 400, "/save", {"body": "{"}),
        ("JSON of another kind", 400, "/edit", {"body": "[1]"}), ("a text that is none", 400, "/parse", {"body": '{"text": 3}'}),
        ("a text that is too long", 400, "/parse", {"body": json.dumps({"text": "#" * 600_000})}),
        ("a post that is too long", 413, "/parse", {"body": " " * 2_100_000}),
        ("a case that is a path", 400, "/start", {"body": '{"case": "../../etc"}'}),
        ("a job that was never started", 400, "/result", {"body": '{"job": 7}'}),
    ]
    for what, status, target, heads in expectations:
        found, body = editor.ask(target, **heads)
        require(found == status, f"{what}: {found} instead of {status}, {body[:200]}")
    editor.ask("/")
    require("default-src 'none'" in editor.heads.get("Content-Security-Policy", ""), "policy")
    require("Access-Control-Allow-Origin" not in editor.heads, "no other origin may read")


def check_checks(editor, text):
    job, result = editor.check(text)
    require(result["faults"] == [] and result["cloud"] and result["check"]["particles"] > 0, f"a right case: {result}")
    status, cloud = editor.ask("/cloud", json.dumps({"job": job}))
    length = struct.unpack("<I", cloud[4:8])[0]
    require(status == 200 and cloud[:4] == b"WPV1" and json.loads(cloud[8:8 + length])["n"] == result["check"]["particles"], "the preview")
    wrong = editor.post("/edit", text=text, acts=[{"act": "set", "key": "domain.cell_size", "value": '"-1 mm"'},
                                                  {"act": "set", "key": "body.0.material", "value": '"unobtainium.toml"'}])["text"]
    faults = editor.check(wrong)[1]["faults"]
    lines = wrong.splitlines()
    require({fault["key"] for fault in faults} >= {"domain.cell_size", "body.0.material"}, f"keys of the faults: {faults}")
    for fault in faults:
        if fault["key"] == "domain.cell_size":
            require("-1 mm" in lines[fault["line"] - 1] and "> 0" in fault["text"], f"{fault}")
    large = editor.post("/edit", text=text, acts=[{"act": "set", "key": "domain.cell_size", "value": '"0.04 mm"'}])["text"]
    result = editor.check(large)[1]
    require(result["faults"] == [] and "not built" in result["check"]["unbuilt"] and not result["cloud"], f"a large case: {result}")


def main():
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    case = FOLDER / "case.toml"
    shutil.copy(CASE, case)
    with Editor(case) as editor:
        check_access(editor)
        content = json.loads(editor.ask("/case")[1])
        require(content["text"] == CASE.read_text() and content["exists"] and len(content["suggestions"]["material"]) > 20, "the case")
        schema = json.loads(editor.ask("/schema")[1])
        require(list(schema["properties"])[:3] == ["title", "domain", "time"], "keys in the order of the tables")
        require(len(json.loads(editor.ask("/library")[1])["cases"]) > 30, "the library")
        check_checks(editor, content["text"])
        start = editor.post("/start", case="copper_disk_on_aluminium")["text"]
        require("copper" in start, "a case of the library")
        os.chmod(case, 0o640)
        digest = editor.post("/save", text=start, digest=content["digest"])["digest"]
        require(case.read_text() == start and case.stat().st_mode & 0o777 == 0o640, "the file")
        case.write_text("# of another program\n")
        status, _ = editor.ask("/save", json.dumps({"text": start, "digest": digest}))
        require(status == 409 and case.read_text() == "# of another program\n", "the file of another program stays")
    with Editor(FOLDER / "new.toml", "--idle", "100000") as editor:
        require(json.loads(editor.ask("/case")[1])["exists"] is False, "a new file")
    require(not (FOLDER / "new.toml").exists(), "nothing is written unasked")
    for wrong in ["none/new.toml", "new.txt"]:
        done = subprocess.run([WHIPPLE, "edit", FOLDER / wrong], capture_output=True, text=True, timeout=60)
        require(done.returncode == 2 and done.stderr, f"{wrong}: {done}")
    return 0


sys.exit(main())
