// Views of one kind that are open, the one that was used last at the end: forms and commands are
// about that one.

import { Emitter } from './emitter';

export class Desk<View> {
  readonly changed = new Emitter<void>();
  /** Someone works in a view. */
  readonly used = new Emitter<void>();
  private readonly views: View[] = [];

  /** The one that was used last. */
  get shown(): View | undefined {
    return this.views.at(-1);
  }

  find(is: (view: View) => boolean): View | undefined {
    return this.views.find(is);
  }

  add(view: View): () => void {
    // Below those that are there: a view comes to the top when it is used.
    this.views.unshift(view);
    this.changed.emit();
    return () => {
      this.views.splice(this.views.indexOf(view), 1);
      this.changed.emit();
    };
  }

  use(view: View): void {
    this.used.emit();
    const at = this.views.indexOf(view);
    if (this.shown === view || at < 0) return;
    this.views.splice(at, 1);
    this.views.push(view);
    this.changed.emit();
  }
}

/** One desk for each owner, made when it is first asked for. */
export function deskFor<Owner extends object, Made>(
  make: (owner: Owner) => Made,
): (owner: Owner) => Made {
  const desks = new WeakMap<Owner, Made>();
  return (owner) => {
    const known = desks.get(owner);
    if (known) return known;
    const made = make(owner);
    desks.set(owner, made);
    return made;
  };
}
