// What the inspection sheet shows of the results, without the page: rows, shares of the tolerance, filters, repeats.

import type { Cycle, Report, Results, ResultValue } from "./data";
import { fixed } from "./dom";
import { currentLanguage, maybe } from "./language";
import { exactly, phrase, translated } from "./phrases";
import { cycleState, type State } from "./verdict";

/** A cycle and those of its results that answer what it was called for. */
export interface Group {
  cycle: number;
  rows: number[];
  state: State;
}

export function groupsOf(results: Results): Group[] {
  return results.cycles.map((cycle, index) => ({
    cycle: index,
    rows: cycle.results.flatMap((result, i) => (result.main ? [i] : [])),
    state: cycleState(cycle),
  }));
}

export const isBad = (state: State) => state === "rework" || state === "scrap" || state === "alarm";

/** The name that people know the feature by: the program's own, or what the cycle does. */
export const nameOf = (cycle: Cycle): string => cycle.feature || translated(cycle.title);

/** What a result is of, in the language of the page: "diameter", "centre, main axis". */
export function characteristicOf(result: ResultValue): string {
  const { characteristic } = result;
  const english = characteristic?.label || result.meaning;
  if (!characteristic || currentLanguage() === "en") return phrase(english);
  const own = exactly(english);
  if (own !== undefined) return own;
  const quantity = maybe(`quantity_${characteristic.quantity}`);
  if (!quantity) return phrase(english);
  const parts = [characteristic.item == null ? quantity : `${quantity} ${characteristic.item}`];
  if (characteristic.along) parts.push(maybe(`along_${characteristic.along}`) ?? characteristic.along);
  if (characteristic.system) parts.push(maybe(`system_${characteristic.system}`) ?? characteristic.system);
  return parts.join(", ");
}

/** A line of a screen of the cycle in the language of the page, as src/reports/screen_lines.cpp does it. */
function screenLine(line: string, cycle: Cycle): string {
  const whole = translated(line);
  if (whole !== line) return whole;
  let text = "";
  for (const { 0: piece, index } of line.matchAll(/\S+(?: \S+)*/g)) {
    const [, label, unit] = /^(.*?)( \[[^[\]]*\])?$/s.exec(piece) ?? [piece, piece, ""];
    const named = cycle.results.find((result) => (result.characteristic?.label || "") === label);
    const word = (named ? characteristicOf(named) : translated(label)) + (unit ?? "");
    const blanks = text === "" ? index : Math.max(2, index + piece.length - text.length - word.length);
    text += " ".repeat(blanks) + word;
  }
  return text;
}

/** A screen of the cycle in the language of the page. */
export const screenOf = (screen: string, cycle: Cycle): string =>
  currentLanguage() === "en" ? screen : screen.split("\n").map((line) => screenLine(line, cycle)).join("\n");

/** The meaning of any result: its role and what it is of. */
export function meaningOf(result: ResultValue): string {
  const role = maybe(`role_${result.role}`);
  if (currentLanguage() === "en" || !role) return phrase(result.meaning);
  const own = exactly(result.meaning);
  if (own !== undefined) return own;
  return result.characteristic ? `${role}, ${characteristicOf(result)}` : phrase(result.meaning);
}

/** How much of the tolerance is used, counted from its middle: 0 there, 1 at a limit, more outside. */
export function shareOf({ value, lowerLimit: lower, upperLimit: upper }: ResultValue): number | null {
  if (value == null || lower == null || upper == null || !(upper > lower)) return null;
  return Math.abs(value - (lower + upper) / 2) / ((upper - lower) / 2);
}

export interface Filter {
  badOnly: boolean;
  /** The control's name of a cycle; empty: all. */
  cycle: string;
  /** Words that name, title, characteristic or value must hold. */
  text: string;
}

export const noFilter: Filter = { badOnly: false, cycle: "", text: "" };

const outside = (result: ResultValue) => result.verdict === "rework" || result.verdict === "scrap";

/** The rows of a group that pass; null if the group does not. */
export function passing(results: Results, group: Group, filter: Filter): number[] | null {
  const cycle = results.cycles[group.cycle];
  if (filter.cycle !== "" && cycle.name !== filter.cycle) return null;
  let { rows } = group;
  if (filter.badOnly) {
    rows = rows.filter((row) => outside(cycle.results[row]));
    if (rows.length === 0 && !isBad(group.state)) return null;
  }
  const words = filter.text.toLowerCase().split(/\s+/).filter(Boolean);
  if (words.length === 0) return rows;
  const head = `${group.cycle + 1} ${cycle.name} ${nameOf(cycle)} ${cycle.title} ${translated(cycle.title)} ${cycle.alarm ?? ""} ${translated(cycle.alarm ?? "")}`.toLowerCase();
  if (words.every((word) => head.includes(word))) return rows;
  rows = rows.filter((row) => {
    const result = cycle.results[row];
    const text = `${head} ${result.name} ${characteristicOf(result)} ${result.meaning} ${fixed(result.value, 4)}`.toLowerCase();
    return words.every((word) => text.includes(word));
  });
  return rows.length > 0 ? rows : null;
}

/** Measurements of the same characteristic by the same line of the program, in the order they happened. */
export function repeatsOf(results: Results, cycle: number, result: ResultValue): number[] {
  const { place } = results.cycles[cycle];
  const values: number[] = [];
  for (const other of results.cycles) {
    if (other.place.line !== place.line || other.place.file !== place.file) continue;
    const same = other.results.find((candidate) => candidate.name === result.name);
    if (same?.value != null) values.push(same.value);
  }
  return values;
}

export interface Statistics {
  n: number;
  mean: number;
  /** Standard deviation of the sample. */
  s: number;
  range: number;
}

export function statisticsOf(values: number[]): Statistics {
  const n = values.length;
  const mean = values.reduce((sum, x) => sum + x, 0) / n;
  const squares = values.reduce((sum, x) => sum + (x - mean) ** 2, 0);
  const [least, most] = values.reduce(([low, high], x) => [Math.min(low, x), Math.max(high, x)], [Infinity, -Infinity]);
  return { n, mean, s: n > 1 ? Math.sqrt(squares / (n - 1)) : 0, range: most - least };
}

/** Time that goes into the cycles of each name, the longest first; what is left of the run under an empty name. */
export function timeByKind({ results }: Report): { name: string; title: string; calls: number; seconds: number }[] {
  const kinds = new Map<string, { name: string; title: string; calls: number; seconds: number }>();
  let inCycles = 0;
  for (const cycle of results.cycles) {
    if (cycle.start == null || cycle.end == null) continue;
    const key = `${cycle.name} ${cycle.title}`;
    const kind = kinds.get(key) ?? { name: cycle.name, title: translated(cycle.title), calls: 0, seconds: 0 };
    kind.calls += 1;
    kind.seconds += cycle.end - cycle.start;
    inCycles += cycle.end - cycle.start;
    kinds.set(key, kind);
  }
  const all = [...kinds.values()].sort((a, b) => b.seconds - a.seconds);
  const rest = (results.totals.time ?? 0) - inCycles;
  if (rest > 0.05) all.push({ name: "", title: "", calls: 0, seconds: rest });
  return all;
}
