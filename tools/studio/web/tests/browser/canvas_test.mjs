// Comments, phantoms and lines between processes on the canvas, in Chromium against the real program.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { accessible, find, picture, until } from './support.mjs';

export default async function({ site, folder, context, start, open, onDisk, faults, step }) {
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  const file = join(folder, 'systems/reactive_foraging.iqr');
  const original = readFileSync(file, 'utf8');
  const page = await open(await start(['systems/reactive_foraging.iqr', '--world', 'systems/worlds/basic_arena.world']).address);
  const diagram = page.getByRole('group', { name: 'Diagram' });
  const canvas = diagram.getByRole('application', { name: 'Canvas' });
  const inspector = page.getByRole('region', { name: 'Inspector' });
  const comments = diagram.locator('.svelte-flow__node-comment');
  const writing = page.getByLabel('Text of the comment');
  const firstOf = { System: 'bug', 'Reactive Layer': 'reactive.us', Selection: 'selection.ur' };
  /** Shows a page, and waits until its boxes are there and rest. */
  const tab = async (name) => {
    await diagram.getByRole('group', { name: 'Processes' }).getByRole('button', { name, exact: true }).click();
    await diagram.locator(`.svelte-flow__node[data-id="${firstOf[name]}"]`).waitFor();
    await resting();
  };
  /** Waits for the field of a comment, which takes what is typed. */
  const begun = () => until(page, 'the text can be written', () => document.activeElement?.matches('textarea[aria-label="Text of the comment"]'));
  const many = (n) => until(page, `${n} comments`, (k) => document.querySelectorAll('.svelte-flow__node-comment').length === k, n);
  /** Saves, and looks for a pattern in the file. */
  const inFile = async (what, pattern) => {
    await dirty();
    await canvas.focus();
    await page.keyboard.press('Control+s');
    await clean();
    assert.match(readFileSync(await onDisk(page, 'systems/reactive_foraging.iqr'), 'utf8'), pattern, what);
  };
  const dirty = () => until(page, 'a change', () => document.title.startsWith('●'));
  const clean = () => until(page, 'no change that is not saved', () => !document.title.startsWith('●'));
  /** The saved text without the comments that hold parts of the diagram. */
  const others = () => readFileSync(file, 'utf8').replace(/\n *<!-- forage:[^]*?-->/g, '');
  /** An empty place of the canvas, below everything. */
  const empty = async () => {
    const all = await canvas.boundingBox();
    return [all.x + all.width * 0.25, all.y + all.height - 90];
  };
  const along = (connection, part) =>
    page.evaluate(([c, p]) => {
      const path = document.querySelector(`g[data-connection="${c}"] .wide`);
      const at = path.getPointAtLength(path.getTotalLength() * p).matrixTransform(path.getScreenCTM());
      return [at.x, at.y];
    }, [connection, part]);
  const bend = async (connection, part = 0.5) => {
    await page.keyboard.down('Control');
    await page.mouse.click(...(await along(connection, part)));
    await page.keyboard.up('Control');
  };
  const drag = async (from, to) => {
    await page.mouse.move(...from);
    await page.mouse.down();
    await page.mouse.move((from[0] + to[0]) / 2, (from[1] + to[1]) / 2, { steps: 3 });
    await page.mouse.move(...to, { steps: 3 });
    await page.mouse.up();
  };
  /** The place and the size of the page in its pane, when they are the same in two pictures in a row. */
  const resting = () =>
    page.evaluate(async () => {
      const transform = () => document.querySelector('.svelte-flow__viewport').style.transform;
      for (let was = ''; was !== transform();) {
        was = transform();
        for (let i = 0; i < 6; i++) await new Promise(requestAnimationFrame);
      }
      return Number(/scale\(([\d.]+)\)/.exec(transform())[1]);
    });
  const smaller = async (zoom) => {
    for (let was = await resting(); was > zoom; was = await resting()) {
      await diagram.getByRole('button', { name: 'Zoom Out' }).click();
      await until(page, 'a smaller page', (z) => Number(/scale\(([\d.]+)\)/.exec(document.querySelector('.svelte-flow__viewport').style.transform)[1]) < z, was);
    }
  };
  const place = (locator) => locator.evaluate((e) => e.style.transform);
  const leaves = (selector, from) => until(page, `${selector} moves`, ([s, was]) => document.querySelector(s)?.style.transform !== was, [selector, from]);
  const returns = (selector, to) => until(page, `${selector} is back`, ([s, was]) => document.querySelector(s)?.style.transform === was, [selector, to]);

  await page.getByRole('group', { name: 'Arena' }).waitFor();
  await find(page, 'layout: build');
  await tab('Selection');

  step('a comment is placed by a click and written; it is one step, and nothing else in the file changes');
  await diagram.getByRole('button', { name: 'Comment', exact: true }).click();
  await page.mouse.click(...(await empty()));
  await begun();
  await page.keyboard.type('Approach wins -- so "Explore" rests');
  await page.keyboard.press('Enter');
  await page.keyboard.type('until it is over');
  await page.keyboard.press('Control+Enter');
  await writing.waitFor({ state: 'detached' });
  await comments.getByText('until it is over').waitFor();
  await inFile('the comment', /<!-- forage:comment id="comment" x="-?\d+" y="-?\d+" width="90" height="\d+" text="Approach wins -&#45; so &quot;Explore&quot; rests\nuntil it is over" -->\n {2}<\/Process>/);
  assert.equal(others(), original);
  await page.keyboard.press('Control+z');
  await many(0);
  await page.keyboard.press('Control+Shift+z');
  await many(1);

  step('it is dragged, moved and resized by keys and by its corner, coloured, and all of it undone');
  const it = '.svelte-flow__node-comment';
  await comments.first().click();
  let was = await place(comments.first());
  const box = await comments.first().boundingBox();
  await drag([box.x + 20, box.y + 10], [box.x + 80, box.y + 20]);
  await leaves(it, was);
  await page.keyboard.press('Control+z');
  await returns(it, was);
  await clean();
  await canvas.focus();
  await page.keyboard.press('Shift+ArrowRight');
  await leaves(it, was);
  await dirty(); // the arrows are sent together, shortly after the last one
  await page.keyboard.press('Control+Shift+ArrowRight');
  await inspector.getByLabel('Width').waitFor();
  await until(page, 'it is wider', () => document.querySelector('[aria-label="Inspector"] input.number')?.value === '100' && document.querySelector('.svelte-flow__node-comment').offsetWidth === 200);
  const corner = await page.locator('.svelte-flow__resize-control.handle.bottom.right').boundingBox();
  await drag([corner.x + 3, corner.y + 3], [corner.x + 63, corner.y + 43]);
  await until(page, 'it is wider still', () => Number(document.querySelector('[aria-label="Inspector"] input.number')?.value) > 100);
  await until(page, 'its colour as it is seen', () => document.querySelector('[aria-label="Inspector"] input[type=color]')?.value === '#fdf3c7');
  await inspector.getByLabel('Colour').fill('#204060');
  await until(page, 'its colour', () => getComputedStyle(document.querySelector('.svelte-flow__node-comment .comment')).color === 'rgb(255, 255, 255)');
  await inFile('the colour', /forage:comment [^>]*color="#204060"/);
  await canvas.focus();
  for (let i = 0; i < 4; i++) await page.keyboard.press('Control+z');
  await returns(it, was);

  step('it is rewritten by keys, given up by Escape, copied, pasted, and deleted');
  await comments.first().click();
  await canvas.focus();
  await page.keyboard.press('Enter');
  await begun();
  await page.keyboard.type('nonsense');
  await page.keyboard.press('Escape');
  await writing.waitFor({ state: 'detached' });
  await comments.getByText('until it is over').waitFor();
  await page.keyboard.press('F2');
  await begun();
  await page.keyboard.type('Shorter');
  await page.keyboard.press('Control+Enter');
  await comments.getByText('Shorter', { exact: true }).waitFor();
  await page.keyboard.press('Control+c');
  await page.getByText('Copied.').first().waitFor();
  await tab('System');
  await many(0);
  await canvas.focus();
  await page.keyboard.press('Control+v');
  await page.locator(`${it}.selected`).waitFor();
  await many(1);
  await inFile('a comment of the system', /<!-- forage:comment [^>]*text="Shorter" -->\n<\/System>/);
  await page.keyboard.press('Delete');
  await many(0);

  step('the keyboard alone: C, a text, Escape for none; a double click does the same');
  await page.keyboard.press('Control+z');
  await many(1);
  await page.keyboard.press('c');
  await begun();
  await page.keyboard.press('Escape');
  await many(1);
  await page.keyboard.press('Control+Shift+z'); // what is given up leaves undo and redo as they were
  await many(0);
  await page.keyboard.press('c');
  await begun();
  await page.keyboard.type('By keys');
  await page.keyboard.press('Control+Enter');
  await comments.getByText('By keys', { exact: true }).waitFor();
  await page.mouse.dblclick(...(await empty()));
  await begun();
  await page.keyboard.type('By a double click');
  await diagram.getByRole('button', { name: 'View', exact: true }).focus(); // what is left is kept
  await comments.getByText('By a double click', { exact: true }).waitFor();
  await many(2);

  step('a phantom is dragged; its place is in the file, and undone');
  await tab('Selection');
  await until(page, 'two phantoms', () => document.querySelectorAll('.svelte-flow__node:has(.phantom)').length === 2);
  const ids = await page.evaluate(() => [...document.querySelectorAll('.svelte-flow__node:has(.phantom)')].map((n) => n.dataset.id));
  const far = `.svelte-flow__node[data-id="${ids[0]}"]`;
  was = await place(page.locator(far));
  const dashed = await page.locator(far).boundingBox();
  await drag([dashed.x + 10, dashed.y + 8], [dashed.x - 50, dashed.y + 60]);
  await leaves(far, was);
  await dirty();
  await inFile('the place of the phantom', new RegExp(`<!-- forage:phantom group="${ids[0]}" x="-?\\d+" y="-?\\d+" -->`));
  const moved = await place(page.locator(far));
  await tab('System');
  await tab('Selection');
  assert.equal(await place(page.locator(far)), moved);
  await canvas.focus();
  await page.keyboard.press('Control+z');
  await returns(far, was);
  await page.locator(far).click();
  await page.locator(`${far}.selected`).waitFor();
  await canvas.focus();
  await page.keyboard.press('Delete');
  await page.getByText('A phantom stands for a group of another process').first().waitFor();
  assert.equal(await page.locator(far).count(), 1);

  step('a line between processes is bent on the page of its target, and on that of the system; by keys, too');
  const across = 'c.reactive_approach-approach';
  await bend(across);
  const vertex = page.getByRole('button', { name: 'Vertex 1 of Reactive Approach to Approach' });
  await vertex.waitFor();
  const v = await vertex.boundingBox();
  await drag([v.x + 4, v.y + 4], [v.x + 54, v.y + 4]);
  await until(page, 'the vertex', (x) => document.querySelector('.vertex')?.getBoundingClientRect().x > x, v.x + 30);
  await inFile('the vertex of the page', /<!-- forage:vertices page="target" points="-?\d+,-?\d+" -->/);
  await vertex.focus();
  await page.keyboard.press('Delete');
  await vertex.waitFor({ state: 'detached' });
  await page.locator(`g[data-connection="${across}"]`).focus();
  await page.keyboard.press('v');
  await vertex.waitFor();
  await until(page, 'the vertex has the focus', () => document.activeElement?.classList.contains('vertex'));
  await tab('System');
  await bend(across);
  await vertex.waitFor();
  await inFile('the vertex of the page of the system', /<DiagramLine [^>]*>\s*<Point x="-?\d+" y="-?\d+"\/>\s*<!-- forage:vertices page="target"/);
  await tab('Reactive Layer');
  await vertex.waitFor({ state: 'detached' });

  step('a page that is opened, and one that is opened again, zoom from what is seen');
  const zoom = () => page.evaluate(() => Number(/scale\(([\d.]+)\)/.exec(document.querySelector('.svelte-flow__viewport').style.transform)[1]));
  const zooms = async (button, factor) => {
    const was = await resting();
    await diagram.getByRole('button', { name: button }).click();
    await resting();
    assert.ok(Math.abs((await zoom()) / was - factor) < 0.01, `${button}: ${was} becomes ${await zoom()}`);
  };
  await page.reload();
  await tab('Reactive Layer');
  await zooms('Zoom Out', 1 / 1.2);
  const kept = await resting();
  await tab('Selection');
  await zooms('Zoom In', 1.2);
  await tab('Reactive Layer');
  assert.ok(Math.abs((await resting()) - kept) < 0.001, 'the page is as it was left');
  await zooms('Zoom Out', 1 / 1.2);
  await page.setViewportSize({ width: 1300, height: 850 });
  await zooms('Zoom In', 1.2);
  assert.ok(Math.abs((await zoom()) - kept) < 0.001, 'another size of the window leaves what was zoomed');
  await page.setViewportSize({ width: 1400, height: 900 });

  step('a double click beside a thin line means the line, on a small page, too');
  await tab('Selection');
  const before = await comments.count();
  await smaller(0.4);
  const beside = await page.evaluate(() => {
    // A place 4 pixels beside a line at which only the line is near.
    for (const path of document.querySelectorAll('g[data-connection] .wide'))
      for (let part = 0.1; part < 0.9; part += 0.02) {
        const point = (p) => path.getPointAtLength(path.getTotalLength() * p).matrixTransform(path.getScreenCTM());
        const [a, b] = [point(part), point(part + 0.01)];
        const length = Math.hypot(b.x - a.x, b.y - a.y);
        const at = [a.x - (4 * (b.y - a.y)) / length, a.y + (4 * (b.x - a.x)) / length];
        if (!document.elementsFromPoint(...at).some((e) => e.closest('.svelte-flow__node, .svelte-flow__panel'))) return at;
      }
    return null;
  });
  await page.mouse.dblclick(...beside);
  await inspector.getByLabel('From', { exact: true }).waitFor();
  assert.equal(await writing.count(), 0);
  assert.equal(await comments.count(), before);
  await canvas.focus();
  await page.keyboard.press('f');
  await resting();
  await tab('Reactive Layer');

  step('connections between the same points lie side by side, and each is clicked where it is seen; those of a kind are a bundle, which opens');
  const drawnHere = () => page.evaluate(() => [...document.querySelectorAll('g[data-connection]')].map((g) => g.dataset.connection));
  const known = await drawnHere();
  const connect = async (from, to, kind) => {
    await diagram.locator(`.svelte-flow__node[data-id="reactive.${from}"]`).focus();
    await until(page, 'the box has the focus', (id) => document.activeElement?.dataset.id === id, `reactive.${from}`);
    await page.keyboard.press(kind);
    const dialog = page.getByRole('dialog', { name: 'Connect' });
    await dialog.getByLabel('To', { exact: true }).selectOption({ label: `Reactive Layer/${to}` });
    await dialog.getByRole('button', { name: 'Connect' }).click();
    await dialog.waitFor({ state: 'hidden' });
  };
  const bundle = page.locator('g[data-connection]', { hasText: '2' });
  const escape = async () => {
    await canvas.focus();
    await page.keyboard.press('Escape');
  };
  await connect('us', 'Approach', 'e');
  await until(page, 'the new one, beside the other', (n) => document.querySelectorAll('g[data-connection]').length === n + 1, known.length);
  await escape();
  await bundle.waitFor();
  assert.deepEqual(await drawnHere(), known);
  const first = await bundle.getAttribute('data-connection');
  await page.mouse.click(...(await along(first, 0.5)));
  await until(page, 'its two lines', () => document.querySelectorAll('g[data-connection].chosen').length === 2);
  await page.mouse.click(...(await along(first, 0.5)));
  await until(page, 'one of them', (id) => [...document.querySelectorAll('g[data-connection].chosen')].map((g) => g.dataset.connection).join() === id, first);
  await escape();
  await bundle.waitFor();
  for (const [from, to, kind] of [['us', 'Approach', 'i'], ['approach', 'US', 'm'], ['us', 'US', 'e'], ['us', 'US', 'i']]) {
    const drawn = (await drawnHere()).length;
    await connect(from, to, kind);
    await until(page, 'another line', (n) => document.querySelectorAll('g[data-connection]').length === n + 1, drawn);
  }
  await picture(page, 'parallel');
  const added = (await drawnHere()).filter((id) => !known.includes(id));
  const chosenLine = (id) => until(page, `${id} is chosen`, (c) => [...document.querySelectorAll('g[data-connection].chosen')].map((g) => g.dataset.connection).join() === c, id);
  for (const size of ['large', 'small']) {
    if (size === 'small') await smaller(0.4);
    for (const id of added) {
      await canvas.focus();
      await page.keyboard.press('Escape');
      await page.mouse.click(...(await along(id, 0.5)));
      await chosenLine(id);
    }
  }
  await canvas.focus();
  for (let i = 0; i <= added.length; i++) await page.keyboard.press('Control+z');
  await until(page, 'the lines are gone', (n) => document.querySelectorAll('g[data-connection]').length === n, known.length);
  await clean();

  if (!site) { // nothing else writes files that a browser keeps
    step('a type that changed outside and a parameter that changed here are in conflict: the page asks');
    await diagram.locator('.svelte-flow__node', { hasText: 'US' }).first().click();
    const gain = page.locator('[id="Reactive Layer/US.excGain"]');
    await gain.fill('4');
    await gain.press('Enter');
    await dirty();
    const text = readFileSync(file, 'utf8');
    const at = text.indexOf('neuronLinearThreshold', text.indexOf('name="US"'));
    writeFileSync(file, `${text.slice(0, at)}neuronSigmoid${text.slice(at + 'neuronLinearThreshold'.length)}`);
    await page.getByRole('button', { name: 'Merge both' }).click();
    const banner = page.getByRole('alert').filter({ hasText: 'was changed by another program' });
    await banner.getByText(/both have changed the type of group 'US' or its parameters/).waitFor();
    await banner.getByRole('button', { name: 'Merge both' }).waitFor({ state: 'detached' });
    await banner.getByRole('button', { name: 'Keep mine' }).click();
    await banner.waitFor({ state: 'detached' });
    await inFile('mine', /name="excGain" value="4"/);
  }

  step('a turn of the wheel with Ctrl, as two fingers on a pad are reported, zooms the page');
  await tab('System');
  await canvas.focus();
  await page.keyboard.press('f');
  const centre = await empty(), whole = await resting();
  await page.mouse.move(...centre);
  await page.keyboard.down('Control');
  await page.mouse.wheel(0, -120);
  await page.keyboard.up('Control');
  const wheeled = await resting();
  assert.ok(wheeled > 1.05 * whole, `${whole} becomes ${wheeled}`);
  assert.equal(await page.evaluate(() => window.visualViewport.scale), 1, 'the page of the browser stays');

  step('axe finds no fault of accessibility');
  await tab('System');
  await comments.first().click();
  await inspector.getByLabel('Text', { exact: true }).waitFor();
  await accessible(page);

  assert.deepEqual(faults, []);
}
