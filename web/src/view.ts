// The 3D view: camera, buttons, picking of touches, the card that tells about one, replay.

import { MathUtils, OrthographicCamera, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

import { type Report, touchDeviation, type Triple } from "./data";
import { count, duration, fixed, h, icon } from "./dom";
import { MachineLayer } from "./machine";
import { Drawing, type Marker, type Palette } from "./scene";
import type { Selector } from "./selection";
import { badge, cycleState } from "./verdict";

const directions: Record<string, [Vector3, Vector3]> = {
  Top: [new Vector3(0, 0, 1), new Vector3(0, 1, 0)],
  Front: [new Vector3(0, -1, 0), new Vector3(0, 0, 1)],
  Right: [new Vector3(1, 0, 0), new Vector3(0, 0, 1)],
  Iso: [new Vector3(0.62, -0.85, 0.68), new Vector3(0, 0, 1)],
};

function palette(): Palette {
  const style = getComputedStyle(document.documentElement);
  const colour = (name: string) => style.getPropertyValue(`--${name}`).trim();
  return {
    background: colour("stage"),
    part: colour("part"),
    fixture: colour("fixture"),
    artefact: colour("artefact"),
    edge: colour("edge"),
    rapid: colour("rapid"),
    feed: colour("feed"),
    measure: colour("measure"),
    good: colour("good"),
    rework: colour("rework"),
    scrap: colour("scrap"),
    alarm: colour("alarm"),
    none: colour("accent"),
    selected: colour("accent"),
  };
}

export class View {
  readonly element: HTMLElement;
  private readonly stage = h("div", { class: "stage" });
  private readonly labels = h("div", { class: "labels" });
  private readonly card = h("aside", { class: "touch-card", hidden: true });
  private readonly camera = new OrthographicCamera(-1, 1, 1, -1, 0.1, 1000);
  private readonly drawing: Drawing;
  /** The machine around it; null: nothing of it is known. */
  private readonly machine: MachineLayer | null;
  private renderer: WebGLRenderer | null = null;
  private controls: OrbitControls | null = null;
  /** What the view was filled with last, until the reader moves it: a page that changes its size fills it anew. */
  private filledBy: Vector3[] | null = null;
  private scheduled = false;
  private shown: { at: Vector3; label: HTMLElement }[] = [];
  /** The names of the axes, and what stands at a collision. */
  private readonly standing: { at: Vector3; label: HTMLElement }[];

  constructor(
    private readonly report: Report,
    private readonly selector: Selector,
  ) {
    this.drawing = new Drawing(report);
    this.machine = report.scene.machine ? new MachineLayer(report.scene.machine, this.drawing.scene) : null;
    this.camera.up.set(0, 0, 1);
    this.standing = [
      ...this.drawing.axisEnds.map(({ name, at }) => ({ at, label: h("span", { class: "axis" }, h("b", {}, name)) })),
      ...report.scene.collisions.map(({ at, what, solid }) => ({
        at: new Vector3().fromArray(at),
        label: h("span", { class: "label collision" }, h("b", {}, `Collision: ${what}, ${solid}`)),
      })),
    ];
    this.element = h(
      "section",
      { class: "card view", id: "view", "aria-label": "3D view" },
      this.stage,
      this.toolbar(),
      this.legend(),
      this.card,
      this.replay(),
    );
    selector.listen((selection) => this.showSelection(selection?.cycle ?? null, selection?.touch ?? null));
    // The page decides the size; drawing starts with the first one.
    new ResizeObserver(() => this.resize()).observe(this.stage);
  }

  private start(): boolean {
    try {
      this.renderer = new WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
    } catch {
      this.stage.append(
        h("p", { class: "empty" }, "This browser shows no 3D graphics (WebGL is off). Everything else is below."),
      );
      return false;
    }
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    const canvas = this.renderer.domElement;
    this.labels.append(...this.standing.map(({ label }) => label));
    this.stage.append(canvas, this.labels);
    this.camera.add(...this.drawing.headlights);
    this.drawing.scene.add(this.camera);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("start", () => (this.filledBy = null));
    this.controls.addEventListener("change", () => this.draw());
    this.pick(canvas);
    this.colour();
    return true;
  }

  /** Takes the page's colours anew. */
  colour() {
    const colours = palette();
    this.drawing.colour(colours);
    this.machine?.colour(colours.fixture, colours.part, colours.artefact, colours.edge);
    // At once: a page about to be printed waits for no frame.
    if (this.renderer) this.render();
  }

  /** A still picture in place of the 3D canvas, which browsers print as it was shown last. */
  showOnPaper(on: boolean) {
    this.stage.querySelector(".paper")?.remove();
    if (!on || !this.renderer) return;
    const canvas = this.renderer.domElement;
    const still = h("canvas", { class: "paper", width: canvas.width, height: canvas.height });
    this.render();
    still.getContext("2d")!.drawImage(canvas, 0, 0);
    canvas.after(still);
  }

  private resize() {
    const { clientWidth: width, clientHeight: height } = this.stage;
    if (width === 0 || height === 0) return;
    const first = !this.renderer;
    if (first && (this.stage.childElementCount > 0 || !this.start())) return;
    this.renderer!.setSize(width, height);
    const aspect = width / height;
    this.camera.left = -aspect;
    this.camera.right = aspect;
    this.camera.updateProjectionMatrix();
    if (first) this.look("Iso");
    else if (this.filledBy) this.zoomTo(this.filledBy);
    // At once, not in the next frame: setting the size has emptied the canvas.
    this.render();
  }

  private look(name: string) {
    const [direction, up] = directions[name];
    this.camera.up.set(0, 0, 1);
    if (!this.controls) return;
    const { center, radius } = this.drawing.sphere;
    const reach = Math.max(radius, this.drawing.everything.radius + this.drawing.everything.center.distanceTo(center));
    // Looking straight down, a hair off the vertical keeps the part's Y pointing up.
    const towards = direction.clone().normalize();
    if (up.y === 1) towards.y -= 1e-4;
    this.controls.target.copy(center);
    this.camera.position.copy(center).addScaledVector(towards, 20 * reach);
    // A machine reaches far beyond its part.
    this.camera.near = this.machine ? -60 * reach : reach;
    this.camera.far = 60 * reach;
    this.zoomTo(this.drawing.focusCorners);
  }

  /** Moves and zooms so that these points fill the view, with room for what lies over its edges. */
  private zoomTo(points: Vector3[]) {
    if (!this.controls) return;
    this.controls.update();
    this.camera.updateMatrixWorld();
    const shift = new Vector3();
    const [width, height] = [0, 1].map((column) => {
      const along = new Vector3().setFromMatrixColumn(this.camera.matrixWorld, column);
      let [low, high] = [Infinity, -Infinity];
      for (const point of points) {
        const place = point.dot(along);
        low = Math.min(low, place);
        high = Math.max(high, place);
      }
      shift.addScaledVector(along, (low + high) / 2 - this.controls!.target.dot(along));
      return Math.max(high - low, 2);
    });
    this.controls.target.add(shift);
    this.camera.position.add(shift);
    this.filledBy = points;
    this.camera.zoom = Math.min((2 * this.camera.right) / (1.15 * width), 2 / (1.35 * height));
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  private draw() {
    if (this.scheduled || !this.renderer) return;
    this.scheduled = true;
    requestAnimationFrame(() => {
      this.scheduled = false;
      this.render();
    });
  }

  private render() {
    this.renderer!.render(this.drawing.scene, this.camera);
    for (const { at, label } of [...this.shown, ...this.standing]) {
      const { x, y } = this.onScreen(at);
      label.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    }
  }

  /** Pixels from the stage's upper left corner. */
  private onScreen(point: Vector3): Vector3 {
    const at = (this.machine?.onScene(point) ?? point.clone()).project(this.camera);
    at.x = ((at.x + 1) / 2) * this.stage.clientWidth;
    at.y = ((1 - at.y) / 2) * this.stage.clientHeight;
    return at;
  }

  private pick(canvas: HTMLCanvasElement) {
    const nearest = (event: PointerEvent): Marker | null => {
      const box = canvas.getBoundingClientRect();
      const reach = event.pointerType === "touch" ? 24 : 12;
      let best: Marker | null = null;
      let bestCost = Infinity;
      for (const marker of this.drawing.markers) {
        const at = this.onScreen(marker.surface.clone().lerp(marker.centre, 0.35));
        const distance = Math.hypot(at.x - event.clientX + box.left, at.y - event.clientY + box.top);
        // Of two in reach the one in front wins.
        const cost = distance + 10 * at.z;
        if (distance <= reach && cost < bestCost) [best, bestCost] = [marker, cost];
      }
      return best;
    };
    let down: PointerEvent | null = null;
    canvas.addEventListener("pointerdown", (event) => (down = event));
    canvas.addEventListener("pointermove", (event) => {
      if (event.buttons === 0) canvas.style.cursor = nearest(event) ? "pointer" : "";
    });
    canvas.addEventListener("pointerup", (event) => {
      if (!down || Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) > 4) return;
      const marker = nearest(event);
      if (marker) this.selector.select({ cycle: marker.cycle, touch: marker.touch }, "view");
    });
  }

  private showSelection(cycle: number | null, touch: number | null) {
    this.labels.replaceChildren(...this.standing.map(({ label }) => label));
    this.shown = [];
    const ofCycle = cycle === null ? [] : this.drawing.markers.filter((marker) => marker.cycle === cycle);
    // Numbers help with a handful of touches; with hundreds they only hide the part.
    if (ofCycle.length <= 40) {
      this.shown = ofCycle.map((marker) => {
        const label = h("span", { class: marker.touch === touch ? "label active" : "label" }, h("b", {}, String(marker.touch + 1)));
        this.labels.append(label);
        return { at: marker.tool < 0 ? marker.centre : marker.surface, label };
      });
    }
    const marker = touch === null ? undefined : ofCycle.find((candidate) => candidate.touch === touch);
    this.drawing.placeProbe(marker ? marker.centre : null, marker?.axis, marker?.tool);
    const time = marker && this.report.results.cycles[marker.cycle]?.touches[marker.touch]?.time;
    if (time != null && this.report.scene.path.seconds.length > 1) this.machine?.show(...this.pathPlace(time));
    this.fillCard(cycle, touch);
    // The card must not lie over what it tells about.
    const points = marker ? [marker] : ofCycle;
    const middle = points.reduce((sum, { centre }) => sum + this.onScreen(centre).x / points.length, 0);
    this.card.classList.toggle("left", middle > 0.56 * this.stage.clientWidth);
    this.draw();
  }

  private touchedByTool(cycle: number, touch: number | null): boolean {
    return this.drawing.markers.some((marker) => marker.cycle === cycle && marker.touch === touch && marker.tool >= 0);
  }

  private fillCard(cycleIndex: number | null, touchIndex: number | null) {
    const cycle = cycleIndex === null ? undefined : this.report.results.cycles[cycleIndex];
    this.card.hidden = !cycle;
    if (!cycle || cycleIndex === null) return;
    const touch = touchIndex === null ? undefined : cycle.touches[touchIndex];
    const row = (name: string, values: string | string[], kind = "") =>
      h("div", { class: kind }, h("dt", {}, name), h("dd", {}, ...[values].flat().map((value) => h("span", {}, value))));
    const point = (triple: Triple | undefined) => triple?.map((x) => fixed(x, 3)) ?? "\u2013";
    const step = (by: number) => {
      const n = cycle.touches.length;
      const next = touchIndex === null ? (by > 0 ? 0 : n - 1) : (touchIndex + by + n) % n;
      this.selector.select({ cycle: cycleIndex, touch: next }, "view");
    };
    const deviation = touch ? touchDeviation(touch) : null;
    this.card.replaceChildren(
      h(
        "header",
        {},
        h("div", {}, h("b", {}, `${cycle.name} ${cycle.title}`), h("br"), cycle.place.line > 0 ? `line ${cycle.place.line}` : ""),
        badge(cycleState(cycle), true),
        h("button", { type: "button", class: "plain-button", "aria-label": "Close", click: () => this.selector.select(null, "view") }, icon("cross")),
      ),
      ...(cycle.touches.length > 0
        ? [
            h(
              "nav",
              {},
              h("button", { type: "button", class: "plain-button", "aria-label": "Previous touch", click: () => step(-1) }, icon("previous")),
              h("span", {}, touch ? `Touch ${touchIndex! + 1} of ${cycle.touches.length}` : count(cycle.touches.length, "touch", "touches")),
              h("button", { type: "button", class: "plain-button", "aria-label": "Next touch", click: () => step(1) }, icon("next")),
            ),
          ]
        : []),
      ...(touch
        ? [
            h(
              "dl",
              {},
              row("Outcome", touch.outcome, touch.outcome === "touched" ? "" : "missed"),
              row("Target", point(touch.target)),
              ...(this.touchedByTool(cycleIndex, touchIndex)
                ? [row("Tool tip", point(touch.ballCentre))]
                : [row("Ball centre", point(touch.ballCentre)), row("Surface", point(touch.surface))]),
              row("Direction", point(touch.direction)),
              row("Deviation", deviation === null ? "\u2013" : `${fixed(deviation, 4, true)} mm`, "strong"),
              row("Axes", touch.axes ? Object.entries(touch.axes).map(([name, value]) => `${name} ${fixed(value, 3)}`) : "\u2013"),
              row("Time", duration(touch.time)),
            ),
          ]
        : []),
      h(
        "button",
        { type: "button", class: "card-link", click: () => this.selector.select({ cycle: cycleIndex, touch: touchIndex }, "card") },
        "Show the results",
      ),
    );
  }

  private toolbar(): HTMLElement {
    const button = (text: string, click: () => void) => h("button", { type: "button", click }, text);
    const toggle = (text: string, on: boolean, change: (on: boolean) => void) => {
      const element = h("button", { type: "button", "aria-pressed": String(on) }, text);
      element.addEventListener("click", () => {
        on = !on;
        element.setAttribute("aria-pressed", String(on));
        change(on);
        this.draw();
      });
      return element;
    };
    return h(
      "div",
      { class: "toolbar" },
      h(
        "div",
        { class: "group" },
        h("button", { type: "button", title: "Show everything", click: () => this.zoomTo(this.drawing.allCorners) }, icon("fit"), "Fit"),
        ...Object.keys(directions).map((name) => button(name, () => this.look(name))),
      ),
      h(
        "div",
        { class: "group" },
        toggle("X-ray", false, (on) => this.drawing.showXray(on)),
        toggle("Path", true, (on) => this.drawing.showPath(on)),
        toggle("Touches", true, (on) => this.drawing.showTouches(on)),
        ...(this.drawing.hasFixtures ? [toggle("Fixtures", true, (on) => this.drawing.showFixtures(on))] : []),
        ...this.machineButtons(toggle),
      ),
    );
  }

  private legend(): HTMLElement {
    const item = (kind: string, text: string) => h("span", {}, h("i", { class: `swatch ${kind}` }), text);
    return h("div", { class: "legend" }, item("rapid", "Rapid"), item("feed", "Feed"), item("measure", "Measuring"), item("dot", "Touch"), this.report.scene.collisions.length > 0 && item("collision", "Collision"));
  }

  /** The points of the path before and after that time, and the part of the way between them. */
  private pathPlace(time: number): [number, number, number] {
    const { seconds } = this.report.scene.path;
    let [low, high] = [0, seconds.length - 1];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (seconds[middle] <= time) low = middle;
      else high = middle;
    }
    const span = seconds[high] - seconds[low];
    return [low, high, span > 0 ? MathUtils.clamp((time - seconds[low]) / span, 0, 1) : 1];
  }

  /** The machine, drawn or not; with it either the part or the machine stands still. */
  private machineButtons(toggle: (text: string, on: boolean, change: (on: boolean) => void) => HTMLElement): HTMLElement[] {
    const { machine } = this;
    if (!machine) return [];
    const fill = (on: boolean) =>
      this.zoomTo(on ? [...machine.corners(), ...this.drawing.focusCorners.map((point) => machine.onScene(point))] : this.drawing.focusCorners);
    const standing = toggle("Axes move", false, (on) => {
      machine.keep(on ? "machine" : "part");
      fill(true);
    });
    standing.title = "The machine stands and its axes move; else the part stands still";
    standing.hidden = true;
    const drawn = toggle("Machine", false, (on) => {
      machine.draw(on);
      standing.hidden = !on;
      fill(on);
    });
    return [drawn, standing];
  }

  /** A slider over the machine's clock. */
  private replay(): HTMLElement | null {
    const { points, seconds, toolAxes, tools } = this.report.scene.path;
    const n = seconds.length;
    if (n < 2 || points.length < 3 * n) return null;
    const total = seconds[n - 1];
    const slider = h("input", { type: "range", min: 0, max: total, step: "any", value: 0, "aria-label": "Time of the run" });
    const clock = h("output", {}, duration(0));
    const vector = (array: Float32Array, i: number) => new Vector3().fromArray(array, 3 * i);
    const show = () => {
      const time = Number(slider.value);
      const [low, high, part] = this.pathPlace(time);
      const axis =
        toolAxes.length >= points.length ? vector(toolAxes, low).lerp(vector(toolAxes, high), part) : new Vector3(0, 0, 1);
      let tool = -1;
      for (let i = 0; i < tools.length && tools[i] <= low; i += 2) tool = tools[i + 1];
      this.drawing.placeProbe(vector(points, low).lerp(vector(points, high), part), axis, tool);
      this.machine?.show(low, high, part);
      clock.textContent = duration(time);
      this.draw();
    };
    slider.addEventListener("input", show);
    let playing = false;
    const button = h("button", { type: "button", class: "plain-button", "aria-label": "Replay" }, icon("play"));
    const set = (on: boolean) => {
      playing = on;
      button.replaceChildren(icon(on ? "pause" : "play"));
    };
    button.addEventListener("click", () => {
      set(!playing);
      if (!playing) return;
      if (Number(slider.value) >= total) slider.value = "0";
      let last = performance.now();
      // The whole run in about twenty seconds, but never slower than it was.
      const speed = Math.max(1, total / 20);
      const frame = (now: number) => {
        if (!playing) return;
        slider.value = String(Math.min(total, Number(slider.value) + (speed * (now - last)) / 1000));
        last = now;
        show();
        if (Number(slider.value) >= total) set(false);
        else requestAnimationFrame(frame);
      };
      requestAnimationFrame(frame);
    });
    return h("div", { class: "replay" }, button, slider, clock);
  }
}
