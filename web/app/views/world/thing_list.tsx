import { useEffect, useRef } from 'react';
import type { WorldModel } from '../../../core/world/model';
import type { Thing } from '../../../core/world/stage';
import { text } from '../../text';
import { css } from './colours';
import { useModel } from './desk';
import { degreesText, metres, nameOfThing } from './words';

/** Numbers of the list change so often, in ms, without React. */
const kEveryMs = 400;
const words = text.world;

/**
 * All that is in the world: name, place, angle. What the picture shows, for those who do not see
 * it; hidden: for them alone, where a panel has no room.
 */
export function ThingList({ model, hidden = false }: { model: WorldModel; hidden?: boolean }) {
  const { stage, selected } = useModel(model);
  const body = useRef<HTMLTableSectionElement>(null);
  usePlaces(body, model);
  const things = [...stage.things].reverse();
  return (
    <div className={hidden ? 'hidden-text' : 'things'}>
      <table aria-label={words.list} className="things__table">
        <thead>
          <tr>
            <th scope="col">{words.name}</th>
            <th scope="col">{words.x} m</th>
            <th scope="col">{words.y} m</th>
            <th scope="col">{words.angle}</th>
          </tr>
        </thead>
        <tbody ref={body}>
          {things.map((thing) => (
            <Row
              key={thing.key}
              thing={thing}
              model={model}
              chosen={thing.key === selected}
              still={hidden}
            />
          ))}
        </tbody>
      </table>
      {things.length === 0 ? <p className="quiet">{words.noThings}</p> : null}
    </div>
  );
}

function Row(props: { thing: Thing; model: WorldModel; chosen: boolean; still: boolean }) {
  const { thing, model, chosen, still } = props;
  const name = nameOfThing(thing);
  return (
    <tr data-key={thing.key} aria-selected={chosen} className={chosen ? 'is-on' : ''}>
      <th scope="row">
        {still ? (
          name
        ) : (
          <button
            type="button"
            className="things__name"
            aria-pressed={chosen}
            data-inset
            onClick={() => model.select(chosen ? null : thing.key)}
          >
            <Swatch thing={thing} />
            <span className="ellipsis">{name}</span>
            {thing.later ? <span className="muted">{words.later}</span> : null}
          </button>
        )}
      </th>
      <td />
      <td />
      <td />
    </tr>
  );
}

export function Swatch({ thing }: { thing: Thing }) {
  const round = thing.shape.radius > 0;
  return (
    <span
      className={`swatch swatch--${thing.kind}${round ? ' is-round' : ''}${thing.later ? ' is-later' : ''}`}
      style={{ background: thing.kind === 'robot' ? undefined : css(thing.colour) }}
      aria-hidden
    />
  );
}

function usePlaces(body: React.RefObject<HTMLTableSectionElement | null>, model: WorldModel): void {
  useEffect(() => {
    const write = () => {
      for (const row of body.current?.rows ?? []) {
        const thing = model.thing(row.dataset['key'] ?? null);
        const pose = thing && model.poseOf(thing);
        const known = pose !== undefined && Number.isFinite(pose.x);
        const shown = known ? [metres(pose.x), metres(pose.y), `${degreesText(pose.angle)}°`] : [];
        [1, 2, 3].forEach((column) => {
          const cell = row.cells[column];
          const value = shown[column - 1] ?? '–';
          if (cell && cell.textContent !== value) cell.textContent = value;
        });
      }
    };
    // After React has made its rows.
    const off = model.changed.on(() => queueMicrotask(write));
    write();
    const timer = setInterval(write, kEveryMs);
    return () => {
      off();
      clearInterval(timer);
    };
  });
}
