import { IconPlus } from '@tabler/icons-react';
import { useId, useState } from 'react';
import { placeOf, readPick, type Pick } from '../../../core/picks';
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
  const [typed, setTyped] = useState('');
  const [wrong, setWrong] = useState(false);
  const [asked, setAsked] = useState(false);
  const list = useId();
  // The descriptions of all nodes are asked when someone begins to type.
  const described = useVariablesOf(asked ? nodes.map((node) => node.id) : []);
  const add = async () => {
    const pick = readPick(typed, nodes, (shownNode(studio) ?? nodes[0])?.id ?? null);
    const place = pick && placeOf(pick, await variablesOf(studio, pick.node));
    if (!place) return setWrong(true);
    onPick(pick, place.count);
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
        title={wrong ? words.noSuch : undefined}
        value={typed}
        spellCheck={false}
        onFocus={() => setAsked(true)}
        onChange={(event) => (setTyped(event.target.value), setWrong(false))}
      />
      <datalist id={list}>
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
    </form>
  );
}
