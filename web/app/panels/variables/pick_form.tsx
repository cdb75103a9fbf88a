import { IconPlus } from '@tabler/icons-react';
import { useId, useState } from 'react';
import { kPlanName, kPlanNode, placeOf, readPick, type Pick } from '../../../core/picks';
import { variableNamed } from '../../../core/plan_view';
import type { Studio } from '../../../core/studio';
import type { NodeId, Variable } from '../../../protocol/messages';
import { shownNode } from '../../commands/looks';
import { useStudio, useTopic } from '../../hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { useVariablesOf } from '../../robot_hooks';
import { text } from '../../text';

const words = text.variables;

/** A description that takes longer does not come. */
const kDescribedWithinMs = 5000;

async function variablesOf(studio: Studio, node: NodeId): Promise<readonly Variable[]> {
  const known = await studio.topics.until(
    'node',
    { node },
    (is) => is.variables.length > 0,
    kDescribedWithinMs,
  );
  return known?.variables ?? [];
}

async function pickOfNode(studio: Studio, pick: Pick | null) {
  if (!pick || pick.node === kPlanNode) return null;
  const place = placeOf(pick, await variablesOf(studio, pick.node));
  return place ? { pick, size: place.count } : null;
}

/** With "plan." in front also before the plan runs; the bare name if it runs and has it. */
function pickOfPlan(studio: Studio, pick: Pick | null, typed: string) {
  const isMeant = pick?.node === kPlanNode && pick.index === undefined;
  const name = isMeant ? pick.name : typed;
  const levels = studio.topics.get('plan', {})?.levels ?? [];
  if (!isMeant && !variableNamed(levels, name)) return null;
  return { pick: { node: kPlanNode, name }, size: 1 };
}

/** "drive.token" or "token" of the script that is looked at: typed, with what there is to choose. */
export function PickForm({
  label,
  find,
  onPick,
}: {
  label: string;
  find: string;
  onPick(pick: Pick, size: number): void;
}) {
  const studio = useStudio();
  const nodes = useTopic('robot', {})?.nodes ?? [];
  const levels = useTopic('plan', {})?.levels ?? [];
  const [typed, setTyped] = useState('');
  const [wrong, setWrong] = useState(false);
  const [asked, setAsked] = useState(false);
  const list = useId();
  // The descriptions of all nodes are asked when someone begins to type.
  const described = useVariablesOf(asked ? nodes.map((node) => node.id) : []);
  const add = async () => {
    const pick = readPick(typed, nodes, (shownNode(studio) ?? nodes[0])?.id ?? null);
    const found = (await pickOfNode(studio, pick)) ?? pickOfPlan(studio, pick, typed.trim());
    if (!found) return setWrong(true);
    onPick(found.pick, found.size);
    setTyped('');
  };
  return (
    <form
      className="strip-bar__form"
      onSubmit={(event) => {
        event.preventDefault();
        void add();
      }}
    >
      <input
        className="field field--small"
        data-find={find}
        list={list}
        aria-label={label}
        placeholder={label}
        aria-invalid={wrong}
        aria-describedby={wrong ? `${list}why` : undefined}
        value={typed}
        spellCheck={false}
        onFocus={() => setAsked(true)}
        onChange={(event) => (setTyped(event.target.value), setWrong(false))}
      />
      <datalist id={list}>
        {levels.flatMap((level) =>
          level.variables.map(({ name }) => (
            <option key={`${level.path} ${name}`} value={`${kPlanName}.${name}`} />
          )),
        )}
        {nodes.flatMap((node) =>
          (described.get(node.id) ?? []).map((variable) => (
            <option key={`${node.id} ${variable.name}`} value={`${node.name}.${variable.name}`} />
          )),
        )}
      </datalist>
      <Button
        kind="plain"
        small
        type="submit"
        tip={words.add}
        icon={<IconPlus size={14} stroke={kStroke} />}
      />
      {wrong ? (
        <span className="why" id={`${list}why`} role="alert">
          {words.noSuch}
        </span>
      ) : null}
    </form>
  );
}
