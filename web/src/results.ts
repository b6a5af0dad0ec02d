// The tables: cycles with their results, parameters and touches; changes; messages.

import { type Cycle, type Report, type ResultValue, type Write, touchDeviation, type Triple } from "./data";
import { type Child, count, touchCount, duration, fileName, fixed, h, icon, length, quantity } from "./dom";
import type { Selector } from "./selection";
import { badge, cycleState, verdictState } from "./verdict";

/** Where the value lies between its limits, drawn to scale; outside values stop at the rim. */
function toleranceBar(result: ResultValue): HTMLElement | null {
  const { value, lowerLimit: lower, upperLimit: upper, nominal } = result;
  if (value == null || lower == null || upper == null || !(upper > lower)) return null;
  // The middle 70 % of the bar are the tolerance.
  const at = (x: number) => Math.min(98, Math.max(2, 15 + (70 * (x - lower)) / (upper - lower)));
  const share = Math.round((100 * (value - lower)) / (upper - lower));
  return h(
    "div",
    { class: "tolerance", role: "img", "aria-label": `at ${share} % of the tolerance`, title: `at ${share} % of the tolerance` },
    h("i", { class: "zone" }),
    nominal != null && h("i", { class: "nominal", style: `left:${at(nominal)}%` }),
    h("i", { class: `value ${result.verdict}`, style: `left:${at(value)}%` }),
  );
}

const number = (text: string, exact: number | null | undefined, kind = "") =>
  h("td", { class: `number ${kind}`, title: exact == null ? null : String(exact) }, text);

function resultRow(result: ResultValue): HTMLElement {
  const { unit } = result;
  const outside = result.verdict === "rework" || result.verdict === "scrap";
  return h(
    "tr",
    { class: `result ${outside ? result.verdict : ""}` },
    h("td", { class: "name" }, result.name),
    h("td", { class: "meaning" }, result.meaning),
    number(quantity(result.value, unit), result.value, "actual"),
    h("td", { class: "unit" }, unit === "deg" ? "\u00b0" : unit),
    number(result.nominal === undefined ? "" : quantity(result.nominal, unit), result.nominal),
    number(result.deviation === undefined ? "" : quantity(result.deviation, unit, true), result.deviation, "deviation"),
    number(result.lowerLimit === undefined ? "" : quantity(result.lowerLimit, unit), result.lowerLimit),
    number(result.upperLimit === undefined ? "" : quantity(result.upperLimit, unit), result.upperLimit),
    h("td", { class: "bar" }, toleranceBar(result)),
    h("td", { class: "verdict" }, result.verdict !== "none" && badge(verdictState(result.verdict), true)),
  );
}

function furtherResults(further: ResultValue[]): HTMLElement {
  return h(
    "section",
    {},
    h("h4", {}, "Further results"),
    h(
      "dl",
      { class: "parameters" },
      ...further.map(({ name, value, unit, meaning }) =>
        h(
          "div",
          {},
          h("dt", {}, name),
          h("dd", { class: "number", title: value == null ? null : String(value) }, `${quantity(value, unit)}${unit === "" ? "" : ` ${unit === "deg" ? "\u00b0" : unit}`}`),
          h("dd", { class: "meaning" }, meaning),
        ),
      ),
    ),
  );
}

function point(triple: Triple | undefined): HTMLElement {
  if (!triple) return h("td", { class: "number" }, "\u2013");
  return h("td", { class: "number point", title: triple.join(", ") }, triple.map((x) => fixed(x, 3)).join("  "));
}

function details(cycle: Cycle, index: number, further: ResultValue[], selector: Selector): HTMLElement {
  const touches = h("tbody");
  cycle.touches.forEach((touch, number_) => {
    const deviation = touchDeviation(touch);
    touches.append(
      h(
        "tr",
        {
          class: `touch ${touch.outcome === "touched" ? "" : "missed"}`,
          "data-cycle": index,
          "data-touch": number_,
          tabindex: 0,
          click: () => selector.select({ cycle: index, touch: number_ }, "results"),
          keydown: (event) => {
            if ((event as KeyboardEvent).key === "Enter") selector.select({ cycle: index, touch: number_ }, "results");
          },
        },
        h("td", { class: "number" }, String(number_ + 1)),
        h("td", {}, touch.outcome),
        point(touch.target),
        point(touch.ballCentre),
        point(touch.surface),
        number(deviation == null ? "\u2013" : fixed(deviation, 4, true), deviation),
        h("td", { class: "number" }, touch.time == null ? "" : touch.time.toFixed(1)),
      ),
    );
  });
  return h(
    "div",
    { class: "details" },
    cycle.touches.length > 0 &&
      h(
        "section",
        { class: "wide" },
        h("h4", {}, "Touches"),
        h(
          "div",
          { class: "scroll" },
          h(
            "table",
            { class: "inner" },
            h("thead", {}, heads("#", "Outcome", "Target X Y Z", "Ball centre X Y Z", "Surface X Y Z", "Deviation", "Time s")),
            touches,
          ),
        ),
      ),
    further.length > 0 && furtherResults(further),
    cycle.parameters.length > 0 &&
      h(
        "section",
        {},
        h("h4", {}, "Parameters"),
        h(
          "dl",
          { class: "parameters" },
          ...cycle.parameters.map((parameter) =>
            h(
              "div",
              { class: parameter.default ? "default" : "" },
              h("dt", {}, parameter.name),
              h("dd", { class: "number" }, parameter.value),
              h("dd", { class: "meaning" }, parameter.meaning + (parameter.default ? " (default)" : "")),
            ),
          ),
        ),
      ),
  );
}

function heads(...texts: string[]): HTMLElement {
  return h("tr", {}, ...texts.map((text) => h("th", { scope: "col" }, text)));
}

function writeLine(write: Write): HTMLElement {
  return h(
    "p",
    { class: "note" },
    icon("arrow"),
    h("b", {}, write.table),
    ` ${write.entry}: `,
    h("span", { class: "before" }, write.before === "" ? "empty" : write.before),
    " \u2192 ",
    h("span", { class: "after" }, write.after === "" ? "empty" : write.after),
  );
}

function cycleBody(cycle: Cycle, index: number, selector: Selector): HTMLElement {
  const state = cycleState(cycle);
  const shown = cycle.results.filter((result) => result.main);
  const further = cycle.results.filter((result) => !result.main);
  const room = h("td", { colspan: 10 });
  const extra = h("tr", { class: "extra", hidden: true }, room);
  const toggle = h(
    "button",
    {
      class: "toggle",
      type: "button",
      "aria-expanded": "false",
      click: (event) => {
        event.stopPropagation();
        show(extra.hidden === true);
      },
    },
    [
      touchCount(cycle.touches.filter((touch) => touch.outcome === "touched").length, cycle.touches.length),
      count(cycle.parameters.length, "parameter"),
      ...(further.length > 0 ? [count(further.length, "further result")] : []),
    ].join(", "),
  );
  const show = (open: boolean) => {
    // Built when first asked for: a long run has thousands of touches.
    if (open && room.childElementCount === 0) room.append(details(cycle, index, further, selector));
    extra.hidden = !open;
    toggle.setAttribute("aria-expanded", String(open));
  };
  const seconds = cycle.start != null && cycle.end != null ? cycle.end - cycle.start : null;
  const head = h(
    "tr",
    { class: "cycle", click: () => selector.select({ cycle: index, touch: null }, "results") },
    h(
      "th",
      { colspan: 9, scope: "rowgroup" },
      h(
        "div",
        { class: "cycle-line" },
        h("span", { class: "order" }, String(index + 1)),
        h("span", { class: "cycle-name" }, cycle.name),
        h("span", { class: "cycle-title" }, cycle.title),
        cycle.place.line > 0 &&
          h(
            "a",
            {
              class: "line-link",
              href: "#program",
              click: (event) => {
                event.preventDefault();
                event.stopPropagation();
                selector.select({ cycle: index, touch: null }, "line");
              },
            },
            `line ${cycle.place.line}`,
          ),
        toggle,
        h("span", { class: "facts" }, `${duration(seconds)}, ${length(cycle.pathLength)}`),
      ),
    ),
    h("td", { class: "verdict" }, badge(state, true)),
  );
  const notes: Child[] = [
    cycle.alarm ? h("p", { class: "note alarm" }, icon("stop"), cycle.alarm) : null,
    ...cycle.writes.map(writeLine),
    ...cycle.screens.map((screen) => h("pre", { class: "screen", "aria-label": "Screen of the control" }, screen)),
    ...cycle.logFiles.map((file) => h("p", { class: "note" }, "Log: ", h("b", {}, fileName(file)))),
  ];
  const body = h(
    "tbody",
    { id: `cycle-${index}`, class: `cycle-group ${state}` },
    head,
    ...shown.map(resultRow),
    notes.some(Boolean) && h("tr", { class: "notes" }, h("td", { colspan: 10 }, ...notes)),
    extra,
  );
  selector.listen((selection, source) => {
    const mine = selection?.cycle === index;
    body.classList.toggle("selected", mine);
    if (mine && selection.touch != null) show(true);
    if (room.childElementCount > 0)
      for (const row of room.querySelectorAll<HTMLElement>("tr.touch"))
        row.classList.toggle("selected", mine && Number(row.dataset.touch) === selection.touch);
    if (!mine) return;
    if (source === "badge" || source === "card") body.scrollIntoView({ behavior: "smooth", block: "nearest" });
  });
  return body;
}

export function resultsSection({ results }: Report, selector: Selector): HTMLElement {
  const table = h(
    "table",
    { class: "results" },
    h(
      "thead",
      {},
      h(
        "tr",
        {},
        h("th", { scope: "col" }, "Result"),
        h("th", { scope: "col" }, "Meaning"),
        h("th", { scope: "col", class: "number" }, "Actual"),
        h("th", { scope: "col" }),
        h("th", { scope: "col", class: "number" }, "Nominal"),
        h("th", { scope: "col", class: "number" }, "Deviation"),
        h("th", { scope: "col", class: "number" }, "Lower limit"),
        h("th", { scope: "col", class: "number" }, "Upper limit"),
        h("th", { scope: "col", class: "bar" }, "In tolerance"),
        h("th", { scope: "col", class: "verdict" }, "Verdict"),
      ),
    ),
    ...results.cycles.map((cycle, index) => cycleBody(cycle, index, selector)),
  );
  return h(
    "section",
    { class: "card", id: "results" },
    h("h2", {}, "Cycles and results"),
    results.cycles.length > 0
      ? h("div", { class: "scroll" }, table)
      : h("p", { class: "empty" }, "The run did not reach a measuring cycle."),
  );
}

/** Controls write numbers with leading signs; a change of anything else has no amount. */
function change(write: Write): string {
  const pattern = /^[+-]?\d*\.?\d+$/;
  if (!pattern.test(write.before.trim()) || !pattern.test(write.after.trim())) return "";
  const decimals = Math.max(...[write.before, write.after].map((text) => (text.trim().split(".")[1] ?? "").length));
  return fixed(Number(write.after) - Number(write.before), decimals, true);
}

export function correctionsSection({ results }: Report, selector: Selector): HTMLElement {
  const rows: HTMLElement[] = [];
  const add = (write: Write, cycle: Cycle | null, index: number) =>
    rows.push(
      h(
        "tr",
        cycle ? { class: "link", click: () => selector.select({ cycle: index, touch: null }, "corrections") } : {},
        h("td", {}, write.table),
        h("td", {}, write.entry),
        h("td", { class: "number before" }, write.before === "" ? "\u2013" : write.before),
        h("td", { class: "number after" }, write.after === "" ? "\u2013" : write.after),
        h("td", { class: "number" }, change(write)),
        h("td", { class: "meaning" }, cycle ? `${index + 1}  ${cycle.name}` : "program"),
      ),
    );
  results.cycles.forEach((cycle, index) => cycle.writes.forEach((write) => add(write, cycle, index)));
  results.writes.forEach((write) => add(write, null, -1));
  return h(
    "section",
    { class: "card", id: "corrections" },
    h("h2", {}, "Corrections"),
    rows.length > 0
      ? h(
          "div",
          { class: "scroll" },
          h(
            "table",
            { class: "plain" },
            h(
              "thead",
              {},
              h(
                "tr",
                {},
                h("th", {}, "Table"),
                h("th", {}, "Entry"),
                h("th", { class: "number" }, "Before"),
                h("th", { class: "number" }, "After"),
                h("th", { class: "number" }, "Change"),
                h("th", {}, "By"),
              ),
            ),
            h("tbody", {}, ...rows),
          ),
        )
      : h("p", { class: "empty" }, "Nothing was changed in the control."),
    results.files.length > 0 && h("p", { class: "files" }, "Files written: ", h("b", {}, results.files.map(fileName).join(", "))),
  );
}

const eventWords = { message: "Message", alarm: "Alarm", stop: "Stop", skipped: "Skipped", tool: "Tool", warning: "Warning" };

export function eventsSection({ results }: Report, showLine: (file: string, line: number) => void): HTMLElement {
  const rows = results.events.map((event) =>
    h(
      "tr",
      { class: `event ${event.kind}` },
      h("td", { class: "number" }, event.time == null ? "" : `${event.time.toFixed(1)} s`),
      h("td", {}, h("span", { class: `kind ${event.kind}` }, eventWords[event.kind])),
      h("td", { class: "event-text" }, event.code !== "" && h("b", {}, event.code), event.code !== "" && event.text !== "" ? ": " : "", event.text),
      h(
        "td",
        {},
        event.place.line > 0 &&
          h(
            "a",
            {
              class: "line-link",
              href: "#program",
              click: (click) => {
                click.preventDefault();
                showLine(event.place.file, event.place.line);
              },
            },
            `line ${event.place.line}`,
          ),
      ),
    ),
  );
  return h(
    "section",
    { class: "card", id: "events" },
    h("h2", {}, "Messages and alarms"),
    rows.length > 0
      ? h("div", { class: "scroll" }, h("table", { class: "plain" }, h("tbody", {}, ...rows)))
      : h("p", { class: "empty" }, "No messages."),
  );
}
