// What stood where at any time of the run: tip, tool, line, what the control showed. Knows nothing of the page.

import type { Readings, Report } from "./data";

type Point = [number, number, number];

/** What the control shows at a time. */
export interface Display {
  file: string;
  line: number;
  tool: string;
  preset: string;
  /** Of the tip in program coordinates: X, Y and Z that the machine has; X as a diameter where the control shows it so. */
  position: { name: string; value: number; diameter: boolean }[];
  /** Readings of all axes, by their names. */
  axes: { name: string; value: number }[];
  /** mm/min along the path; 0 where only rotary axes move. */
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

const linear = ["X", "Y", "Z"];

const mix = (a: number, b: number, part: number) => a + (b - a) * part;

export class MachineClock {
  readonly total: number;
  /** The times at which cycles begin and end, alarms and touches happen. */
  readonly touches: { time: number; cycle: number; touch: number }[];
  private readonly blockTimes: Float32Array;
  /** Readings of the axes at each point of the path, by name; empty: nobody knows. */
  private readonly readings: Map<string, Readings>;

  constructor(private readonly report: Report) {
    const { seconds } = report.scene.path;
    this.total = seconds.length > 0 ? seconds[seconds.length - 1] : 0;
    this.touches = report.results.cycles
      .flatMap((cycle, index) => cycle.touches.map((touch, i) => ({ time: touch.time ?? NaN, cycle: index, touch: i })))
      .filter(({ time }) => Number.isFinite(time))
      .sort((a, b) => a.time - b.time);
    const { axes } = report.scene.path;
    this.readings = new Map(report.trace?.axes.slice(0, axes.length).map((name, i) => [name, axes[i]]));
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
    const { trace } = this.report;
    if (!trace || trace.seconds.length === 0) return null;
    const block = lastAt(trace.seconds, time);
    const next = Math.min(block + 1, trace.seconds.length - 1);
    const [file, line, state] = trace.places.subarray(3 * block, 3 * block + 3);
    const { tool, preset, follows, frame, diameter } = trace.states[state];
    const from = trace.seconds[block];
    const span = trace.seconds[next] - from;
    const part = span > 0 ? Math.min(1, (time - from) / span) : 0;
    const inProgram = ([x, y, z]: Point) => [0, 1, 2].map((k) => frame[k] * x + frame[4 + k] * y + frame[8 + k] * z + frame[12 + k]);
    // The block says where it began and ended as the control sees it; the path in between is that of the tip.
    const [now, begin, end] = [time, from, from + span].map((when) => this.tipAt(when));
    const ended = trace.places[3 * next + 2] === state;
    const shown = (values: Int32Array, k: number, many: number, through: (place: PathPlace) => number) => {
      const [first, last] = [values[many * block + k] / 1e4, values[many * next + k] / 1e4];
      const [off, offAtEnd] = [first - through(begin), last - through(end)];
      return through(now) + (ended ? mix(off, offAtEnd, part) : off);
    };
    const axes = trace.axes.map((name, k) => {
      if (this.readings.has(name)) return { name, value: this.readingAt(name, now) };
      const along = linear.indexOf(name);
      // A lathe or a table that turns: where the tip goes says little, both ends of the block do.
      const through = along >= 0 ? ({ tip }: PathPlace) => tip[along] : () => 0;
      return { name, value: shown(trace.readings, k, trace.axes.length, through) };
    });
    // Positions that follow the readings of the linear axes do not turn with a table or a main spindle.
    const place = follows === "axes" && this.readings.size > 0 ? (at: PathPlace) => this.linearReadings(at) : ({ tip }: PathPlace) => tip;
    const position = linear.flatMap((name, k) => {
      if (!trace.axes.includes(name) && trace.axes.some((axis) => linear.includes(axis))) return [];
      const value = shown(trace.positions, k, 3, (at) => inProgram(place(at))[k]);
      const doubled = diameter && name === "X";
      return [{ name, value: doubled ? 2 * value : value, diameter: doubled }];
    });
    return { file: trace.files[file], line, tool, preset, position, axes, feed: this.feedAt(time, now.move, follows) };
  }

  private readingAt(name: string, { move, part }: PathPlace): number {
    const known = this.readings.get(name) ?? 0;
    return typeof known === "number" ? known : mix(known[move], known[move + 1], part);
  }

  /** What X, Y and Z read; 0: there is no such axis. */
  private linearReadings(at: PathPlace): Point {
    return linear.map((name) => this.readingAt(name, at)) as Point;
  }

  private feedAt(time: number, move: number, follows: "table" | "axes"): number {
    const { points, seconds, kinds } = this.report.scene.path;
    const lasts = seconds[move + 1] - seconds[move];
    if (!(lasts > 0) || time >= seconds[move + 1] - 1e-3 || kinds[move] === jump) return 0;
    const over = Math.hypot(...[0, 1, 2].map((k) => points[3 * move + 3 + k] - points[3 * move + k]));
    if (this.readings.size === 0) return (60 * over) / lasts;
    const [from, to] = [0, 1].map((part) => this.linearReadings({ tip: [0, 0, 0], axis: [0, 0, 1], tool: -1, move, part }));
    const way = Math.hypot(...from.map((value, k) => to[k] - value));
    return (60 * (follows === "table" && way > 0 ? over : way)) / lasts;
  }
}
