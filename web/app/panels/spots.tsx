import type { Doc, Spot } from '../../protocol/messages';
import { revealDoc } from '../../core/window_state';
import { nameOf } from '../documents';
import { useStudio } from '../hooks';

/** Places in documents, by document, each with its line. */
export function Spots({ spots, label }: { spots: readonly Spot[]; label: string }) {
  const studio = useStudio();
  const byDoc = new Map<Doc, Spot[]>();
  for (const spot of spots) byDoc.set(spot.doc, [...(byDoc.get(spot.doc) ?? []), spot]);
  return (
    <div className="scroll" role="group" aria-label={label}>
      {[...byDoc].map(([doc, list]) => (
        <section key={doc}>
          <h3 className="finder__doc">
            {nameOf(studio, doc)} <span className="count">{list.length}</span>
          </h3>
          {list.map((spot) => (
            <button
              key={`${spot.at.line}:${spot.at.column}`}
              type="button"
              className="spot"
              data-inset
              onClick={() => revealDoc(studio.window, doc, spot.at)}
            >
              <span className="spot__line">{spot.at.line}</span>
              <MarkedLine spot={spot} />
            </button>
          ))}
        </section>
      ))}
    </div>
  );
}

function MarkedLine({ spot }: { spot: Spot }) {
  const letters = [...spot.line_text];
  const from = spot.at.column - 1;
  const to = spot.end.line === spot.at.line ? spot.end.column - 1 : letters.length;
  const skip = letters.findIndex((letter) => letter !== ' ' && letter !== '\t');
  const start = Math.min(Math.max(skip, 0), from);
  return (
    <code>
      {letters.slice(start, from).join('')}
      <mark>{letters.slice(from, to).join('')}</mark>
      {letters.slice(to).join('')}
    </code>
  );
}
