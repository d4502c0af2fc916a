// The page against the real program: running, parameters, driving by hand, plots, the way back, and what a hidden page costs.
import assert from 'node:assert/strict';
import { accessible, find, frames, picture, until } from './support.mjs';

export default async function({ site, start, open, faults, step }) {
  const studio = start();
  const page = await open(await studio.address);
  const seek = page.getByLabel('Moment of the run');
  const pixels = (selector) => page.locator(selector).first().evaluate((c) => [...c.getContext('2d').getImageData(0, 0, c.width, c.height).data].reduce((h, v) => (h * 31 + v) | 0, 7));

  step('open: the tree, the arena and the plots are there');
  await page.getByRole('group', { name: 'Arena' }).waitFor();
  await page.getByRole('group', { name: 'Space plot of Bug/Motor' }).waitFor();
  await page.getByRole('navigation').getByText('Head Direction Cells').waitFor();

  step('all buttons of the diagram have room; that there is nothing to undo is reported, and is no error');
  const tools = () =>
    page.getByRole('toolbar', { name: 'Editing' }).evaluate((bar) => {
      const all = [...bar.querySelectorAll('button')].map((b) => [b.ariaLabel ?? b.textContent, b.getBoundingClientRect()]);
      return { cut: all.filter(([, r]) => r.right > bar.getBoundingClientRect().right).map(([name]) => name), places: all.filter(([name]) => /^Select|^Comment|^Connect/.test(name)).map(([name, r]) => [name, r.x]) };
    });
  const ofGroups = await tools();
  assert.deepEqual(ofGroups.cut, []);
  await page.getByRole('group', { name: 'Processes' }).getByRole('button', { name: 'System' }).click();
  await page.getByRole('button', { name: 'Add a part' }).waitFor();
  assert.deepEqual(await tools(), ofGroups, 'the tools stay in place on the page of the system');
  await page.getByRole('group', { name: 'Processes' }).getByRole('button', { name: 'Bug' }).click();
  await page.getByRole('button', { name: 'Add a part' }).waitFor({ state: 'detached' });
  for (const kind of ['excitatory', 'inhibitory', 'modulatory']) await page.getByRole('button', { name: `Connect ${kind}` }).getByText(kind, { exact: true }).waitFor(); // in words
  await page.keyboard.press('Control+z');
  await page.locator('.notice.info').filter({ hasText: 'there is nothing to undo' }).waitFor();
  assert.equal(await page.locator('.notice.error').count(), 0);

  step('run: the cycle grows, plot and arena change');
  const light = '[aria-label="Space plot of Bug/Light"] canvas.heat';
  await page.getByRole('button', { name: '4×' }).click();
  const before = [await pixels(light), await pixels('[role="group"][aria-label="Arena"] canvas')];
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await until(page, 'the run', () => Number(document.querySelector('[aria-label="Moment of the run"]')?.value) > 60);
  assert.notEqual(await pixels('[role="group"][aria-label="Arena"] canvas'), before[1]);
  assert.notEqual(await pixels(light), before[0]);

  step('pause: the cycle stays; space runs and pauses');
  await page.getByRole('button', { name: 'Pause', exact: true }).click();
  await page.getByRole('button', { name: 'Run', exact: true }).waitFor();
  const paused = Number(await seek.inputValue());
  await page.locator('body').press('.'); // one cycle more, if none came meanwhile
  await until(page, 'the next cycle', (c) => document.querySelector('[aria-label="Moment of the run"]').value === String(c), paused + 1);
  await page.locator('body').press(' ');
  await page.getByRole('button', { name: 'Pause', exact: true }).waitFor();
  await page.locator('body').press(' ');
  await page.getByRole('button', { name: 'Run', exact: true }).waitFor();

  step('Ctrl+K finds a group; the inspector shows its parameters; a change has effect; undo takes it back');
  await find(page, 'adaptive/thresh');
  const inspector = page.getByRole('region', { name: 'Inspector' });
  await inspector.getByRole('heading', { name: 'Adaptive/Threshold CR' }).waitFor();
  const threshold = page.locator('[id="Adaptive/Threshold CR.threshold"]');
  const loaded = await threshold.inputValue();
  await threshold.fill('0.77');
  await threshold.press('Enter');
  assert.equal(await inspector.getByText('run.params').count(), 0, 'scripts stand in the log');
  await page.getByRole('button', { name: 'Log', exact: true }).click();
  await page.getByText('run.params["Adaptive/Threshold CR.threshold"] = 0.77').first().waitFor();
  await find(page, 'panel: close');
  await inspector.getByRole('button', { name: /^Reset/ }).waitFor();
  await page.getByRole('button', { name: 'Undo' }).click();
  await until(page, 'undo', ([id, value]) => document.getElementById(id)?.value === value, ['Adaptive/Threshold CR.threshold', loaded]);
  await page.getByRole('button', { name: 'Redo' }).click();
  await until(page, 'redo', (id) => document.getElementById(id)?.value === '0.77', 'Adaptive/Threshold CR.threshold');

  step('Ctrl+K finds panels and actions by other words for them');
  await page.keyboard.press('Control+k');
  const meant = {
    'learning curve': 'Trials and their learning curve',
    hits: 'Trials and their learning curve',
    faster: 'Speed: 20×',
    reset: 'Stop: back to cycle 0',
    'start again': 'Stop: back to cycle 0',
    robot: 'Show the arena',
    graph: 'Plot over time',
    screenshot: 'Export the figure of Arena',
    theme: 'Switch between light and dark',
  };
  for (const [words, name] of Object.entries(meant)) {
    await page.getByRole('combobox', { name: 'Find' }).fill(words);
    await page.getByRole('option', { name }).waitFor();
  }
  await page.keyboard.press('Escape');

  step('drive the motor by hand: the plot shows the clamped cell');
  await page.getByRole('button', { name: 'Stop', exact: true }).click(); // the scale begins again
  await until(page, 'cycle 0', () => document.querySelector('[aria-label="Moment of the run"]')?.value === '0');
  await page.getByRole('navigation').getByText('Motor', { exact: true }).click();
  await inspector.getByRole('button', { name: 'Drive' }).click();
  const drive = page.getByRole('group', { name: 'Drive Bug/Motor' });
  await drive.getByRole('application').focus();
  for (const key of ['Home', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'ArrowDown', 'Space']) await page.keyboard.press(key);
  await drive.getByText('Cell (1, 5): 1').waitFor();
  await drive.getByRole('button', { name: 'Send' }).click();
  await page.getByText('Bug/Motor driven by hand').waitFor();
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await page.getByRole('navigation').getByText('Motor', { exact: true }).dblclick();
  await until(page, 'the clamped cell', () => {
    const c = document.querySelector('[aria-label="Space plot of Bug/Motor"] canvas.heat');
    if (!c || c.width !== 9) return false;
    const d = c.getContext('2d').getImageData(0, 4, 2, 1).data;
    return d[0] > 200 && d[4] < 100; // yellow, then dark blue
  });
  await page.keyboard.press('Control+k');
  await page.keyboard.type('drive');
  await page.keyboard.press('Escape');

  step('time plot: it opens, and grows');
  await inspector.getByRole('button', { name: 'Time' }).click();
  await page.locator('.uplot canvas').first().waitFor();

  step('a hidden page costs the engine nothing: it is sent no frames');
  const hidden = async (yes) =>
    page.evaluate((y) => {
      window.kept ??= window.requestAnimationFrame;
      window.requestAnimationFrame = y ? () => 0 : window.kept;
    }, yes);
  const moment = () => seek.inputValue().then(Number);
  // Not by frames of the page, of which there are none while it is hidden.
  const goesOn = async (cycles) => page.waitForFunction((c) => Number(document.querySelector('[aria-label="Moment of the run"]').value) > c, (await moment()) + cycles, { polling: 50 });
  const earlier = await frames(page);
  await until(page, 'frames', (n) => window.frames_ > n + 5, earlier);
  await hidden(true);
  await goesOn(20); // what is under way
  const already = await frames(page);
  await goesOn(60);
  assert.ok((await frames(page)) - already <= 2, `${(await frames(page)) - already} frames were sent to a page that draws nothing`);
  await hidden(false);
  await picture(page, 'page');

  step('the way back: the slider seeks a cycle, and the run waits there');
  await seek.fill('40'); // which is a change, too
  await until(page, 'cycle 40', () => document.querySelector('[aria-label="Moment of the run"]')?.value === '40');
  await page.getByRole('button', { name: 'Run', exact: true }).waitFor();

  step('a page that is loaded again shows the same run and the same panels');
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await page.reload();
  if (site) await page.getByRole('button', { name: 'Resume it' }).click(); // the session was in this page; it was kept with the driving, or before it
  await page.locator('.uplot canvas').first().waitFor();
  if (!site) {
    await page.getByText('Bug/Motor driven by hand').waitFor();
    await page.getByRole('button', { name: 'Pause', exact: true }).click();
  }

  if (!site) { // a page that is loaded again begins another session there
    step('panels of groups that the system does not have are left out of a kept arrangement');
    await page.evaluate(() => {
      for (const key of Object.keys(localStorage).filter((k) => k.startsWith('layout'))) localStorage[key] = localStorage[key].replaceAll('Bug/Light', 'Bug/Gone');
    });
    await page.reload();
    await page.locator('.uplot canvas').first().waitFor();
    assert.ok(!(await page.locator('.dv-tab').allTextContents()).some((t) => t.includes('Bug/Gone')));
  }

  step('stop: back to cycle 0');
  await page.getByRole('button', { name: 'Stop', exact: true }).click();
  await until(page, 'cycle 0', () => document.querySelector('[aria-label="Moment of the run"]')?.value === '0');

  step('axe finds no fault of accessibility');
  await accessible(page);

  step('a number of trials runs, and then it pauses; hits and misses stand by their starts');
  const end = page.getByRole('button', { name: 'End', exact: true }); // of the driving
  if (!site || await end.count()) await end.click();
  await page.getByRole('button', { name: 'Max', exact: true }).click();
  await page.getByRole('button', { name: 'Trials…' }).click();
  const trials = page.getByRole('group', { name: 'Trials' });
  await trials.getByLabel('Number of trials').fill('3');
  await trials.getByRole('button', { name: 'Run for' }).click();
  await trials.getByText(/^\d of 3 reached the target: \d+\s% \(95\s% interval/).waitFor();
  await page.getByRole('group', { name: 'Run' }).getByRole('button', { name: 'Run', exact: true }).waitFor(); // it is paused
  assert.equal(await trials.locator('dd i').count(), 3);
  await picture(page, 'trials');
  await trials.getByRole('button', { name: 'Figure…' }).click();
  const figure = page.getByRole('dialog', { name: 'Export figure' });
  await figure.getByRole('img', { name: 'The figure learning' }).waitFor();
  await figure.getByRole('button', { name: 'Cancel' }).click();

  step('it runs until a condition, and pauses; a mistake in it is said, and a world without trials takes it, too');
  const condition = trials.getByLabel('or when');
  await trials.getByLabel('Number of trials').fill('1000');
  await condition.fill('trail 5');
  await trials.getByRole('button', { name: 'Run for' }).click();
  const wrong = trials.getByRole('alert').filter({ hasText: 'trail' });
  await wrong.waitFor();
  assert.equal(await condition.getAttribute('aria-invalid'), 'true');
  await condition.fill('trial 5');
  await trials.getByRole('button', { name: 'Run for' }).click();
  await wrong.waitFor({ state: 'detached' });
  await trials.getByText(/^\d of 4 reached the target/).waitFor();
  await page.getByRole('group', { name: 'Run' }).getByRole('button', { name: 'Run', exact: true }).waitFor();
  await find(page, 'Log');
  await page.getByText("--trials 1003 --until 'trial 5'").first().waitFor();

  step('an example is chosen by its sentence, and opens in its world');
  await find(page, 'Open an example');
  const examples = page.getByRole('dialog', { name: 'Open an example' });
  await examples.getByRole('button', { name: /^Braitenberg vehicle.*drives to the light\..*in basic arena/ }).waitFor();
  await accessible(page, 'the examples');
  await picture(page, 'examples');
  await examples.getByRole('button', { name: /^Reactive foraging/ }).click();
  await page.getByRole('dialog', { name: 'Changes' }).getByRole('button', { name: 'Discard them' }).click();
  await until(page, 'the example', () => document.title.includes('Reactive foraging') && document.title.includes('basic_arena'));
  await find(page, 'Show the arena');
  for (const name of ['Open the tutorial', 'New…', 'Open an example…']) await page.getByRole('group', { name: 'Arena' }).getByRole('button', { name }).waitFor();
  await page.getByRole('group', { name: 'Arena' }).getByRole('button', { name: 'Open an example…' }).click();
  await examples.getByRole('button', { name: 'Close' }).click();

  step('what was changed is saved under a name before another system is opened or begun');
  const change = async (task) => {
    await find(page, 'layer/approach');
    const field = page.locator('[id="Reactive Layer/Approach.threshold"]');
    await until(page, 'the value of the file', (id) => document.getElementById(id)?.value === '0.7', 'Reactive Layer/Approach.threshold');
    await field.fill('0.6');
    await field.press('Enter');
    await page.getByTitle(/^Undo: Reactive Layer\/Approach.threshold = 0.6/).waitFor();
    await task();
    await page.getByRole('dialog', { name: 'Changes' }).getByRole('button', { name: 'Save' }).click();
  };
  const saveAs = async (name) => {
    await until(page, 'the name has the keys', () => document.activeElement?.matches('dialog[aria-label="Save as"] input'));
    await page.getByRole('dialog', { name: 'Save as' }).getByLabel('Name').fill(name);
    await page.keyboard.press('Enter');
    await page.getByText(`Saved as ${name}.`).waitFor();
  };
  const another = async () => {
    await find(page, 'Open an example');
    await examples.getByRole('button', { name: /^Reactive foraging/ }).click();
  };
  await change(another);
  await saveAs('left.iqr');
  await page.getByTitle('Nothing to undo').waitFor();
  await until(page, 'the example', () => document.title.includes('reactive_foraging.iqr'));
  await change(async () => {
    await find(page, 'New system');
    const begun = page.getByRole('dialog', { name: 'New system' });
    await begun.getByLabel('Name').fill('Begun');
    await begun.getByRole('button', { name: 'Create' }).click();
  });
  await saveAs('left_again.iqr');
  await until(page, 'the new system', () => document.title.includes('Begun'));

  assert.deepEqual(faults, []);
  if (site) return;

  step('the server ends: the page says so');
  studio.child.removeAllListeners('exit');
  studio.child.kill('SIGINT');
  await page.getByText('connection lost').waitFor();
}
