import { IconMinus, IconSquareFilled } from '@tabler/icons-react';
import type { NodeProps } from '@xyflow/react';
import { memo } from 'react';
import { drawWords as words } from '../words';
import type { PillNode, TagNode } from './flow_nodes';
import { useLive } from './live_store';

/** A variable, with the value that it has now. */
export const Pill = memo(function Pill({ data, selected }: NodeProps<PillNode>) {
  const { variable, near } = data;
  const value = useLive((live) => live.values.get(variable.name));
  const shown = value ?? variable.initial;
  return (
    <div className={selected ? 'ppill is-selected' : near ? 'ppill is-near' : 'ppill'}>
      <b className="ellipsis">{variable.name}</b>
      <span className="num">{`${shown} ${variable.unit}`.trim()}</span>
    </div>
  );
});

/** Where the plan ends, or an event is ignored. */
export const Tag = memo(function Tag({ data }: NodeProps<TagNode>) {
  const name = data.is === 'terminate' ? words.terminate : words.ignore;
  return (
    <div className="ptag" title={name}>
      {data.is === 'terminate' ? <IconSquareFilled size={9} /> : <IconMinus size={12} stroke={2} />}
    </div>
  );
});
