// How the machine's Chromium is started, for tests and for what measures and takes pictures. The shell is the
// same browser without windows, menus and tabs of its own: a page opens in less than half of the processor's time.
import { chromium } from 'playwright-core';

export const browserOptions = {
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium-headless-shell',
  args: [
    '--no-sandbox',
    '--disable-gpu',
    '--enable-unsafe-swiftshader',
    '--disable-quic',
    '--no-first-run',
    '--disable-background-networking',
    '--disable-component-update',
    '--disable-sync',
    '--force-color-profile=srgb',
  ],
};

export const launchBrowser = () => chromium.launch(browserOptions);
