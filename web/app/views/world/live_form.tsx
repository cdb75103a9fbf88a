import type { SceneObject } from '../../../protocol/messages';
import { radians, shownDegrees, type Pose } from '../../../core/world/geometry';
import type { WorldModel } from '../../../core/world/model';
import { isLamp, type Thing } from '../../../core/world/stage';
import { useEffect, useState } from 'react';
import { askWhy } from '../../commands/ask_why';
import { usePart, useStudio, useTopic } from '../../hooks';
import { useMayAct } from '../../past_hooks';
import { Button } from '../../parts/button';
import { text } from '../../text';
import { useModel } from './desk';
import { Field, SwitchField } from './fields';
import { targetOf } from './live_acts';
import { NumberField } from './number_field';
import { PressButtons } from './press_buttons';
import { formWords } from './form_words';

const words = text.world;
/** Numbers follow a thing that moves so often, in ms. */
const kEveryMs = 300;

/** The chosen thing of a running world: where it is, and what a hand can do with it. */
export function LiveForm({ model, thing }: { model: WorldModel; thing: Thing }) {
  const drives = useMayAct();
  const { follows } = useModel(model);
  const pose = usePose(model, thing);
  const move = (change: Partial<Pose>) =>
    model.acts?.move(thing, { ...model.poseOf(thing), ...change }, 'done');
  return (
    <>
      <NumberField
        label={words.x}
        unit="m"
        value={pose.x}
        disabled={!drives}
        onSet={(x) => x !== undefined && move({ x })}
      />
      <NumberField
        label={words.y}
        unit="m"
        value={pose.y}
        disabled={!drives}
        onSet={(y) => y !== undefined && move({ y })}
      />
      <NumberField
        label={words.angle}
        unit="°"
        step={1}
        value={Math.round(shownDegrees(pose.angle) * 10) / 10}
        disabled={!drives}
        onSet={(angle) => angle !== undefined && move({ angle: radians(angle) })}
      />
      {isLamp(thing.kind) ? (
        <SwitchField
          label={formWords.on}
          on={thing.on}
          disabled={!drives}
          onSet={(on) => model.acts?.light?.(thing, on)}
        />
      ) : null}
      {thing.kind === 'robot' ? (
        <>
          <SwitchField
            label={formWords.follow}
            on={follows === thing.key}
            onSet={(on) => model.follow(on ? thing.key : null)}
          />
          <PressButtons robot={thing.name} />
          <WhyWheels robot={thing.name} />
        </>
      ) : (
        <>
          <ObjectFacts thing={thing} />
          <div className="prop__end">
            <Button small disabled={!drives} keys="Delete" onClick={() => model.acts?.take(thing)}>
              {formWords.take}
            </Button>
          </div>
        </>
      )}
    </>
  );
}

/** The same as W, for those who do not know the key. */
function WhyWheels({ robot }: { robot: string }) {
  const studio = useStudio();
  const hasRun = usePart('history', {}, (is) => (is?.to ?? 0) > (is?.from ?? 0));
  return (
    <div className="prop__end">
      <Button small keys="W" disabled={!hasRun} onClick={() => void askWhy(studio, 'motor', robot)}>
        {formWords.whyWheels}
      </Button>
    </div>
  );
}

function ObjectFacts({ thing }: { thing: Thing }) {
  const objects: readonly SceneObject[] = useTopic('scene', {})?.objects ?? [];
  const object = objects.find((one) => one.number === targetOf(thing).object);
  if (!object) return null;
  const [width, length] = object.size ?? [];
  return (
    <>
      <Fact
        label={formWords.size}
        value={object.radius ? `r ${object.radius}` : `${width ?? 0} × ${length ?? 0}`}
        unit="m"
      />
      <Fact label={formWords.height} value={String(object.height)} unit="m" />
      {object.mass > 0 ? (
        <Fact label={formWords.mass} value={String(object.mass)} unit="kg" />
      ) : null}
    </>
  );
}

function Fact({ label, value, unit }: { label: string; value: string; unit: string }) {
  return (
    <Field label={label} unit={unit}>
      {(id) => (
        <output id={id} className="prop__fact num">
          {value}
        </output>
      )}
    </Field>
  );
}

function usePose(model: WorldModel, thing: Thing): Pose {
  const [pose, setPose] = useState(() => model.poseOf(thing));
  useEffect(() => {
    const read = () =>
      setPose((before) => {
        const now = model.poseOf(thing);
        return now.x === before.x && now.y === before.y && now.angle === before.angle
          ? before
          : now;
      });
    read();
    const timer = setInterval(read, kEveryMs);
    return () => clearInterval(timer);
  }, [model, thing]);
  return pose;
}
