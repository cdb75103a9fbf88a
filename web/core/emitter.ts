// A list of listeners. The only way in core to tell others that something happened.

export class Emitter<T> {
  /** How often something has happened: what looks later sees whether it missed anything. */
  count = 0;
  private readonly listeners = new Set<(value: T) => void>();

  on(listener: (value: T) => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  emit(value: T): void {
    this.count++;
    for (const listener of [...this.listeners]) listener(value);
  }
}
