// The 3D view: camera, buttons, picking of touches, labels.

import { OrthographicCamera, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

import type { Report } from "./data";
import { fixed, h, icon, toggleButton } from "./dom";
import { t } from "./language";
import { MachineLayer } from "./machine";
import { deviationColour } from "./overlays";
import { Replay } from "./replay";
import { Drawing, type Marker, type Palette } from "./scene";
import type { Selector } from "./selection";
import { fillCard } from "./touch_card";
import { freePlace, parted } from "./view_places";

const directions = {
  top: new Vector3(0, 0, 1),
  front: new Vector3(0, -1, 0),
  right: new Vector3(1, 0, 0),
  iso: new Vector3(0.62, -0.85, 0.68),
};
/** As a turner sees it: X up, Z to the right. */
const latheDirections = {
  turning: new Vector3(0, 1, 0),
  top: new Vector3(1, 0, 0),
  right: new Vector3(0, 0, 1),
  iso: new Vector3(0.5, 0.8, 0.42),
};
type Direction = keyof typeof directions | keyof typeof latheDirections;

/** Magnifications of deviations: 10 to 5000 in even steps of the slider. */
const magnificationAt = (step: number) => {
  const power = 10 ** Math.floor(step / 3);
  return [1, 2, 5][step % 3] * 10 * power;
};
const lastStep = 8;

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
  /** How long something in the picture is; all places are equally far away. */
  private readonly scaleBar = h("div", { class: "scale-bar", hidden: true }, h("span", {}));
  /** What the colours of the arrows mean. */
  private readonly colourScale = h("div", { class: "group colour-scale", hidden: true });
  private readonly card = h("aside", { class: "touch-card", hidden: true });
  private readonly toolbarElement: HTMLElement;
  readonly replay: Replay;
  private readonly directions: Partial<Record<Direction, Vector3>>;
  private followsSelection = true;
  private readonly camera = new OrthographicCamera(-1, 1, 1, -1, 0.1, 1000);
  private readonly drawing: Drawing;
  /** The machine around it; null: nothing of it is known. */
  private readonly machine: MachineLayer | null;
  private renderer: WebGLRenderer | null = null;
  private controls: OrbitControls | null = null;
  /** What the view was filled with last, until the reader moves it: a page that changes its size fills it anew. */
  private filledBy: Vector3[] | null = null;
  private scheduled = false;
  private starting = false;
  private looked = false;
  private shown: { at: Vector3; label: HTMLElement }[] = [];
  /** The names of the axes, and what stands at a collision. */
  private readonly standing: { at: Vector3; label: HTMLElement }[];
  private arrowEnds: { at: Vector3; label: HTMLElement }[] = [];
  private readonly observer: ResizeObserver;

  constructor(
    private readonly report: Report,
    private readonly selector: Selector,
    showLine: (file: string, line: number) => void,
  ) {
    this.drawing = new Drawing(report);
    this.machine = report.scene.machine ? new MachineLayer(report.scene.machine, report.scene.path.axes, this.drawing.scene) : null;
    const { lathe } = report.scene;
    this.directions = lathe ? latheDirections : directions;
    this.camera.up.set(lathe ? 1 : 0, 0, lathe ? 0 : 1);
    this.replay = new Replay(report, selector, {
      line: showLine,
      place: ({ tip, axis, tool, move, part }) => {
        this.drawing.placeProbe(new Vector3(...tip), new Vector3(...axis), tool);
        this.machine?.show(move, move + 1, part);
        this.draw();
      },
    });
    this.standing = [
      ...this.drawing.axisEnds.map(({ name, at }) => ({ at, label: h("span", { class: "axis" }, h("b", {}, name)) })),
      ...report.scene.collisions.map(({ at, what, solid }) => ({
        at: new Vector3().fromArray(at),
        label: h("span", { class: "label collision" }, h("b", {}, t("collisionOf", { what, solid }))),
      })),
      ...this.drawing.ghosts.map(({ at, kind }) => ({ at, label: h("span", { class: `label ghost ${kind}` }, h("b", {}, t(kind))) })),
    ];
    this.toolbarElement = this.toolbar();
    this.element = h(
      "section",
      { class: "card view", id: "view", "aria-label": t("view") },
      h("div", { class: "stage-area" }, this.stage, this.toolbarElement, this.legend(), this.scaleBar, this.card),
      this.replay.element,
    );
    selector.listen((selection, source) => this.showSelection(selection?.cycle ?? null, selection?.touch ?? null, source));
    // The page decides the size; drawing starts with the first one.
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(this.stage);
  }

  /** Gives back what the graphics card holds. */
  dispose() {
    this.observer.disconnect();
    this.controls?.dispose();
    this.renderer?.dispose();
    this.renderer?.forceContextLoss();
  }

  private start(): boolean {
    try {
      this.renderer = new WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
    } catch {
      this.stage.append(
        h("p", { class: "empty" }, t("noGraphics")),
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
    this.drawArrows();
    this.replay.drawMarks();
    // At once: a page about to be printed waits for no frame.
    if (this.renderer) this.render();
  }

  /** Starts the graphics, if they have not yet. */
  ensureStarted() {
    if (this.renderer || this.stage.childElementCount > 0 || !this.element.isConnected || !this.start()) return;
    this.resize();
  }

  private resize() {
    const { clientWidth: width, clientHeight: height } = this.stage;
    if (width === 0 || height === 0) return;
    if (!this.renderer) {
      // The lists first: they can be read while the graphics start.
      if (!this.starting) requestAnimationFrame(() => setTimeout(() => this.ensureStarted()));
      this.starting = true;
      return;
    }
    this.setSize(width, height);
    if (!this.looked) this.look(this.report.scene.lathe ? "turning" : "iso");
    else if (this.filledBy) this.zoomTo(this.filledBy);
    // At once, not in the next frame: setting the size has emptied the canvas.
    this.render();
  }

  private look(name: Direction) {
    const direction = this.directions[name];
    if (!this.controls || !direction) return;
    const { center, radius } = this.drawing.sphere;
    const reach = Math.max(radius, this.drawing.everything.radius + this.drawing.everything.center.distanceTo(center));
    const towards = direction.clone().normalize();
    // Looking along what points up, a hair off keeps the part's Y (a lathe's Z) where it belongs.
    if (Math.abs(towards.dot(this.camera.up)) > 0.999) towards.add(this.report.scene.lathe ? new Vector3(0, 1e-4, 0) : new Vector3(0, -1e-4, 0));
    this.controls.target.copy(center);
    this.camera.position.copy(center).addScaledVector(towards, 20 * reach);
    // A machine reaches far beyond its part.
    this.camera.near = this.machine ? -60 * reach : reach;
    this.camera.far = 60 * reach;
    this.looked = true;
    this.zoomTo(this.drawing.focusCorners);
  }

  fit() {
    this.zoomTo(this.drawing.allCorners);
  }

  /** The part from where the reader looks, filled by what a cycle touched; null without graphics. */
  pictureOf(cycle: number | null, width: number, height: number): HTMLCanvasElement | null {
    this.ensureStarted();
    if (!this.renderer || !this.controls || !this.looked) return null;
    const before = { zoom: this.camera.zoom, position: this.camera.position.clone(), target: this.controls.target.clone(), filledBy: this.filledBy };
    const size = { width: this.stage.clientWidth, height: this.stage.clientHeight };
    const corners = cycle === null ? this.drawing.focusCorners : this.drawing.cornersOfCycle(cycle);
    this.setSize(width, height);
    if (corners.length > 0) this.zoomTo(corners, "whole");
    this.renderer.render(this.drawing.scene, this.camera);
    const canvas = this.renderer.domElement;
    const still = h("canvas", { width: canvas.width, height: canvas.height });
    still.getContext("2d")!.drawImage(canvas, 0, 0);
    this.setSize(size.width, size.height);
    this.camera.zoom = before.zoom;
    this.camera.position.copy(before.position);
    this.controls.target.copy(before.target);
    this.filledBy = before.filledBy;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.render();
    return still;
  }

  private setSize(width: number, height: number) {
    if (width === 0 || height === 0) return;
    this.renderer!.setSize(width, height);
    this.camera.left = -width / height;
    this.camera.right = width / height;
    this.camera.updateProjectionMatrix();
  }

  toggleDeviations() {
    this.deviationButton?.click();
  }

  private drawArrows() {
    const { deviations } = this.drawing;
    const colours = palette();
    const ends = deviations.draw(colours, this.drawing.sphere.radius);
    this.colourScale.hidden = ends.length === 0;
    if (ends.length > 0) {
      const most = `${fixed(1000 * deviations.most, deviations.most < 0.01 ? 1 : 0)}\u00a0\u00b5m`;
      const ramp = h("i", {});
      ramp.style.background = `linear-gradient(to right, ${[-1, -0.001, 0.001, 1].map((share) => deviationColour(colours, share).getStyle()).join(", ")})`;
      this.colourScale.title = t("deviationColours");
      this.colourScale.replaceChildren(h("span", {}, `\u2212${most}`), ramp, h("span", {}, `+${most}`));
    }
    for (const { label } of this.arrowEnds) label.remove();
    // Texts help with a handful of arrows only.
    this.arrowEnds = ends.length > 40 ? [] : ends.map(({ at, deviation }) => ({ at, label: h("span", { class: "label arrow" }, h("b", {}, fixed(deviation, 4, true))) }));
    this.labels.append(...this.arrowEnds.map(({ label }) => label));
    this.draw();
  }

  /** Moves and zooms so that these points fill the view, with room for what lies over its edges, beside the card or as if there were none. */
  private zoomTo(points: Vector3[], how: "beside" | "whole" = "beside") {
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
    const { zoom, middle } = freePlace({ width, height }, this.camera.right, this.stage, how === "beside" && !this.card.hidden ? [this.toolbarElement, this.card] : null);
    this.camera.zoom = zoom;
    // The middle of what is shown goes to the middle of the free place.
    const off = new Vector3();
    [middle.x, middle.y].forEach((place, column) => off.addScaledVector(new Vector3().setFromMatrixColumn(this.camera.matrixWorld, column), -place / zoom));
    this.controls.target.add(off);
    this.camera.position.add(off);
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
    this.showScale();
    parted(this.standing, (at) => this.onScreen(at).x);
    for (const { at, label } of [...this.shown, ...this.standing, ...this.arrowEnds]) {
      const { x, y } = this.onScreen(at);
      label.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    }
  }

  /** A round length that takes a good inch of the screen. */
  private showScale() {
    const pixelsPerMm = (this.stage.clientHeight * this.camera.zoom) / 2;
    this.scaleBar.hidden = !(pixelsPerMm > 0 && Number.isFinite(pixelsPerMm));
    if (this.scaleBar.hidden) return;
    const power = 10 ** Math.floor(Math.log10(120 / pixelsPerMm));
    const length = [5, 2, 1].map((step) => step * power).find((step) => step * pixelsPerMm <= 120) ?? power;
    this.scaleBar.style.width = `${(length * pixelsPerMm).toFixed(1)}px`;
    this.scaleBar.firstElementChild!.textContent = `${Number(length.toPrecision(1))} mm`;
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

  private showSelection(cycle: number | null, touch: number | null, source: string) {
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
    if (source !== "replay") this.drawing.placeProbe(marker ? marker.centre : null, marker?.axis, marker?.tool);
    const time = marker && this.report.results.cycles[marker.cycle]?.touches[marker.touch]?.time;
    if (time != null && source !== "replay" && this.replay.clock.canReplay) {
      const { move, part } = this.replay.clock.tipAt(time);
      this.machine?.show(move, move + 1, part);
    }
    this.drawing.deviations.show(cycle);
    this.drawArrows();
    fillCard(this.card, this.report, this.selector, marker !== undefined && marker.tool >= 0);
    const zooms = this.followsSelection && cycle !== null && source !== "view" && source !== "replay";
    const corners = zooms ? this.drawing.cornersOfCycle(cycle) : [];
    // The card must not lie over what it tells about: what is zoomed to goes beside it.
    if (corners.length > 0) {
      this.card.classList.remove("left");
      this.zoomTo(corners.map((point) => this.machine?.onScene(point) ?? point));
    }
    const points = marker ? [marker] : ofCycle;
    const middle = points.reduce((sum, { centre }) => sum + this.onScreen(centre).x / points.length, 0);
    if (corners.length === 0) this.card.classList.toggle("left", middle > 0.56 * this.stage.clientWidth);
    this.draw();
  }

  private deviationButton: HTMLElement | null = null;

  private toolbar(): HTMLElement {
    const button = (text: string, click: () => void) => h("button", { type: "button", click }, text);
    const toggle = (text: string, on: boolean, change: (on: boolean) => void) =>
      toggleButton(text, on, (now) => {
        change(now);
        this.draw();
      });
    const { deviations } = this.drawing;
    const usual = 3;
    deviations.magnification = magnificationAt(usual);
    const slider = h("input", { type: "range", min: 0, max: lastStep, step: 1, value: usual, "aria-label": t("magnification") });
    const times = h("output", {}, `${deviations.magnification}\u00d7`);
    const magnifier = h("div", { class: "group magnifier", hidden: true, title: t("magnification") }, slider, times);
    slider.addEventListener("input", () => {
      deviations.magnification = magnificationAt(Number(slider.value));
      times.textContent = `${deviations.magnification}\u00d7`;
      this.drawArrows();
    });
    this.deviationButton = toggle(t("deviations"), false, (on) => {
      deviations.on = on;
      magnifier.hidden = !on;
      this.drawArrows();
    });
    return h(
      "div",
      { class: "toolbar" },
      h(
        "div",
        { class: "group" },
        h("button", { type: "button", title: `${t("showEverything")} (F)`, click: () => this.fit() }, icon("fit"), t("fit")),
        ...(Object.keys(this.directions) as Direction[]).map((name) => button(t(name), () => this.look(name))),
      ),
      h(
        "div",
        { class: "group" },
        toggle(t("xray"), false, (on) => this.drawing.showXray(on)),
        ...(this.hasPath ? [toggle(t("paths"), true, (on) => this.drawing.showPath(on))] : []),
        toggle(t("touchesToggle"), true, (on) => this.drawing.showTouches(on)),
        ...(this.drawing.hasFixtures ? [toggle(t("fixtures"), true, (on) => this.drawing.showFixtures(on))] : []),
        ...this.machineButtons(toggle),
      ),
      h("div", { class: "group" }, toggle(t("follow"), true, (on) => (this.followsSelection = on)), this.deviationButton),
      magnifier,
      this.colourScale,
    );
  }

  /** The machine, drawn or not; with it either the part or the machine stands still. */
  private machineButtons(toggle: (text: string, on: boolean, change: (on: boolean) => void) => HTMLElement): HTMLElement[] {
    const { machine } = this;
    if (!machine) return [];
    const fill = (on: boolean) =>
      this.zoomTo(on ? [...machine.corners(), ...this.drawing.focusCorners.map((point) => machine.onScene(point))] : this.drawing.focusCorners);
    const standing = toggle(t("axesMove"), false, (on) => {
      machine.keep(on ? "machine" : "part");
      fill(true);
    });
    standing.title = t("axesMoveTitle");
    standing.hidden = true;
    const drawn = toggle(t("machine"), false, (on) => {
      machine.draw(on);
      standing.hidden = !on;
      fill(on);
    });
    return [drawn, standing];
  }

  /** A blind run tells no way. */
  private get hasPath(): boolean {
    return this.report.scene.path.points.length > 3;
  }

  private legend(): HTMLElement {
    const item = (kind: string, text: string) => h("span", {}, h("i", { class: `swatch ${kind}` }), text);
    const { scene } = this.report;
    const states = new Set(this.drawing.markers.map(({ cycle, touch }) => this.drawing.stateOf(cycle, touch)));
    const words = { good: "good", rework: "rework", scrap: "scrap", alarm: "missedLegend", none: "touchLegend" } as const;
    return h(
      "div",
      { class: "legend" },
      ...(this.hasPath ? [item("rapid", t("rapid")), item("feed", t("feed")), item("measure", t("measuring"))] : []),
      ...(["good", "rework", "scrap", "none", "alarm"] as const).filter((state) => states.has(state)).map((state) => item(`dot ${state}`, t(words[state]))),
      scene.collisions.length > 0 && item("collision", t("collision")),
    );
  }
}
