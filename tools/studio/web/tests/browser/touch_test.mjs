// Running and touching: driving a group, chosen parameters and their files, seed, speed, undo of moves, worlds, the end.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { find, picture, until } from './support.mjs';

export default async function({ site, start, open, onDisk, faults, step }) {
  const studio = start(['systems/reactive_foraging.iqr', '--world', 'systems/worlds/basic_arena.world']);
  const page = await open(await studio.address);
  const tree = page.getByRole('navigation'), inspector = page.getByRole('region', { name: 'Inspector' }), dialog = page.locator('dialog[open]');
  const press = async (...keys) => {
    for (const k of keys) await page.keyboard.press(k);
  };

  step('a group is driven by keys alone, by a list of patterns in another order');
  await tree.getByText('Motor', { exact: true }).click();
  await inspector.getByRole('button', { name: 'Drive' }).click();
  const drive = page.getByRole('group', { name: 'Drive Bug/Motor' });
  const cells = drive.getByRole('application');
  await cells.focus();
  await press('Home', 'Space');
  await drive.getByText('Cell (1, 1): 1').waitFor();
  await drive.getByRole('button', { name: 'Add to list' }).click();
  await cells.focus();
  await press('Home', 'Delete', 'ArrowRight', 'Shift+ArrowRight');
  await drive.getByText('Cell (3, 1): 1').waitFor();
  await drive.getByRole('button', { name: 'Add to list' }).click();
  await drive.getByRole('button', { name: 'Pattern 2 earlier' }).click();
  await drive.getByLabel('step').fill('2');
  await drive.getByLabel('backwards').check();
  await picture(page, 'drive');
  await drive.getByRole('button', { name: 'Send' }).click();
  await page.getByText('Bug/Motor driven by hand').waitFor();
  await drive.getByRole('button', { name: 'Save…' }).click();
  await dialog.getByLabel('Name').fill('list');
  await press('Enter');
  await page.getByText(/The patterns are in .*list\.txt/).waitFor();
  const list = async () => readFileSync(await onDisk(page, 'systems/list.txt'), 'utf8');
  assert.match(await list(), /^0 0 1 0/, 'the second pattern is the first now');
  await drive.getByRole('button', { name: 'Invert order' }).click();
  await drive.getByRole('button', { name: 'Save…' }).click();
  await dialog.getByLabel('Name').fill('list.txt');
  await press('Enter');
  await dialog.getByRole('button', { name: 'Replace the file' }).click();
  await until(page, 'the dialog is closed', () => !document.querySelector('dialog[open]'));
  assert.match(await list(), /^1 0 0 0/);
  for (let i = 0; i < 2; i++) await drive.getByRole('button', { name: /^Delete pattern/ }).click();
  assert.equal(await drive.getByRole('button', { name: /^Pattern \d$/ }).count(), 0);
  await drive.getByRole('button', { name: 'Open…' }).click();
  await dialog.getByRole('button', { name: 'list.txt' }).click();
  await press('Enter');
  await drive.getByRole('button', { name: 'Pattern 2', exact: true }).waitFor();
  await page.getByRole('button', { name: 'End', exact: true }).click();
  await page.getByText('Bug/Motor driven by hand').waitFor({ state: 'detached' });

  step('a group and a connection that are dropped on the chosen parameters bring theirs; values are written and read');
  await find(page, 'Chosen parameters');
  const chosen = page.getByRole('group', { name: 'Chosen parameters' });
  await tree.getByText('GPS', { exact: true }).dragTo(chosen.locator('.body'));
  await chosen.locator('.head', { hasText: 'Bug/GPS' }).first().waitFor();
  const rows = await chosen.locator('.row').count();
  await tree.locator('[data-id="connections"]').click();
  await tree.locator('.row:has(i.excitatory)').first().dragTo(chosen.locator('.body'));
  await until(page, 'more rows', (n) => document.querySelectorAll('[aria-label="Chosen parameters"] .row').length > n, rows);
  assert.equal(await page.getByRole('group', { name: 'Space plot of Bug/GPS' }).count(), 0, 'no plot opens');
  assert.equal(await page.locator('.dv-drop-target-selection, .dv-drop-target-anchor').count(), 0, 'no frame of a drop stays');
  await picture(page, 'chosen');
  await chosen.getByRole('button', { name: 'Write…' }).click();
  await dialog.getByLabel('Name').fill('mine');
  await press('Enter');
  await page.getByText(/values are in .*mine\.pconf/).waitFor();
  assert.ok(existsSync(await onDisk(page, 'systems/mine.pconf')));
  await chosen.getByRole('button', { name: 'Read…' }).click();
  await dialog.getByRole('button', { name: 'mine.pconf' }).click();
  await press('Enter');
  await page.getByText(/values? (is|are) taken over/).waitFor();

  step('any speed; the seed is shown, and another one restarts the run');
  await page.getByRole('button', { name: /^Another speed/ }).click();
  await page.getByLabel('cycles per second').fill('12.5');
  await press('Enter');
  await page.getByRole('button', { name: 'Another speed, now 12.5 cycles per second' }).waitFor();
  const seed = page.getByLabel('Seed of the run');
  await seed.fill('42');
  await press('Enter');
  await page.getByRole('button', { name: 'Log', exact: true }).click();
  await page.getByText('--seed 42').first().waitFor();
  assert.equal(await seed.inputValue(), '42');

  step('a robot that was moved is put back by undo');
  await find(page, 'Show the arena');
  const arena = page.getByRole('application', { name: /^The world from above/ });
  await arena.focus();
  await press('Tab', 'ArrowRight', 'ArrowRight', 'ArrowRight');
  await page.getByTitle(/^Undo: move /).waitFor();
  await page.getByRole('button', { name: 'Undo' }).click();
  await page.getByTitle(/^Redo: move /).waitFor();

  step('a light is moved while the run continues, and put back');
  for (let i = 0; i < 3; i++) await page.getByRole('button', { name: 'Step one cycle' }).click();
  await arena.focus();
  await press('Tab', 'Tab', 'Shift+ArrowLeft');
  await page.getByText('The run continues in the edited world').waitFor();
  const cycle = () => page.getByLabel('Moment of the run').inputValue();
  assert.equal(await cycle(), '3');
  await page.getByRole('button', { name: 'Undo' }).click();
  await page.getByTitle(/^Redo: move /).waitFor();
  await until(page, 'the world is as in its file', () => !document.querySelector('[aria-label*="its world has changes"]'));

  step('the open system goes to another world, which is chosen from those that come with Forage');
  await find(page, 'Another world');
  await dialog.getByLabel('A world that comes with Forage').selectOption({ label: 'open arena' });
  await dialog.getByRole('button', { name: 'Open', exact: true }).click();
  await page.getByText(/restarts in open_arena/).waitFor();
  await until(page, 'its name', () => document.querySelector('header .world')?.textContent.includes('open_arena'));
  await picture(page, 'world');

  assert.deepEqual(faults, []);
  if (site) return;

  step('quit ends the program');
  const ended = new Promise((done) => {
    studio.child.removeAllListeners('exit');
    studio.child.on('exit', done);
  });
  await page.locator('button.name').click();
  await page.getByRole('menuitem', { name: 'Quit…' }).click();
  await dialog.getByRole('button', { name: /^Quit/ }).click();
  assert.equal(await ended, 0);
  await page.getByText('Forage has ended.').waitFor();
  assert.deepEqual(faults, []);
}
