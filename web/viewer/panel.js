// SPDX-License-Identifier: BSD-3-Clause
// The controls beside the picture and the bar of times below it.
import { MAP_NAMES } from './colours.js';
import { choice, element, labelled, numberBox, slider, tickBox } from './elements.js';
import { titleOf } from './legend.js';
import { quantity, typedNumber } from './numbers.js';
import { completedBox, completionOf } from './copies.js';
import { setField, shownFields } from './viewer.js';

const PLAY_INTERVAL = 100;  // ms
const AXES = [['0', 'x'], ['1', 'y'], ['2', 'z']];
const KEYS = [['Arrows', 'turn; with Shift move'], ['+ and −', 'zoom'], [', and .', 'time before, next time'], ['Space', 'play, stop'],
  ['f and F', 'next field, field before'], ['Enter', 'pick the particle in the middle'], ['1 to 4', 'oblique, front, side, top'], ['r', 'all of it']];

/** Limits of a field as two boxes; what is typed is in the unit of the field. */
function rangeBoxes(unit, limits, set) {
  const box = (text, side) => numberBox(`${text}${unit && unit !== '1' ? ` [${unit}]` : ''}`, String(Number(limits[side].toPrecision(5))), (typed) => {
    const value = typedNumber(typed);
    if (!Number.isFinite(value)) return false;
    limits[side] = value;
    set(limits);
    return true;
  });
  return [box('From', 0), box('To', 1)];
}

function fieldControls(viewer, renew) {
  const { state, cloud } = viewer, field = cloud.fields.get(state.field);
  const fields = shownFields(cloud).map((each) => [each.name, titleOf(each)]);
  const apply = (share) => {
    setField(state, cloud, state.field, share);
    renew();
  };
  const controls = [
    element('h2', {}, 'Colours'),
    labelled('Field', choice(fields, state.field, (name) => {
      setField(state, cloud, name);
      renew();
    })),
    element('p', { class: 'note' }, field.meaning),
  ];
  if (field.codes) return controls;
  const logarithmic = tickBox(state.logarithmic, (ticked) => {
    state.logarithmic = ticked;
    viewer.changed();
  });
  logarithmic.disabled = state.range[0] <= 0;
  return [...controls,
    labelled('Map', choice(MAP_NAMES.map((name) => [name, name]), state.map, (name) => {
      state.map = name;
      viewer.changed();
    })),
    ...rangeBoxes(field.unit, [...state.range], (range) => {
      state.range = [...range];
      viewer.changed();
    }),
    element('p', {}, element('button', { type: 'button', click: () => apply(0.01) }, '1 to 99 % of this time'), ' ',
            element('button', { type: 'button', click: () => apply(0) }, 'all of it')),
    labelled('Logarithmic', logarithmic)];
}

function bodyControls(viewer) {
  const { hidden } = viewer.state;
  return [element('h2', {}, 'Bodies'), ...viewer.cloud.head.bodies.map((body, i) => labelled(body.name, tickBox(!hidden.has(i), (ticked) => {
    if (ticked) hidden.delete(i); else hidden.add(i);
    viewer.redraw();
  })))];
}

function sieveControls(viewer, renew) {
  const { state, cloud } = viewer;
  const choose = (name) => {
    const field = cloud.fields.get(name);
    state.sieve = name === '' ? null : { field: name, lowest: field.codes ? 0 : field.lo, highest: field.codes ? 255 : field.hi };
    renew();
  };
  const fields = shownFields(cloud).map((field) => [field.name, titleOf(field)]);
  const controls = [element('h2', {}, 'Only particles with'), labelled('Field', choice([['', 'any value'], ...fields], state.sieve?.field ?? '', choose))];
  if (!state.sieve) return controls;
  const field = cloud.fields.get(state.sieve.field);
  return [...controls, ...(field.codes ? [element('p', { class: 'note' }, field.meaning)] : []),
    ...rangeBoxes(field.unit, [state.sieve.lowest, state.sieve.highest], ([lowest, highest]) => {
      Object.assign(state.sieve, { lowest, highest });
      viewer.redraw();
    })];
}

function sectionControls(viewer, renew) {
  const { state, cloud } = viewer;
  const { lower, upper } = completedBox(cloud.head, completionOf(cloud.head, state.completed));
  const choose = (word) => {
    const axis = Number(word);
    state.section = word === '' ? null : { axis, at: (lower[axis] + upper[axis]) / 2, side: 1 };
    renew();
  };
  const controls = [element('h2', {}, 'Section'), labelled('Normal to', choice([['', 'none'], ...AXES], String(state.section?.axis ?? ''), choose))];
  if (!state.section) return controls;
  const { axis } = state.section, size = upper[axis] - lower[axis];
  const place = element('output', {}, quantity(state.section.at, 'm'));
  const at = slider(lower[axis], upper[axis], size > 0 ? size / 500 : 'any', state.section.at, (value) => {
    state.section.at = value;
    place.textContent = quantity(value, 'm');
    at.setAttribute('aria-valuetext', place.textContent);
    viewer.redraw({ moving: true });
  });
  at.setAttribute('aria-valuetext', place.textContent);
  return [...controls, labelled(`At ${'xyz'[axis]}`, at), place,
    labelled('Keep the other side', tickBox(state.section.side < 0, (ticked) => {
      state.section.side = ticked ? -1 : 1;
      viewer.changed();
    }))];
}

function sceneControls(viewer, renew) {
  const { state, cloud } = viewer;
  const controls = [element('h2', {}, 'View')];
  if (completionOf(cloud.head, true).count > 1) {
    const text = cloud.head.dimension === 'axisymmetric' ? 'Revolve about the axis' : 'Mirror at the symmetry planes';
    controls.push(labelled(text, tickBox(state.completed, (ticked) => {
      state.completed = ticked;
      renew();
    })));
  }
  const views = ['oblique', 'front', 'side', 'top'].flatMap((name) => [element('button', { type: 'button', click: () => viewer.setView(name) }, name), ' ']);
  const theme = document.documentElement.dataset.theme ?? '';
  return [...controls, element('p', {}, ...views, element('button', { type: 'button', click: () => viewer.reset() }, 'all of it')),
    labelled('Upright axis', choice(AXES, String(state.camera.up), (axis) => {
      state.camera.up = Number(axis);
      viewer.redraw();
    })),
    labelled('Size of particles', slider(0.2, 4, 0.1, state.size, (size) => {
      state.size = size;
      viewer.redraw({ moving: true });
    })),
    labelled('Appearance', choice([['', 'as the system'], ['light', 'light'], ['dark', 'dark']], theme, (word) => {
      if (word === '') delete document.documentElement.dataset.theme; else document.documentElement.dataset.theme = word;
      viewer.redraw();
    })),
    element('p', {}, element('button', { type: 'button', click: () => save(viewer) }, 'Save the picture'))];
}

/** Offers the picture as a file. */
function save(viewer) {
  viewer.drawNow(false);
  viewer.canvas.toBlob((blob) => {
    const link = element('a', { href: URL.createObjectURL(blob), download: 'picture.png' });
    link.click();
    URL.revokeObjectURL(link.href);
  });
}

function fileControls(viewer, alert) {
  const files = element('input', { type: 'file', 'aria-label': 'Files of snapshots', multiple: true, accept: '.wpv,.gz', change: async () => {
    try {
      await viewer.times.openFiles([...files.files]);
      await viewer.show(0);
      viewer.reset();
    } catch (error) {
      alert(error.message);
    }
  } });
  return [element('h2', {}, 'Open snapshots'), element('p', { class: 'note' }, 'Files .wpv and .wpv.gz of whipple view --wpv, in full detail.'), files];
}

/** The panel; it is made anew when what can be chosen changes. */
export function panel(viewer, alert) {
  const controls = element('div'), keys = element('dl', {}, ...KEYS.flatMap(([key, act]) => [element('dt', {}, key), element('dd', {}, act)]));
  const fill = () => {
    // The control that is used keeps the focus, by its place.
    const all = () => [...controls.querySelectorAll('input, select, button')], focused = all().indexOf(document.activeElement);
    controls.replaceChildren(...fieldControls(viewer, renew), ...bodyControls(viewer), ...sectionControls(viewer, renew),
                             ...sieveControls(viewer, renew), ...sceneControls(viewer, renew));
    all()[focused]?.focus();
  };
  const renew = () => {
    fill();
    viewer.changed();
  };
  viewer.whenShown(fill);
  fill();
  return element('aside', { 'aria-label': 'Controls' }, element('h2', {}, 'Particle'), viewer.details, controls, ...fileControls(viewer, alert),
                 element('details', {}, element('summary', {}, 'Keys in the picture'), keys));
}

/** The bar of times. */
export function timeBar(viewer) {
  const readout = element('output', { 'aria-live': 'off' });
  const place = slider(0, 1, 1, 0, (index) => viewer.show(index));
  place.setAttribute('aria-label', 'Time');
  const button = element('button', { type: 'button', click: () => viewer.play() });
  let playing = null;
  const halt = () => {
    clearTimeout(playing);
    playing = null;
    button.textContent = 'Play';
  };
  const next = async () => {
    await viewer.show(viewer.index + 1);
    if (playing === null) return;
    if (viewer.index + 1 < viewer.times.count) playing = setTimeout(next, PLAY_INTERVAL); else halt();
  };
  viewer.play = async () => {
    if (playing !== null) return halt();
    button.textContent = 'Stop';
    playing = setTimeout(next, PLAY_INTERVAL);
    if (viewer.index + 1 >= viewer.times.count) await viewer.show(0);
  };
  const fill = () => {
    place.max = viewer.times.count - 1;
    place.value = viewer.index;
    const time = quantity(viewer.cloud.head.time, 's');
    readout.textContent = `${time} (${viewer.index + 1} of ${viewer.times.count})`;
    place.setAttribute('aria-valuetext', time);
  };
  viewer.whenShown(fill);
  halt();
  fill();
  return element('footer', {}, button, place, readout);
}
