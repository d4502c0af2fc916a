// Parts in the diagram, in Chromium against the real program: added, connected, opened, made and dissolved.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { accessible, find, picture, until } from './support.mjs';

export default async function({ start, open, onDisk, faults, step }) {
  const page = await open(await start(['systems/reactive_foraging.iqr', '--world', 'systems/worlds/basic_arena.world']).address);
  const diagram = page.getByRole('group', { name: 'Diagram' }), inspector = page.getByRole('region', { name: 'Inspector' }), canvas = diagram.getByRole('application', { name: 'Canvas' });
  const node = (id) => diagram.locator(`.svelte-flow__node[data-id="${id}"]`);
  const heading = (name) => inspector.getByRole('heading', { name, exact: true }).waitFor();
  const looks = async (name) => {
    for (const [width, height] of [[1400, 900], [1024, 700], [700, 600]])
      for (const colorScheme of ['light', 'dark']) {
        await page.setViewportSize({ width, height });
        await page.emulateMedia({ colorScheme });
        if (process.env.FORAGE_PICTURES) await page.waitForTimeout(600);
        await picture(page, `parts-${name}-${width}-${colorScheme}`);
      }
    await page.setViewportSize({ width: 1400, height: 900 });
    await page.emulateMedia({ colorScheme: null });
  };
  await diagram.waitFor();
  await find(page, 'layout: build');
  await diagram.getByRole('button', { name: 'System', exact: true }).click();

  step('a part of the list is added, with its ports and constants');
  await diagram.getByRole('button', { name: 'Add a part' }).click();
  const list = page.getByRole('dialog', { name: 'Add a part' });
  await list.getByText('Built in').waitFor();
  await list.getByText('Two cells that inhibit each other and tire, and so are active in turns').waitFor();
  await list.getByText('ports drive, out').waitFor();
  await accessible(page, 'the list of parts');
  await looks('list');
  await list.getByRole('button', { name: /^Basal ganglia/i }).click();
  await list.waitFor({ state: 'detached' });
  await heading('Basal ganglia');
  await until(page, 'the constant in its form', () => [...document.querySelectorAll('aside [id]')].some((e) => /lambda$/.test(e.id)));
  const part = diagram.locator('.svelte-flow__node').filter({ hasText: 'Basal ganglia' });
  const id = await part.getAttribute('data-id');
  await part.getByText('salience', { exact: true }).waitFor();

  step('a connection leads from port to port');
  await diagram.getByRole('button', { name: 'Connect excitatory' }).click();
  await part.getByText('gpi', { exact: true }).click();
  await part.getByText('salience', { exact: true }).click();
  await inspector.getByRole('heading', { name: /^GPi to / }).waitFor();
  await canvas.focus();
  await page.keyboard.press('Control+z');

  step('its box opens; its groups are those of the file');
  await diagram.getByRole('button', { name: 'System', exact: true }).click();
  await part.dblclick({ position: { x: 40, y: 12 } });
  await diagram.getByText(/^The content of Basal ganglia is in .*basal_ganglia\.iqrProcess, and is changed there\.$/).waitFor();
  await diagram.locator('.svelte-flow__node').filter({ hasText: 'GPi' }).waitFor();
  await looks('open');

  step('it is dissolved, and undo brings it back');
  await diagram.getByRole('button', { name: 'Dissolve', exact: true }).click();
  await diagram.getByText(/^The content of Basal ganglia/).waitFor({ state: 'detached' });
  await inspector.getByText(/^Its content is in/).waitFor({ state: 'detached' });
  await until(page, 'its name can be written', () => document.querySelector('aside fieldset.form')?.disabled === false);
  await canvas.focus();
  await page.keyboard.press('Control+z');
  await diagram.getByText(/^The content of Basal ganglia/).waitFor();

  step('a process becomes a part');
  await diagram.getByRole('button', { name: 'System', exact: true }).click();
  const own = diagram.locator('.svelte-flow__node').first(), name = (await own.locator('.name').innerText()).trim();
  await own.click({ button: 'right', position: { x: 40, y: 12 } });
  await page.getByRole('menuitem', { name: 'Make a part of this' }).click();
  const dialog = page.getByRole('dialog', { name: 'Make a part' });
  await dialog.getByLabel('Name').fill('Mine.iqrProcess');
  await dialog.getByRole('button', { name: 'Make the part' }).click();
  await dialog.waitFor({ state: 'detached' });
  await page.getByText(`${name} uses Mine.iqrProcess now.`).waitFor();
  assert.match(readFileSync(await onDisk(page, 'systems/Mine.iqrProcess'), 'utf8'), /<Port /);
  await own.locator('.port').first().waitFor();
  await looks('system');
  await canvas.focus();
  await page.keyboard.press('Control+z');
  await own.locator('.port').first().waitFor({ state: 'detached' });

  assert.deepEqual(faults, []);
}
