// Plots: choosing cells and states, scales, files, and following the model; in Chromium.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { eventually, find, picture, sent, until } from './support.mjs';

export default async function({ folder, start, open, faults, step }) {
  const page = await open(await start().address);
  const inspector = page.getByRole('region', { name: 'Inspector' });
  const tree = page.getByRole('navigation');
  const plot = (name) => page.getByRole('group', { name, exact: true });
  const show = (tab) => page.locator('.dv-tab', { hasText: tab }).filter({ hasText: new RegExp(`^${tab.replace(/[()]/g, '\\$&')}$`) }).click();
  const cycle = (n) => until(page, `cycle ${n}`, (wanted) => Number(document.querySelector('[aria-label="Moment of the run"]')?.value) >= wanted, n);
  const keysOf = () => page.locator('.key .name').allInnerTexts();

  step('space: a drag selects cells, Ctrl adds, and their mean is said');
  const space = plot('Space plot of Bug/Motor');
  const cells = space.getByRole('application');
  await cells.waitFor();
  await page.getByRole('button', { name: '4×' }).click();
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await cycle(60);
  await page.getByRole('button', { name: 'Pause', exact: true }).click();
  const at = async (x, y) => {
    const r = await cells.boundingBox();
    return [r.x + ((x - 0.5) / 9) * r.width, r.y + ((y - 0.5) / 9) * r.height];
  };
  const drag = async (from, to) => {
    await page.mouse.move(...(await at(...from)));
    await page.mouse.down();
    await page.mouse.move(...(await at(...to)), { steps: 4 });
    await page.mouse.up();
  };
  await drag([4, 4], [6, 5]);
  const chosen = space.getByRole('group', { name: 'Selected cells' });
  await chosen.getByText('6 cells, mean').waitFor();
  await page.keyboard.down('Control');
  await drag([1, 1], [2, 1]);
  await page.keyboard.up('Control');
  await chosen.getByText('8 cells, mean').waitFor();
  await picture(page, 'selected');
  await page.keyboard.press('Escape');
  await chosen.waitFor({ state: 'detached' });
  await page.mouse.click(...(await at(4, 4)));
  await page.keyboard.down('Shift');
  await page.mouse.click(...(await at(6, 5)));
  await chosen.getByText('6 cells, mean').waitFor();
  await page.mouse.click(...(await at(6, 6)));
  await chosen.getByText('9 cells, mean').waitFor();
  await page.keyboard.up('Shift');
  await page.keyboard.press('Escape');
  await chosen.waitFor({ state: 'detached' });

  step('space: the mean is that of the cells, which are read with the arrow keys; Shift selects');
  const reading = async () => Number((await space.getByRole('status').last().innerText()).split(') ')[1]);
  const chooseThree = async () => {
    await page.mouse.click(...(await at(4, 1)));
    await space.getByText('(4, 1)').waitFor();
    let sum = await reading();
    for (const key of ['ArrowRight', 'ArrowRight']) {
      await page.keyboard.press(`Shift+${key}`);
      sum += await reading();
    }
    return sum;
  };
  let sum = await chooseThree();
  for (let tries = 0; sum === 0 && tries < 60; tries++) {
    const before = await sent(page, 'ack');
    await page.keyboard.press('.'); // it may be at rest in this cycle
    await until(page, 'what the next cycle shows', (n) => window.sent.filter((s) => s === 'ack').length > n, before);
    sum = await chooseThree();
  }
  await chosen.getByText('3 cells, mean').waitFor();
  const mean = Number((await chosen.innerText()).match(/mean ([\d.e-]+)/)[1]);
  assert.ok(sum > 0 && Math.abs(mean - sum / 3) < 1e-3 * Math.max(1, mean), `${mean} is not ${sum / 3}`);
  await page.keyboard.press('Shift+ArrowDown');
  await chosen.getByText('6 cells, mean').waitFor();

  /** The text of what a panel saves. */
  const saved = async (panel, format) => {
    const [download] = await Promise.all([page.waitForEvent('download'), panel.getByLabel('Save').selectOption(format)]);
    await page.getByText(`${download.suggestedFilename()} is in the downloads of the browser.`).waitFor();
    return readFileSync(await download.path(), format === 'png' ? 'base64' : 'utf8');
  };
  step('space: the rectangle of the selection is enlarged, read and selected as before, until Escape');
  const width = () => space.locator('canvas.heat').evaluate((c) => `${c.width} ${c.height}`);
  await chosen.getByRole('button', { name: 'Zoom' }).click();
  await until(page, 'three columns', () => document.querySelector('[aria-label="Space plot of Bug/Motor"] canvas.heat').width === 3);
  assert.equal(await width(), '3 2');
  assert.match(await saved(space, 'csv'), /^row,column 4,column 5,column 6\n1,/);
  await cells.focus();
  await page.keyboard.press('Home');
  await space.getByText('(4, 1)').waitFor();
  await page.keyboard.press('Control+a');
  await chosen.getByText(`6 cells, mean`).waitFor();
  for (const left of ['the selection', 'the part']) {
    await page.keyboard.press('Escape');
    assert.equal(await space.getByRole('button', { name: 'Whole' }).count(), left === 'the part' ? 0 : 1, left);
  }
  assert.equal(await width(), '9 9');
  await page.mouse.click(...(await at(4, 1)));
  for (const key of ['ArrowRight', 'ArrowRight', 'ArrowDown']) await page.keyboard.press(`Shift+${key}`);

  step('space: the selection over time, as a mean and as cells');
  await chosen.getByRole('button', { name: 'Mean', exact: true }).click();
  await until(page, 'the mean over time', () => document.querySelector('.key .name')?.textContent === 'mean(Bug/Motor:act(4..6,1..2))');
  await show('Bug/Motor');
  await chosen.getByRole('button', { name: 'Cells', exact: true }).click();
  await until(page, 'six cells over time', () => [...document.querySelectorAll('.key .name')].some((n) => n.textContent === 'ahead 75 %, right 25 %'));
  assert.equal((await keysOf()).filter((k) => /^ahead \d+ %, (left 25 %|straight|right 25 %)$/.test(k)).length, 6);

  step('space: the selection is dragged to where it should be shown, and onto a plot over time');
  await show('Bug/Motor');
  await page.keyboard.press('Escape');
  await drag([1, 1], [2, 2]);
  await chosen.getByRole('button', { name: 'Mean', exact: true }).dragTo(plot('Space plot of Bug/Light'));
  const dropped = page.locator('.panel:has(.uplot)').filter({ visible: true });
  await dropped.getByText('mean(Bug/Motor:act(1..2,1..2))').waitFor();
  await page.mouse.move(...(await at(5, 5)));
  await drag([3, 3], [3, 4]);
  await chosen.getByText('2 cells, mean').waitFor();
  await chosen.getByRole('button', { name: 'Cells', exact: true }).dragTo(dropped.locator('.u-over'));
  await dropped.getByText('ahead 25 %, left 50 %').waitFor();
  assert.deepEqual(await dropped.locator('.key .name').allInnerTexts(), ['mean(Bug/Motor:act(1..2,1..2))', 'ahead 50 %, left 50 %', 'ahead 25 %, left 50 %']);
  await find(page, 'Record to a file');
  const sampler = page.locator('.panel', { hasText: 'If it is there' });
  await show('Bug/Light');
  const light = plot('Space plot of Bug/Light');
  await light.getByRole('application').focus();
  for (const key of ['Home', 'Shift+ArrowRight']) await page.keyboard.press(key);
  await light.getByRole('button', { name: 'Mean', exact: true }).dragTo(sampler.getByText('here, or name them above'));
  await sampler.getByText('mean(Bug/Light:act(1..2,1))').waitFor();
  for (const name of ['Record to a file', 'Over time']) {
    const tab = page.locator('.dv-tab', { hasText: name }).first();
    await tab.click();
    await tab.locator('.dv-default-tab-action').click();
  }

  step('time: a state and cells are chosen from lists or typed; what does not exist is said there');
  const time = page.locator('.panel:has(.uplot)').filter({ visible: true });
  await show('mean(Bug/Motor:act(4..6,1..2)) over time');
  const editor = page.getByRole('form', { name: 'Add a source' });
  const more = time.getByRole('button', { name: 'More' });
  await more.click();
  await time.getByRole('button', { name: 'Add', exact: true }).click();
  await editor.getByLabel('Group or connection').selectOption('Bug/Light');
  await editor.getByLabel('State').selectOption('excIn');
  await editor.getByLabel('Cells').fill('1..3,1');
  await editor.getByLabel('Cells').press('Tab');
  assert.equal(await editor.getByLabel('Source').inputValue(), 'mean(Bug/Light:excIn(1..3,1))');
  await picture(page, 'editor');
  await editor.getByRole('button', { name: 'Add' }).click();
  await time.getByRole('button', { name: 'Change mean(Bug/Light:excIn(1..3,1))' }).waitFor();
  await time.getByRole('button', { name: 'Add', exact: true }).click();
  for (const [text, reason] of [['Bug/Nothing', /Bug\/Nothing/], ['Bug/Motor:act', /81 cells/]]) {
    await editor.getByLabel('Source').fill(text);
    await editor.getByLabel('Source').press('Enter');
    await until(page, `the mistake of ${text}`, (t) => document.querySelector('[role=alert]')?.textContent.includes(t), text);
    assert.match(await editor.getByRole('alert').innerText(), reason);
  }
  await editor.getByLabel('Source').fill('Bug/Light(16..17,1)');
  await editor.getByLabel('Source').press('Enter');
  await time.getByRole('button', { name: 'Change Bug/Light(17,1)' }).waitFor();
  await time.getByRole('button', { name: 'Change Bug/Light(16,1)' }).click();
  await page.getByRole('form', { name: 'Change Bug/Light(16,1)' }).getByLabel('State').selectOption('inhIn');
  await page.getByRole('form').getByRole('button', { name: 'Change' }).click();
  await time.getByRole('button', { name: 'Change Bug/Light:inhIn(16,1)' }).waitFor();
  await time.getByRole('button', { name: 'Remove Bug/Light:inhIn(16,1)' }).click();

  step('time: a part that is chosen with a drag stays while the run continues, until Escape');
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await cycle(150);
  const traces = time.getByRole('application');
  const r = await time.locator('.u-over').boundingBox();
  const zoom = async () => {
    await page.mouse.move(r.x + r.width * 0.3, r.y + r.height * 0.5);
    await page.mouse.down();
    await page.mouse.move(r.x + r.width * 0.6, r.y + r.height * 0.5, { steps: 4 });
    await page.mouse.up();
    await time.getByRole('button', { name: 'Whole' }).waitFor();
  };
  await zoom();
  await page.keyboard.press('End');
  const moment = () => time.locator('.bar > .number').first().innerText();
  const before = await moment();
  const c = await page.evaluate(() => Number(document.querySelector('[aria-label="Moment of the run"]').value));
  await cycle(c + 60);
  await page.keyboard.press('End');
  assert.equal(await moment(), before, 'the last moment of the chosen part');
  await page.keyboard.press('Shift+ArrowLeft');
  assert.ok(parseFloat(await moment()) < parseFloat(before));
  assert.match(await time.getByRole('status').innerText(), /^[\d.]+ s \(cycle \d+\): mean\(Bug\/Motor:act\(4\.\.6,1\.\.2\)\) [\d.]+, /);
  await picture(page, 'zoom');
  await page.keyboard.press('Escape');
  await time.getByRole('button', { name: 'Whole' }).waitFor({ state: 'detached' });
  await page.keyboard.press('End');
  assert.ok(parseFloat(await moment()) > parseFloat(before));
  await zoom();
  await time.locator('.u-over').dblclick();
  await time.getByRole('button', { name: 'Whole' }).waitFor({ state: 'detached' });
  await page.getByRole('button', { name: 'Pause', exact: true }).click();

  step('time: in a narrow column the bar leaves room for the plot; what is rarely chosen opens below it');
  for (const choice of ['Seconds shown', 'Vertical scale', 'Save']) await time.getByLabel(choice, { exact: true }).waitFor();
  await time.getByLabel('Seconds shown').selectOption('600');
  await time.getByText(/ min\/max of \d+ cycles$/).waitFor();
  await picture(page, 'time-choices');
  const wide = await time.locator('.reading').evaluate((bar) => bar.clientWidth);
  await page.setViewportSize({ width: 1150, height: 900 });
  await eventually('a narrower plot', () => time.locator('.reading').evaluate((bar, before) => bar.clientWidth < before, wide));
  assert.ok(await time.locator('.reading').evaluate((bar) => bar.scrollWidth <= bar.clientWidth), 'the words below the plot are whole');
  await page.setViewportSize({ width: 1400, height: 900 });
  await time.getByLabel('Seconds shown').selectOption('30');
  await more.click();
  await time.getByLabel('Seconds shown').waitFor({ state: 'detached' });
  await picture(page, 'time-folded');
  await page.setViewportSize({ width: 2600, height: 900 });
  await more.waitFor({ state: 'detached' });
  await time.getByLabel('Seconds shown').waitFor();
  await page.setViewportSize({ width: 1400, height: 900 });
  await more.click();

  step('time: the scale is kept in the layout');
  await time.getByLabel('Vertical scale').selectOption('manual');
  await time.getByLabel('Highest value').fill('2.5');
  await time.getByLabel('Highest value').press('Enter');
  await until(page, 'the layout', () => Object.keys(localStorage).some((k) => k.startsWith('layout') && localStorage.getItem(k).includes('"high":2.5')));
  await page.reload();
  await more.click();
  await until(page, 'the scale', () => [...document.querySelectorAll('[aria-label="Highest value"]')].some((i) => i.value === '2.5'));
  await show('Bug/Motor');

  const png = (text) => assert.ok(text.startsWith('iVBORw0KGgo') && text.length > 200, text.slice(0, 40));

  step('raster: state, cycles, scale, files, and the value under the pointer');
  await tree.getByText('Motor', { exact: true }).click();
  await inspector.getByRole('button', { name: 'Raster' }).click();
  const raster = plot('Raster plot of Bug/Motor');
  await raster.getByLabel('State').selectOption('excIn');
  await raster.getByLabel('Time shown').selectOption('100');
  await raster.getByText('It fills while the system runs.').waitFor();
  assert.ok(await raster.evaluate((e) => e.querySelector('.names').getBoundingClientRect().right <= e.querySelector('.empty').getBoundingClientRect().left), 'the names of the rows stand beside the text');
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  const begin = await page.evaluate(() => Number(document.querySelector('[aria-label="Moment of the run"]').value));
  await cycle(begin + 60);
  await page.getByRole('button', { name: 'Pause', exact: true }).click();
  await until(page, 'a picture of 100 cycles', () => document.querySelector('[aria-label="Raster plot of Bug/Motor"] canvas').width === 100);
  await raster.getByRole('application').focus();
  await page.keyboard.press('End');
  await raster.getByText(/^back 100 %, right 100 % \(9, 9\) [\d.]+ s \(cycle \d+\) [\d.]+$/).waitFor();
  png(await saved(raster, 'png'));
  const rows = (await saved(raster, 'csv')).trim().split('\n').map((l) => l.replace(/"[^"]*"/g, 'name').split(','));
  assert.ok(rows.length > 50 && rows.every((r) => r.length === 82), `${rows.length} rows`);
  assert.ok(rows.slice(2).every((r, i) => Number(r[0]) === Number(rows[1][0]) + i + 1), 'a row per cycle');
  await raster.getByLabel('Colour scale').selectOption('manual');
  await raster.getByLabel('Highest value of the scale').fill('7');
  await raster.getByLabel('Highest value of the scale').press('Enter');
  await picture(page, 'raster');

  step('camera: the colour under the pointer, and files');
  await page.locator('.dv-tab', { hasText: /^Arena$/ }).click();
  await page.getByRole('button', { name: 'Camera' }).click();
  const camera = page.getByRole('group', { name: /^Camera of / });
  await camera.getByRole('application').focus();
  await page.keyboard.press('ArrowRight');
  await camera.getByText(/^\(1, 1\) red, green, blue \d+ \d+ \d+$/).waitFor();
  assert.match(await saved(camera, 'csv'), /^column,row,red,green,blue\n1,1,\d+,\d+,\d+\n2,1,/);
  png(await saved(camera, 'png'));

  step('panels follow a group that gets another name, with their traces; the titles of a selected group are marked');
  const tabs = () => page.locator('.dv-tab').allInnerTexts().then((all) => all.map((t) => t.trim()));
  const marked = () => page.locator('.dv-tab:has(.selected)').allInnerTexts().then((all) => all.map((t) => t.trim()).sort());
  await tree.getByText('Light', { exact: true }).click();
  await until(page, 'marked titles', () => [...document.querySelectorAll('.dv-tab:has(.selected)')].some((t) => t.textContent.trim() === 'Bug/Light'));
  assert.ok((await marked()).includes('Over time') && !(await marked()).includes('Bug/Motor'), (await marked()).join());
  await picture(page, 'marked');
  await inspector.getByRole('button', { name: 'Drive' }).click();
  await plot('Drive Bug/Light').waitFor();
  const count = (await tabs()).length;
  /** The numbers that the plots over time have seen: the traces, and the raster. */
  const seen = async (process) => {
    const all = [];
    for (const [title, panel] of [['Over time', time], [`${process}/Motor raster`, plot(`Raster plot of ${process}/Motor`)]]) {
      await page.locator('.dv-tab', { hasText: title }).first().click();
      all.push((await saved(panel, 'csv')).trim().split('\n').slice(1));
    }
    return all;
  };
  const already = await seen('Bug');
  assert.ok(already.every((rows) => rows.length > 10), `${already.map((rows) => rows.length)} rows`);
  await inspector.getByLabel('Name', { exact: true }).fill('Lamp');
  await inspector.getByLabel('Name', { exact: true }).press('Enter');
  await plot('Space plot of Bug/Lamp').waitFor();
  assert.ok((await tabs()).includes('Bug/Lamp') && (await tabs()).length === count);
  await page.locator('.dv-tab', { hasText: 'Drive Bug/Lamp' }).click();
  await plot('Drive Bug/Lamp').waitFor();
  await page.locator('.dv-tab', { hasText: 'Over time' }).first().click();
  await time.getByRole('button', { name: 'Change Bug/Lamp(17,1)' }).waitFor();
  assert.deepEqual(await seen('Bug'), already, 'what was seen stays');
  await tree.getByRole('button', { name: /^Bug/ }).first().click();
  await inspector.getByLabel('Name', { exact: true }).fill('Robot');
  await inspector.getByLabel('Name', { exact: true }).press('Enter');
  await until(page, 'the name of the process', () => [...document.querySelectorAll('.dv-tab')].some((t) => t.textContent.trim() === 'Robot/Motor raster'));
  assert.deepEqual(await seen('Robot'), already);
  await page.locator('.dv-tab', { hasText: 'Over time' }).first().click();
  await time.getByRole('button', { name: 'Change Robot/Lamp(17,1)' }).waitFor();
  await page.keyboard.press('Control+z');
  await time.getByRole('button', { name: 'Change Bug/Lamp(17,1)' }).waitFor();
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await until(page, 'a value of the renamed group', () => [...document.querySelectorAll('.key')].some((k) => k.querySelector('[aria-label*="Bug/Lamp(17,1)"]') && /\d$/.test(k.querySelector('.number').textContent)));
  await page.getByRole('button', { name: 'Pause', exact: true }).click();

  step('a group that is deleted takes its panels with it, and one undo brings both back');
  await tree.getByText('Motor', { exact: true }).click();
  await page.keyboard.press('Delete');
  await page.getByText(/^Bug\/Motor is gone, and its \d panels are closed. Undo brings back both.$/).waitFor();
  assert.ok(!(await tabs()).some((t) => t.includes('Motor')), (await tabs()).join());
  await page.getByRole('button', { name: 'Undo' }).first().click();
  await until(page, 'the panels of Bug/Motor', () => [...document.querySelectorAll('.dv-tab')].filter((t) => /^Bug\/Motor( raster)?$/.test(t.textContent.trim())).length === 2);

  step('sparse groups have their lattice in space plots and wiring, whose cells are chosen by keyboard');
  const kinds = [['learns', '<Synapse name="synapseHebbian"><Parameter name="lrate" value="0.1"/><XRefHolder name="Freedback"><XRef name="postact" target="act"/></XRefHolder></Synapse>'], [
    'constant',
    '<Synapse name="synapseFixedWeight"><Parameter name="weight" value="0.5"/></Synapse>',
  ]];
  writeFileSync(
    join(folder, 'small.iqr'),
    `<System id="s" name="S"><Process id="p" name="P">
    <Group id="a" name="A"><Topology><TopologySparse><Point x="2" y="3"/><Point x="3" y="1"/><Point x="1" y="1"/></TopologySparse></Topology><Neuron name="neuronRandomSpike"/></Group>
    <Group id="b" name="B"><Topology><TopologyRect hcount="3" vcount="2" cylinderHor="false" cylinderVert="false"/></Topology><Neuron name="neuronLinearThreshold"/></Group>
  </Process>${kinds.map(([name, synapse]) => `<Connection id="${name}" name="${name}" source="a" target="b" type="excitatory"><Pattern><PatternForeach/></Pattern>${synapse}</Connection>`).join('')}</System>`,
  );
  await page.goto(await start(['small.iqr']).address);
  await tree.getByText('A', { exact: true }).click();
  await inspector.getByRole('button', { name: 'Space' }).click();
  const sparse = plot('Space plot of P/A');
  await until(page, 'a lattice of 3 × 3', () => document.querySelector('[aria-label="Space plot of P/A"] canvas.heat')?.height === 3);
  await sparse.getByRole('application').focus();
  await page.keyboard.press('ArrowRight');
  for (const [key, text] of [['ArrowRight', '(2, 1) no cell'], ['ArrowRight', '(3, 1) '], ['Control+a', '3 cells, mean']]) {
    await page.keyboard.press(key);
    await sparse.getByText(text).waitFor();
  }
  await picture(page, 'sparse');
  await tree.getByRole('button', { name: 'Connections', exact: true }).last().click();
  await tree.getByText('constant', { exact: true }).click();
  const plots = () => inspector.locator('.open button').allInnerTexts();
  assert.deepEqual(await plots(), ['Wiring'], 'synapses that keep nothing have no plot of their states');
  await tree.getByText('learns', { exact: true }).click();
  assert.deepEqual(await plots(), ['Wiring', 'Weight', 'Synaptic potential']);
  await inspector.getByRole('button', { name: 'Wiring' }).click();
  const wiring = plot('Wiring of learns');
  const source = wiring.getByRole('application', { name: 'Choose a source cell' }), target = wiring.getByRole('application', { name: 'Choose a target cell' });
  await wiring.waitFor();
  await wiring.getByText('6 synapses').waitFor();
  await source.focus();
  for (const key of ['Enter', 'ArrowRight', 'End', 'ArrowLeft', 'Enter']) await page.keyboard.press(key);
  assert.equal(await wiring.getByRole('spinbutton').inputValue(), '3');
  assert.deepEqual(await source.locator('canvas').evaluate((c) => [c.width, c.height]), [3, 3]);
  await target.focus();
  for (const key of ['ArrowRight', 'ArrowDown', 'Enter']) await page.keyboard.press(key);
  await wiring.getByText('3 synapses').waitFor();
  assert.equal(await wiring.getByRole('spinbutton').inputValue(), '4');
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await wiring.getByLabel('What is shown').selectOption({ label: 'Weight, live' });
  await source.focus();
  await page.keyboard.press('Home');
  await wiring.getByText(/^source \(1, 1\) [\d.e-]+$/).waitFor();
  await until(page, 'a weight that learns', () => parseFloat([...document.querySelectorAll('[aria-label="Wiring of learns"] [role=status]')][0].textContent.split(') ')[1]) > 0);
  assert.match(await saved(wiring, 'csv'), /^source,target,strength,distance,delay,weight\n1,4,/);
  assert.match(await saved(wiring, 'svg'), /<rect .*>P\/A<.*>P\/B</s);
  png(await saved(wiring, 'png'));
  await picture(page, 'wiring');

  step('weights: the value of a synapse, its course, the scale, and files');
  await inspector.getByRole('button', { name: 'Weight' }).click();
  const weights = plot('Weights of learns');
  await until(page, 'a column per source cell', () => document.querySelector('[aria-label="Weights of learns"] canvas')?.width === 3);
  await weights.getByRole('application').focus();
  for (const key of ['End', 'ArrowLeft']) await page.keyboard.press(key);
  await weights.getByText(/^\(3, 1\) → \(3, 2\) [\d.e-]+$/).waitFor();
  assert.equal((await saved(weights, 'svg')).match(/<rect /g).length, 18);
  assert.match(await saved(weights, 'csv'), /^source 1,source 2,source 3\n([\d.e-]+,){2}/);
  await weights.getByLabel('Colour scale').selectOption('manual');
  await weights.getByLabel('State').selectOption({ label: 'Synaptic potential' });
  await picture(page, 'weights');
  await weights.getByRole('button', { name: 'This synapse over time' }).click();
  await page.getByRole('button', { name: /^Change learns:\w+\(2,6\)$/ }).waitFor();

  step('time: a run that begins again has an empty plot');
  const filled = (what, wanted) => until(page, what, (w) => [...document.querySelectorAll('.panel:has(.uplot)')].some((p) => p.offsetWidth && !p.querySelector('.empty') === w), wanted);
  await filled('a trace', true);
  await page.getByRole('button', { name: 'Pause', exact: true }).click();
  await page.getByRole('button', { name: 'Stop', exact: true }).click();
  await filled('no trace', false);

  assert.deepEqual(faults, []);
}
