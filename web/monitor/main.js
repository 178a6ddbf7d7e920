// SPDX-License-Identifier: BSD-3-Clause
// The list of runs, and the run that is shown.
import { element, labelled } from '/viewer/elements.js';
import { RunPage } from './run.js';
import { ask, takeKey, tell } from './server.js';

const INTERVAL = 1000;  // ms between two looks

takeKey();
const list = document.getElementById('runs'), main = document.getElementById('run');
let page = null, cases = null;

function show(name, readOnly) {
  page = new RunPage(name, readOnly);
  main.replaceChildren(...page.root);
}

/** The form that starts a case. */
function starter(names) {
  const name = element('select', {}, ...names.map((each) => element('option', { value: each }, each)));
  const run = element('input', { type: 'text', placeholder: 'name of the run' });
  const set = element('textarea', { rows: 3, placeholder: "domain.cell_size='1 mm'\ntime.end='5 us'", spellcheck: 'false' });
  const told = element('p', { class: 'note', role: 'status' });
  const begin = async (event) => {
    event.preventDefault();
    const lines = set.value.split('\n').map((line) => line.trim()).filter((line) => line !== '');
    try {
      await tell('/start', { case: name.value, run: run.value.trim() || name.value, set: lines });
      told.textContent = 'Started: it appears in the list when it has been checked.';
    } catch (error) {
      told.textContent = `Not started: ${error.message}`;
    }
  };
  return element('details', {}, element('summary', {}, 'Start a case'),
                 element('form', { submit: begin }, labelled('Case', name), labelled('Run', run), labelled('Other values, one key=value a line', set),
                         element('button', { type: 'submit' }, 'Start'), told));
}

const entries = element('ul'), heading = element('h2', {}, 'Runs'), started = element('pre', { hidden: true, tabindex: 0, role: 'log', 'aria-live': 'off', 'aria-label': 'Output of started runs' });
const trouble = element('p', { role: 'alert', hidden: true });
list.append(heading, trouble, entries);

function fillList({ folder, runs, read_only: readOnly, started: output }) {
  heading.title = folder;
  entries.replaceChildren(...runs.map((run) => {
    const done = run.end > 0 ? `, ${(100 * run.time / run.end).toFixed(0)} %` : '';
    const state = element('span', { class: 'state', 'data-state': run.state }, run.state);
    return element('li', {}, element('button', { type: 'button', class: 'run', 'data-run': run.name, 'aria-current': String(page?.name === run.name),
      click: () => show(run.name, readOnly) }, element('div', {}, run.name === '.' ? folder.split('/').at(-1) : run.name), state, done));
  }));
  if (runs.length === 0) entries.append(element('li', { class: 'note' }, 'No run yet.'));
  started.hidden = output.length === 0;
  started.textContent = output.join('\n');
}

async function look() {
  try {
    const answer = await ask('/runs');
    if (cases === null) {
      cases = answer.cases;
      if (cases.length > 0) list.append(starter(cases));
      list.append(started);
    }
    if (page === null && answer.runs.length > 0) show((answer.runs.find((run) => run.goes_on) ?? answer.runs[0]).name, answer.read_only);
    const focused = entries.contains(document.activeElement) ? document.activeElement.dataset.run : undefined;
    fillList(answer);
    if (focused !== undefined) [...entries.querySelectorAll('button')].find((each) => each.dataset.run === focused)?.focus();
    if (page !== null) await page.update();
    trouble.hidden = true;
  } catch (error) {
    trouble.hidden = false;
    trouble.textContent = error.message;
  }
  setTimeout(look, document.hidden ? 5 * INTERVAL : INTERVAL);
}

look();
