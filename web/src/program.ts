// The program's text with the lines of cycles marked.

import type { Report } from "./data";
import { count, fileName, h, icon } from "./dom";
import type { Selector } from "./selection";
import { cycleState, type State, stateWord } from "./verdict";

const symbols: Record<State, "check" | "warning" | "cross" | "stop" | "dot"> = {
  good: "check",
  rework: "warning",
  scrap: "cross",
  alarm: "stop",
  none: "dot",
};

const severity = ["none", "good", "rework", "scrap", "alarm"];

/** Comments start with a semicolon outside of texts in quotes, in both languages. */
function commentStart(line: string): number {
  let quoted = false;
  for (let i = 0; i < line.length; ++i) {
    if (line[i] === '"') quoted = !quoted;
    else if (line[i] === ";" && !quoted) return i;
  }
  return -1;
}

export interface ProgramView {
  element: HTMLElement;
  showLine(file: string, line: number): void;
}

export function programSection(report: Report, selector: Selector): ProgramView {
  const { results, programs } = report;
  const cyclesAt = new Map<string, number[]>();
  results.cycles.forEach((cycle, index) => {
    const key = `${cycle.place.file}\n${cycle.place.line}`;
    cyclesAt.set(key, [...(cyclesAt.get(key) ?? []), index]);
  });
  const troubleAt = new Set(
    results.events.filter((event) => event.kind === "alarm").map((event) => `${event.place.file}\n${event.place.line}`),
  );

  const rows = new Map<string, HTMLElement>();
  const listings = programs.map((program, file) => {
    const path = results.run.programs[file];
    const listing = h("div", { class: "listing", role: "region", "aria-label": fileName(path), tabindex: 0 });
    let next = 1;
    for (const piece of program.pieces) {
      if (piece.first > next) listing.append(h("div", { class: "left-out" }, `${count(piece.first - next, "line")} left out`));
      piece.lines.forEach((text, offset) => {
        const line = piece.first + offset;
        const key = `${path}\n${line}`;
        const here = cyclesAt.get(key) ?? [];
        const comment = commentStart(text);
        const code = h(
          "code",
          {},
          comment < 0 ? text : text.slice(0, comment),
          comment >= 0 && h("span", { class: "comment" }, text.slice(comment)),
        );
        const row = h("div", { class: "line", "data-line": line }, h("span", { class: "line-number" }, String(line)), code);
        if (here.length > 0) {
          const states = here.map((index) => cycleState(results.cycles[index]));
          const worst = states.reduce((a, b) => (severity.indexOf(b) > severity.indexOf(a) ? b : a));
          row.classList.add("has-cycle", worst);
          // A line that ran several times steps through its runs.
          const choose = (source: string) => {
            const current = selector.value ? here.indexOf(selector.value.cycle) : -1;
            selector.select({ cycle: here[(current + 1) % here.length], touch: null }, source);
          };
          const toResults = h(
            "button",
            {
              type: "button",
              class: "line-badge",
              title: `${stateWord(worst)}: show the results`,
              "aria-label": `${stateWord(worst)}: show the results`,
              click: (event) => {
                event.stopPropagation();
                choose("badge");
              },
            },
            here.length > 1 && `${here.length}\u00d7 `,
            icon(symbols[worst]),
          );
          code.before(toResults);
          row.addEventListener("click", () => choose("program"));
        } else if (troubleAt.has(key)) {
          row.classList.add("alarm");
        }
        rows.set(key, row);
        listing.append(row);
      });
      next = piece.first + piece.lines.length;
    }
    if (program.lineCount >= next) listing.append(h("div", { class: "left-out" }, `${count(program.lineCount - next + 1, "line")} left out`));
    return listing;
  });

  const tabs = listings.map((_, file) =>
    h(
      "button",
      { type: "button", class: "tab", title: results.run.programs[file], click: () => open(file) },
      fileName(results.run.programs[file]),
    ),
  );
  const open = (file: number) => {
    listings.forEach((listing, i) => (listing.hidden = i !== file));
    tabs.forEach((tab, i) => tab.classList.toggle("active", i === file));
  };
  if (listings.length > 0) open(0);

  let marked: HTMLElement | null = null;
  const show = (file: string, line: number, scroll: boolean, smooth: boolean) => {
    marked?.classList.remove("selected");
    marked = rows.get(`${file}\n${line}`) ?? null;
    if (!marked) return;
    marked.classList.add("selected");
    const listing = marked.parentElement!;
    open(listings.indexOf(listing as HTMLDivElement));
    // Only the listing scrolls: the page stays where the reader is.
    if (scroll)
      listing.scrollTo({
        top: marked.offsetTop - listing.clientHeight / 3,
        behavior: smooth ? "smooth" : "instant",
      });
  };
  const element = h(
    "section",
    { class: "card program", id: "program" },
    h("div", { class: "tabs" }, h("h2", {}, "Program"), ...tabs),
    ...listings,
    listings.length === 0 && h("p", { class: "empty" }, "The program's text is not in this report."),
  );
  selector.listen((selection, source) => {
    if (!selection) {
      marked?.classList.remove("selected");
      marked = null;
      return;
    }
    const { place } = results.cycles[selection.cycle];
    show(place.file, place.line, source !== "program" && source !== "badge", true);
    if (source === "line") element.scrollIntoView({ behavior: "smooth", block: "nearest" });
  });
  return {
    element,
    showLine(file, line) {
      show(file, line, true, true);
      element.scrollIntoView({ behavior: "smooth", block: "nearest" });
    },
  };
}
