import type { WhyLink } from '../../../core/asking';
import { shownTime } from '../../../core/numbers';
import { partOf } from '../../../core/paths';
import type { Studio } from '../../../core/studio';
import { revealDoc } from '../../../core/window_state';
import { nameOf } from '../../documents';
import { useStudio } from '../../hooks';
import { stepThroughRows } from '../../parts/list_keys';
import { revealElement } from '../../views/plan/reveal_element';
import { whyWords as words } from './words';

/** What something followed from. Up and down go from link to link. */
export function Chain({ chain }: { chain: readonly WhyLink[] }) {
  const studio = useStudio();
  return (
    <div className="scroll">
      <ol className="because__chain" aria-label={words.chain} onKeyDown={stepThroughRows}>
        {chain.map((link, index) => (
          // Nothing else tells two of the same instant apart, and a chain never changes.
          <li key={index}>
            <Row
              link={link}
              isFirst={index === 0}
              earlier={chain[index + 1]}
              onOpen={() => open(studio, link)}
            />
          </li>
        ))}
      </ol>
    </div>
  );
}

interface RowProps {
  link: WhyLink;
  isFirst: boolean;
  earlier: WhyLink | undefined;
  onOpen(): void;
}

function Row({ link, isFirst, earlier, onOpen }: RowProps) {
  const studio = useStudio();
  const { t, what, value, place } = link;
  return (
    <button
      type="button"
      className={link.root ? 'because__link is-root' : 'because__link'}
      data-inset
      data-autofocus={isFirst || undefined}
      onClick={onOpen}
    >
      <span className="because__dot" aria-hidden />
      <span className="because__what">
        {what} <Value value={value} />
      </span>
      <time className="num">{shownTime(t)}</time>
      <span className="because__place ellipsis" title={place}>
        {place === '' && link.root ? words.root : shownPlace(studio, link)}
      </span>
      <span className="because__gap num">{earlier ? gapOf(t - earlier.t) : ''}</span>
    </button>
  );
}

/** A line of a script as the editor counts it: its file has the scripts of other nodes before it. */
function shownPlace(studio: Studio, { place, doc, line }: WhyLink): string {
  if (doc === undefined || line === undefined || partOf(doc).part === 0) return place;
  return `${nameOf(studio, doc)}:${line}`;
}

/** Numbers as code; what a local event is about is a sentence. */
function Value({ value }: { value: string }) {
  if (value === '') return null;
  return /^[-"\d]/.test(value) ? <code>{value}</code> : <span className="muted">{value}</span>;
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
