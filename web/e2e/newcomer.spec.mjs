// Somebody who has never seen it: from the start screen to a Thymio that avoids obstacles.
import { seen, reads, test, until } from './support/studio.mjs';

test('a newcomer makes a Thymio avoid obstacles', {}, async (studio) => {
  const { page, press, type, button, layout } = studio;
  await page.getByRole('button', { name: /^New/ }).click();
  await page.getByLabel('Name').fill('avoid');
  await button('Create').click();
  const editor = studio.editor('thymio-II');
  await editor.click();
  await press('Control+a', 'Delete');
  for (const line of [
    'motor.left.target = 200',
    'motor.right.target = 200',
    'onevent prox',
    'if prox.horizontal[2] > 1000 then',
    'motor.left.taget = -200',
    'else',
    'motor.left.target = 200',
    'end',
  ]) {
    await type(line);
    await press('Escape', 'Enter');
  }
  // The mistake is told at its line, in a sentence, with its fix.
  const note = page.getByRole('note');
  await reads(note.first(), /motor\.left\.taget.*did you mean.*motor\.left\.target/s);
  await note.getByRole('button').first().click();
  await seen(button('No problems'));
  // A breakpoint, beside the line.
  await press('F5');
  await seen(page.getByRole('button', { name: /Running/ }));
  await page
    .locator('.cm-lineNumbers .cm-gutterElement', { hasText: /^4$/ })
    .click({ position: { x: -6, y: 8 }, force: true });
  await seen(page.getByText('thymio-II paused at line 4'));
  await page
    .locator('.cm-lineNumbers .cm-gutterElement', { hasText: /^4$/ })
    .click({ position: { x: -6, y: 8 }, force: true });
  await button('Continue').first().click();
  // A sensor in the plot.
  await page.getByRole('searchbox', { name: 'Find in all nodes' }).fill('prox.horizontal');
  await button('Plot prox.horizontal').click();
  await seen(page.getByRole('img', { name: /Plot of .*prox\.horizontal/ }));
  // It turns before the box in its way.
  await layout('Present');
  await page.getByRole('button', { name: /Speed of the clock/ }).click();
  await page.getByRole('menuitem', { name: '10×' }).click();
  const row = page.getByRole('table', { name: 'Things' }).getByRole('row', { name: 'thymio' });
  await until('it turns away from something', async () => {
    const angle = Number((await row.getByRole('cell').last().innerText()).replace(/[^\d.]/g, ''));
    return Math.abs(angle) > 20;
  });
});
