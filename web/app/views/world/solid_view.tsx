import { Canvas } from '@react-three/fiber';
import { useEffect, useState, type RefObject } from 'react';
import type { WorldModel } from '../../../core/world/model';
import { readColours, type Colours } from './colours';
import { SolidCamera } from './solid_camera';
import { SolidScene } from './solid_scene';
import type { Eye } from './use_hands';

/** The world in 3D: drawn when something has changed; no shadows, and coarse under tests. */
export default function SolidView({
  model,
  eyeRef,
}: {
  model: WorldModel;
  eyeRef: RefObject<Eye | null>;
}) {
  const colours = useColours();
  const ratio = navigator.webdriver ? 0.75 : Math.min(window.devicePixelRatio || 1, 2);
  return (
    <div className="world__solid" aria-hidden>
      <Canvas
        frameloop="demand"
        flat
        dpr={ratio}
        gl={{ antialias: !navigator.webdriver, powerPreference: 'low-power' }}
        camera={{ up: [0, 0, 1], fov: 40, near: 0.01, far: 500 }}
      >
        <color attach="background" args={[colours.sky]} />
        <ambientLight intensity={1.5} />
        <directionalLight position={[-2, -4, 8]} intensity={1.9} />
        <SolidCamera model={model} eyeRef={eyeRef} />
        <SolidScene model={model} colours={colours} />
      </Canvas>
    </div>
  );
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
