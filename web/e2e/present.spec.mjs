// The layout for a class or a talk: the plan fills its panel, and its names are read from the last row.
import assert from 'node:assert/strict';
import { seen, test, until } from './support/studio.mjs';

test(
  'Present shows the whole plan, large, and no empty panel',
  { words: ['--example', 'follow-wall'] },
  async ({ page, layout }) => {
    await layout('Present');
    await seen(page.getByRole('region', { name: 'Plan WallFollow, drawn' }));
    const measured = () =>
      page.evaluate(() => {
        const all = (/** @type {string} */ selector) => [...document.querySelectorAll(selector)];
        const canvas = all('.pcanvas')[0].getBoundingClientRect();
        const zoom = new DOMMatrix(getComputedStyle(all('.react-flow__viewport')[0]).transform).a;
        const rects = all('.react-flow__node').map((one) => one.getBoundingClientRect());
        const left = Math.min(...rects.map((one) => one.left));
        const right = Math.max(...rects.map((one) => one.right));
        const top = Math.min(...rects.map((one) => one.top));
        const bottom = Math.max(...rects.map((one) => one.bottom));
        const inside =
          left >= canvas.left &&
          right <= canvas.right &&
          top >= canvas.top &&
          bottom <= canvas.bottom;
        return {
          inside,
          filled: Math.max((right - left) / canvas.width, (bottom - top) / canvas.height),
          least: Math.min(
            ...[...document.querySelectorAll('.pactor__head b, .psup > b')].map(
              (name) => parseFloat(getComputedStyle(name).fontSize) * zoom,
            ),
          ),
        };
      });
    // It has come to rest so: several times in a row.
    let good = 0;
    await until('it fills its panel, with names of 20 px', async () => {
      const { inside, filled, least } = await measured();
      good = inside && filled > 0.85 && least >= 19.9 ? good + 1 : 0;
      return good > 12;
    });
    assert.equal(await page.getByText('Nothing plotted.').count(), 0);
  },
);

test(
  'a window of 720 x 450 has its whole top bar in sight',
  { words: ['--example', 'follow-wall'], width: 720, height: 450 },
  async ({ page, layout }) => {
    await layout('Draw');
    await seen(page.getByRole('button', { name: /^Target/ }));
    const cut = await page.evaluate(() =>
      [...document.querySelectorAll('.topbar button')]
        .filter((one) => one.checkVisibility())
        .filter((one) => {
          const { left, right, bottom } = one.getBoundingClientRect();
          return left < 0 || right > innerWidth || bottom > innerHeight;
        })
        .map((one) => one.textContent || one.getAttribute('aria-label')),
    );
    assert.deepEqual(cut, []);
  },
);
