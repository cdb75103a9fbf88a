import {
  IconArrowDown,
  IconArrowUp,
  IconPencil,
  IconPlus,
  IconSend2,
  IconTrash,
} from '@tabler/icons-react';
import { useState, type KeyboardEvent } from 'react';
import type { Definition, SharedFile } from '../../../protocol/messages';
import { useDrives, useStudio } from '../../hooks';
import { Quiet } from '../../parts/blank';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { text } from '../../text';
import { DefinitionForm, SendForm, type DefinitionKind } from './definition_form';
import { Group } from './group';

const icon = { size: 14, stroke: kStroke };

/** Events or constants of an .aesl file: add, rename, change, remove; events can be sent. */
export function Definitions({ file, kind }: { file: SharedFile; kind: DefinitionKind }) {
  const drives = useDrives();
  const [adding, setAdding] = useState(false);
  const list = kind === 'event' ? file.events : file.constants;
  const add = (
    <Button
      kind="plain"
      small
      disabled={!drives}
      tip={text.outline.add[kind]}
      icon={<IconPlus {...icon} />}
      onClick={() => setAdding(true)}
    />
  );
  return (
    <>
      <Group
        title={kind === 'event' ? text.outline.events : text.outline.constants}
        note={String(list.length)}
        open={false}
        wanted={adding}
        tools={add}
      >
        <ul>
          {list.map((definition, index) => (
            <Row
              key={definition.name}
              file={file}
              kind={kind}
              definition={definition}
              index={index}
              last={index === list.length - 1}
            />
          ))}
        </ul>
        {list.length === 0 ? <Quiet>{text.outline.none[kind]}</Quiet> : null}
      </Group>
      {adding ? (
        <DefinitionForm file={file.path} kind={kind} onEnd={() => setAdding(false)} />
      ) : null}
    </>
  );
}

function Row({
  file,
  kind,
  definition,
  index,
  last,
}: {
  file: SharedFile;
  kind: DefinitionKind;
  definition: Definition;
  index: number;
  last: boolean;
}) {
  const studio = useStudio();
  const drives = useDrives();
  const [form, setForm] = useState<'none' | 'change' | 'send'>('none');
  const { name, value } = definition;
  const end = () => setForm('none');
  if (form === 'change')
    return <DefinitionForm file={file.path} kind={kind} definition={definition} onEnd={end} />;
  if (form === 'send') return <SendForm definition={definition} onEnd={end} />;
  const send = () =>
    value === 0 ? studio.order('event.send', { name, args: [] }) : setForm('send');
  const tell = (done: Promise<unknown>) => void done.catch((why: unknown) => studio.tell(why));
  const move = (by: number) =>
    tell(studio.change('define.move', { file: file.path, kind, name, to: index + by }));
  const moveKey = (event: KeyboardEvent) => {
    const by = event.altKey ? { ArrowUp: -1, ArrowDown: 1 }[event.key] : undefined;
    if (!by || !drives || (by < 0 ? index === 0 : last)) return;
    event.preventDefault();
    move(by);
  };
  return (
    <li className="row definition" onKeyDown={moveKey}>
      <code className="ellipsis">{name}</code>
      <span className="grow" />
      <span className="definition__tools">
        {kind === 'event' ? (
          <Button
            kind="plain"
            small
            disabled={!drives}
            tip={text.outline.send(name)}
            icon={<IconSend2 {...icon} />}
            onClick={send}
          />
        ) : null}
        <Button
          kind="plain"
          small
          disabled={!drives || index === 0}
          tip={text.outline.up(name)}
          icon={<IconArrowUp {...icon} />}
          onClick={() => move(-1)}
        />
        <Button
          kind="plain"
          small
          disabled={!drives || last}
          tip={text.outline.down(name)}
          icon={<IconArrowDown {...icon} />}
          onClick={() => move(1)}
        />
        <Button
          kind="plain"
          small
          disabled={!drives}
          tip={text.outline.edit(name)}
          icon={<IconPencil {...icon} />}
          onClick={() => setForm('change')}
        />
        <Button
          kind="plain"
          small
          disabled={!drives}
          tip={text.outline.remove(name)}
          icon={<IconTrash {...icon} />}
          onClick={() => tell(studio.change('define.remove', { file: file.path, kind, name }))}
        />
      </span>
      <span className="outline__words num">{value}</span>
    </li>
  );
}
