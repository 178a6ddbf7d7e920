// SPDX-License-Identifier: BSD-3-Clause
// Requests to a run, and its answers.
import { element, labelled } from '/viewer/elements.js';
import { quantity } from '/viewer/numbers.js';
import { tell } from './server.js';

/** States in which an act makes no sense: its button is off. */
const USELESS = { pause: ['paused'], resume: ['running'] };

/** Switches the buttons of acts off that make no sense in a state. @param root  what holds them */
export function allow(root, state) {
  for (const [word, states] of Object.entries(USELESS)) {
    const button = root.querySelector(`[data-act="${word}"]`);
    if (button) button.disabled = states.includes(state);
  }
}

/** What a person reads of the newest answer. */
export function wordsOf({ request, value, answer, detail }) {
  return `${request}${value === '' ? '' : ` ${value}`}: ${answer}${detail ? `: ${detail}` : ''}`;
}

/** Buttons and boxes for the requests that a run accepts. @param tellUser  tells a person what became of it */
export function requests(run, acts, tellUser) {
  const send = async (word, value) => {
    try {
      await tell('/steer', { run, request: word, value });
      tellUser(`Asked for ${word}${value === '' ? '' : ` ${value}`}: the run answers when its step has ended.`);
    } catch (error) {
      tellUser(`Not asked: ${error.message}`);
    }
  };
  const buttons = acts.filter((act) => !act.value || act.optional).map((act) => element('button', {
    type: 'button', title: act.meaning, 'data-act': act.word,
    click: () => (act.word !== 'end' || confirm('End this run now? It writes a checkpoint first.')) && send(act.word, '') }, act.word === 'end' ? 'end now' : act.word));
  const wish = element('select', {}, ...acts.filter((act) => act.value).map((act) => element('option', { value: act.word }, act.word)));
  const value = element('input', { type: 'text', size: 12, placeholder: '0.1 us' });
  const meaning = element('span', { class: 'note' });
  const explain = () => { meaning.textContent = acts.find((act) => act.word === wish.value)?.meaning ?? ''; };
  wish.addEventListener('change', explain);
  explain();
  const form = element('form', { class: 'acts', submit: (event) => {
    event.preventDefault();
    send(wish.value, value.value.trim());
  } }, labelled('Change ', wish), labelled('to ', value), element('button', { type: 'submit' }, 'Ask'), meaning);
  return element('section', { 'aria-label': 'Requests' }, element('div', { class: 'acts' }, ...buttons), form);
}

/** The answers so far, newest first. */
export function answersTable(answers) {
  if (answers.length === 0) return element('p', { class: 'note' }, 'No requests yet.');
  const row = (answer) => element('tr', {}, ...[quantity(Number(answer.time), 's'), answer.step, `${answer.request} ${answer.value}`,
    `${answer.answer}${answer.detail ? `: ${answer.detail}` : ''}`].map((text) => element('td', {}, text)));
  return element('table', {}, element('caption', {}, 'Requests and answers'),
                 element('tr', {}, ...['t', 'step', 'request', 'answer'].map((text) => element('th', { scope: 'col' }, text))),
                 ...answers.toReversed().map(row));
}
