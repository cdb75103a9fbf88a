import { IconArrowBackUp, IconHandClick, IconRefresh, IconX } from '@tabler/icons-react';
import { useCallback, useEffect, useRef, type KeyboardEvent } from 'react';
import type { Doc } from '../../../../protocol/messages';
import type { Trying } from '../../../../core/plan/trying';
import { Button } from '../../../parts/button';
import { kStroke } from '../../../parts/icons';
import { digitOf } from './digits';
import { KeepTest } from './keep_test';
import { Lane } from './lane';
import { Options } from './options';
import { useTakenAgain, useTrying } from './use_trying';
import { tryWords as words } from './words';
import '../../../look/try.css';

const size = { size: 14, stroke: kStroke };

/** Above the drawing of a plan that is tried: what can be chosen, and the way so far. */
export default function TryBar({ doc }: { doc: Doc }) {
  const trying = useTrying(doc);
  return trying ? <Bar trying={trying} doc={doc} /> : null;
}

function Bar({ trying, doc }: { trying: Trying; doc: Doc }) {
  useTakenAgain(trying);
  const frame = useKeyboard(trying);
  const { answer, trouble, way } = trying;
  return (
    <section
      className="ptry"
      ref={frame}
      tabIndex={-1}
      aria-label={words.label}
      onKeyDown={(event) => pressed(event, trying)}
    >
      <div className="ptry__row">
        <IconHandClick {...size} aria-hidden />
        <p className="ptry__question" role="status">
          {questionOf(trying)}
        </p>
        <span className="grow" />
        <Button
          kind="plain"
          small
          disabled={way.length === 0}
          tip={words.back}
          keys="Backspace"
          icon={<IconArrowBackUp {...size} />}
          onClick={() => void trying.back(way.length - 1)}
        />
        <Button
          kind="plain"
          small
          disabled={way.length === 0}
          tip={words.again}
          icon={<IconRefresh {...size} />}
          onClick={() => void trying.back(0)}
        />
        <KeepTest doc={doc} trying={trying} />
        <Button
          kind="plain"
          small
          tip={words.leave}
          keys="Escape"
          icon={<IconX {...size} />}
          onClick={() => trying.leave()}
        />
      </div>
      {trouble === '' ? null : (
        <p className="ptry__trouble" role="alert">
          {trouble}
        </p>
      )}
      <Options trying={trying} />
      {answer ? <Lane trying={trying} turns={answer.turns} /> : null}
    </section>
  );
}

function questionOf({ answer, options, trouble }: Trying): string {
  if (trouble !== '') return '';
  if (!answer) return words.waits;
  const { waits, plan } = answer;
  if (waits) {
    const ends = options.some(({ is }) => is === 'state');
    return ends ? words.ends(waits.actor) : words.noEnd(waits.actor);
  }
  const over = words.over[plan.result ?? 'OK'];
  return plan.message ? `${over} ${plan.message}` : over;
}

/** Numbers choose, Backspace takes back, Escape leaves; left and right go from button to button. */
function pressed(event: KeyboardEvent<HTMLElement>, trying: Trying): void {
  const { key, ctrlKey, altKey, metaKey } = event;
  if (ctrlKey || altKey || metaKey) return;
  const isTyped = event.target instanceof HTMLInputElement && key !== 'Escape';
  if (isTyped) return;
  const digit = digitOf(event);
  const by = { ArrowRight: 1, ArrowLeft: -1 }[key];
  if (digit !== null) void trying.press(digit);
  else if (key === 'Backspace') void trying.back(trying.way.length - 1);
  else if (key === 'Escape') trying.leave();
  else if (by !== undefined) move(event.currentTarget, by);
  else return;
  event.preventDefault();
  event.stopPropagation();
}

function move(frame: HTMLElement, by: number): void {
  const buttons = [...frame.querySelectorAll<HTMLElement>('button:not(:disabled)')];
  const options = buttons.filter((one) => one.dataset['option'] !== undefined);
  const among = options.includes(document.activeElement as HTMLElement) ? options : buttons;
  const at = among.findIndex((one) => one === document.activeElement);
  const next = at < 0 ? (options[0] ?? buttons[0]) : among[(at + by + among.length) % among.length];
  next?.focus();
}

/** The keyboard is here from the beginning, and stays when what had it is gone with the last choice. */
function useKeyboard({ answer, clicked }: Trying) {
  const frame = useRef<HTMLElement>(null);
  const focus = useCallback(() => frame.current?.focus({ preventScroll: true }), []);
  useEffect(() => {
    const asked = requestAnimationFrame(focus);
    return () => cancelAnimationFrame(asked);
  }, [focus]);
  useEffect(() => {
    const { activeElement } = document;
    const isGone = activeElement === null || activeElement === document.body;
    if (isGone || activeElement.matches(':disabled')) focus();
  }, [answer, focus]);
  // A click in the drawing would leave it there, where Backspace deletes.
  useEffect(() => clicked.on(focus), [clicked, focus]);
  return frame;
}
