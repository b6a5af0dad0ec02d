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
  /* Only of a touch, not of a miss. */
  ballCentre?: Triple;
  surface?: Triple;
  axes?: Record<string, number | null>;
  time: number | null;
}

export interface ResultValue {
  name: string;
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

export interface Cycle {
  name: string;
  title: string;
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

export interface Results {
  run: {
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

export interface Scene {
  meshes: SceneMesh[];
  tools: SceneTool[];
  /* tools: pairs of a point and the tool in the spindle from there on; -1 is a touch probe, or none. */
  path: { points: Float32Array; kinds: Uint8Array; seconds: Float32Array; toolAxes: Float32Array; tools: Int32Array };
  /* axes: from the ball or the tool's end to the spindle; empty: always Z. */
  touches: { indices: Uint32Array; centres: Float32Array; surfaces: Float32Array; tools: Int32Array; axes: Float32Array };
  collisions: Collision[];
  camera: CameraShot[];
  /** The machine around the part; null: its bodies are not known. */
  machine: Replay | null;
  ballRadius: number;
  workpiece: number[] | null;
}

export interface Report {
  results: Results;
  programs: ProgramText[];
  scene: Scene;
}

/* The layout of the JSON inside the page; arrays are base64. */
interface PackedScene {
  meshes: (Omit<SceneMesh, "positions" | "normals" | "triangles" | "edges"> &
    Record<"positions" | "normals" | "triangles" | "edges", string>)[];
  tools: ({ name: string } & Record<"positions" | "normals" | "triangles" | "edges", string>)[];
  path: Record<"points" | "kinds" | "seconds" | "toolAxes" | "tools", string>;
  touches: Record<"indices" | "centres" | "surfaces" | "tools" | "axes", string>;
  collisions: Collision[];
  camera: CameraShot[];
  /** The machine around the part; null: its bodies are not known. */
  machine: Replay | null;
  ballRadius: number;
  workpiece: number[] | null;
}

function bytes(base64: string): ArrayBuffer {
  const text = atob(base64);
  const array = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) array[i] = text.charCodeAt(i);
  return array.buffer;
}

const floats = (text: string) => new Float32Array(bytes(text));
const unsigned = (text: string) => new Uint32Array(bytes(text));
const integers = (text: string) => new Int32Array(bytes(text));

export function readReport(): Report {
  const packed = JSON.parse(document.getElementById("report-data")!.textContent!) as {
    results: Results;
    programs: ProgramText[];
    scene: PackedScene;
  };
  const { meshes, tools, path, touches, collisions, camera, machine, ballRadius, workpiece } = packed.scene;
  return {
    results: packed.results,
    programs: packed.programs,
    scene: {
      meshes: meshes.map((mesh) => ({
        name: mesh.name,
        role: mesh.role,
        pose: mesh.pose,
        positions: floats(mesh.positions),
        normals: new Int8Array(bytes(mesh.normals)),
        triangles: unsigned(mesh.triangles),
        edges: floats(mesh.edges),
      })),
      tools: tools.map((tool) => ({
        name: tool.name,
        positions: floats(tool.positions),
        normals: new Int8Array(bytes(tool.normals)),
        triangles: unsigned(tool.triangles),
        edges: floats(tool.edges),
      })),
      path: {
        points: floats(path.points),
        kinds: new Uint8Array(bytes(path.kinds)),
        seconds: floats(path.seconds),
        toolAxes: floats(path.toolAxes),
        tools: integers(path.tools),
      },
      touches: {
        indices: unsigned(touches.indices),
        centres: floats(touches.centres),
        surfaces: floats(touches.surfaces),
        tools: integers(touches.tools),
        axes: floats(touches.axes),
      },
      collisions,
      camera,
      machine,
      ballRadius,
      workpiece,
    },
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
