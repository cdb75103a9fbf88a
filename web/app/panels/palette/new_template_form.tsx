import { useId, useState } from 'react';
import { faultOfName, workingScripts, type WantedTemplate } from '../../../core/plan/own_template';
import { useStudio, useTopic } from '../../hooks';
import { Quiet } from '../../parts/blank';
import { Button } from '../../parts/button';
import { words } from './words';
import { newTemplate } from './new_template';

/** Asks what is needed for a template of one's own; what cannot be is said while it is typed. */
export function NewTemplateForm({ onDone }: { onDone: () => void }) {
  const studio = useStudio();
  const scripts = useTopic('scripts', {});
  const toolboxes = useTopic('templates', {})?.toolboxes ?? [];
  const parts = workingScripts(scripts?.parts ?? []);
  const [typed, type] = useState<WantedTemplate>({
    name: '',
    kind: 'actor',
    script: '',
    help: '',
  });
  const wanted = { ...typed, script: typed.script || (parts[0]?.doc ?? '') };
  const fault = faultOfName(wanted, toolboxes, scripts?.files ?? []);
  const set = (change: Partial<WantedTemplate>) => type({ ...typed, ...change });
  if (parts.length === 0) return <Quiet>{words.noScripts}</Quiet>;
  return (
    <form
      className="newtemplate"
      aria-label={words.newTemplate}
      onSubmit={(event) => {
        event.preventDefault();
        if (fault !== null) return;
        onDone();
        newTemplate(studio, wanted).catch((problem: unknown) => studio.tell(problem));
      }}
    >
      <NameField
        name={typed.name}
        why={fault === null || fault === 'empty' ? null : words.badName[fault]}
        onType={(name) => set({ name })}
      />
      <label>
        <span>{words.kind}</span>
        <select
          className="field field--small field--ui"
          value={typed.kind}
          onChange={({ target }) =>
            set({ kind: target.value === 'supervisor' ? 'supervisor' : 'actor' })
          }
        >
          <option value="actor">{words.kinds.actor}</option>
          <option value="supervisor">{words.kinds.supervisor}</option>
        </select>
      </label>
      <label>
        <span>{words.onNode}</span>
        <select
          className="field field--small field--ui"
          value={wanted.script}
          onChange={({ target }) => set({ script: target.value })}
        >
          {parts.map((one) => (
            <option key={one.doc} value={one.doc}>
              {words.scriptOf(one.name, one.file)}
            </option>
          ))}
        </select>
      </label>
      <label>
        <span>{words.helpText}</span>
        <input
          className="field field--small field--ui"
          maxLength={300}
          value={typed.help}
          onChange={({ target }) => set({ help: target.value })}
        />
      </label>
      <p className="quiet">{words.whatHappens}</p>
      <div className="newtemplate__buttons">
        <Button small kind="plain" onClick={onDone}>
          {words.cancel}
        </Button>
        <Button small type="submit" disabled={fault !== null}>
          {words.make}
        </Button>
      </div>
    </form>
  );
}

function NameField(props: { name: string; why: string | null; onType: (name: string) => void }) {
  const { name, why, onType } = props;
  const sentence = useId();
  return (
    <>
      <label>
        <span>{words.name}</span>
        <input
          className="field field--small"
          data-autofocus
          autoFocus
          autoComplete="off"
          spellCheck={false}
          maxLength={100}
          aria-invalid={why !== null}
          aria-describedby={why === null ? undefined : sentence}
          value={name}
          onChange={({ target }) => onType(target.value)}
        />
      </label>
      {why === null ? null : (
        <p id={sentence} className="planform__why">
          {why}
        </p>
      )}
    </>
  );
}
