import { useState } from 'react';
import type { Json, PlanOutput } from '../../../../protocol/messages';
import type { PlanBoard } from '../../../../core/plan/board';
import type { Supervisor } from '../../../../core/plan/model';
import { typedValue } from '../../../../core/plan_view';
import { useDrives, useStudio, useTopic } from '../../../hooks';
import { Button } from '../../../parts/button';
import { drawWords } from '../words';
import { Field } from '../../world/fields';

const words = drawWords.raise;

/** While a supervisor watches: its events, raised by hand, with the outputs that they give. */
export function RaisePart({ board, supervisor }: { board: PlanBoard; supervisor: Supervisor }) {
  const studio = useStudio();
  const drives = useDrives();
  const plan = useTopic('plan', {});
  const [typed, type] = useState<Readonly<Record<string, string>>>({});
  const level = plan?.levels.findLast((one) => one.doc === board.doc);
  const goes = plan?.state === 'running' || plan?.state === 'paused';
  const watches = level?.supervisors.some((one) => one.name === supervisor.name && one.watching);
  if (!goes || !watches) return null;
  const outputs = (supervisor.known?.outputs ?? []).filter(
    ({ name }) => supervisor.outputs[name] !== undefined,
  );
  const given = outputsOf(outputs, typed);
  return (
    <section className="planform__part" aria-label={words.title}>
      <h3>{words.title}</h3>
      {outputs.map((one) => (
        <Field key={one.name} label={one.name} unit={one.unit}>
          {(id) => (
            <input
              id={id}
              className="field field--small"
              title={one.help}
              value={typed[one.name] ?? ''}
              aria-invalid={given === null && valueFor(one, typed[one.name]) === undefined}
              disabled={!drives}
              onChange={(event) => type({ ...typed, [one.name]: event.target.value })}
            />
          )}
        </Field>
      ))}
      <div className="raise">
        {supervisor.outcomes.map(({ name }) => (
          <Button
            key={name}
            small
            disabled={!drives || given === null}
            onClick={() =>
              studio.order('plan.raise', {
                supervisor: supervisor.name,
                event: name,
                outputs: given ?? {},
              })
            }
          >
            {words.event(name)}
          </Button>
        ))}
      </div>
    </section>
  );
}

/** Nothing typed is the type's own nothing: 0, false, an empty text. */
function valueFor(output: PlanOutput, typed: string | undefined): Json | undefined {
  if (output.type === 'object') return undefined;
  if (output.type === 'any') return typed ?? '';
  const empty = { bool: 'false', int: '0', float: '0', string: '' }[output.type];
  return typedValue(output.type, typed === undefined || typed === '' ? empty : typed);
}

function outputsOf(
  outputs: readonly PlanOutput[],
  typed: Readonly<Record<string, string>>,
): Record<string, Json> | null {
  const given: Record<string, Json> = {};
  for (const one of outputs) {
    const value = valueFor(one, typed[one.name]);
    if (value === undefined && one.type !== 'object') return null;
    if (value !== undefined) given[one.name] = value;
  }
  return given;
}
