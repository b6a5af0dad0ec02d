// The card in the view that tells about the selected cycle or touch.

import { type Report, touchDeviation, type Triple } from "./data";
import { outcomeText } from "./details";
import { duration, fixed, h, icon } from "./dom";
import { nameOf } from "./features";
import { t } from "./language";
import { translated } from "./phrases";
import type { Selector } from "./selection";
import { badge, cycleState } from "./verdict";

const row = (name: string, values: string | string[], kind = "") =>
  h("div", { class: kind }, h("dt", {}, name), h("dd", {}, ...[values].flat().map((value) => h("span", {}, value))));

const point = (triple: Triple | undefined) => triple?.map((x) => fixed(x, 3)) ?? "\u2013";

/** `byTool`: the touch was felt by a cutter, not by a ball. */
export function fillCard(card: HTMLElement, report: Report, selector: Selector, byTool: boolean) {
  const selection = selector.value;
  const cycle = selection && report.results.cycles[selection.cycle];
  card.hidden = !cycle;
  if (!cycle) return;
  const { cycle: index, touch: touchIndex } = selection;
  const touch = touchIndex === null ? undefined : cycle.touches[touchIndex];
  const n = cycle.touches.length;
  const step = (by: number) => selector.select({ cycle: index, touch: touchIndex === null ? (by > 0 ? 0 : n - 1) : (touchIndex + by + n) % n }, "view");
  const button = (title: string, symbol: "previous" | "next" | "cross", click: () => void) =>
    h("button", { type: "button", class: "plain-button", "aria-label": title, title, click }, icon(symbol));
  const deviation = touch ? touchDeviation(touch) : null;
  card.replaceChildren(
    h(
      "header",
      {},
      h("div", {}, h("b", {}, nameOf(cycle)), h("br"), `${cycle.name} ${translated(cycle.title)}`, cycle.place.line > 0 ? `, ${t("line", { line: cycle.place.line })}` : ""),
      badge(cycleState(cycle), true),
      button(t("close"), "cross", () => selector.select(null, "view")),
    ),
    n > 0
      ? h(
          "nav",
          {},
          button(t("previousTouch"), "previous", () => step(-1)),
          h("span", {}, touch ? t("touchOf", { at: touchIndex! + 1, n }) : t("touches", { n })),
          button(t("nextTouch"), "next", () => step(1)),
        )
      : "",
    touch
      ? h(
          "dl",
          {},
          row(t("outcome"), outcomeText(touch.outcome), touch.outcome === "touched" ? "" : "missed"),
          row(t("target"), point(touch.target)),
          ...(byTool ? [row(t("toolTip"), point(touch.ballCentre))] : [row(t("ballCentre"), point(touch.ballCentre)), row(t("surface"), point(touch.surface))]),
          row(t("direction"), point(touch.direction)),
          row(t("deviation"), deviation === null ? "\u2013" : `${fixed(deviation, 4, true)} mm`, "strong"),
          ...(touch.truth ? [row(t("errorOfMeasurement"), `${fixed(touch.truth.error, 4, true)} mm`)] : []),
          row(t("axes"), touch.axes ? Object.entries(touch.axes).map(([name, value]) => `${name} ${fixed(value, 3)}`) : "\u2013"),
          row(t("time"), duration(touch.time)),
        )
      : "",
  );
}
