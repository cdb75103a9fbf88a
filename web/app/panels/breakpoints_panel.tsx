import { IconTrash } from '@tabler/icons-react';
import type { Breakpoint } from '../../protocol/messages';
import { revealDoc } from '../../core/window_state';
import { nameOf } from '../dock/documents';
import { useDrives, useStudio, useTopic } from '../hooks';
import { Quiet } from '../parts/blank';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { text } from '../text';
import '../look/lists.css';

/** All breakpoints; the disc switches one on and off. */
export default function BreakpointsPanel() {
  const list = useTopic('breakpoints', {})?.breakpoints ?? [];
  if (list.length === 0) return <Quiet>{text.empty.breakpoints}</Quiet>;
  return (
    <ul className="scroll" aria-label={text.panels.breakpoints}>
      {[...list]
        .sort((a, b) => (a.doc < b.doc ? -1 : a.doc > b.doc ? 1 : a.line - b.line))
        .map((one) => (
          <Row key={`${one.doc}:${one.line}`} one={one} />
        ))}
    </ul>
  );
}

function Row({ one }: { one: Breakpoint }) {
  const studio = useStudio();
  const drives = useDrives();
  const { doc, line, condition, ignore, enabled, hits, set, why } = one;
  const place = `${nameOf(studio, doc)}:${line}`;
  const disc = !enabled
    ? 'disc disc--off'
    : condition || ignore
      ? 'disc disc--if'
      : !set && why
        ? 'disc disc--unset'
        : 'disc';
  return (
    <li className="bp">
      <button
        type="button"
        className="bp__open"
        data-inset
        title={why}
        onClick={() => revealDoc(studio.window, doc, { line, column: 1 })}
      >
        <span className={disc} aria-hidden />
        <code>{place}</code>
        {condition ? <code className="ellipsis">{text.editor.if(condition)}</code> : null}
        {ignore > 0 ? <span className="muted">{text.editor.after(ignore)}</span> : null}
        {enabled ? null : <span className="muted">{text.editor.off}</span>}
        <span className="bp__hits num">{text.editor.hits(hits)}</span>
      </button>
      <button
        type="button"
        className="switch"
        role="switch"
        aria-checked={enabled}
        aria-label={`${place}: ${text.editor.enabled}`}
        disabled={!drives}
        onClick={() => studio.order('break.set', { doc, line, enabled: !enabled })}
      />
      <Button
        kind="plain"
        small
        disabled={!drives}
        tip={`${text.editor.clear} ${place}`}
        icon={<IconTrash size={14} stroke={kStroke} />}
        onClick={() => studio.order('break.clear', { doc, line })}
      />
    </li>
  );
}
