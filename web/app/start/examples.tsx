import { IconMapCog } from '@tabler/icons-react';
import { useState } from 'react';
import type { Example } from '../../protocol/messages';
import { useDrives, useStudio, useTopic } from '../hooks';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { WorldPicture } from './world_picture';
import { startWords } from './words';

const kShown = 6;

export function Examples() {
  const examples = useTopic('start', {})?.examples ?? [];
  const [all, setAll] = useState(false);
  const shown = all ? examples : examples.slice(0, kShown);
  return (
    <section aria-label={startWords.examples}>
      <div className="first__title">
        <IconMapCog className="icon" size={16} stroke={kStroke} aria-hidden />
        <h2>{startWords.examples}</h2>
        <span className="muted">{startWords.examplesHelp}</span>
        <span className="grow" />
        {examples.length > kShown ? (
          <Button kind="plain" small aria-expanded={all} onClick={() => setAll(!all)}>
            {all ? startWords.fewer : startWords.all}
          </Button>
        ) : null}
      </div>
      <ul className="cards">
        {shown.map((example) => (
          <li key={example.id}>
            <Card example={example} />
          </li>
        ))}
      </ul>
    </section>
  );
}

function Card({ example }: { example: Example }) {
  const studio = useStudio();
  const drives = useDrives();
  const { id, name, help, robot, content } = example;
  return (
    <button
      type="button"
      className="excard"
      disabled={!drives}
      onClick={() => studio.order('project.example', { id })}
    >
      <WorldPicture example={id} />
      <span className="excard__text">
        <b>{name}</b>
        <span className="excard__help">{help}</span>
        <span className="muted">
          {robot && !content.includes(robot) ? `${content} · ${robot}` : content}
        </span>
      </span>
    </button>
  );
}
