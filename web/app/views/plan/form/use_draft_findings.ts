// What would be wrong with a formula that is being typed: asked of the checker itself, a moment
// after the last key.

import { useEffect, useState } from 'react';
import type { Doc, Finding, JsonStep } from '../../../../protocol/messages';
import type { Keys } from '../../../../core/plan/model';
import { findingsAt } from '../../../../core/plan/row_findings';
import { useStudio } from '../../../hooks';

const kPauseMs = 120;

/** null: nothing is being typed, or the checker has not said anything of it yet. */
export function useDraftFindings(doc: Doc, keys: Keys, steps: JsonStep[] | null): Finding[] | null {
  const studio = useStudio();
  const [found, setFound] = useState<Finding[] | null>(null);
  const asked = steps && JSON.stringify(steps);
  const way = keys.join('\n');
  if (asked === null && found !== null) setFound(null);
  useEffect(() => {
    if (asked === null) return;
    let isLate = false;
    const cancel = studio.world.later(kPauseMs, () => {
      studio.send('plan.check', { doc, steps: JSON.parse(asked) as JsonStep[] }).then(
        ({ findings }) => isLate || setFound(findingsAt(findings, way.split('\n'))),
        // Others changed the plan meanwhile: what was found there before is still true.
        () => {},
      );
    });
    return () => {
      isLate = true;
      cancel();
    };
  }, [studio, doc, way, asked]);
  return found;
}
