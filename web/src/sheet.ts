// The inspection sheet: every characteristic with its limits, what was measured and what is true.

import type { Cycle, Report, ResultValue } from "./data";
import { detailsOf, writeLine } from "./details";
import { duration, h, icon, quantity, unitText } from "./dom";
import { characteristicOf, type Filter, type Group, groupsOf, isBad, nameOf, noFilter, passing, shareOf } from "./features";
import { hyphenated } from "./hyphens";
import { t } from "./language";
import { translated } from "./phrases";
import type { Selector } from "./selection";
import { badge, cycleState, verdictState } from "./verdict";
import { type Item, VirtualList } from "./virtual";

/** Where the value lies between its limits, drawn to scale; outside values stop at the rim. */
export function toleranceBar(result: ResultValue): HTMLElement | null {
  const share = shareOf(result);
  if (share === null) return null;
  const { value, lowerLimit, upperLimit, nominal } = result;
  const [lower, upper] = [lowerLimit!, upperLimit!];
  // The middle 70 % of the bar are the tolerance.
  const at = (x: number) => Math.min(98, Math.max(2, 15 + (70 * (x - lower)) / (upper - lower)));
  const percent = String(Math.round(100 * share));
  const title = t("shareTitle", { share: percent });
  return h(
    "div",
    { class: "share", title },
    h(
      "div",
      { class: "tolerance", role: "img", "aria-label": title },
      h("i", { class: "zone" }),
      nominal != null && h("i", { class: "nominal", style: `left:${at(nominal)}%` }),
      h("i", { class: `value ${result.verdict}`, style: `left:${at(value!)}%` }),
    ),
    h("span", {}, `${percent} %`),
  );
}

/** The label stands beside the value where the page is too narrow for heads. */
const cell = (kind: string, text: string, exact?: number | null, label?: string) =>
  h("span", { role: "cell", class: kind, title: exact == null ? null : String(exact), "data-label": label && text !== "" ? label : null }, text);

export function resultCells(result: ResultValue, number: string, truth: boolean): (HTMLElement | null)[] {
  const { unit } = result;
  const value = (x: number | null | undefined, signed = false) => (x === undefined ? "" : quantity(x, unit, signed));
  return [
    h("span", { role: "cell", class: "no" }, number),
    h(
      "span",
      { role: "cell", class: "characteristic", title: result.meaning },
      h("span", {}, hyphenated(characteristicOf(result))),
      h("code", {}, result.name),
    ),
    cell("number nominal-value", value(result.nominal), result.nominal, t("nominal")),
    h(
      "span",
      { role: "cell", class: "number limits" },
      result.upperLimit !== undefined && h("span", { title: String(result.upperLimit) }, value(result.upperLimit)),
      result.lowerLimit !== undefined && h("span", { title: String(result.lowerLimit) }, value(result.lowerLimit)),
    ),
    h(
      "span",
      {
        role: "cell",
        class: "number actual",
        title:
          String(result.value) +
          (result.uncertainty ? ` ${t("uncertainty", { value: quantity(result.uncertainty, unit) })}` : "") +
          (result.uncertaintyHolds === false ? `; ${t("uncertaintyFails")}` : ""),
      },
      value(result.value),
      h("i", { class: "unit" }, unitText(unit)),
      result.uncertaintyHolds === false && h("abbr", { title: t("uncertaintyFails") }, " ±?"),
    ),
    cell("number deviation", value(result.deviation, true), result.deviation),
    h("span", { role: "cell", class: "bar" }, toleranceBar(result)),
    h("span", { role: "cell", class: "verdict" }, result.verdict !== "none" && badge(verdictState(result.verdict), true)),
    truth ? cell("number truth", value(result.truth?.value), result.truth?.value, t("trueValue")) : null,
    truth ? cell("number truth truth-error", value(result.truth?.error, true), result.truth?.error, t("error")) : null,
  ];
}

export function sheetHeads(truth: boolean): [string, string][] {
  const heads: [string, string][] = [
    ["no", t("number")],
    ["characteristic", t("characteristic")],
    ["number nominal-value", t("nominal")],
    ["number limits", t("limits")],
    ["number actual", t("actual")],
    ["number deviation", t("deviation")],
    ["bar", t("ofTolerance")],
    ["verdict", t("verdict")],
  ];
  if (truth) heads.push(["number truth", t("trueValue")], ["number truth truth-error", t("error")]);
  return heads.map(([kind, text]) => [kind, hyphenated(text)]);
}

export const hasTruth = ({ results }: Report): boolean =>
  results.cycles.some((cycle) => cycle.results.some((result) => result.truth));

/** The greatest share of a tolerance among the rows of a group. */
function worstShare(cycle: Cycle, rows: number[]): number | null {
  const shares = rows.flatMap((row) => shareOf(cycle.results[row]) ?? []);
  return shares.length > 0 ? Math.max(...shares) : null;
}

export class Sheet {
  readonly element: HTMLElement;
  private readonly groups: Group[];
  private readonly list: VirtualList;
  private readonly truth: boolean;
  private filter: Filter = noFilter;
  private foldGood: boolean;
  /** What the reader has opened or folded by hand, by cycle. */
  private readonly opened = new Set<number>();
  private readonly unfolded = new Map<number, boolean>();
  /** Groups that pass the filter, and what stands where in the list. */
  private shown: number[] = [];
  private readonly count = h("output", { class: "count" });
  private readonly failureCount = h("output", { class: "count failures" });
  private readonly badButton: HTMLElement;
  private readonly foldButton: HTMLElement;
  readonly search: HTMLInputElement;
  private readonly failures: number[];

  constructor(
    private readonly report: Report,
    private readonly selector: Selector,
  ) {
    const { results } = report;
    this.groups = groupsOf(results);
    this.failures = this.groups.filter(({ state }) => isBad(state)).map(({ cycle }) => cycle);
    this.truth = hasTruth(report);
    // A handful of cycles is read at once; of many the bad ones matter.
    this.foldGood = this.groups.length > 12;
    this.list = new VirtualList(
      { class: `sheet ${this.truth ? "with-truth" : ""}`, role: "table", "aria-label": t("inspection"), "aria-rowcount": String(results.cycles.length) },
      h("div", { class: "sheet-head row", role: "row" }, ...sheetHeads(this.truth).map(([kind, text]) => h("span", { role: "columnheader", class: kind }, text))),
    );
    const names = [...new Set(results.cycles.map(({ name }) => name))];
    const press = (text: string, on: boolean, change: (on: boolean) => void) => {
      const button = h("button", { type: "button", class: "press", "aria-pressed": String(on) }, text);
      button.addEventListener("click", () => change(button.getAttribute("aria-pressed") !== "true"));
      return button;
    };
    this.badButton = press(t("badOnly"), false, (badOnly) => this.setFilter({ ...this.filter, badOnly }));
    this.foldButton = press(t("foldGood"), this.foldGood, (on) => {
      this.foldGood = on;
      this.unfolded.clear();
      this.update();
    });
    this.search = h("input", { type: "search", placeholder: t("searchName"), "aria-label": t("searchName") });
    this.search.addEventListener("input", () => this.setFilter({ ...this.filter, text: this.search.value }));
    const kinds = h("select", { "aria-label": t("allCycles") }, h("option", { value: "" }, t("allCycles")), ...names.map((name) => h("option", { value: name }, name)));
    kinds.addEventListener("change", () => this.setFilter({ ...this.filter, cycle: kinds.value }));
    const step = (by: number, symbol: "up" | "down", title: string) =>
      h("button", { type: "button", class: "plain-button", title, "aria-label": title, disabled: this.failures.length === 0, click: () => this.nextFailure(by) }, icon(symbol));
    this.element = h(
      "section",
      { class: "panel", id: "results", "data-tab": "inspection" },
      h(
        "div",
        { class: "filters" },
        this.badButton,
        names.length > 1 && kinds,
        this.search,
        this.foldButton,
        h("span", { class: "failure-steps" }, step(-1, "up", `${t("previousFailure")} (P)`), this.failureCount, step(1, "down", `${t("nextFailure")} (N)`)),
        this.count,
      ),
      results.cycles.length > 0 ? this.list.element : h("p", { class: "empty" }, t("noCycle")),
    );
    selector.listen((selection, source) => this.select(selection?.cycle ?? null, selection?.touch ?? null, source));
    this.update();
  }

  nextFailure(by: number) {
    const { failures } = this;
    if (failures.length === 0) return;
    const now = this.selector.value?.cycle ?? (by > 0 ? -1 : this.groups.length);
    const next = by > 0 ? failures.find((cycle) => cycle > now) : failures.findLast((cycle) => cycle < now);
    this.selector.select({ cycle: next ?? (by > 0 ? failures[0] : failures[failures.length - 1]), touch: null }, "keys");
  }

  nextCycle(by: number) {
    if (this.shown.length === 0) return;
    const now = this.selector.value?.cycle ?? (by > 0 ? -1 : Infinity);
    const next = by > 0 ? this.shown.find((cycle) => cycle > now) : this.shown.findLast((cycle) => cycle < now);
    if (next !== undefined) this.selector.select({ cycle: next, touch: null }, "keys");
  }

  /** Opens or folds the details of the selected cycle. */
  toggleSelected() {
    if (this.selector.value) this.toggle(this.selector.value.cycle);
  }

  private setFilter(filter: Filter) {
    this.filter = filter;
    this.update();
  }

  private update() {
    const { results } = this.report;
    this.badButton.setAttribute("aria-pressed", String(this.filter.badOnly));
    this.foldButton.setAttribute("aria-pressed", String(this.foldGood));
    const items: Item[] = [];
    this.shown = [];
    for (const group of this.groups) {
      const rows = passing(results, group, this.filter);
      if (!rows) continue;
      this.shown.push(group.cycle);
      this.addGroup(items, group, rows);
    }
    if (items.length === 0 && this.groups.length > 0)
      items.push({ key: "nothing", height: 40, build: () => h("p", { class: "empty" }, t("nothingFits")) });
    this.list.setItems(items);
    this.count.textContent = this.shown.length < this.groups.length ? t("shownOf", { shown: this.shown.length, n: this.groups.length }) : t("cycles", { n: this.groups.length });
    this.tellFailure();
  }

  private isFolded({ cycle, state }: Group): boolean {
    return this.unfolded.get(cycle) ?? (this.foldGood && !isBad(state) && this.filter.text === "");
  }

  private addGroup(items: Item[], group: Group, rows: number[]) {
    const cycle = this.report.results.cycles[group.cycle];
    const folded = this.isFolded(group);
    const open = this.opened.has(group.cycle);
    items.push({ key: `c${group.cycle}`, height: 38, build: () => this.head(group, rows, folded, open) });
    const inGroup = (element: HTMLElement) => {
      element.classList.add("of-group", `of-${group.state}`);
      element.classList.toggle("selected", this.selector.value?.cycle === group.cycle);
      element.addEventListener("click", () => this.selector.select({ cycle: group.cycle, touch: null }, "results"));
      return element;
    };
    if (!folded) {
      rows.forEach((row, i) =>
        items.push({
          key: `r${group.cycle}.${row}`,
          height: 40,
          build: () => {
            const result = cycle.results[row];
            const bad = result.verdict === "rework" || result.verdict === "scrap";
            // Without nominal value and limits there is room for a long name.
            const bare = result.nominal === undefined && result.upperLimit === undefined && result.lowerLimit === undefined;
            return inGroup(h("div", { class: `result row ${bad ? result.verdict : ""} ${bare ? "bare" : ""}`, role: "row" }, ...resultCells(result, `${group.cycle + 1}.${i + 1}`, this.truth)));
          },
        }),
      );
    }
    const alarm = cycle.alarm;
    if (alarm)
      items.push({
        key: `a${group.cycle}`,
        height: 34,
        build: () => inGroup(h("div", { class: "notes", role: "row" }, h("p", { class: "note alarm" }, icon("stop"), translated(alarm)), ...this.diagnosis(group.cycle))),
      });
    if (!folded && cycle.writes.length > 0)
      items.push({ key: `w${group.cycle}`, height: 24 * cycle.writes.length + 6, build: () => inGroup(h("div", { class: "notes", role: "row" }, ...cycle.writes.map(writeLine))) });
    if (open)
      items.push({
        key: `d${group.cycle}`,
        height: 420,
        build: () => h("div", { class: `detail-row ${group.state}`, role: "row" }, detailsOf(this.report, group.cycle, this.selector)),
      });
  }

  private diagnosis(cycle: number): HTMLElement[] {
    const known = this.report.results.truth?.diagnoses?.filter((each) => each.cycle === cycle) ?? [];
    return known.flatMap(({ texts }) => texts.map((text) => h("p", { class: "note diagnosis" }, icon("target"), translated(text))));
  }

  private head(group: Group, rows: number[], folded: boolean, open: boolean): HTMLElement {
    const cycle = this.report.results.cycles[group.cycle];
    const seconds = cycle.start != null && cycle.end != null ? cycle.end - cycle.start : null;
    const share = folded ? worstShare(cycle, rows) : null;
    const expandTitle = open ? t("fold") : t("expand");
    return h(
      "div",
      {
        id: `cycle-${group.cycle}`,
        class: `cycle-head ${cycleState(cycle)} ${this.selector.value?.cycle === group.cycle ? "selected" : ""}`,
        role: "row",
        click: () => {
          if (folded) this.setFolded(group.cycle, false);
          this.selector.select({ cycle: group.cycle, touch: null }, "results");
        },
      },
      h(
        "button",
        {
          type: "button",
          class: "toggle",
          title: expandTitle,
          "aria-label": expandTitle,
          "aria-expanded": String(open),
          click: (event) => {
            event.stopPropagation();
            this.toggle(group.cycle);
          },
        },
        icon(open ? "down" : "next"),
      ),
      h("span", { class: "order" }, String(group.cycle + 1)),
      h("b", { class: "feature" }, nameOf(cycle)),
      h("span", { class: "cycle-name" }, cycle.name, cycle.feature ? ` ${translated(cycle.title)}` : ""),
      cycle.place.line > 0 &&
        h(
          "a",
          {
            class: "line-link",
            href: "#program",
            click: (event) => {
              event.preventDefault();
              event.stopPropagation();
              this.selector.select({ cycle: group.cycle, touch: null }, "line");
            },
          },
          t("line", { line: cycle.place.line }),
        ),
      h("span", { class: "facts" }, [share !== null && `${Math.round(100 * share)} %`, duration(seconds)].filter(Boolean).join(" \u00b7 ")),
      badge(group.state, true),
    );
  }

  private setFolded(cycle: number, folded: boolean) {
    this.unfolded.set(cycle, folded);
    this.update();
  }

  private toggle(cycle: number) {
    if (!this.opened.delete(cycle)) {
      this.opened.add(cycle);
      this.unfolded.set(cycle, false);
    }
    this.update();
    if (this.opened.has(cycle)) this.list.show(`c${cycle}`, `d${cycle}`);
  }

  private tellFailure() {
    const { failures } = this;
    const at = this.selector.value ? failures.indexOf(this.selector.value.cycle) : -1;
    this.failureCount.textContent = failures.length === 0 ? t("noFailure") : t("failures", { at: at < 0 ? "\u2013" : at + 1, n: failures.length });
  }

  private select(cycle: number | null, touch: number | null, source: string) {
    this.tellFailure();
    if (cycle !== null && source !== "results") {
      // Whoever comes from outside wants to see it, whatever the filter says.
      if (!this.shown.includes(cycle)) {
        this.search.value = "";
        this.filter = noFilter;
        const kinds = this.element.querySelector("select");
        if (kinds) kinds.value = "";
        this.update();
      }
      const group = this.groups[cycle];
      if (this.isFolded(group)) this.setFolded(cycle, false);
    }
    if (cycle !== null && touch !== null && !this.opened.has(cycle)) this.toggle(cycle);
    this.list.eachRow((key, row) => {
      const mine = cycle !== null && (key === `c${cycle}` || key.startsWith(`r${cycle}.`) || key === `a${cycle}` || key === `w${cycle}`);
      row.classList.toggle("selected", mine);
      for (const line of row.querySelectorAll<HTMLElement>("tr.touch"))
        line.classList.toggle("selected", Number(line.dataset.cycle) === cycle && Number(line.dataset.touch) === touch);
    });
    if (cycle !== null && source !== "results" && source !== "replay") {
      const last = this.groups[cycle].rows.at(-1);
      this.list.show(`c${cycle}`, last === undefined ? `c${cycle}` : `r${cycle}.${last}`);
    }
  }
}
