// What is drawn over the part on request: deviations as arrows, and where the truth says that a feature is.

import { BufferGeometry, Color, ConeGeometry, DoubleSide, Group, Matrix4, Mesh, MeshBasicMaterial, Quaternion, TorusGeometry, PlaneGeometry, SphereGeometry, Vector3 } from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";

import { type Ghost, type Report, touchDeviation, type Triple } from "./data";
import type { Marker, Palette } from "./scene";

const vector = (triple: Triple): Vector3 => new Vector3(...(triple.map((x) => x ?? 0) as [number, number, number]));

function dispose(group: Group) {
  group.traverse((object) => {
    const { geometry, material } = object as Mesh<BufferGeometry>;
    geometry?.dispose();
    if (Array.isArray(material)) material.forEach((each) => each.dispose());
    else material?.dispose();
  });
  group.clear();
}

/** The colour of a deviation, as a share of the greatest: more of it the greater it is. */
export function deviationColour(palette: Palette, share: number): Color {
  const pale = new Color(palette.part);
  return pale.lerp(new Color(share < 0 ? palette.feed : palette.measure), 0.3 + 0.7 * Math.min(1, Math.abs(share)));
}

/** How far a touch lies off its target, drawn along the surface's normal, many times magnified. */
export class DeviationArrows {
  readonly group = new Group();
  magnification = 100;
  on = false;
  /** The greatest deviation of those that were drawn last, mm. */
  most = 0;
  private cycle: number | null = null;

  constructor(
    private readonly report: Report,
    private readonly markers: Marker[],
  ) {}

  /** Of a selected cycle its arrows, else those of all. */
  show(cycle: number | null) {
    this.cycle = cycle;
  }

  /** Where each arrow ends and what it says, for labels. */
  draw(palette: Palette, size: number): { at: Vector3; deviation: number }[] {
    dispose(this.group);
    if (!this.on) return [];
    const positions: number[] = [];
    const colours: number[] = [];
    const ends: { at: Vector3; deviation: number }[] = [];
    const heads = new Group();
    const deviationOf = (marker: Marker) => {
      const touch = this.report.results.cycles[marker.cycle]?.touches[marker.touch];
      return touch && touchDeviation(touch);
    };
    const drawn = this.markers.filter(({ cycle }) => this.cycle === null || cycle === this.cycle);
    this.most = drawn.reduce((most, marker) => Math.max(most, Math.abs(deviationOf(marker) ?? 0)), 1e-6);
    for (const marker of drawn) {
      const deviation = deviationOf(marker);
      if (deviation == null || marker.centre.distanceTo(marker.surface) < 1e-6) continue;
      const outwards = marker.centre.clone().sub(marker.surface).normalize();
      const end = marker.surface.clone().addScaledVector(outwards, deviation * this.magnification);
      positions.push(...marker.surface.toArray(), ...end.toArray());
      const colour = deviationColour(palette, deviation / this.most);
      colours.push(colour.r, colour.g, colour.b, colour.r, colour.g, colour.b);
      const length = Math.abs(deviation) * this.magnification;
      const head = new Mesh(new ConeGeometry(0.35, 1, 12), new MeshBasicMaterial({ color: colour, depthTest: false, transparent: true }));
      const headSize = Math.min(length * 0.5, size * 0.045);
      head.scale.setScalar(headSize);
      const along = outwards.multiplyScalar(Math.sign(deviation) || 1);
      head.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), along);
      head.position.copy(end).addScaledVector(along, -headSize / 2);
      head.renderOrder = 7;
      heads.add(head);
      ends.push({ at: end, deviation });
    }
    if (positions.length === 0) return ends;
    const geometry = new LineSegmentsGeometry().setPositions(positions).setColors(colours);
    const lines = new LineSegments2(geometry, new LineMaterial({ linewidth: 3, vertexColors: true, depthTest: false, transparent: true }));
    lines.renderOrder = 6;
    this.group.add(lines, heads);
    return ends;
  }
}

/** A shape where the program expected a feature, or where it truly is. */
export function ghostOf(ghost: Ghost, colour: string, size: number): Group {
  const group = new Group();
  if (ghost.shape === "outline" && ghost.outline) {
    const geometry = new LineSegmentsGeometry().setPositions(ghost.outline.slice(1).flatMap((point, i) => [...vector(ghost.outline![i]).toArray(), ...vector(point).toArray()]));
    const lines = new LineSegments2(geometry, new LineMaterial({ color: colour, linewidth: 4, depthTest: false, transparent: true, opacity: 0.8 }));
    lines.renderOrder = 6;
    group.add(lines);
    return group;
  }
  const material = new MeshBasicMaterial({ color: colour, transparent: true, opacity: 0.55, side: DoubleSide, depthTest: false });
  const turned = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), ghost.normal ? vector(ghost.normal).normalize() : new Vector3(0, 0, 1));
  const add = (geometry: BufferGeometry) => {
    const mesh = new Mesh(geometry, material);
    mesh.renderOrder = 6;
    group.add(mesh);
  };
  const radius = (ghost.diameter ?? 0) / 2;
  if (ghost.shape === "circle" && radius > 0) add(new TorusGeometry(radius, Math.max(radius * 0.025, size * 0.004), 8, 96));
  else if (ghost.shape === "plane") add(new PlaneGeometry(size * 0.3, size * 0.3));
  else add(new SphereGeometry(size * 0.015, 16, 12));
  group.applyMatrix4(new Matrix4().compose(vector(ghost.at), turned, new Vector3(1, 1, 1)));
  return group;
}
