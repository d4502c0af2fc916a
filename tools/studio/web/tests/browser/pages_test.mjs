// Several pages of one session, in Chromium against the real program.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { answered, until } from './support.mjs';

export default async function({ site, folder, start, open, faults, step }) {
  if (site) return step('each page has a session of its own there');
  const address = await start(['systems/reactive_foraging.iqr', '--world', 'systems/worlds/basic_arena.world']).address;
  const show = async (url) => {
    const page = await open(url);
    await page.getByRole('navigation').getByText('UR', { exact: true }).waitFor();
    return page;
  };
  const page = await show(address), second = await show(new URL(address).origin);
  const row = (p, name) => p.getByRole('navigation').getByText(name, { exact: true }).first();
  const plot = (p, name) => p.getByRole('group', { name: `Space plot of Selection/${name}` });

  step('an edit of one page closes panels of the second page, which says that Undo brings them back');
  await row(second, 'UR').dblclick();
  await plot(second, 'UR').waitFor();
  await row(page, 'UR').click();
  await page.keyboard.press('Delete');
  await plot(second, 'UR').waitFor({ state: 'detached' });
  await second.getByText('Undo brings back both.').waitFor();
  await page.keyboard.press('Control+z');
  await plot(second, 'UR').waitFor();
  await second.getByRole('button', { name: 'Close the message' }).click();
  await second.getByText('Undo brings back both.').waitFor({ state: 'detached' });

  step('another system that is opened in one page is another one in the other page, too, also when it has the same ids');
  const other = join(folder, 'systems/other.iqr');
  writeFileSync(other, readFileSync(join(folder, 'systems/reactive_foraging.iqr'), 'utf8').replaceAll('"selection.ur"', '"selection.reflex"').replace('name="UR"', 'name="Reflex"'));
  await page.keyboard.press('Control+o');
  await page.getByRole('dialog').getByLabel('Name', { exact: true }).fill(other);
  await page.keyboard.press('Enter');
  await row(second, 'Reflex').waitFor();
  await plot(second, 'UR').waitFor({ state: 'detached' });
  await answered(second);
  assert.equal(await second.getByText('Undo brings back').count(), 0);
  await row(second, 'Reflex').dblclick();
  await plot(second, 'Reflex').waitFor();
  await page.keyboard.press('.');
  await until(second, 'the first cycle', () => document.querySelector('[aria-label="Moment of the run"]')?.value === '1');

  assert.deepEqual(faults, []);
}
