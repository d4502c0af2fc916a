// What lasts in Chromium against the real program.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { eventually, find, picture, until } from './support.mjs';

const cycle = (page) => page.getByLabel('Moment of the run').inputValue().then(Number);

export default async function({ site, folder, start, open, step }) {
  if (site) return step('without_server.mjs has what lasts there');
  step('a studio that is killed: the next one offers to continue, with the panels and the comparison as they were');
  const first = start();
  const page = await open(await first.address);
  await page.getByRole('group', { name: 'Space plot of Bug/Motor' }).waitFor();
  await page.getByRole('navigation').getByText('CS', { exact: true }).first().dblclick();
  await page.getByRole('group', { name: /^Space plot of .*\/CS$/ }).waitFor();
  for (let i = 0; i < 7; i++) await page.locator('body').press('.');
  await until(page, 'seven cycles', () => document.querySelector('[aria-label="Moment of the run"]')?.value === '7');
  await page.getByRole('button', { name: 'Compare from here' }).click();
  await page.getByRole('button', { name: 'End comparison' }).waitFor();
  await page.locator('[aria-label^="Space plot of"] canvas.reference').first().waitFor();
  // The panels are kept one second after the last change.
  const kept = () =>
    readdirSync(join(folder, 'state'), { recursive: true, withFileTypes: true }).filter((f) => f.isFile() && !f.name.endsWith('.part')).some((f) =>
      ['"compare":{"changed":{},"from":7}', '"Adaptive/CS"'].every((part) => readFileSync(join(f.parentPath, f.name)).includes(part))
    );
  await eventually('the session is kept', kept);
  first.child.removeAllListeners('exit');
  first.child.kill('SIGKILL');

  step('the page of the one that was killed says so, and how to continue');
  const gone = page.getByRole('alert').filter({ hasText: 'Forage has ended or cannot be reached' });
  await gone.getByText('forage studio systems/dac_foraging.iqr --world systems/worlds/basic_arena.world --recover', { exact: true }).waitFor();

  const second = start(['systems/dac_foraging.iqr', '--world', 'systems/worlds/basic_arena.world', '--port', new URL(page.url()).port]);
  const again = await open(await second.address);
  await again.getByText("This system's last session was not closed.").waitFor();
  assert.equal(await cycle(again), 0);
  await again.getByRole('button', { name: 'Resume it' }).click();
  await until(again, 'cycle 7', () => document.querySelector('[aria-label="Moment of the run"]')?.value === '7');
  await again.getByRole('group', { name: /^Space plot of .*\/CS$/ }).waitFor();
  await again.getByRole('button', { name: 'End comparison' }).waitFor();
  await again.locator('[aria-label^="Space plot of"] canvas.reference').first().waitFor();
  assert.equal(await again.getByText("This system's last session was not closed.").count(), 0);

  step('the page of the first one has no token of the second one, and says what to do');
  await page.getByText("This tab has no key: the address bar hides it. Use the studio's first tab, or the address that 'forage studio' printed.").waitFor();
  await gone.waitFor({ state: 'detached' });
  await page.goto(await second.address);
  await until(page, 'cycle 7 in the page of the first one', () => document.querySelector('[aria-label="Moment of the run"]')?.value === '7');
  await page.reload();
  await until(page, 'cycle 7 after a reload', () => document.querySelector('[aria-label="Moment of the run"]')?.value === '7');
  assert.equal(new URL(page.url()).search, '');
  assert.deepEqual(await page.context().cookies(), []);

  step('a backup is opened from under its file, and does not replace it without a question');
  const file = join(folder, 'systems/dac_foraging.iqr'), content = readFileSync(file, 'utf8');
  await again.keyboard.press('Control+b');
  await again.getByText(/^The backup is dac_foraging\.iqr,/).waitFor();
  await again.keyboard.press('Control+o');
  const opening = again.getByRole('dialog', { name: 'Open a system' });
  await opening.getByText('a backup', { exact: true }).click();
  await opening.getByRole('button', { name: /^(today|yesterday), \d\d:\d\d:\d\d$/ }).click();
  await picture(again, 'backups');
  await opening.getByRole('button', { name: 'Open', exact: true }).click();
  const name = again.getByRole('button', { name: /^DAC foraging backup/ });
  await name.waitFor();
  await find(again, 'Learning/CS');
  const field = again.getByRole('region', { name: 'Inspector' }).getByLabel('Name', { exact: true });
  await field.fill('Changed');
  await field.press('Enter');
  await until(again, 'a change', () => document.title.startsWith('●'));
  await again.keyboard.press('Control+s');
  const saving = again.getByRole('dialog', { name: 'Save as' });
  assert.equal(await saving.getByLabel('Name', { exact: true }).inputValue(), 'dac_foraging.iqr');
  await saving.getByRole('button', { name: 'Save', exact: true }).click();
  await saving.getByRole('button', { name: 'Replace the file' }).waitFor();
  assert.equal(readFileSync(file, 'utf8'), content);
  await saving.getByRole('button', { name: 'Replace the file' }).click();
  await saving.waitFor({ state: 'detached' });
  await until(again, 'the file itself', () => document.title.includes('dac_foraging.iqr)') && !document.title.startsWith('●'));
  await name.waitFor({ state: 'detached' });
  assert.match(readFileSync(file, 'utf8'), /name="Changed"/);
}
