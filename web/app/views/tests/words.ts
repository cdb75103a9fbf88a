// Words of tests of behaviour: apart from text.ts, as they come with what shows them.

import type { TestState } from '../../../core/tests';
import type { CoverageShare, TestFailure } from '../../../protocol/messages';
import { counted } from '../../text';

const runs = (count: number) => counted(count, 'run', 'runs');

export const testWords = {
  none: 'No test has been run yet.',
  lost: 'The studio was started again, and the results of the tests are gone. Run them again.',
  how: 'A test says what is expected of every run of a plan. Run all tests of the project, or open one, a file NAME.test.json, and press F5. “Keep the run as a test” in the timeline writes a first one.',
  list: 'Tests, and what was not as expected',
  run: 'Run this test',
  runHelp:
    'Saves all files, then runs this test with each of its seeds. What runs is what is on the screen.',
  runAll: 'Run all tests',
  runAllHelp: 'Saves all files, then runs every test of the project with each of its seeds.',
  stop: 'Stop',
  busy: 'Tests are running. Wait for them, or stop them.',
  scripts: 'Count script lines',
  scriptsHelp: 'Also counts which lines of scripts are executed. Takes several times as long.',
  progress: 'Runs done',
  results: 'Show results',
  states: {
    waits: 'waits',
    runs: 'runs',
    ok: 'ok',
    failed: 'failed',
    refused: 'cannot be run',
    stopped: 'stopped',
  } satisfies Record<TestState, string>,
  of: (done: number, all: number) => `${done} of ${all}`,
  running: (all: number) => `${runs(all)} started.`,
  done: (done: number, failed: number) =>
    failed === 0 ? `${runs(done)} as expected.` : `${failed} of ${runs(done)} not as expected.`,
  stopped: (done: number, all: number) => `Stopped after ${done} of ${runs(all)}.`,
  failed: (why: string) => `The tests could not be run to their end: ${why}.`,
  changed: 'Files have changed since these tests were run.',
  seed: (seed: number) => `seed ${seed}`,
  at: (t: number) => `${t.toFixed(2)} s`,
  crashed: 'no outcome',
  more: (count: number) => `and ${counted(count, 'more run', 'more runs')} that failed`,
  open: 'Open the recording',
  openHelp: 'Runs the recorded run again, and shows the instant at which it failed.',
  byHand: 'Run by hand',
  byHandHelp: 'Runs it live from its beginning, with this seed.',
  noRecording: 'It has no world, so its recording can only be replayed by `vagus replay`.',
  failure: ({ expected, what, help }: TestFailure) =>
    `${expected === undefined ? '' : `${expected}: `}${what}${help === undefined ? '' : ` (${help})`}`,
  place: (count: number, { seed, t = 0, ...failure }: TestFailure) =>
    `${counted(count, 'run', 'runs')} not so; with seed ${seed}, at ${t.toFixed(2)} s: ${failure.what}`,
  bar: 'Test',
  keys: 'F5',
};

export const coverageWords = {
  title: 'What the runs went through',
  table: 'Taken, of all there is',
  file: 'File',
  kinds: {
    actors: 'actors',
    states: 'states',
    supervisors: 'supervisors',
    events: 'events',
    pairs: 'pairs',
    lines: 'lines',
    branches: 'branches',
  } satisfies Record<CoverageShare['name'], string>,
  show: 'Show coverage',
  showIn: (path: string) => `Show coverage in ${path}`,
  strip: 'Coverage of the tests',
  hide: 'Hide coverage',
  share: (taken: number, of: number) => `${taken} of ${of}`,
  changed: 'This file has changed since the tests were run.',
  taken: 'taken, with how often',
  never: 'never taken',
  list: 'What was taken, what never was',
  only: 'Only what never was',
  nothing: 'Everything was taken.',
  mark: (key: string, count: number) =>
    count === 0 ? `${key}: never taken` : `${key}: taken ${counted(count, 'time', 'times')}`,
  count: (count: number) => (count === 0 ? 'never' : shortOf(count)),
  line: (count: number, ways: number | undefined, taken: number | undefined) => {
    const often = count === 0 ? 'Never executed' : `Executed ${counted(count, 'time', 'times')}`;
    return ways === undefined ? often : `${often}; ${taken ?? 0} of ${ways} ways taken`;
  },
  lines: (taken: number, all: number, never: string) =>
    `${taken} of ${all} lines executed. ${never === '' ? 'None was left out.' : `Never: ${never}.`}`,
  kind: (kind: keyof typeof singular) => singular[kind],
};

const singular = {
  actors: 'actor',
  states: 'state',
  supervisors: 'supervisor',
  events: 'event',
  pairs: 'pair',
};

/** At most four letters. */
export const shortOf = (count: number): string =>
  count < 1000
    ? String(count)
    : count < 1e6
      ? `${Math.round(count / 1000)}k`
      : `${Math.round(count / 1e6)}M`;
