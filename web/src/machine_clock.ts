// What stood where at any time of the run: tip, tool, line, what the control showed. Knows nothing of the page.

import type { Report } from "./data";
import { packedFloats } from "./links";

type Point = [number, number, number];

/** What the control shows at a time. */
export interface Display {
  file: string;
  line: number;
  tool: string;
  preset: string;
  /** Of the tip in program coordinates. */
  position: Point;
  /** Readings of all axes, by their names. */
  axes: { name: string; value: number }[];
  /** mm/min along the path. */
  feed: number;
}

/** Where the tip is, the direction to the spindle, the tool (-1: a touch probe), and how far it has gone in which move. */
export interface PathPlace {
  tip: Point;
  axis: Point;
  tool: number;
  move: number;
  part: number;
}

/** The last of `times` that is not after `time`; 0 if all are. */
export function lastAt(times: Float32Array | number[], time: number): number {
  let [low, high] = [0, times.length];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return low;
}

/** What a tool change is among the kinds of moves. */
const jump = 3;

const mix = (a: number, b: number, part: number) => a + (b - a) * part;

export class MachineClock {
  readonly total: number;
  /** The times at which cycles begin and end, alarms and touches happen. */
  readonly touches: { time: number; cycle: number; touch: number }[];
  private readonly blockTimes: Float32Array;
  /** Readings of the axes at each point of the path, by name: one number if the axis stands. */
  private readonly readings = new Map<string, Float32Array | number>();

  constructor(private readonly report: Report) {
    const { seconds } = report.scene.path;
    this.total = seconds.length > 0 ? seconds[seconds.length - 1] : 0;
    this.touches = report.results.cycles
      .flatMap((cycle, index) => cycle.touches.map((touch, i) => ({ time: touch.time ?? NaN, cycle: index, touch: i })))
      .filter(({ time }) => Number.isFinite(time))
      .sort((a, b) => a.time - b.time);
    const { machine } = report.scene;
    machine?.axes.forEach(({ name }, i) => {
      const values = machine.positions[i];
      if (values !== undefined) this.readings.set(name, typeof values === "number" ? values : packedFloats(values));
    });
    this.blockTimes = report.trace?.seconds ?? new Float32Array();
  }

  get canReplay(): boolean {
    const { points, seconds } = this.report.scene.path;
    return seconds.length >= 2 && points.length >= 3 * seconds.length;
  }

  tipAt(time: number): PathPlace {
    const { points, kinds, seconds, toolAxes, tools } = this.report.scene.path;
    const low = Math.min(lastAt(seconds, time), Math.max(0, seconds.length - 2));
    const span = seconds[low + 1] - seconds[low];
    const along = span > 0 ? Math.min(1, Math.max(0, (time - seconds[low]) / span)) : 1;
    // A tool change is a jump: the end of the old tool stays until the new one is in the spindle.
    const part = kinds[low] === jump ? Math.floor(along) : along;
    const at = (array: Float32Array) => [0, 1, 2].map((k) => mix(array[3 * low + k], array[3 * low + 3 + k], part)) as Point;
    let tool = -1;
    for (let i = 0; i < tools.length && tools[i] <= low; i += 2) tool = tools[i + 1];
    return { tip: at(points), axis: toolAxes.length >= points.length ? at(toolAxes) : [0, 0, 1], tool, move: low, part };
  }

  /** The time at which block `by` blocks from here begins: one that takes another moment than this one. */
  blockFrom(time: number, by: number): number {
    const times = this.blockTimes;
    if (times.length === 0) return time;
    let at = lastAt(times, time + 1e-4);
    if (by < 0) {
      while (at > 0 && times[at] >= time - 1e-3) --at;
      return times[at];
    }
    while (at < times.length - 1 && times[at] <= time + 1e-3) ++at;
    return times[at];
  }

  touchFrom(time: number, by: number): (typeof this.touches)[number] | undefined {
    return by > 0 ? this.touches.find((touch) => touch.time > time + 1e-3) : this.touches.findLast((touch) => touch.time < time - 1e-3);
  }

  /** The cycle that is under way, -1: none. */
  cycleAt(time: number): number {
    const { cycles } = this.report.results;
    let [low, high] = [0, cycles.length];
    while (high - low > 0) {
      const middle = (low + high) >> 1;
      if ((cycles[middle].start ?? Infinity) <= time) low = middle + 1;
      else high = middle;
    }
    const at = low - 1;
    return at >= 0 && time <= (cycles[at].end ?? -Infinity) ? at : -1;
  }

  displayAt(time: number): Display | null {
    const { trace, scene } = this.report;
    if (!trace || trace.seconds.length === 0) return null;
    const block = lastAt(trace.seconds, time);
    const next = Math.min(block + 1, trace.seconds.length - 1);
    const [file, line, state] = trace.places.subarray(3 * block, 3 * block + 3);
    const { tool, preset, frame } = trace.states[state];
    const from = trace.seconds[block];
    const span = trace.seconds[next] - from;
    const part = span > 0 ? Math.min(1, (time - from) / span) : 0;
    const inProgram = ([x, y, z]: Point) => [0, 1, 2].map((k) => frame[k] * x + frame[4 + k] * y + frame[8 + k] * z + frame[12 + k]);
    // The block says where it began and ended as the control sees it; the path in between is that of the tip.
    const [now, begin, end] = [time, from, from + span].map((when) => this.tipAt(when).tip);
    const ended = trace.places[3 * next + 2] === state;
    const shown = (values: Int32Array, k: number, many: number, through: (tip: Point) => number) => {
      const [first, last] = [values[many * block + k] / 1e4, values[many * next + k] / 1e4];
      const [off, offAtEnd] = [first - through(begin), last - through(end)];
      return through(now) + (ended ? mix(off, offAtEnd, part) : off);
    };
    const position = [0, 1, 2].map((k) => shown(trace.positions, k, 3, (tip) => inProgram(tip)[k])) as Point;
    const { move, part: share } = this.tipAt(time);
    const linear = ["X", "Y", "Z"];
    const axes = trace.axes.map((name, k) => {
      const known = this.readings.get(name);
      if (known !== undefined) return { name, value: typeof known === "number" ? known : mix(known[move], known[move + 1], share) };
      const along = linear.indexOf(name);
      // A lathe or a table that turns: where the tip goes says little, both ends of the block do.
      const through = along >= 0 ? (tip: Point) => tip[along] : () => 0;
      return { name, value: shown(trace.readings, k, trace.axes.length, through) };
    });
    const { points, seconds } = scene.path;
    const way = Math.hypot(...[0, 1, 2].map((k) => points[3 * move + 3 + k] - points[3 * move + k]));
    const lasts = seconds[move + 1] - seconds[move];
    const moving = lasts > 0 && time < seconds[move + 1] && scene.path.kinds[move] !== jump;
    return { file: trace.files[file], line, tool, preset, position, axes, feed: moving ? (60 * way) / lasts : 0 };
  }
}
