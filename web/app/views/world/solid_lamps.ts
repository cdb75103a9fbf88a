// Lit lamps of robots in 3D: a bright ball on the roof with a halo, as many as there are at the moment.

import { Color, Group, Mesh, MeshBasicMaterial, SphereGeometry, SRGBColorSpace } from 'three';
import type { Colour } from '../../../protocol/messages';
import type { Lit } from '../../../core/world/lamps';

const kHalo = 2.2;

export class Lamps {
  readonly object = new Group();
  private readonly ball = new SphereGeometry(1, 14, 10);

  show(lit: readonly Lit[]): void {
    while (this.object.children.length < lit.length) this.object.add(this.make());
    this.object.children.forEach((lamp, index) => {
      const one = lit[index];
      lamp.visible = one !== undefined;
      if (!one) return;
      lamp.position.set(one.at.x, one.at.y, one.height);
      lamp.scale.setScalar(one.radius);
      const [core, halo] = lamp.children;
      paint(core, one.core);
      paint(halo, one.colour);
    });
  }

  dispose(): void {
    this.ball.dispose();
    this.object.traverse((one) => {
      if (one instanceof Mesh) (one.material as MeshBasicMaterial).dispose();
    });
    this.object.clear();
  }

  private make(): Group {
    const lamp = new Group();
    const halo = new Mesh(
      this.ball,
      new MeshBasicMaterial({ transparent: true, opacity: 0.35, depthWrite: false }),
    );
    halo.scale.setScalar(kHalo);
    return lamp.add(new Mesh(this.ball, new MeshBasicMaterial()), halo);
  }
}

function paint(part: unknown, [red = 0, green = 0, blue = 0]: Colour): void {
  if (!(part instanceof Mesh)) return;
  const { color } = part.material as MeshBasicMaterial & { color: Color };
  color.setRGB(red, green, blue, SRGBColorSpace);
}
