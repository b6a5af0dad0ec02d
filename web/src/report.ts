import "./colours.css";
import "./basics.css";
import "./report.css";
import "./view.css";
import "./sheet.css";
import "./paper.css";

import { cameraShots } from "./camera";
import { clearanceSection } from "./clearance";
import { readReport, type Report } from "./data";
import { duration, fileName, h, icon, length } from "./dom";
import { currentLanguage, languageNames, t, useLanguage } from "./language";
import { buildPaper, facts } from "./paper";
import { ProgramView } from "./program";
import { type Selection, Selector } from "./selection";
import { Sheet } from "./sheet";
import { correctionsTable, eventsTable, filesText, timeSection, travelTable, truthTable } from "./tables";
import { headline, symbols } from "./verdict";
import { View } from "./view";
import { phrase, useDescriptions, usePhrases } from "./phrases";

type Tab = "inspection" | "program" | "corrections" | "messages" | "camera" | "run";

const root = document.documentElement;

function header(report: Report, switchLanguage: (code: string) => void, switchTheme: () => void): HTMLElement {
  const { run, totals, cycles, writes, events } = report.results;
  const { state, title, text } = headline(report);
  const changes = writes.length + cycles.reduce((sum, cycle) => sum + cycle.writes.length, 0);
  const alarms = events.filter((event) => event.kind === "alarm").length;
  const known: [string, string | undefined][] = [
    [t("part"), run.job?.part || run.part.name || fileName(run.part.path)],
    [t("serial"), run.job?.serial],
    [t("control"), run.control],
    [t("machine"), run.machine && phrase(run.machine)],
    [t("setup"), fileName(run.setup)],
  ];
  const languages = h(
    "select",
    { "aria-label": t("language"), title: t("language") },
    ...Object.entries(languageNames).map(([code, name]) => h("option", { value: code, selected: code === currentLanguage() }, name)),
  );
  languages.addEventListener("change", () => switchLanguage(languages.value));
  const button = (name: string, symbol: "sun" | "printer", click: () => void) =>
    h("button", { type: "button", class: "plain-button", title: name, "aria-label": name, click }, icon(symbol));
  return h(
    "header",
    { class: "page-head" },
    h(
      "div",
      { class: "title" },
      h("p", { class: "kicker" }, t("report")),
      h("h1", {}, run.programs.length > 0 ? fileName(run.programs[0]) : t("noProgram")),
      h("dl", { class: "run" }, ...known.map(([name, value]) => value && h("div", {}, h("dt", {}, name), h("dd", { title: value }, value)))),
    ),
    h("div", { class: `headline ${state}`, role: "status" }, icon(symbols[state]), h("div", {}, h("strong", {}, title), h("p", { title: text }, text))),
    h(
      "p",
      { class: "facts-line" },
      ...[
        t("cycles", { n: totals.cycles }),
        t("touches", { n: totals.touches }),
        totals.failedTouches > 0 && t("failedAttempts", { n: totals.failedTouches }),
        `${t("path")} ${length(totals.pathLength)}`,
        `${t("time")} ${duration(totals.time)}`,
        t("corrections", { n: changes }),
        t("alarms", { n: alarms }),
      ].map((fact) => fact && h("span", {}, fact)),
    ),
    h("div", { class: "page-buttons" }, languages, button(t("lightOrDark"), "sun", switchTheme), button(t("print"), "printer", () => window.print())),
  );
}

function runPanel(report: Report, selector: Selector): HTMLElement {
  const travel = travelTable(report);
  return h(
    "section",
    { class: "panel scroll text", "data-tab": "run", tabindex: 0 },
    h("dl", { class: "paper-facts" }, ...facts(report).map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value)))),
    ...timeSection(report, selector),
    ...clearanceSection(report, selector),
    travel && h("h3", {}, t("travelHead")),
    travel,
    h("h3", {}, t("keys")),
    h("ul", { class: "keys" }, ...t("keysText").split(". ").map((line) => h("li", {}, line.replace(/\.$/, "")))),
    h("p", { class: "meaning" }, t("footer")),
  );
}

/** The page in one language; built anew when that changes. */
class Page {
  readonly element: HTMLElement;
  readonly selector = new Selector();
  readonly view: View;
  readonly program: ProgramView;
  private readonly sheet: Sheet;
  private readonly main: HTMLElement;

  constructor(
    private readonly report: Report,
    switchLanguage: (code: string) => void,
    switchTheme: () => void,
  ) {
    const { selector } = this;
    this.program = new ProgramView(report, selector);
    this.view = new View(report, selector, (file, line) => this.program.follow(file, line));
    this.sheet = new Sheet(report, selector);
    const showLine = (file: string, line: number) => {
      this.program.showLine(file, line);
      this.open("program");
    };
    const truth = truthTable(report);
    const files = filesText(report);
    const shots = cameraShots(report, selector);
    const { results } = report;
    const alarms = results.events.filter(({ kind }) => kind === "alarm").length;
    const tab = (name: Tab, text: string, count = 0, kind = "") =>
      h("button", { type: "button", role: "tab", class: `tab ${kind}`, "data-tab": name, click: () => this.open(name) }, text, count > 0 && h("i", {}, String(count)));
    const changes = results.writes.length + results.cycles.reduce((sum, cycle) => sum + cycle.writes.length, 0);
    this.main = h(
      "main",
      { "data-tab": "inspection" },
      this.view.element,
      this.program.element,
      h(
        "div",
        { class: "card side" },
        h(
          "div",
          { class: "side-tabs", role: "tablist" },
          tab("inspection", t("inspection")),
          tab("program", t("program"), 0, "narrow-only"),
          tab("corrections", t("correctionsTab"), changes),
          tab("messages", t("messages"), results.events.length, alarms > 0 ? "alarm" : ""),
          shots.length > 0 && tab("camera", t("camera"), shots.length),
          tab("run", t("runTab")),
        ),
        this.sheet.element,
        h(
          "section",
          { class: "panel scroll", id: "corrections", "data-tab": "corrections", tabindex: 0 },
          correctionsTable(report, selector),
          files && h("p", { class: "files" }, files),
          truth && h("h3", {}, t("truthHead")),
          truth && h("p", { class: "files" }, t("truthNote")),
          truth,
        ),
        h("section", { class: "panel scroll", id: "events", "data-tab": "messages", tabindex: 0 }, eventsTable(report, showLine)),
        shots.length > 0 && h("section", { class: "panel scroll", id: "camera", "data-tab": "camera", tabindex: 0 }, ...shots),
        runPanel(report, selector),
      ),
    );
    this.element = h("div", { class: "page" }, header(report, switchLanguage, switchTheme), this.main);
    selector.listen((selection, source) => {
      // A click in one list leads to the other one that has it.
      if (selection && (source === "badge" || source === "corrections" || source === "time")) this.open("inspection");
      if (selection && source === "line") this.open("program");
    });
    this.open("inspection");
  }

  open(tab: Tab) {
    // Beside the others the program is always open.
    const narrow = matchMedia("(max-width: 1050px)").matches;
    if (tab === "program" && !narrow) return;
    this.main.dataset.tab = tab;
    for (const button of this.main.querySelectorAll<HTMLElement>(".side-tabs .tab")) {
      const on = button.dataset.tab === tab;
      button.classList.toggle("active", on);
      button.setAttribute("aria-selected", String(on));
    }
  }

  /** True if the key was one of the page's. */
  key(event: KeyboardEvent): boolean {
    const target = event.target as HTMLElement;
    const typing = /^(INPUT|SELECT|TEXTAREA)$/.test(target.tagName);
    if (event.key === "Escape") {
      if (typing) target.blur();
      else this.selector.select(null, "page");
      return true;
    }
    if (typing || event.ctrlKey || event.altKey || event.metaKey) return false;
    const { replay } = this.view;
    const onButton = target.tagName === "BUTTON" || target.tagName === "A";
    const actions: Record<string, () => void> = {
      n: () => this.sheet.nextFailure(1),
      p: () => this.sheet.nextFailure(-1),
      j: () => this.sheet.nextCycle(1),
      k: () => this.sheet.nextCycle(-1),
      o: () => this.sheet.toggleSelected(),
      f: () => this.view.fit(),
      d: () => this.view.toggleDeviations(),
      "/": () => {
        this.open("inspection");
        this.sheet.search.focus();
      },
      ArrowLeft: () => replay.stepTouch(-1),
      ArrowRight: () => replay.stepTouch(1),
      ",": () => replay.stepBlock(-1),
      ".": () => replay.stepBlock(1),
      "+": () => replay.changeSpeed(1),
      "-": () => replay.changeSpeed(-1),
    };
    if (!onButton) actions[" "] = () => replay.toggle();
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    action?.();
    return action !== undefined;
  }

  paper(): HTMLElement {
    return buildPaper(this.report, this.view, this.program);
  }
}

async function main() {
  const place = document.getElementById("report")!;
  if (!("DecompressionStream" in window)) {
    place.append(h("p", { class: "empty" }, t("oldBrowser")));
    return;
  }
  const report = await readReport();
  useDescriptions(report.words);
  usePhrases(report.phrases);
  const dark = matchMedia("(prefers-color-scheme: dark)");
  let page: Page | null = null;
  const setTheme = (theme: string) => {
    root.dataset.theme = theme;
    page?.view.colour();
  };
  const build = (language: string) => {
    const before: Selection | null = page?.selector.value ?? null;
    page?.view.dispose();
    useLanguage(language);
    root.lang = currentLanguage();
    page = new Page(report, build, () => setTheme(root.dataset.theme === "dark" ? "light" : "dark"));
    place.replaceChildren(page.element);
    if (before) page.selector.select(before, "page");
  };
  root.dataset.theme = dark.matches ? "dark" : "light";
  build(report.language);
  dark.addEventListener("change", () => setTheme(dark.matches ? "dark" : "light"));

  // Paper is white, whatever the screen.
  let onScreen = "";
  const toPaper = () => {
    if (!page || document.getElementById("paper")) return;
    onScreen = root.dataset.theme ?? "light";
    setTheme("light");
    document.body.append(page.paper());
  };
  addEventListener("beforeprint", toPaper);
  addEventListener("afterprint", () => {
    document.getElementById("paper")?.remove();
    setTheme(onScreen);
  });
  // Whoever makes a PDF of the file asks for the pages at once.
  if (location.hash === "#print") requestAnimationFrame(() => requestAnimationFrame(toPaper));
  addEventListener("keydown", (event) => {
    if (page?.key(event)) event.preventDefault();
  });
}

main().catch((error: unknown) => {
  document.getElementById("report")!.append(h("p", { class: "empty" }, t("loadFailed", { why: String(error) })));
  throw error;
});
