// The world's file is edited on a map, in Chromium against the real program: node world_test.mjs FORAGE SOURCES
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import { inBrowser } from './support.mjs';

const [forage, sources] = process.argv.slice(2).map((p) => resolve(p));
const step = (text) => console.log(text);

await inBrowser(sources, async ({ folder, context, start, until }) => {
  const faults = [];
  const file = 'systems/worlds/basic_arena.world';
  const original = readFileSync(join(folder, file), 'utf8');
  const studio = start(forage, ['systems/reactive_foraging.iqr', '--world', file]);
  const page = await context.newPage();
  page.setDefaultTimeout(20000);
  page.on('pageerror', (e) => faults.push(e.message));
  page.on('console', (m) => m.type() === 'error' && faults.push(m.text()));
  await page.goto(await studio.address);
  await page.getByRole('group', { name: 'Arena' }).waitFor();
  await page.getByRole('button', { name: /Reactive foraging/ }).first().click();
  await page.getByRole('menuitem', { name: 'Edit the world' }).click();
  const world = page.getByRole('group', { name: 'World', exact: true });
  const map = world.getByRole('group', { name: 'Map of the world' });
  await map.waitFor();
  const field = (label) => world.getByLabel(label, { exact: true });
  const at = async (x, y) => {
    const box = await map.boundingBox();
    return [box.x + box.width * x, box.y + box.height * y];
  };

  step('a wall is added by a click, dragged, and given numbers');
  const items = await map.getByRole('button').count();
  await world.getByRole('button', { name: 'wall', exact: true }).click();
  await page.mouse.click(...(await at(0.4, 0.42)));
  const wall = map.locator('.chosen');
  await wall.waitFor();
  const name = await field('Name').inputValue();
  assert.equal(await map.getByRole('button').count(), items + 1);
  const before = Number(await field('x, m').inputValue());
  await page.mouse.move(...(await at(0.4, 0.42)));
  await page.mouse.down();
  await page.mouse.move(...(await at(0.45, 0.42)), { steps: 3 });
  await page.mouse.up();
  await until(page, 'the wall moves', (x) => Number(document.querySelector('[aria-label^="Properties of"] input[type=number]')?.value) > x, before + 0.05);
  await field('Width, m').fill('1.5');
  await field('Width, m').press('Enter');

  step('a patch is added and taken away by keys; undo takes the last step back');
  await world.getByRole('button', { name: 'patch', exact: true }).focus();
  await page.keyboard.press('Enter');
  await until(page, 'another item', (n) => document.querySelectorAll('[aria-label="Map of the world"] .item').length === n, items + 2);
  await map.locator('.chosen').focus();
  await page.keyboard.press('Delete');
  await until(page, 'it is gone', (n) => document.querySelectorAll('[aria-label="Map of the world"] .item').length === n, items + 1);
  await page.keyboard.press('Control+z');
  await until(page, 'it is back', (n) => document.querySelectorAll('[aria-label="Map of the world"] .item').length === n, items + 2);

  step('axe finds no serious fault of accessibility');
  await page.evaluate(readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8'));
  const serious = await page.evaluate(async () => (await window.axe.run({ exclude: ['.dv-tab'] }, { resultTypes: ['violations'] })).violations.filter((v) => ['serious', 'critical'].includes(v.impact)).map((v) => `${v.id}: ${v.nodes.slice(0, 3).map((n) => n.html.slice(0, 160)).join(' | ')}`));
  assert.deepEqual(serious, []);

  step('saved under another name, the rest of the file keeps its bytes; the command line checks it');
  await world.getByRole('button', { name: 'Save as…' }).click();
  const dialog = page.getByRole('dialog', { name: 'Save the world as' });
  const path = join(folder, 'systems/worlds/mine.world');
  await dialog.getByLabel('Name').fill(path);
  await dialog.getByLabel('Name').press('Enter');
  await page.getByText('in mine').waitFor();
  const saved = readFileSync(path, 'utf8').split('\n');
  assert.ok(original.split('\n').every((line) => saved.includes(line)), 'lines of the original are missing');
  assert.ok(saved.some((line) => line.includes(name)));
  execFileSync(forage, ['check', 'systems/reactive_foraging.iqr', '--world', path], { cwd: folder });
  assert.deepEqual(faults, []);
  console.log('all fine');
});
