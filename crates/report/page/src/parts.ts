import {
  BoxGeometry, CanvasTexture, Color, CylinderGeometry, EdgesGeometry, Group, Mesh, MeshStandardMaterial,
  Quaternion, SphereGeometry, SRGBColorSpace, Sprite, SpriteMaterial, Vector3, type BufferGeometry, type Material,
} from "three";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { color, onThemeChange } from "./theme";

/** What a line looks like: a colour of the style sheet, CSS pixels, and opacity. */
export interface Stroke {
  color: string;
  width: number;
  opacity?: number;
}

/** Calls now and whenever the colour scheme changes. */
export function painted(paint: () => void): void {
  paint();
  onThemeChange(paint);
}

/** Separate straight pieces; `points` in pairs. */
export function segments(points: Vector3[], stroke: Stroke): LineSegments2 {
  const geometry = new LineSegmentsGeometry();
  if (points.length > 0) geometry.setPositions(points.flatMap((point) => point.toArray()));
  const opacity = stroke.opacity ?? 1;
  const material = new LineMaterial({
    linewidth: stroke.width, transparent: opacity < 1, opacity, depthWrite: opacity === 1,
  });
  painted(() => material.color.set(color(stroke.color)));
  return new LineSegments2(geometry, material);
}

/** One line through all points. */
export function polyline(points: Vector3[], stroke: Stroke): LineSegments2 {
  return segments(points.slice(1).flatMap((point, i) => [points[i], point]), stroke);
}

/** A surface in a colour of the style sheet. */
export function surface(paint: () => string, opacity = 1): MeshStandardMaterial {
  const material = new MeshStandardMaterial({
    roughness: 0.62, metalness: 0.08, transparent: opacity < 1, opacity, depthWrite: opacity === 1,
  });
  painted(() => material.color.set(new Color(paint())));
  return material;
}

const UP = new Vector3(0, 1, 0);

/** A cylinder that is put between two points again and again. */
export class Strut {
  readonly mesh: Mesh;

  constructor(radius: number, material: Material) {
    this.mesh = new Mesh(new CylinderGeometry(radius, radius, 1, 24), material);
  }

  between(start: Vector3, end: Vector3): void {
    const along = end.clone().sub(start);
    const length = along.length();
    this.mesh.visible = length > 0;
    if (length === 0) return;
    this.mesh.position.copy(start).addScaledVector(along, 0.5);
    this.mesh.scale.set(1, length, 1);
    this.mesh.quaternion.copy(new Quaternion().setFromUnitVectors(UP, along.divideScalar(length)));
  }
}

/** A capsule that is put between two points again and again; a sphere where they are the same. */
export class Capsule {
  readonly group = new Group();
  private readonly strut: Strut;
  private readonly ends: Mesh[];

  constructor(radius: number, material: Material) {
    this.strut = new Strut(radius, material);
    this.ends = [0, 1].map(() => new Mesh(new SphereGeometry(radius, 24, 16), material));
    this.group.add(this.strut.mesh, ...this.ends);
  }

  between(start: Vector3, end: Vector3): void {
    this.strut.between(start, end);
    [start, end].forEach((place, i) => this.ends[i].position.copy(place));
  }
}

/** The edges of a box about the origin. */
export function boxEdges(size: [number, number, number], stroke: Stroke): LineSegments2 {
  const edges: BufferGeometry = new EdgesGeometry(new BoxGeometry(...size));
  const position = edges.getAttribute("position");
  const points = Array.from({ length: position.count }, (_, i) =>
    new Vector3().fromBufferAttribute(position, i));
  return segments(points, stroke);
}

type Write = (text: string, height: number, x: number, y: number) => void;

/** Text that faces the reader, as large near as far; heights and places in parts of its own height. */
function written(aspect: number, name: string, text: (write: Write) => void): Sprite {
  const size = 64;
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [aspect * size, size];
  const material = new SpriteMaterial({ sizeAttenuation: false, depthTest: false });
  const sprite = new Sprite(material);
  sprite.scale.set(0.036 * aspect, 0.036, 1);
  sprite.renderOrder = 10;
  painted(() => {
    const context = canvas.getContext("2d");
    if (!context) return;
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.lineWidth = 7;
    context.lineJoin = "round";
    context.strokeStyle = color("scene");
    context.fillStyle = color(name);
    text((text, height, x, y) => {
      context.font = `600 ${height * size}px system-ui, sans-serif`;
      context.strokeText(text, x * size, y * size);
      context.fillText(text, x * size, y * size);
    });
    material.map?.dispose();
    material.map = new CanvasTexture(canvas);
    material.map.colorSpace = SRGBColorSpace;
    material.needsUpdate = true;
  });
  return sprite;
}

/** A letter with an index. */
export function label(letter: string, index: string, name: string): Sprite {
  return written(1, name, (write) => {
    write(letter, 0.6, 0.18, 0.64);
    write(index, 0.34, 0.56, 0.8);
  });
}

/** A few small characters that start where they are put, behind what is in front of them. */
export function caption(text: string, name: string): Sprite {
  const sprite = written(2, name, (write) => write(text, 0.32, 0.1, 0.62));
  sprite.center.set(0, 0.5);
  sprite.material.depthTest = true;
  return sprite;
}
