import { useThree } from '@react-three/fiber';
import { useEffect, useMemo, useRef } from 'react';
import { Group } from 'three';
import type { WorldModel } from '../../../core/world/model';
import { useStudio } from '../../hooks';
import type { Colours } from './colours';
import { useModel } from './desk';
import { optionsOf } from './options';
import { SolidDrawer } from './solid_drawer';

/** What stands in the world, moved past React: once a frame, from the model. */
export function SolidScene({ model, colours }: { model: WorldModel; colours: Colours }) {
  const studio = useStudio();
  const invalidate = useThree((three) => three.invalidate);
  const { stage } = useModel(model);
  const group = useRef<Group>(null);
  const drawer = useMemo(() => new SolidDrawer(model, colours), [model, colours]);
  useEffect(() => {
    const place = group.current;
    place?.add(drawer.root);
    let asked = 0;
    const draw = () => {
      asked = 0;
      drawer.move(optionsOf(studio).getState());
      invalidate();
    };
    const ask = () => {
      if (asked === 0) asked = requestAnimationFrame(draw);
    };
    const ends = [model.drawn.on(ask), optionsOf(studio).subscribe(ask)];
    ask();
    return () => {
      ends.forEach((end) => end());
      cancelAnimationFrame(asked);
      place?.remove(drawer.root);
      drawer.dispose();
    };
  }, [studio, drawer, model, invalidate]);
  useEffect(() => {
    drawer.build();
    model.drawn.emit();
  }, [drawer, stage, model]);
  return <group ref={group} />;
}
