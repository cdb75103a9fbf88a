import { useEffect, useRef, useState } from 'react';
import { readPicture } from '../../../core/world/frames';
import type { WorldModel } from '../../../core/world/model';
import { useStudio, useTopic } from '../../hooks';
import { text } from '../../text';
import { useModel } from './desk';

const kRate = 10;

/** What the camera of the chosen robot sees, or of the first that has one. */
export function CameraPicture({ model }: { model: WorldModel }) {
  const { connection } = useStudio();
  const robots = useTopic('scene', {})?.robots ?? [];
  const chosen = useModel(model).chosen;
  const robot =
    robots.find((one) => one.camera && one.name === chosen?.name && chosen.kind === 'robot') ??
    robots.find((one) => one.camera);
  const name = robot?.name;
  const canvas = useRef<HTMLCanvasElement>(null);
  const [seen, setSeen] = useState(false);
  useEffect(() => {
    if (name === undefined) return;
    const end = connection.watch(
      'picture',
      { robot: name },
      {
        frame(_t, payload) {
          const picture = readPicture(payload);
          const context = canvas.current?.getContext('2d');
          if (!picture || !canvas.current || !context) return;
          canvas.current.width = picture.width;
          canvas.current.height = picture.height;
          context.putImageData(new ImageData(picture.pixels, picture.width, picture.height), 0, 0);
          setSeen(true);
        },
      },
      kRate,
    );
    return () => {
      end();
      setSeen(false);
    };
  }, [connection, name]);
  if (name === undefined) return null;
  return (
    <figure className="world__camera" hidden={!seen}>
      <canvas ref={canvas} role="img" aria-label={text.world.pictureOf(name)} />
      <figcaption>{name}</figcaption>
    </figure>
  );
}
