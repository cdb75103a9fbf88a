import { useState } from 'react';
import type { Json, PlanVariable } from '../../../protocol/messages';
import type { Variable } from '../../../core/plan/model';
import { typedValue } from '../../../core/plan_view';
import { useStudio } from '../../hooks';
import { OverlayFrame, useCloseOverlay } from '../../parts/overlay_frame';
import { Button } from '../../parts/button';
import { rememberPlan } from '../../commands/looks';
import { planDeskOf } from './plan_desk';
import { planWords } from './live_words';

const words = planWords.from;

/** Runs the plan from the actor that is chosen, with values of the variables. */
export default function RunFrom() {
  const studio = useStudio();
  const close = useCloseOverlay();
  const { shown } = planDeskOf(studio);
  const board = shown?.board;
  const actor = board?.actor(board.selected);
  const [typed, type] = useState<Readonly<Record<string, string>>>({});
  if (!board || !actor) return null;
  const fields = board.model.variables.flatMap((one) => fieldOf(one, typed[one.name]));
  const wrong = fields.some((one) => one.value === undefined);
  const run = () => {
    if (wrong) return;
    close();
    start(studio, board.doc, actor.name, fields).catch((problem: unknown) => studio.tell(problem));
  };
  return (
    <OverlayFrame label={words.title(actor.name)}>
      <form
        className="sheet sheet--small form"
        onSubmit={(event) => (event.preventDefault(), run())}
      >
        <div className="sheet__head">
          <h2>{words.title(actor.name)}</h2>
        </div>
        <p className="quiet">{fields.length === 0 ? words.noVariables : words.help}</p>
        {fields.map((one, index) => (
          <label key={one.name}>
            {one.name}{' '}
            <span className="muted">{[one.type, one.unit].filter(Boolean).join(', ')}</span>
            <input
              className="field field--ui num"
              autoFocus={index === 0}
              autoComplete="off"
              value={one.typed}
              aria-invalid={one.value === undefined}
              onFocus={(event) => event.target.select()}
              onChange={(event) => type({ ...typed, [one.name]: event.target.value })}
            />
            {one.value === undefined ? <span className="why">{words.bad[one.type]}</span> : null}
          </label>
        ))}
        <div className="form__end">
          <Button onClick={close}>{words.cancel}</Button>
          <Button kind="primary" type="submit" disabled={wrong} autoFocus={fields.length === 0}>
            {words.run}
          </Button>
        </div>
      </form>
    </OverlayFrame>
  );
}

interface ValueField {
  name: string;
  type: Exclude<PlanVariable['type'], 'object'>;
  unit: string;
  typed: string;
  /** undefined: what is typed is none. */
  value: Json | undefined;
  isOther: boolean;
}

const kTypes = ['bool', 'int', 'float', 'string'] as const;

/** Objects are made by actors only. */
function fieldOf(variable: Variable, typed: string | undefined): ValueField[] {
  const type = kTypes.find((one) => one === variable.type);
  if (!type) return [];
  const initial = initialOf(type, variable.initial);
  const now = typed ?? initial;
  return [
    {
      name: variable.name,
      type,
      unit: variable.unit,
      typed: now,
      value: typedValue(type, now),
      isOther: now !== initial,
    },
  ];
}

/** As it is typed: the model shows a text in quotes, and nothing where the file says nothing. */
function initialOf(type: ValueField['type'], shown: string): string {
  if (type === 'string') return shown.slice(1, -1);
  return shown || { bool: 'false', int: '0', float: '0' }[type];
}

async function start(
  studio: ReturnType<typeof useStudio>,
  doc: string,
  from: string,
  fields: readonly ValueField[],
): Promise<void> {
  const set = Object.fromEntries(
    fields.flatMap(({ name, value, isOther }) =>
      isOther && value !== undefined ? [[name, value]] : [],
    ),
  );
  const started = await studio.inTurn(studio.documents.flushAll(), (_, due) =>
    studio.send('plan.start', { doc, from, set }, due),
  );
  if (started !== null) rememberPlan(studio, doc);
}
