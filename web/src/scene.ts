// The drawing: part, fixtures, path and touches as three.js objects. Knows nothing of the page around it.

import {
  AmbientLight,
  Box3,
  BufferAttribute,
  BufferGeometry,
  CanvasTexture,
  Color,
  CylinderGeometry,
  DirectionalLight,
  DoubleSide,
  Group,
  LineBasicMaterial,
  LineSegments,
  Matrix4,
  Mesh,
  MeshStandardMaterial,
  Object3D,
  Points,
  PointsMaterial,
  Quaternion,
  Scene as ThreeScene,
  Sphere,
  SphereGeometry,
  Vector3,
} from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";

import type { Report, Scene, SceneMesh, SceneTool } from "./data";
import { DeviationArrows, ghostOf } from "./overlays";
import { cycleState, type State } from "./verdict";

export interface Palette {
  background: string;
  part: string;
  fixture: string;
  artefact: string;
  edge: string;
  rapid: string;
  feed: string;
  measure: string;
  good: string;
  rework: string;
  scrap: string;
  alarm: string;
  none: string;
  selected: string;
}

/** More moves than these are drawn as thin lines. */
const mostWideMoves = 4000;

export const moveNames = ["rapid", "feed", "measure"] as const;

/** One touch as the view needs it. */
export interface Marker {
  cycle: number;
  touch: number;
  centre: Vector3;
  surface: Vector3;
  /** The cutter that touched, its end at the centre; -1: a touch probe's ball. */
  tool: number;
  /** From the ball or the tool's end to the spindle. */
  axis: Vector3;
}

export function markersOf(scene: Scene): Marker[] {
  const { indices, centres, surfaces, tools, axes } = scene.touches;
  return Array.from({ length: indices.length / 2 }, (_, i) => ({
    cycle: indices[2 * i],
    touch: indices[2 * i + 1],
    centre: new Vector3().fromArray(centres, 3 * i),
    surface: new Vector3().fromArray(surfaces, 3 * i),
    tool: tools[i] ?? -1,
    axis: axes.length > 3 * i + 2 ? new Vector3().fromArray(axes, 3 * i) : new Vector3(0, 0, 1),
  }));
}

/** How a tool lies whose shank points along `axis`: of a tool along X or Y the simulation says where its own X is. */
function toolOrientation(axis: Vector3): Quaternion {
  const along = axis.clone().normalize();
  const [x, y, z] = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];
  const frame = new Matrix4();
  if (along.distanceTo(x) < 1e-5) return new Quaternion().setFromRotationMatrix(frame.makeBasis(y, z, x));
  if (along.distanceTo(y) < 1e-5) return new Quaternion().setFromRotationMatrix(frame.makeBasis(z, x, y));
  return new Quaternion().setFromUnitVectors(z, along);
}

function meshGeometry(mesh: SceneMesh | SceneTool): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(mesh.positions, 3));
  geometry.setIndex(new BufferAttribute(mesh.triangles, 1));
  if (mesh.normals.length > 0) geometry.setAttribute("normal", new BufferAttribute(mesh.normals, 4, true));
  return geometry;
}

function cornersOf({ min, max }: Box3): Vector3[] {
  return [min.x, max.x].flatMap((x) => [min.y, max.y].flatMap((y) => [min.z, max.z].map((z) => new Vector3(x, y, z))));
}

function dotTexture(): CanvasTexture {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const context = canvas.getContext("2d")!;
  context.beginPath();
  context.arc(32, 32, 29, 0, 2 * Math.PI);
  context.fillStyle = "#fff";
  context.fill();
  context.lineWidth = 6;
  context.strokeStyle = "rgba(0, 0, 0, 0.55)";
  context.stroke();
  return new CanvasTexture(canvas);
}

function crossTexture(): CanvasTexture {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const context = canvas.getContext("2d")!;
  context.lineCap = "round";
  for (const [width, style] of [
    [18, "rgba(255, 255, 255, 0.9)"],
    [11, "#fff"],
  ] as const) {
    context.beginPath();
    context.moveTo(14, 14);
    context.lineTo(50, 50);
    context.moveTo(50, 14);
    context.lineTo(14, 50);
    context.lineWidth = width;
    context.strokeStyle = style;
    context.stroke();
  }
  return new CanvasTexture(canvas);
}

export class Drawing {
  readonly scene = new ThreeScene();
  readonly markers: Marker[];
  /** Around the part, every touch and collision, and whatever else was touched. */
  readonly sphere: Sphere;
  /** Around the part, the fixtures, the gauges and every touch. */
  readonly everything: Sphere;
  /** The corners of what stands in the first view, and of all there is: a view is filled by them. */
  readonly focusCorners: Vector3[];
  readonly allCorners: Vector3[];
  /** Where the names of the workpiece's axes stand. */
  readonly axisEnds: { name: string; at: Vector3 }[] = [];
  readonly deviations: DeviationArrows;
  /** Where a feature was expected, and where it is: centre and which of both. */
  readonly ghosts: { at: Vector3; kind: "expected" | "found" }[] = [];
  private readonly ghostGroup = new Group();
  private readonly solids = new Group();
  private readonly fixtures = new Group();
  private readonly path = new Group();
  private readonly touches = new Group();
  private readonly probe = new Group();
  private readonly ball = new Group();
  private readonly cutters: Group[];
  private readonly lights: Object3D[] = [];
  private readonly colours: Float32Array;
  private readonly solidMaterials: { material: MeshStandardMaterial; role: SceneMesh["role"] }[] = [];
  private readonly edgeMaterials: LineBasicMaterial[] = [];
  private readonly lineMaterials: { material: LineMaterial | LineBasicMaterial; kind: number }[] = [];
  private markerGeometry: BufferGeometry | null = null;
  private collisionMaterial: PointsMaterial | null = null;

  constructor(private readonly report: Report) {
    const { scene } = report;
    this.markers = markersOf(scene);
    this.colours = new Float32Array(3 * this.markers.length);

    const points = [
      ...this.markers.flatMap(({ centre, surface, tool }) => (tool < 0 ? [centre, surface] : [surface])),
      ...scene.collisions.map(({ at }) => new Vector3().fromArray(at)),
    ];
    const bounds = new Box3().setFromPoints(points);
    const focus = bounds.clone();
    this.focusCorners = [...points];
    this.allCorners = [...points];
    // Fixtures, gauges and the way to the tool changer may reach far beyond the part: only what was touched counts.
    for (const mesh of scene.meshes) {
      const box = this.addMesh(mesh);
      bounds.union(box);
      const reached = box.clone().expandByScalar(0.5);
      this.allCorners.push(...cornersOf(box));
      if (mesh.role !== "part" && !points.some((point) => reached.containsPoint(point))) continue;
      focus.union(box);
      this.focusCorners.push(...cornersOf(box));
    }
    if (focus.isEmpty()) focus.copy(bounds);
    if (focus.isEmpty()) for (let i = 0; i + 2 < scene.path.points.length; i += 3) focus.expandByPoint(new Vector3().fromArray(scene.path.points, i));
    if (focus.isEmpty()) focus.set(new Vector3(-50, -50, -50), new Vector3(50, 50, 50));
    if (this.focusCorners.length === 0) this.focusCorners = cornersOf(focus);
    if (this.allCorners.length === 0) this.allCorners = cornersOf(focus);
    this.sphere = focus.getBoundingSphere(new Sphere());
    this.sphere.radius = Math.max(this.sphere.radius, 1);
    this.everything = bounds.union(focus).getBoundingSphere(new Sphere());

    this.addPath();
    this.addMarkers();
    this.addCollisions();
    this.deviations = new DeviationArrows(report, this.markers);
    for (const { expected, found } of report.results.truth?.diagnoses ?? []) {
      for (const [ghost, kind] of [[expected, "expected"], [found, "found"]] as const)
        if (ghost) this.ghosts.push({ at: new Vector3().fromArray(ghost.at.map((x) => x ?? 0)), kind });
    }
    const ballRadius = scene.ballRadius > 0 ? scene.ballRadius : this.sphere.radius / 60;
    const ball = new Mesh(
      new SphereGeometry(ballRadius, 32, 20),
      new MeshStandardMaterial({ color: "#b3261e", roughness: 0.35, transparent: true, opacity: 0.85 }),
    );
    const length = 12 * ballRadius;
    const stem = new Mesh(
      new CylinderGeometry(0.4 * ballRadius, 0.4 * ballRadius, length, 20),
      new MeshStandardMaterial({ color: "#9aa2ad", roughness: 0.4, transparent: true, opacity: 0.6 }),
    );
    stem.rotateX(Math.PI / 2).position.set(0, 0, length / 2);
    // What stands inside the part shows through it a little.
    for (const mesh of [ball, stem]) {
      const material = mesh.material.clone();
      material.opacity = 0.28;
      material.depthTest = false;
      const ghost = new Mesh(mesh.geometry, material);
      ghost.applyMatrix4(mesh.matrix.compose(mesh.position, mesh.quaternion, mesh.scale));
      this.ball.add(ghost, mesh);
    }
    this.cutters = scene.tools.map((tool) => this.cutter(tool));
    this.probe.add(this.ball, ...this.cutters);
    this.probe.visible = false;
    if (scene.workpiece) this.addTriad(scene.workpiece);

    const key = new DirectionalLight("#ffffff", 1.7);
    key.position.set(0.5, 0.9, 0.9);
    const rim = new DirectionalLight("#dbe6ff", 0.9);
    rim.position.set(-0.8, -0.2, 0.4);
    this.lights.push(key, rim);
    this.scene.add(this.solids, this.fixtures, this.path, this.touches, this.probe, this.deviations.group, this.ghostGroup);
    this.scene.add(new AmbientLight("#ffffff", 1.25));
  }

  /** Lights that move with the camera. */
  get headlights(): Object3D[] {
    return this.lights;
  }

  private cutter(tool: SceneTool): Group {
    const group = new Group();
    const material = new MeshStandardMaterial({
      color: "#9aa2ad",
      metalness: 0.3,
      roughness: 0.4,
      side: DoubleSide,
      transparent: true,
      opacity: 0.72,
      depthWrite: false,
    });
    group.add(new Mesh(meshGeometry(tool), material));
    const edges = new BufferGeometry();
    edges.setAttribute("position", new BufferAttribute(tool.edges, 3));
    group.add(new LineSegments(edges, new LineBasicMaterial({ color: "#b3261e" })));
    return group;
  }

  private addMesh(mesh: SceneMesh): Box3 {
    const group = new Group();
    const material = new MeshStandardMaterial({
      metalness: 0.08,
      roughness: 0.62,
      flatShading: mesh.normals.length === 0,
      side: DoubleSide,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
    this.solidMaterials.push({ material, role: mesh.role });
    group.add(new Mesh(meshGeometry(mesh), material));
    if (mesh.edges.length > 0) {
      const edges = new BufferGeometry();
      edges.setAttribute("position", new BufferAttribute(mesh.edges, 3));
      const edgeMaterial = new LineBasicMaterial({ transparent: true });
      this.edgeMaterials.push(edgeMaterial);
      group.add(new LineSegments(edges, edgeMaterial));
    }
    group.applyMatrix4(new Matrix4().fromArray(mesh.pose));
    group.updateMatrixWorld(true);
    (mesh.role === "part" ? this.solids : this.fixtures).add(group);
    return new Box3().setFromObject(group);
  }

  private addPath() {
    const { points, kinds } = this.report.scene.path;
    const segments: number[][] = [[], [], []];
    for (let i = 0; i < kinds.length; ++i) {
      const list = segments[kinds[i]];
      if (!list) continue;
      for (let k = 3 * i; k < 3 * i + 6; ++k) list.push(points[k]);
    }
    // Wide lines of tens of thousands of moves hide the part, and are slow without a graphics card.
    const thin = kinds.length > mostWideMoves;
    segments.forEach((positions, kind) => {
      if (positions.length === 0) return;
      if (thin) this.addThinLines(positions, kind);
      else this.addWideLines(positions, kind);
    });
  }

  private addThinLines(positions: number[], kind: number) {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
    const material = new LineBasicMaterial({ transparent: true, opacity: kind === 0 ? 0.35 : 0.7 });
    this.lineMaterials.push({ material, kind });
    const lines = new LineSegments(geometry, material);
    lines.renderOrder = 2 + 0.1 * kind;
    this.path.add(lines);
  }

  private addWideLines(positions: number[], kind: number) {
    const geometry = new LineSegmentsGeometry().setPositions(positions);
    const dashed = kind === 0;
    // Once where it is seen, once faintly through the part.
    for (const faint of [false, true]) {
      const material = new LineMaterial({
        linewidth: kind === 2 ? 3 : 1.6,
        dashed,
        dashSize: this.sphere.radius / 45,
        gapSize: this.sphere.radius / 60,
        transparent: true,
        opacity: faint ? 0.16 : 1,
        depthTest: !faint,
        depthWrite: false,
      });
      this.lineMaterials.push({ material, kind });
      const lines = new LineSegments2(geometry, material);
      if (dashed) lines.computeLineDistances();
      lines.renderOrder = (faint ? 1 : 2) + 0.1 * kind;
      this.path.add(lines);
    }
  }

  private addMarkers() {
    if (this.markers.length === 0) return;
    const positions = new Float32Array(3 * this.markers.length);
    // A little off the surface, so that the dot is not cut by it.
    // The end of a cutter may be far from where its edge touched.
    this.markers.forEach(({ centre, surface, tool }, i) => surface.clone().lerp(centre, tool < 0 ? 0.35 : 0).toArray(positions, 3 * i));
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(positions, 3));
    geometry.setAttribute("color", new BufferAttribute(this.colours, 3));
    this.markerGeometry = geometry;
    const map = dotTexture();
    for (const faint of [true, false]) {
      const material = new PointsMaterial({
        size: (faint ? 9 : 13) * Math.min(window.devicePixelRatio, 2),
        sizeAttenuation: false,
        vertexColors: true,
        map,
        transparent: true,
        alphaTest: 0.05,
        opacity: faint ? 0.35 : 1,
        depthTest: !faint,
        depthWrite: false,
      });
      const points = new Points(geometry, material);
      points.renderOrder = faint ? 3 : 4;
      this.touches.add(points);
    }
  }

  /** Crosses that nothing hides; they say why the run ended where it did. */
  private addCollisions() {
    const { collisions } = this.report.scene;
    if (collisions.length === 0) return;
    const positions = new Float32Array(collisions.flatMap(({ at }) => at));
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(positions, 3));
    this.collisionMaterial = new PointsMaterial({
      size: 26 * Math.min(window.devicePixelRatio, 2),
      sizeAttenuation: false,
      map: crossTexture(),
      transparent: true,
      alphaTest: 0.05,
      depthTest: false,
      depthWrite: false,
    });
    const points = new Points(geometry, this.collisionMaterial);
    points.renderOrder = 5;
    this.scene.add(points);
  }

  private addTriad(pose: number[]) {
    const size = this.sphere.radius * 0.22;
    const triad = new Group();
    const sceneFromWorkpiece = new Matrix4().fromArray(pose);
    const axes: [string, string, Vector3][] = [
      ["X", "#d1242f", new Vector3(size, 0, 0)],
      ["Y", "#1f9d4d", new Vector3(0, size, 0)],
      ["Z", "#2f6feb", new Vector3(0, 0, size)],
    ];
    for (const [name, color, end] of axes) {
      const geometry = new LineSegmentsGeometry().setPositions([0, 0, 0, end.x, end.y, end.z]);
      const line = new LineSegments2(geometry, new LineMaterial({ color: new Color(color).getHex(), linewidth: 3, depthTest: false, transparent: true }));
      line.renderOrder = 2;
      triad.add(line);
      this.axisEnds.push({ name, at: end.clone().multiplyScalar(1.08).applyMatrix4(sceneFromWorkpiece) });
    }
    triad.applyMatrix4(sceneFromWorkpiece);
    this.scene.add(triad);
  }

  colour(palette: Palette) {
    this.scene.background = null;
    for (const { material, role } of this.solidMaterials) material.color.set(palette[role]);
    for (const material of this.edgeMaterials) material.color.set(palette.edge);
    for (const { material, kind } of this.lineMaterials) material.color.set(palette[moveNames[kind]]);
    this.collisionMaterial?.color.set(palette.alarm);
    const colour = new Color();
    this.markers.forEach((marker, i) => {
      colour.set(palette[this.stateOf(marker.cycle, marker.touch)]).toArray(this.colours, 3 * i);
    });
    if (this.markerGeometry) this.markerGeometry.attributes.color.needsUpdate = true;
    this.ghostGroup.clear();
    for (const { expected, found } of this.report.results.truth?.diagnoses ?? []) {
      if (expected) this.ghostGroup.add(ghostOf(expected, palette.rapid, this.sphere.radius));
      if (found) this.ghostGroup.add(ghostOf(found, palette.good, this.sphere.radius));
    }
  }

  /** What a touch is coloured by: an alarm if it was none. */
  stateOf(cycleIndex: number, touchIndex: number): State {
    const cycle = this.report.results.cycles[cycleIndex];
    const touch = cycle?.touches[touchIndex];
    return touch && touch.outcome !== "touched" ? "alarm" : cycle ? cycleState(cycle) : "none";
  }

  /** The corners of what a cycle touched, with room around it. */
  cornersOfCycle(cycle: number): Vector3[] {
    const box = new Box3();
    // Where it ended, too, and where what it looked for really is.
    for (const known of this.report.results.truth?.diagnoses ?? []) {
      if (known.cycle !== cycle) continue;
      for (const ghost of [known.expected, known.found]) if (ghost) box.expandByPoint(new Vector3().fromArray(ghost.at.map((x) => x ?? 0)));
    }
    for (const marker of this.markers) {
      if (marker.cycle !== cycle) continue;
      box.expandByPoint(marker.tool < 0 ? marker.centre : marker.surface);
      box.expandByPoint(marker.surface);
    }
    if (box.isEmpty()) return [];
    const size = box.getSize(new Vector3()).length();
    return cornersOf(box.expandByScalar(Math.max(0.35 * size, 0.12 * this.sphere.radius)));
  }

  showXray(on: boolean) {
    for (const { material } of this.solidMaterials) {
      material.transparent = on;
      material.opacity = on ? 0.3 : 1;
      material.depthWrite = !on;
      material.needsUpdate = true;
    }
  }

  showPath(on: boolean) {
    this.path.visible = on;
  }

  showTouches(on: boolean) {
    this.touches.visible = on;
  }

  showFixtures(on: boolean) {
    this.fixtures.visible = on;
  }

  get hasFixtures(): boolean {
    return this.fixtures.children.length > 0;
  }

  /** The probe with its ball's centre there, or a cutter with its end, the shank along `axis`; null hides it. */
  placeProbe(centre: Vector3 | null, axis = new Vector3(0, 0, 1), tool = -1) {
    this.probe.visible = centre !== null;
    if (!centre) return;
    this.ball.visible = tool < 0;
    this.cutters.forEach((cutter, i) => (cutter.visible = i === tool));
    this.probe.position.copy(centre);
    this.probe.quaternion.copy(toolOrientation(axis));
  }
}
