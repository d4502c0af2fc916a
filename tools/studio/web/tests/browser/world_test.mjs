// The world's file is edited on a map, in Chromium against the real program.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { accessible, find, picture, sessionIsKept, until } from './support.mjs';

export default async function({ forage, site, folder, start, open, onDisk, faults, step }) {
  const file = 'systems/worlds/basic_arena.world';
  const original = readFileSync(join(folder, file), 'utf8');
  const page = await open(await start(['systems/reactive_foraging.iqr', '--world', file]).address);
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

  step('what the map says about itself does not cover it');
  assert.ok((await map.boundingBox()).y + (await map.boundingBox()).height <= (await world.getByText('Drag or use the arrows').boundingBox()).y);

  step('a click beside all things chooses the floor, and says that its picture does not move');
  await page.mouse.click(...(await at(0.4, 0.42)));
  await world.getByText('What is painted on GroundPlane is part of its picture').waitFor();
  assert.equal(await field('Name').inputValue(), 'GroundPlane');

  step('a wall is added by a click, dragged, and given numbers; Escape puts away what is to be placed');
  const pillar = world.getByRole('button', { name: 'pillar', exact: true });
  await pillar.click();
  await pillar.and(page.locator('[aria-pressed=true]')).waitFor();
  await page.keyboard.press('Escape');
  await pillar.and(page.locator('[aria-pressed=false]')).waitFor();
  const items = await map.getByRole('button').count();
  await world.getByRole('button', { name: 'wall', exact: true }).click();
  await page.mouse.click(...(await at(0.4, 0.42)));
  const wall = map.locator('.chosen');
  await map.getByRole('button').nth(items).waitFor();
  await until(page, 'the form of the wall', () => ![...document.querySelectorAll('[aria-label^="Properties of"] input')].some((i) => i.value === 'GroundPlane'));
  await wall.waitFor();
  await until(page, 'the focus on the wall', () => document.activeElement.matches('.item.chosen')); // keys are for it
  const name = await field('Name').inputValue();
  assert.equal(await map.getByRole('button').count(), items + 1);
  const before = Number(await field('x, m').inputValue());
  await page.mouse.move(...(await at(0.4, 0.42)));
  await page.mouse.down();
  await page.mouse.move(...(await at(0.45, 0.42)), { steps: 3 });
  await page.mouse.up();
  await until(page, 'the wall moves', (x) => Number(document.querySelector('[aria-label^="Properties of"] input.number')?.value) > x, before + 0.05);
  await field('Width, m').fill('1.5');
  await field('Width, m').press('Enter');

  step('the map has lines with a scale, and is zoomed by buttons');
  const scale = () => map.evaluate((e) => [e.viewBox.baseVal.width, e.parentElement.querySelector('.scale').textContent]);
  const [wideView, lines] = await scale();
  await world.getByRole('button', { name: 'Zoom in' }).click();
  await world.getByRole('button', { name: 'Zoom in' }).click();
  const [nearer, finer] = await scale();
  assert.ok(nearer < 0.6 * wideView && parseFloat(finer) < parseFloat(lines), `${wideView} ${lines} ${nearer} ${finer}`);
  await world.getByRole('button', { name: 'Show all' }).click();
  assert.equal((await scale())[0], wideView);
  await wall.focus();

  step('handles turn and resize it, each drag as one step of the history; a key switches snapping off');
  const number = async (label) => Number(await field(label).inputValue());
  const middle = async (locator) => {
    const box = await locator.boundingBox();
    return [box.x + box.width / 2, box.y + box.height / 2];
  };
  const dragTo = async (handle, x, y, key) => {
    await page.mouse.move(...(await middle(map.locator(handle).first())));
    if (key) await page.keyboard.down(key);
    await page.mouse.down();
    await page.mouse.move(x - 9, y, { steps: 3 });
    await page.mouse.move(x, y);
    await page.mouse.up();
    if (key) await page.keyboard.up(key);
  };
  const becomes = (label, wanted) =>
    until(page, `${label} is ${wanted}`, ([l, w]) => [...document.querySelectorAll('[aria-label^="Properties of"] .field')].some((f) => f.querySelector('label').textContent === l && f.querySelector('input').value === w), [label, wanted]);
  await becomes('Width, m', '1.5');
  const [cx, cy] = await middle(map.locator('.chosen polygon'));
  await dragTo('.turn', cx + 3, cy - 120);
  await becomes('Heading, °', '90');
  const upwards = await middle(map.locator('.chosen polygon'));
  await dragTo('.size', upwards[0], upwards[1] - 77);
  await until(page, 'a wider wall', () => [...document.querySelectorAll('[aria-label^="Properties of"] .field')].some((f) => f.querySelector('label').textContent === 'Width, m' && f.querySelector('input').value !== '1.5'));
  const wide = await number('Width, m');
  assert.ok(Math.abs(wide * 10 - Math.round(wide * 10)) < 1e-9, `${wide} is on the grid`);
  await page.keyboard.press('Control+z');
  await becomes('Width, m', '1.5');
  await page.keyboard.press('Control+z');
  await becomes('Heading, °', '0');
  const exact = await number('x, m');
  const perMetre = await map.evaluate((e) => e.getScreenCTM().a);
  await dragTo('.chosen', cx + 0.14 * perMetre, cy, 'Control');
  await until(page, 'it has moved', (x) => Number(document.querySelector('[aria-label^="Properties of"] input.number')?.value) !== x, exact);
  const free = await number('x, m');
  assert.ok(Math.abs(free * 10 - Math.round(free * 10)) > 1e-6, `${free} is off the grid`);
  await page.keyboard.press('Control+z');
  await becomes('x, m', String(exact));

  step('a wall is drawn from one end to the other');
  await world.getByRole('button', { name: 'wall', exact: true }).click();
  await page.mouse.move(...(await at(0.3, 0.7)));
  await page.mouse.down();
  await page.mouse.move(...(await at(0.35, 0.8)), { steps: 3 });
  await page.mouse.move(...(await at(0.3, 0.9)), { steps: 3 });
  await page.mouse.up();
  await map.getByRole('button').nth(items + 1).waitFor();
  await becomes('Heading, °', '-90');
  assert.equal(await page.evaluate(() => getSelection().toString()), '');
  await page.keyboard.press('Control+z');
  await until(page, 'it is gone', (n) => document.querySelectorAll('[aria-label="Map of the world"] [role=button]').length === n, items + 1);
  await map.locator(`[data-id="${name}"]`).focus();

  step('a patch is drawn from one corner to the other, as a floor is');
  await world.getByRole('button', { name: 'patch', exact: true }).click();
  await page.mouse.move(...(await at(0.3, 0.7)));
  await page.mouse.down();
  await page.mouse.move(...(await at(0.35, 0.9)), { steps: 3 });
  await page.mouse.up();
  await map.getByRole('button').nth(items + 1).waitFor();
  await until(page, 'the size of the drag', () => {
    const size = (label) => Number([...document.querySelectorAll('[aria-label^="Properties of"] .field')].find((f) => f.querySelector('label').textContent === label)?.querySelector('input').value);
    return size('Depth, m') > size('Width, m') && size('Width, m') < 1;
  });
  await page.keyboard.press('Control+z');
  await until(page, 'it is gone', (n) => document.querySelectorAll('[aria-label="Map of the world"] [role=button]').length === n, items + 1);
  await map.locator(`[data-id="${name}"]`).focus();

  step('keys resize it, too');
  await map.locator('.chosen').focus();
  await page.keyboard.press('Control+ArrowRight');
  await becomes('Width, m', '1.6');
  await page.keyboard.press('Control+z');
  await becomes('Width, m', '1.5');

  step('the kinds stand under their headings, each with a drawing and its name');
  const named = await world.getByRole('toolbar').getByRole('button').evaluateAll((all) => all.filter((b) => [...b.childNodes].some((n) => n.nodeType === 3 && n.data.trim() && b.offsetWidth > 20)).length);
  assert.equal(named, await world.getByRole('toolbar').getByRole('button').count());
  assert.deepEqual(await world.getByRole('toolbar').getByRole('group').evaluateAll((all) => all.map((g) => g.ariaLabel)), ['Robots', 'Obstacles', 'Floor', 'Targets', 'Rules and light']);
  assert.equal(await world.getByRole('toolbar').locator('button svg').count(), await world.getByRole('toolbar').getByRole('button').count());

  step('the map is wide, and the form in sight, in a smaller window');
  for (const [width, height] of [[1400, 900], [1024, 700], [700, 600]]) {
    await page.setViewportSize({ width, height });
    for (const dark of [false, true]) {
      await page.emulateMedia({ colorScheme: dark ? 'dark' : 'light' });
      await picture(page, `world-${width}-${dark ? 'dark' : 'light'}`);
    }
    const form = await world.getByRole('group', { name: `Properties of ${name}`, exact: true }).boundingBox();
    assert.ok(form && form.y >= 0 && form.y + 60 <= height, `the form at ${width} x ${height}: ${JSON.stringify(form)}`);
    const { clientWidth, clientHeight } = await map.evaluate(({ clientWidth, clientHeight }) => ({ clientWidth, clientHeight }));
    assert.ok(clientWidth >= 420 && clientHeight >= 250, `the map at ${width} x ${height}: ${clientWidth} x ${clientHeight}`);
  }
  await accessible(page, 'dark');
  await page.emulateMedia({ colorScheme: 'light' });
  await page.setViewportSize({ width: 1400, height: 900 });

  step('a patch is added and taken away by keys; undo takes the last step back');
  await world.getByRole('button', { name: 'patch', exact: true }).focus();
  await page.keyboard.press('Enter');
  await until(page, 'another item', (n) => document.querySelectorAll('[aria-label="Map of the world"] .item').length === n, items + 2);
  await map.locator('.chosen').focus();
  await page.keyboard.press('Delete');
  await until(page, 'it is gone', (n) => document.querySelectorAll('[aria-label="Map of the world"] .item').length === n, items + 1);
  await page.keyboard.press('Control+z');
  await until(page, 'it is back', (n) => document.querySelectorAll('[aria-label="Map of the world"] .item').length === n, items + 2);

  step('the buttons and the map are one stop of the Tab key each; keys lead from button to button, and from item to item');
  await world.getByRole('button', { name: 'wall', exact: true }).focus();
  const active = () =>
    page.evaluate(
      () => [document.activeElement.closest('[role=toolbar]') ? 'button' : document.activeElement.closest('[aria-label="Map of the world"]') ? 'map' : 'other', document.activeElement.ariaLabel ?? document.activeElement.textContent],
    );
  await page.keyboard.press('End');
  const [, end] = await active();
  await page.keyboard.press('ArrowLeft');
  assert.ok((await active())[0] === 'button' && (await active())[1] !== end && (await active())[1] !== 'wall', await active());
  const stops = [];
  while (stops[stops.length - 1] !== 'map' && stops.length < 8) await page.keyboard.press('Tab'), stops.push((await active())[0]);
  assert.ok(stops[stops.length - 1] === 'map' && !stops.includes('button'), stops.join());
  const seen = new Set();
  await page.keyboard.press('Home');
  for (let i = 0; i < items + 2; i++) seen.add((await active())[1]), await page.keyboard.press('PageDown');
  assert.equal(seen.size, items + 2, [...seen].join());
  const last = (await active())[1];
  await page.keyboard.press('PageUp');
  assert.notEqual((await active())[1], last);
  await world.locator('.item[aria-pressed=true]').waitFor();
  assert.equal(await map.locator('.chosen').getAttribute('aria-label'), (await active())[1]);
  await page.keyboard.press('Tab');
  assert.equal((await active())[0], 'other');

  step('every kind is added, and every item of the world can be chosen, and has a form');
  const count = (n) => until(page, `${n} items`, (wanted) => document.querySelectorAll('[aria-label="Item"] option').length === wanted, n);
  const list = world.getByLabel('Item', { exact: true });
  let all = await list.locator('option').count();
  const kinds = await world.getByRole('toolbar').getByRole('button').allTextContents();
  for (const kind of ['wall', 'pillar', 'patch', 'disc', 'ball', 'crate', 'light', 'goal', 'resource', 'home', 'site', 'start', 'robot', 'floor', 'sun', 'trials', 'game', 'model']) assert.ok(kinds.includes(kind), `${kind} cannot be added`);
  for (const kind of kinds.filter((k) => !['floor', 'sun', 'game'].includes(k))) { // the world has a floor and a sun, and a site brings a game
    await world.getByRole('button', { name: kind, exact: true }).focus();
    await page.keyboard.press('Enter');
    all += kind === 'site' ? 2 : 1;
    await count(all);
  }
  for (const id of await list.locator('option').evaluateAll((options) => options.map((o) => o.value))) {
    await list.selectOption(id);
    await world.getByRole('group', { name: `Properties of ${id}`, exact: true }).locator('input, select').first().waitFor();
  }

  const undo = async (times = 1) => {
    await page.evaluate(() => document.activeElement?.blur());
    for (let i = 0; i < times; i++) await page.keyboard.press('Control+z');
  };
  await undo(kinds.length - 3);
  await count(all - (kinds.length - 3) - 1);

  step('colours, lengths and rules are edited in the form, and undone');
  const value = (label, wanted) =>
    until(page, `${label} is ${wanted}`, ([l, w]) => [...document.querySelectorAll('[aria-label^="Properties of"] .field')].some((f) => f.querySelector('label').textContent === l && f.querySelector('input').value === w), [label, wanted]);
  await list.selectOption('Bug');
  await field('Colour').fill('#00ff80');
  await value('Colour', '#00ff80');
  await until(page, 'the robot is painted', () => getComputedStyle(document.querySelector('.item.robot [style*="--paint"]')).getPropertyValue('--paint') === '#00ff80');
  await undo();
  await value('Colour', '#ff0000');
  await world.getByRole('button', { name: 'trials', exact: true }).click();
  await list.selectOption('Trials');
  await field('Reach, m').fill('0.8');
  await field('Reach, m').press('Enter');
  await value('Reach, m', '0.8');
  await list.selectOption('basic_arena');
  await field('Ambient light').fill('0.6');
  await field('Ambient light').press('Enter');
  await value('Ambient light', '0.6');
  await undo();
  await value('Ambient light', '0.4');

  step('an included model is unpacked, and takes another width');
  await list.selectOption('Wall');
  await world.getByRole('button', { name: 'Unpack' }).click();
  await until(page, 'it has no model any more', () => ![...document.querySelectorAll('[aria-label="Properties of Wall"] label')].some((l) => l.textContent === 'Model'));
  await field('Width, m').fill('7');
  await field('Width, m').press('Enter');
  await value('Width, m', '7');
  await undo(2);
  await world.getByLabel('Model', { exact: true }).waitFor();

  step('a world that cannot run is not saved');
  await list.selectOption('Bug');
  await world.getByRole('button', { name: 'Delete' }).click();
  await until(page, 'the robot is gone', () => ![...document.querySelectorAll('[aria-label="Item"] option')].some((o) => o.value === 'Bug'));
  await world.getByRole('button', { name: 'Save', exact: true }).click();
  await page.getByRole('alert').filter({ hasText: 'Bug' }).first().waitFor();
  assert.equal(readFileSync(await onDisk(page, file), 'utf8'), original);
  await undo();
  await until(page, 'the robot is back', () => [...document.querySelectorAll('[aria-label="Item"] option')].some((o) => o.value === 'Bug'));

  step('axe finds no fault of accessibility');
  await accessible(page);

  step('a world that is not saved is marked, also in a page that was reloaded, and is not left without a question');
  const marked = page.getByRole('img', { name: 'its world has changes that are not saved' });
  await marked.waitFor();
  assert.match(await page.title(), /^● /);
  const asked = [];
  page.on('dialog', (d) => (asked.push(d.type()), d.accept()));
  if (site) { // what the next page resumes is kept a moment after each change
    const since = Date.now();
    await page.locator('body').press('.');
    await sessionIsKept(page, since);
  }
  await page.reload();
  if (site) await page.getByRole('button', { name: 'Resume it' }).click(); // the session was in this page
  await marked.waitFor();
  await page.keyboard.press('Alt+n');
  const begin = page.getByRole('dialog', { name: 'New system' });
  await begin.getByLabel('Name').fill('Another');
  await begin.getByLabel('Name').press('Enter');
  const changes = page.getByRole('dialog', { name: 'Changes' });
  await changes.getByText('The world has changes that are not saved.').waitFor();
  await changes.getByRole('button', { name: 'Save', exact: true }).waitFor();
  await changes.getByRole('button', { name: 'Cancel' }).click();
  assert.deepEqual(asked, ['beforeunload']);
  await begin.getByRole('button', { name: 'Cancel' }).click();
  await map.waitFor();

  step('saved under another name, the rest of the file keeps its bytes; the command line checks it');
  await world.getByRole('button', { name: 'Save as…' }).click();
  const dialog = page.getByRole('dialog', { name: 'Save the world as' });
  const path = 'systems/worlds/mine.world', text = async () => readFileSync(await onDisk(page, path), 'utf8');
  await until(page, 'the folder of the world', () => document.querySelector('.folder')?.textContent.endsWith('systems/worlds'));
  const replace = dialog.getByRole('button', { name: 'Replace the file' });
  await dialog.getByLabel('Name').fill('open_arena.world');
  await dialog.getByLabel('Name').press('Enter');
  await replace.waitFor();
  await dialog.getByLabel('Name').fill('mine');
  assert.equal(await replace.count(), 0, 'another name is not the one that is there');
  await dialog.getByLabel('Name').press('Enter');
  await page.getByText('Saved as mine.world.').waitFor();
  await page.getByText('in mine').waitFor();
  assert.equal(await marked.count(), 0);
  const saved = (await text()).split('\n');
  assert.ok(saved.some((line) => line.includes('<world name="mine">')), 'it is called as its file');
  assert.deepEqual(original.split('\n').filter((line) => !line.includes('<world name="basic_arena">') && !saved.includes(line)), [], 'lines of the original are missing');
  assert.ok(saved.some((line) => line.includes(name)));
  execFileSync(forage, ['check', 'systems/reactive_foraging.iqr', '--world', path], { cwd: folder });

  step('Ctrl+S in the panel of the world saves the world');
  await list.selectOption('Wall');
  await field('x, m').fill('0.25');
  await field('x, m').press('Enter');
  await marked.waitFor();
  await page.keyboard.press('Control+s');
  await page.getByText('The world is saved').waitFor();
  await until(page, 'the mark is gone', () => !document.title.startsWith('●'));
  assert.notEqual(await text(), saved.join('\n'));

  step('Enter opens the file that was clicked, without a question when all is saved');
  await page.keyboard.press('Control+o');
  await page.getByRole('dialog', { name: 'Open a system' }).getByRole('button', { name: 'dac_foraging.iqr', exact: true }).first().click();
  await page.keyboard.press('Enter');
  await until(page, 'the other system', () => document.title.startsWith('DAC foraging'));
  assert.equal(await changes.count(), 0);

  step('a world that comes with Forage is edited, and saved in the folder of the user, where its models are found');
  await page.keyboard.press('Alt+n');
  await begin.getByLabel('Name').fill('Another');
  await begin.getByLabel('World').selectOption({ label: 'a file…' });
  await begin.getByRole('list', { name: 'Files' }).waitFor();
  await begin.getByLabel('World').selectOption({ label: 'open arena' });
  await begin.getByRole('list', { name: 'Files' }).waitFor({ state: 'detached' });
  await begin.getByLabel('Name').press('Enter');
  await until(page, 'the new system', () => document.title.includes('Another'));
  await begin.waitFor({ state: 'detached' });
  await find(page, 'edit the world');
  await list.selectOption('open_arena');
  await field('Ambient light').fill('0,7');
  await field('Ambient light').press('Enter');
  await value('Ambient light', '0.7');
  await world.getByRole('button', { name: 'Save', exact: true }).click();
  await until(page, 'the folder of the user', (name) => document.querySelector('.folder')?.textContent.endsWith(name), site ? 'web_user' : folder.split('/').pop());
  await dialog.getByLabel('Name').fill('own');
  await dialog.getByLabel('Name').press('Enter');
  await page.getByText('Saved as own.world.').waitFor();
  if (!site) execFileSync(forage, ['check', 'systems/reactive_foraging.iqr', '--world', 'own.world'], { cwd: folder }); // in Node it is not installed, and knows no models
  assert.deepEqual(faults, []);
}
