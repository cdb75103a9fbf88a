import { IconHelpCircle } from '@tabler/icons-react';
import { Suspense, useEffect, useRef } from 'react';
import { askingOf, type Asking, type Question, type WhyLink } from '../../../core/asking';
import { shownTime } from '../../../core/numbers';
import { copyText } from '../../commands/clipboard';
import { useChanges, useStudio } from '../../hooks';
import { Blank } from '../../parts/blank';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { late } from '../../parts/late';
import { Segments } from '../../parts/segments';
import { Chain } from './chain';
import { questionOf, whyWords as words } from './words';
import '../../look/because.css';

const Decided = late(() => import('./decided'));

/** Why something is as it is: what it followed from, each a click from its place and its instant. */
export default function WhyPanel() {
  const studio = useStudio();
  const asking = askingOf(studio);
  useChanges(asking.changed);
  const views = [
    { value: 'why', words: words.why },
    { value: 'decided', words: words.decided },
  ] as const;
  return (
    <div className="because">
      <div className="because__views">
        <Segments
          small
          label={words.views}
          segments={views}
          chosen={asking.view}
          onChoose={(view) => asking.look(view)}
        />
      </div>
      {asking.view === 'why' ? (
        <Because asking={asking} />
      ) : (
        <Suspense>
          <Decided />
        </Suspense>
      )}
    </div>
  );
}

function Because({ asking }: { asking: Asking }) {
  const { question, chain, trouble } = asking;
  const frame = useFirstLink(chain);
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
    <div className="because" ref={frame} tabIndex={-1} data-autofocus={chain ? undefined : true}>
      <Head question={question} chain={chain} />
      {asking.waits ? (
        <p className="because__note" role="status">
          {words.waits}
        </p>
      ) : null}
      {trouble === '' ? null : (
        <p className="because__note is-error" role="alert">
          {trouble}
        </p>
      )}
      {chain ? <Chain chain={chain} /> : null}
    </div>
  );
}

/** Who asked by the keyboard goes on in the answer. */
function useFirstLink(chain: readonly WhyLink[] | null) {
  const frame = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const waits = document.activeElement === frame.current;
    if (chain && waits) frame.current?.querySelector<HTMLElement>('li button')?.focus();
  }, [chain]);
  return frame;
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

function textOf(question: Question, chain: readonly WhyLink[]): string {
  const lines = chain.map(({ t, what, value, place }) =>
    [`${shownTime(t)} s`, value === '' ? what : `${what} (${value})`, place].join('  ').trimEnd(),
  );
  return [questionOf(question), ...lines, ''].join('\n');
}
