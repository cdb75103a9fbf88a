import type { PlanBoard } from '../../../../core/plan/board';
import { dropSteps, formulaJson, setSteps, shownFormula } from '../../../../core/plan/edit';
import { memberOf, textOf } from '../../../../core/plan/json';
import { drawWords as words } from '../words';
import { ChoiceField, TextField } from '../../world/fields';

const types = ['bool', 'int', 'float', 'string', 'object'] as const;
const accesses = ['', 'in', 'out', 'inout', 'shared'] as const;

/** Type, first value, unit of a variable, and what callers see of it. */
export function VariableForm(props: { board: PlanBoard; name: string; disabled: boolean }) {
  const { board, name, disabled } = props;
  const keys = ['configuration', name];
  const value = board.at(keys);
  const type = textOf(memberOf(value, 'type'));
  const access = textOf(memberOf(value, 'access'));
  const set = (member: string) => (to: string) => {
    const at = [...keys, member];
    const { value: file } = board.file;
    return board.commit(to === '' ? dropSteps(file, at) : setSteps(file, at, to));
  };
  const setInitial = (to: string) => {
    const at = [...keys, 'initial'];
    const json = type === 'string' ? to : formulaJson(to);
    const { value: file } = board.file;
    return board.commit(to === '' ? dropSteps(file, at) : setSteps(file, at, json));
  };
  return (
    <div className="props__fields">
      <ChoiceField
        label={words.type}
        value={type}
        choices={types.map((one) => ({ value: one, label: words.types[one] }))}
        disabled={disabled}
        onSet={set('type')}
      />
      <TextField
        label={words.initial}
        value={shownFormula(memberOf(value, 'initial'))}
        disabled={disabled}
        onSet={setInitial}
      />
      <TextField
        label={words.unit}
        value={textOf(memberOf(value, 'unit'))}
        disabled={disabled}
        onSet={set('unit')}
      />
      <TextField
        label={words.help}
        value={textOf(memberOf(value, 'help'))}
        disabled={disabled}
        onSet={set('help')}
      />
      <ChoiceField
        label={words.access}
        value={access}
        choices={accesses.map((one) => ({ value: one, label: words.accesses[one || 'local'] }))}
        disabled={disabled}
        onSet={set('access')}
      />
    </div>
  );
}
