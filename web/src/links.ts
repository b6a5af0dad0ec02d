// A machine as its file describes it: where each link stands, given what the axes read. The same as src/machine/links.hpp.

import { BufferAttribute, BufferGeometry, Matrix4, Vector3 } from "three";

export interface MachineAxis {
  name: string;
  rotary: boolean;
  minimum: number;
  maximum: number;
  modulo: boolean;
  /** Where tools are changed. */
  home: number;
}

/** Shifts along `direction`, or turns about the line through `point`; at 0 of all axes, base frame. */
export interface Element {
  axis: number | null;
  direction: number[];
  point: number[];
}

export type Chain = "table" | "spindle";

export interface Link {
  chain: Chain;
  /** How many elements of the chain lie between the bed and it; 0 is the bed. */
  elements: number;
}

/** Typed arrays are base64. */
export interface Body extends Link {
  name: string;
  pose: number[];
  positions: string;
  normals: string;
  triangles: string;
  edges: string;
}

export interface Machine {
  name: string;
  /** In pictures; an axis of the base frame. */
  up: number[];
  axes: MachineAxis[];
  table: Element[];
  spindle: Element[];
  bodies: Body[];
}

export const tableLink = (machine: Machine): Link => ({ chain: "table", elements: machine.table.length });
export const headLink = (machine: Machine): Link => ({ chain: "spindle", elements: machine.spindle.length });

const vector = (values: number[]) => new Vector3().fromArray(values);

function elementPose(machine: Machine, element: Element, q: ArrayLike<number>): Matrix4 {
  const point = vector(element.point);
  if (element.axis === null) return new Matrix4().setPosition(point);
  const position = q[element.axis];
  if (!machine.axes[element.axis].rotary) return new Matrix4().setPosition(vector(element.direction).multiplyScalar(position));
  const turn = new Matrix4().makeRotationAxis(vector(element.direction).normalize(), (position * Math.PI) / 180);
  return new Matrix4().setPosition(point).multiply(turn).multiply(new Matrix4().setPosition(point.negate()));
}

/** Base from link. */
export function linkPose(machine: Machine, link: Link, q: ArrayLike<number>): Matrix4 {
  const pose = new Matrix4();
  for (const element of machine[link.chain].slice(0, link.elements)) pose.multiply(elementPose(machine, element, q));
  return pose;
}

/** What is between the bed and it, the bed first: "bed", "Y", "X". */
export const chainNames = (machine: Machine, chain: Chain): string[] => [
  "bed",
  ...machine[chain].map(({ axis }) => (axis === null ? "offset" : machine.axes[axis].name)),
];

/** The element that an axis moves, and where it is; null if it moves nothing. */
export function elementOf(machine: Machine, axis: number): { chain: Chain; place: number; element: Element } | null {
  for (const chain of ["table", "spindle"] as const) {
    const place = machine[chain].findIndex((element) => element.axis === axis);
    if (place >= 0) return { chain, place, element: machine[chain][place] };
  }
  return null;
}

function bytes(base64: string): ArrayBuffer {
  const text = atob(base64);
  const array = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) array[i] = text.charCodeAt(i);
  return array.buffer;
}

export const packedFloats = (base64: string) => new Float32Array(bytes(base64));

/** The triangles of a body and its edges. */
export function bodyGeometry(body: Omit<Body, keyof Link>): { surface: BufferGeometry; edges: BufferGeometry } {
  const attribute = (base64: string) => new BufferAttribute(packedFloats(base64), 3);
  const surface = new BufferGeometry();
  surface.setAttribute("position", attribute(body.positions));
  surface.setIndex(new BufferAttribute(new Uint32Array(bytes(body.triangles)), 1));
  if (body.normals) surface.setAttribute("normal", attribute(body.normals));
  else surface.computeVertexNormals();
  const edges = new BufferGeometry();
  edges.setAttribute("position", attribute(body.edges));
  return { surface, edges };
}
