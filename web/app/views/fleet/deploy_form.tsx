import { useId, useMemo, useRef, useState, type FormEvent } from 'react';
import { kStepsUnlessTold } from '../../../core/fleet_desk';
import type { Path } from '../../../protocol/messages';
import { useDrives, usePart, useStudio } from '../../hooks';
import { Button } from '../../parts/button';
import { useFleetDesk } from './use_fleet';
import { words } from './words';

const said = words.deploy;

/** Another version, that of the project which is open, for the chosen robots or for all. */
export function DeployForm({ onClose }: { onClose(): void }) {
  const desk = useFleetDesk();
  const id = useId();
  const [steps, setSteps] = useState(kStepsUnlessTold);
  const project = usePart('rollout', {}, (is) => is?.project);
  const isUnderWay = usePart('rollout', {}, (is) => is?.state === 'running');
  const count = usePart('fleet', {}, (is) => Object.keys(is?.robots ?? {}).length);
  const field = useRef<HTMLInputElement>(null);
  const unsaved = useUnsavedFiles();
  // The key Enter says nothing of changes that are not saved.
  const [asks, setAsks] = useState(false);
  const chosen = [...desk.choice.chosen];
  const isLocked = project === undefined || isUnderWay;
  const deploy = async () => {
    if (await desk.deploy(chosen, steps, unsaved)) onClose();
  };
  const submit = (event: FormEvent) => {
    event.preventDefault();
    setAsks(unsaved.length > 0);
    if (unsaved.length === 0 && !isLocked) void deploy();
  };
  return (
    <form
      className="forder"
      aria-label={said.title}
      onSubmit={submit}
      onKeyDown={(event) => event.key === 'Escape' && onClose()}
    >
      <p className="fdeploy__what">
        {project === undefined ? said.noProject : said.what(project, chosen.length, count)}
      </p>
      {unsaved.length === 0 ? null : (
        <Unsaved files={unsaved} onSave={() => field.current?.focus()} />
      )}
      <label>
        {said.steps}
        <input
          className="field num"
          ref={field}
          autoFocus
          value={steps}
          aria-describedby={`${id}-help`}
          spellCheck={false}
          autoComplete="off"
          onChange={(event) => setSteps(event.target.value)}
        />
      </label>
      {unsaved.length === 0 ? (
        <Button kind="primary" type="submit" disabled={isLocked}>
          {said.deploy}
        </Button>
      ) : (
        <Button disabled={isLocked} onClick={() => void deploy()}>
          {said.without}
        </Button>
      )}
      <Button kind="plain" onClick={onClose}>
        {words.form.close}
      </Button>
      <p className="muted fdeploy__help" id={`${id}-help`}>
        {said.help}
      </p>
      <p className="why" role="alert">
        {asks && unsaved.length > 0 ? said.decide : desk.deployWhy}
      </p>
    </form>
  );
}

/** What robots would not get, of the project that is open; on any page. */
function useUnsavedFiles(): readonly Path[] {
  const paths = usePart('files', {}, (is) =>
    (is?.files ?? []).flatMap((file) => (file.unsaved ? file.path : [])).join('\n'),
  );
  return useMemo(() => (paths === '' ? [] : paths.split('\n')), [paths]);
}

/** It is gone when they are saved, so what has the focus then is for onSave to say. */
function Unsaved({ files, onSave }: { files: readonly Path[]; onSave(): void }) {
  const { registry } = useStudio();
  const drives = useDrives();
  const save = () => {
    registry.run('file.saveAll');
    onSave();
  };
  return (
    <p className="fdeploy__what fdeploy__unsaved is-warning" role="status">
      {said.unsaved(files)}
      <Button small disabled={!drives} onClick={save}>
        {said.saveAll}
      </Button>
    </p>
  );
}
