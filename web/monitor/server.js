// SPDX-License-Identifier: BSD-3-Clause
// Questions to the server of this page.

/** The key of the address, which only this page knows: it goes into every question, and out of the address bar. */
let key = '';

/** Takes the key behind the mark # of the address. It stays in this window, so that the page can be loaded again. */
export function takeKey() {
  if (location.hash.length > 1) {
    sessionStorage.setItem('whipple-key', location.hash.slice(1));
    history.replaceState(null, '', location.pathname);
  }
  key = sessionStorage.getItem('whipple-key') ?? '';
}

async function asked(path, options) {
  let answer;
  try {
    answer = await fetch(path, { ...options, headers: { ...options.headers, 'X-Whipple-Token': key } });
  } catch {
    throw new Error('the program does not answer: it has ended, or the machine cannot be reached');
  }
  if (!answer.ok) throw Object.assign(new Error((await answer.text()).trim() || `answer ${answer.status}`), { status: answer.status });
  return answer;
}

/** The address of a question. @param {object} keys  a list gives a key several values */
export function address(path, keys = {}) {
  const query = new URLSearchParams();
  for (const [name, value] of Object.entries(keys)) for (const each of [value].flat()) query.append(name, each);
  return query.size > 0 ? `${path}?${query}` : path;
}

export async function ask(path, keys) {
  return (await asked(address(path, keys), {})).json();
}

export async function askBytes(path, keys) {
  return new Uint8Array(await (await asked(address(path, keys), {})).arrayBuffer());
}

async function sent(path, wish) {
  return asked(path, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(wish) });
}

export async function tell(path, wish) {
  await sent(path, wish);
}

/** The answer to a question that needs more than an address. */
export async function askWith(path, wish) {
  return (await sent(path, wish)).json();
}

export async function askBytesWith(path, wish) {
  return new Uint8Array(await (await sent(path, wish)).arrayBuffer());
}
