// SPDX-License-Identifier: BSD-3-Clause
// Elements of the page and the panel of controls.

/** An element with attributes (functions become listeners, `undefined` and false are left out) and children. */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') made.addEventListener(name, value);
    else if (name === 'style') made.style.cssText = value;  // as an attribute, the policy of a page may refuse it
    else if (value !== undefined && value !== false) made.setAttribute(name, value === true ? '' : value);
  }
  made.append(...children);
  return made;
}

/** A list of choices. @param choices  pairs of a value and its text */
export function choice(choices, chosen, change) {
  const list = element('select', { change: () => change(list.value) },
                       ...choices.map(([value, text]) => element('option', { value, selected: value === chosen }, text)));
  return list;
}

/** A control with its text; the text stands after a box to be ticked. */
export function labelled(text, control) {
  return control.type === 'checkbox' ? element('label', { class: 'tick' }, control, text) : element('label', {}, text, control);
}

export function tickBox(ticked, change) {
  const box = element('input', { type: 'checkbox', change: () => change(box.checked) });
  box.checked = ticked;
  return box;
}

export function slider(lowest, highest, step, value, change) {
  const made = element('input', { type: 'range', min: lowest, max: highest, step, input: () => change(Number(made.value)) });
  made.value = value;
  return made;
}

/** A field for a number with a text before it; what is no number is marked and not passed on. */
export function numberBox(text, value, change) {
  const box = element('input', { type: 'text', inputmode: 'decimal', value, change: () => {
    box.setAttribute('aria-invalid', String(!change(box.value)));
  } });
  return labelled(text, box);
}
