// The machine around the part: its bodies on their links, moved as the axes have moved on the path.

import { DoubleSide, Group, LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshStandardMaterial, type Object3D, Vector3 } from "three";

import type { Readings } from "./data";
import { type Body, bodyGeometry, headLink, type Link, linkPose, type Machine, tableLink } from "./links";

type Shape = Omit<Body, keyof Link>;

/** A machine whose axes move on the path; as src/reports/machine_scene.hpp. */
export interface Replay extends Machine {
  /** Touch probes, spindle frame. */
  probes: Shape[];
  /** Which of them is in the spindle from a point of the path on. */
  changes: [number, number][];
}

/** What stands still in the picture. */
export type Standing = "part" | "machine";

export class MachineLayer {
  /** Everything that the report draws, in the frame of the table. */
  readonly table = new Group();
  private readonly links: { link: Link; group: Group }[] = [];
  private readonly probes: Group[];
  private readonly bodies: { material: MeshStandardMaterial; link: Link }[] = [];
  private readonly edges: LineBasicMaterial[] = [];
  private place: [number, number, number] = [0, 0, 0];
  private standing: Standing = "part";
  private shown = false;

  /** Takes what is in the scene, which lies in the frame of the table, into a group that may move. */
  constructor(
    private readonly replay: Replay,
    private readonly axes: Readings[],
    private readonly scene: Object3D,
  ) {
    this.table.matrixAutoUpdate = false;
    this.table.add(...scene.children.filter((child) => !("isLight" in child)));
    scene.add(this.table);
    for (const chain of ["table", "spindle"] as const)
      for (let elements = chain === "table" ? 0 : 1; elements <= replay[chain].length; ++elements) {
        const group = new Group();
        group.matrixAutoUpdate = false;
        group.visible = false;
        this.links.push({ link: { chain, elements }, group });
        scene.add(group);
      }
    for (const body of replay.bodies) this.group(body).add(this.solid(body, body));
    this.probes = replay.probes.map((probe) => this.solid(probe, headLink(replay)));
    for (const probe of this.probes) this.group(headLink(replay)).add(probe);
    this.update();
    // What is drawn, in numbers: scene from link of each, column by column.
    Object.assign(window, { probewrightLinks: () => this.links.map(({ link, group }) => ({ ...link, pose: group.matrixWorld.toArray() })) });
  }

  private group({ chain, elements }: Link): Group {
    return this.links.find(({ link }) => link.elements === elements && (elements === 0 || link.chain === chain))!.group;
  }

  private solid(shape: Shape, link: Link): Group {
    const { surface, edges } = bodyGeometry(shape);
    // Bodies stand around what the reader wants to see: it shines through them.
    const material = new MeshStandardMaterial({ metalness: 0.08, roughness: 0.6, side: DoubleSide, transparent: true, opacity: 0.32, depthWrite: false });
    this.bodies.push({ material, link });
    const lines = new LineBasicMaterial({ transparent: true, opacity: 0.55 });
    this.edges.push(lines);
    const group = new Group();
    const mesh = new Mesh(surface, material);
    mesh.renderOrder = 6;
    group.add(mesh, new LineSegments(edges, lines));
    group.applyMatrix4(new Matrix4().fromArray(shape.pose));
    return group;
  }

  /** The axes where they were `part` of the way from one point of the path to another. */
  show(low: number, high: number, part: number) {
    this.place = [low, high, part];
    this.update();
  }

  /** What the axes read there. */
  get readings(): number[] {
    const [low, high, part] = this.place;
    return this.axes.map((values) => (typeof values === "number" ? values : values[low] + part * (values[high] - values[low])));
  }

  draw(on: boolean) {
    this.shown = on;
    this.update();
  }

  keep(standing: Standing) {
    this.standing = standing;
    this.update();
  }

  private update() {
    const q = this.readings;
    const table = linkPose(this.replay, tableLink(this.replay), q);
    // The scene is the table's frame, or with the machine standing still the base frame.
    const sceneFromBase = this.shown && this.standing === "machine" ? new Matrix4() : table.clone().invert();
    this.table.matrix.multiplyMatrices(sceneFromBase, table);
    for (const { link, group } of this.links) {
      group.visible = this.shown;
      group.matrix.multiplyMatrices(sceneFromBase, linkPose(this.replay, link, q));
    }
    let probe = -1;
    for (const [point, index] of this.replay.changes) if (point <= this.place[0]) probe = index;
    this.probes.forEach((group, i) => (group.visible = i === probe));
    this.scene.updateMatrixWorld(true);
  }

  /** Takes the page's colours: those of fixtures, parts and gauges. */
  colour(fixture: string, part: string, tool: string, edge: string) {
    for (const { material, link } of this.bodies) material.color.set(link.elements === 0 ? fixture : link.chain === "table" ? part : tool);
    for (const material of this.edges) material.color.set(edge);
  }

  /** The corners of boxes about all that is drawn now, to fill a view with. */
  corners(): Vector3[] {
    const corners: Vector3[] = [];
    for (const { group } of this.links) {
      group.updateMatrixWorld(true);
      group.traverse((child) => {
        if (!(child instanceof Mesh)) return;
        child.geometry.computeBoundingBox();
        const { min, max } = child.geometry.boundingBox!;
        for (const x of [min.x, max.x])
          for (const y of [min.y, max.y]) for (const z of [min.z, max.z]) corners.push(new Vector3(x, y, z).applyMatrix4(child.matrixWorld));
      });
    }
    return corners;
  }

  /** A place in the frame of the table as it stands in the scene. */
  onScene(point: Vector3): Vector3 {
    return point.clone().applyMatrix4(this.table.matrix);
  }
}
