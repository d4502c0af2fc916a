// The pictures of the docs: node screenshot.mjs FORAGE SOURCES OUTPUT [WIDTH HEIGHT light|dark [tutorial|build]]
import { spawn } from 'node:child_process';
import { resolve } from 'node:path';
import { launch } from './support.mjs';

const [forage, sources, output] = process.argv.slice(2, 5).map((p) => resolve(p));
const [width = 1400, height = 900, colorScheme = 'light', shown] = process.argv.slice(5);
const tutorial = shown === 'tutorial';
const studio = spawn(forage, ['studio', shown === 'build' ? 'systems/reactive_foraging.iqr' : 'systems/dac_foraging.iqr', '--world', 'systems/worlds/basic_arena.world'], { cwd: sources });
const address = await new Promise((found) => studio.stdout.on('data', (text) => found(/http:\/\/\S+/.exec(text)[0])));
const browser = await launch();
try {
  const page = await browser.newPage({ viewport: { width: Number(width), height: Number(height) }, colorScheme });
  await page.goto(address);
  await page.getByRole('group', { name: 'Arena' }).waitFor();
  const find = async (text) => {
    await page.keyboard.press('Control+k');
    await page.keyboard.type(text);
    await page.keyboard.press('Enter');
  };
  if (shown === 'build') {
    await find('layout: build');
    await page.getByRole('group', { name: 'Diagram' }).getByRole('button', { name: 'Reactive Layer' }).click();
    await find('US to Approach');
    await page.getByRole('region', { name: 'Inspector' }).getByText('3 synapses', { exact: true }).waitFor();
  } else if (tutorial) {
    await page.getByRole('button', { name: 'Tutorial', exact: true }).click();
    const text = page.getByRole('group', { name: 'Tutorial', exact: true });
    await text.getByTitle('Tutorial 3: the adaptive layer').click();
    await text.locator('[data-open="1"]').click();
    await text.locator('.setup.active').waitFor();
    await page.getByRole('group', { name: 'Arena' }).getByRole('button', { name: '3-D' }).click();
  } else {
    await find('layout: part 2');
    await page.getByRole('group', { name: 'Space plot of Reactive Layer/Approach' }).waitFor();
    await find('bug/motor');
    await page.getByRole('region', { name: 'Inspector' }).getByRole('heading', { name: 'Bug/Motor' }).waitFor();
  }
  if (shown !== 'build') {
    // The last cycles are steps, so that the picture shows the same moment on each machine: the robot turns to the light, and Approach is active.
    const last = tutorial ? 3490 : 1843;
    const reached = (cycle) => page.waitForFunction((c) => Number(document.querySelector('[aria-label="Moment of the run"]')?.value) >= c, cycle, { polling: 50 });
    await page.getByRole('button', { name: '4×', exact: true }).click();
    await page.getByRole('button', { name: 'Run', exact: true }).click();
    await reached(last - 200);
    await page.getByRole('button', { name: 'Pause', exact: true }).click();
    await page.getByRole('button', { name: 'Run', exact: true }).waitFor();
    for (let c = Number(await page.getByLabel('Moment of the run').inputValue()); c < last; c++) await page.keyboard.press('.');
    await reached(last);
  }
  await page.evaluate(() => document.activeElement.blur());
  await page.waitForTimeout(500);
  await page.screenshot({ path: output });
} finally {
  await browser.close();
  studio.kill('SIGINT');
}
