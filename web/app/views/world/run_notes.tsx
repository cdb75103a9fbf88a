import { IconHandGrab, IconInfoCircle, IconRefreshAlert, IconX } from '@tabler/icons-react';
import { useCallback, useSyncExternalStore } from 'react';
import type { JsonFile } from '../../../core/session/json_file';
import { useChanges, useDrives, usePart, useStudio } from '../../hooks';
import { useMayAct } from '../../past_hooks';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { text } from '../../text';
import { countToKeep, keepInWorld } from './keep_acts';
import { setOption, useWorldOptions } from './options';
import { useJsonFile } from './use_world';

const words = text.world;
const icon = { className: 'icon', size: 14, stroke: kStroke, 'aria-hidden': true };

/** Once: what the two modes change. */
export function ModeNote({ mode }: { mode: 'live' | 'edit' }) {
  const studio = useStudio();
  const { explained } = useWorldOptions();
  if (explained) return null;
  return (
    <div className="notice notice--plain" role="note">
      <IconInfoCircle {...icon} />
      <span className="ellipsis" title={words.explain[mode]}>
        {words.explain[mode]}
      </span>
      <span className="grow" />
      <Button small kind="plain" onClick={() => setOption(studio, { explained: true })}>
        {words.understood}
      </Button>
    </div>
  );
}

/** Of a run: what a hand changed and the file does not have, and that the file has changed. */
export function RunNotes() {
  const { hand } = useStudio();
  useChanges(hand.changed);
  const world = usePart('studio', {}, (is) => is?.project?.world) ?? null;
  const changed = usePart('studio', {}, (is) => is?.project?.world_changed) ?? false;
  const { file } = useJsonFile(changed || hand.changes().length > 0 ? world : null);
  const version = useText(file);
  if (!file || version === null) return null;
  return (
    <>
      {hand.changes().length > 0 ? <KeepNote file={file} /> : null}
      {changed && version !== hand.keptText ? <ChangedNote /> : null}
    </>
  );
}

function KeepNote({ file }: { file: JsonFile }) {
  const studio = useStudio();
  const drives = useDrives();
  const count = countToKeep(studio, file);
  if (count === 0) return null;
  return (
    <div className="notice notice--plain" role="status">
      <IconHandGrab {...icon} />
      <span className="ellipsis">{words.changedByHand(count, studio.hand.isOfThisRun)}</span>
      <span className="grow" />
      <Button
        small
        disabled={!drives}
        title={words.keepHelp}
        onClick={() => void keepInWorld(studio)}
      >
        {words.keep}
      </Button>
      <Button
        small
        kind="plain"
        tip={words.forget}
        icon={<IconX size={14} stroke={kStroke} />}
        onClick={() => studio.hand.forget()}
      />
    </div>
  );
}

function ChangedNote() {
  const studio = useStudio();
  const may = useMayAct();
  return (
    <div className="notice" role="status">
      <IconRefreshAlert {...icon} />
      <span className="ellipsis">{words.fileChanged}</span>
      <span className="grow" />
      <Button small disabled={!may} onClick={() => void studio.registry.run('run.reset')}>
        {words.restart}
      </Button>
    </div>
  );
}

/** The text of the file as it is now. */
function useText(file: JsonFile | null): string | null {
  return useSyncExternalStore(
    useCallback((listener: () => void) => file?.changed.on(listener) ?? (() => {}), [file]),
    () => file?.session.text ?? null,
  );
}
