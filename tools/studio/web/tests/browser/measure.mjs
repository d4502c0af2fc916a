// What a visitor of the site waits for, and how fast the studio runs in Chromium: node measure.mjs SITE FORAGE [MINUTES]
// FORAGE is the command line in Node (build/web/forage): the speed without a page. With MINUTES, the memory of a run at Max is printed each minute.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { brotliCompressSync } from 'node:zlib';
import { launch, serve } from './support.mjs';

const [, , site, forage, minutes = '0'] = process.argv, runs = 5;
const { address } = await serve(site), browser = await launch();
const button = (page, name) => page.getByRole('button', { name, exact: true });
const seconds = (n) => new Promise((done) => setTimeout(done, 1000 * n));
const median = (numbers) => numbers.toSorted((a, b) => a - b)[Math.floor(numbers.length / 2)];

// The page presses Run as soon as it can, and notes when the robot has moved, in ms since the visit began.
function runAtOnce() {
  const look = () => {
    const run = [...document.querySelectorAll('button')].find((b) => b.textContent.trim() === 'Run' && !b.disabled);
    if (run && !window.pressed) run.click(), window.pressed = performance.now();
    if (Number(document.querySelector('[aria-label="Moment of the run"]')?.value) > 0) window.moved = performance.now();
    else requestAnimationFrame(look);
  };
  requestAnimationFrame(look);
}
/** The last status of the run goes to `window.status_`. */
function watchStatus() {
  window.Worker = class extends Worker {
    constructor(...given) {
      super(...given);
      this.addEventListener('message', ({ data }) => {
        if (typeof data === 'string' && data.includes('"type":"status"')) window.status_ = JSON.parse(data);
        else if (data instanceof ArrayBuffer) window.frames_ = (window.frames_ ?? 0) + 1;
      });
    }
  };
}

const starts = [], loaded = new Set();
for (let n = 0; n < runs; n++) {
  const context = await browser.newContext({ viewport: { width: 1400, height: 900 } }), page = await context.newPage();
  await context.addInitScript(runAtOnce);
  page.on('requestfinished', (request) => {
    const path = new URL(request.url()).pathname;
    if (!request.serviceWorker() && path.startsWith('/studio/')) loaded.add(path);
  });
  await page.goto(address);
  await page.waitForFunction(() => window.moved);
  starts.push(await page.evaluate(() => [window.pressed, window.moved]));
  await context.close();
}
const shown = (i) => `${median(starts.map((s) => s[i])).toFixed(0)} ms (${starts.map((s) => s[i].toFixed(0)).toSorted((a, b) => a - b).join(', ')})`;
console.log(`start of ${runs} first visits: Run can be pressed after ${shown(0)}, the robot moves after ${shown(1)}`);
const wire = new Map([...loaded].map((path) => [path, brotliCompressSync(readFileSync(join(site, path.replace(/\/$/, '/index.html')))).length]));
const total = [...wire].reduce((sum, [path, size]) => sum + (path.endsWith('rest.wasm') ? 0 : size), 0);
console.log(`first visit, with brotli: ${(total / 1e6).toFixed(2)} MB; forage-web.rest.wasm comes while the robot runs`);
for (const [path, size] of [...wire].sort((a, b) => b[1] - a[1])) console.log(`  ${(size / 1e3).toFixed(0).padStart(6)} kB  ${path}`);

/** Cycles per second without a page. */
function inNode() {
  const out = mkdtempSync(join(tmpdir(), 'forage-measure-')), cycles = 100000;
  const begun = performance.now();
  execFileSync(forage, ['run', 'systems/dac_foraging.iqr', '--world', 'systems/worlds/basic_arena.world', '--cycles', String(cycles), '-o', join(out, 'run')], { stdio: 'ignore' });
  rmSync(out, { recursive: true });
  return cycles / ((performance.now() - begun) / 1000);
}
const context = await browser.newContext({ viewport: { width: 1400, height: 900 } });
await context.addInitScript(watchStatus);
const page = await context.newPage();
await page.goto(address);
await page.getByRole('button', { name: 'Layouts of the panels' }).click();
await page.getByRole('button', { name: 'Part 1' }).click(); // four plots
await button(page, 'Max').click();
await button(page, 'Run').click();
for (let n = 0; n < runs; n++) {
  await button(page, 'Pause').click();
  const node = inNode();
  await button(page, 'Run').click();
  await seconds(3);
  const before = await page.evaluate(() => [window.status_.cycle, performance.now(), window.frames_]);
  await seconds(5);
  const after = await page.evaluate(() => [window.status_.cycle, performance.now(), window.frames_, window.status_]);
  const passed = (after[1] - before[1]) / 1000, rate = (after[0] - before[0]) / passed;
  const { times_real_time: times, pages_share: share } = after[3], frames = (after[2] - before[2]) / passed;
  console.log(
    `DAC foraging at Max: ${rate.toFixed(0)} cycles/s, ${times.toFixed(0)} times real time (${(rate / node).toFixed(2)} of the ${node.toFixed(0)} in Node), ${frames.toFixed(0)} frames/s, ${(100 * share).toFixed(0)} % for the page`,
  );
}
// The DevTools of the page, and through them those of its worker.
const tools = await context.newCDPSession(page), ofBrowser = await browser.newBrowserCDPSession(), answers = [];
let worker;
tools.on('Target.attachedToTarget', ({ sessionId, targetInfo: { type } }) => type === 'worker' && (worker = sessionId));
tools.on('Target.receivedMessageFromTarget', ({ message }) => answers[JSON.parse(message).id]?.(JSON.parse(message).result));
await tools.send('Target.setAutoAttach', { autoAttach: true, waitForDebuggerOnStart: false, flatten: false });
const ofWorker = (method) => new Promise((answered) => tools.send('Target.sendMessageToTarget', { sessionId: worker, message: JSON.stringify({ id: answers.push(answered) - 1, method }) }));
/** The memory of the page with its worker, before and after garbage is collected, and what JavaScript holds in both. */
async function memory() {
  const resident = async () =>
    Math.max(...(await ofBrowser.send('SystemInfo.getProcessInfo')).processInfo.filter((p) => p.type === 'renderer').map(({ id }) => Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${id}/status`, 'utf8'))[1]) / 1e3));
  const before = await resident();
  await Promise.all([tools.send('HeapProfiler.collectGarbage'), ofWorker('HeapProfiler.collectGarbage')]);
  await ofBrowser.send('Memory.simulatePressureNotification', { level: 'critical' }).catch(() => {});
  await seconds(1);
  const held = (await Promise.all([tools.send('Runtime.getHeapUsage'), ofWorker('Runtime.getHeapUsage')])).map((h) => (h.usedSize + h.embedderHeapUsedSize + h.backingStorageSize) / 1e6);
  return `${before.toFixed(0)} MB, without garbage ${(await resident()).toFixed(0)} MB; JavaScript holds ${held[0].toFixed(1)} MB in the page, ${held[1].toFixed(1)} MB in the worker`;
}
for (let minute = 0; minute <= Number(minutes); minute++) {
  if (minute) await seconds(60);
  const used = await memory(), { cycle, seconds: time } = await page.evaluate(() => window.status_);
  console.log(`minute ${minute}: ${(time / 60).toFixed(0)} minutes of the robot, ${cycle} cycles; ${used}`);
}
await browser.close();
