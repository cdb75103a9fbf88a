import type { PlanTemplate } from '../../../../protocol/messages';
import type { Actor } from '../../../../core/plan/model';
import '../../../look/palette.css';

const kSubPlan = 'M3 4h18v16H3zM7 8h10v8H7z';

/** The drawing of a template, from its toolbox. */
export function TemplateIcon({ icon, role }: { icon: string; role?: Actor['role'] }) {
  return (
    <svg className="ptemplate" viewBox="0 0 24 24" aria-hidden>
      <path d={role === 'subplan' ? kSubPlan : icon} />
    </svg>
  );
}

const roleShapes: Record<PlanTemplate['kind'], string> = {
  actor: 'M2.5 1H11.5Q13 1 13 2.5V7.5Q13 9 11.5 9H2.5Q1 9 1 7.5V2.5Q1 1 2.5 1z',
  computation: 'M1 1H9.5L13 4.5V9H1z',
  supervisor: 'M4 1H10L13 5L10 9H4L1 5z',
};

/** The shape of a role, small. */
export function RoleShape({ kind, label }: { kind: PlanTemplate['kind']; label: string }) {
  return (
    <svg className={`prole prole--${kind}`} viewBox="0 0 14 10" role="img" aria-label={label}>
      <path d={roleShapes[kind]} />
    </svg>
  );
}
