// What stands below a cycle's results when it is opened: plots, touches, further results, parameters, screens.

import { type Cycle, type Report, type ResultValue, touchDeviation, type Triple } from "./data";
import { fileName, fixed, h, icon, quantity, unitText } from "./dom";
import { characteristicOf, meaningOf, repeatsOf, screenOf } from "./features";
import { hyphenated } from "./hyphens";
import { t } from "./language";
import { formPlot, histogram, positionPlot, repeatedTouches } from "./plots";
import type { Selector } from "./selection";
import type { Write } from "./data";
import { description, phrase } from "./phrases";

export const outcomeText = (outcome: string) => (outcome === "touched" ? t("touched") : outcome);

/** "1\u20135", or "1, 6, 11" where there are others between them. */
function listed(numbers: number[]): string {
  const [first, last] = [numbers[0], numbers[numbers.length - 1]];
  if (last - first === numbers.length - 1) return `${first}\u2013${last}`;
  const most = 8;
  return numbers.length > most ? `${numbers.slice(0, most - 1).join(", ")}, \u2026 ${last}` : numbers.join(", ");
}

export function plotsOf({ results }: Report, index: number): HTMLElement[] {
  const cycle = results.cycles[index];
  const repeated = repeatedTouches(cycle).map(({ numbers, deviations }) =>
    histogram(`${t("repeatedTouches")} ${listed(numbers)}`, deviations),
  );
  const again = cycle.results
    .filter((result) => result.main && result.verdict !== "none")
    .map((result) => {
      const values = repeatsOf(results, index, result);
      if (values.length < 5) return null;
      return histogram(t("repeats", { name: `${result.name}, ${characteristicOf(result)}` }), values, { lower: result.lowerLimit, upper: result.upperLimit });
    });
  return [...(cycle.fits ?? []).map((fit) => formPlot(cycle, fit)), positionPlot(cycle), ...repeated, ...again].filter((plot) => plot !== null);
}

export function writeLine(write: Write): HTMLElement {
  return h(
    "p",
    { class: "note" },
    icon("arrow"),
    h("b", {}, phrase(write.table)),
    ` ${phrase(write.entry)}: `,
    h("span", { class: "before" }, write.before === "" ? t("empty") : write.before),
    " \u2192 ",
    h("span", { class: "after" }, write.after === "" ? t("empty") : write.after),
  );
}

const point = (triple: Triple | undefined) =>
  h("td", { class: "number point", title: triple?.join(", ") }, triple ? triple.map((x) => fixed(x, 3)).join(" ") : "\u2013");

function touchTable(cycle: Cycle, index: number, selector: Selector): HTMLElement {
  const known = cycle.touches.some((touch) => touch.truth);
  const rows = cycle.touches.map((touch, i) => {
    const deviation = touchDeviation(touch);
    const choose = () => selector.select({ cycle: index, touch: i }, "results");
    const selected = selector.value?.cycle === index && selector.value.touch === i;
    return h(
      "tr",
      {
        class: `touch ${touch.outcome === "touched" ? "" : "missed"} ${selected ? "selected" : ""}`,
        "data-cycle": index,
        "data-touch": i,
        tabindex: 0,
        click: choose,
        keydown: (event) => (event as KeyboardEvent).key === "Enter" && choose(),
      },
      h("td", { class: "number" }, String(i + 1)),
      h("td", {}, outcomeText(touch.outcome)),
      h("td", { class: "number strong" }, deviation == null ? "\u2013" : fixed(deviation, 4, true)),
      known && h("td", { class: "number" }, touch.truth?.error == null ? "\u2013" : fixed(touch.truth.error, 4, true)),
      point(touch.target),
      point(touch.ballCentre),
      point(touch.surface),
      h("td", { class: "number" }, touch.time == null ? "" : touch.time.toFixed(1)),
    );
  });
  const heads = [
    t("number"),
    t("outcome"),
    t("deviation"),
    ...(known ? [t("error")] : []),
    `${t("target")} X Y Z`,
    `${t("ballCentre")} X Y Z`,
    `${t("surface")} X Y Z`,
    `${t("time")} s`,
  ];
  return h(
    "section",
    { class: "wide" },
    h("h4", {}, t("touchesHead")),
    h(
      "div",
      { class: "scroll", tabindex: 0 },
      h("table", { class: "inner" }, h("thead", {}, h("tr", {}, ...heads.map((head) => h("th", { scope: "col" }, hyphenated(head))))), h("tbody", {}, ...rows)),
    ),
  );
}

function furtherResults(further: ResultValue[]): HTMLElement {
  return h(
    "section",
    {},
    h("h4", {}, t("furtherHead")),
    h(
      "dl",
      { class: "parameters" },
      ...further.map((result) =>
        h(
          "div",
          {},
          h("dt", {}, result.name),
          h("dd", { class: "number", title: result.value == null ? null : String(result.value) }, `${quantity(result.value, result.unit)} ${unitText(result.unit)}`.trim()),
          h("dd", { class: "meaning" }, meaningOf(result)),
        ),
      ),
    ),
  );
}

function parameters(cycle: Cycle): HTMLElement {
  return h(
    "section",
    {},
    h("h4", {}, t("parametersHead")),
    h(
      "dl",
      { class: "parameters" },
      ...cycle.parameters.map((parameter) =>
        h(
          "div",
          { class: parameter.default ? "default" : "" },
          h("dt", {}, parameter.name),
          h("dd", { class: "number" }, parameter.value),
          h("dd", { class: "meaning" }, description(parameter.meaning) + (parameter.default ? ` ${t("defaultValue")}` : "")),
        ),
      ),
    ),
  );
}

export function detailsOf(report: Report, index: number, selector: Selector): HTMLElement {
  const cycle = report.results.cycles[index];
  const further = cycle.results.filter((result) => !result.main);
  const plots = plotsOf(report, index);
  return h(
    "div",
    { class: "details" },
    plots.length > 0 && h("section", { class: "plots" }, ...plots),
    cycle.touches.length > 0 && touchTable(cycle, index, selector),
    further.length > 0 && furtherResults(further),
    cycle.parameters.length > 0 && parameters(cycle),
    (cycle.screens.length > 0 || cycle.logFiles.length > 0) &&
      h(
        "section",
        {},
        ...cycle.screens.map((screen) => h("pre", { class: "screen", "aria-label": t("screen") }, screenOf(screen, cycle))),
        ...cycle.logFiles.map((file) => h("p", { class: "note" }, t("log", { file: fileName(file) }))),
      ),
  );
}
