import { IconChevronDown, IconChevronRight } from '@tabler/icons-react';
import { useEffect, useEffectEvent, useRef, useState } from 'react';
import type { NumberForm } from '../../../core/numbers';
import { pickName, type Pick } from '../../../core/picks';
import { toast } from '../../../core/window_state';
import { useDrives, useStudio } from '../../hooks';
import { usePastTime } from '../../past_hooks';
import { kStroke } from '../../parts/icons';
import { text } from '../../text';
import { PickButtons } from './pick_buttons';
import { LiveBar, LiveValue, type Place } from './live_value';
import { ValueEditor } from './value_editor';

const words = text.variables;
const icon = { size: 14, stroke: kStroke, 'aria-hidden': true } as const;
export const kDragType = 'application/x-vagus-variable';

/** A variable, or an element of one: name, value, unit, and what can be done with it. */
export function VariableLine({
  pick,
  place,
  form,
  name,
  open,
  onToggle,
  inWatch,
}: {
  pick: Pick;
  place: Place;
  form: NumberForm;
  name: string;
  open?: boolean | undefined;
  onToggle?: (() => void) | undefined;
  inWatch?: boolean;
}) {
  const studio = useStudio();
  const drives = useDrives();
  const past = usePastTime();
  const row = useRef<HTMLDivElement>(null);
  const [edits, setEdits] = useState(false);
  const { variable } = place;
  const why = past !== null ? text.whyNot.looksBack : drives ? '' : text.whyNot.viewOnly;
  const edit = () =>
    why === ''
      ? setEdits(true)
      : toast(studio.window, 'note', `${words.change(pickName(pick))}: ${why}`);
  // Below its unfolded array; elsewhere an element is by itself.
  const isElement = name.startsWith('[');
  useEditKey(row, variable.writable, edit);
  return (
    <div
      className="variable"
      ref={row}
      draggable={!edits}
      onDragStart={(event) => event.dataTransfer.setData(kDragType, JSON.stringify(pick))}
    >
      <Toggle open={open} onToggle={onToggle} name={name} />
      <code
        className={isElement ? 'ellipsis variable__index' : 'ellipsis'}
        title={variable.help ? `${variable.name}: ${variable.help}` : variable.name}
      >
        {name}
        {variable.size > 1 && pick.index === undefined ? (
          <span className="muted">[{variable.size}]</span>
        ) : null}
      </code>
      {edits ? (
        <ValueEditor place={place} onEnd={() => (setEdits(false), focusRow(row.current))} />
      ) : (
        <button
          type="button"
          className="value"
          data-inset
          data-edit
          tabIndex={-1}
          disabled={!variable.writable}
          aria-disabled={why !== '' || undefined}
          title={(variable.writable ? words.change : words.valueOf)(pickName(pick))}
          onClick={edit}
        >
          {isElement ? <LiveBar place={place} /> : null}
          <LiveValue place={place} form={form} row={row} />
        </button>
      )}
      <span className="variable__unit ellipsis">{variable.unit ?? ''}</span>
      <PickButtons pick={pick} size={place.count} inWatch={inWatch} />
    </div>
  );
}

function Toggle({
  open,
  onToggle,
  name,
}: {
  open: boolean | undefined;
  onToggle: (() => void) | undefined;
  name: string;
}) {
  if (!onToggle) return <span className="variable__dot" aria-hidden />;
  const Icon = open ? IconChevronDown : IconChevronRight;
  return (
    <button
      type="button"
      className="variable__toggle"
      tabIndex={-1}
      aria-expanded={open}
      aria-label={words.elements(name)}
      onClick={onToggle}
    >
      <Icon {...icon} size={12} />
    </button>
  );
}

/** Enter on the row of the list edits its value. */
function useEditKey(
  row: React.RefObject<HTMLElement | null>,
  may: boolean,
  edit: () => void,
): void {
  const begin = useEffectEvent(edit);
  useEffect(() => {
    const item = row.current?.closest<HTMLElement>('[data-row]');
    if (!item || !may) return;
    const pressed = (event: globalThis.KeyboardEvent) => {
      if (event.key !== 'Enter' || event.target !== item) return;
      event.preventDefault();
      begin();
    };
    item.addEventListener('keydown', pressed);
    return () => item.removeEventListener('keydown', pressed);
  }, [row, may]);
}

function focusRow(row: HTMLElement | null): void {
  row?.closest<HTMLElement>('[data-row]')?.focus();
}
