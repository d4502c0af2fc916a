// The studio without a server, from a folder of static files: node without_server.mjs SITE [firefox]; without a name, in Chromium.
import assert from 'node:assert/strict';
import { createReadStream, existsSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { firefox } from 'playwright-core';
import { eventually, launch } from './support.mjs';

const [, , site, name] = process.argv, patience = 60000;
const types = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.svg': 'image/svg+xml', '.png': 'image/png' };
const server = createServer(({ url }, response) => {
  const path = join(site, normalize(new URL(url, 'http://x').pathname).replace(/\/$/, '/index.html'));
  if (!existsSync(path) || statSync(path).isDirectory()) return response.writeHead(404).end();
  response.writeHead(200, { 'Content-Type': types[extname(path)] ?? 'application/octet-stream' });
  createReadStream(path).pipe(response);
});
await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
const home = `http://127.0.0.1:${server.address().port}/studio/`;

const browser = name ? await firefox.launch({ channel: 'moz-firefox', executablePath: '/usr/bin/firefox-esr' }) : await launch();
const context = await browser.newContext({ viewport: { width: 1400, height: 900 } });
context.setDefaultTimeout(patience);
// Browsers ask the user before a page may read the clipboard.
await context.addInitScript(() => {
  if (navigator.clipboard) navigator.clipboard.writeText = async (text) => void (window.copied = text);
});
const faults = [], begun = performance.now();
context.on('page', (page) => {
  page.on('pageerror', (e) => faults.push(e.message));
  page.on('console', (m) => m.type() === 'error' && faults.push(m.text()));
});
const step = (text) => console.log(`${((performance.now() - begun) / 1000).toFixed(1).padStart(6)} s  ${text}`);
const open = async (address) => {
  const page = await context.newPage();
  await page.goto(home + address);
  await page.getByRole('button', { name: 'Run', exact: true }).waitFor();
  return page;
};
/** The cycle that the page shows. */
const cycle = async (page) => Number(await page.getByLabel('Moment of the run').inputValue());
const menu = async (page, item) => {
  await page.locator('button.name').click();
  await page.getByRole('menuitem', { name: new RegExp(`^${item}`) }).click();
};

step('the robot of the tutorial runs');
let page = await open('');
await page.getByRole('button', { name: 'Run', exact: true }).click();
await eventually('cycles', async () => (await cycle(page)) > 20);
if (process.env.FORAGE_PICTURES) await page.screenshot({ path: join(process.env.FORAGE_PICTURES, 'without-server.png') });

step('a system that is changed is saved');
await page.getByRole('button', { name: 'Pause', exact: true }).click();
await page.getByLabel('Author', { exact: true }).fill('A teacher');
await page.getByLabel('Author', { exact: true }).press('Enter');
await menu(page, 'Save as…');
await page.getByRole('dialog').getByLabel('Name', { exact: true }).fill('mine.iqr');
await page.getByRole('dialog').getByRole('button', { name: 'Save', exact: true }).click();
await page.getByText('Saved as mine.iqr.').waitFor();

step('a link opens the same system in another tab');
await menu(page, 'Copy a link');
await page.getByText(/^The link is copied/).waitFor();
const link = await page.evaluate(() => window.copied);
await page.close();
const linked = await open(link.slice(home.length));
await eventually('what was changed', async () => (await linked.getByLabel('Author', { exact: true }).inputValue()) === 'A teacher');

step('what was saved in the other tab is there');
await menu(linked, 'Open…');
await linked.getByRole('button', { name: 'mine.iqr', exact: true }).first().waitFor();
await linked.close();

step('an exercise of the tutorial sets itself up');
page = await open('?exercise=2-reactive-layer:2');
await eventually('its system', async () => (await page.locator('button.name').textContent()).includes('reflex without'));
await eventually('the panels of the exercise', async () => (await page.getByText('Motor In').count()) > 0);
await page.close();

assert.deepEqual(faults, []);
await browser.close();
server.close();
step('all fine');
