// What the report holds: the results as in docs/results.schema.json, the program texts, and the scene in typed arrays.

import type { Replay } from "./machine";

export type Verdict = "none" | "good" | "rework" | "scrap";
export type Triple = [number | null, number | null, number | null];

export interface Place {
  file: string;
  line: number;
  column: number;
}

export interface Touch {
  outcome: string;
  target: Triple;
  direction: Triple;
  truth?: { surface: Triple; error: number | null; solid: string; shape?: string };
  /* Only of a touch, not of a miss. */
  ballCentre?: Triple;
  surface?: Triple;
  axes?: Record<string, number | null>;
  time: number | null;
}

export interface Characteristic {
  quantity: string;
  along?: string;
  item?: number;
  system?: "machine";
  label?: string;
}

export interface ResultValue {
  name: string;
  role: string;
  characteristic?: Characteristic;
  /** What the virtual machine knows. */
  truth?: { value: number | null; error: number | null; from: "face" | "points"; shape?: string };
  meaning: string;
  value: number | null;
  unit: string;
  /** Answers the question that the cycle was called for. */
  main: boolean;
  verdict: Verdict;
  nominal?: number | null;
  deviation?: number | null;
  lowerLimit?: number | null;
  upperLimit?: number | null;
  uncertainty?: number | null;
  /** False where first order is wrong by more than 5 %. */
  uncertaintyHolds?: boolean;
}

export interface Write {
  table: string;
  entry: string;
  before: string;
  after: string;
}

export interface Parameter {
  name: string;
  value: string;
  meaning: string;
  default: boolean;
}

/** A line, circle, plane or sphere through touches; see results.schema.json. */
export interface Fit {
  shape: "line" | "circle" | "plane" | "sphere";
  touches: number[];
  residuals: (number | null)[];
  formDeviation: number | null;
  degreesOfFreedom: number;
}

export interface Cycle {
  name: string;
  title: string;
  /** What the program calls the feature. */
  feature?: string;
  fits?: Fit[];
  place: Place;
  verdict: Verdict;
  alarm?: string;
  parameters: Parameter[];
  touches: Touch[];
  results: ResultValue[];
  writes: Write[];
  logFiles: string[];
  screens: string[];
  start: number | null;
  end: number | null;
  pathLength: number | null;
}

export interface RunEvent {
  kind: "message" | "alarm" | "stop" | "skipped" | "tool" | "warning";
  place: Place;
  code: string;
  text: string;
  time: number | null;
}

export interface Ghost {
  shape: "point" | "circle" | "plane" | "outline";
  at: Triple;
  normal?: Triple;
  diameter?: number | null;
  outline?: Triple[];
}

/** What the virtual machine knows of the run as a whole. */
export interface RunTruth {
  entries?: {
    kind: string;
    name: string;
    cycle?: number;
    values: { name: string; unit: string; value: number | null; truth: number | null; error: number | null }[];
    distance?: number | null;
    angle?: number | null;
  }[];
  diagnoses?: { cycle?: number; time: number | null; texts: string[]; expected?: Ghost; found?: Ghost }[];
  clearance?: {
    limit?: number;
    spans: { from: number; to: number; distance: number; orMore?: boolean; part?: string; solid?: string; cycle?: number }[];
  };
  travel?: { axis: string; unit: string; margin: number | null; position: number | null; time: number | null }[];
}

export type JobField = "part" | "drawing" | "order" | "serial" | "operator" | "company";

export interface Results {
  truth?: RunTruth;
  run: {
    job?: Partial<Record<JobField, string>>;
    programs: string[];
    language: string;
    control: string;
    machine: string;
    setup: string;
    part: { name: string; path: string };
    seed: number | null;
    version: string;
    startedAt?: string;
    exit: { code: number; state: string; text?: string };
  };
  verdict: Verdict;
  totals: { cycles: number; touches: number; failedTouches: number; pathLength: number | null; time: number | null };
  cycles: Cycle[];
  writes: Write[];
  events: RunEvent[];
  files: string[];
}

export interface ProgramText {
  pieces: { first: number; lines: string[] }[];
  lineCount: number;
}

export interface SceneMesh {
  name: string;
  role: "part" | "fixture" | "artefact";
  pose: number[];
  positions: Float32Array;
  normals: Int8Array;
  triangles: Uint32Array;
  edges: Float32Array;
}

/** Where the tool ran into something. */
export interface Collision {
  at: [number, number, number];
  what: string;
  solid: string;
}

/* A cutter: its end in the origin, its shank along Z. */
export interface SceneTool {
  name: string;
  positions: Float32Array;
  normals: Int8Array;
  triangles: Uint32Array;
  edges: Float32Array;
}

/** What a cycle saw with the camera; pictures are PNG files in base64, empty where there is none. */
export interface CameraShot {
  cycle: number;
  point: string;
  number: number;
  references: number;
  errors: number;
  reference: string;
  taken: string;
  evaluated: string;
}

/** What an axis reads at each point of the path; one number if it stands all the time. */
export type Readings = Float32Array | number;

export interface Scene {
  meshes: SceneMesh[];
  tools: SceneTool[];
  /* axes: of each axis of the machine; none: nobody knows.
     tools: pairs of a point and the tool in the spindle from there on; -1 is a touch probe, or none. */
  path: { points: Float32Array; kinds: Uint8Array; seconds: Float32Array; toolAxes: Float32Array; axes: Readings[]; tools: Int32Array };
  /* axes: from the ball or the tool's end to the spindle; empty: always Z. */
  touches: { indices: Uint32Array; centres: Float32Array; surfaces: Float32Array; tools: Int32Array; axes: Float32Array };
  collisions: Collision[];
  camera: CameraShot[];
  /** The machine around the part; null: its bodies are not known. */
  machine: Replay | null;
  ballRadius: number;
  /** The main spindle turns the workpiece. */
  lathe: boolean;
  workpiece: number[] | null;
}

/** Where the program stood, block after block. */
export interface Trace {
  files: string[];
  /* frame, column by column: positions of programs from places in the scene (follows "table"), or from the readings of X, Y and Z ("axes").
     diameter: the control shows positions in X as diameters. */
  states: { tool: string; preset: string; follows: "table" | "axes"; frame: number[]; diameter: boolean }[];
  axes: string[];
  seconds: Float32Array;
  /** Of each block its file, line and state. */
  places: Uint32Array;
  /** Of each block the position in program coordinates, and the readings of all axes: steps of 0.0001 mm or degrees. */
  positions: Int32Array;
  readings: Int32Array;
}

export interface Report {
  results: Results;
  programs: ProgramText[];
  scene: Scene;
  trace: Trace | null;
  /** The page begins in it. */
  language: string;
  /** What parameters mean, in the other languages. */
  words: Record<string, string[]>;
  /** What only the cycles of the run say, in the other languages. */
  phrases: Record<string, string[]>;
}

/* The layout of the JSON inside the page; arrays are base64. */
type Packed<T> = {
  [K in keyof T]: T[K] extends ArrayBufferView ? string : T[K] extends (infer E)[] ? Packed<E>[] : T[K] extends object ? Packed<T[K]> : T[K];
};

function bytes(base64: string): Uint8Array<ArrayBuffer> {
  const text = atob(base64);
  const array = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) array[i] = text.charCodeAt(i);
  return array;
}

const floats = (text: string) => new Float32Array(bytes(text).buffer);
const unsigned = (text: string) => new Uint32Array(bytes(text).buffer);
const integers = (text: string) => new Int32Array(bytes(text).buffer);

function body<T extends Packed<SceneTool>>(mesh: T) {
  return {
    positions: floats(mesh.positions as string),
    normals: new Int8Array(bytes(mesh.normals as string).buffer),
    triangles: unsigned(mesh.triangles as string),
    edges: floats(mesh.edges as string),
  };
}

function unpackScene(packed: Packed<Scene>): Scene {
  const { meshes, tools, path, touches, collisions, ballRadius, workpiece, ...rest } = packed;
  return {
    ...(rest as object),
    meshes: meshes.map((mesh) => ({ name: mesh.name, role: mesh.role, pose: mesh.pose as unknown as number[], ...body(mesh) })),
    tools: tools.map((tool) => ({ name: tool.name, ...body(tool) })),
    path: {
      points: floats(path.points as string),
      kinds: bytes(path.kinds as string),
      seconds: floats(path.seconds as string),
      toolAxes: floats(path.toolAxes as string),
      axes: (path.axes as (string | number)[]).map((values) => (typeof values === "number" ? values : floats(values))),
      tools: integers(path.tools as string),
    },
    touches: {
      indices: unsigned(touches.indices as string),
      centres: floats(touches.centres as string),
      surfaces: floats(touches.surfaces as string),
      tools: integers(touches.tools as string),
      axes: floats(touches.axes as string),
    },
    collisions: collisions as unknown as Collision[],
    ballRadius,
    workpiece: workpiece as unknown as number[] | null,
  } as Scene;
}

function unpackTrace(packed: Packed<Trace> | null): Trace | null {
  if (!packed) return null;
  return {
    files: packed.files as unknown as string[],
    states: packed.states as unknown as Trace["states"],
    axes: packed.axes as unknown as string[],
    seconds: floats(packed.seconds as unknown as string),
    places: unsigned(packed.places as unknown as string),
    positions: integers(packed.positions as unknown as string),
    readings: integers(packed.readings as unknown as string),
  };
}

/** Reading the chunks here is ten times as fast as through a Response. */
async function inflated(packed: Uint8Array<ArrayBuffer>): Promise<string> {
  const stream = new DecompressionStream("deflate");
  const writer = stream.writable.getWriter();
  const written = writer.write(packed).then(() => writer.close());
  const chunks: BlobPart[] = [];
  const reader = stream.readable.getReader();
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    chunks.push(value as Uint8Array<ArrayBuffer>);
  }
  await written;
  return new Blob(chunks).text();
}

/** The data of the page: JSON, compressed, as base64. */
export async function readReport(): Promise<Report> {
  const element = document.getElementById("report-data")!;
  const text = await inflated(bytes(element.textContent!));
  // The page holds it once more otherwise, as long as it is open.
  element.textContent = "";
  const data = JSON.parse(text);
  return {
    results: data.results,
    programs: data.programs,
    scene: unpackScene(data.scene),
    trace: unpackTrace(data.trace),
    language: data.language,
    words: data.words ?? {},
    phrases: data.phrases ?? {},
  };
}

/** How a touch lies against its target, outwards positive: material stands too far out. */
export function touchDeviation(touch: Touch): number | null {
  if (!touch.surface) return null;
  let sum = 0;
  for (let i = 0; i < 3; ++i) {
    const [surface, target, direction] = [touch.surface[i], touch.target[i], touch.direction[i]];
    if (surface == null || target == null || direction == null) return null;
    sum -= (surface - target) * direction;
  }
  return sum;
}
