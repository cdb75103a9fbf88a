// The canvas of the 3D picture, with its camera and lights. It is drawn when somebody asks, at most once a frame;
// no shadows, and coarse under tests.

import {
  AmbientLight,
  Color,
  DirectionalLight,
  PerspectiveCamera,
  Scene,
  WebGLRenderer,
} from 'three';

export class SolidStage {
  readonly camera = new PerspectiveCamera(40, 1, 0.01, 500);
  readonly scene = new Scene();
  private readonly renderer: WebGLRenderer;
  private readonly resizes: ResizeObserver;
  private asked = 0;

  /** Fills `place`; `resized` is called with each size. Throws where there is no WebGL. */
  constructor(
    private readonly place: HTMLElement,
    private readonly resized: () => void,
  ) {
    const isCoarse = navigator.webdriver;
    this.renderer = new WebGLRenderer({ antialias: !isCoarse, powerPreference: 'low-power' });
    this.renderer.setPixelRatio(isCoarse ? 0.75 : Math.min(window.devicePixelRatio || 1, 2));
    this.camera.up.set(0, 0, 1);
    const sun = new DirectionalLight(0xffffff, 1.9);
    sun.position.set(-2, -4, 8);
    this.scene.add(new AmbientLight(0xffffff, 1.5), sun);
    place.append(this.element);
    this.fill();
    this.resizes = new ResizeObserver(() => {
      this.fill();
      this.resized();
      // At once: a canvas that got a new size is empty.
      this.draw();
    });
    this.resizes.observe(place);
  }

  get element(): HTMLCanvasElement {
    return this.renderer.domElement;
  }

  setSky(colour: string): void {
    this.scene.background = new Color(colour);
    this.ask();
  }

  ask(): void {
    if (this.asked === 0) this.asked = requestAnimationFrame(() => this.draw());
  }

  /** Now. */
  draw(): void {
    cancelAnimationFrame(this.asked);
    this.asked = 0;
    this.renderer.render(this.scene, this.camera);
  }

  end(): void {
    cancelAnimationFrame(this.asked);
    this.resizes.disconnect();
    this.element.remove();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  private fill(): void {
    const { clientWidth: width, clientHeight: height } = this.place;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }
}
