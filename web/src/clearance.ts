// The least distance of the tool from everything else over the time of the run, with the nearest places.

import type { Report } from "./data";
import { duration, fixed, h, svg } from "./dom";
import { nameOf } from "./features";
import { t } from "./language";
import { phrase } from "./phrases";
import type { Selector } from "./selection";

type Span = NonNullable<NonNullable<NonNullable<Report["results"]["truth"]>["clearance"]>["spans"]>[number];

const [width, height] = [640, 170];
const [left, right, top, bottom] = [38, width - 10, 10, height - 22];
const nearestPlaces = 5;

/** A step of 1, 2 or 5 times a power of ten by which about `parts` of them make `whole`. */
function stepOf(whole: number, parts: number): number {
  const power = 10 ** Math.floor(Math.log10(whole / parts));
  return [1, 2, 5, 10].map((step) => step * power).find((step) => step * parts >= whole)!;
}

const upTo = (end: number, step: number) => Array.from({ length: Math.floor(end / step + 1e-9) + 1 }, (_, i) => i * step);

const whatMet = ({ part, solid }: Span) => [part && phrase(part), solid].filter(Boolean).join(", ");

function curve(spans: Span[], total: number, limit: number | undefined): SVGElement {
  const known = spans.map(({ distance }) => distance);
  const most = Math.max(1, limit ? 2 * limit : 0, ...known) * 1.05;
  const x = (seconds: number) => left + ((right - left) * seconds) / total;
  const y = (distance: number) => bottom - ((bottom - top) * distance) / most;
  // A move has one distance, its least; where nothing is known the curve has a gap.
  const path = (wanted: (span: Span) => boolean) => {
    let line = "";
    let last: Span | undefined;
    for (const span of spans) {
      if (!wanted(span)) continue;
      const joins = last !== undefined && span.from - last.to < 0.02;
      line += `${joins ? "L" : "M"}${x(span.from).toFixed(1)} ${y(span.distance).toFixed(1)}L${x(span.to).toFixed(1)} ${y(span.distance).toFixed(1)}`;
      last = span;
    }
    return line;
  };
  const text = (at: [number, number], what: string, kind: string) => svg("text", { x: at[0], y: at[1], class: kind }, what);
  return svg(
    "svg",
    { viewBox: `0 0 ${width} ${height}`, width, height, role: "img", "aria-label": t("clearance") },
    ...upTo(most, stepOf(most, 4)).flatMap((distance) => [
      svg("path", { class: "grid", d: `M${left} ${y(distance)}H${right}` }),
      text([left - 5, y(distance) + 3], `${distance}`, "end"),
    ]),
    ...upTo(total, stepOf(total, 6)).map((seconds) => text([x(seconds), height - 8], duration(seconds), "scale")),
    text([left - 5, top - 1], "mm", "end"),
    limit !== undefined && svg("path", { class: "limit", d: `M${left} ${y(limit)}H${right}` }),
    svg("path", { class: "clearance-far", d: path(({ orMore }) => Boolean(orMore)) }),
    svg("path", { class: "measured open", d: path(({ orMore }) => !orMore) }),
    limit !== undefined && svg("path", { class: "clearance-near", d: path(({ distance }) => distance < limit) }),
  );
}

export function clearanceSection({ results }: Report, selector: Selector): HTMLElement[] {
  const known = results.truth?.clearance;
  if (!known || known.spans.length === 0) return [];
  const total = Math.max(results.totals.time ?? 0, ...known.spans.map(({ to }) => to));
  // Of each cycle, and of what lies between two of them, only what came nearest.
  const ofCycles = new Map<string, Span>();
  for (const span of known.spans) {
    if (span.orMore) continue;
    const key = `${span.cycle ?? ""} ${span.part} ${span.solid}`;
    const before = ofCycles.get(key);
    if (!before || span.distance < before.distance) ofCycles.set(key, span);
  }
  const nearest = [...ofCycles.values()].sort((a, b) => a.distance - b.distance).slice(0, nearestPlaces);
  const cell = (kind: string, text: string) => h("td", { class: kind }, text);
  return [
    h("h3", {}, t("clearance")),
    h("figure", { class: "plot clearance" }, curve(known.spans, total, known.limit)),
    h(
      "table",
      { class: "plain" },
      h("tbody", {}, ...nearest.map((span) =>
        h(
          "tr",
          { click: () => span.cycle !== undefined && selector.select({ cycle: span.cycle, touch: null }, "clearance") },
          cell("number", `${fixed(span.distance, 2)} mm`),
          cell("", whatMet(span)),
          cell("", span.cycle === undefined ? "" : `${span.cycle + 1}  ${results.cycles[span.cycle].name} ${nameOf(results.cycles[span.cycle])}`),
          cell("number", `${span.from.toFixed(1)} s`),
        ),
      )),
    ),
  ];
}
