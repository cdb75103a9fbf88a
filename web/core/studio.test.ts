import { expect, test } from 'vitest';
import { kFirstRetryMs } from './connection';
import { Studio } from './studio';
import { TestWorld } from './test_world';

const settled = async () => {
  for (let turn = 0; turn < 3; turn++) await new Promise((resolve) => setTimeout(resolve));
};

/** A page that has control, and a file with something in it that the server does not have. */
async function make() {
  const world = new TestWorld();
  const identity = { client: 'c', nonce: 'n', firstId: 1, usedId: () => {}, renamed: () => {} };
  const studio = new Studio(world, identity, '', () => 0);
  studio.connection.start();
  world.welcome();
  const last = (command: string) => world.last.sent.findLast((one) => one.do === command);
  const watch = world.last.sent.find((one) => one.in['topic'] === 'studio')?.in['watch'];
  const look = (folder: string | null, driver = 7) => {
    const about = { name: '', help: '', scripts: [], target: '' };
    const whole = { version: '', driver, driver_name: '', clients: 1, settings: {} };
    const project = folder === null ? {} : { project: { ...about, folder } };
    world.say({ watch, whole: { ...whole, recovered: [], ...project } });
  };
  look('/one');
  const { opened } = studio.documents.acquire('a');
  const file = { epoch: 'e', text: 'abc', version: 1, language: 'text', unsaved: false };
  world.say({ id: last('doc.open')?.id, ok: { ...file, ends: 'lf' } });
  const { session } = await opened;
  session.type({ changes: { from: 0, insert: 'x' }, at: 0 });
  return { world, studio, session, last, look };
}

test('WhatIsUnsentWhenTheServerComesBackWithoutTheProjectIsSaidAndKept', async () => {
  const { studio, session, look } = await make();
  const told: object[] = [];
  studio.left.on((one) => told.push(one));
  look(null);
  expect(told).toEqual([{ folder: '/one', docs: ['a'] }]);
  look('/two');
  expect(studio.documents.isUnsent).toBe(false);
  look('/one');
  expect(studio.documents.isUnsent).toBe(true);
  expect((await studio.documents.acquire('a').opened).session).toBe(session);
});

test('WhatChangesTextsOnTheServerNamesThemAsTheyAreHere', async () => {
  const { world, studio, last } = await make();
  const renamed = studio.change('file.rename', { path: 'b', to: 'c' });
  expect(last('file.rename')).toBeUndefined();
  world.say({ id: last('doc.edit')?.id, ok: { version: 2 } });
  await settled();
  expect(last('file.rename')?.in).toEqual({
    path: 'b',
    to: 'c',
    seen: [{ doc: 'a', epoch: 'e', version: 2 }],
  });
  world.say({ id: last('file.rename')?.id, ok: { followed: [] } });
  await renamed;
});

// What was seen: a letter that was typed while the page came back to a new server was missing in the text.
test('APageThatHadControlMayEditWhileItComesBackUntilAnotherHasIt', async () => {
  const { world, studio, look } = await make();
  const comeBack = (number: number) => {
    world.last.events.closed();
    expect(studio.mayEdit).toBe(true);
    world.pass(kFirstRetryMs * 2);
    world.welcome(number, { epoch: `life ${number}` });
  };
  comeBack(1);
  expect([studio.mayEdit, studio.drives]).toEqual([true, false]);
  look('/one', 0);
  expect([studio.mayEdit, studio.drives]).toEqual([true, false]);
  look('/one', 1);
  expect([studio.mayEdit, studio.drives]).toEqual([true, true]);
  // Control is released.
  look('/one', 0);
  expect(studio.mayEdit).toBe(false);
  look('/one', 1);
  // The new server counts from one, too.
  comeBack(1);
  look('/one', 0);
  expect(studio.mayEdit).toBe(true);
  look('/one', 1);
  comeBack(2);
  look('/one', 3);
  expect(studio.mayEdit).toBe(false);
});
