import type { Breakpoint } from '../../../protocol/messages';
import { revealDoc } from '../../../core/window_state';
import { nameOf } from '../../documents';
import { useStudio } from '../../hooks';
import { text } from '../../text';
import { BreakRow } from './break_row';

export function ScriptRow({ one }: { one: Breakpoint }) {
  const studio = useStudio();
  const { doc, line, condition, ignore, enabled, hits, set, why } = one;
  const place = `${nameOf(studio, doc)}:${line}`;
  const sometimes = condition !== '' || ignore > 0;
  return (
    <BreakRow
      disc={!enabled ? 'off' : sometimes ? 'if' : !set && why ? 'unset' : 'on'}
      name={place}
      enabled={enabled}
      hits={hits}
      why={why}
      onGo={() => revealDoc(studio.window, doc, { line, column: 1 })}
      onSwitch={() => studio.order('break.set', { doc, line, enabled: !enabled })}
      onClear={() => studio.order('break.clear', { doc, line })}
    >
      <code>{place}</code>
      {condition ? <code className="ellipsis">{text.editor.if(condition)}</code> : null}
      {ignore > 0 ? <span className="muted">{text.editor.after(ignore)}</span> : null}
    </BreakRow>
  );
}
