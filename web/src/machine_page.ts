// The page of a machine: its bodies, a slider for each axis, and which way positive is.

import "./colours.css";
import "./basics.css";
import "./machine_page.css";

import { Vector3 } from "three";

import { fixed, h, icon, toggleButton } from "./dom";
import { elementOf, linkPose, tableLink, headLink, chainNames, type Machine } from "./links";
import { MachineView, toolLength } from "./machine_view";

interface Data extends Machine {
  file: string;
  remarks: string[];
}

/** "+X", "-Z", or the numbers of a direction that is none of the axes. */
function directionName(direction: Vector3): string {
  const letters = ["X", "Y", "Z"];
  for (let i = 0; i < 3; ++i) {
    if (Math.abs(direction.getComponent(i)) > 0.9999) return (direction.getComponent(i) > 0 ? "+" : "\u2212") + letters[i];
  }
  return `[${direction.toArray().map((value) => fixed(value, 3)).join(" ")}]`;
}

/** What happens when the axis goes to plus, in words. */
function positiveText(machine: Machine, axis: number): string {
  const found = elementOf(machine, axis);
  if (!found) return "moves nothing";
  const own = new Vector3().fromArray(found.element.direction);
  const { rotary } = machine.axes[axis];
  const verb = rotary ? "turns about" : "moves towards";
  const tool = `tool ${verb} ${directionName(found.chain === "table" ? own.clone().negate() : own)}`;
  return found.chain === "table" ? `${tool}: the workpiece ${verb} ${directionName(own)}` : tool;
}

function axisRow(data: Data, axis: number, read: () => number[], set: (axis: number, value: number) => void) {
  const { name, rotary, minimum, maximum, modulo, home } = data.axes[axis];
  const [low, high] = modulo ? [-180, 180] : [minimum, maximum];
  const unit = rotary ? "\u00b0" : "mm";
  const step = rotary ? 1 : Math.max(1, Math.round((high - low) / 500));
  const slider = h("input", { type: "range", min: low, max: high, step: "any", "aria-label": `Axis ${name}`, id: `axis-${name}` });
  const field = h("input", { type: "number", min: low, max: high, step: "any", "aria-label": `Position of ${name}` });
  const text = (value: number) => value.toFixed(3).replace(/\.?0+$/, "").replace(/^-0$/, "0");
  // Without end stops 270 is -90, with them the axis stops at its end.
  const within = (value: number) => (modulo && Math.abs(value) > 180 ? value - 360 * Math.round(value / 360) : Math.min(high, Math.max(low, value)));
  const go = (value: number) => set(axis, within(value));
  slider.addEventListener("input", () => go(Number(slider.value)));
  // Steps of a size that is seen; with Shift ten of them.
  slider.addEventListener("keydown", (event) => {
    const sign = ["ArrowRight", "ArrowUp"].includes(event.key) ? 1 : ["ArrowLeft", "ArrowDown"].includes(event.key) ? -1 : 0;
    if (sign === 0) return;
    event.preventDefault();
    go(read()[axis] + sign * step * (event.shiftKey ? 10 : 1));
  });
  // What is no number moves nothing; afterwards the field says where the axis is.
  field.addEventListener("change", () => {
    if (Number.isFinite(field.valueAsNumber)) go(field.valueAsNumber);
    field.value = text(read()[axis]);
  });
  const show = () => {
    const value = read()[axis];
    slider.value = String(value);
    if (document.activeElement !== field) field.value = text(value);
  };
  const element = h(
    "div",
    { class: "axis", "data-axis": name },
    h("b", { class: `letter ${rotary ? "rotary" : "linear"}` }, name),
    slider,
    h("span", { class: "place" }, field, unit),
    h("button", { type: "button", title: `${name} to where tools are changed`, "aria-label": `${name} to ${home}`, click: () => go(home) }, "Home"),
    h("p", {}, `+ : ${positiveText(data, axis)}. `, modulo ? "Turns without end." : `Travel ${low} to ${high} ${unit}.`),
  );
  return { element, show };
}

function main() {
  const data = JSON.parse(document.getElementById("machine-data")!.textContent!) as Data;
  const q = data.axes.map(({ home }) => home);
  const root = document.documentElement;
  const view = new MachineView(data);
  const output = h("output", { class: "tip" });

  const rows = data.axes.map((_, axis) =>
    axisRow(
      data,
      axis,
      () => q,
      (index, value) => {
        q[index] = value;
        update();
      },
    ),
  );
  const update = () => {
    rows.forEach(({ show }) => show());
    view.move(q);
    const tip = new Vector3(0, 0, -toolLength).applyMatrix4(linkPose(data, headLink(data), q));
    const onTable = tip.clone().applyMatrix4(linkPose(data, tableLink(data), q).invert());
    const text = (point: Vector3) => `X ${fixed(point.x, 3)}  Y ${fixed(point.y, 3)}  Z ${fixed(point.z, 3)}`;
    output.replaceChildren(
      h("span", {}, `Tip of a tool of ${toolLength} mm, base frame`),
      h("b", { id: "tip-base" }, text(tip)),
      h("span", {}, "the same, table frame"),
      h("b", { id: "tip-table" }, text(onTable)),
    );
  };
  const all = (values: (axis: number) => number) => {
    data.axes.forEach(({ minimum, maximum, modulo }, axis) => {
      q[axis] = modulo ? values(axis) : Math.min(maximum, Math.max(minimum, values(axis)));
    });
    update();
  };
  const button = (text: string, title: string, click: () => void) => h("button", { type: "button", title, click }, text);

  const dark = matchMedia("(prefers-color-scheme: dark)");
  const setTheme = (theme: string) => {
    root.dataset.theme = theme;
    view.colour();
  };
  dark.addEventListener("change", () => setTheme(dark.matches ? "dark" : "light"));

  const chain = (name: string, chain: "table" | "spindle", end: string) =>
    h("p", {}, h("b", {}, name), " ", [...chainNames(data, chain), end].join(" \u2192 "));
  document.getElementById("machine")!.append(
    h(
      "header",
      {},
      h("div", {}, h("p", { class: "kicker" }, "Machine"), h("h1", {}, data.name), h("p", { class: "quiet" }, data.file)),
      h("div", { class: "chains" }, chain("Workpiece", "table", "table"), chain("Tool", "spindle", "head")),
      h("button", { type: "button", title: "Light or dark", "aria-label": "Light or dark", click: () => setTheme(root.dataset.theme === "dark" ? "light" : "dark") }, icon("sun")),
    ),
    ...(data.remarks.length > 0
      ? [h("section", { class: "remarks", role: "status" }, ...data.remarks.map((remark) => h("p", {}, icon("warning"), remark)))]
      : []),
    h(
      "main",
      {},
      h(
        "section",
        { class: "card view", "aria-label": "3D view" },
        view.element,
        h(
          "div",
          { class: "toolbar" },
          ...["Iso", "Front", "Right", "Top"].map((name) => button(name, `Look from ${name.toLowerCase()}`, () => view.look(name))),
          toggleButton("X-ray", false, (on) => view.showXray(on)),
          toggleButton("Arrows", true, (on) => view.showArrows(on)),
          toggleButton("Frames", true, (on) => view.showFrames(on)),
        ),
        h(
          "p",
          { class: "quiet hint" },
          "Arrows: which way things go when an axis goes to plus. Letters with a prime, C\u2032, are those of the workpiece (ISO 841): the tool goes the other way as seen from there.",
        ),
      ),
      h(
        "section",
        { class: "card axes", "aria-label": "Axes" },
        h("h2", {}, "Axes"),
        ...rows.map(({ element }) => element),
        h(
          "div",
          { class: "buttons" },
          button("All 0", "All axes to 0, or as near as they come", () => all(() => 0)),
          button("Tool change", "All axes to where tools are changed", () => all((axis) => data.axes[axis].home)),
        ),
        output,
        h("h2", {}, "Bodies"),
        h("ul", { class: "bodies" }, ...bodiesOf(data)),
      ),
    ),
  );
  setTheme(dark.matches ? "dark" : "light");
  update();
}

function bodiesOf(data: Data): HTMLElement[] {
  if (data.bodies.length === 0) return [h("li", { class: "quiet" }, "none: [[body]] of the machine file describes them")];
  const carried = new Map<string, string>();
  for (const body of data.bodies) carried.set(body.name, body.elements === 0 ? "bed" : chainNames(data, body.chain)[body.elements]);
  return [...carried].map(([name, link]) => h("li", {}, h("b", {}, link), " ", name));
}

main();
