import type { Line } from '../../../protocol/messages';
import { planWords } from './live_words';
import '../../look/lists.css';

const words = planWords;

/** What happened, the newest first. */
export function PlanStory({ story }: { story: readonly Line[] }) {
  return (
    <section className="planlive__part planlive__story">
      <h3>{words.story}</h3>
      {story.length === 0 ? <p className="quiet">{words.nothing}</p> : null}
      <div role="log" aria-label={words.story}>
        {[...story].reverse().map((line) => (
          <p key={line.number} className={`said said--${line.kind}`}>
            <time>{line.t.toFixed(1)}</time>
            <span>{line.text}</span>
          </p>
        ))}
      </div>
    </section>
  );
}
