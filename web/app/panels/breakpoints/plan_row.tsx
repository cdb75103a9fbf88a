import type { PlanBreakpoint } from '../../../protocol/messages';
import { discOf } from '../../../core/plan/breaks';
import { shownName } from '../../../core/paths';
import { usePart, useStudio } from '../../hooks';
import { text } from '../../text';
import { changeBreak } from '../../views/plan/break_acts';
import { revealElement } from '../../views/plan/reveal_element';
import { BreakRow } from './break_row';
import { breakWords as words } from './words';

export function PlanRow({ one }: { one: PlanBreakpoint }) {
  const studio = useStudio();
  const { number, doc, kind, condition, stop_at, enabled, hits, why } = one;
  const holds = usePart('plan', {}, (is) => is?.stands_at?.includes(number) ?? false);
  const place = text.breakpoints.place(one);
  return (
    <BreakRow
      disc={discOf(one)}
      name={place}
      enabled={enabled}
      hits={hits}
      holds={holds}
      why={why}
      onGo={() => revealElement(studio, doc, one.element)}
      onSwitch={() => changeBreak(studio, one, { enabled: !enabled })}
      onClear={() => studio.order('plan.break.clear', { number })}
    >
      <span className="ellipsis">{place}</span>
      {kind !== 'condition' && condition ? (
        <code className="ellipsis">{text.editor.if(condition)}</code>
      ) : null}
      {stop_at > 1 ? <span className="muted">{words.from(stop_at)}</span> : null}
      <span className="muted ellipsis">{shownName(doc)}</span>
      {why ? <span className="bp__why ellipsis">{why}</span> : null}
    </BreakRow>
  );
}
