const kTries = 120;

/**
 * Gives something the keyboard: `focus` tries it and tells whether it has it. What is in a tab
 * that comes to the front just now can have it only once it is shown; then `late` is called. Whoever
 * goes elsewhere in the meantime, by the pointer or a key that types nothing, stays there; nothing is
 * taken from the palette or a form that lies over the window. What is replaced meanwhile by something
 * else leaves the keyboard to that.
 */
export function takeFocus(focus: () => boolean, late = () => {}): void {
  let has: Element | null = null;
  const attempt = () => {
    if (isCovered() || !focus()) return false;
    has = document.activeElement;
    return true;
  };
  const atOnce = attempt();
  const left = new AbortController();
  const leave = (event: Event) => {
    if (!(event instanceof KeyboardEvent) || !types(event)) left.abort();
  };
  for (const kind of ['pointerdown', 'keydown'])
    document.addEventListener(kind, leave, { capture: true, signal: left.signal });
  const again = (tries: number) =>
    requestAnimationFrame(() => {
      if (left.signal.aborted) return;
      const first = has === null;
      if ((first || isLost(has)) && attempt() && first && !atOnce) late();
      if (tries === 0) left.abort();
      else again(tries - 1);
    });
  again(kTries);
}

/** What had it was replaced, as the words "Loading" are by what was loaded. */
function isLost(has: Element | null): boolean {
  return has?.isConnected === false && document.activeElement === document.body;
}

function types({ key, ctrlKey, metaKey }: KeyboardEvent): boolean {
  return [...key].length === 1 && !ctrlKey && !metaKey;
}

function isCovered(): boolean {
  return document.activeElement?.closest('.overlay') != null;
}
