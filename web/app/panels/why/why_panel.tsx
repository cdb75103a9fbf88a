import { IconHelpCircle } from '@tabler/icons-react';
import { useRef, type KeyboardEvent } from 'react';
import { askingOf, type Question, type WhyLink } from '../../../core/asking';
import { shownTime } from '../../../core/numbers';
import type { Studio } from '../../../core/studio';
import { revealDoc } from '../../../core/window_state';
import { copyText } from '../../commands/clipboard';
import { useChanges, useStudio } from '../../hooks';
import { Blank } from '../../parts/blank';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { revealElement } from '../../views/plan/reveal_element';
import { questionOf, whyWords as words } from './words';
import '../../look/because.css';

/** Why something is as it is: what it followed from, each a click from its place and its instant. */
export default function WhyPanel() {
  const studio = useStudio();
  const asking = askingOf(studio);
  useChanges(asking.changed);
  const { question, chain, trouble } = asking;
  if (question === null)
    return (
      <Blank
        title={words.nothing}
        icon={<IconHelpCircle className="icon" size={18} stroke={kStroke} aria-hidden />}
      >
        {words.how}
      </Blank>
    );
  return (
    <div className="because">
      <Head question={question} chain={chain} />
      {asking.waits ? (
        <p className="because__note" role="status" tabIndex={-1} data-autofocus>
          {words.waits}
        </p>
      ) : null}
      {trouble === '' ? null : (
        <p className="because__note is-error" role="alert" tabIndex={-1} data-autofocus>
          {trouble}
        </p>
      )}
      {chain ? <Chain chain={chain} /> : null}
    </div>
  );
}

function Head({ question, chain }: { question: Question; chain: readonly WhyLink[] | null }) {
  const studio = useStudio();
  const { t } = question;
  return (
    <header className="because__head">
      <h3 className="grow">
        {questionOf(question)}{' '}
        <span className="muted num">{t === null ? words.now : words.at(shownTime(t))}</span>
      </h3>
      {chain ? (
        <Button
          small
          kind="plain"
          onClick={() => void copyText(studio, textOf(question, chain), words.copied)}
        >
          {words.copy}
        </Button>
      ) : null}
    </header>
  );
}

function Chain({ chain }: { chain: readonly WhyLink[] }) {
  const studio = useStudio();
  const list = useRef<HTMLOListElement>(null);
  const pressed = (event: KeyboardEvent) => {
    const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (by === undefined) return;
    const rows = [...(list.current?.querySelectorAll('button') ?? [])];
    const at = rows.findIndex((row) => row === document.activeElement);
    rows[Math.min(Math.max(at + by, 0), rows.length - 1)]?.focus();
    event.preventDefault();
    event.stopPropagation();
  };
  return (
    <div className="scroll">
      <ol className="because__chain" ref={list} aria-label={words.chain} onKeyDown={pressed}>
        {chain.map((link, index) => (
          // Nothing else tells two of the same instant apart, and a chain never changes.
          <li key={index}>
            <Row link={link} earlier={chain[index + 1]} onOpen={() => open(studio, link)} />
          </li>
        ))}
      </ol>
    </div>
  );
}

function Row(props: { link: WhyLink; earlier: WhyLink | undefined; onOpen(): void }) {
  const { link, earlier, onOpen } = props;
  const { t, what, value, place } = link;
  const said = value === '' ? what : `${what} (${value})`;
  return (
    <button
      type="button"
      className={link.root ? 'because__link is-root' : 'because__link'}
      data-inset
      aria-label={words.open(said, shownTime(t), place)}
      onClick={onOpen}
    >
      <span className="because__dot" aria-hidden />
      <span className="because__what">
        {what} {value === '' ? null : <code>{value}</code>}
      </span>
      <time className="num">{shownTime(t)}</time>
      <span className="because__place ellipsis">
        {place === '' && link.root ? words.root : place}
      </span>
      <span className="because__gap num">{earlier ? gapOf(t - earlier.t) : ''}</span>
    </button>
  );
}

/** Between it and what it followed from. */
function gapOf(seconds: number): string {
  const ms = Math.round(seconds * 1000);
  if (ms === 0) return '';
  return words.later(ms < 1000 ? `${ms} ms` : `${seconds.toFixed(3)} s`);
}

/** Its place comes in sight, and everything shows its instant; the keyboard stays in the chain. */
function open(studio: Studio, { t, doc, line, element }: WhyLink): void {
  studio.past.look(t);
  if (doc === undefined) return;
  if (element !== undefined) revealElement(studio, doc, element, false);
  else revealDoc(studio.window, doc, line === undefined ? null : { line, column: 1 }, false);
}

function textOf(question: Question, chain: readonly WhyLink[]): string {
  const lines = chain.map(({ t, what, value, place }) =>
    [`${shownTime(t)} s`, value === '' ? what : `${what} (${value})`, place].join('  ').trimEnd(),
  );
  return [questionOf(question), ...lines, ''].join('\n');
}
