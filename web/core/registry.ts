// The one list of what a person can do. Palette, menus, keys and help are made from it.

import { Emitter } from './emitter';
import { normalKey, pressedKeys, typesText, type KeyPress } from './keys';

export interface Command {
  id: string;
  title: string;
  group: string;
  keys?: string[];
  /** Its keys count only while the focus is in a place of that name (data-place). */
  within?: string;
  /** The browser makes an event of its own of its keys, which does it: they are only shown. */
  keysAreEvents?: boolean;
  /** Why not now, or true. Without it the command is always there. */
  enabled?(): boolean;
  /** Why not, where the words of its id do not say it; '': they do. */
  why?(): string;
  /** Not offered in the palette: it makes sense only at its place. */
  hidden?: boolean;
  run(): void | Promise<void>;
}

export class Registry {
  readonly changed = new Emitter<void>();
  readonly failed = new Emitter<unknown>();
  /** Why a command cannot be run now, in a sentence; '' if it can. */
  whyNot: (command: Command) => string = ({ id }) => (this.isEnabled(id) ? '' : id);
  /** Says why the key of a command does nothing now; false: the key is somebody else's. */
  refuse: (command: Command, key: string) => boolean = () => false;
  private readonly commands = new Map<string, Command>();
  private snapshot: readonly Command[] = [];
  /** The keyboard has Option where others have Alt. */
  isApple = false;

  /** Adds commands until the returned function is called. The last one of an id counts. */
  add(commands: readonly Command[]): () => void {
    for (const command of commands) this.commands.set(command.id, command);
    this.refresh();
    return () => {
      for (const command of commands) {
        if (this.commands.get(command.id) === command) this.commands.delete(command.id);
      }
      this.refresh();
    };
  }

  list(): readonly Command[] {
    return this.snapshot;
  }

  find(id: string): Command | undefined {
    return this.commands.get(id);
  }

  isEnabled(id: string): boolean {
    const command = this.commands.get(id);
    return command !== undefined && (command.enabled?.() ?? true);
  }

  run(id: string): boolean {
    const command = this.commands.get(id);
    if (!command || !(command.enabled?.() ?? true)) return false;
    void this.attempt(command);
    return true;
  }

  /** Runs what a key is for. typing: the focus is in a text; isWithin: it is in a place. */
  press(
    press: KeyPress,
    typing: boolean,
    isWithin: (place: string) => boolean = () => false,
  ): boolean {
    for (const pressed of pressedKeys(press, this.isApple)) {
      if (typing && typesText(pressed)) continue;
      const meant = this.meantBy(pressed, isWithin);
      if (meant.some((command) => this.run(command.id))) return true;
      if (meant[0] && this.refuse(meant[0], pressed)) return true;
    }
    return false;
  }

  private meantBy(pressed: string, isWithin: (place: string) => boolean): Command[] {
    return this.snapshot.filter(
      ({ within, keysAreEvents, keys }) =>
        (within === undefined || isWithin(within)) &&
        !keysAreEvents &&
        keys?.some((key) => normalKey(key) === pressed),
    );
  }

  private async attempt(command: Command): Promise<void> {
    try {
      await command.run();
    } catch (problem) {
      this.failed.emit(problem);
    }
  }

  private refresh(): void {
    // Newest first: what a panel adds comes before what the window offers for the same key.
    this.snapshot = [...this.commands.values()].reverse();
    this.changed.emit();
  }
}
