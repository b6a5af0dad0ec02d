import type { Cycle, Report, Verdict } from "./data";
import { fileName, h, icon } from "./dom";
import { t } from "./language";
import { translated } from "./phrases";

export type State = "good" | "rework" | "scrap" | "alarm" | "none";

export function cycleState(cycle: Cycle): State {
  return cycle.alarm ? "alarm" : cycle.verdict;
}

export const stateWord = (state: State): string => t(state === "none" ? "done" : state);

export const symbols: Record<State, "check" | "warning" | "cross" | "stop" | "dot"> = {
  good: "check",
  rework: "warning",
  scrap: "cross",
  alarm: "stop",
  none: "dot",
};

export function badge(state: State, small = false): HTMLElement {
  return h("span", { class: `badge ${state}${small ? " small" : ""}` }, state !== "none" && icon(symbols[state]), stateWord(state));
}

export interface Headline {
  state: State;
  title: string;
  text: string;
}

/** The run in a setter's words. */
export function headline({ results }: Report): Headline {
  const exit = results.run.exit;
  const stop = results.events.findLast((event) => event.kind === "alarm" || event.kind === "stop");
  if (exit.code >= 3 || stop?.kind === "alarm") {
    const text = translated(exit.text ?? (stop ? [stop.code, stop.text].filter((part) => part !== "").join(": ") : t("notFinished")));
    const where = stop && stop.place.line > 0 ? ` (${t("atLine", { file: fileName(stop.place.file), line: stop.place.line })})` : "";
    const title = exit.code === 4 ? t("internalError") : stop?.kind === "stop" ? t("stopped") : t("alarm");
    return { state: "alarm", title, text: text + where };
  }
  if (exit.code === 2) return { state: "alarm", title: t("inputMistake"), text: exit.text ?? "" };
  let [toleranced, outside] = [0, 0];
  for (const cycle of results.cycles)
    for (const { verdict } of cycle.results) {
      toleranced += Number(verdict !== "none");
      outside += Number(verdict === "rework" || verdict === "scrap");
    }
  if (results.verdict === "rework" || results.verdict === "scrap" || exit.code === 1) {
    const advice = results.verdict === "scrap" ? t("cannotBeSaved") : t("canBeReworked");
    const text = outside > 0 ? `${t("outside", { bad: outside, n: toleranced })} ${advice}` : (exit.text ?? "");
    return { state: results.verdict === "scrap" ? "scrap" : "rework", title: t("outOfTolerance"), text };
  }
  return { state: "good", title: t("good"), text: toleranced > 0 ? t("allWithin", { n: toleranced }) : t("nothingToleranced") };
}

export const verdictState = (verdict: Verdict): State => verdict;
