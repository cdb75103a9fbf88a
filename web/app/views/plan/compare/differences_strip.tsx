import { IconChevronDown, IconChevronUp, IconFileDiff, IconList, IconX } from '@tabler/icons-react';
import { useEffect, useRef, useState, type KeyboardEvent } from 'react';
import type { Doc } from '../../../../protocol/messages';
import type { Comparing } from '../../../../core/plan/comparing';
import { Button } from '../../../parts/button';
import { kStroke } from '../../../parts/icons';
import { DifferenceLine, DifferenceList } from './difference_list';
import { Legend } from './legend';
import { useCompared, useComparing } from './use_comparing';
import { compareWords as words } from './words';
import '../../../look/compare.css';

const size = { size: 14, stroke: kStroke };

/** Above a drawing that is compared: how much differs, and the way from difference to difference. */
export default function DifferencesStrip({ doc }: { doc: Doc }) {
  const comparing = useComparing(doc);
  return comparing ? <Strip comparing={comparing} doc={doc} /> : null;
}

function Strip({ comparing, doc }: { comparing: Comparing; doc: Doc }) {
  useCompared(comparing, doc);
  const [lists, setLists] = useState(false);
  const frame = useFocus();
  const { other, answer, trouble, at } = comparing;
  const count = answer?.differences.length ?? 0;
  const pressed = (event: KeyboardEvent) => {
    if (event.key !== 'Escape') return;
    event.preventDefault();
    event.stopPropagation();
    comparing.leave();
  };
  return (
    <section
      className="pcompare"
      ref={frame}
      tabIndex={-1}
      aria-label={words.strip(other?.name ?? '')}
      data-place="plan-parts"
      onKeyDown={pressed}
    >
      <div className="pcompare__row">
        <IconFileDiff {...size} aria-hidden />
        <b className="ellipsis pcompare__name">{words.strip(other?.name ?? '')}</b>
        {answer ? <Legend answer={answer} /> : null}
        <span className="grow" />
        {count === 0 ? null : <span className="muted num">{words.at((at ?? -1) + 1, count)}</span>}
        <Step comparing={comparing} by={-1} />
        <Step comparing={comparing} by={1} />
        <Button
          kind="plain"
          small
          disabled={count === 0}
          aria-pressed={lists}
          tip={words.list}
          icon={<IconList {...size} />}
          onClick={() => setLists(!lists)}
        />
        <Button
          kind="plain"
          small
          tip={words.commands.leave}
          keys="Escape"
          icon={<IconX {...size} />}
          onClick={() => comparing.leave()}
        />
      </div>
      {trouble === '' ? null : (
        <p className="pcompare__trouble" role="alert">
          {trouble}
        </p>
      )}
      {answer || trouble !== '' ? null : <p role="status">{words.waits}</p>}
      {lists && answer ? (
        <DifferenceList
          differences={answer.differences}
          at={at}
          onShow={(index) => comparing.look(index)}
        />
      ) : comparing.current ? (
        <DifferenceLine difference={comparing.current} />
      ) : null}
    </section>
  );
}

function Step({ comparing, by }: { comparing: Comparing; by: 1 | -1 }) {
  const isNext = by === 1;
  return (
    <Button
      kind="plain"
      small
      disabled={(comparing.answer?.differences.length ?? 0) === 0}
      tip={isNext ? words.commands.next : words.commands.previous}
      keys={isNext ? 'F7' : 'Shift+F7'}
      icon={isNext ? <IconChevronDown {...size} /> : <IconChevronUp {...size} />}
      onClick={() => comparing.step(by)}
    />
  );
}

/** What was chosen to compare with is gone with its menu or notice: the keyboard goes on here. */
function useFocus() {
  const frame = useRef<HTMLElement>(null);
  useEffect(() => {
    const asked = requestAnimationFrame(() => frame.current?.focus({ preventScroll: true }));
    return () => cancelAnimationFrame(asked);
  }, []);
  return frame;
}
