import { marksOf, type MarkKind } from '../../../../core/plan/differences';
import type { Compared } from '../../../../core/plan/comparing';
import { compareWords as words } from './words';

const kinds: readonly MarkKind[] = ['added', 'changed', 'removed'];

/** How much differs, with the signs and colours of the drawing. */
export function Legend({ answer: { differences, places } }: { answer: Compared }) {
  const kindOf = (one: Compared['differences'][number]): MarkKind =>
    one.kind === 'reordered' ? 'changed' : (marksOf(one)[0]?.kind ?? one.kind);
  return (
    <ul className="pcompare__legend" aria-label={words.legend}>
      {differences.length === 0 ? <li>{words.none}</li> : null}
      {kinds.map((kind) => {
        const count = differences.filter((one) => kindOf(one) === kind).length;
        if (count === 0) return null;
        return (
          <li key={kind}>
            <span className={`pdiff__sign pdiff__sign--${kind}`} aria-hidden>
              {words.signs[kind]}
            </span>
            <span className="num">{count}</span> {words.kinds[kind]}
          </li>
        );
      })}
      {places === 0 ? null : <li className="muted">{words.places(places)}</li>}
    </ul>
  );
}
