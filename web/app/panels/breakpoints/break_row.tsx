import { IconTrash } from '@tabler/icons-react';
import type { ReactNode } from 'react';
import type { Disc } from '../../../core/plan/breaks';
import { useDrives } from '../../hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { text } from '../../text';
import { breakWords } from './words';

/** One breakpoint: its disc and place, which lead there, a switch, and away with it. */
export function BreakRow(props: {
  disc: Disc;
  name: string;
  children: ReactNode;
  enabled: boolean;
  hits: number;
  holds?: boolean;
  why?: string | undefined;
  onGo(): void;
  onSwitch(): void;
  onClear(): void;
}) {
  const { disc, name, children, enabled, hits, holds, why, onGo, onSwitch, onClear } = props;
  const drives = useDrives();
  return (
    <li className={holds ? 'bp is-hit' : 'bp'}>
      <button type="button" className="bp__open" data-inset title={why} onClick={onGo}>
        <span className={`disc disc--${disc}`} aria-hidden />
        {children}
        {enabled ? null : <span className="muted">{text.editor.off}</span>}
        {holds ? <span className="bp__holds">{breakWords.holds}</span> : null}
        <span className="bp__hits num">{text.editor.hits(hits)}</span>
      </button>
      <button
        type="button"
        className="switch"
        role="switch"
        aria-checked={enabled}
        aria-label={`${name}: ${text.editor.enabled}`}
        disabled={!drives}
        onClick={onSwitch}
      />
      <Button
        kind="plain"
        small
        disabled={!drives}
        tip={`${text.editor.clear} ${name}`}
        icon={<IconTrash size={14} stroke={kStroke} />}
        onClick={onClear}
      />
    </li>
  );
}
