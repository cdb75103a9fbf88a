import { IconSearch } from '@tabler/icons-react';
import { useState, type KeyboardEvent } from 'react';
import { matching, usable } from '../../core/plan/templates';
import { useDrives, useStudio, useTopic } from '../hooks';
import { Quiet } from '../parts/blank';
import { Button } from '../parts/button';
import { kStroke } from '../parts/icons';
import { text } from '../text';
import { words } from './palette/words';
import { planDeskOf, usePlanDesk } from '../views/plan/plan_desk';
import { NewTemplateButton } from './palette/new_template_button';
import { SubPlans } from './palette/sub_plans';
import { addTemplate, ToolboxList } from './palette/toolbox_list';
import '../look/palette.css';

/** What plans can be made of, by toolbox: dragged onto a plan, or added by a press. */
export default function PalettePanel() {
  const studio = useStudio();
  const drives = useDrives();
  const { shown } = usePlanDesk(studio);
  const told = useTopic('templates', {});
  const toolboxes = told?.toolboxes ?? [];
  const [typed, type] = useState('');
  const groups = matching(toolboxes, typed);
  const count = toolboxes.reduce((sum, one) => sum + one.templates.length, 0);
  const may = drives && shown !== undefined;
  return (
    <div className="palettepanel" data-place="plan-parts" onKeyDown={stepByArrow}>
      <label className="search">
        <IconSearch className="icon" size={14} stroke={kStroke} aria-hidden />
        <input
          type="search"
          data-autofocus
          placeholder={words.search(count)}
          aria-label={words.search(count)}
          value={typed}
          onChange={(event) => type(event.target.value)}
          onKeyDown={(event) => {
            const listed = shown?.board.model.toolboxes ?? [];
            const [first] = usable(toolboxes, listed, typed);
            if (event.key === 'Enter' && may && first) addTemplate(studio, first);
          }}
        />
      </label>
      <div className="scroll" tabIndex={0} data-inset>
        {groups.map((group) => (
          <ToolboxList key={group.name} group={group} may={may} />
        ))}
        <SubPlans may={may} typed={typed} />
        {groups.length === 0 ? (
          <Quiet>{told ? words.none(typed) : text.editor.opening}</Quiet>
        ) : null}
        {typed === '' ? (
          <button
            type="button"
            className="btn btn--small palettepanel__variable"
            disabled={!may}
            onClick={() => planDeskOf(studio).shown?.board.addVariable()}
          >
            {words.variable}
          </button>
        ) : null}
        {typed === '' ? (
          <button
            type="button"
            className="btn btn--small palettepanel__variable"
            disabled={!may}
            onClick={() => studio.registry.run('draw.note')}
          >
            {words.note}
          </button>
        ) : null}
        {typed === '' ? <NewTemplateButton /> : null}
      </div>
      {shown || !told ? null : <NoPlan />}
    </div>
  );
}

/** Nothing can be added yet: a plan is opened, or made here. */
function NoPlan() {
  const { registry } = useStudio();
  const drives = useDrives();
  return (
    <div className="palettepanel__none">
      <Quiet>{words.noPlan}</Quiet>
      <Button small disabled={!drives} onClick={() => void registry.run('file.new.plan')}>
        {text.commands['file.new.plan']}
      </Button>
    </div>
  );
}

/** Down and up, from the search through all that can be added. */
function stepByArrow(event: KeyboardEvent<HTMLElement>): void {
  const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
  if (by === undefined) return;
  const all = [
    ...event.currentTarget.querySelectorAll<HTMLElement>('input, .plantool:not(:disabled)'),
  ];
  const now = all.findIndex((one) => one === document.activeElement);
  if (now < 0) return;
  event.preventDefault();
  all[now + by]?.focus();
}
