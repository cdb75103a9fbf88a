import { useEffect, useRef, useState } from 'react';
import { viewOf } from '../../../core/base64';
import type { Past } from '../../../core/past';
import type { Studio } from '../../../core/studio';
import { readPicture } from '../../../core/world/frames';
import type { WorldModel } from '../../../core/world/model';
import { isBetterLow, toScreen } from '../../../core/world/view';
import { useStudio, useTopic } from '../../hooks';
import { usePastTime } from '../../past_hooks';
import { cameraWords } from './camera_words';
import { useModel } from './desk';

const kRate = 10;

/** What the camera of the chosen robot sees, or saw then; or that of the first that has one. */
export default function CameraPicture({ model, flat }: { model: WorldModel; flat: boolean }) {
  const robots = useTopic('scene', {})?.robots ?? [];
  const chosen = useModel(model).chosen;
  const robot =
    robots.find((one) => one.camera && one.name === chosen?.name && chosen.kind === 'robot') ??
    robots.find((one) => one.camera);
  const then = usePastTime() !== null;
  const low = useIsLow(model, flat ? robot?.name : undefined);
  return robot ? (
    <Picture key={`${robot.name} ${then}`} robot={robot.name} then={then} low={low} />
  ) : null;
}

/** Where the robot is seen from above, and what it drives into, the picture is not over it. */
function useIsLow(model: WorldModel, robot: string | undefined): boolean {
  const [low, setLow] = useState(false);
  useEffect(() => {
    const away = () => {
      const thing = model.stage.things.find((one) => one.kind === 'robot' && one.name === robot);
      if (!thing) return;
      const at = toScreen(model.seen(), model.screen, model.poseOf(thing));
      setLow((is) => isBetterLow(model.screen, at, is));
    };
    return model.drawn.on(away);
  }, [model, robot]);
  return low && robot !== undefined;
}

/** What is said below a picture; none: why there is no picture. */
type Show = (payload: DataView | null, caption: string) => void;

function Picture({ robot, then, low }: { robot: string; then: boolean; low: boolean }) {
  const studio = useStudio();
  const canvas = useRef<HTMLCanvasElement>(null);
  const [shown, setShown] = useState<{ caption: string; none: boolean } | null>(null);
  useEffect(() => {
    const show: Show = (payload, caption) =>
      setShown({ caption, none: payload === null || !draw(canvas.current, payload) });
    return then ? watchThen(studio.past, robot, show) : watchNow(studio, robot, show);
  }, [studio, robot, then]);
  const none = shown?.none === true;
  return (
    <figure
      className="world__camera"
      hidden={shown === null}
      data-none={none || undefined}
      data-low={low || undefined}
    >
      <canvas ref={canvas} role="img" aria-label={cameraWords.sees(robot)} hidden={none} />
      <figcaption>{shown?.caption}</figcaption>
    </figure>
  );
}

function watchNow({ connection }: Studio, robot: string, show: Show): () => void {
  const frame = (_t: number, payload: DataView) => show(payload, robot);
  return connection.watch('picture', { robot }, { frame }, kRate);
}

function watchThen(past: Past, robot: string, show: Show): () => void {
  const told = () => {
    const { picture, picture_t: t } = past.instant ?? {};
    if (!past.instant) return;
    if (picture === undefined || t === undefined) show(null, cameraWords.none(robot));
    else show(viewOf(picture), cameraWords.then(robot, t.toFixed(1)));
  };
  const ends = [past.changed.on(told), past.wants({ picture: robot })];
  return () => ends.forEach((end) => end());
}

function draw(canvas: HTMLCanvasElement | null, payload: DataView): boolean {
  const picture = readPicture(payload);
  const context = canvas?.getContext('2d');
  if (!picture || !canvas || !context) return false;
  canvas.width = picture.width;
  canvas.height = picture.height;
  context.putImageData(new ImageData(picture.pixels, picture.width, picture.height), 0, 0);
  return true;
}
