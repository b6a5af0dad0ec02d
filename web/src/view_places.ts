// Where things go in the picture, beside what lies over it.

import type { Vector3 } from "three";

interface FreePlace {
  zoom: number;
  /** As the camera counts without zoom: 1 is half the height of the stage, from its middle, up and to the right. */
  middle: { x: number; y: number };
}

/**
 * The part of the stage in which something of this size (mm) becomes largest. `right`: half the width of the stage as the camera counts.
 * `over`: the toolbar at its top and the card that lies over it; null: nothing does.
 */
export function freePlace(size: { width: number; height: number }, right: number, stage: HTMLElement, over: [HTMLElement, HTMLElement] | null): FreePlace {
  const zoomIn = (width: number, height: number) => Math.min(width / (1.15 * size.width), height / (1.35 * size.height));
  const whole = { zoom: zoomIn(2 * right, 2), middle: { x: 0, y: 0 } };
  const area = stage.getBoundingClientRect();
  if (!over || area.height === 0) return whole;
  const [toolbar, card] = over.map((element) => element.getBoundingClientRect());
  const top = Math.min(toolbar.bottom, area.top + area.height / 2);
  const { left, right: end, bottom } = area;
  const perPixel = 2 / area.height;
  const places = [
    { left, right: card.left, top, bottom },
    { left: card.right, right: end, top, bottom },
    { left, right: end, top: Math.max(top, card.bottom), bottom },
    { left, right: end, top, bottom: card.top },
  ].map((place) => ({
    zoom: zoomIn(perPixel * Math.max(0, place.right - place.left), perPixel * Math.max(0, place.bottom - place.top)),
    middle: { x: (perPixel * (place.left + place.right - left - end)) / 2, y: (perPixel * (area.top + bottom - place.top - place.bottom)) / 2 },
  }));
  const best = places.reduce((a, b) => (b.zoom > a.zoom ? b : a));
  return best.zoom > 0 ? best : whole;
}

/** The names of two ghosts, what was expected and what is true, go to their outer sides. */
export function parted(labels: { at: Vector3; label: HTMLElement }[], across: (at: Vector3) => number) {
  const ghosts = labels.filter(({ label }) => label.classList.contains("ghost")).map(({ at, label }) => ({ x: across(at), label }));
  ghosts.sort((a, b) => a.x - b.x);
  ghosts.forEach(({ label }, i) => label.classList.toggle("to-left", i < ghosts.length / 2 && ghosts.length > 1));
}
