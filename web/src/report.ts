import "./report.css";

import { cameraSection } from "./camera";
import { readReport, type Report } from "./data";
import { count, duration, fileName, h, icon, length } from "./dom";
import { programSection } from "./program";
import { correctionsSection, eventsSection, resultsSection } from "./results";
import { Selector } from "./selection";
import { headline, type State } from "./verdict";
import { View } from "./view";

const symbols: Record<State, "check" | "warning" | "cross" | "stop"> = {
  good: "check",
  none: "check",
  rework: "warning",
  scrap: "cross",
  alarm: "stop",
};

function startTime(report: Report): string {
  const text = report.results.run.startedAt;
  if (!text) return "";
  // As written, with the clock of the place where it ran.
  return text.replace("T", " ").replace(/(:\d\d)(?:\.\d+)?([+-]\d\d:\d\d|Z)$/, "$1");
}

function header(report: Report, switchTheme: () => void): HTMLElement {
  const { run, totals, cycles, writes, events } = report.results;
  const { state, title, text } = headline(report);
  const changes = writes.length + cycles.reduce((sum, cycle) => sum + cycle.writes.length, 0);
  const alarms = events.filter((event) => event.kind === "alarm").length;
  const fact = (value: string, name: string) => h("div", { class: "fact" }, h("b", {}, value), h("span", {}, name));
  const detail = (name: string, value: string | null | undefined) =>
    value ? h("div", {}, h("dt", {}, name), h("dd", { title: value }, value)) : null;
  return h(
    "header",
    { class: "page-head" },
    h(
      "div",
      { class: "head-line" },
      h(
        "div",
        { class: "title" },
        h("p", { class: "kicker" }, "Measuring report"),
        h("h1", {}, run.programs.length > 0 ? fileName(run.programs[0]) : "No program"),
        h(
          "dl",
          { class: "run" },
          detail("Part", run.part.name || fileName(run.part.path)),
          detail("Control", run.control),
          detail("Machine", run.machine),
          detail("Setup", fileName(run.setup)),
          detail("Seed", run.seed == null ? null : String(run.seed)),
          detail("Run at", startTime(report)),
        ),
      ),
      h(
        "div",
        { class: `headline ${state}`, role: "status" },
        icon(symbols[state]),
        h("div", {}, h("strong", {}, title), h("p", {}, text)),
      ),
      h(
        "div",
        { class: "page-buttons" },
        h("button", { type: "button", class: "plain-button", title: "Light or dark", "aria-label": "Light or dark", click: switchTheme }, icon("sun")),
        h("button", { type: "button", class: "plain-button", title: "Print", "aria-label": "Print", click: () => window.print() }, icon("printer")),
      ),
    ),
    h(
      "div",
      { class: "facts-line" },
      fact(String(totals.cycles), totals.cycles === 1 ? "cycle" : "cycles"),
      fact(String(totals.touches), totals.touches === 1 ? "touch" : "touches"),
      ...(totals.failedTouches > 0
        ? [fact(String(totals.failedTouches), totals.failedTouches === 1 ? "failed attempt" : "failed attempts")]
        : []),
      fact(length(totals.pathLength), "path"),
      fact(duration(totals.time), "time"),
      fact(String(changes), changes === 1 ? "correction" : "corrections"),
      fact(String(alarms), alarms === 1 ? "alarm" : "alarms"),
    ),
  );
}

async function main() {
  const report = await readReport();
  const selector = new Selector();
  const view = new View(report, selector);
  const program = programSection(report, selector);

  const dark = matchMedia("(prefers-color-scheme: dark)");
  const root = document.documentElement;
  const setTheme = (theme: string) => {
    root.dataset.theme = theme;
    view.colour();
  };
  dark.addEventListener("change", () => setTheme(dark.matches ? "dark" : "light"));
  // Paper is white, whatever the screen, and a reader of paper wants the results before the program.
  let onScreen = "";
  addEventListener("beforeprint", () => {
    onScreen = root.dataset.theme ?? "light";
    setTheme("light");
    view.showOnPaper(true);
    document.querySelector("main")!.append(program.element);
  });
  addEventListener("afterprint", () => {
    view.showOnPaper(false);
    setTheme(onScreen);
    view.element.after(program.element);
  });
  addEventListener("keydown", (event) => {
    if (event.key === "Escape") selector.select(null, "page");
  });

  const { run } = report.results;
  document.getElementById("report")!.append(
    header(report, () => setTheme(root.dataset.theme === "dark" ? "light" : "dark")),
    h("main", {}, h("div", { class: "top" }, view.element, program.element)),
  );
  const camera = cameraSection(report, selector);
  document
    .querySelector("main")!
    .append(
      resultsSection(report, selector),
      ...(camera ? [camera] : []),
      h("div", { class: "pair" }, correctionsSection(report, selector), eventsSection(report, program.showLine)),
    );
  document
    .getElementById("report")!
    .append(h("footer", {}, `Probewright ${run.version}. Lengths in mm, angles in degrees. ${count(report.results.totals.cycles, "cycle")} run as ${run.control || "unknown control"}.`));
  setTheme(dark.matches ? "dark" : "light");
}

void main();
