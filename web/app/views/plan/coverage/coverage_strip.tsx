import { IconList, IconX } from '@tabler/icons-react';
import { useState } from 'react';
import { coverageKinds, type CoverageKind } from '../../../../core/plan/coverage';
import { testOptionsOf } from '../../../../core/tests';
import type { Doc, PlanCoverage } from '../../../../protocol/messages';
import { useStudio } from '../../../hooks';
import { Button } from '../../../parts/button';
import { kStroke } from '../../../parts/icons';
import { coverageWords as words } from '../../tests/words';
import { CoverageList } from './coverage_list';
import { usePlanCoverage } from './use_coverage';
import '../../../look/tests.css';

const size = { size: 14, stroke: kStroke };

/** Above the drawing: how much of each kind was taken, what the marks mean, all of it as a list. */
export default function CoverageStrip({ doc }: { doc: Doc }) {
  const options = testOptionsOf(useStudio());
  const [lists, setLists] = useState(false);
  const coverage = usePlanCoverage(doc);
  if (!coverage) return null;
  const { counts, changed } = coverage;
  return (
    <section className="pcoverage" aria-label={words.strip} data-place="plan-parts">
      <div className="pcoverage__row">
        <ul className="pcoverage__kinds" aria-label={words.table}>
          {coverageKinds.map((kind) => (
            <Share key={kind} kind={kind} counts={counts} />
          ))}
        </ul>
        <span className="grow" />
        <span className="pcoverage__sign is-taken">
          <i aria-hidden /> {words.taken}
        </span>
        <span className="pcoverage__sign is-never">
          <i aria-hidden /> {words.never}
        </span>
        <Button
          kind="plain"
          small
          aria-pressed={lists}
          tip={words.list}
          icon={<IconList {...size} />}
          onClick={() => setLists(!lists)}
        />
        <Button
          kind="plain"
          small
          tip={words.hide}
          icon={<IconX {...size} />}
          onClick={() => options.toggle('coverage', false)}
        />
      </div>
      {changed ? <p className="pcoverage__changed">{words.changed}</p> : null}
      {lists ? <CoverageList doc={doc} counts={counts} /> : null}
    </section>
  );
}

function Share({ kind, counts }: { kind: CoverageKind; counts: PlanCoverage }) {
  const all = Object.values(counts[kind]);
  const taken = all.filter((count) => count > 0).length;
  return (
    <li>
      {words.kinds[kind]} <b className="num">{words.share(taken, all.length)}</b>
    </li>
  );
}
