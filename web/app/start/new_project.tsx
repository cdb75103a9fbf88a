import { useState } from 'react';
import { badName } from '../../core/paths';
import { useStudio } from '../hooks';
import { OverlayFrame, useCloseOverlay } from '../parts/overlay_frame';
import { Button } from '../parts/button';
import { folderWords, newProjectWords } from './words';

const words = newProjectWords;
type Robot = keyof typeof words.robots;

export default function NewProject() {
  const studio = useStudio();
  const close = useCloseOverlay();
  const [name, setName] = useState('my-robot');
  const [robot, setRobot] = useState<Robot>('thymio2');
  const [chosen, setPlan] = useState<boolean | null>(null);
  // A Carbot is driven by plans.
  const plan = chosen ?? robot === 'carbot';
  const why = badName(name);
  const make = () => {
    if (why) return;
    close();
    void studio.openAnother('project.new', { name, robot, plan });
  };
  return (
    <OverlayFrame label={words.title}>
      <form
        className="sheet sheet--small form"
        onSubmit={(event) => (event.preventDefault(), make())}
      >
        <div className="sheet__head">
          <h2>{words.title}</h2>
        </div>
        <label>
          {words.name}
          <input
            className="field field--ui"
            autoFocus
            value={name}
            aria-invalid={why !== ''}
            onFocus={(event) => event.target.select()}
            onChange={(event) => setName(event.target.value)}
          />
          {why ? <span className="why">{why}</span> : null}
        </label>
        <label>
          {words.robot}
          <select
            className="field field--ui"
            value={robot}
            onChange={(event) => setRobot(event.target.value as Robot)}
          >
            {Object.entries(words.robots).map(([id, label]) => (
              <option key={id} value={id}>
                {label}
              </option>
            ))}
          </select>
        </label>
        <label>
          {words.begins}
          <select
            className="field field--ui"
            value={plan ? 'small' : 'none'}
            onChange={(event) => setPlan(event.target.value === 'small')}
          >
            {Object.entries(robot === 'carbot' ? words.plans : words.scripts).map(([id, label]) => (
              <option key={id} value={id}>
                {label}
              </option>
            ))}
          </select>
        </label>
        <div className="form__end">
          <Button onClick={close}>{folderWords.close}</Button>
          <Button kind="primary" type="submit" disabled={why !== ''}>
            {words.make}
          </Button>
        </div>
      </form>
    </OverlayFrame>
  );
}
