// The time line and the controls of a replay, and what the control showed meanwhile.

import type { Report } from "./data";
import { duration, fileName, fixed, h, icon, quantity, unitText } from "./dom";
import { nameOf } from "./features";
import { t } from "./language";
import { MachineClock, type PathPlace } from "./machine_clock";
import { description, phrase } from "./phrases";
import type { Selector } from "./selection";
import { cycleState } from "./verdict";

const speeds = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100];

/** What follows the time. */
export interface Followers {
  /** The probe or tool goes there. */
  place(at: PathPlace): void;
  line(file: string, line: number): void;
}

export class Replay {
  /** Null if there is nothing to replay. */
  readonly element: HTMLElement | null = null;
  readonly clock: MachineClock;
  private readonly slider = h("input", { type: "range", min: 0, step: "any", value: 0, "aria-label": t("timeOfRun") });
  private readonly marks = h("canvas", { class: "marks", "aria-hidden": "true" });
  private readonly output = h("output", { class: "clock" });
  private readonly display = h("div", { class: "display", hidden: true });
  private readonly playButton = h("button", { type: "button", class: "plain-button play" });
  private readonly speedChoice: HTMLSelectElement;
  private playing = false;
  private time = 0;

  constructor(
    private readonly report: Report,
    private readonly selector: Selector,
    private readonly followers: Followers,
  ) {
    this.clock = new MachineClock(report);
    const { total } = this.clock;
    // The whole run in about twenty seconds, but never slower than it was.
    const usual = speeds.findLast((speed) => speed <= Math.max(1, total / 20)) ?? 1;
    this.speedChoice = h("select", { "aria-label": t("speed"), title: `${t("speed")} (+, -)` }, ...speeds.map((speed) => h("option", { value: speed, selected: speed === usual }, `${speed}\u00d7`)));
    if (!this.clock.canReplay) return;
    this.slider.max = String(total);
    this.slider.addEventListener("input", () => this.goTo(Number(this.slider.value)));
    this.playButton.addEventListener("click", () => this.toggle());
    this.showPlaying();
    const step = (symbol: "stepBack" | "stepOn" | "previous" | "next", title: string, go: () => void) =>
      h("button", { type: "button", class: "plain-button", title, "aria-label": title, click: go }, icon(symbol));
    this.element = h(
      "div",
      { class: "replay-area" },
      this.display,
      h(
        "div",
        { class: "replay" },
        step("stepBack", `${t("blockBack")} (,)`, () => this.stepBlock(-1)),
        step("previous", `${t("touchBack")} (\u2190)`, () => this.stepTouch(-1)),
        this.playButton,
        step("next", `${t("touchOn")} (\u2192)`, () => this.stepTouch(1)),
        step("stepOn", `${t("blockOn")} (.)`, () => this.stepBlock(1)),
        h("div", { class: "timeline" }, this.marks, this.slider),
        this.output,
        this.speedChoice,
      ),
    );
    new ResizeObserver(() => this.drawMarks()).observe(this.marks);
    this.output.textContent = duration(0);
  }

  toggle() {
    if (!this.element) return;
    this.playing = !this.playing;
    this.showPlaying();
    if (!this.playing) return;
    if (this.time >= this.clock.total) this.time = 0;
    let last = performance.now();
    const frame = (now: number) => {
      if (!this.playing) return;
      this.time = Math.min(this.clock.total, this.time + (Number(this.speedChoice.value) * (now - last)) / 1000);
      last = now;
      this.show();
      if (this.time >= this.clock.total) {
        this.playing = false;
        this.showPlaying();
      } else {
        requestAnimationFrame(frame);
      }
    };
    requestAnimationFrame(frame);
  }

  goTo(time: number) {
    this.time = Math.min(this.clock.total, Math.max(0, time));
    this.show();
  }

  stepBlock(by: number) {
    this.goTo(this.clock.blockFrom(this.time, by));
  }

  stepTouch(by: number) {
    const touch = this.clock.touchFrom(this.time, by);
    if (!touch) return;
    this.selector.select({ cycle: touch.cycle, touch: touch.touch }, "replay");
    this.goTo(touch.time);
  }

  changeSpeed(by: number) {
    const at = speeds.indexOf(Number(this.speedChoice.value)) + by;
    if (at >= 0 && at < speeds.length) this.speedChoice.value = String(speeds[at]);
  }

  /** Colours are the page's. */
  drawMarks() {
    const { width, height } = this.marks.getBoundingClientRect();
    if (width === 0) return;
    const scale = Math.min(devicePixelRatio, 2);
    this.marks.width = Math.round(width * scale);
    this.marks.height = Math.round(height * scale);
    const context = this.marks.getContext("2d")!;
    context.scale(scale, scale);
    const style = getComputedStyle(document.documentElement);
    const colour = (name: string) => style.getPropertyValue(`--${name}`).trim();
    // The slider's thumb stays within its track.
    const inset = 8;
    const x = (time: number) => inset + ((width - 2 * inset) * time) / this.clock.total;
    const { results } = this.report;
    context.fillStyle = colour("none-soft");
    context.fillRect(inset, 4, width - 2 * inset, 7);
    for (const cycle of results.cycles) {
      if (cycle.start == null || cycle.end == null) continue;
      const state = cycleState(cycle);
      context.fillStyle = colour(state === "none" ? "accent" : state);
      context.fillRect(x(cycle.start), 4, Math.max(0.7, x(cycle.end) - x(cycle.start) - 0.8), 7);
    }
    context.fillStyle = colour("alarm");
    for (const { kind, time } of results.events) {
      if ((kind !== "alarm" && kind !== "stop") || time == null) continue;
      context.beginPath();
      context.moveTo(x(time) - 5, 0);
      context.lineTo(x(time) + 5, 0);
      context.lineTo(x(time), 9);
      context.fill();
    }
    this.drawClearance(context, x, height, colour);
  }

  /** The least distance of the tool from everything else, where the run knows it. */
  private drawClearance(context: CanvasRenderingContext2D, x: (time: number) => number, height: number, colour: (name: string) => string) {
    const clearance = this.report.results.truth?.clearance;
    if (!clearance || clearance.spans.length === 0) return;
    const most = Math.max(2 * (clearance.limit ?? 0), 10);
    const [top, bottom] = [13, height - 1];
    const y = (distance: number) => bottom - ((bottom - top) * Math.min(distance, most)) / most;
    context.lineWidth = 1.2;
    for (const { from, to, distance } of clearance.spans) {
      context.strokeStyle = clearance.limit !== undefined && distance < clearance.limit ? colour("alarm") : colour("quiet");
      context.beginPath();
      context.moveTo(x(from), y(distance));
      context.lineTo(Math.max(x(to), x(from) + 0.8), y(distance));
      context.stroke();
    }
  }

  private showPlaying() {
    const title = `${t(this.playing ? "pause" : "replay")} (${t("keySpace")})`;
    this.playButton.replaceChildren(icon(this.playing ? "pause" : "play"));
    this.playButton.title = title;
    this.playButton.setAttribute("aria-label", t("replay"));
  }

  private show() {
    this.slider.value = String(this.time);
    this.output.textContent = duration(this.time);
    this.followers.place(this.clock.tipAt(this.time));
    this.showDisplay();
  }

  private showDisplay() {
    const shown = this.clock.displayAt(this.time);
    this.display.hidden = !shown;
    if (!shown) return;
    this.followers.line(shown.file, shown.line);
    const cycleIndex = this.clock.cycleAt(this.time);
    const { results } = this.report;
    const cycle = cycleIndex < 0 ? null : results.cycles[cycleIndex];
    const linear = shown.position.map(({ name }) => name);
    const names = [...linear, ...shown.axes.map(({ name }) => name).filter((name) => !linear.includes(name))];
    const position = (at: (typeof shown.position)[number] | undefined) => at && h("td", { class: "number", title: at.diameter ? t("quantity_diameter") : null }, `${at.diameter ? "\u2300 " : ""}${fixed(at.value, 3, true)}`);
    const reading = (name: string) => shown.axes.find((axis) => axis.name === name)?.value;
    const span = results.truth?.clearance?.spans.find(({ from, to }) => from <= this.time && this.time <= to);
    const item = (name: string, value: string) => h("div", {}, h("dt", {}, name), h("dd", { title: value }, value));
    this.display.replaceChildren(
      h(
        "table",
        { class: "axes" },
        h("thead", {}, h("tr", {}, h("th", {}), h("th", { scope: "col" }, `${t("preset")} ${shown.preset}`), h("th", { scope: "col" }, t("machine")))),
        h(
          "tbody",
          {},
          ...names.map((name, i) =>
            h("tr", {}, h("th", { scope: "row" }, name), position(shown.position[i]) ?? h("td"), h("td", { class: "number" }, fixed(reading(name), 3, true))),
          ),
        ),
      ),
      h(
        "dl",
        { class: "state" },
        item(t("block"), `${fileName(shown.file)} ${shown.line}`),
        item(t("tool"), shown.tool || t("noTool")),
        item(t("feedRate"), `${fixed(shown.feed, 0)} mm/min`),
        cycle && item(t("cycle"), `${cycleIndex + 1}  ${cycle.name} ${nameOf(cycle)}`),
        span && item(t("clearance"), `${span.orMore ? "\u2265 " : ""}${fixed(span.distance, 2)} mm${span.part ? ` (${phrase(span.part)}${span.solid ? `, ${span.solid}` : ""})` : ""}`),
      ),
      this.values(cycleIndex),
    );
  }

  /** What a cycle works with while it runs, and what the last one has left. */
  private values(cycleIndex: number): HTMLElement {
    const { cycles } = this.report.results;
    const running = cycles[cycleIndex];
    let done = cycleIndex - 1;
    if (cycleIndex < 0) done = cycles.findLastIndex((cycle) => (cycle.end ?? Infinity) <= this.time);
    const pair = (name: string, value: string, title: string) => h("div", { title }, h("dt", {}, name), h("dd", {}, value));
    return h(
      "dl",
      { class: "values", "aria-label": t("valuesInUse") },
      ...(running ? running.parameters.filter((parameter) => !parameter.default).map(({ name, value, meaning }) => pair(name, value, description(meaning))) : []),
      ...(done >= 0
        ? cycles[done].results.filter((result) => result.main).map(({ name, value, unit, meaning }) => pair(name, `${quantity(value, unit)}${unit ? ` ${unitText(unit)}` : ""}`, meaning))
        : []),
    );
  }
}
