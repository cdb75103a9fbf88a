import { useId, useState, type FormEvent } from 'react';
import { kStepsUnlessTold } from '../../../core/fleet_desk';
import { usePart } from '../../hooks';
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
  const chosen = [...desk.choice.chosen];
  const deploy = async (event: FormEvent) => {
    event.preventDefault();
    if (await desk.deploy(chosen, steps)) onClose();
  };
  return (
    <form
      className="forder"
      aria-label={said.title}
      onSubmit={(event) => void deploy(event)}
      onKeyDown={(event) => event.key === 'Escape' && onClose()}
    >
      <p className="fdeploy__what">
        {project === undefined ? said.noProject : said.what(project, chosen.length, count)}
      </p>
      <label>
        {said.steps}
        <input
          className="field num"
          autoFocus
          value={steps}
          aria-describedby={`${id}-help`}
          spellCheck={false}
          autoComplete="off"
          onChange={(event) => setSteps(event.target.value)}
        />
      </label>
      <Button kind="primary" type="submit" disabled={project === undefined || isUnderWay}>
        {said.deploy}
      </Button>
      <Button kind="plain" onClick={onClose}>
        {words.form.close}
      </Button>
      <p className="muted fdeploy__help" id={`${id}-help`}>
        {said.help}
      </p>
      <p className="why" role="alert">
        {desk.deployWhy}
      </p>
    </form>
  );
}
