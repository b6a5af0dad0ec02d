// Small drawings of what was measured: form of circles, lines, planes and spheres, position, spread of repeats.

import { type Cycle, type Fit, type ResultValue, type Touch, touchDeviation } from "./data";
import { fixed, h, svg } from "./dom";
import { statisticsOf } from "./features";
import { t } from "./language";

type Point = [number, number, number];

const size = 220;
const middle = size / 2;

function frame(title: string, note: string, drawing: SVGElement): HTMLElement {
  return h("figure", { class: "plot" }, h("figcaption", {}, h("b", {}, title), h("span", {}, note)), drawing);
}

const box = (width: number, height: number, ...children: (SVGElement | string | false | null)[]) =>
  svg("svg", { viewBox: `0 0 ${width} ${height}`, width, height, role: "img" }, ...children);

const text = (x: number, y: number, what: string, kind = "") => svg("text", { x, y, class: kind }, what);

/** 1, 2 or 5 times a power of ten, at least so large. */
function round(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 5, 10].map((step) => step * power).find((step) => step >= value) ?? value;
}

const microns = (mm: number) => `${fixed(1000 * mm, Math.abs(mm) < 0.01 ? 1 : 0, true)} \u00b5m`;

function pointOf(touch: Touch | undefined): Point | null {
  const at = touch?.ballCentre ?? touch?.surface;
  return at && at.every((x) => x != null) ? (at as Point) : null;
}

interface Sample {
  at: Point;
  residual: number;
  number: number;
}

function samplesOf(cycle: Cycle, fit: Fit): Sample[] {
  return fit.touches.flatMap((touch, i) => {
    const at = pointOf(cycle.touches[touch]);
    const residual = fit.residuals[i];
    return at && residual != null ? [{ at, residual, number: touch + 1 }] : [];
  });
}

const meanOf = (points: Point[]): Point =>
  [0, 1, 2].map((axis) => points.reduce((sum, point) => sum + point[axis], 0) / points.length) as Point;

/** The axes of coordinates by how far the points spread along them, the widest first. */
function widest(points: Point[]): number[] {
  const spread = [0, 1, 2].map((axis) => Math.max(...points.map((p) => p[axis])) - Math.min(...points.map((p) => p[axis])));
  return [0, 1, 2].sort((a, b) => spread[b] - spread[a]);
}

/** Centre and radius of the circle through points of a plane by least squares (Kasa). */
function circleThrough(points: [number, number][]): [number, number, number] {
  const [mx, my] = [0, 1].map((axis) => points.reduce((sum, point) => sum + point[axis], 0) / points.length);
  let [xx, xy, yy, xz, yz] = [0, 0, 0, 0, 0];
  for (const [px, py] of points) {
    const [x, y] = [px - mx, py - my];
    const z = x * x + y * y;
    xx += x * x;
    xy += x * y;
    yy += y * y;
    xz += x * z;
    yz += y * z;
  }
  const determinant = 2 * (xx * yy - xy * xy);
  if (Math.abs(determinant) < 1e-12) return [mx, my, 1];
  const [cx, cy] = [(xz * yy - yz * xy) / determinant, (yz * xx - xz * xy) / determinant];
  return [mx + cx, my + cy, Math.hypot(cx, cy) + Math.sqrt((xx + yy) / points.length)];
}

/** Centre and radius of the sphere through points by least squares; null if they lie in a plane. */
function sphereThrough(points: Point[]): { centre: Point; radius: number } | null {
  // About the mean: x^2 + y^2 + z^2 = 2 c x + e, with e from the mean of both sides.
  const mean = meanOf(points);
  const away = points.map((point) => point.map((value, k) => value - mean[k]) as Point);
  const squares = away.map(([x, y, z]) => x * x + y * y + z * z);
  const square = squares.reduce((sum, value) => sum + value, 0) / points.length;
  const rows = [0, 1, 2].map((i) => [
    ...[0, 1, 2].map((k) => away.reduce((sum, point) => sum + 2 * point[i] * point[k], 0)),
    away.reduce((sum, point, n) => sum + point[i] * (squares[n] - square), 0),
  ]);
  for (let i = 0; i < 3; ++i) {
    const pivot = [0, 1, 2].slice(i).reduce((best, row) => (Math.abs(rows[row][i]) > Math.abs(rows[best][i]) ? row : best), i);
    [rows[i], rows[pivot]] = [rows[pivot], rows[i]];
    if (Math.abs(rows[i][i]) < 1e-9 * square * points.length) return null;
    for (let row = 0; row < 3; ++row) {
      if (row === i) continue;
      const factor = rows[row][i] / rows[i][i];
      rows[row] = rows[row].map((value, k) => value - factor * rows[i][k]);
    }
  }
  const off = rows.map((row, i) => row[3] / row[i]);
  return { centre: mean.map((value, k) => value + off[k]) as Point, radius: Math.sqrt(square + off.reduce((sum, value) => sum + value * value, 0)) };
}

/** How far the limits of a cycle's diameter lie from the circle that was measured, mm along the radius. */
function radialLimits(cycle: Cycle): number[] {
  const diameters = cycle.results.filter(({ characteristic, lowerLimit, upperLimit }) => characteristic?.quantity === "diameter" && (lowerLimit != null || upperLimit != null));
  if (diameters.length !== 1) return [];
  const [{ value, lowerLimit, upperLimit }] = diameters;
  return value == null ? [] : [lowerLimit, upperLimit].flatMap((limit) => (limit == null ? [] : [(limit - value) / 2]));
}

/** The greatest residual takes 28 of the 70 pixels to the circle. */
function polar(cycle: Cycle, fit: Fit): HTMLElement | null {
  const samples = samplesOf(cycle, fit);
  if (samples.length < 3) return null;
  const normal = widest(samples.map(({ at }) => at))[2];
  // Seen against the normal: X to the right and Y up, Z and X, Y and Z.
  const [across, up] = normal === 2 ? [0, 1] : normal === 1 ? [0, 2] : [1, 2];
  const plane = samples.map(({ at }) => [at[across], at[up]] as [number, number]);
  const [cx, cy] = circleThrough(plane);
  const residuals = Math.max(...samples.map(({ residual }) => Math.abs(residual)), 1e-6);
  // Limits of the diameter, from the measured circle outwards; drawn where they do not make the form a dot.
  const limits = radialLimits(cycle).filter((limit) => Math.abs(limit) <= 8 * residuals);
  const most = Math.max(residuals, ...limits.map(Math.abs));
  const step = round(most);
  const radius = 62;
  const scale = 24 / step;
  const placed = samples
    .map(({ residual, number }, i) => {
      const angle = Math.atan2(plane[i][1] - cy, plane[i][0] - cx);
      const reach = radius + scale * residual;
      return { angle, number, residual, x: middle + reach * Math.cos(angle), y: middle - reach * Math.sin(angle) };
    })
    .sort((a, b) => a.angle - b.angle);
  const names = "XYZ";
  return frame(
    t("roundness"),
    `${fixed(fit.formDeviation, 4)} mm`,
    box(
      size,
      size,
      svg("circle", { cx: middle, cy: middle, r: radius + 24, class: "grid" }),
      svg("circle", { cx: middle, cy: middle, r: radius - 24, class: "grid" }),
      svg("circle", { cx: middle, cy: middle, r: radius, class: "nominal" }),
      ...limits.map((limit) => svg("circle", { cx: middle, cy: middle, r: (radius + scale * limit).toFixed(1), class: "limit" }, svg("title", {}, `${t("limits")} ${microns(limit)}`))),
      svg("path", { d: `M${middle} ${middle - 8}v16M${middle - 8} ${middle}h16`, class: "grid" }),
      svg("polygon", { points: placed.map(({ x, y }) => `${x.toFixed(1)},${y.toFixed(1)}`).join(" "), class: "measured" }),
      ...placed.flatMap(({ angle, number, residual, x, y }) => [
        svg("circle", { cx: x.toFixed(1), cy: y.toFixed(1), r: 3.2, class: "dot" }, svg("title", {}, `${number}: ${microns(residual)}`)),
        text(middle + 97 * Math.cos(angle), middle - 97 * Math.sin(angle) + 4, String(number), "count"),
      ]),
      text(middle, middle + 22, `\u00b1${fixed(1000 * step, step < 0.001 ? 1 : 0)} \u00b5m`, "scale"),
      text(size - 8, size - 6, `${names[across]}${names[up]}`, "end"),
    ),
  );
}

/** Residuals over the length of a line, or touch by touch. */
function strip(title: string, fit: Fit, places: { x: number; residual: number; number: number }[], ends: [string, string]): HTMLElement {
  const [width, height, left] = [300, 130, 46];
  const step = round(Math.max(...places.map(({ residual }) => Math.abs(residual)), 1e-6));
  const y = (residual: number) => 58 - (42 * residual) / step;
  const x = (at: number) => left + 10 + at * (width - left - 26);
  const sorted = [...places].sort((a, b) => a.x - b.x);
  return frame(
    title,
    `${fixed(fit.formDeviation, 4)} mm`,
    box(
      width,
      height,
      ...[step, 0, -step].flatMap((level) => [
        svg("path", { d: `M${left} ${y(level)}H${width - 8}`, class: level === 0 ? "nominal" : "grid" }),
        text(left - 4, y(level) + 4, level === 0 ? "0" : microns(level), "end"),
      ]),
      svg("polyline", { points: sorted.map((p) => `${x(p.x).toFixed(1)},${y(p.residual).toFixed(1)}`).join(" "), class: "measured open" }),
      ...sorted.flatMap((p) => [
        svg("path", { d: `M${x(p.x).toFixed(1)} ${y(0)}V${y(p.residual).toFixed(1)}`, class: "stem" }),
        svg("circle", { cx: x(p.x).toFixed(1), cy: y(p.residual).toFixed(1), r: 3.2, class: "dot" }, svg("title", {}, `${p.number}: ${microns(p.residual)}`)),
        text(x(p.x), 118, String(p.number), "count"),
      ]),
      text(left, 129, ends[0]),
      text(width - 8, 129, ends[1], "end"),
    ),
  );
}

function linePlot(cycle: Cycle, fit: Fit): HTMLElement | null {
  const samples = samplesOf(cycle, fit);
  if (samples.length < 2) return null;
  const along = widest(samples.map(({ at }) => at))[0];
  const values = samples.map(({ at }) => at[along]);
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const places = samples.map(({ at, residual, number }) => ({ x: (at[along] - low) / (high - low || 1), residual, number }));
  const name = "XYZ"[along];
  return strip(t("straightness"), fit, places, [`${name} ${fixed(low, 1)}`, `${name} ${fixed(high, 1)}`]);
}

const mostTexts = 12;

/** Where the points lie, seen against `normal`; a ring shows by its size and sign how far a point lies off. */
function map(title: string, cycle: Cycle, fit: Fit): HTMLElement | null {
  const samples = samplesOf(cycle, fit);
  if (samples.length < 3) return null;
  const points = samples.map(({ at }) => at);
  const sphere = fit.shape === "sphere" ? sphereThrough(points) : null;
  if (fit.shape === "sphere" && !sphere) return null;
  const normal = sphere ? 2 : widest(points)[2];
  const [across, up] = normal === 2 ? [0, 1] : normal === 1 ? [0, 2] : [1, 2];
  const centre = sphere?.centre ?? meanOf(points);
  // A sphere is drawn to scale: its points lie within its outline.
  const reach = sphere?.radius ?? Math.max(...points.map((p) => Math.max(Math.abs(p[across] - centre[across]), Math.abs(p[up] - centre[up]))), 1e-6);
  const most = Math.max(...samples.map(({ residual }) => Math.abs(residual)), 1e-9);
  const names = "XYZ";
  return frame(
    title,
    `${fixed(fit.formDeviation, 4)} mm`,
    box(
      size,
      size,
      sphere && svg("circle", { cx: middle, cy: middle, r: 74, class: "nominal" }),
      svg("path", { d: `M${middle} 20V${size - 20}M20 ${middle}H${size - 20}`, class: "grid" }),
      ...samples.flatMap(({ at, residual, number }) => {
        const x = middle + (74 * (at[across] - centre[across])) / reach;
        const y = middle - (74 * (at[up] - centre[up])) / reach;
        return [
          svg(
            "circle",
            { cx: x.toFixed(1), cy: y.toFixed(1), r: (4 + (14 * Math.abs(residual)) / most).toFixed(1), class: residual < 0 ? "inwards" : "outwards" },
            svg("title", {}, `${number}: ${microns(residual)}`),
          ),
          text(x, y + 4, String(number), "count"),
          // Of many only the size is drawn.
          ...(samples.length <= mostTexts ? [text(x, y + 28, microns(residual), "scale")] : []),
        ];
      }),
      text(size - 8, 12, `${names[across]}${names[up]}`, "end"),
    ),
  );
}

/** Form of one fit; nothing where the shape passes through every point. */
export function formPlot(cycle: Cycle, fit: Fit): HTMLElement | null {
  if (fit.degreesOfFreedom === 0) return null;
  switch (fit.shape) {
    case "circle":
      return polar(cycle, fit);
    case "line":
      return linePlot(cycle, fit);
    case "plane": {
      return map(t("flatness"), cycle, fit);
    }
    case "sphere":
      return map(t("sphericity"), cycle, fit);
  }
}

/** A centre against its nominal place and its tolerance: the bull's eye. */
export function positionPlot(cycle: Cycle): HTMLElement | null {
  const along = (axis: string): ResultValue | undefined =>
    cycle.results.find(({ main, characteristic, nominal }) => main && characteristic?.quantity === "centre" && characteristic.along === axis && nominal != null);
  const [first, second] = [along("first"), along("second")];
  if (first?.value == null || second?.value == null) return null;
  const [dx, dy] = [first.value - first.nominal!, second.value - second.nominal!];
  const half = (result: ResultValue) =>
    result.upperLimit != null && result.lowerLimit != null ? (result.upperLimit - result.lowerLimit) / 2 : 0;
  const [hx, hy] = [half(first), half(second)];
  const reach = round(Math.max(Math.abs(dx), Math.abs(dy), hx, hy, 1e-4) * 1.05);
  const scale = 84 / reach;
  const bad = [first, second].find(({ verdict }) => verdict === "rework" || verdict === "scrap");
  return frame(
    t("plotPosition"),
    `${fixed(Math.hypot(dx, dy), 4)} mm`,
    box(
      size,
      size,
      ...[1, 2, 3].map((ring) => svg("circle", { cx: middle, cy: middle, r: 28 * ring, class: "grid" })),
      svg("path", { d: `M${middle} 14V${size - 14}M14 ${middle}H${size - 14}`, class: "grid" }),
      hx > 0 &&
        hy > 0 &&
        svg("rect", { x: middle - scale * hx, y: middle - scale * hy, width: 2 * scale * hx, height: 2 * scale * hy, class: "tolerance-zone" }),
      svg("path", { d: `M${middle} ${middle}L${middle + scale * dx} ${middle - scale * dy}`, class: "stem" }),
      svg("circle", { cx: middle + scale * dx, cy: middle - scale * dy, r: 4.5, class: `dot ${bad?.verdict ?? "good"}` }, svg("title", {}, `${microns(dx)}, ${microns(dy)}`)),
      text(size - 8, middle - 5, microns(reach), "end"),
      text(8, size - 6, `${microns(dx)}, ${microns(dy)}`),
    ),
  );
}

export function histogram(title: string, values: number[], limits?: { lower?: number | null; upper?: number | null }): HTMLElement | null {
  if (values.length < 3) return null;
  const { n, mean, s, range } = statisticsOf(values);
  const [width, height] = [300, 130];
  const bins = Math.max(3, Math.min(24, Math.ceil(Math.sqrt(n))));
  const least = Math.min(...values);
  const wide = range > 0 ? range / bins : 1e-6;
  const counts = new Array<number>(bins).fill(0);
  for (const value of values) counts[Math.min(bins - 1, Math.floor((value - least) / wide))] += 1;
  const most = Math.max(...counts);
  const x = (value: number) => 12 + ((value - least) / (bins * wide)) * (width - 24);
  const mark = (value: number | null | undefined, kind: string) =>
    value != null && x(value) >= 0 && x(value) <= width && svg("path", { d: `M${x(value).toFixed(1)} 8V100`, class: kind });
  return frame(
    title,
    t("statistics", { n, mean: fixed(mean, 4), s: fixed(s, 5), range: fixed(range, 4) }),
    box(
      width,
      height,
      svg("path", { d: `M8 100H${width - 8}`, class: "grid" }),
      ...counts.map((count, i) =>
        svg(
          "rect",
          { x: (12 + (i * (width - 24)) / bins + 0.5).toFixed(1), y: (100 - (88 * count) / most).toFixed(1), width: ((width - 24) / bins - 1).toFixed(1), height: ((88 * count) / most).toFixed(1), class: "bin" },
          svg("title", {}, String(count)),
        ),
      ),
      mark(mean, "nominal"),
      mark(limits?.lower, "limit"),
      mark(limits?.upper, "limit"),
      text(12, 116, fixed(least, 4)),
      text(width - 12, 116, fixed(least + bins * wide, 4), "end"),
    ),
  );
}

/** By its name in ISO 841. */
const isLinear = (name: string) => /^[XYZUVW]/i.test(name);

/** Positions of rotary axes: another one turns what is touched. */
const rotaryPlace = ({ axes }: Touch): string =>
  Object.entries(axes ?? {})
    .filter(([name]) => !isLinear(name))
    .map(([name, value]) => `${name}${Math.round(100 * (value ?? 0)) + 0}`)
    .join(" ");

/** How far two touches lie apart sideways, as the linear axes tell: of a point that is probed again only how deep it lies differs. */
function sideways(first: Touch, second: Touch, difference: number): number {
  const way = Object.entries(first.axes ?? {})
    .filter(([name]) => isLinear(name))
    .map(([name, value]) => (second.axes?.[name] ?? 0) - (value ?? 0));
  return Math.abs(Math.hypot(...way) - Math.abs(difference));
}

interface Repeated {
  numbers: number[];
  deviations: number[];
}

/** Touches that went for the same point of the machine from the same side, the rotary axes standing alike, three or more: their deviations. */
export function repeatedTouches(cycle: Cycle): Repeated[] {
  // mm; the preset that a cycle corrects between two touches moves the point.
  const samePlace = 0.01;
  const places = new Map<string, (Repeated & { first: Touch })[]>();
  cycle.touches.forEach((touch, i) => {
    const deviation = touchDeviation(touch);
    if (deviation === null) return;
    const key = `${[...touch.target, ...touch.direction].map((x) => x?.toFixed(4)).join(" ")} ${rotaryPlace(touch)}`;
    const there = places.get(key) ?? [];
    places.set(key, there);
    const same = there.find(({ first, deviations }) => sideways(first, touch, deviation - deviations[0]) < samePlace);
    if (same) {
      same.numbers.push(i + 1);
      same.deviations.push(deviation);
    } else {
      there.push({ first: touch, numbers: [i + 1], deviations: [deviation] });
    }
  });
  return [...places.values()].flat().filter(({ numbers }) => numbers.length >= 3);
}
