import type { Json, PlanDifference } from '../../../../protocol/messages';
import { marksOf } from '../../../../core/plan/differences';
import { stepThroughRows } from '../../../parts/list_keys';
import { compareWords as words } from './words';

/** All that differs, each a click from its place in the drawing; up and down go from one to the next. */
export function DifferenceList(props: {
  differences: readonly PlanDifference[];
  at: number | null;
  onShow(index: number): void;
}) {
  const { differences, at, onShow } = props;
  return (
    <ul className="pcompare__list" aria-label={words.list} onKeyDown={stepThroughRows}>
      {differences.map((one, index) => (
        <li key={`${one.kind} ${one.path.join('/')}`}>
          <button
            type="button"
            className={index === at ? 'pcompare__one is-current' : 'pcompare__one'}
            aria-current={index === at}
            data-inset
            onClick={() => onShow(index)}
          >
            <DifferenceLine difference={one} />
          </button>
        </li>
      ))}
    </ul>
  );
}

/** What it is about, and what it was and is. */
export function DifferenceLine({ difference }: { difference: PlanDifference }) {
  const { kind, before, after } = difference;
  const sign = marksOf(difference)[0]?.kind ?? (kind === 'reordered' ? 'changed' : kind);
  return (
    <span className="pcompare__line">
      <span className={`pdiff__sign pdiff__sign--${sign}`} aria-hidden>
        {words.signs[sign]}
      </span>
      <b>{words.nameOf(difference)}</b>
      <span className="muted">{words.kinds[kind]}</span>
      <span className="pcompare__values">
        {before === undefined ? null : (
          <del aria-label={words.before} title={textOf(before)}>
            {textOf(before)}
          </del>
        )}
        {before === undefined || after === undefined ? null : <span aria-hidden> → </span>}
        {after === undefined ? null : (
          <ins aria-label={words.after} title={textOf(after)}>
            {textOf(after)}
          </ins>
        )}
      </span>
    </span>
  );
}

/** Formulas as they are written. */
function textOf(value: Json): string {
  if (typeof value === 'string') return value;
  const isNames = Array.isArray(value) && value.every((one) => typeof one === 'string');
  return isNames ? value.join(', ') : JSON.stringify(value);
}
