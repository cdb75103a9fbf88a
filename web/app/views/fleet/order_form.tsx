import { useId, useState, type FormEvent } from 'react';
import { readVariable } from '../../../core/fleet';
import { readWords } from '../../../core/numbers';
import type { OrderWords } from '../../../core/fleet_desk';
import { useStudio } from '../../hooks';
import { Button } from '../../parts/button';
import { useFleetDesk } from './use_fleet';
import { words } from './words';

const said = words.form;

/** An event or a variable for the robots that are chosen; it stays open, so that it can be sent again. */
export function OrderForm({ verb, onClose }: { verb: 'emit' | 'set'; onClose(): void }) {
  const desk = useFleetDesk();
  const id = useId();
  const [what, setWhat] = useState('');
  const [typed, setTyped] = useState('');
  const [why, setWhy] = useState('');
  const known = useKnown(verb);
  const send = (event: FormEvent) => {
    event.preventDefault();
    const order = read(verb, what, typed);
    setWhy(typeof order === 'string' ? order : '');
    if (typeof order !== 'string') void desk.order(verb, [...desk.choice.chosen], order);
  };
  return (
    <form
      className="forder"
      aria-label={words.verbs[verb]}
      onSubmit={send}
      onKeyDown={(event) => event.key === 'Escape' && onClose()}
    >
      <label>
        {verb === 'emit' ? said.event : said.variable}
        <input
          className="field"
          autoFocus
          list={`${id}-known`}
          value={what}
          placeholder={verb === 'emit' ? '' : said.variableHint}
          aria-invalid={why !== ''}
          aria-describedby={`${id}-why`}
          spellCheck={false}
          autoComplete="off"
          onChange={(event) => setWhat(event.target.value)}
        />
      </label>
      <datalist id={`${id}-known`}>
        {known.map((name) => (
          <option key={name} value={name} />
        ))}
      </datalist>
      <label>
        {verb === 'emit' ? said.args : said.values}
        <input
          className="field num"
          value={typed}
          placeholder={verb === 'emit' ? said.argsHint : ''}
          aria-describedby={`${id}-why`}
          spellCheck={false}
          autoComplete="off"
          onChange={(event) => setTyped(event.target.value)}
        />
      </label>
      <Button kind="primary" type="submit" disabled={desk.choice.chosen.size === 0}>
        {verb === 'emit' ? said.send : said.set}
      </Button>
      <Button kind="plain" onClick={onClose}>
        {said.close}
      </Button>
      <p className="why" id={`${id}-why`} role="alert">
        {why}
      </p>
    </form>
  );
}

/** The words of the order, or why they are none. */
function read(verb: 'emit' | 'set', what: string, typed: string): OrderWords | string {
  const values = readWords(typed);
  if (verb === 'emit') {
    if (what.trim() === '') return said.noEvent;
    return values ? { event: what.trim(), values } : said.noArgs;
  }
  const variable = readVariable(what);
  if (!variable) return said.noVariable;
  return values && values.length > 0 ? { ...variable, values } : said.noValues;
}

/** Events that the chosen robots hear, nodes that they have. */
function useKnown(verb: 'emit' | 'set'): string[] {
  const { topics } = useStudio();
  const { choice } = useFleetDesk();
  const robots = topics.get('fleet', {})?.robots ?? {};
  const known = new Set<string>();
  for (const name of choice.chosen)
    for (const one of (verb === 'emit' ? robots[name]?.hear : robots[name]?.nodes) ?? [])
      known.add(verb === 'emit' ? one : `${one}.`);
  return [...known].toSorted();
}
