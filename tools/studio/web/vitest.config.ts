import { resolve } from 'node:path';
import { svelte } from '@sveltejs/vite-plugin-svelte';
import { defineConfig } from 'vitest/config';
import { tutorial } from './tutorial/plugin';

const tutorialFolder = resolve(process.env.FORAGE_TUTORIAL ?? '../../../docs/tutorial');

export default defineConfig({
  plugins: [svelte(), tutorial(tutorialFolder)],
  server: { fs: { allow: ['.', tutorialFolder] } },
  test: { css: true, include: ['tests/unit/**/*.test.ts'], environment: 'node' },
});
