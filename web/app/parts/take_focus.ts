const kTries = 120;

/**
 * Gives something the keyboard: `focus` tries it and tells whether it has it. What stands in a tab
 * that comes to the front just now can have it only once it is shown; then `late` is called.
 */
export function takeFocus(focus: () => boolean, late: () => void = () => {}, tries = kTries): void {
  const has = focus();
  if (has && tries < kTries) late();
  if (!has && tries > 0) requestAnimationFrame(() => takeFocus(focus, late, tries - 1));
}
