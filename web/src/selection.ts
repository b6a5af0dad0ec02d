// What the reader looks at: a cycle, or one touch of it. Every view listens and follows.

export interface Selection {
  cycle: number;
  touch: number | null;
}

type Listener = (selection: Selection | null, source: string) => void;

export class Selector {
  private listeners: Listener[] = [];
  private current: Selection | null = null;

  get value(): Selection | null {
    return this.current;
  }

  listen(listener: Listener) {
    this.listeners.push(listener);
  }

  /** `source` names the view the reader clicked in; that view does not scroll. */
  select(selection: Selection | null, source: string) {
    this.current = selection;
    for (const listener of this.listeners) listener(selection, source);
  }
}
