// Drives the page in Chromium against the real program: node page_test.mjs FORAGE SOURCES [SCREENSHOT]
// Exit code 77: skipped, as there is no browser.
import { existsSync, mkdtempSync, cpSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import assert from 'node:assert/strict';
import { startStudio } from './support.mjs';

const [forage, sources, screenshot] = process.argv.slice(2).map((p) => resolve(p));
const browserPath = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find((p) => existsSync(p));
if (!browserPath) {
  console.log('SKIPPED: there is no Chromium');
  process.exit(77);
}
const { chromium } = await import('playwright-core');
const folder = mkdtempSync(join(tmpdir(), 'forage-page-'));
cpSync(join(sources, 'systems'), join(folder, 'systems'), { recursive: true });

const studio = startStudio(forage, folder);
let browser;
const faults = [];
const step = (text) => console.log(text);
try {
  const address = await studio.address;
  browser = await chromium.launch({ executablePath: browserPath, args: ['--no-sandbox', '--disable-gpu', '--disable-background-networking', '--disable-dev-shm-usage'] });
  const context = await browser.newContext({ viewport: { width: 1400, height: 900 }, colorScheme: 'light' });
  const page = await context.newPage();
  let received = 0; // binary frames
  page.on('websocket', (socket) => socket.on('framereceived', (f) => (received += typeof f.payload === 'string' ? 0 : 1)));
  page.on('pageerror', (e) => faults.push(e.message));
  page.on('console', (m) => m.type() === 'error' && faults.push(m.text()));
  const until = (what, condition, argument) => page.waitForFunction(condition, argument, { polling: 100 }).catch(() => assert.fail(`waited in vain: ${what}`));
  const seek = page.getByLabel('Moment of the run');
  const pixels = (selector) => page.locator(selector).first().evaluate((c) => [...c.getContext('2d').getImageData(0, 0, c.width, c.height).data].reduce((h, v) => (h * 31 + v) | 0, 7));

  step('open: the tree, the arena and the plots are there');
  await page.goto(address);
  await page.getByRole('group', { name: 'Arena' }).waitFor();
  await page.getByRole('group', { name: 'Space plot of Bug/Motor' }).waitFor();
  await page.getByRole('navigation').getByText('Head Direction Cells').waitFor();

  step('all buttons of the diagram have room; that there is nothing to undo is told, and is no error');
  const cut = await page.getByRole('toolbar', { name: 'Editing' }).evaluate((bar) => [...bar.querySelectorAll('button')].filter((b) => b.getBoundingClientRect().right > bar.getBoundingClientRect().right).map((b) => b.textContent));
  assert.deepEqual(cut, []);
  await page.keyboard.press('Control+z');
  await page.locator('.notice.info').filter({ hasText: 'there is nothing to undo' }).waitFor();
  assert.equal(await page.locator('.notice.error').count(), 0);

  step('run: the cycle grows, plot and arena change');
  const light = '[aria-label="Space plot of Bug/Light"] canvas.heat';
  await page.getByRole('button', { name: '4×' }).click();
  const before = [await pixels(light), await pixels('[role="group"][aria-label="Arena"] canvas')];
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await until('the run', () => Number(document.querySelector('[aria-label="Moment of the run"]')?.value) > 60);
  assert.notEqual(await pixels('[role="group"][aria-label="Arena"] canvas'), before[1]);
  assert.notEqual(await pixels(light), before[0]);

  step('pause: the cycle stays; space runs and pauses');
  await page.getByRole('button', { name: 'Pause', exact: true }).click();
  await page.getByRole('button', { name: 'Run', exact: true }).waitFor();
  const paused = await seek.inputValue();
  await page.waitForTimeout(300);
  assert.equal(await seek.inputValue(), paused);
  await page.locator('body').press(' ');
  await page.getByRole('button', { name: 'Pause', exact: true }).waitFor();
  await page.locator('body').press(' ');
  await page.getByRole('button', { name: 'Run', exact: true }).waitFor();

  step('Ctrl+K finds a group; the inspector shows its parameters; a change has effect; undo takes it back');
  await page.keyboard.press('Control+k');
  await page.keyboard.type('adaptive/thresh');
  await page.keyboard.press('Enter');
  const inspector = page.getByRole('region', { name: 'Inspector' });
  await inspector.getByRole('heading', { name: 'Adaptive/Threshold CR' }).waitFor();
  const threshold = page.locator('[id="Adaptive/Threshold CR.threshold"]');
  const loaded = await threshold.inputValue();
  await threshold.fill('0.77');
  await threshold.press('Enter');
  await page.getByText("run.params[\"Adaptive/Threshold CR.threshold\"] = 0.77").first().waitFor();
  await inspector.getByRole('button', { name: /^Reset/ }).waitFor();
  await page.getByRole('button', { name: 'Undo' }).click();
  await until('undo', ([id, value]) => document.getElementById(id)?.value === value, ['Adaptive/Threshold CR.threshold', loaded]);
  await page.getByRole('button', { name: 'Redo' }).click();
  await until('redo', (id) => document.getElementById(id)?.value === '0.77', 'Adaptive/Threshold CR.threshold');

  step('drive the motor by hand: the plot shows the clamped cell');
  await page.getByRole('navigation').getByText('Motor', { exact: true }).click();
  await inspector.getByRole('button', { name: 'Drive' }).click();
  const drive = page.getByRole('group', { name: 'Drive Bug/Motor' });
  await drive.getByRole('application').focus();
  for (const key of ['Home', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'Space']) await page.keyboard.press(key);
  await drive.getByText('Cell (1, 5): 1').waitFor();
  await drive.getByRole('button', { name: 'Send' }).click();
  await page.getByText('Bug/Motor driven by hand').waitFor();
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await page.getByRole('navigation').getByText('Motor', { exact: true }).dblclick();
  await until('the clamped cell', () => {
    const c = document.querySelector('[aria-label="Space plot of Bug/Motor"] canvas.heat');
    if (!c || c.width !== 9) return false;
    const d = c.getContext('2d').getImageData(0, 4, 2, 1).data;
    return d[0] > 200 && d[4] < 100; // yellow, then dark blue
  });
  await page.keyboard.press('Control+k');
  await page.keyboard.type('drive');
  await page.keyboard.press('Escape');

  step('time plot: it opens, and grows');
  await inspector.getByRole('button', { name: 'Time' }).click();
  await page.locator('.uplot canvas').first().waitFor();

  step('a hidden page costs the engine nothing: it is sent no frames');
  const rate = async () => {
    const cycle = async () => Number(await seek.inputValue());
    const [a, t] = [await cycle(), performance.now()];
    await page.waitForTimeout(800);
    return ((await cycle()) - a) / ((performance.now() - t) / 1000);
  };
  const earlier = received;
  const seen = await rate();
  assert.ok(received - earlier > 5, `only ${received - earlier} frames in 0.8 s`);
  await page.evaluate(() => {
    window.kept = window.requestAnimationFrame;
    window.requestAnimationFrame = () => 0;
  });
  await page.waitForTimeout(200); // what is under way
  const sent = received;
  const hidden = await rate();
  assert.ok(received - sent <= 2, `${received - sent} frames were sent to a page that draws nothing`);
  await page.evaluate(() => (window.requestAnimationFrame = window.kept));
  assert.ok(hidden > 0.5 * seen, `${hidden} cycles/s while hidden, ${seen} before`);

  if (screenshot) {
    await page.screenshot({ path: screenshot });
  }
  step('the way back: the slider seeks a cycle, and the run waits there');
  await seek.fill('40');
  await seek.dispatchEvent('change');
  await until('cycle 40', () => document.querySelector('[aria-label="Moment of the run"]')?.value === '40');
  await page.getByRole('button', { name: 'Run', exact: true }).waitFor();

  step('a page that is loaded again shows the same run and the same panels');
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await page.reload();
  await page.locator('.uplot canvas').first().waitFor();
  await page.getByText('Bug/Motor driven by hand').waitFor();
  await page.getByRole('button', { name: 'Pause', exact: true }).click();

  step('stop: back to cycle 0');
  await page.getByRole('button', { name: 'Stop', exact: true }).click();
  await until('cycle 0', () => document.querySelector('[aria-label="Moment of the run"]')?.value === '0');

  step('axe finds no serious fault of accessibility');
  const { createRequire } = await import('node:module');
  const axe = createRequire(import.meta.url).resolve('axe-core/axe.min.js');
  const { readFileSync } = await import('node:fs');
  await page.evaluate(readFileSync(axe, 'utf8'));
  // Dockview's own tabs hold a close button, which axe calls nested.
  const serious = await page.evaluate(async () => (await window.axe.run({ exclude: ['.dv-tab'] }, { resultTypes: ['violations'] })).violations.filter((v) => ['serious', 'critical'].includes(v.impact)).map((v) => `${v.id}: ${v.nodes.slice(0, 3).map((n) => n.html.slice(0, 160)).join(' | ')}`));
  assert.deepEqual(serious, []);

  step('the server ends: the page says so; faults in between: none');
  assert.deepEqual(faults, []);
  studio.child.removeAllListeners('exit');
  studio.child.kill('SIGINT');
  await page.getByText('connection lost').waitFor();
  console.log('all fine');
} finally {
  await browser?.close();
  studio.child.kill('SIGKILL');
  rmSync(folder, { recursive: true, force: true });
}
