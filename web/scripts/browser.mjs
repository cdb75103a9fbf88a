// A page of the built studio, served by the stand-in, in the machine's Chromium.
import { chromium } from 'playwright-core';
import { runnerImport } from 'vite';

export async function openStudio({
  project = true,
  width = 1440,
  height = 900,
  theme = 'dark',
  port = 0,
  crowd = 0,
  reducedMotion,
} = {}) {
  const { module } = await runnerImport(new URL('../dev/stand_in.ts', import.meta.url).pathname);
  const server = await module.startStandIn({
    port,
    project,
    crowd,
    dist: new URL('../dist', import.meta.url).pathname,
  });
  server.model.settings.theme = theme;
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: [
      '--no-sandbox',
      '--disable-gpu',
      '--enable-unsafe-swiftshader',
      '--disable-quic',
      '--no-first-run',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
    ],
  });
  const context = await browser.newContext({
    viewport: { width, height },
    colorScheme: theme === 'light' ? 'light' : 'dark',
    reducedMotion: reducedMotion ?? 'reduce',
  });
  const page = await context.newPage();
  const problems = [];
  page.on(
    'console',
    (message) => ['error', 'warning'].includes(message.type()) && problems.push(message.text()),
  );
  page.on('pageerror', (error) => problems.push(String(error)));
  await page.goto(`http://127.0.0.1:${server.port}/#token=dev`);
  return {
    page,
    server,
    problems,
    async close() {
      await browser.close();
      server.close();
    },
  };
}
