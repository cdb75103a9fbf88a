import { memo } from 'react';
import type { Node } from '../../../protocol/messages';
import { shownRate } from '../../../core/numbers';
import { revealDoc, update } from '../../../core/window_state';
import type { NodeAct } from '../../commands/run_commands';
import { useStudio, useWindow } from '../../hooks';
import { useNodeWord } from '../../robot_hooks';
import { StateSign } from '../../parts/state_sign';
import { text } from '../../text';
import { words } from './words';
import { NodeControls } from './node_controls';
import { WriteScript } from '../../parts/write_script';
import { NetworkPart, type Column } from './network_part';
import type { NetworkState } from './use_network';

const { columns } = words;
const kColumns: readonly Column[] = [
  { title: '' },
  { title: columns.node },
  { title: columns.state },
  { title: columns.program },
  { title: columns.says, is: 'number' },
  { title: columns.hears, is: 'number' },
  { title: columns.controls, is: 'hidden' },
];

/** One row for each node; the buttons above are for those that are chosen, or for all. */
export function NodeTable({ network: { nodes, talk } }: { network: NetworkState }) {
  const chosen = useWindow((state) => state.chosenNodes);
  const there = chosen.filter((id) => nodes.some((node) => node.id === id));
  const name = there.length > 0 ? words.forSome(there.length) : words.forAll;
  return (
    <NetworkPart
      title={words.nodes}
      count={nodes.length}
      tools={
        <>
          <span className="grow" />
          <span className="muted">{name}</span>
          <NodeControls nodes={there} name={name} />
        </>
      }
      columns={kColumns}
      className="table table--nodes"
    >
      {nodes.map((node) => (
        <Row
          key={node.id}
          node={node}
          says={shownRate(talk.get(node.id)?.says ?? 0)}
          hears={shownRate(talk.get(node.id)?.hears ?? 0)}
          chosen={chosen.includes(node.id)}
        />
      ))}
    </NetworkPart>
  );
}

interface RowProps {
  node: Node;
  says: string;
  hears: string;
  chosen: boolean;
}

// The document of the robot comes again with each change of one node: rows are told apart by content.
const Row = memo(NodeRow, (before, after) => JSON.stringify(before) === JSON.stringify(after));

function NodeRow({ node, says, hears, chosen }: RowProps) {
  const { window: store } = useStudio();
  const wordOf = useNodeWord();
  const { id, name, state, at, program, doc, fault, busy, stop } = node;
  const unstopped = stop !== undefined && stop !== 'stopped' ? text.stop.states[stop] : undefined;
  const choose = () =>
    update(store, (draft) => {
      draft.chosenNodes = chosen
        ? draft.chosenNodes.filter((one) => one !== id)
        : [...draft.chosenNodes, id];
    });
  return (
    <tr className={chosen ? 'is-on' : undefined}>
      <td className="table__check">
        <input type="checkbox" checked={chosen} aria-label={words.choose(name)} onChange={choose} />
      </td>
      <th scope="row">
        {doc ? (
          <button
            type="button"
            className="link"
            title={words.openScript(name)}
            onClick={() => revealDoc(store, doc, null)}
          >
            {name}
          </button>
        ) : (
          name
        )}{' '}
        <span className="muted num">{id}</span> {doc ? null : <WriteScript node={node} />}
      </th>
      <td className={(fault ?? unstopped) ? 'is-error' : undefined} title={fault}>
        <span className="table__state">
          <StateSign state={state} />
          {unstopped ?? busy ?? wordOf(state)}
          {at ? <span className="muted">{words.line(at.line)}</span> : null}
        </span>
      </td>
      <td className={program === 'older' ? 'is-warning' : 'muted'}>{words.programs[program]}</td>
      <td className="table__num num">{says}</td>
      <td className="table__num num">{hears}</td>
      <td className="table__tools">
        <NodeControls nodes={[id]} name={name} can={(act) => can(node, act)} />
      </td>
    </tr>
  );
}

function can({ state, doc }: Node, act: NodeAct): boolean {
  if (state === 'gone') return false;
  if (act === 'load') return doc !== undefined;
  if (act === 'run') return state !== 'running';
  if (act === 'pause') return state === 'running';
  return act !== 'step' || state === 'paused';
}
