// The window: start screen, panels and layouts, files, palette, keys, problems.
import { seen, test, until } from './support/studio.mjs';

test(
  'an example of the start screen opens as a copy, with picture and robot',
  {},
  async (studio) => {
    const { page, button } = studio;
    await seen(page.getByRole('heading', { name: 'Take an example' }));
    await until('every example has its picture', async () => {
      const cards = page.getByRole('region', { name: 'Take an example' }).getByRole('listitem');
      return (await cards.count()) >= 6 && (await cards.locator('svg').count()) >= 6;
    });
    await button(/^Thymio A Thymio/).click();
    await seen(studio.editor('thymio-II'));
    await seen(button(/Target Simulator/));
    await seen(page.getByText('A Thymio that explores: it drives ahead'));
  },
);
