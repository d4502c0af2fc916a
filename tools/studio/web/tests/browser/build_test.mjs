// From nothing to a foraging robot, by mouse and keyboard alone: the reactive layer of the tutorial is built from an empty system, saved, checked and
// run by the command line, and its groups and connections are those of the shipped one.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { answeredTo, eventually, find, picture, sent, until } from './support.mjs';

// What the tutorial says of the groups: place on the page, size, and the parameters that differ from the defaults.
const relay = {};
const clipped = { clipVm: true, vmMin: 0, vmMax: 1 };
const reactive = {
  US: { at: [120, 160], size: [7, 1], set: { excGain: 5, inhGain: 1, ...clipped, threshold: 0.01 } },
  Approach: { at: [480, 160], size: [9, 1], set: { excGain: 1, inhGain: 1, threshold: 0.7 } },
};
const selection = {
  Approach: { at: [120, 120], size: [9, 1], set: { excGain: 1, inhGain: 1.5, ...clipped, threshold: 0 } },
  UR: { at: [400, 120], size: [9, 1], set: relay },
  'Motor In': { at: [680, 120], size: [9, 1], set: relay },
  'Approach Inhibition': { at: [120, 320], size: [1, 1], set: { excGain: 10, inhGain: 1, ...clipped, threshold: 0 } },
  Explore: { at: [400, 320], size: [9, 1], set: { excGain: 1, inhGain: 1.5, threshold: 0 } },
  'Const Speed': { at: [400, 520], size: [1, 1], type: 'neuronRandomSpike', set: { probability: 1, spkAmpl: 1 } },
};

export default async function({ forage, folder, start, open, onDisk, faults, step }) {
  const page = await open(await start(['systems/reactive_foraging.iqr', '--world', 'systems/worlds/basic_arena.world']).address);
  const run = (...args) => execFileSync(forage, args, { cwd: folder, encoding: 'utf8' });
  const diagram = page.getByRole('group', { name: 'Diagram' });
  const inspector = page.getByRole('region', { name: 'Inspector' });
  const canvas = diagram.getByRole('application', { name: 'Canvas' });
  const box = (name) => diagram.locator('.svelte-flow__node').filter({ hasText: name });
  const tab = (name) => diagram.getByRole('group', { name: 'Processes' }).first().getByRole('button', { name, exact: true }).click();
  const heading = (name) => inspector.getByRole('heading', { name, exact: true }).waitFor();
  const field = (label) => inspector.getByLabel(label, { exact: true });
  const write = async (input, value) => {
    if (typeof value === 'boolean') return input.setChecked(value);
    await input.fill(String(value));
    await input.press('Enter');
  };
  const called = async (path, name) => {
    await diagram.locator('.svelte-flow__node input').waitFor();
    await page.keyboard.type(name);
    await page.keyboard.press('Enter');
    await heading(path);
  };

  step('a new system shows its diagram beside the arena, in real time, whatever was open before');
  await page.getByRole('button', { name: 'Max', exact: true }).click();
  const kept = await sent(page, 'panels_keep');
  await find(page, 'layout: overview');
  await answeredTo(page, 'panels_keep', kept);
  await page.reload(); // the server has the panels of the system before
  await page.getByRole('button', { name: /Reactive foraging/ }).first().click();
  await page.getByRole('menuitem', { name: 'New' }).click();
  await page.getByRole('dialog', { name: 'New system' }).getByLabel('Name').fill('Mine');
  await page.keyboard.press('Enter');
  await page.getByText('The system is empty').waitFor();
  await page.getByRole('group', { name: 'Arena' }).waitFor(); // beside the diagram
  assert.deepEqual(await page.locator('.dv-tab').allTextContents().then((all) => all.map((t) => t.trim()).sort()), ['Arena', 'Diagram']);
  await page.getByRole('button', { name: '1×', exact: true, pressed: true }).waitFor();
  await page.getByRole('button', { name: 'Arrange, view, save' }).click(); // one menu, as there is less room
  await page.getByRole('menuitem', { name: 'Lay out the page' }).waitFor();
  await page.keyboard.press('Escape');
  await find(page, 'layout: build');

  step('three processes, placed by the mouse');
  for (const [name, x, y] of [['Bug', 150, 400], ['Reactive Layer', 400, 150], ['Selection', 650, 400]]) {
    await diagram.getByRole('button', { name: 'Process', exact: true }).click();
    await canvas.click({ position: { x, y } });
    await called(name, name);
  }

  step('the groups of the robot, by the keyboard; its module and what it is wired to');
  await box('Bug').focus();
  await page.keyboard.press('Enter');
  await page.keyboard.press('Enter');
  for (const [name, columns, rows] of [['Motor', 9, 9], ['Light', 32, 1], ['Sensor', 32, 1]]) {
    await canvas.press('g');
    await called(`Bug/${name}`, name);
    await write(field('Columns'), columns);
    await write(field('Rows'), rows);
  }
  await page.getByRole('navigation').getByRole('button', { name: /^Bug/ }).last().click();
  await heading('Bug');
  await field('Type').selectOption('moduleGazeboBug');
  for (const [port, group] of [['_motor', 'Motor'], ['_target', 'Light'], ['_proximity', 'Sensor']]) await inspector.locator(`[data-port="${port}"] select`).selectOption({ label: group });

  await write(page.locator('[id="Bug.device_name"]'), 'Bug');

  const groups = async (process, table) => {
    await tab(process);
    for (const [name, g] of Object.entries(table)) {
      await diagram.getByRole('button', { name: 'Group', exact: true }).click();
      await canvas.click({ position: { x: g.at[0], y: g.at[1] } });
      await called(`${process}/${name}`, name);
      if (g.type) await field('Neuron').selectOption(g.type);
      if (g.size[0] > 1) await write(field('Columns'), g.size[0]);
      for (const [parameter, value] of Object.entries(g.set)) await write(page.locator(`[id="${process}/${name}.${parameter}"]`), value);
    }
  };
  step('the groups of the reactive layer and of the selection');
  await groups('Reactive Layer', reactive);
  await groups('Selection', selection);

  const named = async (ends, name) => {
    await inspector.getByText(ends, { exact: true }).waitFor();
    await field('Kind').waitFor();
    await write(field('Name'), name);
    await heading(name);
  };
  // From one side of a box to a side of another, and over corners.
  const draw = async (kind, from, to, corners = []) => {
    await diagram.getByRole('button', { name: `Connect ${kind}` }).click();
    await box(from).click();
    for (const [x, y] of corners) await canvas.click({ position: { x, y } });
    await box(to).click();
  };
  const exact = (name) => new RegExp(`^\\s*${name}\\s*$`);
  const advanced = async (mapping) => {
    await field('Cells').selectOption('advanced');
    await field('Pattern').selectOption('mapped');
    await field('Mapping').selectOption(mapping);
  };
  step('connections within a page: by clicks');
  await draw('excitatory', exact('Approach'), exact('UR'));
  await named('Selection/Approach → Selection/UR', 'Approach to UR');
  await draw('excitatory', exact('UR'), 'Motor In');
  await named('Selection/UR → Selection/Motor In', 'UR to Motor In');
  await draw('excitatory', 'Const Speed', exact('Explore'));
  await named('Selection/Const Speed → Selection/Explore', 'Const Speed to Explore');
  await advanced('center');
  await draw('excitatory', exact('Explore'), 'Motor In', [[730, 380]]);
  await named('Selection/Explore → Selection/Motor In', 'Explore to Motor In');
  await draw('excitatory', exact('Approach'), 'Approach Inhibition');
  await named('Selection/Approach → Selection/Approach Inhibition', 'Approach to Approach Inhibition');
  // Groups of different sizes are connected all to all; the words of the file format are one step further.
  assert.equal(await field('Cells').inputValue(), 'all to all');
  await inspector.getByText('9 synapses', { exact: true }).waitFor();
  await field('Cells').selectOption('advanced');
  await field('Pattern').selectOption('mapped');
  await inspector.getByText('1 of 9 cells of Selection/Approach is used.').waitFor();
  await field('Mapping').selectOption('all');
  await draw('inhibitory', 'Approach Inhibition', exact('Explore'));
  await named('Selection/Approach Inhibition → Selection/Explore', 'Approach Inhibition to Explore');
  await advanced('all');
  await tab('Reactive Layer');
  await draw('excitatory', 'US', exact('Approach'));
  await named('Reactive Layer/US → Reactive Layer/Approach', 'US to Approach');
  await field('Cells').selectOption('nearest');
  await inspector.getByText('9 synapses', { exact: true }).waitFor();
  await field('Cells').selectOption('chosen cells');
  await inspector.getByRole('button', { name: 'Remove all tuples' }).click();
  for (const [s, t] of [[3, 1], [4, 5], [5, 9]]) {
    await inspector.getByRole('checkbox', { name: `Source cell (${s}, 1)` }).click();
    await inspector.getByRole('checkbox', { name: `Target cell (${t}, 1)` }).click();
    await inspector.getByRole('button', { name: 'Add tuple' }).click();
    await inspector.getByRole('list', { name: 'Tuples' }).getByText(`${s},1 → ${t},1`).waitFor();
  }
  // Shift chooses all from the last one to this one.
  await inspector.getByRole('checkbox', { name: 'Source cell (2, 1)' }).click();
  await inspector.getByRole('checkbox', { name: 'Source cell (4, 1)' }).click({ modifiers: ['Shift'] });
  await inspector.getByRole('checkbox', { name: 'Target cell (1, 1)' }).click();
  await inspector.getByRole('button', { name: 'Add tuple' }).click();
  await inspector.getByRole('list', { name: 'Tuples' }).getByText('2,1 3,1 4,1 → 1,1').waitFor();
  await inspector.getByRole('button', { name: 'Remove tuple 4' }).click();
  await inspector.getByRole('button', { name: 'Remove tuple 4' }).waitFor({ state: 'detached' });
  await page.getByRole('button', { name: 'Close the inspector' }).click();
  await diagram.getByLabel('US to Approach, excitatory').dispatchEvent('dblclick'); // a level line has no height to click on
  await heading('US to Approach');
  await inspector.getByText('3 synapses', { exact: true }).waitFor();

  step('a connection across processes: two panes');
  await diagram.getByRole('button', { name: 'View', exact: true }).click();
  await page.getByRole('menuitem', { name: 'Two panes side by side' }).click();
  const panes = diagram.locator('.pane');
  await panes.nth(1).getByRole('button', { name: 'Bug', exact: true }).click();
  await diagram.getByRole('button', { name: 'Connect excitatory' }).click();
  await panes.nth(1).locator('.svelte-flow__node').filter({ hasText: exact('Light') }).click();
  await panes.nth(0).locator('.svelte-flow__node').filter({ hasText: exact('US') }).click();
  await named('Bug/Light → Reactive Layer/US', 'Light to US');
  await advanced('center');
  await inspector.getByText('Spread and delay').click();
  await field('Spread').selectOption('ArbRect');
  await write(field('Width'), 10);
  await field('Attenuation').selectOption('FunGaussian');
  await write(field('At the largest distance'), 1);
  await write(field('Width of the Gaussian'), 5);

  step('the others by the dialog, without the mouse');
  const dialog = async (from, to, name) => {
    await diagram.getByRole('button', { name: 'Connect excitatory' }).focus();
    await page.keyboard.press('Enter');
    const connect = page.getByRole('dialog', { name: 'Connect' });
    await connect.getByLabel('From').selectOption({ label: from });
    await connect.getByLabel('To').selectOption({ label: to });
    await connect.getByLabel('To').press('Enter');
    await connect.getByRole('button', { name: 'Connect', exact: true }).press('Enter');
    await named(`${from} → ${to}`, name);
  };
  await dialog('Reactive Layer/Approach', 'Selection/Approach', 'Reactive Approach to Approach');
  await dialog('Selection/Motor In', 'Bug/Motor', 'Motor In to Motor');
  await field('Cells').selectOption('chosen cells');
  await inspector.getByText('From text').click();
  await inspector.getByLabel('Tuples as text').fill('1,1:1,4 2,1:1,1|2,1 3,1:3,1 4,1:4,1 5,1:5,1 6,1:6,1 7,1:7,1 8,1:8,1|9,1 9,1:9,4');
  await inspector.getByRole('button', { name: 'Add these' }).click();
  await inspector.getByText('11 synapses', { exact: true }).waitFor();
  await picture(page, 'build');

  step('no problems are left; it is saved');
  await page.keyboard.press('Escape');
  const problems = page.getByRole('button', { name: /problem/ });
  assert.equal(await problems.count(), 0, await problems.getAttribute('title', { timeout: 1 }).catch(() => ''));
  await page.keyboard.press('Control+s');
  const save = page.getByRole('dialog', { name: 'Save as' });
  await save.getByLabel('Name').fill('mine.iqr');
  await save.getByLabel('Name').press('Enter');
  await until(page, 'the file', () => !document.title.startsWith('●'));

  step('the command line checks it, describes the same connections, and runs it');
  const described = (file) => JSON.parse(run('describe', file, '--format', 'json'));
  const mine = 'mine.iqr';
  await onDisk(page, mine);
  run('check', mine, '--world', 'systems/worlds/basic_arena.world');
  const [built, shipped] = [mine, 'systems/reactive_foraging.iqr'].map(described);
  // The shipped file writes out the weight, which is the default.
  const plain = (system) => system.connections.map(({ id, notes, synapse, ...c }) => ({ ...c, synapse: { ...synapse, parameters: { weight: '1', ...synapse.parameters } } })).sort((a, b) => a.name.localeCompare(b.name));
  assert.deepEqual(plain(built), plain(shipped));
  // describe counts tuples: their cells are compared in the files.
  const patterns = (file) =>
    page.evaluate((text) => {
      const system = new DOMParser().parseFromString(text, 'text/xml');
      const places = (e) => [...e.querySelectorAll('Point')].map((p) => `${p.getAttribute('x')},${p.getAttribute('y')}`).join(' ');
      return [...system.querySelectorAll('Connection')].map((c) => [c.getAttribute('name'), [...c.querySelectorAll('Tuple')].map((t) => `${places(t.querySelector('SourceList'))}:${places(t.querySelector('TargetList'))}`)]).sort();
    }, readFileSync(join(folder, file), 'utf8'));
  assert.deepEqual(await patterns(mine), await patterns('systems/reactive_foraging.iqr'));
  run('run', mine, '--world', 'systems/worlds/basic_arena.world', '--cycles', '200');

  step('from nothing to a robot that avoids walls, in 12 clicks');
  await page.evaluate(() => {
    window.clicks = 0;
    addEventListener('pointerdown', () => (window.clicks += 1), true);
    addEventListener('change', (e) => (window.clicks += e.target.matches('select')), true); // it is chosen without the mouse here
  });
  await page.getByRole('button', { name: /^Mine/ }).click();
  await page.getByRole('menuitem', { name: 'New…' }).click();
  const begin = page.getByRole('dialog', { name: 'New system' });
  await begin.getByLabel('Begin with').selectOption({ label: 'Robot that drives' });
  await begin.getByRole('button', { name: 'Create' }).click();
  await until(page, 'the new system', () => document.title.includes('Robot that drives'));
  await box(exact('Sensor')).waitFor();
  await draw('excitatory', exact('Sensor'), exact('Motor'));
  await field('Cells').selectOption('chosen cells');
  const middle = async (side, x, y) => {
    const cell = inspector.getByRole('checkbox', { name: `${side} cell (${x}, ${y})` });
    await cell.scrollIntoViewIfNeeded();
    const at = await cell.boundingBox();
    return [at.x + at.width / 2, at.y + at.height / 2];
  };
  for (const [ray, x, y] of [[15, 9, 4], [18, 1, 4]]) {
    await middle('Target', x, y); // both are in view
    const from = await middle('Source', ray, 1);
    await page.mouse.move(...from);
    await page.mouse.down();
    await page.mouse.move(...(await middle('Target', x, y)), { steps: 4 });
    await page.mouse.up();
    await inspector.getByRole('list', { name: 'Tuples' }).getByText(`${ray},1 → ${x},${y}`).waitFor();
  }
  const said = inspector.getByText('2 of 32 cells of Bug/Sensor are used.');
  assert.ok(await said.evaluate((e) => e.matches('.muted:not(.likely)')), 'they were chosen: it is no warning');
  await until(page, 'the button that adds a tuple, below the cells that are scrolled', () => {
    const scroll = document.querySelector('aside.right .scroll'), cells = document.querySelector('[data-grid="Source"]'), add = [...scroll.querySelectorAll('button')].find((b) => b.textContent === 'Add tuple');
    cells.scrollIntoView({ block: 'end' });
    return add.getBoundingClientRect().bottom <= scroll.getBoundingClientRect().bottom;
  });
  await picture(page, 'chooser');
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await until(page, 'it runs', () => Number(document.querySelector('[aria-label="Moment of the run"]')?.value) > 10);
  const clicks = await page.evaluate(() => window.clicks);
  assert.ok(clicks <= 12, `${clicks} clicks`);
  await page.keyboard.press('Control+s');
  await save.getByLabel('Name').fill('walls.iqr');
  await save.getByLabel('Name').press('Enter');
  await page.getByText('Saved as walls.iqr.').waitFor();
  await onDisk(page, 'walls.iqr');
  run('run', 'walls.iqr', '--world', 'systems/worlds/open_arena.world', '--seconds', '60', '-o', 'walls');
  const places = readFileSync(join(folder, 'walls/trajectory.csv'), 'utf8').trim().split('\n').slice(1).map((line) => line.split(',').slice(2, 4).map(Number));
  const last = places.slice(-Math.floor(places.length / 3));
  const way = last.slice(1).reduce((sum, [x, y], k) => sum + Math.hypot(x - last[k][0], y - last[k][1]), 0);
  assert.ok(way > 10, `it drives on for ${way} m in the last 20 s, and stands at no wall`);

  step('a robot is one choice; Run says what keeps it at rest; an error has a button that mends it');
  const begun = async (text, button) => {
    await page.getByRole('button', { name: 'Run', exact: true }).click();
    await page.locator('.notice').filter({ hasText: text }).getByRole('button', { name: button }).click();
    await page.getByRole('button', { name: 'Pause', exact: true }).click();
  };
  await page.keyboard.press('Alt+n');
  await begin.getByLabel('Name').fill('Empty');
  await begin.getByRole('button', { name: 'Create' }).click();
  await page.getByRole('button', { name: 'Add the robot Bug' }).first().waitFor(); // in either pane
  await begun('No module drives the robot Bug.', 'Add the robot Bug');
  for (const name of ['Motor', 'Proximity sensor', 'Target sensor']) await diagram.locator(`.svelte-flow__node[aria-label="${name}"]`).waitFor(); // its text may be shorter
  assert.equal(await problems.count(), 0);
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await page.locator('.notice').filter({ hasText: "Nothing drives group 'Bug/Motor', which the module of process 'Bug' reads." }).getByRole('button', { name: 'Connect a group to it' }).click();
  await until(page, 'the motor as the target', () => [...document.querySelectorAll('dialog[open] option:checked')].some((o) => o.textContent === 'Bug/Motor'));
  await page.getByRole('dialog', { name: 'Connect' }).getByRole('button', { name: 'Cancel' }).click();
  await page.getByRole('button', { name: 'Pause', exact: true }).click();
  await page.getByRole('button', { name: 'Close the inspector' }).click();
  const connect = async (target = 'Motor') => {
    await page.getByRole('button', { name: 'Connect excitatory' }).first().click();
    for (const end of ['Proximity sensor', target]) await diagram.locator(`.svelte-flow__node[aria-label="${end}"]`).first().click();
  };
  await connect();
  await field('Cells').waitFor(); // its form is opened again, as cells are to be chosen
  await inspector.getByText(/^Read by Gazebo Bug as Motor\. The most active cell/).waitFor();
  await page.keyboard.press('Control+z');
  // A drag from box to box connects them, too.
  await page.getByRole('button', { name: 'Connect excitatory' }).first().click();
  await diagram.locator('.svelte-flow__node[aria-label="Target sensor"]').first().dragTo(diagram.locator('.svelte-flow__node[aria-label="Motor"]').first());
  await inspector.getByRole('heading', { name: 'Target sensor to Motor' }).waitFor();
  await page.keyboard.press('Control+z');
  await connect('Target sensor');
  await inspector.getByText("leads to 'Bug/Target sensor', to which the module of process 'Bug' writes: its cells get the sum of both").waitFor();
  await page.keyboard.press('Control+z');

  for (const [width, height] of [[1024, 700], [700, 600]]) {
    step(`at ${width} pixels, what is new or double-clicked shows its form at once, and stays in sight beside it`);
    const inSight = (what) =>
      until(page, `${what} beside its form`, () => {
        const form = document.querySelector('aside.right'), seen = [...document.querySelectorAll('.svelte-flow__node.selected, g[data-connection].chosen')].map((e) => e.getBoundingClientRect());
        return form && seen.length > 0 && seen.every((r) => r.left >= 0 && r.right <= form.getBoundingClientRect().left);
      });
    const close = async () => {
      await page.getByRole('button', { name: 'Close the inspector' }).click();
      await until(page, 'the width of the window for the diagram', () => [...document.querySelectorAll('[aria-label="Canvas"]')].some((e) => e.getBoundingClientRect().right > innerWidth - 20));
    };
    await page.setViewportSize({ width, height });
    await page.getByRole('tab', { name: 'Diagram' }).click();
    await connect();
    await field('Cells').waitFor();
    await inSight('the new connection');
    await until(page, 'the chooser at the top of the form', () => document.querySelector('[data-field="cells"]').getBoundingClientRect().top < document.querySelector('aside.right .scroll').getBoundingClientRect().top + 60);
    await inspector.getByText('Cell 1: left 172°, 16: left 6°, 17: right 6°, 32: right 172°').waitFor();
    await close();
    // The diagram takes the room of the inspector.
    let [x, y, rests] = [0, 0, 0];
    await eventually('the line at rest', async () => {
      const [nextX, nextY] = await diagram.locator('g[data-connection] .thin').evaluate((path) => {
        const { x, y } = path.getPointAtLength(path.getTotalLength() / 2).matrixTransform(path.getScreenCTM());
        return [x, y];
      });
      rests = nextX === x && nextY === y ? rests + 1 : 0;
      [x, y] = [nextX, nextY];
      return rests > 20;
    });
    await page.mouse.dblclick(x, y);
    await until(page, 'the chooser of cells with the focus, and no text that is selected', () => document.activeElement.matches('[data-field="cells"] select') && String(getSelection()) === '');
    await inSight('the connection');
    await close();
    await page.getByRole('button', { name: 'Undo', exact: true }).click();
    await page.getByRole('toolbar', { name: 'Editing' }).getByRole('button', { name: 'Group' }).press('Enter');
    await field('Neuron').waitFor();
    await inSight('the new group');
    await until(page, 'its name is still written in its box', () => document.activeElement.matches('.svelte-flow__node input'));
    await page.keyboard.press('Escape');
    await close();
    await page.getByRole('button', { name: 'Undo', exact: true }).click();
  }
  await page.setViewportSize({ width: 1400, height: 900 });
  await box(exact('Motor')).press('Delete');
  await page.getByRole('button', { name: '1 problem' }).click();
  await page.getByRole('group', { name: 'Problems' }).getByRole('button', { name: 'Create group 9 × 9' }).waitFor();
  await begun('The system has a mistake, so its last version without one runs: Motor of the module of Bug has no group.', 'Create group 9 × 9');
  await problems.waitFor({ state: 'detached' });
  assert.deepEqual(faults, []);
}
