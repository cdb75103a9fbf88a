import type { Doc } from '../../../../protocol/messages';
import type { Trying } from '../../../../core/plan/trying';
import type { Studio } from '../../../../core/studio';
import { revealDoc, toast } from '../../../../core/window_state';
import { useDrives, useStudio } from '../../../hooks';
import { Button } from '../../../parts/button';
import { tryWords as words } from './words';

/** Writes the way as a test, and opens it. */
export function KeepTest({ doc, trying }: { doc: Doc; trying: Trying }) {
  const studio = useStudio();
  const drives = useDrives();
  return (
    <Button
      small
      disabled={!drives || trying.way.length === 0 || trying.trouble !== ''}
      tip={words.keepHelp}
      onClick={() => void keep(studio, doc, trying)}
    >
      {words.keep}
    </Button>
  );
}

async function keep(studio: Studio, doc: Doc, { way }: Trying): Promise<void> {
  try {
    await studio.documents.flushAll();
    const { path } = await studio.send('plan.try.keep', { doc, way: [...way] });
    toast(studio.window, 'ok', words.saved(path));
    revealDoc(studio.window, path, null);
  } catch (problem) {
    studio.tell(problem);
  }
}
