import type { Finding } from '../../../protocol/messages';
import { useDrives, useStudio } from '../../hooks';
import { Button } from '../../parts/button';
import { actFor } from './finding_acts';

/** Leads to the arrow or the field that a finding of a plan asks for. */
export function FindingButton({ finding }: { finding: Finding }) {
  const studio = useStudio();
  const drives = useDrives();
  const act = actFor(studio, finding);
  if (!act) return null;
  return (
    <Button small disabled={!drives} onClick={act.run}>
      {act.label}
    </Button>
  );
}
