import { svelte } from '@sveltejs/vite-plugin-svelte';
import { resolve } from 'node:path';
import { defineConfig, type Plugin } from 'vite';
import { tutorial } from './tutorial/plugin';

// `FORAGE_STUDIO_URL=http://127.0.0.1:PORT npm run dev` shows the page of these sources on a running `forage studio`, at the address of Vite with `?token=T`.
const server = process.env.FORAGE_STUDIO_URL ? new URL(process.env.FORAGE_STUDIO_URL) : null;
const forward = server && {
  target: server.origin,
  ws: true,
  changeOrigin: true,
  headers: { origin: server.origin },
};

// The text of the tutorial lives in docs/tutorial; the build of the program works on a copy of this folder, and names it.
const tutorialFolder = resolve(process.env.FORAGE_TUTORIAL ?? '../../../docs/tutorial');

// What the server's header says, where any web server shows the page: it loads nothing from elsewhere, and compiles WebAssembly.
const policy: Plugin = {
  name: 'policy',
  transformIndexHtml: () => [{
    tag: 'meta',
    attrs: {
      'http-equiv': 'Content-Security-Policy',
      content: "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; connect-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; base-uri 'none'; form-action 'none'",
    },
    injectTo: 'head-prepend',
  }],
};

// File names carry no hash: the program embeds the files, and a build gives the same bytes each time.
// With --mode web it is the page for browsers only: its session runs in a worker (tools/web).
export default defineConfig(({ mode }) => ({
  plugins: [svelte(), tutorial(tutorialFolder), ...(mode === 'web' ? [policy] : [])],
  base: './',
  // The only file of dockview-core that brings its style sheet.
  resolve: { alias: [{ find: /^dockview-core$/, replacement: 'dockview-core/dist/dockview-core.min.js' }] },
  server: { fs: { allow: ['.', tutorialFolder] }, ...(forward ? { proxy: { '/ws': forward, '/picture': forward } } : {}) },
  build: {
    outDir: process.env.FORAGE_STUDIO_OUT ?? 'dist',
    emptyOutDir: true,
    target: 'es2022',
    chunkSizeWarningLimit: 700,
    rollupOptions: {
      ...(mode === 'web' ? { input: ['index.html', 'src/browser/worker.ts', 'src/browser/service_worker.ts'] } : {}),
      output: {
        entryFileNames: 'assets/[name].js',
        chunkFileNames: 'assets/[name].js',
        assetFileNames: 'assets/[name][extname]',
      },
    },
  },
}));
