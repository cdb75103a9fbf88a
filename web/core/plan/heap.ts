// A queue of states by cost, the least first.

export class Heap {
  private readonly costs: number[] = [];
  private readonly states: number[] = [];

  push(cost: number, state: number): void {
    let at = this.costs.length;
    this.costs.push(cost);
    this.states.push(state);
    while (at > 0) {
      const up = (at - 1) >> 1;
      if (this.cost(up) <= this.cost(at)) break;
      this.swap(at, up);
      at = up;
    }
  }

  /** -1: it is empty. */
  pop(): number {
    const first = this.states[0];
    if (first === undefined) return -1;
    this.swap(0, this.costs.length - 1);
    this.costs.pop();
    this.states.pop();
    this.sink();
    return first;
  }

  private sink(): void {
    for (let at = 0; ;) {
      let least = at;
      for (const child of [2 * at + 1, 2 * at + 2])
        if (child < this.costs.length && this.cost(child) < this.cost(least)) least = child;
      if (least === at) return;
      this.swap(at, least);
      at = least;
    }
  }

  private cost(at: number): number {
    return this.costs[at] ?? Infinity;
  }

  private swap(a: number, b: number): void {
    const cost = this.costs[a] ?? 0;
    const state = this.states[a] ?? 0;
    this.costs[a] = this.costs[b] ?? 0;
    this.states[a] = this.states[b] ?? 0;
    this.costs[b] = cost;
    this.states[b] = state;
  }
}
