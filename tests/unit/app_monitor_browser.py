#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The monitor's page in Chromium: a run is started, watched, paused, changed, ended and continued by the controls of the
page; a page of another origin can neither read nor change anything. Skipped without Chromium and its driver.

Usage: app_monitor_browser.py WHIPPLE CASE.toml FOLDER
"""
import http.server
import json
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import threading
import time

from checks import require
from chromium import ENTER, RIGHT, SKIPPED, TAB, Browser, programs
from processes import end_runs_in

WHIPPLE, CASE, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])


FOREIGN = """<!doctype html><title>foreign</title><script>
async function tries(base, key) {
  const results = [];
  for (const [path, options] of [['/runs', { headers: { 'X-Whipple-Token': key } }], ['/', {}], ['/runs', { mode: 'no-cors' }],
    ['/steer', { method: 'POST', mode: 'no-cors', body: '{"run": "steady", "request": "pause", "value": ""}' }],
    ['/steer', { method: 'POST', headers: { 'X-Whipple-Token': key, 'Content-Type': 'application/json' }, body: '{"run": "steady", "request": "pause", "value": ""}' }]]) {
    try { const answer = await fetch(base + path, options); results.push(answer.type === 'opaque' ? 'opaque' : 'read ' + await answer.text()); }
    catch (error) { results.push('refused'); }
  }
  return results;
}
</script>"""


class ForeignPage(http.server.BaseHTTPRequestHandler):
    def do_GET(self):
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.end_headers()
        self.wfile.write(FOREIGN.encode())

    def log_message(self, *_):
        pass


def check_foreign_page(browser, address, key, run):
    """@param run  a run that goes on, which would follow a request"""
    server = http.server.HTTPServer(("127.0.0.1", 0), ForeignPage)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    browser.open(f"http://127.0.0.1:{server.server_port}/")
    browser.js("tries(arguments[0], arguments[1]).then((all) => { window.tried = all; })", address, key)
    browser.wait("return window.tried !== undefined", "the foreign page")
    tried = browser.js("return window.tried")
    require(not any(result.startswith("read") for result in tried), f"a foreign page reads: {tried}")
    time.sleep(1.5)  # a run looks once a second
    require(not (run / "steering.csv").exists() and not list((run / "control").iterdir()), "a foreign page asks something of a run")
    require(json.loads((run / "status.json").read_text())["state"] == "running", "a foreign page pauses a run")
    server.shutdown()
    browser.complaints()  # its own refusals are no fault


# Everything that a person can use and see, in the order of the page.
CONTROLS = """return [...document.querySelectorAll('button, input, select, textarea, summary, a[href], [tabindex="0"]')].filter(
  (one) => !one.disabled && one.checkVisibility({ visibilityProperty: true }) && one.getClientRects().length > 0).map((one) => one.tagName)"""
ROLES = {"button", "textbox", "combobox", "checkbox", "slider", "DisclosureTriangle", "application", "img", "image", "log", "link",
         "listbox", "spinbutton", "region"}


def check_keyboard(browser, what):
    """The tab key reaches every control in the order of the page, each with a role and a name; back again with shift."""
    browser.js("document.activeElement?.blur(); window.getSelection().removeAllRanges(); window.scrollTo(0, 0)")
    browser.js("document.body.tabIndex = -1; document.body.focus(); document.body.removeAttribute('tabindex')")
    expected, tags, reached = browser.js(CONTROLS), [], []
    require(len(expected) > 5, f"{what}: {len(expected)} controls")
    for _ in expected:
        browser.press(TAB)
        found = browser.focused()
        require(found is not None, f"{what}: the focus is lost after {reached[-3:]}")
        reached.append(found)
        tags.append(browser.js("return document.activeElement.tagName"))
    require(tags == expected, f"{what}: the tab key goes through {tags}, the page has {expected}")
    require(all(role in ROLES and name.strip() for role, name in reached), f"{what}: a control without role or name in {reached}")
    browser.press(TAB)
    require(browser.focused() != reached[-1], f"{what}: no way out of {reached[-1]}")


def check_run(browser, address, key):
    running = "document.querySelector('#run .state')?.textContent"
    browser.open(f"{address}/#{key}")
    browser.wait("return document.querySelector('details summary') !== null", "the form of cases")
    require(browser.js("return location.hash") == "", "the key is out of the address bar")
    browser.click("nav details summary")
    browser.type("nav details input", "ball")
    browser.type("nav textarea", "domain.cell_size='0.5 mm'\ntime.end='6 us'\noutput.snapshot_every='0.04 us'")
    browser.click("nav form button")
    browser.wait(f"return {running} === 'running'", "the run")
    browser.wait("return document.querySelectorAll('.plot li').length > 5", "the curves")
    energy = browser.text(".plot li")
    browser.wait(f"return document.querySelector('.plot li').textContent !== {json.dumps(energy)}", "a curve that moves")
    browser.wait("return /particles in three dimensions/i.test(document.querySelector('#viewer canvas')?.getAttribute('aria-label') ?? '')", "the snapshots")
    at = browser.text("#viewer footer output")
    browser.wait(f"return document.querySelector('#viewer footer output').textContent !== {json.dumps(at)}", "a later snapshot")
    browser.tab_to(lambda _, name: name == "pause", "the pause")
    browser.press(ENTER)
    browser.wait(f"return {running} === 'paused'", "the pause")
    browser.picture(FOLDER / "paused.png")
    require(browser.js("return document.querySelector('#run .state').getAttribute('role')") == "status", "the state is told")
    check_keyboard(browser, "the monitor")
    before = browser.tab_to(lambda role, _: role == "application", "the picture")[1]
    browser.press("f")
    browser.wait(f"return document.activeElement.getAttribute('aria-label') !== {json.dumps(before)}", "another field by the key f")
    browser.press(RIGHT)
    browser.js("const select = document.querySelector('header select'); select.value = 'snapshot_every'; select.dispatchEvent(new Event('change'))")
    browser.type("header form input", "3 kg")
    browser.click("header form button")
    browser.wait("return /Not asked:.*unit/.test(document.querySelector('header').innerText)", "the refusal of a wrong unit")
    browser.js("document.querySelector('header form input').value = ''")
    browser.type("header form input", "0.01 us")
    browser.click("header form button")
    browser.wait("return /snapshot_every 0.01 us.*accepted/s.test(document.querySelector('[aria-label=Answers]').innerText)", "the answer")
    browser.tab_to(lambda _, name: name == "resume", "the end of the pause")
    browser.press(" ")
    browser.wait(f"return {running} === 'running'", "the run after the pause")
    browser.click("[data-act=stop]")
    browser.wait("return document.querySelector('[data-act=restart]') !== null", "the stop")
    browser.click("[data-act=restart]")
    browser.wait(f"return {running} === 'running'", "the run continued")
    browser.click("[data-act=end]")
    browser.do("POST", "/alert/accept")
    browser.wait(f"return {running} === 'stopped' || {running} === 'done'", "its end")
    browser.picture(FOLDER / "ended.png")
    unnamed = browser.js("""return [...document.querySelectorAll('button, input, select, textarea, canvas')].filter((one) =>
      !(one.labels?.length || one.getAttribute('aria-label') || one.textContent.trim() || one.type === 'file')).map((one) => one.outerHTML)""")
    require(not unnamed, f"controls without a name: {unnamed}")
    complaints = [line for line in browser.complaints() if "status of 400" not in line]  # that of the wrong unit
    require(not complaints, f"the console complains: {complaints}")


def main():
    found = programs()
    if found is None:
        return SKIPPED
    shutil.rmtree(FOLDER, ignore_errors=True)
    cases, runs = FOLDER / "cases", FOLDER / "runs"
    (cases / "small_impact").mkdir(parents=True)
    shutil.copy(CASE, cases / "small_impact" / "case.toml")
    runs.mkdir()
    monitor = subprocess.Popen([WHIPPLE, "monitor", str(runs), "--cases", str(cases)], stdout=subprocess.PIPE, text=True)
    try:
        address, key = re.search(r"(http://[0-9.:]+)/#([0-9a-f]+) ", monitor.stdout.readline()).groups()
        with Browser(*found, FOLDER / "profile") as browser:
            check_run(browser, address, key)
            closed = [f"domain.boundary.{axis}_{side}=symmetry" for axis in "xyz" for side in ("lower", "upper")]  # nothing leaves: it goes on
            steady = subprocess.Popen([WHIPPLE, "run", CASE, "-o", runs / "steady", "--quiet", "--threads", "1",
                                       *[word for key in ("time.end=1 s", "output.snapshot_every=1 ms", *closed) for word in ("--set", key)]])
            while not (runs / "steady" / "history.csv").exists():
                require(steady.poll() is None, "the steady run ends")
                time.sleep(0.05)
            check_foreign_page(browser, address, key, runs / "steady")
            steady.terminate()
            steady.wait(20)
            subprocess.run([WHIPPLE, "view", runs / "ball", "-o", FOLDER / "view.html", "--quiet"], check=True)
            browser.open((FOLDER / "view.html").as_uri())
            browser.wait("return document.querySelector('footer output') !== null", "the view")
            check_keyboard(browser, "the view")
            browser.picture(FOLDER / "view.png")
    finally:
        end_runs_in(runs)
        monitor.send_signal(signal.SIGTERM)
        monitor.wait(10)
    return 0


sys.exit(main())
