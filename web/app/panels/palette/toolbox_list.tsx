import type { PlanTemplate } from '../../../protocol/messages';
import { Emitter } from '../../../core/emitter';
import { kStart } from '../../../core/plan/model';
import { hiddenBy, type Found, type Group } from '../../../core/plan/templates';
import type { Studio } from '../../../core/studio';
import { toast } from '../../../core/window_state';
import { useChanges, useStudio, useTopic } from '../../hooks';
import { drawWords } from '../../views/plan/words';
import { Carried, useCarried } from './carried';
import { words } from './words';
import { RoleShape, TemplateIcon } from '../../views/plan/canvas/template_icon';
import { planDeskOf, usePlanDesk } from '../../views/plan/plan_desk';
import { dragged, kTemplateData } from '../../views/plan/template_drag';

/** The templates of one toolbox. */
export function ToolboxList({ group, may }: { group: Group; may: boolean }) {
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

const kNoPlan = new Emitter<void>();

/** The toolbox whose template the plan that is looked at would get instead. */
function useHiddenBy(studio: Studio, toolbox: string, template: PlanTemplate): string | null {
  const { shown } = usePlanDesk(studio);
  const toolboxes = useTopic('templates', {})?.toolboxes ?? [];
  useChanges(shown?.board.changed ?? kNoPlan);
  return shown ? hiddenBy(toolboxes, shown.board.model.toolboxes, { toolbox, template }) : null;
}

function Tool(props: { toolbox: string; template: PlanTemplate; may: boolean }) {
  const { toolbox, template, may } = props;
  const studio = useStudio();
  const hider = useHiddenBy(studio, toolbox, template);
  const can = may && hider === null;
  const { at, hands } = useCarried(dragged(toolbox, template), can);
  return (
    <button
      type="button"
      className="plantool"
      title={hider === null ? template.help : words.hidden(template.name, hider, toolbox)}
      aria-label={words.add(template.name, drawWords.roles[template.kind])}
      disabled={!can}
      draggable={can}
      onDragStart={(event) => {
        event.dataTransfer.setData(kTemplateData, dragged(toolbox, template));
        event.dataTransfer.effectAllowed = 'copy';
      }}
      onClick={() => addTemplate(studio, { toolbox, template })}
      {...hands}
    >
      <TemplateIcon icon={template.icon} />
      <span className="ellipsis grow">{template.name}</span>
      <RoleShape kind={template.kind} label={drawWords.roles[template.kind]} />
      {at ? <Carried at={at} name={template.name} /> : null}
    </button>
  );
}

/** An actor goes where one looks; a supervisor under what is chosen. */
export function addTemplate(studio: Studio, found: Found): void {
  const { shown } = planDeskOf(studio);
  if (!shown) return;
  const { board } = shown;
  if (found.template.kind !== 'supervisor')
    return shown.focus(board.addActor(found, shown.middle(), shown.room()));
  const { selected } = board;
  const owner = board.actor(selected)?.name ?? board.supervisor(selected)?.owner;
  if (owner === undefined && selected !== kStart) return toast(studio.window, 'note', words.whose);
  shown.focus(board.addSupervisor(found, owner ?? kStart));
}
