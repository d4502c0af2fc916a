// Editing a system in the diagram and the inspector, in Chromium against the real program.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { accessible, answeredTo, find, sent, until } from './support.mjs';

export default async function({ site, folder, context, start, open, onDisk, faults, step }) {
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  const file = join(folder, 'systems/reactive_foraging.iqr');
  const original = readFileSync(file, 'utf8');
  const page = await open(await start(['systems/reactive_foraging.iqr', '--world', 'systems/worlds/basic_arena.world']).address);
  const diagram = page.getByRole('group', { name: 'Diagram' });
  const canvas = diagram.getByRole('application', { name: 'Canvas' });
  const inspector = page.getByRole('region', { name: 'Inspector' });
  const node = (id) => diagram.locator(`.svelte-flow__node[data-id="${id}"]`);
  const heading = (name) => inspector.getByRole('heading', { name, exact: true }).waitFor();
  const place = async (id) => (await node(id).evaluate((e) => e.style.transform)).match(/-?[\d.]+/g).map(Number);
  const moved = (id, from) => until(page, `${id} moves`, ([i, was]) => document.querySelector(`.svelte-flow__node[data-id="${i}"]`)?.style.transform !== was, [id, `translate(${from[0]}px, ${from[1]}px)`]);
  const undone = (id, to) => until(page, `${id} is back`, ([i, was]) => document.querySelector(`.svelte-flow__node[data-id="${i}"]`)?.style.transform === was, [id, `translate(${to[0]}px, ${to[1]}px)`]);
  const dirty = (yes) => until(page, yes ? 'a change' : 'no change', (y) => document.title.startsWith('●') === y, yes);
  const count = (n) => until(page, `${n} boxes`, (k) => document.querySelectorAll('.svelte-flow__node:not(:has(.phantom))').length === k, n);
  /** A point of a line, as a part of its length. */
  const along = (connection, part) =>
    page.evaluate(([c, p]) => {
      const path = document.querySelector(`g[data-connection="${c}"] .wide`);
      const at = path.getPointAtLength(path.getTotalLength() * p).matrixTransform(path.getScreenCTM());
      return [at.x, at.y];
    }, [connection, part]);
  const drag = async (from, to) => {
    await page.mouse.move(...from);
    await page.mouse.down();
    await page.mouse.move((from[0] + to[0]) / 2, (from[1] + to[1]) / 2, { steps: 3 });
    await page.mouse.move(...to, { steps: 3 });
    await page.mouse.up();
  };

  step('a box is dragged, undone, redone, and moved by the arrows; only its place in the file changes');
  await page.getByRole('group', { name: 'Arena' }).waitFor();
  await find(page, 'layout: build');
  await diagram.getByRole('button', { name: 'Selection', exact: true }).click();
  await count(6);
  const ur = await place('selection.ur');
  const box = await node('selection.ur').boundingBox();
  await drag([box.x + 20, box.y + 15], [box.x + 60, box.y + 75]);
  await moved('selection.ur', ur);
  await dirty(true);
  await page.keyboard.press('Control+z');
  await undone('selection.ur', ur);
  await dirty(false);
  await page.keyboard.press('Control+Shift+z');
  await moved('selection.ur', ur);
  const there = await place('selection.ur');
  const edits = await sent(page, 'edit');
  await page.keyboard.press('Shift+ArrowDown');
  await until(page, 'the arrow', ([y]) => Number(document.querySelector('.svelte-flow__node[data-id="selection.ur"]').style.transform.match(/-?[\d.]+/g)[1]) > y, [there[1]]);
  await page.getByText('UR', { exact: true }).first().waitFor();
  await answeredTo(page, 'edit', edits); // the arrows are sent together, shortly after the last one
  await page.keyboard.press('Control+s');
  await dirty(false);
  const saved = readFileSync(await onDisk(page, 'systems/reactive_foraging.iqr'), 'utf8').split('\n');
  const differing = original.split('\n').flatMap((l, i) => (l === saved[i] ? [] : [i]));
  assert.equal(saved.length, original.split('\n').length);
  assert.equal(differing.length, 1);
  assert.match(saved[differing[0]], /<DiagramIcon x="\d+" y="\d+" width="\d+" height="50"\/>/);

  step('a double click on its name writes it, as the finder does');
  for (const begin of [() => node('selection.ur').locator('.name').dblclick(), () => find(page, 'rename ur')]) {
    await begin();
    await node('selection.ur').getByRole('textbox', { name: 'Name' }).waitFor();
    await page.keyboard.type('Reflex');
    await page.keyboard.press('Escape');
    await node('selection.ur').getByText('UR', { exact: true }).waitFor();
  }
  await dirty(false);

  step('a vertex is added by Ctrl and click, dragged, and deleted by a key');
  const c = 'c.approach-ur';
  await page.keyboard.down('Control');
  await page.mouse.click(...(await along(c, 0.5)));
  await page.keyboard.up('Control');
  const vertex = page.getByRole('button', { name: 'Vertex 1 of Approach to UR' });
  await vertex.waitFor();
  const v = await vertex.boundingBox();
  await drag([v.x + 4, v.y + 4], [v.x + 4, v.y + 64]);
  await until(page, 'the vertex', (y) => document.querySelector('.vertex')?.getBoundingClientRect().y > y, v.y + 30);
  await vertex.focus();
  await page.keyboard.press('Delete');
  await vertex.waitFor({ state: 'detached' });

  step('an end is drawn to another box: the connection leads elsewhere; undo takes it back');
  const end = await page.locator('circle[data-end="target"]').boundingBox();
  const motor = await node('selection.motor_in').boundingBox();
  await drag([end.x + 5, end.y + 5], [motor.x + motor.width / 2, motor.y + motor.height - 4]);
  await inspector.getByText('Selection/Approach → Selection/Motor In', { exact: true }).waitFor();
  await canvas.focus();
  await page.keyboard.press('Control+z');
  await inspector.getByText('Selection/Approach → Selection/UR', { exact: true }).waitFor();

  step('a tool connects once and is put away; with Shift or a double click it stays, until Escape');
  const tool = (name) => diagram.getByRole('button', { name, exact: true });
  const inHand = (name) => until(page, `the tool ${name}`, (n) => [...document.querySelectorAll('[aria-label="Editing"] [aria-pressed="true"]')].map((b) => b.ariaLabel).join() === n, name);
  const lines = () => page.locator('g[data-connection]').count();
  const connections = await lines();
  await inHand('Select');
  await tool('Connect inhibitory').click();
  await inHand('Connect inhibitory');
  await node('selection.explore').click();
  await node('selection.ur').click();
  await inspector.getByText('Selection/Explore → Selection/UR', { exact: true }).waitFor();
  await inHand('Select');
  for (const keep of [() => tool('Connect inhibitory').click({ modifiers: ['Shift'] }), () => tool('Connect inhibitory').dblclick()]) {
    await keep();
    await node('selection.explore').click();
    await node('selection.ur').click();
    await until(page, 'another line', (n) => document.querySelectorAll('g[data-connection]').length >= n, connections + 1);
    await inHand('Connect inhibitory');
    await node('selection.explore').click();
    await tool('Connect inhibitory').focus(); // Escape is heard outside of the canvas, too
    await page.keyboard.press('Escape');
    await inHand('Select');
  }
  await canvas.focus();
  for (let i = 0; i < 3; i++) await page.keyboard.press('Control+z');
  await until(page, 'the lines as before', (n) => document.querySelectorAll('g[data-connection]').length === n, connections);

  step('keys act on the box that has the focus, whatever is selected');
  await node('selection.explore').click();
  await node('selection.ur').focus();
  const looks = (id) => node(id).evaluate((e) => [getComputedStyle(e).outlineStyle, getComputedStyle(e.querySelector('.item')).outlineStyle]);
  await page.keyboard.press('Shift+Tab');
  await page.keyboard.press('Tab');
  assert.deepEqual([await looks('selection.ur'), await looks('selection.explore')], [['dashed', 'none'], ['none', 'solid']]);
  const rests = await place('selection.explore'), goes = await place('selection.ur');
  const earlier = await sent(page, 'edit');
  await page.keyboard.press('ArrowLeft');
  await moved('selection.ur', goes);
  assert.deepEqual(await place('selection.explore'), rests);
  await answeredTo(page, 'edit', earlier);
  await page.keyboard.press('Control+z');
  await undone('selection.ur', goes);
  await page.keyboard.press('e');
  const ends = page.getByRole('dialog', { name: /Connect/ });
  assert.equal(await ends.getByLabel('From', { exact: true }).inputValue(), 'selection.ur');
  await page.keyboard.press('Escape');
  await ends.waitFor({ state: 'detached' });
  await node('selection.ur').focus();
  await page.keyboard.press('Delete');
  await node('selection.ur').waitFor({ state: 'detached' });
  await node('selection.explore').waitFor();
  await canvas.focus();
  await page.keyboard.press('Control+z');
  await node('selection.ur').waitFor();

  step('the bar of the diagram is not cut');
  const bar = diagram.getByRole('toolbar', { name: 'Editing' });
  const room = await bar.evaluate((e) => [e.scrollWidth, e.clientWidth]);
  assert.ok(room[0] <= room[1], room.join());

  step('groups are selected by a rubber band, copied with their connection, pasted and deleted');
  const first = await node('selection.approach_inhibition').boundingBox(), second = await node('selection.explore').boundingBox();
  await page.keyboard.press('Escape');
  await drag([first.x - 12, first.y - 12], [second.x + second.width + 12, second.y + second.height + 12]);
  await until(page, 'two selected boxes', () => document.querySelectorAll('.svelte-flow__node.selected').length === 2);
  await page.keyboard.press('Control+c');
  await page.getByText('Copied 2 items.').waitFor();
  await page.keyboard.press('Control+v');
  await count(8);
  await until(page, 'the copies are selected', () => document.querySelectorAll('.svelte-flow__node.selected:not([data-id="selection.explore"], [data-id="selection.approach_inhibition"])').length === 2);
  await page.getByRole('navigation').getByText('11', { exact: true }).waitFor(); // connections
  await page.keyboard.press('Delete');
  await count(6);

  step('a message says how many connections go with a group, and brings them back');
  await node('selection.explore').press('Delete');
  const removed = page.locator('.notice').filter({ hasText: /^Selection\/Explore and 3 connections are deleted/ });
  await removed.getByRole('button', { name: 'Undo' }).click();
  await removed.waitFor({ state: 'detached' });
  await node('selection.explore').waitFor();

  step('two groups of a type are changed together');
  await node('selection.approach').click();
  await node('selection.explore').click({ modifiers: ['Control'] });
  await inspector.getByText(/act on the 2 selected groups/).waitFor();
  const gain = page.locator('[id="Selection/Explore.inhGain"]');
  await gain.fill('1.25');
  await gain.press('Enter');
  await node('selection.approach').click();
  await until(page, 'the other group', () => document.getElementById('Selection/Approach.inhGain')?.value === '1.25');

  step('what is wrong is listed, and a click goes there');
  await inspector.getByLabel('Neuron', { exact: true }).waitFor();
  await inspector.getByText('XML', { exact: true }).click();
  const xml = inspector.getByLabel('XML of the item');
  await xml.waitFor();
  const written = (await xml.locator('.cm-line').allInnerTexts()).join('\n');
  await xml.fill('<Group id="selection.approach" name="Approach">');
  await xml.press('Control+Enter');
  await inspector.getByRole('alert').waitFor();
  await inspector.getByRole('button', { name: 'Discard' }).click();
  await xml.fill(written.replace('neuronLinearThreshold', 'neuronLinearTreshold'));
  await xml.press('Control+Enter');
  await page.getByRole('button', { name: /problem/ }).click();
  const problems = page.getByRole('group', { name: 'Problems' });
  await find(page, 'US to Approach');
  await heading('US to Approach');
  await problems.getByRole('button', { name: /neuronLinearTreshold/ }).first().click();
  await heading('Selection/Approach');
  await canvas.focus();
  await page.keyboard.press('Control+z');
  await page.getByRole('button', { name: /problem/ }).waitFor({ state: 'detached' });

  step('the changes since the last save; another program writes the file');
  await find(page, 'changes since');
  await page.getByRole('group', { name: 'Changes since the last save' }).getByText(/1\.25/).first().waitFor();
  if (!site) { // nothing else writes files that a browser keeps
    writeFileSync(file, readFileSync(file, 'utf8').replace('name="Const Speed"', 'name="Drive"'));
    await page.getByText('reactive_foraging.iqr was changed by another program.').waitFor();
    await page.getByRole('button', { name: 'Merge both' }).click();
    await page.getByRole('navigation').getByText('Drive', { exact: true }).waitFor();
    await page.getByRole('group', { name: 'Changes since the last save' }).getByText(/1\.25/).first().waitFor();
  }

  step('axe finds no fault of accessibility');
  await find(page, 'US to Approach');
  await inspector.getByLabel('Cells', { exact: true }).waitFor();
  await accessible(page);
  await page.getByRole('button', { name: /Reactive foraging/ }).first().click();
  await page.getByRole('menuitem', { name: 'Save as' }).waitFor();
  await accessible(page);
  await page.getByRole('menuitem', { name: 'Save as' }).click();
  await page.getByRole('dialog', { name: 'Save as' }).waitFor();
  await accessible(page);

  step('in a small window, Enter leads into the form of a box, and Escape back to it');
  const small = await open(new URL(page.url()).origin, { width: 420, height: 800 });
  await small.locator('.dv-tab').first().waitFor();
  await find(small, 'diagram');
  await small.getByRole('group', { name: 'Processes' }).getByRole('button', { name: 'System', exact: true }).click();
  await small.locator('.svelte-flow__node .process').first().waitFor();
  await small.locator('.svelte-flow__node').first().focus();
  await small.keyboard.press('Enter');
  const drawer = small.getByRole('region', { name: 'Inspector' });
  const focusIn = (selector) => until(small, `the focus in ${selector}`, (s) => document.activeElement?.closest(s) != null, selector);
  await focusIn('aside .form');
  await small.keyboard.press('Escape');
  await drawer.waitFor({ state: 'detached' });
  await focusIn('.svelte-flow__node');
  await small.keyboard.press('Enter'); // the process is selected: its page opens, and nothing lies over it
  await small.locator('.svelte-flow__node canvas').first().waitFor();
  await focusIn('.flow');
  assert.equal(await drawer.count(), 0);
  await small.locator('.svelte-flow__node:not(:has(.phantom))').first().click();
  await drawer.waitFor();
  await small.locator('.svelte-flow__node:not(:has(.phantom))').first().focus();
  await small.keyboard.press('Escape');
  await drawer.waitFor({ state: 'detached' });
  await small.close();

  assert.deepEqual(faults, []);
}
