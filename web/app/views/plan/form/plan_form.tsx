import { supervisorKey } from '../../../../core/plan/arrows';
import type { PlanBoard } from '../../../../core/plan/board';
import { kStart } from '../../../../core/plan/model';
import { useDrives } from '../../../hooks';
import { Quiet } from '../../../parts/blank';
import { FieldsOf } from '../../../parts/use_draft';
import { text } from '../../../text';
import { drawWords as words } from '../words';
import { RoleShape } from '../canvas/template_icon';
import { useBoard, type ShownPlan } from '../plan_desk';
import { BreakPart } from './break_part';
import { ElementForm } from './element_form';
import { FormHead } from './form_head';
import { Leads } from './leads';
import { NoteForm } from './note_form';
import { RaisePart } from './raise_part';
import { VariableForm } from './variable_form';

/** What is chosen in a plan, to be changed exactly. */
export function PlanForm({ plan }: { plan: ShownPlan }) {
  const board = useBoard(plan.board);
  const drives = useDrives();
  const { selected } = board;
  if (selected === null) return <Quiet>{words.noneSelected}</Quiet>;
  const arrow = board.arrow(selected);
  const key = arrow ? arrow.source : selected;
  return (
    <section
      className="props"
      key={key}
      aria-label={text.panels.properties}
      data-place="plan-parts"
    >
      {board.selection.size > 1 ? (
        <p className="props__many">{words.several(board.selection.size)}</p>
      ) : null}
      <FieldsOf value={board.doc}>
        <Chosen board={board} chosen={key} disabled={!drives} />
      </FieldsOf>
    </section>
  );
}

function Chosen(props: { board: PlanBoard; chosen: string; disabled: boolean }) {
  const { board, chosen, disabled } = props;
  const element = board.element(chosen);
  const variable = board.variable(chosen);
  if (chosen === kStart) return <StartForm board={board} disabled={disabled} />;
  if (variable)
    return (
      <>
        <FormHead board={board} chosen={chosen} name={variable.name} about={words.variable} />
        <VariableForm board={board} name={variable.name} disabled={disabled} />
      </>
    );
  const note = board.note(chosen);
  if (note)
    return (
      <>
        <header className="props__head">
          <h2 className="props__name">{words.note}</h2>
        </header>
        <NoteForm board={board} note={note} disabled={disabled} />
      </>
    );
  if (!element) return <Quiet>{words.noneSelected}</Quiet>;
  const about = [element.template, element.toolbox].filter(Boolean).join(' · ');
  return (
    <>
      <FormHead
        board={board}
        chosen={chosen}
        name={element.name}
        about={about}
        icon={element.known?.icon ?? ''}
        help={element.known?.help ?? ''}
      />
      <ElementForm board={board} chosen={chosen} element={element} disabled={disabled} />
      {'supervisors' in element ? (
        <Hanging board={board} keys={element.supervisors} />
      ) : (
        <RaisePart board={board} supervisor={element} />
      )}
      <BreakPart board={board} chosen={chosen} outcomes={element.outcomes} disabled={disabled} />
    </>
  );
}

function StartForm({ board, disabled }: { board: PlanBoard; disabled: boolean }) {
  const first = [{ name: '', target: board.model.first, help: '' }];
  return (
    <>
      <header className="props__head">
        <h2 className="props__name">{words.start}</h2>
      </header>
      <Leads board={board} source={kStart} outcomes={first} disabled={disabled} />
      <Hanging board={board} keys={board.model.globals} />
    </>
  );
}

/** The supervisors under an element; a press chooses one. */
function Hanging(props: { board: PlanBoard; keys: PlanBoard['model']['globals'] }) {
  const { board, keys } = props;
  return (
    <section className="planform__part" aria-label={words.supervisors}>
      <h3>{words.supervisors}</h3>
      {keys.length === 0 ? <Quiet>{words.noSupervisors}</Quiet> : null}
      {keys.map((one) => (
        <button
          key={one.name}
          type="button"
          className="plantool"
          onClick={() => board.select(supervisorKey(one))}
        >
          <RoleShape kind="supervisor" label={words.roles.supervisor} />
          <span className="ellipsis">{one.name}</span>
          <span className="muted ellipsis">{one.template}</span>
        </button>
      ))}
    </section>
  );
}
