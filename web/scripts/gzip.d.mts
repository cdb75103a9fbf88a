import type { Plugin } from 'vite';

export declare function gzip(): Plugin;
