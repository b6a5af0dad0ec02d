// What the camera of the machine saw: for each monitoring cycle the reference, the image it took, and the errors in it.

import "./camera.css";

import type { CameraShot, Report } from "./data";
import { count, h } from "./dom";
import type { Selector } from "./selection";
import type { State } from "./verdict";

/** Q601 as the cycles define it. */
const states: Record<number, { state: State; text: string }> = {
  1: { state: "good", text: "No error" },
  2: { state: "scrap", text: "Error found" },
  3: { state: "none", text: "Monitoring area or reference images missing" },
  10: { state: "alarm", text: "Camera fault" },
};

function picture(png: string, title: string, alt: string): HTMLElement {
  return h(
    "figure",
    { class: "camera-picture" },
    png === "" ? h("p", { class: "empty" }, "None") : h("img", { src: `data:image/png;base64,${png}`, alt }),
    h("figcaption", {}, title),
  );
}

function shotOf(shot: CameraShot, { results }: Report, selector: Selector): HTMLElement {
  const cycle = results.cycles[shot.cycle];
  const verdict = states[cycle.results.find((result) => result.name === "Q601")?.value ?? 0];
  const name = `image ${shot.number} of ${shot.point}`;
  const found = shot.evaluated === "" ? "not compared" : count(shot.errors, "error");
  return h(
    "article",
    { class: "camera-shot", click: () => selector.select({ cycle: shot.cycle, touch: null }, "results") },
    h(
      "p",
      { class: "camera-line" },
      h("b", {}, `${shot.cycle + 1}  ${cycle.name}`),
      ` ${name}`,
      verdict && h("span", { class: `badge ${verdict.state} small` }, verdict.text),
    ),
    h(
      "div",
      { class: "camera-pictures" },
      picture(shot.reference, `Reference: average of ${count(shot.references, "image")}`, `reference images of ${shot.point}`),
      picture(shot.taken, "Taken", name),
      picture(shot.evaluated, `Compared: ${found}`, `${name} with ${found}`),
    ),
  );
}

/** Null for a run without camera images. */
export function cameraSection(report: Report, selector: Selector): HTMLElement | null {
  const shots = report.scene.camera;
  if (shots.length === 0) return null;
  return h("section", { class: "card", id: "camera" }, h("h2", {}, "Camera"), ...shots.map((shot) => shotOf(shot, report, selector)));
}
