// Plots: choosing cells and states, scales, files, and following the model; in Chromium: node plots_test.mjs FORAGE SOURCES [SCREENSHOT]
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { inBrowser } from './support.mjs';

const [forage, sources, screenshot] = process.argv.slice(2).map((p) => resolve(p));
const step = (text) => console.log(text);

await inBrowser(sources, async ({ context, start, until }) => {
  const page = await context.newPage();
  page.setDefaultTimeout(10000);
  const faults = [];
  page.on('pageerror', (e) => faults.push(e.message));
  await page.goto(await start(forage).address);
  const inspector = page.getByRole('region', { name: 'Inspector' });
  const tree = page.getByRole('navigation');
  const plot = (name) => page.getByRole('group', { name, exact: true });
  const show = (tab) => page.locator('.dv-tab', { hasText: tab }).filter({ hasText: new RegExp(`^${tab.replace(/[()]/g, '\\$&')}$`) }).click();
  const cycle = (n) => until(page, `cycle ${n}`, (wanted) => Number(document.querySelector('[aria-label="Moment of the run"]')?.value) >= wanted, n);
  const shot = async (name) => screenshot && page.screenshot({ path: `${screenshot}.${name}.png` });
  const keysOf = () => page.locator('.key .name').allInnerTexts();

  step('space: a drag selects cells, Ctrl adds, and their mean is said');
  const space = plot('Space plot of Bug/Motor');
  const cells = space.getByRole('application');
  await cells.waitFor();
  await page.getByRole('button', { name: '4×' }).click();
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await cycle(60);
  await page.getByRole('button', { name: 'Pause', exact: true }).click();
  const at = async (x, y) => {
    const r = await cells.boundingBox();
    return [r.x + ((x - 0.5) / 9) * r.width, r.y + ((y - 0.5) / 9) * r.height];
  };
  const drag = async (from, to) => {
    await page.mouse.move(...(await at(...from)));
    await page.mouse.down();
    await page.mouse.move(...(await at(...to)), { steps: 4 });
    await page.mouse.up();
  };
  await drag([4, 4], [6, 5]);
  const chosen = space.getByRole('group', { name: 'Selected cells' });
  await chosen.getByText('6 cells, mean').waitFor();
  await page.keyboard.down('Control');
  await drag([1, 1], [2, 1]);
  await page.keyboard.up('Control');
  await chosen.getByText('8 cells, mean').waitFor();
  await shot('selected');
  await page.keyboard.press('Escape');
  await chosen.waitFor({ state: 'detached' });

  step('space: the mean is that of the cells, which are read with the arrow keys; Shift selects');
  await page.mouse.click(...(await at(4, 1)));
  const reading = async () => Number((await space.getByRole('status').first().innerText()).split(') ')[1]);
  await space.getByText('(4, 1)').waitFor();
  let sum = await reading();
  for (const key of ['ArrowRight', 'ArrowRight']) {
    await page.keyboard.press(`Shift+${key}`);
    sum += await reading();
  }
  await chosen.getByText('3 cells, mean').waitFor();
  const mean = Number((await chosen.innerText()).match(/mean ([\d.e-]+)/)[1]);
  assert.ok(sum > 0 && Math.abs(mean - sum / 3) < 1e-3 * Math.max(1, mean), `${mean} is not ${sum / 3}`);
  await page.keyboard.press('Shift+ArrowDown');
  await chosen.getByText('6 cells, mean').waitFor();

  step('space: the selection over time, as a mean and as cells');
  await chosen.getByRole('button', { name: 'Mean', exact: true }).click();
  await until(page, 'the mean over time', () => document.querySelector('.key .name')?.textContent === 'mean(Bug/Motor:act(4..6,1..2))');
  await show('Bug/Motor');
  await chosen.getByRole('button', { name: 'Cells', exact: true }).click();
  await until(page, 'six cells over time', () => [...document.querySelectorAll('.key .name')].some((n) => n.textContent === 'Bug/Motor:act(6,2)'));
  assert.equal((await keysOf()).filter((k) => /^Bug\/Motor:act\(\d,\d\)$/.test(k)).length, 6);

  step('time: a state and cells are chosen from lists or typed; what does not exist is said there');
  const time = page.locator('.panel:has(.uplot)').filter({ visible: true });
  await show('mean(Bug/Motor:act(4..6,1..2)) over time');
  const editor = page.getByRole('form', { name: 'Add a source' });
  await time.getByRole('button', { name: 'Add', exact: true }).click();
  await editor.getByLabel('Group or connection').selectOption('Bug/Light');
  await editor.getByLabel('State').selectOption('excIn');
  await editor.getByLabel('Cells').fill('1..3,1');
  await editor.getByLabel('Cells').press('Tab');
  assert.equal(await editor.getByLabel('Source').inputValue(), 'mean(Bug/Light:excIn(1..3,1))');
  await shot('editor');
  await editor.getByRole('button', { name: 'Add' }).click();
  await time.getByRole('button', { name: 'Change mean(Bug/Light:excIn(1..3,1))' }).waitFor();
  await time.getByRole('button', { name: 'Add', exact: true }).click();
  for (const [text, reason] of [['Bug/Nothing', /Bug\/Nothing/], ['Bug/Motor:act', /81 cells/]]) {
    await editor.getByLabel('Source').fill(text);
    await editor.getByLabel('Source').press('Enter');
    await until(page, `the mistake of ${text}`, (t) => document.querySelector('[role=alert]')?.textContent.includes(t), text);
    assert.match(await editor.getByRole('alert').innerText(), reason);
  }
  await editor.getByLabel('Source').fill('Bug/Light(16..17,1)');
  await editor.getByLabel('Source').press('Enter');
  await time.getByRole('button', { name: 'Change Bug/Light(17,1)' }).waitFor();
  await time.getByRole('button', { name: 'Change Bug/Light(16,1)' }).click();
  await page.getByRole('form', { name: 'Change Bug/Light(16,1)' }).getByLabel('State').selectOption('inhIn');
  await page.getByRole('form').getByRole('button', { name: 'Change' }).click();
  await time.getByRole('button', { name: 'Change Bug/Light:inhIn(16,1)' }).waitFor();
  await time.getByRole('button', { name: 'Remove Bug/Light:inhIn(16,1)' }).click();

  step('time: a part that is chosen with a drag stays while the run goes on, until Escape');
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await cycle(150);
  const traces = time.getByRole('application');
  const r = await time.locator('.u-over').boundingBox();
  const zoom = async () => {
    await page.mouse.move(r.x + r.width * 0.3, r.y + r.height * 0.5);
    await page.mouse.down();
    await page.mouse.move(r.x + r.width * 0.6, r.y + r.height * 0.5, { steps: 4 });
    await page.mouse.up();
    await time.getByRole('button', { name: 'Whole' }).waitFor();
  };
  await zoom();
  await page.keyboard.press('End');
  const moment = () => time.locator('.bar > .number').first().innerText();
  const before = await moment();
  const c = await page.evaluate(() => Number(document.querySelector('[aria-label="Moment of the run"]').value));
  await cycle(c + 60);
  await page.keyboard.press('End');
  assert.equal(await moment(), before, 'the last moment of the chosen part');
  await page.keyboard.press('Shift+ArrowLeft');
  assert.ok(parseFloat(await moment()) < parseFloat(before));
  assert.match(await time.getByRole('status').innerText(), /^[\d.]+ s: mean\(Bug\/Motor:act\(4\.\.6,1\.\.2\)\) [\d.]+, /);
  await shot('zoom');
  await page.keyboard.press('Escape');
  await time.getByRole('button', { name: 'Whole' }).waitFor({ state: 'detached' });
  await page.keyboard.press('End');
  assert.ok(parseFloat(await moment()) > parseFloat(before));
  await zoom();
  await time.locator('.u-over').dblclick();
  await time.getByRole('button', { name: 'Whole' }).waitFor({ state: 'detached' });
  await page.getByRole('button', { name: 'Pause', exact: true }).click();

  step('time: the scale is kept in the layout');
  await time.getByLabel('Vertical scale').selectOption('manual');
  await time.getByLabel('Highest value').fill('2.5');
  await time.getByLabel('Highest value').press('Enter');
  await until(page, 'the layout', () => Object.keys(localStorage).some((k) => k.startsWith('layout') && localStorage.getItem(k).includes('"high":2.5')));
  await page.reload();
  await until(page, 'the scale', () => [...document.querySelectorAll('[aria-label="Highest value"]')].some((i) => i.value === '2.5'));
  await show('Bug/Motor');

  assert.deepEqual(faults, []);
  console.log('all fine');
});
