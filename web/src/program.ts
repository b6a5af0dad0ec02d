// The program's text with the lines of cycles marked. Only the lines in sight are elements of the page.

import type { Report } from "./data";
import { fileName, h, icon } from "./dom";
import { t } from "./language";
import type { Selector } from "./selection";
import { cycleState, type State, stateWord, symbols } from "./verdict";

const severity: State[] = ["none", "good", "rework", "scrap", "alarm"];
const lineHeight = 20;
const margin = 20;

/** Comments start with a semicolon outside of texts in quotes, in both languages. */
export function commentStart(line: string): number {
  let quoted = false;
  for (let i = 0; i < line.length; ++i) {
    if (line[i] === '"') quoted = !quoted;
    else if (line[i] === ";" && !quoted) return i;
  }
  return -1;
}

/** A line of the text, or the gap where lines were left out. */
interface Row {
  line: number;
  text: string;
  leftOut: number;
}

function rowsOf(program: Report["programs"][number]): Row[] {
  const rows: Row[] = [];
  let next = 1;
  const gap = (leftOut: number) => leftOut > 0 && rows.push({ line: 0, text: "", leftOut });
  for (const piece of program.pieces) {
    gap(piece.first - next);
    piece.lines.forEach((text, offset) => rows.push({ line: piece.first + offset, text, leftOut: 0 }));
    next = piece.first + piece.lines.length;
  }
  gap(program.lineCount - next + 1);
  return rows;
}

export class ProgramView {
  readonly element: HTMLElement;
  private readonly files: string[];
  private readonly rows: Row[][];
  private readonly places: Map<number, number>[];
  private readonly cyclesAt = new Map<string, number[]>();
  private readonly troubleAt: Set<string>;
  private readonly listing = h("div", { class: "listing", role: "region", tabindex: 0 });
  private readonly space = h("div", { class: "program-space" });
  private readonly tabs: HTMLElement[];
  private readonly drawn = new Map<number, HTMLElement>();
  private file = 0;
  private selected: { file: number; row: number } | null = null;
  private running: { file: number; row: number } | null = null;

  constructor(
    private readonly report: Report,
    private readonly selector: Selector,
  ) {
    const { results, programs } = report;
    this.files = results.run.programs;
    this.rows = programs.map(rowsOf);
    this.places = this.rows.map((rows) => new Map(rows.flatMap((row, i) => (row.line > 0 ? [[row.line, i] as const] : []))));
    results.cycles.forEach((cycle, index) => {
      const key = `${cycle.place.file}\n${cycle.place.line}`;
      const list = this.cyclesAt.get(key);
      if (list) list.push(index);
      else this.cyclesAt.set(key, [index]);
    });
    this.troubleAt = new Set(results.events.filter(({ kind }) => kind === "alarm").map(({ place }) => `${place.file}\n${place.line}`));
    this.tabs = this.rows.map((_, file) =>
      h("button", { type: "button", class: "tab", title: this.files[file], click: () => this.open(file) }, fileName(this.files[file] ?? "")),
    );
    this.listing.append(this.space);
    this.listing.addEventListener("scroll", () => this.render(), { passive: true });
    new ResizeObserver(() => this.render()).observe(this.listing);
    const printed = h("input", { type: "checkbox", id: "print-program" });
    this.element = h(
      "section",
      { class: "card program", id: "program" },
      h(
        "div",
        { class: "tabs" },
        h("h2", {}, t("program")),
        ...this.tabs,
        this.rows.length > 0 && h("label", { class: "print-program" }, printed, t("printProgram")),
      ),
      this.rows.length > 0 ? this.listing : h("p", { class: "empty" }, t("programMissing")),
    );
    if (this.rows.length > 0) this.open(0);
    selector.listen((selection, source) => {
      if (!selection) {
        this.mark("selected", null);
        return;
      }
      const { place } = results.cycles[selection.cycle];
      this.mark("selected", this.placeOf(place.file, place.line));
      if (source !== "program") this.scrollTo(this.selected, source !== "line");
    });
  }

  get printed(): boolean {
    return this.element.querySelector<HTMLInputElement>("#print-program")?.checked ?? false;
  }

  showLine(file: string, line: number) {
    this.mark("selected", this.placeOf(file, line));
    this.scrollTo(this.selected, false);
  }

  /** The line that is carried out at this time of a replay; 0: none. */
  follow(file: string, line: number) {
    const place = line > 0 ? this.placeOf(file, line) : null;
    if (place?.file === this.running?.file && place?.row === this.running?.row) return;
    this.mark("running", place);
    this.scrollTo(place, true);
  }

  /** All lines as they are printed. */
  paper(): HTMLElement[] {
    return this.rows.map((rows, file) =>
      h("section", { class: "paper-program" }, h("h2", {}, fileName(this.files[file] ?? "")), h("pre", {}, rows.map((row) => (row.leftOut > 0 ? t("linesLeftOut", { n: row.leftOut }) : `${String(row.line).padStart(5)}  ${row.text}`)).join("\n"))),
    );
  }

  private placeOf(file: string, line: number): { file: number; row: number } | null {
    const at = this.files.indexOf(file);
    const row = at < 0 ? undefined : this.places[at]?.get(line);
    return row === undefined ? null : { file: at, row };
  }

  private open(file: number) {
    this.file = file;
    this.tabs.forEach((tab, i) => tab.classList.toggle("active", i === file));
    const rows = this.rows[file];
    this.listing.setAttribute("aria-label", fileName(this.files[file] ?? ""));
    const longest = rows.reduce((most, { text }) => Math.max(most, text.length), 0);
    this.space.style.height = `${rows.length * lineHeight}px`;
    this.space.style.minWidth = `calc(${longest}ch + 110px)`;
    this.space.replaceChildren();
    this.drawn.clear();
    this.render();
  }

  private mark(kind: "selected" | "running", place: { file: number; row: number } | null) {
    const before = this[kind];
    this[kind] = place;
    for (const each of [before, place]) if (each && each.file === this.file) this.drawn.get(each.row)?.classList.toggle(kind, each === place);
  }

  /** Only the listing scrolls: what the reader looks at stays. */
  private scrollTo(place: { file: number; row: number } | null, onlyIfHidden: boolean) {
    if (!place) return;
    if (place.file !== this.file) this.open(place.file);
    const top = place.row * lineHeight;
    const { scrollTop, clientHeight } = this.listing;
    const seen = top >= scrollTop + lineHeight && top + 2 * lineHeight <= scrollTop + clientHeight;
    if (onlyIfHidden && seen) return;
    this.listing.scrollTop = Math.max(0, top - clientHeight / 3);
    this.render();
  }

  private render() {
    const rows = this.rows[this.file];
    if (!rows) return;
    const { scrollTop, clientHeight } = this.listing;
    const first = Math.max(0, Math.floor(scrollTop / lineHeight) - margin);
    const last = Math.min(rows.length, Math.ceil((scrollTop + clientHeight) / lineHeight) + margin);
    for (const [row, element] of this.drawn) {
      if ((row >= first && row < last) || element.contains(document.activeElement)) continue;
      element.remove();
      this.drawn.delete(row);
    }
    for (let i = first; i < last; ++i) {
      if (this.drawn.has(i)) continue;
      const element = this.row(rows[i]);
      element.style.top = `${i * lineHeight}px`;
      for (const kind of ["selected", "running"] as const)
        if (this[kind]?.file === this.file && this[kind]?.row === i) element.classList.add(kind);
      this.drawn.set(i, element);
      this.space.append(element);
    }
  }

  private row({ line, text, leftOut }: Row): HTMLElement {
    if (leftOut > 0) return h("div", { class: "line left-out" }, t("linesLeftOut", { n: leftOut }));
    const comment = commentStart(text);
    const code = h("code", {}, comment < 0 ? text : text.slice(0, comment), comment >= 0 && h("span", { class: "comment" }, text.slice(comment)));
    const row = h("div", { class: "line", "data-line": line }, h("span", { class: "line-number" }, String(line)), code);
    const key = `${this.files[this.file]}\n${line}`;
    const here = this.cyclesAt.get(key) ?? [];
    if (here.length === 0) {
      if (this.troubleAt.has(key)) row.classList.add("alarm");
      return row;
    }
    const states = here.map((index) => cycleState(this.report.results.cycles[index]));
    const worst = states.reduce((a, b) => (severity.indexOf(b) > severity.indexOf(a) ? b : a));
    row.classList.add("has-cycle", worst);
    // A line that ran several times steps through its runs.
    const choose = (source: string) => {
      const current = this.selector.value ? here.indexOf(this.selector.value.cycle) : -1;
      this.selector.select({ cycle: here[(current + 1) % here.length], touch: null }, source);
    };
    const title = t("showResultsOf", { state: stateWord(worst) });
    code.before(
      h(
        "button",
        {
          type: "button",
          class: "line-badge",
          title,
          "aria-label": title,
          click: (event) => {
            event.stopPropagation();
            choose("badge");
          },
        },
        here.length > 1 && `${here.length}\u00d7 `,
        icon(symbols[worst]),
      ),
    );
    row.addEventListener("click", () => choose("program"));
    return row;
  }
}
