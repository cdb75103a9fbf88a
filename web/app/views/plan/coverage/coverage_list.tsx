import { useState } from 'react';
import { countedIn, type Counted } from '../../../../core/plan/coverage';
import type { Doc, PlanCoverage } from '../../../../protocol/messages';
import { useStudio } from '../../../hooks';
import { stepThroughRows } from '../../../parts/list_keys';
import { coverageWords as words } from '../../tests/words';
import { planDeskOf } from '../plan_desk';

/** All that was counted, pairs of consecutive actors too; each a click from its place in the drawing. */
export function CoverageList({ doc, counts }: { doc: Doc; counts: PlanCoverage }) {
  const studio = useStudio();
  const [only, setOnly] = useState(true);
  const shown = countedIn(counts).filter(({ count }) => !only || count === 0);
  const show = ({ keys }: Counted) => {
    const view = planDeskOf(studio).find(({ board }) => board.doc === doc);
    view?.board.selectAll(keys);
    const [first] = keys.flatMap((key) => view?.board.boxOf(key) ?? []);
    if (first) view?.showBox(first);
  };
  return (
    <>
      <button
        type="button"
        role="switch"
        className="switch pcoverage__only"
        aria-checked={only}
        onClick={() => setOnly(!only)}
      >
        {words.only}
      </button>
      {shown.length === 0 ? <p>{words.nothing}</p> : null}
      <ul className="pcoverage__list" aria-label={words.list} onKeyDown={stepThroughRows}>
        {shown.map((one) => (
          <li key={`${one.kind} ${one.name}`}>
            <button type="button" className="pcoverage__one" data-inset onClick={() => show(one)}>
              <span className="muted">{words.kind(one.kind)}</span>
              <span className="ellipsis">
                {one.kind === 'pairs' ? one.keys.join(' → ') : one.name}
              </span>
              <span className={`num pcoverage__count ${one.count === 0 ? 'is-never' : ''}`}>
                {words.count(one.count)}
              </span>
            </button>
          </li>
        ))}
      </ul>
    </>
  );
}
