import {
  IconCircleCheck,
  IconCircleDashed,
  IconCircleX,
  IconLoader2,
  IconPlayerStop,
  type TablerIcon,
} from '@tabler/icons-react';
import { useRef, type KeyboardEvent } from 'react';
import { stateOf, type Tests, type TestState } from '../../../core/tests';
import { revealDoc } from '../../../core/window_state';
import type { TestRun } from '../../../protocol/messages';
import { useStudio } from '../../hooks';
import { kStroke } from '../../parts/icons';
import { testWords as words } from '../../views/tests/words';
import { FailureRow } from './failure_row';

/** Tests, below each what was not as expected. Up and down go from row to row, right into its buttons. */
export function TestList({ tests }: { tests: Tests }) {
  const list = useRef<HTMLUListElement>(null);
  return (
    <ul
      className="tests__list"
      ref={list}
      aria-label={words.list}
      onKeyDown={(event) => list.current && pressed(list.current, event)}
    >
      {tests.tests.map((test, index) => (
        <li key={test.path}>
          <TestRow test={test} tests={tests} isFirst={index === 0} />
          {test.failures.length === 0 ? null : (
            <ul className="tests__failures" aria-label={words.states.failed}>
              {test.failures.map((failure, index) => (
                // One seed can fail at several places; the list only grows.
                <FailureRow key={index} path={test.path} failure={failure} />
              ))}
            </ul>
          )}
          <More test={test} />
        </li>
      ))}
    </ul>
  );
}

/** Rows are the buttons that lead to a place; what else a row has is at the right of it. */
function pressed(list: HTMLElement, event: KeyboardEvent): void {
  const focused = document.activeElement?.closest<HTMLElement>('[data-row]');
  if (!focused) return;
  const to = toward(list, focused, event.key);
  if (to === undefined) return;
  to?.focus();
  event.preventDefault();
  event.stopPropagation();
}

function toward(list: HTMLElement, row: HTMLElement, key: string): HTMLElement | null | undefined {
  const rows = [...list.querySelectorAll<HTMLElement>('[data-row]')];
  const buttons = [...row.querySelectorAll<HTMLElement>('button:not(:disabled)')];
  const at = rows.indexOf(row);
  const within = buttons.findIndex((one) => one === document.activeElement);
  const first = (one: HTMLElement | undefined) => one?.querySelector<HTMLElement>('button') ?? null;
  switch (key) {
    case 'ArrowDown':
      return first(rows[at + 1]);
    case 'ArrowUp':
      return first(rows[at - 1]);
    case 'Home':
      return first(rows[0]);
    case 'End':
      return first(rows.at(-1));
    case 'ArrowRight':
      return buttons[within + 1] ?? null;
    case 'ArrowLeft':
      return buttons[within - 1] ?? null;
    default:
      return undefined;
  }
}

const signs: Record<TestState, TablerIcon> = {
  waits: IconCircleDashed,
  runs: IconLoader2,
  ok: IconCircleCheck,
  failed: IconCircleX,
  refused: IconCircleX,
  stopped: IconPlayerStop,
};

function TestRow(props: { test: TestRun; tests: Tests; isFirst: boolean }) {
  const { test, tests, isFirst } = props;
  const studio = useStudio();
  const state = stateOf(test, tests);
  const Sign = signs[state];
  const { path, runs, done, failed, why, at } = test;
  return (
    <div data-row className="tests__row">
      <button
        type="button"
        className="tests__open"
        data-inset
        {...(isFirst ? { 'data-autofocus': true } : {})}
        onClick={() => revealDoc(studio.window, path, at ?? null, false)}
      >
        <Sign className={`icon tests__sign is-${state}`} size={16} stroke={kStroke} aria-hidden />
        <span className={`tests__state is-${state}`}>{words.states[state]}</span>
        <b className="ellipsis">{path}</b>
        {why === undefined ? (
          <span className="num muted">
            {words.of(done - failed, state === 'stopped' ? done : runs)}
          </span>
        ) : (
          <span className="tests__why">{why}</span>
        )}
      </button>
    </div>
  );
}

/** Those that are only counted: a run that failed is told at least once below. */
function More({ test: { failed, failures } }: { test: TestRun }) {
  const told = new Set(failures.map(({ seed }) => seed)).size;
  return failed > told ? <p className="tests__more muted">{words.more(failed - told)}</p> : null;
}
