import type { Cycle, Report, Verdict } from "./data";
import { count, fileName, h, icon } from "./dom";

export type State = "good" | "rework" | "scrap" | "alarm" | "none";

const words: Record<State, string> = {
  good: "OK",
  rework: "Rework",
  scrap: "Scrap",
  alarm: "Alarm",
  none: "Done",
};

export function cycleState(cycle: Cycle): State {
  return cycle.alarm ? "alarm" : cycle.verdict;
}

export const stateWord = (state: State): string => words[state];

export function badge(state: State, small = false): HTMLElement {
  const symbol = state === "good" ? "check" : state === "alarm" ? "stop" : state === "scrap" ? "cross" : state === "rework" ? "warning" : null;
  return h("span", { class: `badge ${state}${small ? " small" : ""}` }, symbol && icon(symbol), words[state]);
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
    const text =
      exit.text ?? (stop ? [stop.code, stop.text].filter((part) => part !== "").join(": ") : "The run did not finish.");
    const where = stop && stop.place.line > 0 ? ` (${fileName(stop.place.file)}, line ${stop.place.line})` : "";
    const title = exit.code === 4 ? "Internal error" : stop?.kind === "stop" ? "Stopped" : "Alarm";
    return { state: "alarm", title, text: text + where };
  }
  if (exit.code === 2) return { state: "alarm", title: "Mistake in the input", text: exit.text ?? "" };
  const toleranced = results.cycles.flatMap((cycle) => cycle.results).filter((result) => result.verdict !== "none");
  const outside = toleranced.filter((result) => result.verdict !== "good").length;
  if (results.verdict === "rework" || results.verdict === "scrap" || exit.code === 1) {
    const advice = results.verdict === "scrap" ? "The part cannot be saved." : "The part can be reworked.";
    const text =
      outside > 0 ? `${outside} of ${count(toleranced.length, "toleranced value")} outside the limits. ${advice}` : (exit.text ?? "");
    return { state: results.verdict === "scrap" ? "scrap" : "rework", title: "Out of tolerance", text };
  }
  if (toleranced.length > 0) {
    return { state: "good", title: "OK", text: `All ${count(toleranced.length, "toleranced value")} within the limits.` };
  }
  return { state: "good", title: "OK", text: "The program ran to its end. Nothing had a tolerance." };
}

export const verdictState = (verdict: Verdict): State => verdict;
