import { IconPencil, IconTrash } from '@tabler/icons-react';
import { useEffect, useRef, useState } from 'react';
import type { PlanBoard } from '../../../../core/plan/board';
import { whyNoName } from '../../../../core/plan/edit';
import { useDrives, useStudio } from '../../../hooks';
import { Button } from '../../../parts/button';
import { kStroke } from '../../../parts/icons';
import { takeFocus } from '../../../parts/take_focus';
import { useDraft } from '../../../parts/use_draft';
import { drawWords as words } from '../words';
import { withBreaks } from '../break_acts';
import { TemplateIcon } from '../canvas/template_icon';
import { planDeskOf } from '../plan_desk';

const size = { size: 14, stroke: kStroke };

/** The name of what is chosen, to be changed in place; beside it what it is. */
export function FormHead(props: {
  board: PlanBoard;
  chosen: string;
  name: string;
  about: string;
  icon?: string;
  help?: string;
}) {
  const { board, chosen, name, about, icon, help } = props;
  const drives = useDrives();
  const [renames, rename] = useState(false);
  const desk = planDeskOf(useStudio());
  useEffect(() => desk.onRename(() => rename(true)), [desk]);
  return (
    <header className="props__head">
      {icon ? <TemplateIcon icon={icon} /> : null}
      <div className="grow">
        {renames ? (
          <NameField board={board} chosen={chosen} name={name} onDone={() => rename(false)} />
        ) : (
          <h2 className="props__name ellipsis">{name}</h2>
        )}
        <p className="props__kind ellipsis" title={help}>
          {about}
        </p>
      </div>
      <Button
        kind="plain"
        small
        disabled={!drives}
        tip={`${words.rename}  (F2)`}
        icon={<IconPencil {...size} />}
        onClick={() => rename(true)}
      />
      <Button
        kind="plain"
        small
        disabled={!drives}
        tip={`${words.remove}  (Delete)`}
        icon={<IconTrash {...size} />}
        onClick={() => {
          board.select(chosen);
          desk.shown?.focus(board.removeChosen());
        }}
      />
    </header>
  );
}

function NameField(props: { board: PlanBoard; chosen: string; name: string; onDone: () => void }) {
  const { board, chosen, name, onDone } = props;
  const studio = useStudio();
  const field = useRef<HTMLInputElement>(null);
  useEffect(
    () => takeFocus(() => (field.current?.focus(), document.activeElement === field.current)),
    [],
  );
  const is = board.variable(chosen)
    ? 'variable'
    : board.supervisor(chosen)
      ? 'supervisor'
      : 'actor';
  const whyNot = (typed: string | null) =>
    typed === null || typed === name ? null : whyNoName(board.model, typed, is);
  const draft = useDraft(
    name,
    (typed) =>
      whyNot(typed) === null && withBreaks(studio, board, () => board.rename(chosen, typed)),
  );
  const why = whyNot(draft.typed);
  // A name that cannot be stays in its field, with the reason below it.
  const done = () => {
    if (draft.done()) onDone();
  };
  return (
    <>
      <input
        className="field field--small"
        aria-label={words.name}
        aria-invalid={why !== null || draft.isRefused}
        ref={field}
        value={draft.shown}
        onFocus={(event) => event.target.select()}
        onChange={(event) => draft.set(event.target.value)}
        onBlur={done}
        onKeyDown={(event) => {
          if (event.key === 'Enter') done();
          else if (event.key === 'Escape') onDone();
        }}
      />
      {why === null ? null : <p className="planform__why">{words.badName[why]}</p>}
    </>
  );
}
