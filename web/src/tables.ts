// The other tables: what was changed, how right it is, messages, where the time goes.

import type { Cycle, Report, Write } from "./data";
import { duration, fileName, fixed, h, length, quantity, unitText } from "./dom";
import { nameOf, timeByKind } from "./features";
import { t } from "./language";
import { phrase, translated } from "./phrases";
import type { Selector } from "./selection";

/** Controls write numbers with leading signs; a change of anything else has no amount. */
function change(write: Write): string {
  const pattern = /^[+-]?\d*\.?\d+$/;
  if (!pattern.test(write.before.trim()) || !pattern.test(write.after.trim())) return "";
  const decimals = Math.max(...[write.before, write.after].map((text) => (text.trim().split(".")[1] ?? "").length));
  return fixed(Number(write.after) - Number(write.before), decimals, true);
}

const headRow = (...heads: [string, string?][]) =>
  h("thead", {}, h("tr", {}, ...heads.map(([text, kind]) => h("th", { scope: "col", class: kind }, text))));

export function correctionsTable({ results }: Report, selector: Selector): HTMLElement {
  const rows: HTMLElement[] = [];
  const add = (write: Write, cycle: Cycle | null, index: number) => {
    const select = () => selector.select({ cycle: index, touch: null }, "corrections");
    rows.push(
      h(
        "tr",
        cycle ? { class: "link", tabindex: 0, click: select, keydown: (event) => (event as KeyboardEvent).key === "Enter" && select() } : {},
        h("td", {}, phrase(write.table)),
        h("td", {}, phrase(write.entry)),
        h("td", { class: "number before" }, write.before === "" ? "\u2013" : write.before),
        h("td", { class: "number after" }, write.after === "" ? "\u2013" : write.after),
        h("td", { class: "number" }, change(write)),
        h("td", { class: "meaning" }, cycle ? `${index + 1}  ${cycle.name}` : t("byProgram")),
      ),
    );
  };
  results.cycles.forEach((cycle, index) => cycle.writes.forEach((write) => add(write, cycle, index)));
  results.writes.forEach((write) => add(write, null, -1));
  if (rows.length === 0) return h("p", { class: "empty" }, t("nothingChanged"));
  return h(
    "table",
    { class: "plain" },
    headRow([t("table")], [t("entry")], [t("before"), "number"], [t("after"), "number"], [t("change"), "number"], [t("by")]),
    h("tbody", {}, ...rows),
  );
}

export function truthTable({ results }: Report): HTMLElement | null {
  const entries = results.truth?.entries ?? [];
  if (entries.length === 0) return null;
  // What is known of one entry stays together on paper.
  const groups = entries.map(({ name, values, distance, angle }) => {
    const off = [distance != null && `${fixed(distance, 4)} mm`, angle != null && `${fixed(angle, 4)} \u00b0`].filter(Boolean).join(", ");
    const rows = values.map((value, i) =>
      h(
        "tr",
        {},
        h("td", {}, i === 0 && h("b", {}, phrase(name)), i === 0 && off !== "" && h("div", { class: "meaning" }, t("distance", { value: off }))),
        h("td", {}, phrase(value.name)),
        h("td", { class: "number" }, quantity(value.value, value.unit)),
        h("td", { class: "number" }, quantity(value.truth, value.unit)),
        h("td", { class: "number strong" }, quantity(value.error, value.unit, true)),
        h("td", { class: "meaning" }, unitText(value.unit)),
      ),
    );
    return h("tbody", { class: "together" }, ...rows);
  });
  return h("table", { class: "plain" }, headRow([t("entry")], [""], [t("actual"), "number"], [t("truth"), "number"], [t("error"), "number"], [""]), ...groups);
}

const eventWords = { message: "eventMessage", alarm: "eventAlarm", stop: "eventStop", skipped: "eventSkipped", tool: "eventTool", warning: "eventWarning" } as const;

export function eventsTable({ results }: Report, showLine: ((file: string, line: number) => void) | null): HTMLElement {
  const known = results.truth?.diagnoses ?? [];
  const rows = results.events.map((event) => {
    const says = event.kind === "alarm" ? known.filter(({ time }) => time != null && event.time != null && Math.abs(time - event.time) < 0.5).flatMap(({ texts }) => texts) : [];
    return h(
      "tr",
      { class: `event ${event.kind}` },
      h("td", { class: "number" }, event.time == null ? "" : `${event.time.toFixed(1)} s`),
      h("td", {}, h("span", { class: `kind ${event.kind}` }, t(eventWords[event.kind]))),
      h(
        "td",
        { class: "event-text" },
        event.code !== "" && h("b", {}, phrase(event.code)),
        event.code !== "" && event.text !== "" ? ": " : "",
        // What programs say stays as it is.
        event.kind === "message" || event.kind === "stop" ? phrase(event.text) : translated(event.text),
        ...says.map((text) => h("div", { class: "diagnosis" }, translated(text))),
      ),
      h(
        "td",
        {},
        event.place.line > 0 &&
          (showLine
            ? h(
                "a",
                {
                  class: "line-link",
                  href: "#program",
                  click: (click) => {
                    click.preventDefault();
                    showLine(event.place.file, event.place.line);
                  },
                },
                t("line", { line: event.place.line }),
              )
            : t("line", { line: event.place.line })),
      ),
    );
  });
  return rows.length > 0 ? h("table", { class: "plain" }, h("tbody", {}, ...rows)) : h("p", { class: "empty" }, t("noMessages"));
}

function bars(rows: { label: string; note: string; seconds: number; select?: () => void }[]): HTMLElement {
  const most = Math.max(...rows.map(({ seconds }) => seconds), 1e-9);
  return h(
    "div",
    { class: "bars" },
    ...rows.map(({ label, note, seconds, select }) =>
      h(
        select ? "button" : "div",
        { class: "bar-row", type: select && "button", click: select },
        h("span", { class: "bar-label" }, label),
        h("span", { class: "bar-track" }, h("i", { style: `width:${((100 * seconds) / most).toFixed(1)}%` })),
        h("span", { class: "number" }, duration(seconds)),
        h("span", { class: "meaning" }, note),
      ),
    ),
  );
}

export function timeSection(report: Report, selector: Selector): HTMLElement[] {
  const { results } = report;
  const kinds = timeByKind(report);
  if (kinds.length === 0) return [];
  const total = results.totals.time || kinds.reduce((sum, { seconds }) => sum + seconds, 0);
  const share = (seconds: number) => `${((100 * seconds) / total).toFixed(0)} %`;
  const longest = results.cycles
    .map((cycle, index) => ({ cycle, index, seconds: (cycle.end ?? 0) - (cycle.start ?? 0) }))
    .sort((a, b) => b.seconds - a.seconds)
    .slice(0, 20);
  return [
    h("h3", {}, t("timePerCycle")),
    h("h4", {}, t("timeByKind")),
    bars(
      kinds.map(({ name, title, calls, seconds }) => ({
        label: name === "" ? t("betweenCycles") : `${name} ${title}`,
        note: name === "" ? share(seconds) : `${calls} \u00d7, ${share(seconds)}`,
        seconds,
      })),
    ),
    h("h4", {}, t("longestCycles")),
    bars(
      longest.map(({ cycle, index, seconds }) => ({
        label: `${index + 1}  ${cycle.name} ${nameOf(cycle)}`,
        note: length(cycle.pathLength),
        seconds,
        select: () => selector.select({ cycle: index, touch: null }, "time"),
      })),
    ),
  ];
}

export function travelTable({ results }: Report): HTMLElement | null {
  const travel = results.truth?.travel ?? [];
  if (travel.length === 0) return null;
  return h(
    "table",
    { class: "plain" },
    headRow([t("axis")], [t("margin"), "number"], [t("position"), "number"], [t("time"), "number"]),
    h(
      "tbody",
      {},
      ...travel.map(({ axis, unit, margin, position, time }) =>
        h("tr", {}, h("td", {}, axis), h("td", { class: "number" }, `${fixed(margin, 1)} ${unitText(unit)}`), h("td", { class: "number" }, fixed(position, 3)), h("td", { class: "number" }, time == null ? "" : `${time.toFixed(1)} s`)),
      ),
    ),
  );
}

export const filesText = ({ results }: Report): string | null =>
  results.files.length > 0 ? t("filesWritten", { files: results.files.map(fileName).join(", ") }) : null;
