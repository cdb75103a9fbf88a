// The pages load and connect in Firefox ESR, too: asked by WebDriver BiDi, which the browser itself speaks.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import WebSocket from 'ws';
import { startProgram, startServer, temporaryFolder } from './support/server.mjs';
import { until } from './support/until.mjs';

void test('Firefox shows the studio and reaches its server', { timeout: 240_000 }, async (t) => {
  const server = await startServer(t, ['--example', 'thymio']);
  const home = temporaryFolder(t);
  const firefox = startProgram(
    t,
    ['firefox-esr', '--headless', '--no-remote', '--profile', home, '--remote-debugging-port', 0],
    { env: { HOME: home, MOZ_DISABLE_CONTENT_SANDBOX: '1' } },
  );
  const [, address] = await firefox.line(/WebDriver BiDi listening on (ws:\S+)/);
  const bidi = await connect(`${address}/session`);
  t.after(() => bidi.socket.terminate());
  await bidi.ask('session.new', { capabilities: {} });
  const { contexts } = await bidi.ask('browsingContext.getTree', {});
  const { context } = contexts[0];
  await bidi.ask('browsingContext.navigate', { context, url: server.address, wait: 'complete' });
  const evaluate = async (/** @type {string} */ expression) =>
    (
      await bidi.ask('script.evaluate', {
        expression,
        target: { context },
        awaitPromise: true,
      })
    ).result?.value;
  await until(
    'the script is shown',
    async () =>
      await evaluate(
        `document.querySelector('[aria-label="Script of thymio-II"]')?.innerText.includes('explores') ?? false`,
      ),
    120_000,
  );
  assert.match(await evaluate('document.body.innerText'), /Simulator/);
  assert.doesNotMatch(await evaluate('location.href'), /token/);
});

/** A session of BiDi: ask(method, params) gives its result. */
async function connect(/** @type {string} */ address) {
  const socket = new WebSocket(address);
  await new Promise((done, fail) => socket.on('open', done).on('error', fail));
  const waiting = new Map();
  let last = 0;
  socket.on('message', (data) => {
    const message = JSON.parse(data.toString());
    const answer = waiting.get(message.id);
    waiting.delete(message.id);
    if (message.type === 'error') answer?.fail(new Error(`${message.error}: ${message.message}`));
    else answer?.done(message.result);
  });
  const ask = (/** @type {string} */ method, /** @type {any} */ params) =>
    new Promise((done, fail) => {
      waiting.set(++last, { done, fail });
      socket.send(JSON.stringify({ id: last, method, params }));
    });
  return { socket, ask };
}
