// Elements and numbers as text. Texts only ever become text nodes, so nothing in a program can become markup.

export type Child = Node | string | null | undefined | false;

type Attributes = Record<string, string | number | boolean | null | undefined | ((event: Event) => void)>;

function fill(element: Element, attributes: Attributes, children: Child[]) {
  for (const [key, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(key, value);
    else if (value === true) element.setAttribute(key, "");
    else if (value !== false && value != null) element.setAttribute(key, String(value));
  }
  element.append(...children.filter((child): child is Node | string => child != null && child !== false));
}

export function svg(tag: string, attributes: Attributes = {}, ...children: Child[]): SVGElement {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  fill(element, attributes, children);
  return element;
}

export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  fill(element, attributes, children);
  return element;
}

/** A button that is pressed or not. */
export function toggleButton(text: string, on: boolean, change: (on: boolean) => void): HTMLButtonElement {
  const element = h("button", { type: "button", "aria-pressed": String(on) }, text);
  element.addEventListener("click", () => {
    on = !on;
    element.setAttribute("aria-pressed", String(on));
    change(on);
  });
  return element;
}

const icons: Record<string, string> = {
  check: "M4 12.5l5 5L20 6.5",
  warning: "M12 4L2.5 20.5h19zM12 10v5M12 17.6v.4",
  cross: "M5 5l14 14M19 5L5 19",
  stop: "M8 2.5h8l5.5 5.5v8L16 21.5H8L2.5 16V8zM12 7v6M12 16v.4",
  dot: "M12 9.5a2.5 2.5 0 100 5 2.5 2.5 0 000-5z",
  arrow: "M4 12h15M13 6l6 6-6 6",
  fit: "M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5",
  play: "M7 4l13 8-13 8z",
  pause: "M8 4v16M16 4v16",
  previous: "M15 5l-7 7 7 7",
  next: "M9 5l7 7-7 7",
  sun: "M12 8a4 4 0 100 8 4 4 0 000-8zM12 2v2M12 20v2M2 12h2M20 12h2M5 5l1.4 1.4M17.6 17.6L19 19M5 19l1.4-1.4M17.6 6.4L19 5",
  stepBack: "M18 5l-8 7 8 7zM7 5v14",
  stepOn: "M6 5l8 7-8 7zM17 5v14",
  up: "M5 15l7-7 7 7",
  down: "M5 9l7 7 7-7",
  target: "M12 3v4M12 17v4M3 12h4M17 12h4M12 8a4 4 0 100 8 4 4 0 000-8z",
  search: "M10.5 4a6.5 6.5 0 100 13 6.5 6.5 0 000-13zM15.5 15.5L21 21",
  printer: "M7 9V3h10v6M7 17H4v-8h16v8h-3M7 14h10v7H7z",
};

export function icon(name: keyof typeof icons): SVGSVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  fill(svg, { viewBox: "0 0 24 24", class: "icon", "aria-hidden": "true" }, []);
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", icons[name]);
  svg.append(path);
  return svg;
}

const minus = "\u2212";

/** A number with a true minus sign; "-0.000" never appears. */
export function fixed(value: number | null | undefined, decimals: number, signed = false): string {
  if (value == null) return "\u2013";
  const text = Math.abs(value).toFixed(decimals);
  const zero = Number(text) === 0;
  const sign = value < 0 && !zero ? minus : signed && !zero ? "+" : "";
  return sign + text;
}

/** A measured value: four decimals of mm and degrees, plain numbers as they are. */
export function quantity(value: number | null | undefined, unit: string, signed = false): string {
  if (value == null) return "\u2013";
  if (unit === "" && Number.isInteger(value)) return fixed(value, 0, signed);
  return fixed(value, 4, signed);
}

export const unitText = (unit: string): string => (unit === "deg" ? "\u00b0" : unit);

export function duration(seconds: number | null): string {
  if (seconds == null) return "\u2013";
  if (seconds < 60) return `${seconds.toFixed(1)} s`;
  const whole = Math.round(seconds);
  const hours = Math.floor(whole / 3600);
  const minutes = Math.floor((whole % 3600) / 60);
  return hours > 0 ? `${hours} h ${minutes} min` : `${minutes} min ${whole % 60} s`;
}

export function length(mm: number | null): string {
  if (mm == null) return "\u2013";
  return mm < 1000 ? `${mm.toFixed(0)} mm` : `${(mm / 1000).toFixed(2)} m`;
}

export const fileName = (path: string) => path.slice(Math.max(path.lastIndexOf("/"), path.lastIndexOf("\\")) + 1);
