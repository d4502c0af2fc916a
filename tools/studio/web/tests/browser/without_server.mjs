// The studio without a server, from a folder of static files: node without_server.mjs SITE [firefox]; without a name, in Chromium.
import assert from 'node:assert/strict';
import { join } from 'node:path';
import { eventually, launchNamed, serve, sessionIsKept } from './support.mjs';

const [, , site, name] = process.argv, patience = 60000;
const { address: home } = await serve(site), browser = await launchNamed(name);
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

step('a page that is hidden does not compute');
const hide = (hidden) =>
  page.evaluate((is) => {
    Object.defineProperty(document, 'hidden', { configurable: true, get: () => is });
    document.dispatchEvent(new Event('visibilitychange'));
  }, hidden);
const hidden = Date.now();
await hide(true);
await eventually('the run rests', async () => {
  const before = await cycle(page);
  await page.evaluate(() => new Promise((done) => setTimeout(done, 500)));
  return (await cycle(page)) === before;
});
await sessionIsKept(page, hidden); // a browser may discard the page
const rested = await cycle(page);
await hide(false);
await eventually('the run continues', async () => (await cycle(page)) > rested);

step('what a closed tab has left is continued in the next one');
await page.getByRole('button', { name: 'Pause', exact: true }).click();
await page.getByRole('button', { name: 'Run', exact: true }).waitFor();
const since = Date.now();
await page.locator('body').press('.');
await sessionIsKept(page, since);
await page.close();
page = await open('');
await page.getByRole('button', { name: 'Resume it' }).click();
await eventually('its cycle', async () => (await cycle(page)) > rested);

step('a system that is changed is saved');
await page.getByLabel('Author', { exact: true }).fill('A teacher');
await page.getByLabel('Author', { exact: true }).press('Enter');
await menu(page, 'Save as…');
await page.getByRole('dialog').getByLabel('Name', { exact: true }).fill('mine.iqr');
await page.getByRole('dialog').getByRole('button', { name: 'Save', exact: true }).click();
await page.getByText('Saved as mine.iqr.').waitFor();

step('a page that is loaded again has opened the same file');
await page.reload();
await eventually('what was changed', async () => (await page.getByLabel('Author', { exact: true }).inputValue()) === 'A teacher');
assert.match(await page.title(), /mine\.iqr/);

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

step('a new system without a file can be resumed when the page is loaded again');
page = await open('');
await menu(page, 'New…');
await page.getByRole('dialog').getByRole('button', { name: 'Create' }).click();
await page.getByRole('dialog').waitFor({ state: 'detached' }); // then the new system is open
await page.getByLabel('Author', { exact: true }).fill('A student');
await page.getByLabel('Author', { exact: true }).press('Enter');
const oneStep = page.getByRole('button', { name: 'Step one cycle' });
await oneStep.click();
await eventually('a cycle after the change', async () => (await cycle(page)) === 1);
const changed = Date.now(); // what is kept from now on has the change
await oneStep.click();
await sessionIsKept(page, changed);
page.once('dialog', (question) => question.accept());
await page.reload();
await page.getByRole('button', { name: 'Resume it' }).click();
await eventually('what was changed', async () => (await page.getByLabel('Author', { exact: true }).inputValue()) === 'A student');
await page.close();

step('an exercise of the tutorial sets itself up');
page = await open('?exercise=2-reactive-layer:2');
await eventually('its system', async () => (await page.locator('button.name').textContent()).includes('reflex without'));
await eventually('the panels of the exercise', async () => (await page.getByText('Motor In').count()) > 0);
await page.close();

assert.deepEqual(faults, []);
await browser.close();
step('all fine');
