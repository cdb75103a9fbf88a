import { useEffect, useRef, useState, type RefObject } from 'react';
import type { WorldModel } from '../../../core/world/model';
import type { Studio } from '../../../core/studio';
import { useStudio } from '../../hooks';
import { readColours, type Colours } from './colours';
import { optionsOf } from './options';
import { SolidCamera } from './solid_camera';
import { SolidDrawer } from './solid_drawer';
import { SolidStage } from './solid_stage';
import type { Eye } from './use_hands';

/** The world in 3D: drawn when something has changed. */
export default function SolidView({
  model,
  eyeRef,
}: {
  model: WorldModel;
  eyeRef: RefObject<Eye | null>;
}) {
  const studio = useStudio();
  const place = useRef<HTMLDivElement>(null);
  const stage = useRef<SolidStage | null>(null);
  const colours = useColours();
  useEffect(() => {
    if (!place.current) return;
    const made = new SolidStage(place.current, () => model.drawn.emit());
    const camera = new SolidCamera(model, made);
    stage.current = made;
    eyeRef.current = camera.eye;
    return () => {
      eyeRef.current = null;
      stage.current = null;
      camera.end();
      made.end();
    };
  }, [model, eyeRef]);
  useEffect(
    () => (stage.current ? drawIn(stage.current, studio, model, colours) : undefined),
    [studio, model, colours],
  );
  return <div className="world__solid" ref={place} aria-hidden />;
}

/** What is in the world, moved past React: once a frame, from the model. */
function drawIn(
  stage: SolidStage,
  studio: Studio,
  model: WorldModel,
  colours: Colours,
): () => void {
  const drawer = new SolidDrawer(model, colours);
  let built: unknown = null;
  let image: unknown = null;
  let asked = 0;
  const draw = () => {
    asked = 0;
    build();
    drawer.move(optionsOf(studio).getState());
    stage.draw();
  };
  const ask = () => {
    if (asked === 0) asked = requestAnimationFrame(draw);
  };
  const build = () => {
    if (built === model.stage && image === model.image) return;
    built = model.stage;
    image = model.image;
    drawer.build();
    model.drawn.emit();
  };
  stage.setSky(colours.sky);
  stage.scene.add(drawer.root);
  const ends = [model.drawn.on(ask), model.changed.on(build), optionsOf(studio).subscribe(ask)];
  build();
  return () => {
    ends.forEach((end) => end());
    cancelAnimationFrame(asked);
    stage.scene.remove(drawer.root);
    drawer.dispose();
  };
}

function useColours(): Colours {
  const [colours, setColours] = useState(readColours);
  useEffect(() => {
    const themes = new MutationObserver(() => setColours(readColours()));
    themes.observe(document.documentElement, { attributeFilter: ['data-theme'] });
    return () => themes.disconnect();
  }, []);
  return colours;
}
