import { useDrives, useStudio, useTopic } from '../../hooks';
import { Button } from '../../parts/button';
import { DroppedByNodes } from './dropped_by_nodes';
import { HeldRow } from './held_row';
import { heldWords } from './words';

const words = heldWords;

/** Events of the bus that wait while the plan is paused; and what paused nodes have dropped. */
export function HeldEvents() {
  const studio = useStudio();
  const drives = useDrives();
  const held = useTopic('held', {});
  const events = held?.events ?? [];
  const shown = held !== undefined && (held.stands || events.length > 0);
  const idle = !drives || !held?.stands || events.length === 0;
  const nodes = useTopic('robot', {})?.nodes ?? [];
  return (
    <>
      {shown ? (
        <section aria-label={words.title}>
          <div className="held__head">
            <h3>{words.title}</h3>
            <span className="muted ellipsis">{words.why}</span>
            <span className="grow" />
            <Button small disabled={idle} onClick={() => studio.order('plan.held.step', {})}>
              {words.step}
            </Button>
            <Button small disabled={idle} onClick={() => studio.order('plan.held.go', {})}>
              {words.goAll}
            </Button>
            <Button small disabled={idle} onClick={() => studio.order('plan.held.drop', {})}>
              {words.dropAll}
            </Button>
          </div>
          {events.length === 0 ? <p className="held__note">{words.none}</p> : null}
          <ul aria-label={words.title}>
            {events.map((one) => (
              <HeldRow key={one.number} one={one} nodes={nodes} />
            ))}
          </ul>
          {held.more > 0 ? <p className="held__note">{words.more(held.more)}</p> : null}
          {held.dropped > 0 ? (
            <p className="held__note held__note--lost" role="status">
              {words.dropped(held.dropped)}
            </p>
          ) : null}
        </section>
      ) : null}
      <DroppedByNodes nodes={nodes} />
    </>
  );
}
