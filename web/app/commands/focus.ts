// F6: the focus goes from region to region of the window: the bars, and each panel.

const regions = '[data-region], .flexlayout__tabset_container';
const inside =
  'button:not(:disabled), [href], input, select, textarea, [tabindex="0"], [contenteditable="true"]';

export function focusRegion(by: 1 | -1): void {
  const found = [...document.querySelectorAll<HTMLElement>(regions)].filter(
    (region) => region.offsetParent !== null,
  );
  if (found.length === 0) return;
  const now = found.findIndex(hasFocus);
  const start = now < 0 && by === -1 ? 0 : now;
  for (let step = 1; step <= found.length; step++) {
    const region = found[(start + by * step + found.length * 2) % found.length];
    if (region && focusIn(region)) return;
  }
}

/** The panel of a region's chosen tab is elsewhere in the page than its tabs. */
function panelOf(region: HTMLElement): HTMLElement | null {
  const id = region
    .querySelector('[role="tab"][aria-selected="true"]')
    ?.getAttribute('aria-controls');
  return id ? document.getElementById(id) : null;
}

function hasFocus(region: HTMLElement): boolean {
  const active = document.activeElement;
  return region.contains(active) || (panelOf(region)?.contains(active) ?? false);
}

const all = (place: HTMLElement | null, what: string) => [
  ...(place?.querySelectorAll<HTMLElement>(what) ?? []),
];

const isShown = (one: HTMLElement) => one.offsetParent !== null;

/** What is in the panel comes first; an empty panel takes the focus on its tab. */
function focusIn(region: HTMLElement): boolean {
  for (const place of [panelOf(region), region]) {
    // What the place is there for, as a canvas below its bar; else what comes first.
    const target =
      all(place, '[data-autofocus]').find(isShown) ??
      all(place, inside).find((one) => isShown(one) && one.tabIndex >= 0);
    if (!target) continue;
    target.focus();
    return document.activeElement === target;
  }
  return false;
}
