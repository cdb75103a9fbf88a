import { IconCopy, IconMap2, IconTrash } from '@tabler/icons-react';
import { useEffect, useReducer } from 'react';
import { keyOf, listOf, partOfKey, removeSteps, tableOf } from '../../../core/world/file';
import { useDrives, useStudio } from '../../hooks';
import { Quiet } from '../../parts/blank';
import { Button } from '../../parts/button';
import { kStroke } from '../../parts/icons';
import { FieldsOf } from '../../parts/use_draft';
import { text } from '../../text';
import { useModel, type ShownWorld } from './desk';
import { EntryForm } from './entry_form';
import { FileForm } from './file_form';
import { LiveForm } from './live_form';
import { Swatch } from './thing_list';
import { WorldForm } from './world_form';
import { entryText } from './entry_text';
import { nameOfThing } from './words';
import { formWords } from './form_words';
import { keysShown } from '../../parts/keys_shown';

const words = text.world;

/** What is chosen in a world, to be changed exactly. */
export function ThingForm({ world }: { world: ShownWorld }) {
  const { model, file } = world;
  const { documents } = useStudio();
  useModel(model);
  useFile(world);
  const thing = model.chosen;
  const entry = file && model.entry !== null ? model.entry : null;
  if (!file && !thing) return <Quiet>{text.empty.propertiesOfWorld}</Quiet>;
  const key = entry ?? thing?.key ?? null;
  // Another thing, another form: what is half typed belongs to the one before.
  return (
    <section className="props" key={key ?? 'world'} aria-label={text.panels.properties}>
      <Head world={world} entry={entry} />
      <FieldsOf value={file && documents.docOf(file.session)}>
        <div className="props__fields">
          {file && entry !== null ? (
            <EntryForm file={file} id={entry} model={model} />
          ) : file && key !== null ? (
            partOfKey(key)?.list === 'timeline' ? (
              <EntryForm file={file} id={key} model={model} />
            ) : (
              <FileForm file={file} id={key} />
            )
          ) : file ? (
            <WorldForm file={file} />
          ) : thing ? (
            <LiveForm model={model} thing={thing} />
          ) : null}
        </div>
      </FieldsOf>
    </section>
  );
}

function Head({ world, entry }: { world: ShownWorld; entry: string | null }) {
  const studio = useStudio();
  const drives = useDrives();
  const { model, file } = world;
  const thing = model.chosen;
  const run = (id: string) => () => void studio.registry.run(id);
  const title =
    entry !== null && file
      ? entryText(file.value, entry).what
      : thing
        ? nameOfThing(thing)
        : model.stage.name || formWords.theWorld;
  const kind = thing
    ? thing.type
      ? words.types[thing.type]
      : words.kinds[thing.kind]
    : entry !== null
      ? formWords.timeline
      : formWords.theWorld;
  const edits = file !== null && (thing !== undefined || entry !== null);
  return (
    <header className="props__head">
      {thing ? <Swatch thing={thing} /> : <IconMap2 size={16} stroke={kStroke} aria-hidden />}
      <div className="grow">
        <h2 className="props__name ellipsis">{title}</h2>
        <p className="props__kind ellipsis">
          {kind} <span className="muted">· {file ? formWords.inFile : formWords.inRun}</span>
        </p>
      </div>
      {edits && thing ? (
        <Button
          kind="plain"
          small
          disabled={!drives}
          tip={`${formWords.copy}  (${keysShown('Ctrl+D')})`}
          icon={<IconCopy size={14} stroke={kStroke} />}
          onClick={run('world.copy')}
        />
      ) : null}
      {edits ? (
        <Button
          kind="plain"
          small
          disabled={!drives}
          tip={`${formWords.remove}  (Delete)`}
          icon={<IconTrash size={14} stroke={kStroke} />}
          onClick={() => {
            const key = entry ?? thing?.key;
            if (key === undefined) return;
            file.commit(removeSteps(file.value, key));
            model.selectEntry(null);
            model.select(null);
          }}
        />
      ) : null}
    </header>
  );
}

/** Forms show each change of the file, no matter who made it. */
function useFile({ file, model }: ShownWorld): void {
  const [, redraw] = useReducer((count: number) => count + 1, 0);
  useEffect(
    () =>
      file?.changed.on(() => {
        const part = model.entry === null ? null : partOfKey(model.entry);
        if (part && part.index >= listOf(tableOf(file.value), 'timeline').length)
          model.selectEntry(part.index > 0 ? keyOf({ ...part, index: part.index - 1 }) : null);
        redraw();
      }),
    [file, model],
  );
}
