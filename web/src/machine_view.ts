// A machine in three dimensions: its bodies on their links, and arrows that say which way plus is.

import {
  AmbientLight,
  Box3,
  BoxGeometry,
  BufferGeometry,
  ConeGeometry,
  CylinderGeometry,
  DirectionalLight,
  DoubleSide,
  EdgesGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Material,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  Object3D,
  OrthographicCamera,
  Quaternion,
  Scene,
  SphereGeometry,
  TorusGeometry,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

import { h } from "./dom";
import { bodyGeometry, elementOf, headLink, type Link, linkPose, type Machine, tableLink } from "./links";

/** mm; of the tool that is drawn. */
export const toolLength = 100;

/** Where one looks from: as at a vertical mill, a horizontal one (Y up), a lathe (X up, Z to the right). */
function looksOf(up: Vector3): Record<string, Vector3> {
  const front = up.x > 0.5 ? new Vector3(0, 1, 0) : up.y > 0.5 ? new Vector3(0, 0, 1) : new Vector3(0, -1, 0);
  const right = up.clone().cross(front);
  const from = (x: number, y: number, z: number) =>
    new Vector3().addScaledVector(right, x).addScaledVector(front, y).addScaledVector(up, z).normalize();
  const iso = up.x > 0.5 ? from(0.5, 0.85, 0.45) : up.y > 0.5 ? from(0.9, 0.45, 0.5) : from(-0.55, 0.85, 0.6);
  return { Iso: iso, Front: front, Right: right, Top: from(0, 1e-4, 1) };
}
const triadColours = ["#d1242f", "#1f9d4d", "#2f6feb"];

/** What each link looks like: the bed grey, what carries the workpiece blue, what carries the tool brown. */
function shade(link: Link, count: number): [string, number] {
  if (link.elements === 0) return ["fixture", 0];
  return [link.chain === "table" ? "part" : "artefact", (0.28 * (link.elements - 1)) / Math.max(1, count - 1)];
}

export class MachineView {
  readonly element: HTMLElement = h("div", { class: "stage" });
  private readonly labels = h("div", { class: "labels" });
  private readonly scene = new Scene();
  private readonly camera = new OrthographicCamera(-1, 1, 1, -1, 0.1, 1000);
  private readonly links: { link: Link; group: Group }[] = [];
  private readonly arrows: Object3D[] = [];
  private readonly frames: Object3D[] = [];
  private readonly bodyMaterials: { material: MeshStandardMaterial; tint: [string, number] }[] = [];
  private readonly edgeMaterials: LineBasicMaterial[] = [];
  private readonly arrowMaterials: { material: MeshBasicMaterial; colour: string }[] = [];
  private readonly names: { at: Object3D; label: HTMLElement; of: Object3D[] }[] = [];
  private renderer: WebGLRenderer | null = null;
  private controls: OrbitControls | null = null;
  private scheduled = false;
  private look_ = "Iso";
  private readonly size: number;
  private readonly up: Vector3;

  constructor(private readonly machine: Machine) {
    this.up = new Vector3().fromArray(machine.up);
    const home = machine.axes.map(({ home }) => home);
    for (const chain of ["table", "spindle"] as const)
      for (let elements = chain === "table" ? 0 : 1; elements <= machine[chain].length; ++elements) this.addLink({ chain, elements });
    for (const body of machine.bodies) this.addBody(body, bodyGeometry(body), new Matrix4().fromArray(body.pose));
    if (!machine.bodies.some(({ chain, elements }) => this.group({ chain, elements }) === this.group(tableLink(machine)))) this.addPlate();
    this.move(home);
    const bounds = this.bounds();
    this.size = Math.max(50, 0.5 * bounds.getSize(new Vector3()).length());
    this.addTool();
    machine.axes.forEach((_, axis) => this.addArrow(axis));
    this.addFrame(this.scene, new Vector3(), "base", 0.1);
    this.addFrame(this.group(tableLink(machine)), new Vector3(), "table", 0.075);
    this.addFrame(this.group(headLink(machine)), new Vector3(0, 0, -toolLength), "tool", 0.06);

    const key = new DirectionalLight("#ffffff", 1.7);
    key.position.set(0.5, 0.9, 0.9);
    const rim = new DirectionalLight("#dbe6ff", 0.9);
    rim.position.set(-0.8, -0.2, 0.4);
    this.camera.add(key, rim);
    this.scene.add(this.camera, new AmbientLight("#ffffff", 1.25));
    new ResizeObserver(() => this.resize()).observe(this.element);
    // What is drawn, in numbers: base from link of each, column by column.
    Object.assign(window, { probewrightLinks: () => this.links.map(({ link, group }) => ({ ...link, pose: group.matrixWorld.toArray() })) });
  }

  /** The axes read that. */
  move(q: ArrayLike<number>) {
    for (const { link, group } of this.links) group.matrix.copy(linkPose(this.machine, link, q));
    this.scene.updateMatrixWorld(true);
    this.draw();
  }

  private addLink(link: Link) {
    const group = new Group();
    group.matrixAutoUpdate = false;
    this.links.push({ link, group });
    this.scene.add(group);
  }

  private group({ chain, elements }: Link): Group {
    const found = this.links.find(({ link }) => link.elements === elements && (elements === 0 || link.chain === chain));
    return found!.group;
  }

  private bounds(): Box3 {
    const box = new Box3();
    for (const { group } of this.links) box.expandByObject(group);
    return box;
  }

  private addBody(link: Link, { surface, edges }: { surface: BufferGeometry; edges: BufferGeometry }, pose: Matrix4) {
    const material = new MeshStandardMaterial({
      metalness: 0.08,
      roughness: 0.62,
      side: DoubleSide,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
    this.bodyMaterials.push({ material, tint: shade(link, this.machine[link.chain].length) });
    const lines = new LineBasicMaterial({ transparent: true, opacity: 0.6 });
    this.edgeMaterials.push(lines);
    const body = new Group();
    body.add(new Mesh(surface, material), new LineSegments(edges, lines));
    body.applyMatrix4(pose);
    this.group(link).add(body);
  }

  /** A machine file without a table: a plate where the tool reaches down to, so that something is seen to move. */
  private addPlate() {
    const travel = (letter: string) => this.machine.axes.find(({ name, rotary }) => name === letter && !rotary);
    const [x, y, z] = ["X", "Y", "Z"].map(travel);
    const span = (axis: ReturnType<typeof travel>) => (axis ? Math.min(axis.maximum - axis.minimum, 5000) : 200);
    const middle = (axis: ReturnType<typeof travel>) => (axis ? (axis.minimum + axis.maximum) / 2 : 0);
    const surface = new BoxGeometry(span(x), span(y), 0.04 * span(x));
    const lowest = (z ? z.minimum : 0) - toolLength - 0.02 * span(x);
    this.addBody(tableLink(this.machine), { surface, edges: new EdgesGeometry(surface) }, new Matrix4().setPosition(middle(x), middle(y), lowest));
  }

  private addTool() {
    const steel = new MeshStandardMaterial({ color: "#9aa2ad", metalness: 0.3, roughness: 0.4 });
    const tip = new MeshStandardMaterial({ color: "#b3261e", roughness: 0.35 });
    const radius = Math.max(4, this.size / 120);
    const shank = new Mesh(new CylinderGeometry(radius, radius, toolLength - radius, 24), steel);
    shank.rotateX(Math.PI / 2).position.set(0, 0, -(toolLength - radius) / 2);
    const ball = new Mesh(new SphereGeometry(radius, 24, 16), tip);
    ball.position.set(0, 0, radius - toolLength);
    this.group(headLink(this.machine)).add(shank, ball);
  }

  private overlay(colour: string): MeshBasicMaterial {
    const material = new MeshBasicMaterial({ color: colour, depthTest: false, transparent: true, opacity: 0.92 });
    return material;
  }

  private name(at: Object3D, text: string, kind: string, of: Object3D[]) {
    const label = h("span", { class: `axis-name ${kind}` }, h("b", {}, text));
    this.labels.append(label);
    this.names.push({ at, label, of });
  }

  /** A straight arrow from the origin along Z. */
  private straight(length: number, width: number, material: Material): Group {
    const group = new Group();
    const shaft = new Mesh(new CylinderGeometry(width, width, 0.8 * length, 16), material);
    shaft.rotateX(Math.PI / 2).position.set(0, 0, 0.4 * length);
    const head = new Mesh(new ConeGeometry(3 * width, 0.2 * length, 20), material);
    head.rotateX(Math.PI / 2).position.set(0, 0, 0.9 * length);
    group.add(shaft, head);
    for (const mesh of [shaft, head]) mesh.renderOrder = 10;
    return group;
  }

  /** An arc of 270 degrees about Z, right-handed, with its arrow head at the end. */
  private arc(radius: number, width: number, material: Material): Group {
    const group = new Group();
    const ring = new Mesh(new TorusGeometry(radius, width, 12, 72, 1.5 * Math.PI), material);
    const head = new Mesh(new ConeGeometry(3 * width, 8 * width, 20), material);
    // At 270 degrees it goes towards +X.
    head.position.set(4 * width, -radius, 0);
    head.rotateZ(-Math.PI / 2);
    group.add(ring, head);
    for (const mesh of [ring, head]) mesh.renderOrder = 10;
    return group;
  }

  private addArrow(axis: number) {
    const found = elementOf(this.machine, axis);
    if (!found) return;
    const { chain, place, element } = found;
    const { name, rotary } = this.machine.axes[axis];
    const colour = rotary ? "measure" : "feed";
    const material = this.overlay("#888888");
    this.arrowMaterials.push({ material, colour });
    const direction = new Vector3().fromArray(element.direction).normalize();
    const width = this.size / 170;
    const arrow = rotary ? this.arc(0.17 * this.size, width, material) : this.straight(0.3 * this.size, width, material);
    const start = this.reference(chain);
    if (rotary) {
      const point = new Vector3().fromArray(element.point);
      const along = start.clone().sub(point).dot(direction);
      start.copy(point).addScaledVector(direction, along);
      // About an upright axis over the table, about others beside it, where bodies do not hide them.
      const upright = Math.abs(direction.dot(this.up)) > 0.7 || this.up.x > 0.5;
      const offset = chain === "spindle" ? 0.12 : upright ? 0.04 : -0.3;
      start.addScaledVector(direction, offset * this.size * Math.sign(direction.x + direction.y + direction.z));
    }
    arrow.applyQuaternion(new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), direction));
    arrow.position.copy(start);
    // What it moves goes along, but what turns goes about an axis that stands still.
    this.group({ chain, elements: rotary ? place : place + 1 }).add(arrow);
    this.arrows.push(arrow);
    const end = new Object3D();
    end.position.set(rotary ? 0.17 * this.size : 0, 0, rotary ? 0 : 0.34 * this.size);
    arrow.add(end);
    this.name(end, `${name}${chain === "table" ? "\u2032" : ""}+`, rotary ? "rotary" : "linear", this.arrows);
  }

  /** Where the arrows of a chain begin, base frame at zero of all axes: beside the nose, on a corner of the table. */
  private reference(chain: "table" | "spindle"): Vector3 {
    if (chain === "spindle") return new Vector3(0, 0, 0.12 * this.size);
    const group = this.group(tableLink(this.machine));
    const box = new Box3().setFromObject(group).applyMatrix4(group.matrixWorld.clone().invert());
    if (box.isEmpty()) return new Vector3(0, 0, -0.3 * this.size);
    const middle = box.getCenter(new Vector3());
    // The middle of its upper face.
    return middle.addScaledVector(this.up, 0.5 * box.getSize(new Vector3()).dot(this.up));
  }

  private addFrame(parent: Object3D, at: Vector3, name: string, length: number) {
    const triad = new Group();
    const turns = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];
    turns.forEach((direction, i) => {
      const arrow = this.straight(length * this.size, this.size / 320, this.overlay(triadColours[i]));
      arrow.applyQuaternion(new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), direction));
      triad.add(arrow);
    });
    triad.position.copy(at);
    parent.add(triad);
    this.frames.push(triad);
    this.name(triad, name, `frame ${name}`, this.frames);
  }

  showArrows(on: boolean) {
    for (const arrow of this.arrows) arrow.visible = on;
    this.draw();
  }

  showFrames(on: boolean) {
    for (const frame of this.frames) frame.visible = on;
    this.draw();
  }

  showXray(on: boolean) {
    for (const { material } of this.bodyMaterials) {
      material.transparent = on;
      material.opacity = on ? 0.3 : 1;
      material.depthWrite = !on;
      material.needsUpdate = true;
    }
    this.draw();
  }

  /** Takes the page's colours anew. */
  colour() {
    const style = getComputedStyle(document.documentElement);
    const colour = (name: string) => style.getPropertyValue(`--${name}`).trim();
    for (const { material, tint } of this.bodyMaterials) {
      material.color.set(colour(tint[0]));
      material.color.lerp(material.color.clone().set("#ffffff"), tint[1]);
    }
    for (const material of this.edgeMaterials) material.color.set(colour("edge"));
    for (const { material, colour: name } of this.arrowMaterials) material.color.set(colour(name));
    this.draw();
  }

  look(name: string) {
    this.look_ = name;
    if (!this.controls) return;
    const bounds = this.bounds();
    const centre = bounds.getCenter(new Vector3());
    const reach = 0.5 * bounds.getSize(new Vector3()).length() + this.size;
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(looksOf(this.up)[name], 10 * reach);
    this.camera.near = reach;
    this.camera.far = 30 * reach;
    this.camera.lookAt(centre);
    this.camera.updateMatrixWorld();
    const across = [0, 1].map((column) => {
      const along = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, column);
      const corners = [bounds.min.x, bounds.max.x].flatMap((x) =>
        [bounds.min.y, bounds.max.y].flatMap((y) => [bounds.min.z, bounds.max.z].map((z) => new Vector3(x, y, z).sub(centre).dot(along))),
      );
      return Math.max(...corners) - Math.min(...corners);
    });
    this.camera.zoom = Math.min((2 * this.camera.right) / (1.1 * across[0]), 2 / (1.1 * across[1]));
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  private resize() {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (width === 0 || height === 0) return;
    const first = !this.renderer;
    if (first && (this.element.childElementCount > 0 || !this.start())) return;
    this.renderer!.setSize(width, height);
    this.camera.right = width / height;
    this.camera.left = -this.camera.right;
    this.camera.updateProjectionMatrix();
    if (first) this.look(this.look_);
    this.render();
  }

  private start(): boolean {
    try {
      this.renderer = new WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
    } catch {
      this.element.append(h("p", { class: "quiet" }, "This browser shows no 3D graphics (WebGL is off)."));
      return false;
    }
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.element.append(this.renderer.domElement, this.labels);
    // It turns about what is up now.
    this.camera.up.copy(this.up);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.draw());
    return true;
  }

  private draw() {
    if (this.scheduled || !this.renderer) return;
    this.scheduled = true;
    requestAnimationFrame(() => {
      this.scheduled = false;
      this.render();
    });
  }

  private render() {
    this.renderer!.render(this.scene, this.camera);
    const at = new Vector3();
    for (const { at: object, label, of } of this.names) {
      label.hidden = !of[0]?.visible;
      at.setFromMatrixPosition(object.matrixWorld).project(this.camera);
      const x = ((at.x + 1) / 2) * this.element.clientWidth;
      const y = ((1 - at.y) / 2) * this.element.clientHeight;
      label.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    }
  }
}
