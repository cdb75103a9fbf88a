/// <reference types="vitest/config" />
import react from '@vitejs/plugin-react';
import { defineConfig } from 'vite';
import { gzip } from './scripts/gzip.mjs';
import { licences } from './scripts/licences.mjs';

export default defineConfig({
  base: './',
  plugins: [react(), licences(), gzip()],
  // The dev server passes the live connection on to a running studio.
  server: {
    host: '127.0.0.1',
    // The help shows pages of docs/.
    fs: { allow: ['.', '../docs'] },
    proxy: { '/live': { target: process.env['STUDIO'] ?? 'http://127.0.0.1:7357', ws: true } },
  },
  build: {
    outDir: 'dist',
    target: 'es2022',
    // Strict CSP: nothing is inlined as data: but small icons, and no module preload polyfill.
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 900,
    // A file for each icon or part would cost more in headers than what is in it.
    rolldownOptions: {
      output: {
        codeSplitting: {
          groups: [
            { name: 'codemirror', test: /@codemirror\/(?!lang|legacy|merge)/ },
            { name: 'icons', test: /tabler/ },
            { name: 'parts', test: /app\/parts\// },
            {
              name: 'small',
              test: /\/(log_lines|looks|robot_hooks|run_choice|webgl|world_name)\.tsx?$/,
            },
          ],
        },
      },
    },
  },
  test: {
    include: ['{protocol,core,app,aesl}/**/*.test.{ts,tsx}'],
    environment: 'node',
    // A test that hangs ends; one on a busy machine does not fail.
    testTimeout: 120_000,
  },
});
