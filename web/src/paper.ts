// The report on paper: the same sheet with pictures, laid out for pages.

import { cameraShots } from "./camera";
import type { JobField, Report } from "./data";
import { plotsOf, writeLine } from "./details";
import { duration, fileName, h, icon, length } from "./dom";
import { groupsOf, isBad, nameOf } from "./features";
import { t } from "./language";
import { phrase, translated } from "./phrases";
import type { ProgramView } from "./program";
import { Selector } from "./selection";
import { hasTruth, resultCells, sheetHeads } from "./sheet";
import { correctionsTable, eventsTable, filesText, truthTable } from "./tables";
import { badge, headline, symbols } from "./verdict";
import type { View } from "./view";

const jobFields: JobField[] = ["company", "part", "drawing", "order", "serial", "operator"];
/** Features out of tolerance that get pictures of their own. */
const mostPictures = 12;

export function startTime(report: Report): string {
  // As written, with the clock of the place where it ran.
  return (report.results.run.startedAt ?? "").replace("T", " ").replace(/(:\d\d)(?:\.\d+)?([+-]\d\d:\d\d|Z)$/, (_, seconds, zone) => seconds + (zone === "Z" ? " UTC" : ` ${zone}`));
}

/** What the head says of part, job and run. */
export function facts(report: Report): [string, string][] {
  const { run } = report.results;
  const all: [string, string | undefined | null][] = [
    ...jobFields.map((field): [string, string | undefined] => [t(field), run.job?.[field]]),
    [run.job?.part ? t("machinePart") : t("part"), run.part.name || fileName(run.part.path)],
    [t("program"), run.programs.length > 0 ? fileName(run.programs[0]) : null],
    [t("control"), run.control],
    [t("machine"), run.machine && phrase(run.machine)],
    [t("setup"), fileName(run.setup)],
    [t("runAt"), startTime(report)],
    [t("seed"), run.seed == null ? null : String(run.seed)],
    [t("version"), `Probewright ${run.version}`],
  ];
  return all.filter((pair): pair is [string, string] => !!pair[1]);
}

/** A cycle with more lines may go on on the next page. */
const longGroup = 12;

/** A text inside of a style sheet. */
const quoted = (text: string) => `"${text.replace(/[\\"]/g, "\\$&").replace(/[\n\r\f]/g, " ").replace(/</g, "\\3c ")}"`;

const footFont = "8pt sans-serif";
/** Of the 186 mm of a page's foot the middle has this much, the left end that. */
const [middleWide, leftWide] = [74, 54];

/** Texts one after the other, each cut short as far as all of them take more than this many mm in the foot of a page. */
function fitted(texts: (string | undefined)[], mm: number): string {
  const context = document.createElement("canvas").getContext("2d");
  const all = texts.filter((text): text is string => !!text);
  if (!context || all.length === 0) return all.join("   ").slice(0, mm / 2);
  context.font = footFont;
  const wide = (text: string) => (context.measureText(text).width * 25.4) / 96;
  const cut = (text: string, most: number) => {
    if (wide(text) <= most) return text;
    const letters = [...text];
    while (letters.length > 0 && wide(`${letters.join("")}\u2026`) > most) letters.pop();
    return `${letters.join("").trimEnd()}\u2026`;
  };
  // What is short leaves its place to the others.
  let [free, left] = [mm - (all.length - 1) * wide("   "), all.length];
  const order = all.map((_, i) => i).sort((a, b) => wide(all[a]) - wide(all[b]));
  for (const i of order) {
    all[i] = cut(all[i], free / left);
    free -= wide(all[i]);
    left -= 1;
  }
  return all.join("   ");
}

function pageStyle(report: Report): string {
  const { run } = report.results;
  const left = fitted([run.job?.part ?? run.part.name, run.job?.order, run.job?.serial], leftWide);
  const middle = fitted([run.programs.length > 0 ? fileName(run.programs[0]) : "", startTime(report)], middleWide);
  const box = (place: string, content: string) => `@bottom-${place} { content: ${content}; font: ${footFont}; white-space: nowrap; }`;
  return `@page { size: A4; margin: 12mm 12mm 16mm;
    ${box("left", quoted(left))}
    ${box("center", quoted(middle))}
    ${box("right", `${quoted(`${t("page")} `)} counter(page) " / " counter(pages)`)} }`;
}

function table(report: Report): HTMLElement {
  const { cycles } = report.results;
  const truth = hasTruth(report);
  const heads = sheetHeads(truth);
  // Widths are the columns' business: a name has as many lines as it needs.
  const asCell = (element: HTMLElement | null) => element && h("td", { class: element.className, title: null }, ...element.childNodes);
  return h(
    "table",
    { class: `paper-sheet ${truth ? "with-truth" : ""}` },
    h("colgroup", {}, ...heads.map(([kind]) => h("col", { class: kind.split(" ").at(-1)! }))),
    h("thead", {}, h("tr", {}, ...heads.map(([kind, text]) => h("th", { class: kind }, text)))),
    ...groupsOf(report.results).map(({ cycle: index, rows, state }) => {
      const cycle = cycles[index];
      return h(
        "tbody",
        { class: `${state} ${rows.length + cycle.writes.length > longGroup ? "long" : ""}` },
        h(
          "tr",
          { class: "paper-cycle" },
          h(
            "th",
            { colspan: heads.length },
            h("div", {}, h("span", {}, `${index + 1}  `, h("b", {}, nameOf(cycle)), `  ${cycle.name}${cycle.feature ? ` ${translated(cycle.title)}` : ""}`), badge(state, true)),
          ),
        ),
        ...rows.map((row, i) => h("tr", { class: isBad(cycle.results[row].verdict) ? cycle.results[row].verdict : "" }, ...resultCells(cycle.results[row], `${index + 1}.${i + 1}`, truth).map(asCell))),
        ...[cycle.alarm && h("p", { class: "note alarm" }, icon("stop"), translated(cycle.alarm)), ...cycle.writes.map(writeLine)].flatMap((note) => note ? [h("tr", {}, h("td", { colspan: heads.length }, note))] : []),
      );
    }),
  );
}

function pictures(report: Report, view: View): HTMLElement[] {
  const bad = groupsOf(report.results).filter(({ state, rows }) => isBad(state) && rows.length > 0);
  return bad.slice(0, mostPictures).flatMap(({ cycle: index, state }) => {
    const cycle = report.results.cycles[index];
    const picture = view.pictureOf(index, 520, 360);
    const plots = plotsOf(report, index);
    if (!picture && plots.length === 0) return [];
    return [h("section", { class: `paper-feature ${state}` }, h("h3", {}, `${index + 1}  ${nameOf(cycle)}`, badge(state, true)), h("div", { class: "paper-plots" }, picture, ...plots))];
  });
}

/** Builds the pages anew, as the report stands. */
export function buildPaper(report: Report, view: View, program: ProgramView): HTMLElement {
  const { state, title, text } = headline(report);
  const { totals, writes, cycles } = report.results;
  const changes = writes.length + cycles.reduce((sum, cycle) => sum + cycle.writes.length, 0);
  const selector = new Selector();
  const truth = truthTable(report);
  const files = filesText(report);
  return h(
    "div",
    { id: "paper" },
    h("style", {}, pageStyle(report)),
    h("header", {}, h("div", {}, h("p", { class: "kicker" }, t("inspectionReport")), h("h1", {}, report.results.run.job?.part ?? (report.results.run.part.name || fileName(report.results.run.programs[0] ?? "")))), h("div", { class: `headline ${state}` }, icon(symbols[state]), h("div", {}, h("strong", {}, title), h("p", {}, text)))),
    h("dl", { class: "paper-facts" }, ...facts(report).map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value)))),
    h(
      "p",
      { class: "paper-totals" },
      [t("cycles", { n: totals.cycles }), t("touches", { n: totals.touches }), ...(totals.failedTouches > 0 ? [t("failedAttempts", { n: totals.failedTouches })] : []), `${t("path")} ${length(totals.pathLength)}`, `${t("time")} ${duration(totals.time)}`].join(", "),
    ),
    h("figure", { class: "paper-picture" }, view.pictureOf(null, 1100, 480)),
    cycles.length > 0 && h("h2", {}, t("inspection")),
    cycles.length > 0 && table(report),
    ...pictures(report, view),
    report.scene.camera.length > 0 && h("section", {}, h("h2", {}, t("camera")), ...cameraShots(report, selector)),
    changes > 0 && h("section", {}, h("h2", {}, t("correctionsTab")), correctionsTable(report, selector), files && h("p", { class: "files" }, files)),
    truth && h("section", {}, h("h2", {}, t("truthHead")), truth),
    report.results.events.length > 0 && h("section", {}, h("h2", {}, t("messages")), eventsTable(report, null)),
    ...(program.printed ? program.paper() : []),
    h("div", { class: "signature" }, h("span", {}, t("operator")), h("span", {}, t("signature")), h("span", {}, t("runAt"))),
    h("p", { class: "paper-foot" }, t("footer")),
  );
}
