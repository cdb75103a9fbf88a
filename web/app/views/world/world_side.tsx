import { useStudio } from '../../hooks';
import { text } from '../../text';
import { useDesk, type ShownWorld } from './desk';
import { ThingForm } from './thing_form';
import { ThingList } from './thing_list';
import { TimelineList } from './timeline_list';

/** Beside the picture: all that is there, and the form of what is chosen if no panel has it. */
export function WorldSide({ world }: { world: ShownWorld }) {
  const desk = useDesk(useStudio());
  const { model, file } = world;
  return (
    <aside className="world__side">
      <div className="scroll" tabIndex={-1}>
        <header className="things__head">
          <h2>{text.world.list}</h2>
        </header>
        <ThingList model={model} />
        {file ? <TimelineList file={file} model={model} /> : null}
      </div>
      {desk.hasForm ? null : (
        <div className="world__form">
          <ThingForm world={world} />
        </div>
      )}
    </aside>
  );
}
