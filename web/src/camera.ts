// What the camera of the machine saw: for each monitoring cycle the reference, the image it took, and the errors in it.

import "./camera.css";

import type { CameraShot, Report } from "./data";
import { h } from "./dom";
import { type Key, t } from "./language";
import type { Selector } from "./selection";
import type { State } from "./verdict";

/** Q601 as the cycles define it. */
const states: Record<number, { state: State; text: Key }> = {
  1: { state: "good", text: "noErrorFound" },
  2: { state: "scrap", text: "errorFound" },
  3: { state: "none", text: "noReference" },
  10: { state: "alarm", text: "cameraFault" },
};

function picture(png: string, title: string, alt: string): HTMLElement {
  return h(
    "figure",
    { class: "camera-picture" },
    png === "" ? h("p", { class: "empty" }, t("noPicture")) : h("img", { src: `data:image/png;base64,${png}`, alt }),
    h("figcaption", {}, title),
  );
}

function shotOf(shot: CameraShot, { results }: Report, selector: Selector): HTMLElement {
  const cycle = results.cycles[shot.cycle];
  const verdict = states[cycle.results.find((result) => result.name === "Q601")?.value ?? 0];
  const name = t("imageOf", { number: shot.number, point: shot.point });
  const found = shot.evaluated === "" ? t("notCompared") : t("errorsFound", { n: shot.errors });
  return h(
    "article",
    { class: "camera-shot", click: () => selector.select({ cycle: shot.cycle, touch: null }, "results") },
    h(
      "p",
      { class: "camera-line" },
      h("b", {}, `${shot.cycle + 1}  ${cycle.name}`),
      ` ${name}`,
      verdict && h("span", { class: `badge ${verdict.state} small` }, t(verdict.text)),
    ),
    h(
      "div",
      { class: "camera-pictures" },
      picture(shot.reference, t("referenceOf", { n: shot.references }), t("referenceImages", { point: shot.point })),
      picture(shot.taken, t("taken"), name),
      picture(shot.evaluated, t("compared", { found }), `${name}: ${found}`),
    ),
  );
}

/** What each of the monitoring cycles saw; empty for a run without camera images. */
export function cameraShots(report: Report, selector: Selector): HTMLElement[] {
  return report.scene.camera.map((shot) => shotOf(shot, report, selector));
}
