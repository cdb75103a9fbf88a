import type { JsonFile } from '../../../core/session/json_file';
import {
  buttonsOf,
  entryOf,
  namesIn,
  numberOf,
  robotsWithProject,
  setSteps,
  textOf,
  timeSteps,
  verbs,
  verbSteps,
  type Verb,
} from '../../../core/world/file';
import type { WorldModel } from '../../../core/world/model';
import { useDrives } from '../../hooks';
import { ChoiceField, SwitchField } from './fields';
import { FileForm } from './file_form';
import { EntryTarget, type EditedEntry } from './entry_target';
import { NumberField } from './number_field';
import { formWords } from './form_words';

/** An entry of the timeline: when, what, with whom. */
export function EntryForm(props: { file: JsonFile; id: string; model: WorldModel }) {
  const { file, id, model } = props;
  const off = !useDrives();
  const entry = entryOf(file.value, id);
  const verb = verbs.find((one) => one === entry['do']) ?? 'add';
  const retime = (t: number | undefined) => {
    const timed = t === undefined ? null : timeSteps(file.value, id, t);
    if (!timed || file.broken !== null) return false;
    model.selectEntry(timed.key);
    return file.commit(timed.steps);
  };
  return (
    <>
      <NumberField
        label={formWords.at}
        unit="s"
        low={0}
        high={1e6}
        step={1}
        value={numberOf(entry['t'], 0)}
        disabled={off}
        onSet={retime}
      />
      <ChoiceField<Verb>
        label={formWords.does}
        value={verb}
        choices={verbs.map((one) => ({ value: one, label: formWords.verbs[one] }))}
        disabled={off}
        onSet={(to) => file.commit(verbSteps(file.value, id, to))}
      />
      <Members file={file} id={id} off={off} verb={verb} />
    </>
  );
}

function Members({ verb, ...edited }: EditedEntry & { verb: Verb }) {
  const { file, id } = edited;
  const { ids, lights, robots } = namesIn(file.value);
  switch (verb) {
    case 'add':
      return <FileForm file={file} id={id} />;
    case 'remove':
      return <Name {...edited} member="id" names={ids} />;
    case 'move':
      return (
        <>
          <Name {...edited} member="id" names={[...ids, ...robots]} />
          <EntryTarget {...edited} />
        </>
      );
    case 'press':
    case 'release': {
      const robot = textOf(entryOf(file.value, id)['robot']);
      return (
        <>
          <Name {...edited} member="robot" names={robots} />
          <Name {...edited} member="button" names={buttonsOf(file.value, robot)} />
        </>
      );
    }
    case 'cut':
    case 'restore':
      return <Name {...edited} member="robot" names={robotsWithProject(file.value)} />;
    case 'light':
      return (
        <>
          <Name {...edited} member="id" names={lights} />
          <SwitchField
            label={formWords.on}
            on={entryOf(file.value, id)['on'] === true}
            disabled={edited.off}
            onSet={(on) => file.commit(setSteps(file.value, id, 'on', on))}
          />
        </>
      );
  }
}

function Name(
  props: EditedEntry & { member: 'id' | 'robot' | 'button'; names: readonly string[] },
) {
  const { file, id, off, member, names } = props;
  return (
    <ChoiceField<string>
      label={member === 'button' ? formWords.button : formWords.who}
      value={textOf(entryOf(file.value, id)[member])}
      choices={names.map((name) => ({ value: name, label: name }))}
      disabled={off}
      onSet={(value) => file.commit(setSteps(file.value, id, member, value))}
    />
  );
}
