// How the machine's Chromium is started, for tests and for what measures and takes pictures.
import { chromium } from 'playwright-core';

export const browserOptions = {
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
    '--force-color-profile=srgb',
  ],
};

export const launchBrowser = () => chromium.launch(browserOptions);
