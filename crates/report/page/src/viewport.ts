import {
  AmbientLight, Color, DirectionalLight, PerspectiveCamera, Scene, Vector2, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { color, onThemeChange } from "./theme";

/** A direction to look from, z up. */
export const VIEWS = {
  iso: new Vector3(1, -1.5, 0.8),
  x: new Vector3(1, 0, 0),
  y: new Vector3(0, 1, 0),
  z: new Vector3(0, -1e-3, 1),
} as const;
export type ViewName = keyof typeof VIEWS;

/** A scene in a resizable element, turned by mouse and touch, drawn when something has changed. */
export class Viewport {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(32, 1, 0.01, 1000);
  readonly resolution = new Vector2(1, 1);
  private readonly renderer: WebGLRenderer;
  private readonly controls: OrbitControls;
  private readonly sun = new DirectionalLight(0xffffff, 2.2);
  private fitted = { center: new Vector3(), radius: 1 };
  private requested = false;

  /** Throws where the browser has no WebGL. */
  constructor(private readonly element: HTMLElement) {
    this.renderer = new WebGLRenderer({ antialias: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    element.prepend(this.renderer.domElement);
    this.camera.up.set(0, 0, 1);
    this.camera.add(this.sun, this.sun.target);
    this.sun.position.set(-0.6, 1, 0.6);
    this.sun.target.position.set(0, 0, -1);
    this.scene.add(this.camera, new AmbientLight(0xffffff, 1.5));
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener("change", () => this.requestDraw());
    new ResizeObserver(() => this.resize()).observe(element);
    onThemeChange(() => this.paint());
    this.paint();
    this.resize();
  }

  /** Draws with the next frame of the browser, once however often it is asked. */
  requestDraw(): void {
    if (this.requested) return;
    this.requested = true;
    requestAnimationFrame(() => {
      this.requested = false;
      this.renderer.render(this.scene, this.camera);
    });
  }

  /** Points that the last drawing sent to the screen. */
  drawnPoints(): number {
    return this.renderer.info.render.points;
  }

  /** Moves what is looked at, and how far from, without turning. */
  fit(center: Vector3, radius: number): void {
    const away = this.camera.position.clone().sub(this.controls.target);
    this.fitted = { center: center.clone(), radius };
    this.place(away.lengthSq() > 0 ? away : VIEWS.iso);
  }

  look(view: ViewName): void {
    this.place(VIEWS[view]);
  }

  /** Looks from a direction; from none that is no direction. */
  lookFrom(direction: Vector3): void {
    if (direction.toArray().every(Number.isFinite) && direction.lengthSq() > 0) this.place(direction);
  }

  /** What is drawn now, a PNG. */
  picture(): Promise<Blob> {
    // The drawing buffer is empty again once the browser has shown it.
    this.renderer.render(this.scene, this.camera);
    return new Promise((done, fail) => this.renderer.domElement.toBlob(
      (blob) => { if (blob) done(blob); else fail(new Error("the browser makes no picture")); }, "image/png"));
  }

  /** What is drawn from now on. */
  stream(framesPerSecond: number): MediaStream {
    return this.renderer.domElement.captureStream(framesPerSecond);
  }

  /** Calls when the scene was turned, moved or scaled. */
  onTurn(listener: () => void): void {
    this.controls.addEventListener("change", listener);
  }

  /** Looks at this scene as another one is looked at, each in its own size. */
  lookAs(other: Viewport): void {
    const scale = this.fitted.radius / other.fitted.radius;
    const { target } = other.controls;
    this.controls.target.copy(target).sub(other.fitted.center).multiplyScalar(scale).add(this.fitted.center);
    const away = other.camera.position.clone().sub(target).multiplyScalar(scale);
    this.camera.position.copy(this.controls.target).add(away);
    this.controls.update();
    this.requestDraw();
  }

  /** Unit vector to the camera from what it looks at. */
  direction(): Vector3 {
    return this.camera.position.clone().sub(this.controls.target).normalize();
  }

  private place(direction: Vector3): void {
    const { center, radius } = this.fitted;
    const vertical = (this.camera.fov * Math.PI) / 360;
    const narrow = Math.min(1, this.camera.aspect);
    const distance = radius / Math.sin(Math.atan(Math.tan(vertical) * narrow));
    this.camera.position.copy(direction).setLength(distance).add(center);
    this.camera.near = distance / 100;
    this.camera.far = distance * 20;
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(center);
    this.controls.minDistance = radius / 10;
    this.controls.maxDistance = distance * 8;
    this.controls.update();
    this.requestDraw();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (width === 0 || height === 0) return;
    const wasNarrow = Math.min(1, this.camera.aspect);
    this.resolution.set(width, height);
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    // A narrower window shows the same width of the scene as before.
    const away = this.camera.position.sub(this.controls.target);
    away.multiplyScalar(wasNarrow / Math.min(1, this.camera.aspect)).add(this.controls.target);
    this.controls.update();
    this.requestDraw();
  }

  private paint(): void {
    this.scene.background = new Color(color("scene"));
    this.requestDraw();
  }
}
