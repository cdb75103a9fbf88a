// Brings the studio into a state that is worth looking at.

export async function breakLine(page) {
  const editor = page.getByRole('textbox', { name: /Script of drive/ });
  await editor.waitFor();
  await page.keyboard.press('F5');
  await editor.click();
  await page.keyboard.press('Control+Home');
  for (let line = 0; line < 26; line++) await page.keyboard.press('ArrowDown');
  await page.keyboard.press('Home');
  for (let column = 0; column < 13; column++) await page.keyboard.press('ArrowRight');
  await page.keyboard.press('Delete');
  await page.waitForTimeout(700);
}

export function pauseAt(server, line) {
  const node = server.model.nodes[0];
  Object.assign(node, { state: 'paused', at: { line, column: 1 }, why: 'breakpoint' });
  server.model.clock = { ...server.model.clock, state: 'paused', t: 62 };
  server.refresh();
}

/** The robot runs; variables, a plot and events are to be seen, or the network in the place of documents. */
export async function showRobot(page, view) {
  await page.keyboard.press('F5');
  if (view !== 'Network') await page.getByRole('radio', { name: view }).click();
  await page.waitForTimeout(500);
  if (view === 'Network') {
    await page.getByRole('button', { name: /State of the bus/ }).click();
    await page.waitForTimeout(2500);
    return;
  }
  const add = async (panel, field, names) => {
    await page.keyboard.press('Control+k');
    await page.keyboard.type(`Show ${panel}`);
    await page.keyboard.press('Enter');
    await page.waitForTimeout(300);
    for (const name of names) {
      await page.locator(`[data-find="${field}"]`).click();
      await page.waitForTimeout(150);
      await page.keyboard.type(name);
      await page.keyboard.press('Enter');
    }
  };
  await add('Plots', 'plots', [
    'drive.wheel.rear.speed',
    'drive.odometry.heading',
    'range.sonar.distance',
  ]);
  if (view !== 'Present')
    await add('Watch', 'watch', [
      'drive.wheel.rear.speed',
      'drive.odometry.x[1]',
      'drive.token',
      'drive.event.args',
      'range.sonar.distance',
    ]);
  if (view === 'Script') {
    // Events stand behind the world.
    await page.keyboard.press('Control+k');
    await page.keyboard.type('Show Events');
    await page.keyboard.press('Enter');
    await page.waitForTimeout(300);
    await page.keyboard.press('Control+k');
    await page.keyboard.type('Show Variables');
    await page.keyboard.press('Enter');
  }
  await page.waitForTimeout(3500);
}

export async function openWorld(page) {
  await page
    .getByRole('treeitem', { name: /hall\.world/ })
    .first()
    .dblclick();
  await page.waitForTimeout(900);
}
