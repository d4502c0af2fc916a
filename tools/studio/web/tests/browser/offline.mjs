// The studio without a network after the first visit, and its versions: node offline.mjs SITE SOURCES [firefox]; without a name, in Chromium.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { appendFileSync, cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { eventually, launchNamed, serve } from './support.mjs';

const [, , site, sources, name] = process.argv, begun = performance.now();
const step = (text) => console.log(`${((performance.now() - begun) / 1000).toFixed(1).padStart(6)} s  ${text}`);
const folder = mkdtempSync(join(tmpdir(), 'forage-offline-')), studio = join(folder, 'studio');
cpSync(join(site, 'studio'), studio, { recursive: true });

let server = await serve(folder);
const home = server.address, browser = await launchNamed(name), context = await browser.newContext({ viewport: { width: 1400, height: 900 } });
context.setDefaultTimeout(60000);
const button = (page, label) => page.getByRole('button', { name: label, exact: true });
async function open() {
  const page = await context.newPage();
  await page.goto(home);
  await button(page, 'Run').waitFor();
  return page;
}
/** The version of the page, and how many the browser keeps. */
const seen = (page) => page.evaluate(async () => [document.querySelector('meta[name=version]')?.content, (await caches.keys()).length]);
/** Lets the browser look for another version. Returns the state in which its worker ends. */
const update = (page) =>
  page.evaluate(async () => {
    const registration = await navigator.serviceWorker.getRegistration();
    const found = new Promise((begins) => (registration.onupdatefound = () => begins(registration.installing)));
    await registration.update();
    const worker = await found;
    while (worker.state === 'installing') await new Promise((changed) => worker.addEventListener('statechange', changed, { once: true }));
    return worker.state;
  });
/** Changes the page on the server; `damage` also a file of which the list of files has another digest. */
function publish(version, damage = false) {
  const page = join(studio, 'index.html'), worker = join(studio, 'assets/worker.js');
  cpSync(join(site, 'studio/assets/worker.js'), worker);
  writeFileSync(page, readFileSync(join(site, 'studio/index.html'), 'utf8').replace('<head>', `<head><meta name="version" content="${version}">`));
  execFileSync('node', [join(sources, 'tools/studio/wasm/offline.mjs'), studio]);
  if (damage) appendFileSync(worker, '// of another version');
}

step('the first visit keeps all files');
let page = await open();
await page.evaluate(() => navigator.serviceWorker.ready.then(({ active }) => active.state === 'activated' || new Promise((changed) => active.addEventListener('statechange', changed))));

step('without a server, the robot runs, and figures have their fonts');
await server.close();
await page.reload();
await button(page, 'Run').click();
const cycle = async () => Number(await page.getByLabel('Moment of the run').inputValue());
await eventually('cycles', async () => (await cycle()) > 20);
await button(page, 'Pause').click();
await page.locator('.dv-tab', { hasText: 'Bug/Motor' }).first().click();
await page.getByRole('group', { name: 'Space plot of Bug/Motor', exact: true }).getByLabel('Save').selectOption({ label: 'Figure…' });
await page.getByRole('dialog', { name: 'Export figure' }).getByRole('img').waitFor();
await page.keyboard.press('Escape');
await button(page, 'Tutorial').click();
await page.getByRole('heading', { name: 'Tutorial 1: getting started' }).waitFor();

step('an address with a system opens without a server, too');
await page.goto(`${home}index.html?system=cookbook/oscillator.iqr`);
await eventually('its system', async () => (await page.locator('button.name').textContent()).includes('Oscillator'));

step('a version that is not whole on the server is not kept');
publish('second', true);
server = await serve(folder, home);
assert.equal(await update(page), 'redundant');
await page.reload();
await button(page, 'Run').waitFor();
assert.deepEqual(await seen(page), [undefined, 1]);

step('a whole one is opened when no tab has the one before');
publish('third');
await eventually('the other version', () =>
  page.evaluate(async () => {
    const registration = await navigator.serviceWorker.getRegistration();
    await registration.update().catch(() => {}); // the browser may look by itself, while the files change
    return registration.waiting !== null;
  }));
await page.reload();
await button(page, 'Run').waitFor();
assert.deepEqual(await seen(page), [undefined, 2]);
await page.close();
await eventually('the new version alone', async () => {
  page = await open();
  const [version, versions] = await seen(page);
  await page.close();
  return version === 'third' && versions === 1;
});

await browser.close();
rmSync(folder, { recursive: true });
step('all fine');
