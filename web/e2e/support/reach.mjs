// What a person could not reach: controls that are cut off, covered, or in no box that scrolls to them.

/** @typedef {import('playwright-core').Page} Page */

/**
 * The controls inside what the selector finds that no scrolling brings wholly into sight, as words.
 * The canvas of a plan and the text of an editor move in their own way and are left out.
 * @param {Page} page
 * @param {string} within
 * @returns {Promise<string[]>}
 */
export function unreachable(page, within = 'body') {
  return page.evaluate(
    ([all, moving, place]) => {
      const kSlack = 1.5;
      const found = [...document.querySelectorAll(place)].flatMap((one) => [
        ...one.querySelectorAll(all),
      ]);
      return found.filter(isShown).flatMap((control) => {
        const why = fault(control);
        return why ? [`${nameOf(control)}: ${why}`] : [];
      });

      /** @param {Element} one */
      function isShown(one) {
        const { width, height } = one.getBoundingClientRect();
        return (
          one.checkVisibility({ opacityProperty: true, visibilityProperty: true }) &&
          width > 0 &&
          height > 0 &&
          !one.closest(moving)
        );
      }

      /** Tabs that have no room are in the list of the button beside them. */
      function isListed(/** @type {Element} */ one) {
        return (
          one.matches('[role=tab]') &&
          one.closest('.flexlayout__tabset')?.querySelector('.flexlayout__tab_button_overflow')
        );
      }

      /** @param {Element} control */
      function fault(control) {
        if (isListed(control)) return undefined;
        const before = ancestorsOf(control).map((one) => [one, one.scrollLeft, one.scrollTop]);
        for (const box of ancestorsOf(control)) scrollTo(box, control);
        const why = cutBy(control) ?? coveredBy(control);
        for (const [box, left, top] of before)
          Object.assign(box, { scrollLeft: left, scrollTop: top });
        return why;
      }

      /** @param {Element} one @returns {any[]} */
      function ancestorsOf(one) {
        return one.parentElement ? [one.parentElement, ...ancestorsOf(one.parentElement)] : [];
      }

      /** A person can scroll what shows bars; what only hides its rest stays as it is. */
      function scrollTo(/** @type {any} */ box, /** @type {Element} */ control) {
        const { overflowX, overflowY } = getComputedStyle(box);
        const [own, rect] = [box.getBoundingClientRect(), control.getBoundingClientRect()];
        const can = (/** @type {string} */ how) => how === 'auto' || how === 'scroll';
        if (can(overflowY)) {
          if (rect.bottom > own.top + box.clientHeight)
            box.scrollTop += rect.bottom - own.top - box.clientHeight;
          const top = control.getBoundingClientRect().top;
          if (top < own.top) box.scrollTop -= own.top - top;
        }
        if (can(overflowX)) {
          if (rect.right > own.left + box.clientWidth)
            box.scrollLeft += rect.right - own.left - box.clientWidth;
          const left = control.getBoundingClientRect().left;
          if (left < own.left) box.scrollLeft -= own.left - left;
        }
      }

      /** @param {Element} control */
      function cutBy(control) {
        const rect = control.getBoundingClientRect();
        const isFixed = ancestorsOf(control).some(
          (one) => getComputedStyle(one).position === 'fixed',
        );
        const boxes = ancestorsOf(control).filter(
          (box) =>
            !isFixed && getComputedStyle(box).overflow !== 'visible' && box !== document.body,
        );
        const edges = [
          { name: 'the window', left: 0, top: 0, right: innerWidth, bottom: innerHeight },
          ...boxes.map((box) => {
            const { left, top, right, bottom } = box.getBoundingClientRect();
            return { name: box.className, left, top, right, bottom };
          }),
        ];
        for (const edge of edges)
          if (
            rect.left < edge.left - kSlack ||
            rect.right > edge.right + kSlack ||
            rect.top < edge.top - kSlack ||
            rect.bottom > edge.bottom + kSlack
          )
            return `cut off by ${edge.name}`;
      }

      /** @param {Element} control */
      function coveredBy(control) {
        const { left, top, width, height } = control.getBoundingClientRect();
        const there = document.elementFromPoint(left + width / 2, top + height / 2);
        const own =
          there && (control.contains(there) || there.contains(control) || isLabel(there, control));
        if (!own) return `covered by ${there?.className || there?.tagName}`;
      }

      function isLabel(/** @type {Element} */ there, /** @type {any} */ control) {
        return [...(control.labels ?? [])].some((one) => one.contains(there));
      }

      /** @param {Element} one */
      function nameOf(one) {
        const words = one.getAttribute('aria-label') ?? one.textContent?.trim() ?? '';
        return `${one.tagName.toLowerCase()}.${one.className} "${words.slice(0, 40)}"`;
      }
    },
    [
      'button, input, select, textarea, a[href], summary, [role=tab], [role=menuitem], [role=option], [role=switch], [role=radio], [role=checkbox]',
      '.react-flow__viewport, .cm-scroller, .hidden-text, [aria-hidden=true], [inert]',
      within,
    ],
  );
}
