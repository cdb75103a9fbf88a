import { IconSearch } from '@tabler/icons-react';
import { useState } from 'react';
import type { PlanTemplate } from '../../protocol/messages';
import { kStart } from '../../core/plan/model';
import { matching, type Group } from '../../core/plan/templates';
import { toast } from '../../core/window_state';
import type { Studio } from '../../core/studio';
import { useDrives, useStudio, useTopic } from '../hooks';
import { Quiet } from '../parts/blank';
import { kStroke } from '../parts/icons';
import { text } from '../text';
import { RoleShape, TemplateIcon } from '../views/plan/canvas/template_icon';
import { planDeskOf, usePlanDesk } from '../views/plan/plan_desk';
import { dragged, kTemplateData } from '../views/plan/template_drag';
import { NewTemplateButton } from './palette/new_template_button';
import { SubPlans } from './palette/sub_plans';
import '../look/palette.css';

const words = text.templates;

/** What plans can be made of, by toolbox: dragged onto a plan, or added by a press. */
export default function PalettePanel() {
  const studio = useStudio();
  const drives = useDrives();
  const { shown } = usePlanDesk(studio);
  const toolboxes = useTopic('templates', {})?.toolboxes ?? [];
  const [typed, type] = useState('');
  const groups = matching(toolboxes, typed);
  const count = toolboxes.reduce((sum, one) => sum + one.templates.length, 0);
  const may = drives && shown !== undefined;
  return (
    <div className="palettepanel">
      <label className="search">
        <IconSearch className="icon" size={14} stroke={kStroke} aria-hidden />
        <input
          type="search"
          placeholder={words.search(count)}
          aria-label={words.search(count)}
          value={typed}
          onChange={(event) => type(event.target.value)}
          onKeyDown={(event) => {
            const first = groups[0]?.templates[0];
            if (event.key === 'Enter' && may && groups[0] && first)
              addTemplate(studio, groups[0].name, first);
          }}
        />
      </label>
      <div className="scroll" tabIndex={0} data-inset>
        {groups.map((group) => (
          <Toolbox key={group.name} group={group} may={may} />
        ))}
        <SubPlans may={may} typed={typed} />
        {groups.length === 0 ? <Quiet>{words.none(typed)}</Quiet> : null}
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
      {shown ? null : <Quiet>{words.noPlan}</Quiet>}
    </div>
  );
}

function Toolbox({ group, may }: { group: Group; may: boolean }) {
  return (
    <section aria-label={group.name}>
      <h3 className="palettepanel__head" title={group.help}>
        {group.name}
        <span className="muted">{group.templates.length}</span>
      </h3>
      <ul>
        {group.templates.map((one) => (
          <li key={one.name}>
            <Tool toolbox={group.name} template={one} may={may} />
          </li>
        ))}
      </ul>
    </section>
  );
}

function Tool(props: { toolbox: string; template: PlanTemplate; may: boolean }) {
  const { toolbox, template, may } = props;
  const studio = useStudio();
  return (
    <button
      type="button"
      className="tool"
      title={template.help}
      aria-label={words.add(template.name, text.draw.roles[template.kind])}
      disabled={!may}
      draggable={may}
      onDragStart={(event) => {
        event.dataTransfer.setData(kTemplateData, dragged(toolbox, template));
        event.dataTransfer.effectAllowed = 'copy';
      }}
      onClick={() => addTemplate(studio, toolbox, template)}
    >
      <TemplateIcon icon={template.icon} />
      <span className="ellipsis grow">{template.name}</span>
      <RoleShape kind={template.kind} label={text.draw.roles[template.kind]} />
    </button>
  );
}

/** An actor goes where one looks; a supervisor under what is chosen. */
function addTemplate(studio: Studio, toolbox: string, template: PlanTemplate): void {
  const { shown } = planDeskOf(studio);
  if (!shown) return;
  const { board } = shown;
  const found = { toolbox, template };
  if (template.kind !== 'supervisor') return shown.focus(board.addActor(found, shown.middle()));
  const { selected } = board;
  const owner = board.actor(selected)?.name ?? board.supervisor(selected)?.owner;
  if (owner === undefined && selected !== kStart) return toast(studio.window, 'note', words.whose);
  shown.focus(board.addSupervisor(found, owner ?? kStart));
}
