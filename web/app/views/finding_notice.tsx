import { IconAlertOctagon, IconAlertTriangle } from '@tabler/icons-react';
import type { Doc, Finding } from '../../protocol/messages';
import { ordered } from '../../core/findings';
import { revealDoc } from '../../core/window_state';
import { pressFix } from '../commands/problem_commands';
import { useDrives, useStudio, useTopic } from '../hooks';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { text } from '../text';
import { FindingButton } from './plan/finding_button';

/** The first finding of a document that is not shown as its text; a press shows the place. */
export function FindingNotice({
  doc,
  onShow,
}: {
  doc: Doc;
  /** Shows what is meant without the text, if it can. */
  onShow?: (finding: Finding) => boolean;
}) {
  const studio = useStudio();
  const drives = useDrives();
  const all = useTopic('findings', {})?.findings ?? [];
  const found = ordered(all.filter((one) => one.doc === doc));
  const first = found[0];
  if (!first) return null;
  const error = first.severity === 'error';
  const Icon = error ? IconAlertOctagon : IconAlertTriangle;
  const fix = first.fixes[0];
  return (
    <div className={error ? 'notice notice--error' : 'notice'} role="status">
      <Icon className="icon" size={14} stroke={kStroke} aria-hidden />
      <span className="ellipsis" title={first.what}>
        {first.what}
      </span>
      {found.length > 1 ? (
        <span className="muted">{text.world.hidden(found.length - 1)}</span>
      ) : null}
      <span className="grow" />
      {fix ? (
        <Button small disabled={!drives} onClick={() => pressFix(studio, first, fix)}>
          {fix.label}
        </Button>
      ) : null}
      {fix ? null : <FindingButton finding={first} />}
      {onShow ? (
        <Button small kind="plain" onClick={() => onShow(first)}>
          {text.world.showIt}
        </Button>
      ) : null}
      <Button small kind="plain" onClick={() => revealDoc(studio.window, doc, first.at)}>
        {text.world.showText}
      </Button>
    </div>
  );
}
