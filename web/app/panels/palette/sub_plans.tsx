import { pathTo } from '../../../core/plan/sub_plans';
import { useStudio, useTopic } from '../../hooks';
import { drawWords } from '../../views/plan/words';
import { words } from './words';
import { TemplateIcon } from '../../views/plan/canvas/template_icon';
import { usePlanDesk } from '../../views/plan/plan_desk';

/** Other plans of the project: each can be an actor of this one, and it of itself. */
export function SubPlans({ may, typed }: { may: boolean; typed: string }) {
  const { shown } = usePlanDesk(useStudio());
  const files = useTopic('files', {})?.files ?? [];
  const wanted = typed.trim().toLowerCase();
  const plans = files.filter(
    ({ path, kind }) => kind === 'plan' && path.toLowerCase().includes(wanted),
  );
  const { subPlans } = drawWords;
  if (plans.length === 0 || !shown) return null;
  const { board } = shown;
  return (
    <section aria-label={subPlans.title}>
      <h3 className="palettepanel__head" title={subPlans.help}>
        {subPlans.title}
        <span className="muted">{plans.length}</span>
      </h3>
      <ul>
        {plans.map(({ path }) => (
          <li key={path}>
            <button
              type="button"
              className="plantool"
              aria-label={words.add(path, drawWords.roles.subplan)}
              disabled={!may}
              onClick={() =>
                shown.focus(board.addSubPlan(pathTo(board.doc, path), shown.middle(), shown.room()))
              }
            >
              <TemplateIcon icon="" role="subplan" />
              <span className="ellipsis grow">{path.replace(/\.plan\.json$/, '')}</span>
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}
