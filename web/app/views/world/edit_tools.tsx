import { Menu } from '@mantine/core';
import { IconArrowBackUp, IconArrowForwardUp, IconPlus } from '@tabler/icons-react';
import { useEffect, useReducer } from 'react';
import type { JsonFile } from '../../../core/session/json_file';
import { objectKinds, robotTypes } from '../../../core/world/stage';
import { isObstacle } from './world_commands';
import { useChanges, useDrives, useStudio } from '../../hooks';
import { useMayAct } from '../../past_hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { CommandItem, StudioMenu } from '../../parts/menu';
import { text } from '../../text';
import { toggleOption, useWorldOptions } from './options';
import { formWords } from './form_words';
import { keysShown } from '../../parts/keys_shown';

const words = text.world;
const size = { size: 14, stroke: kStroke };

/** Puts down what can be put down: all in the file, obstacles in a run. */
export function AddMenu({ edits }: { edits: boolean }) {
  const drives = useDrives();
  return (
    <StudioMenu
      button={
        <Button
          small
          disabled={!drives}
          icon={<IconPlus {...size} />}
          tip={edits ? formWords.addHelp : formWords.obstacle}
        >
          <span className="doctools__word">{formWords.add}</span>
        </Button>
      }
    >
      <Menu.Label>{edits ? formWords.objects : formWords.obstacle}</Menu.Label>
      {objectKinds
        .filter((kind) => edits || isObstacle(kind))
        .map((kind) => (
          <CommandItem key={kind} id={`world.add.${kind}`} title={words.kinds[kind]} />
        ))}
      {edits ? (
        <>
          <Menu.Divider />
          <Menu.Label>{formWords.robots}</Menu.Label>
          {robotTypes.map((type) => (
            <CommandItem key={type} id={`world.add.${type}`} title={words.types[type]} />
          ))}
        </>
      ) : null}
    </StudioMenu>
  );
}

/** For the file of a world: undo, redo, snapping. */
export function EditTools({ file }: { file: JsonFile }) {
  const studio = useStudio();
  const drives = useDrives();
  const { snap } = useWorldOptions();
  const [, redraw] = useReducer((count: number) => count + 1, 0);
  useEffect(() => file.changed.on(redraw), [file]);
  return (
    <>
      <AddMenu edits />
      <UndoButtons
        canUndo={drives && file.canUndo}
        canRedo={drives && file.canRedo}
        undo={() => file.undo()}
        redo={() => file.redo()}
      />
      <button
        type="button"
        role="switch"
        className="switch world__snap"
        aria-checked={snap}
        title={formWords.snapHelp}
        onClick={() => toggleOption(studio, 'snap')}
      >
        {formWords.snap}
      </button>
    </>
  );
}

/** For a run: what can be put into it, and what was done by hand. */
export function RunTools() {
  const { hand } = useStudio();
  const may = useMayAct();
  useChanges(hand.changed);
  return (
    <>
      <AddMenu edits={false} />
      <UndoButtons
        canUndo={may && hand.canUndo}
        canRedo={may && hand.canRedo}
        undo={() => void hand.undo()}
        redo={() => void hand.redo()}
      />
    </>
  );
}

function UndoButtons(props: {
  canUndo: boolean;
  canRedo: boolean;
  undo: () => void;
  redo: () => void;
}) {
  return (
    <>
      <Button
        kind="plain"
        small
        disabled={!props.canUndo}
        tip={`${formWords.undo}  (${keysShown('Ctrl+Z')})`}
        icon={<IconArrowBackUp {...size} />}
        onClick={props.undo}
      />
      <Button
        kind="plain"
        small
        disabled={!props.canRedo}
        tip={`${formWords.redo}  (${keysShown('Ctrl+Y')})`}
        icon={<IconArrowForwardUp {...size} />}
        onClick={props.redo}
      />
    </>
  );
}
