// Tests of behaviour as a page shows them: what is chosen of them, how a test is, what is failed
// where.

import type { Doc, Json, Place, TestFailure, TestRun, Topics } from '../protocol/messages';
import { deskFor } from './desk';
import { Emitter } from './emitter';
import type { Studio } from './studio';

export type Tests = Topics['tests']['is'];
export type TestState = 'waits' | 'runs' | 'ok' | 'failed' | 'refused' | 'stopped';

/** In .vagus/state.json, by state.put. */
const kTestOptions = 'tests';

/** How tests are run and shown: the same in all views of the window. */
export class TestOptions {
  readonly changed = new Emitter<void>();

  constructor(
    private values: { scripts: boolean; coverage: boolean },
    private readonly keep: (values: Json) => void,
  ) {}

  /** Lines of scripts are counted, too. */
  get scripts(): boolean {
    return this.values.scripts;
  }

  /** Plans and scripts show what was taken. */
  get coverage(): boolean {
    return this.values.coverage;
  }

  toggle(name: 'scripts' | 'coverage', on = !this.values[name]): void {
    this.values = { ...this.values, [name]: on };
    this.keep(this.values);
    this.changed.emit();
  }
}

export const testOptionsOf: (studio: Studio) => TestOptions = deskFor((studio: Studio) => {
  const kept = studio.topics.get('state', {})?.values as
    { tests?: Record<string, Json> } | undefined;
  const isOn = (name: string) => kept?.[kTestOptions]?.[name] === true;
  return new TestOptions(
    { scripts: isOn('scripts'), coverage: isOn('coverage') },
    (value) => studio.drives && studio.order('state.put', { key: kTestOptions, value }),
  );
});

export function stateOf(test: TestRun, { state }: Pick<Tests, 'state'>): TestState {
  if (test.why !== undefined) return 'refused';
  if (test.failed > 0) return 'failed';
  if (test.runs > 0 && test.done === test.runs) return 'ok';
  if (state === 'running') return test.done > 0 ? 'runs' : 'waits';
  return 'stopped';
}

/** What was not as expected at one place of a test. */
export interface FailedPlace {
  at: Place;
  first: TestFailure;
  /** So many runs. */
  count: number;
}

/** By place, in the order of the file. */
export function failedPlaces(failures: readonly TestFailure[]): FailedPlace[] {
  const places = new Map<string, FailedPlace>();
  for (const one of failures) {
    if (!one.at) continue;
    const key = `${one.at.line}:${one.at.column}`;
    const known = places.get(key);
    if (known) known.count += 1;
    else places.set(key, { at: one.at, first: one, count: 1 });
  }
  return [...places.values()].sort((a, b) => a.at.line - b.at.line || a.at.column - b.at.column);
}

/** The file has not been changed since the tests were run. */
export function isAsRun(tests: Tests | undefined, doc: Doc): boolean {
  return tests !== undefined && !tests.changed.includes(doc.replace(/#.*$/, ''));
}
