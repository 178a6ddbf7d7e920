# SPDX-License-Identifier: BSD-3-Clause
"""Chromium without a window, for tests of pages; where it is absent, a test says so and is skipped."""
import base64
import contextlib
import http.client
import json
import pathlib
import re
import shutil
import subprocess
import threading
import time

from checks import require

SKIPPED = 77  # exit code
ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # key of the WebDriver protocol
TAB, ENTER, RIGHT = "\ue004", "\ue007", "\ue014"  # keys of the WebDriver protocol


def programs():
    """Paths of the driver and of the browser; None, and a word about it, without both."""
    found = shutil.which("chromedriver"), shutil.which("chromium")
    if not all(found):
        print("SKIPPED: no Chromium here (Debian's packages chromium and chromium-driver)")
        return None
    return found


class Browser:
    """Chromium without a window, by the WebDriver protocol of W3C."""

    def __init__(self, driver, browser, profile):
        self.process = subprocess.Popen([driver, "--port=0"], stdout=subprocess.PIPE, text=True)
        port = None
        for line in self.process.stdout:
            if found := re.search(r"started successfully on port (\d+)", line):
                port = int(found[1])
                break
        require(port, "the driver of Chromium does not start")
        threading.Thread(target=self.process.stdout.read, daemon=True).start()
        self.connection = http.client.HTTPConnection("127.0.0.1", port, timeout=600)
        self.session = ""
        arguments = ["--headless=new", "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
                     "--disable-component-update", "--disable-sync", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                     "--window-size=1200,800", f"--user-data-dir={profile}"]
        options = {"browserName": "chrome", "goog:chromeOptions": {"binary": browser, "args": arguments},
                   "goog:loggingPrefs": {"browser": "ALL"}, "unhandledPromptBehavior": "ignore"}
        self.session = "/session/" + self.do("POST", "/session", {"capabilities": {"alwaysMatch": options}})["sessionId"]
        self.do("POST", "/timeouts", {"script": 500000})  # ms: a crowded machine draws slowly

    def __enter__(self):
        return self

    def __exit__(self, *_):
        with contextlib.suppress(Exception):
            self.do("DELETE", "")
        self.process.terminate()

    def do(self, method, path, body=None):
        text = None if method != "POST" else json.dumps(body or {})
        self.connection.request(method, self.session + path, text, {"Content-Type": "application/json"})
        answer = json.loads(self.connection.getresponse().read())["value"]
        if isinstance(answer, dict) and "error" in answer:
            raise RuntimeError(f"{answer['error']}: {answer['message'][:300]}")
        return answer

    def command(self, name, **parameters):
        """Gives a command of the DevTools protocol, for what the WebDriver protocol has not: sizes and colours of a device."""
        return self.do("POST", "/goog/cdp/execute", {"cmd": name, "params": parameters})

    def open(self, url):
        self.do("POST", "/url", {"url": url})

    def js(self, script, *arguments):
        return self.do("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def find(self, selector):
        return "/element/" + self.do("POST", "/element", {"using": "css selector", "value": selector})[ELEMENT]

    def click(self, selector):
        self.do("POST", self.find(selector) + "/click")

    def type(self, selector, text):
        self.do("POST", self.find(selector) + "/value", {"text": text})

    def text(self, selector):
        return self.js("return document.querySelector(arguments[0])?.textContent ?? ''", selector)

    def wait(self, script, what, seconds=60):
        deadline = time.monotonic() + seconds
        while not (found := self.js(script)):
            require(time.monotonic() < deadline, f"waited in vain for {what}; the page says: {self.js('return document.body.innerText')[:1500]}")
            time.sleep(0.2)
        return found

    def press(self, *keys):
        for key in keys:
            self.do("POST", "/actions", {"actions": [{"type": "key", "id": "keys", "actions": [
                {"type": "keyDown", "value": key}, {"type": "keyUp", "value": key}]}]})

    def focused(self):
        """Role and name of what has the focus, as a screen reader gets them; none of a page without focus."""
        if self.js("return document.activeElement === document.body || document.activeElement === null"):
            return None
        element = "/element/" + self.do("GET", "/element/active")[ELEMENT]
        return self.do("GET", element + "/computedrole"), self.do("GET", element + "/computedlabel")

    def tab_to(self, fits, what):
        """Goes to a control by the keyboard alone. @param fits  whether a role and a name are those of the control"""
        for _ in range(200):
            self.press(TAB)
            if (found := self.focused()) and fits(*found):
                return found
        require(False, f"no way by the keyboard to {what}")

    def picture(self, name):
        pathlib.Path(name).write_bytes(base64.b64decode(self.do("GET", "/screenshot")))

    def complaints(self):
        return [entry["message"] for entry in self.do("POST", "/se/log", {"type": "browser"}) if entry["level"] == "SEVERE"]
