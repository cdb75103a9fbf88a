import type { Doc } from '../../../../protocol/messages';
import { useStudio } from '../../../hooks';
import { Button } from '../../../parts/button';
import { showDifferences } from './compare_commands';
import { compareWords as words } from './words';

/** In a notice: what differs from the version that it is about. */
export function ShowDifferences({ doc, from }: { doc: Doc; from: 'disk' | 'running' | 'then' }) {
  const studio = useStudio();
  const then = studio.past.shown ?? 0;
  const other =
    from === 'then'
      ? { against: from, t: then, name: words.names.then(then.toFixed(3)) }
      : { against: from, name: words.names[from] };
  return (
    <Button small kind="plain" onClick={() => showDifferences(studio, doc, other)}>
      {words.show}
    </Button>
  );
}
