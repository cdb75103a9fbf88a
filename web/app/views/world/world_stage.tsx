import { Suspense, useEffect, useRef, useState, type ReactNode } from 'react';
import { late } from '../../parts/late';
import type { JsonFile } from '../../../core/session/json_file';
import type { Point } from '../../../core/world/geometry';
import type { WorldModel } from '../../../core/world/model';
import { useStudio, useTopic } from '../../hooks';
import { usePastTime, useTraceName } from '../../past_hooks';
import { text } from '../../text';
import { deskOf, useModel, type ShownWorld } from './desk';
import { FlatView } from './flat_view';
import { useWorldOptions } from './options';
import { SolidGuard } from './solid_guard';
import { StatusChip } from './status_chip';
import { useHands, type Eye } from './use_hands';
import { canSolid } from './webgl';
import { nameOfThing } from './words';

const SolidView = late(() => import('./solid_view'));
const CameraPicture = late(() => import('./camera_picture'), 'button');
const RobotMenu = late(() => import('./robot_menu'), 'button');

/** The picture of a world, with what is over it. All that can be done with it has keys, too. */
export function WorldStage({
  model,
  file,
  live,
  children,
}: {
  model: WorldModel;
  file: JsonFile | null;
  live: boolean;
  children?: ReactNode;
}) {
  const frame = useRef<HTMLDivElement>(null);
  const eye = useRef<Eye | null>(null);
  const options = useWorldOptions();
  const looksBack = usePastTime() !== null;
  const isTrace = useTraceName() !== null;
  const sees = useTopic('scene', {})?.robots.some((one) => one.camera) ?? false;
  const [failed, setFailed] = useState(false);
  useOnDesk(frame, model, file);
  const [menu, setMenu] = useState<Point | null>(null);
  useHands(frame, model, eye, options.snap, setMenu);
  const solid = options.solid && canSolid() && !failed;
  const flat = <FlatView model={model} eyeRef={eye} />;
  return (
    <div
      className="world__stage"
      ref={frame}
      role="application"
      aria-label={text.world.canvas(model.stage.name)}
      aria-description={text.world.canvasHelp}
      tabIndex={0}
      data-place="world"
      data-autofocus
      data-inset
    >
      {solid ? (
        <SolidGuard onFail={() => setFailed(true)}>
          <Suspense fallback={flat}>
            <SolidView model={model} eyeRef={eye} />
          </Suspense>
        </SolidGuard>
      ) : (
        flat
      )}
      <div className="world__over">
        {live && !looksBack ? <StatusChip model={model} /> : null}
        {live && looksBack && !isTrace ? <p className="world__chip">{text.past.dashed}</p> : null}
        <PlacingNote model={model} />
        {children}
      </div>
      {live && options.picture && sees ? (
        <Suspense>
          <CameraPicture model={model} flat={!solid} />
        </Suspense>
      ) : null}
      {menu ? (
        <Suspense>
          <RobotMenu at={menu} onClose={() => (setMenu(null), frame.current?.focus())} />
        </Suspense>
      ) : null}
      <Spoken model={model} />
    </div>
  );
}

/** Tells that this world is the one that is looked at, once it is used. */
function useOnDesk(
  frame: React.RefObject<HTMLDivElement | null>,
  model: WorldModel,
  file: JsonFile | null,
): void {
  const studio = useStudio();
  useEffect(() => {
    const place = frame.current;
    const desk = deskOf(studio);
    const world: ShownWorld = { model, file, focus: () => place?.focus() };
    const end = desk.add(world);
    const use = () => desk.use(world);
    const around = place?.closest('[data-world]') ?? place;
    around?.addEventListener('focusin', use);
    around?.addEventListener('pointerdown', use);
    // Its mode was chosen just now.
    if (around?.contains(document.activeElement)) use();
    return () => {
      end();
      around?.removeEventListener('focusin', use);
      around?.removeEventListener('pointerdown', use);
    };
  }, [studio, frame, model, file]);
}

function PlacingNote({ model }: { model: WorldModel }) {
  const { placing, follows } = useModel(model);
  const followed = model.thing(follows);
  if (placing) {
    const what =
      placing.what === 'robot' ? text.world.types[placing.type] : text.world.kinds[placing.kind];
    return <p className="world__chip is-on">{text.world.placing(what)}</p>;
  }
  return followed ? (
    <p className="world__chip">{text.world.following(nameOfThing(followed))}</p>
  ) : null;
}

function Spoken({ model }: { model: WorldModel }) {
  const [said, setSaid] = useState('');
  useEffect(() => model.spoken.on(setSaid), [model]);
  return (
    <p className="hidden-text" role="status">
      {said}
    </p>
  );
}
