#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""`whipple check --preview` of every case in Chromium: a page of less than 20 MB that opens from its file, asks for no other,
and picks the particle that is seen at ten places. Skipped without Chromium.

Usage: preview_cases.py WHIPPLE CASES_FOLDER FOLDER [CASE...]
"""
import pathlib
import shutil
import subprocess
import sys
import time
import tomllib

from checks import require
from chromium import SKIPPED, Browser, programs

WHIPPLE, CASES, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
MOST_BYTES, PLACES = 20e6, 10
# Looks along an axis at the model without its copies, clicks where particles are, and tells the numbers of what was picked
# and of what must be seen there: by the places of all discs, computed here.
PICKS = """
const [seed, count] = arguments, viewer = window.whippleViewer, { cloud, state, canvas } = viewer, { head } = cloud;
state.completed = false;
viewer.reset();
state.camera.side = [0, 1];  // along the third axis, wherever the projectile comes from
viewer.setView('front');
viewer.updateReach();
const { camera } = state, right = (camera.up + 2) % 3, toEye = (camera.up + 1) % 3, aspect = canvas.width / canvas.height;
const focal = Math.min(aspect, 1) / Math.tan(0.35), eye = camera.radius / Math.sin(0.35) / camera.zoom;
const place = (axis, i) => head.lower[axis] + (head.upper[axis] - head.lower[axis]) * cloud.position[axis][i] / 65535 - camera.centre[axis];
const bodies = cloud.fields.get('body').plane;
const enlarged = state.size * head.one_of ** (1 / (head.dimension === '3d' ? 3 : 2));
const disc = (i) => {
  const depth = eye - place(toEye, i), scale = canvas.height / 2 * focal / depth;
  return { depth, x: canvas.width / 2 + scale * place(right, i), y: canvas.height / 2 - scale * place(camera.up, i),
           radius: Math.min(Math.max(scale * enlarged * head.bodies[bodies[i]].spacing / 2, 0.5), 127) };
};
const results = [];
let random = seed;
for (let tries = 0; results.length < count && tries < 20 * count; ++tries) {
  random = (random * 1103515245 + 12345) % 2147483648;
  const aim = disc(random % cloud.n), x = Math.floor(aim.x), y = Math.floor(aim.y);
  viewer.pickAt((x + 0.5) / canvas.width, (y + 0.5) / canvas.height);
  const ids = cloud.fields.get('id').plane, picked = state.picked === null ? -1 : ids.indexOf(state.picked.id);
  if (picked < 0) {  // a disc smaller than a pixel may cover no middle of one
    if (aim.radius > 1) results.push('nothing');
    continue;
  }
  const seen = disc(picked), way = (d) => Math.hypot(d.x - x - 0.5, d.y - y - 0.5);
  let hiding = -1;  // another body, clearly in front
  for (let i = 0; i < cloud.n; ++i) {
    if (bodies[i] === bodies[picked]) continue;
    const other = disc(i);
    if (way(other) < other.radius - 1 && other.depth < seen.depth * (1 - 1e-4)) hiding = i;
  }
  const told = viewer.pickedRows().flat().join(' ');
  results.push(way(seen) > seen.radius + 1 ? `a particle ${way(seen)} pixels away` : hiding >= 0 ? `behind particle ${hiding}`
    : told.includes(head.bodies[bodies[picked]].name) ? 'right' : `the table tells ${told}`);
}
return results;
"""


def check(browser, case):
    page = FOLDER / f"{case.name}.html"
    begin = time.monotonic()
    done = subprocess.run([WHIPPLE, "check", case / "case.toml", "--preview", page, "--threads", "1", "--quiet"],
                          capture_output=True, text=True)
    require(done.returncode == 0, f"{case.name}: {done.stderr}")
    size = page.stat().st_size
    require(size < MOST_BYTES, f"{case.name}: {size / 1e6} MB")
    browser.open(page.as_uri())
    browser.wait("return window.whippleViewer !== undefined || document.querySelector('[role=alert]') !== null", case.name, 120)
    require(not browser.js("return document.querySelector('[role=alert]')?.textContent ?? ''"), f"{case.name}: the page gives up")
    bodies = [body["name"] for body in tomllib.loads((case / "case.toml").read_text())["body"]]
    require(browser.js("return window.whippleViewer.cloud.head.bodies.map((body) => body.name)") == bodies, f"{case.name}: bodies")
    results = browser.js(PICKS, 7, PLACES)
    require(results == ["right"] * PLACES, f"{case.name}: {results}")
    complaints = browser.complaints()
    require(not complaints, f"{case.name}: the console complains: {complaints}")
    particles = browser.js("return window.whippleViewer.cloud.n")
    print(f"{case.name}: {size / 1e6:.1f} MB, {particles} particles, {time.monotonic() - begin:.0f} s", flush=True)
    page.unlink()


def main():
    found = programs()
    if found is None:
        return SKIPPED
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    cases = sorted(path.parent for path in CASES.glob("*/case.toml"))
    require(len(cases) > 30, f"{len(cases)} cases")
    if sys.argv[4:]:
        cases = [case for case in cases if case.name in sys.argv[4:]]
    with Browser(*found, FOLDER / "profile") as browser:
        for case in cases:
            check(browser, case)
    return 0


sys.exit(main())
