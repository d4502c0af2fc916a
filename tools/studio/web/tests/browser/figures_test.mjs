// Figures: the dialog, what it exports, and that its commands make the same file; in Chromium.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { accessible, find, picture, until } from './support.mjs';

export default async function({ forage, site, folder, start, open, step }) {
  const page = await open(await start().address);
  const dialog = page.getByRole('dialog', { name: 'Export figure' });
  const plot = (name) => page.getByRole('group', { name, exact: true });
  const drawn = () => dialog.getByRole('img').waitFor();
  const cycle = () => page.evaluate(() => Number(document.querySelector('[aria-label="Moment of the run"]').value));
  /** The content of the exported file, and of the one that the commands make. */
  async function both(act) {
    const commands = (await dialog.getByRole('region', { name: 'Commands' }).innerText()).replaceAll('/home/web_user/', ''); // where a browser keeps what is in `folder` here
    const [download] = await Promise.all([page.waitForEvent('download'), act()]);
    await page.getByText(`${download.suggestedFilename()} is in the downloads of the browser.`).waitFor();
    execFileSync('bash', ['-c', `set -e; forage() { "${forage}" "$@" > log; }\n${commands}`], { cwd: folder, stdio: 'pipe' });
    return [readFileSync(await download.path()), readFileSync(join(folder, 'forage-out', download.suggestedFilename())), commands];
  }

  step('a run that has not begun has no figure over time, and says so');
  await page.locator('.dv-tab', { hasText: 'Bug/Motor' }).first().click();
  await plot('Space plot of Bug/Motor').getByLabel('Save').selectOption({ label: 'Figure…' });
  await dialog.getByText('there is nothing to draw yet').waitFor();
  assert.ok(await dialog.getByRole('button', { name: 'Export' }).isDisabled());
  await page.keyboard.press('Escape');

  step('a plot is exported with its axes, and its commands make the same bytes');
  await page.getByRole('button', { name: '4×' }).click();
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await until(page, 'cycle 200', () => Number(document.querySelector('[aria-label="Moment of the run"]')?.value) >= 200);
  await page.getByRole('button', { name: 'Pause', exact: true }).click();
  await plot('Space plot of Bug/Motor').getByLabel('Save').selectOption({ label: 'Figure…' });
  await drawn();
  await accessible(page, 'the dialog');
  for (const [width, height] of [[1400, 900], [1024, 700], [700, 600]]) {
    await page.setViewportSize({ width, height });
    await picture(page, `figure-${width}`);
    assert.ok((await dialog.getByRole('button', { name: 'Export' }).boundingBox()).y < height - 20, `the button at ${width}`);
  }
  await page.setViewportSize({ width: 1400, height: 900 });
  assert.equal(await dialog.getByLabel('Format').inputValue(), 'png');
  await dialog.getByLabel('Format').selectOption('svg');
  await dialog.getByLabel(/^Width/).first().selectOption('mm');
  await until(page, 'the commands', () => document.querySelector('[aria-label=Commands]')?.textContent.includes("--width '85mm' --plot-format svg"));
  const [space, ofCommands] = await both(() => dialog.getByRole('button', { name: 'Export' }).press('Enter'));
  assert.ok(space.equals(ofCommands) && space.includes('<svg'));
  await dialog.waitFor({ state: 'hidden' });

  step('a figure over time begins where its panel does, or at another cycle; by keyboard');
  await page.getByRole('navigation').getByText('Light', { exact: true }).click();
  await page.getByRole('region', { name: 'Inspector' }).getByRole('button', { name: 'Raster' }).click();
  await plot('Raster plot of Bug/Light').waitFor();
  const now = await cycle();
  await find(page, 'Panel: export figure…');
  await drawn();
  await dialog.getByLabel('Format').selectOption('pdf');
  const from = dialog.getByLabel('First cycle');
  assert.equal(await from.inputValue(), String(Math.max(0, now - 400)));
  await from.fill('100');
  await from.press('Tab');
  await until(page, 'the commands', () => document.querySelector('[aria-label=Commands]')?.textContent.includes('--record-from 100'));
  const [raster, again, commands] = await both(() => dialog.getByRole('button', { name: 'Export' }).click());
  // A PDF holds its fonts: those of the site may be another version than those of this machine.
  assert.ok((site || raster.equals(again)) && raster.subarray(0, 4).toString() === '%PDF', commands);

  step("the arena has the robot's path, the trials their curve, the diagram itself");
  for (const [name, shown] of [['Arena', 'trajectory'], ['Diagram', 'diagram']]) {
    await page.locator('.dv-tab', { hasText: name }).first().click({ button: 'right' });
    await page.getByRole('menuitem', { name: 'Export figure…' }).click();
    await drawn();
    assert.match(await dialog.getByRole('region', { name: 'Commands' }).innerText(), new RegExp(`forage plot .*'${shown}'`));
    await picture(page, `figure-${shown}`);
    await page.keyboard.press('Escape');
  }
}
