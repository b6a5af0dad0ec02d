// A long list of rows of which only those in sight are elements of the page. Heights are guessed and then measured.

import { h } from "./dom";

export interface Item {
  key: string;
  /** Guessed, in pixels. */
  height: number;
  build(): HTMLElement;
}

/** Pixels above and below what is seen. */
const margin = 300;

export class VirtualList {
  readonly element: HTMLElement;
  private readonly space = h("div", { class: "virtual-space", role: "rowgroup" });
  private items: Item[] = [];
  private tops = new Float64Array(1);
  private readonly measured = new Map<string, number>();
  private readonly rows = new Map<string, HTMLElement>();
  private places = new Map<string, number>();
  private scheduled = false;
  private width = 0;

  /** `head` stays at the top while the rows scroll. */
  constructor(attributes: Record<string, string>, head: HTMLElement | null = null) {
    this.element = h("div", { ...attributes, tabindex: 0 }, head, this.space);
    this.element.addEventListener("scroll", () => this.schedule(), { passive: true });
    new ResizeObserver(() => {
      if (this.element.clientWidth !== this.width) {
        this.width = this.element.clientWidth;
        this.measured.clear();
        this.layOut();
      }
      this.render();
    }).observe(this.element);
  }

  setItems(items: Item[]) {
    this.items = items;
    this.places = new Map(items.map((item, i) => [item.key, i]));
    for (const row of this.rows.values()) row.remove();
    this.rows.clear();
    this.layOut();
    this.render();
  }

  /** Rows are built anew when they are seen next. */
  refresh(key: string) {
    this.rows.get(key)?.remove();
    this.rows.delete(key);
    this.schedule();
  }

  /** Calls back for every row that is in the page. */
  eachRow(change: (key: string, row: HTMLElement) => void) {
    for (const [key, row] of this.rows) change(key, row);
  }

  /** Brings a row into sight; with `rows` after it as far as there is room. */
  show(key: string, lastKey = key) {
    const [first, last] = [this.places.get(key), this.places.get(lastKey)];
    if (first === undefined) return;
    const view = this.element.clientHeight - this.headHeight;
    // What lies between may have been guessed only: once drawn it is known.
    for (let pass = 0; pass < 3; ++pass) {
      const top = this.tops[first];
      const bottom = this.tops[(last ?? first) + 1];
      const at = this.element.scrollTop;
      if (top < at || bottom - top > view) this.element.scrollTop = Math.max(0, top);
      else if (bottom > at + view) this.element.scrollTop = bottom - view;
      this.render();
    }
  }

  private get headHeight(): number {
    return this.space.offsetTop;
  }

  private layOut() {
    const tops = new Float64Array(this.items.length + 1);
    this.items.forEach((item, i) => (tops[i + 1] = tops[i] + (this.measured.get(item.key) ?? item.height)));
    this.tops = tops;
    this.space.style.height = `${tops[this.items.length]}px`;
  }

  private schedule() {
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame(() => {
      this.scheduled = false;
      this.render();
    });
  }

  /** The item at this height. */
  private at(y: number): number {
    let [low, high] = [0, this.items.length];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.tops[middle] <= y) low = middle;
      else high = middle;
    }
    return low;
  }

  private render() {
    if (this.element.clientHeight === 0) return;
    const top = this.element.scrollTop;
    const first = this.at(Math.max(0, top - margin));
    const last = Math.min(this.items.length, this.at(top + this.element.clientHeight + margin) + 1);
    const wanted = new Set<string>();
    for (let i = first; i < last; ++i) {
      const item = this.items[i];
      wanted.add(item.key);
      let row = this.rows.get(item.key);
      if (!row) {
        row = item.build();
        row.classList.add("virtual-row");
        row.setAttribute("aria-rowindex", String(i + 1));
        this.rows.set(item.key, row);
        this.space.append(row);
      }
      row.style.transform = `translateY(${this.tops[i]}px)`;
    }
    for (const [key, row] of this.rows) {
      if (wanted.has(key) || row.contains(document.activeElement)) continue;
      row.remove();
      this.rows.delete(key);
    }
    this.measure(first, last, top);
  }

  private measure(first: number, last: number, top: number) {
    let moved = 0;
    let changed = false;
    for (let i = first; i < last; ++i) {
      const { key, height } = this.items[i];
      const now = this.rows.get(key)?.offsetHeight;
      const before = this.measured.get(key) ?? height;
      if (now === undefined || now === before) continue;
      this.measured.set(key, now);
      changed = true;
      if (this.tops[i + 1] <= top) moved += now - before;
    }
    if (!changed) return;
    this.layOut();
    // What the reader looks at stays where it is.
    if (moved !== 0) this.element.scrollTop = top + moved;
    for (let i = first; i < last; ++i) {
      const row = this.rows.get(this.items[i].key);
      if (row) row.style.transform = `translateY(${this.tops[i]}px)`;
    }
  }
}
