// Forms and the diagram beside each other, in Chromium against the real program.
import assert from 'node:assert/strict';
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { find, picture, until } from './support.mjs';

export default async function({ site, folder, context, start, open, faults, step }) {
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  const begin = async (args) => {
    const page = await open(await start(args).address);
    await page.getByRole('group', { name: 'Arena' }).waitFor();
    return page;
  };
  const page = await begin(['systems/dac_foraging.iqr', '--world', 'systems/worlds/basic_arena.world']);
  const diagram = page.getByRole('group', { name: 'Diagram' }), inspector = page.getByRole('region', { name: 'Inspector' }), tree = page.getByRole('navigation');
  const canvas = diagram.getByRole('application', { name: 'Canvas' });
  const node = (id) => diagram.locator(`.svelte-flow__node[data-id="${id}"]`);
  const heading = (name) => inspector.getByRole('heading', { name, exact: true }).waitFor();
  const pageIs = (name) => diagram.getByRole('group', { name: `Page of ${name}`, exact: true }).waitFor();
  const alert = (text) => inspector.getByRole('alert').filter({ hasText: text }).waitFor();
  const row = (id) => tree.locator(`[data-id="${id}"]`);
  const download = async (act) => {
    const [file] = await Promise.all([page.waitForEvent('download'), act()]);
    const path = join(folder, file.suggestedFilename());
    await file.saveAs(path);
    return path;
  };
  await find(page, 'layout: build');

  step('a page of the diagram is selected with its process, and what is chosen elsewhere opens its page');
  await diagram.getByRole('button', { name: 'Adaptive', exact: true }).click();
  await heading('Adaptive');
  await row('bug.motor').click();
  await pageIs('Bug');
  await node('bug.motor').locator('.selected').waitFor();
  assert.match(await node('bug.motor').locator('.item').getAttribute('title'), /Bug\/Motor.*\n.*9 × 9 cells\nto _motor of the module/);
  await node('bug.light').getByRole('img', { name: /from the module/ }).waitFor();
  await find(page, 'CR to Threshold CR');
  await pageIs('Adaptive');
  await row('system').click();
  await pageIs('the system');
  await inspector.getByLabel('Cycles per second').waitFor();
  await inspector.getByText('In this world, 30 cycles are a second: its time is 2 times as fast as the clock.').waitFor();
  await inspector.getByText('For the original iqr').click();
  await inspector.getByLabel('Port', { exact: true }).fill('54923');
  await inspector.getByLabel('Port', { exact: true }).press('Enter');
  await until(page, 'a change', () => document.title.startsWith('●'));

  step('what was chosen elsewhere is brought into view');
  await row('bug.motor').click();
  await pageIs('Bug');
  const inView = (yes) =>
    until(page, yes ? 'it is seen' : 'it is not seen', (y) => {
      const seen = document.querySelector('.flow').getBoundingClientRect(), box = document.querySelector('.svelte-flow__node[data-id="bug.light"]').getBoundingClientRect();
      return y === (box.left < seen.right && box.right > seen.left && box.top < seen.bottom && box.bottom > seen.top);
    }, yes);
  const middle = await canvas.boundingBox();
  await page.mouse.move(middle.x + middle.width / 2, middle.y + 40);
  await page.mouse.down({ button: 'middle' });
  await page.mouse.move(middle.x + middle.width / 2 + 1500, middle.y + 40, { steps: 4 });
  await page.mouse.up({ button: 'middle' });
  await inView(false);
  await find(page, 'Bug/Light');
  await inView(true);

  step('a group that takes the name of another one says how it is called until then; so does the other');
  await row('contextual.collector').click();
  await heading('Contextual/Collector');
  const called = inspector.getByLabel('Name', { exact: true });
  await called.fill('Distance');
  await called.press('Enter');
  await inspector.getByText("rename one of them; until then, this one is called 'Contextual/Distance#contextual.collector'").waitFor();
  await picture(page, 'shared-name');
  await row('contextual.distance').click();
  await inspector.getByText("there is already a group 'Contextual/Distance'").waitFor();
  assert.equal(await inspector.locator('.problem').count(), 1);
  await page.getByRole('button', { name: 'Undo' }).click();
  await inspector.locator('.problem').waitFor({ state: 'detached' });

  step('what one needs first comes first: the weight of a connection is in sight in windows of each size');
  for (const [width, height] of [[1024, 700], [700, 600], [1400, 900]]) {
    await page.setViewportSize({ width, height });
    await find(page, 'Light to US');
    await heading('Light to US');
    await inspector.getByLabel('Weight', { exact: true }).waitFor();
    await until(page, `the weight at ${width}`, () => {
      const rows = [...document.querySelectorAll('[aria-label="Inspector"] [data-field=weight]')];
      return rows.length === 1 && rows[0].getBoundingClientRect().bottom < document.querySelector('footer').getBoundingClientRect().top;
    });
  }

  step('messages cover no panel, in windows of each size');
  for (const [width, height] of [[1024, 700], [700, 700], [1400, 900]]) {
    await page.setViewportSize({ width, height });
    await page.evaluate(() => document.activeElement.blur());
    for (let i = 0; i < 2; i++) await page.keyboard.press('Control+z');
    await until(page, `a message over the status line at ${width}`, () => {
      const message = document.querySelector('.notice')?.getBoundingClientRect(), panels = document.querySelector('main').getBoundingClientRect();
      return message && message.left >= 0 && message.width > 150 && message.right <= innerWidth && message.top >= panels.bottom - 2;
    });
    await picture(page, `message-${width}`);
  }

  step('an empty name, and numbers out of their range, are refused at the field');
  await row('bug.motor').click();
  await heading('Bug/Motor');
  const name = inspector.getByLabel('Name', { exact: true });
  await name.fill(' ');
  await name.press('Enter');
  await alert('a name cannot be empty');
  assert.equal(await name.inputValue(), 'Motor');
  const columns = inspector.getByLabel('Columns');
  await columns.fill('0');
  await columns.press('Enter');
  await alert('0 is too small: 1 to');
  assert.equal(await columns.inputValue(), '0', 'what is refused can be mended');
  await columns.fill('3.7');
  await columns.press('Enter');
  await alert('3.7 is not a whole number.');
  await columns.press('Escape');
  assert.equal(await columns.inputValue(), '9');
  assert.equal(await page.getByRole('alert').filter({ hasText: 'whole number' }).count(), 0, 'the reason goes');
  const persistence = page.locator('[id="Bug/Motor.vmPrs"]');
  await persistence.fill('0x10');
  await persistence.press('Enter');
  await alert("'0x10' is not a number.");
  await persistence.fill('0,5');
  await persistence.press('Enter');
  const undo = page.getByTitle(/^Undo: Bug\/Motor.vmPrs = 0.5/);
  await undo.waitFor();
  assert.equal(await persistence.inputValue(), '0.5', 'the decimal comma');
  await page.keyboard.press('Escape');
  await heading('Bug/Motor');
  await persistence.blur();
  await page.keyboard.press('Control+z');
  await undo.waitFor({ state: 'detached' });
  await until(page, 'the former value', () => document.getElementById('Bug/Motor.vmPrs')?.value === '0');
  await persistence.fill('7');
  await persistence.press('Enter');
  await alert('7 is outside of the usual range, 0 to 1.');
  assert.equal(await persistence.inputValue(), '7', 'what is refused can be mended');
  await persistence.fill('a');
  await persistence.press('Enter');
  await alert("'a' is not a number.");
  assert.equal(await inspector.getByRole('button', { name: 'Use 7 all the same' }).count(), 0, 'one reason at a time');
  await persistence.fill('7');
  await persistence.press('Enter');
  await alert('7 is outside of the usual range, 0 to 1.');
  await page.getByRole('button', { name: /problem/ }).waitFor({ state: 'detached' });
  await inspector.getByRole('button', { name: 'Use 7 all the same' }).click();
  await page.getByTitle(/^Undo: Bug\/Motor.vmPrs = 7/).waitFor();
  await inspector.getByText('7 is outside of the usual range').waitFor({ state: 'detached' });
  await until(page, 'the unusual value is taken', () => document.getElementById('Bug/Motor.vmPrs')?.ariaInvalid === 'false');
  await page.keyboard.press('Control+z');
  await undo.waitFor({ state: 'detached' });
  await until(page, 'the former value', () => document.getElementById('Bug/Motor.vmPrs')?.value === '0');

  step('a note is written for one of several items; keys select several');
  await node('bug.light').focus();
  await page.keyboard.press('Control+Space');
  await inspector.getByText('Colour, neuron, cells and parameters act on the 2 selected groups; name and note act on this one only.').waitFor();
  await inspector.getByLabel('Note', { exact: true }).fill('Light only');
  await inspector.getByLabel('Note', { exact: true }).press('Tab');
  await node('bug.light').focus();
  await page.keyboard.press('Shift+Enter');
  await heading('Bug/Motor');
  assert.equal(await inspector.getByLabel('Note', { exact: true }).inputValue(), '');
  await find(page, 'Bug/Light');
  await until(page, 'the note', () => document.querySelector('aside textarea')?.value === 'Light only');

  step('the end of a line is chosen in its form');
  await find(page, 'CR to Threshold CR');
  await inspector.getByText('Line and note').click();
  const leaves = inspector.getByLabel('Leaves at');
  await leaves.selectOption({ label: 'Bottom 2' });
  await until(page, 'the line', () => {
    const path = document.querySelector('g.chosen .wide')?.getAttribute('d').match(/[\d.-]+/g).map(Number), box = document.querySelector('.svelte-flow__node[data-id="adaptive.cr"]');
    return path && box && Math.abs(path[1] - Number(box.style.transform.match(/[\d.-]+/g)[1]) - box.offsetHeight) < 1;
  });

  step('the page is saved as a picture, printed alone, and has an optional map');
  const svg = readFileSync(await download(() => find(page, 'Save the diagram as SVG')), 'utf8');
  assert.ok(svg.startsWith('<svg') && svg.includes('Threshold CR') && svg.includes('url(#inhibitory)'));
  await diagram.getByRole('button', { name: 'Save or print the page' }).click();
  const png = readFileSync(await download(() => page.getByRole('menuitem', { name: 'Save the page as PNG' }).click()));
  assert.ok(png.subarray(1, 4).toString() === 'PNG' && png.length > 5000);
  await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
  await page.emulateMedia({ media: 'print' });
  assert.deepEqual(await page.evaluate(() => [...document.body.children].filter((e) => e.getBoundingClientRect().height > 0).map((e) => e.className)), ['printed']);
  await page.emulateMedia({ media: null });
  await page.evaluate(() => dispatchEvent(new Event('afterprint')));
  assert.equal(await page.locator('.printed').count(), 0);
  const map = diagram.locator('.svelte-flow__minimap');
  assert.equal(await map.count(), 0);
  await diagram.getByRole('button', { name: 'View', exact: true }).click();
  await page.getByRole('menuitem', { name: 'Show the map' }).click();
  await map.waitFor();

  step('groups are copied without their connections; a process is pasted beside itself');
  const lines = () => page.locator('g[data-connection]').count();
  await node('adaptive.cr').click();
  await node('adaptive.threshold_cr').click({ modifiers: ['Control'] });
  await node('adaptive.cr').click({ button: 'right' });
  await page.getByRole('menuitem', { name: 'Copy with connections' }).waitFor();
  await page.getByRole('menuitem', { name: 'Copy groups only' }).click();
  await page.getByText('Copied 2 items.').waitFor();
  const before = await lines();
  await canvas.focus();
  await page.keyboard.press('Control+v');
  await heading('Adaptive/Threshold CR 2');
  assert.equal(await lines(), before);
  await page.keyboard.press('Control+z');
  await diagram.getByRole('button', { name: 'System', exact: true }).click();
  await node('vision').click({ position: { x: 4, y: 4 } });
  await page.keyboard.press('Control+c');
  await page.getByText('Copied.', { exact: true }).waitFor();
  await page.keyboard.press('Control+v');
  await heading('Vision 2');
  const apart = await page.evaluate(() => {
    const at = (e) => e.style.transform.match(/[\d.-]+/g).map(Number);
    const [a, b] = [document.querySelector('.svelte-flow__node[data-id="vision"]'), document.querySelector('.svelte-flow__node.selected')].map(at);
    return Math.hypot(a[0] - b[0], a[1] - b[1]);
  });
  assert.ok(apart >= 40, String(apart));
  await page.keyboard.press('Control+z');

  step('two connections offer their plots');
  await tree.getByLabel('Connections', { exact: true }).click();
  const connections = tree.locator('.row:has(i)');
  await connections.nth(0).click();
  await connections.nth(1).click({ modifiers: ['Control'] });
  await connections.nth(1).click({ button: 'right' });
  await page.getByRole('menuitem', { name: 'Wiring plots' }).waitFor();
  assert.equal(await page.getByRole('menuitem', { name: 'Space plots' }).count(), 0);
  await page.keyboard.press('Escape');

  step('tuples are drawn from cell to cell, which stay in place while names come and go, and no text is selected');
  await find(page, 'Reactive Approach to Approach');
  await inspector.getByLabel('Cells', { exact: true }).selectOption('chosen cells');
  const cellOf = (side, cell) => inspector.locator(`[data-grid="${side}"] [data-cell="${cell},1"]`);
  const below = () => cellOf('Target', 1).evaluate((c) => c.getBoundingClientRect().top - document.querySelector('[data-grid="Source"]').closest('.wiring').previousElementSibling.getBoundingClientRect().top);
  const gridAt = await below();
  for (const cell of [3, 4]) {
    await cellOf('Source', cell).dragTo(cellOf('Target', cell - 1));
    await inspector.getByText(`${cell},1 → ${cell - 1},1`).waitFor();
    assert.equal(await below(), gridAt);
  }
  assert.equal(await page.evaluate(() => String(getSelection())), '');

  step('Escape clears the cells that are marked; a warning above leaves them and the button where they are');
  const add = inspector.getByRole('button', { name: 'Add tuple' });
  const mark = async () => {
    for (const [side, cell] of [['Source', 3], ['Target', 2]]) await cellOf(side, cell).click();
    assert.ok(await add.isEnabled());
  };
  const places = () => Promise.all([cellOf('Source', 3), add].map(async (e) => Math.round((await e.boundingBox()).y)));
  await mark();
  await page.keyboard.press('Escape');
  assert.equal(await inspector.getByRole('checkbox', { checked: true }).count(), 0);
  assert.ok(await add.isDisabled());
  await mark();
  const worked = await places();
  await add.click();
  await inspector.getByText('more than once').waitFor();
  await until(page, 'the cells are at their place', (y) => Math.abs(document.querySelector('[data-grid="Source"] [data-cell="3,1"]').getBoundingClientRect().y - y) <= 1, worked[0]);
  for (const [i, y] of (await places()).entries()) assert.ok(Math.abs(y - worked[i]) <= 1, `${y} instead of ${worked[i]}`);
  await canvas.focus();
  for (let i = 0; i < 3; i++) await page.keyboard.press('Control+z');

  step('tuples come from a file');
  await find(page, 'CR to Threshold CR');
  await inspector.getByLabel('Cells', { exact: true }).selectOption('chosen cells');
  await inspector.getByText('From text or a file').click();
  writeFileSync(join(folder, 'tuples.txt'), '1,1|2,1:3,1\n4,1:5,1\n');
  await inspector.getByLabel('Import tuples from a file').setInputFiles(join(folder, 'tuples.txt'));
  await inspector.getByText('1,1 2,1 → 3,1').waitFor();
  await inspector.getByText('4,1 → 5,1').waitFor();
  await canvas.focus();
  await page.keyboard.press('Control+z');

  step('a port that is not set is named as its field, and a click leads there; Run says what it drives');
  await row('bug').click();
  await heading('Bug');
  const port = inspector.locator('[data-port="_motor"] select');
  const label = (await inspector.locator('[data-port="_motor"] label').innerText()).replace(/\s*\*\s*$/, '').trim();
  const left = () => page.evaluate(() => document.querySelector('button.run').getBoundingClientRect().left);
  const runAt = await left();
  await port.selectOption('');
  await page.getByRole('button', { name: 'earlier version runs' }).click();
  assert.equal(await left(), runAt, 'Run stays where it is');
  await find(page, 'Adaptive/UR');
  await page.getByRole('group', { name: 'Problems' }).getByRole('button', { name: `${label} of the module of Bug has no group` }).click();
  await until(page, 'the field of the port', () => document.activeElement?.closest('[data-port="_motor"]') != null);
  await page.keyboard.press('Escape');
  await canvas.focus();
  await page.keyboard.press('Control+z');
  await page.getByRole('button', { name: 'earlier version runs' }).waitFor({ state: 'detached' });

  step('a size that the module cannot use is named by the label of the port; a button sets the one that fits');
  await row('bug.light').click();
  await heading('Bug/Light');
  await inspector.getByLabel('Columns').fill('100');
  await inspector.getByLabel('Columns').press('Enter');
  await page.getByRole('group', { name: 'Problems' }).getByRole('button', { name: /^\w[\w ]* \('_\w+'\) needs 32 x 1 cells; 'Bug\/Light' is 100 x 1/ }).waitFor();
  await page.getByRole('group', { name: 'Problems' }).getByRole('button', { name: 'Make Light 32 × 1' }).click();
  await page.getByText('The system has no problems').waitFor();
  assert.equal(await inspector.getByLabel('Columns').inputValue(), '32');

  step('Ctrl+K has the actions of the menus; a backup is written beside the file');
  await find(page, 'Save a backup');
  await page.getByText(/^The backup is dac_foraging\.iqr,/).waitFor();
  if (!site) assert.equal(readdirSync(join(folder, 'systems')).filter((f) => f.startsWith('dac_foraging.iqr,')).length, 1);
  await page.keyboard.press('Control+k');
  for (const action of ['Save as', 'Import a process', 'Link a process', 'Undo', 'Diagram: two panes side by side', 'Arrange: lay out the page', 'Print the diagram']) {
    await page.getByRole('combobox', { name: 'Find' }).fill(action);
    await page.getByRole('option', { name: action }).first().waitFor();
  }
  await page.keyboard.press('Escape');

  if (!site) { // nothing else writes files that a browser keeps
    step('a linked process has a form that only reads');
    const process = join(folder, 'Part.iqrProcess');
    await diagram.getByRole('button', { name: 'Selection', exact: true }).click();
    await find(page, 'Export the process Selection');
    const dialog = page.getByRole('dialog', { name: 'Export the process' });
    await dialog.getByLabel('Name').fill(process);
    await dialog.getByRole('button', { name: 'Export' }).click();
    await dialog.waitFor({ state: 'detached' });
    writeFileSync(process, readFileSync(process, 'utf8').replaceAll('selection', 'part').replace('name="Selection"', 'name="Part"')); // ids of its own
    await find(page, 'Link a process');
    const link = page.getByRole('dialog', { name: 'Link a process' });
    await link.getByLabel('Name').fill(process);
    await link.getByRole('button', { name: 'Link', exact: true }).click();
    await link.waitFor({ state: 'detached' });
    await row('part').click();
    await heading('Part');
    const path = inspector.getByLabel('External path');
    assert.match(await path.inputValue(), /Part\.iqrProcess$/);
    assert.ok(await inspector.getByLabel('Name', { exact: true }).isDisabled());
    await inspector.getByText(/is changed there/).waitFor();
  }

  step('in a small window, the group that is selected already shows its form again');
  const small = await open(new URL(page.url()).origin, { width: 420, height: 800 });
  await small.locator('.dv-tab').first().waitFor();
  const drawer = small.getByRole('region', { name: 'Inspector' });
  for (let i = 0; i < 2; i++) {
    await find(small, 'Bug/Light');
    await drawer.waitFor();
    await small.keyboard.press('Escape');
    await drawer.waitFor({ state: 'detached' });
  }
  await small.close();

  if (!site) { // an address names one system, and sets nothing
    step('items of a second system show their parameters, which act on the run');
    const teams = await begin(['systems/team_a.iqr', 'systems/team_b.iqr', '--world', 'systems/worlds/team_arena.world']);
    await find(teams, 'B_1/Motor');
    const form = teams.getByRole('region', { name: 'Inspector' });
    await form.getByText(/only the first system can be edited/).waitFor();
    assert.ok(await form.getByLabel('Name', { exact: true }).isDisabled());
    const gain = teams.locator('[id="B_1/Motor.excGain"]');
    await gain.fill('2');
    await gain.press('Enter');
    await teams.getByTitle(/^Undo: B_1\/Motor.excGain = 2/).waitFor();
    await teams.close();

    step('a number of the run that is none stays in sight until Stop takes it out');
    const endless = await begin(['systems/reactive_foraging.iqr', '--world', 'systems/worlds/basic_arena.world', '--set', 'Selection/Explore.excGain=1e308', '--set', 'Selection/Const Speed.spkAmpl=1e308']);
    const shown = endless.getByRole('alert').filter({ hasText: "In cycle 1 'vm' of 'Selection/Explore' becomes inf in cell (5, 1)" });
    for (let n = 0; n < 2; n++) {
      await endless.getByRole('button', { name: /^Step/ }).first().click();
      await endless.getByRole('button', { name: /^Step/ }).first().click();
      await shown.waitFor();
      await shown.getByRole('button', { name: 'Stop' }).click();
      await shown.waitFor({ state: 'detached' });
    }
    await endless.close();
  }

  assert.deepEqual(faults, []);
}
