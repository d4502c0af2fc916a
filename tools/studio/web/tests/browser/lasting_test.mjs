// What lasts in Chromium against the real program: node lasting_test.mjs FORAGE SOURCES
import assert from 'node:assert/strict';
import { resolve } from 'node:path';
import { inBrowser } from './support.mjs';

const [forage, sources] = process.argv.slice(2).map((p) => resolve(p));
const step = (text) => console.log(text);
const cycle = (page) => page.getByLabel('Moment of the run').inputValue().then(Number);

await inBrowser(sources, async ({ context, start, until }) => {
  step('a studio that is killed: the next one offers to go on, with the panels and the comparison as they were');
  const first = start(forage);
  const page = await context.newPage();
  await page.goto(await first.address);
  await page.getByRole('group', { name: 'Space plot of Bug/Motor' }).waitFor();
  await page.getByRole('navigation').getByText('CS', { exact: true }).first().dblclick();
  await page.getByRole('group', { name: /^Space plot of .*\/CS$/ }).waitFor();
  for (let i = 0; i < 7; i++) await page.locator('body').press('.');
  await until(page, 'seven cycles', () => document.querySelector('[aria-label="Moment of the run"]')?.value === '7');
  await page.getByRole('button', { name: 'Compare from here' }).click();
  await page.getByRole('button', { name: 'End comparison' }).waitFor();
  await page.locator('[aria-label^="Space plot of"] canvas.reference').first().waitFor();
  await page.waitForTimeout(2500); // it is kept one second after the last change
  first.child.removeAllListeners('exit');
  first.child.kill('SIGKILL');

  step('the page of the one that was killed says so, and how to go on, until it reaches the next one');
  const gone = page.getByRole('alert').filter({ hasText: 'Forage has ended or cannot be reached' });
  await gone.getByText('forage studio systems/dac_foraging.iqr --world systems/worlds/basic_arena.world --recover', { exact: true }).waitFor();

  const second = start(forage, ['systems/dac_foraging.iqr', '--world', 'systems/worlds/basic_arena.world', '--port', new URL(page.url()).port]);
  const again = await context.newPage();
  await again.goto(await second.address);
  await again.getByText("This system's last session was not closed.").waitFor();
  assert.equal(await cycle(again), 0);
  await again.getByRole('button', { name: 'Go on with it' }).click();
  await until(again, 'cycle 7', () => document.querySelector('[aria-label="Moment of the run"]')?.value === '7');
  await again.getByRole('group', { name: /^Space plot of .*\/CS$/ }).waitFor();
  await again.getByRole('button', { name: 'End comparison' }).waitFor();
  await again.locator('[aria-label^="Space plot of"] canvas.reference').first().waitFor();
  assert.equal(await again.getByText("This system's last session was not closed.").count(), 0);
  await gone.waitFor({ state: 'detached' });
  await until(page, 'cycle 7 in the page of the first one', () => document.querySelector('[aria-label="Moment of the run"]')?.value === '7');
  console.log('all fine');
});
