#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The page of `whipple edit` in Chromium: a case is made from the form alone, saved, run and opened; text, form, faults and
picture follow one another; the keyboard alone is enough. Skipped without Chromium and its driver.

Usage: app_edit_browser.py WHIPPLE FOLDER
"""
import json
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tomllib

from checks import require
from chromium import ENTER, SKIPPED, TAB, Browser, programs

WHIPPLE, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
TEXT = "document.querySelector('#text').value"


def control(path):
    return f'[data-focus="{path}"]'


def open_part(browser, path):
    browser.js("const part = document.querySelector(arguments[0]); if (!part.open) part.querySelector('summary').click()", f'details[data-path="{path}"]')


def fill(browser, path, text, shows=None):
    """Types a value into the form and waits until the text of the case has it."""
    for attempt in range(5):  # the form may be made anew between the look for a control and its use
        browser.wait(f"return document.querySelector({json.dumps(control(path))}) !== null", f"the control of {path}")
        browser.js("const box = document.querySelector(arguments[0]); box.value = ''; box.scrollIntoView({ block: 'center' })", control(path))
        try:
            browser.type(control(path), text + TAB)
            break
        except RuntimeError as error:
            require("stale" in str(error) and attempt < 4, str(error))
    if shows is not None:
        browser.wait(f"return {TEXT}.includes({json.dumps(shows)})", f"{shows} in the text")


def fill_vector(browser, path, values, shows):
    for axis, value in enumerate(values):
        fill(browser, f"{path} {axis}", value)
    browser.wait(f"return {TEXT}.includes({json.dumps(shows)})", f"{shows} in the text")


def choose(browser, path, value, shows):
    browser.wait(f"return document.querySelector({json.dumps(control(path))}) !== null", f"the control of {path}")
    browser.js("const list = document.querySelector(arguments[0]); list.value = arguments[1]; list.dispatchEvent(new Event('change'))", control(path), value)
    browser.wait(f"return {TEXT}.includes({json.dumps(shows)})", f"{shows} in the text")


def press(browser, name):
    browser.js("[...document.querySelectorAll('button')].find((each) => each.textContent === arguments[0]).click()", name)


def state(browser, word):
    browser.wait(f"return document.querySelector('#preview').dataset.state === {json.dumps(word)}", f"a preview that is {word}", 240)


def make_case(browser):
    """A ball and a plate, by the form alone."""
    press(browser, "Start from nothing")
    fill(browser, "title", "made by the form", "made by the form")
    for part in ("domain", "time", "output"):
        open_part(browser, part)
    fill_vector(browser, "domain.lower", ["-4 mm", "-4 mm", "-4 mm"], 'lower = ["-4 mm"')
    fill_vector(browser, "domain.upper", ["4 mm", "4 mm", "4 mm"], 'upper = ["4 mm"')
    fill(browser, "domain.cell_size", "0.5 mm", 'cell_size = "0.5 mm"')
    fill(browser, "time.end", "0.4 us", 'end = "0.4 us"')
    fill(browser, "output.snapshot_every", "0.2 us", "snapshot_every")
    for number, (name, material) in enumerate([("ball", "copper_johnson_cook.toml"), ("plate", "aluminium_6061_t6.toml")]):
        press(browser, "Add body")
        fill(browser, f"body.{number}.name", name, f'name = "{name}"')
        fill(browser, f"body.{number}.material", material, material)
    choose(browser, "body.0.shape", "sphere", "sphere")
    fill_vector(browser, "body.0.shape.sphere.center", ["0", "0", "-1.5 mm"], "-1.5 mm")
    fill(browser, "body.0.shape.sphere.radius", "1 mm", 'radius = "1 mm"')
    choose(browser, "body.1.shape", "box", "box")
    fill_vector(browser, "body.1.shape.box.lower", ["-3 mm", "-3 mm", "0 mm"], "-3 mm")
    fill_vector(browser, "body.1.shape.box.upper", ["3 mm", "3 mm", "1 mm"], "3 mm")
    fill_vector(browser, "body.0.velocity", ["0", "0", "3 km/s"], "3 km/s")
    state(browser, "right")
    browser.wait("return document.querySelector('#viewer canvas') !== null", "the picture")


def check_faults(browser):
    """A wrong value is told beside its key and beside its line, with what is accepted; the text goes into the form."""
    fill(browser, "domain.cell_size", "-0.5 mm", '"-0.5 mm"')
    state(browser, "faulty")
    browser.wait("return /> 0/.test(document.querySelector('[data-key=\"domain.cell_size\"] .fault')?.textContent ?? '')", "the fault of the key")
    line = browser.js(f"return {TEXT}.split('\\n').findIndex((each) => each.includes('cell_size')) + 1")
    marked = browser.js("return [...document.querySelectorAll('.lines .fault .number')].map((each) => Number(each.textContent))")
    require(marked == [line], f"lines {marked} are marked, the fault is in {line}")
    require(browser.js(f"return document.querySelector({json.dumps(control('domain.cell_size'))}).getAttribute('aria-invalid')") == "true", "told to readers")
    browser.picture(FOLDER / "fault.png")
    browser.click("#text")
    browser.do("POST", "/actions", {"actions": [{"type": "key", "id": "keys", "actions": [
        {"type": "keyDown", "value": "\ue009"}, {"type": "keyDown", "value": "z"}, {"type": "keyUp", "value": "z"}, {"type": "keyUp", "value": "\ue009"}]}]})
    browser.wait(f"return {TEXT}.includes('cell_size = \"0.5 mm\"')", "the text before, by Ctrl+Z")
    browser.js("const area = document.querySelector('#text'); area.value = '# By hand.\\n' + area.value.replace('0.4 us', '0.5 us'); area.dispatchEvent(new Event('input'))")
    browser.wait(f"return document.querySelector({json.dumps(control('time.end'))})?.value === '0.5 us'", "what was typed, in the form")
    fill(browser, "time.courant", "0.3", "courant = 0.3")
    require("# By hand." in browser.js(f"return {TEXT}"), "the comment stays")
    browser.js("document.querySelector('[aria-label=\"Remove time.courant\"]').click()")
    browser.wait(f"return !{TEXT}.includes('courant')", "the key removed")
    browser.js("const area = document.querySelector('#text'); area.value += '= wrong'; area.dispatchEvent(new Event('input'))")
    browser.wait("return document.querySelector('fieldset.tables').disabled && document.querySelector('#faults li') !== null", "a form that waits")
    press(browser, "Undo")
    browser.wait("return !document.querySelector('fieldset.tables').disabled", "the form goes on")
    state(browser, "right")


def check_keyboard(browser):
    """The tab key reaches everything; each control has a role and a name."""
    browser.js("document.activeElement?.blur(); document.body.tabIndex = -1; document.body.focus(); document.body.removeAttribute('tabindex')")
    count = browser.js("""return [...document.querySelectorAll('button, input, select, textarea, summary, a[href], [tabindex="0"]')].filter(
      (one) => !one.disabled && one.checkVisibility({ visibilityProperty: true }) && one.getClientRects().length > 0).length""")
    unnamed, reached = [], 0
    for _ in range(count):
        browser.press(TAB)
        found = browser.js("""const one = document.activeElement;
          return [one.tagName, one.getAttribute('aria-label') ?? one.labels?.[0]?.textContent ?? one.textContent]""")
        reached += 1 if found[0] != "BODY" else 0
        if not found[1].strip():
            unnamed.append(found)
    require(not unnamed and reached == count, f"{reached} of {count} controls, without a name: {unnamed}")


def check_conflict(browser, case):
    text = case.read_text()
    case.write_text(text + "# another program\n")
    fill(browser, "time.end", "0.3 us", 'end = "0.3 us"')
    press(browser, "Save")
    browser.wait("return !document.querySelector('#question').hidden", "the question")
    require(case.read_text() == text + "# another program\n", "the other program's file stays")
    browser.press(ENTER)  # the first answer has the focus
    browser.wait(f"return {TEXT}.includes('# another program')", "the file's text")
    require(browser.js("return document.querySelector('#saved').textContent") == "saved", "it is that of the file")


def main():
    found = programs()
    if found is None:
        return SKIPPED
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    case = FOLDER / "new.toml"
    editor = subprocess.Popen([WHIPPLE, "edit", str(case)], stdout=subprocess.PIPE, text=True)
    try:
        address = re.search(r"(http://[0-9.:]+/#[0-9a-f]+) ", editor.stdout.readline())[1]
        with Browser(*found, FOLDER / "profile") as browser:
            browser.do("POST", "/window/rect", {"width": 1500, "height": 950})
            browser.open(address)
            browser.wait("return document.querySelector('#start select')?.options.length > 30", "the library")
            require(not case.exists(), "nothing is written unasked")
            make_case(browser)
            browser.picture(FOLDER / "light.png")
            require(browser.js("return document.querySelector('#saved').textContent") == "not saved", "it tells that it is not saved")
            press(browser, "Save")
            browser.wait("return document.querySelector('#saved').textContent === 'saved'", "the file")
            made = tomllib.loads(case.read_text())
            require([body["name"] for body in made["body"]] == ["ball", "plate"] and made["body"][0]["velocity"][2] == "3 km/s", f"{made}")
            done = subprocess.run([WHIPPLE, "run", case, "-o", FOLDER / "run", "--quiet", "--threads", "1"], capture_output=True, text=True)
            require(done.returncode == 0, f"the case runs: {done.stderr}")
            check_faults(browser)
            press(browser, "Save")
            browser.wait("return document.querySelector('#saved').textContent === 'saved'", "the file again")
            check_conflict(browser, case)
            check_keyboard(browser)
            complaints = [line for line in browser.complaints() if "status of 409" not in line]
            require(not complaints, f"the console complains: {complaints}")
            state(browser, "right")
            browser.do("POST", "/goog/cdp/execute", {"cmd": "Emulation.setEmulatedMedia", "params": {"features": [{"name": "prefers-color-scheme", "value": "dark"}]}})
            browser.picture(FOLDER / "dark.png")
            browser.do("POST", "/goog/cdp/execute", {"cmd": "Emulation.setDeviceMetricsOverride", "params": {"width": 390, "height": 844, "deviceScaleFactor": 1, "mobile": True}})
            browser.wait("return window.innerWidth <= 400", "the width of a phone")
            wide = browser.js("return document.documentElement.scrollWidth - window.innerWidth")
            require(wide <= 1, f"{wide} pixels too wide for a phone")
            browser.picture(FOLDER / "phone.png")
            browser.js("document.querySelector('#form').scrollIntoView()")
            browser.picture(FOLDER / "phone_form.png")
            browser.do("POST", "/goog/cdp/execute", {"cmd": "Emulation.clearDeviceMetricsOverride", "params": {}})
            subprocess.run([WHIPPLE, "view", FOLDER / "run", "-o", FOLDER / "view.html", "--quiet"], check=True)
            browser.open((FOLDER / "view.html").as_uri())
            browser.wait("return window.whippleViewer !== undefined", "the run")
            names = browser.js("return window.whippleViewer.cloud.head.bodies.map((body) => body.name)")
            require(names == ["ball", "plate"], f"the bodies of the run: {names}")
            browser.picture(FOLDER / "run.png")
    finally:
        editor.send_signal(signal.SIGTERM)
        editor.wait(20)
    return 0


sys.exit(main())
