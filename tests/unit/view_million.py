#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A million particles in the page of `whipple view`: all of them in less than 12 MB; while the picture moves it is drawn at
least four times as fast as with all particles, in the same browser. Prints what was measured. Skipped without Chromium.

Usage: view_million.py WHIPPLE IO_SYNTHETIC_CLOUD FOLDER
"""
import pathlib
import shutil
import statistics
import subprocess
import sys

from checks import require
from chromium import SKIPPED, Browser, programs

WHIPPLE, MAKER, FOLDER = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
MOST_BYTES, LEAST_RATIO = 12e6, 4.0
# One frame with all particles, or as while moving; waits for the pixels. Returns ms.
FRAME = """
const { picture, cloud, state } = window.whippleViewer, gl = picture.gl, start = performance.now();
if (arguments[0]) picture.drawMoving(cloud, state); else picture.draw(cloud, state);
gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
return performance.now() - start;
"""
FACTS = """
const { picture, cloud } = window.whippleViewer, gl = picture.gl, info = gl.getExtension('WEBGL_debug_renderer_info');
return { particles: cloud.n, of: cloud.head.of, budget: picture.budget,
  renderer: info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : 'unknown' };
"""


def measure(browser):
    """Median times of a frame (ms) with all particles and while moving, alternately, after it has learnt how many it can."""
    for _ in range(6):
        browser.js(FRAME, True)
    times = [(browser.js(FRAME, False), browser.js(FRAME, True)) for _ in range(3)]
    return [statistics.median(each) for each in zip(*times)]


def main():
    found = programs()
    if found is None:
        return SKIPPED
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    run, page = FOLDER / "run", FOLDER / "million.html"
    subprocess.run([MAKER, run, "1000000", "2"], check=True, capture_output=True)
    subprocess.run([WHIPPLE, "view", run, "-o", page, "--times", "1", "--bits", "8", "--megabytes", str(1e-6 * MOST_BYTES), "--quiet"], check=True)
    size = page.stat().st_size
    with Browser(*found, FOLDER / "profile") as browser:
        browser.open(page.as_uri())
        browser.wait("return window.whippleViewer !== undefined || document.querySelector('[role=alert]') !== null", "the page", 120)
        every, moving = measure(browser)
        measured = browser.js(FACTS)
        browser.picture(FOLDER / "million.png")
        complaints = browser.complaints()
    ratio = every / moving
    print(f"{measured['particles']} particles, page of {size / 1e6:.2f} MB; all {every:.0f} ms, while moving "
          f"{moving:.0f} ms (at most {measured['budget']:.0f} points): {ratio:.1f} times as fast; {measured['renderer']}")
    require(measured["particles"] == measured["of"] >= 999000, f"{measured['particles']} of {measured['of']} particles")
    require(size < MOST_BYTES, f"the page has {size} bytes")
    require(ratio >= LEAST_RATIO, f"only {ratio:.2f} times as fast")
    require(not complaints, f"the console complains: {complaints}")
    return 0


sys.exit(main())
