// The tutorial in Chromium against the real program.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { accessible, answeredTo, eventually, find, picture, sent, until } from './support.mjs';

export default async function({ site, folder, start, open, faults, step }) {
  const page = await open(await start().address);
  await page.getByRole('group', { name: 'Arena' }).waitFor();

  step('the text stands beside the arena, with its pictures');
  await page.getByRole('button', { name: 'Tutorial', exact: true }).click();
  const tutorial = page.getByRole('group', { name: 'Tutorial', exact: true });
  await tutorial.getByRole('heading', { name: 'Tutorial 1: getting started' }).waitFor();
  const image = tutorial.getByAltText('Three starts, six patches of six colours, one target');
  await image.scrollIntoViewIfNeeded();
  await until(page, 'the picture', () => document.querySelector('[aria-label="Tutorial"] img').naturalWidth > 100);
  await image.click();
  const large = page.getByRole('dialog', { name: 'Picture' });
  await until(page, 'a larger picture', () => document.querySelector('dialog[open] img').offsetWidth > 1.5 * document.querySelector('[aria-label="Tutorial"] img').offsetWidth);
  await large.getByRole('button', { name: 'Close' }).click();
  await tutorial.getByRole('button', { name: 'Enlarge' }).or(tutorial.locator('.picture')).first().press('Enter');
  await large.waitFor();
  await page.keyboard.press('Escape');
  await large.waitFor({ state: 'detached' });
  await tutorial.getByRole('button', { name: '3', exact: true }).click();
  await until(page, 'typeset formulas, within the text', () => {
    const all = [...document.querySelectorAll('.formula math')], text = document.querySelector('[aria-label="Tutorial"] .text');
    return all.length === 4 && all.every((m) => m.offsetWidth !== 0 && m.getBoundingClientRect().right <= text.getBoundingClientRect().right) && text.scrollWidth <= text.clientWidth;
  });
  await picture(page, 'formulas');

  step(
    'the first exercise of each part, or every one with FORAGE_WHOLE, is set up: its system is opened, no command is refused, each of its plots gets numbers, the panel in question is the largest, and the diagram shows the process that it is about',
  );
  const refused = page.locator('.notice.error');
  const about = {
    1: ['Bug', 'Selection', 'Bug', 'Bug'],
    2: ['Reactive Layer', 'Selection', 'Selection', 'Reactive Layer', 'Bug'],
    3: Array(9).fill('Adaptive'),
    4: Array(9).fill('Contextual'),
    5: ['Contextual', 'Contextual', 'Contextual', 'Sequential'],
    6: Array(5).fill('Allostasis'),
  };
  /** The panels in question: those that the exercise asks about. */
  const asked = {
    1: ['Arena', 'Diagram', 'Bug/Red - Hue', 'Bug/Light'],
    2: ['Diagram', 'Selection/Motor In', 'Diagram', 'Arena', 'GPS over time'],
    3: ['Trials', 'Adaptive/Weights Display', 'Adaptive/Weights Display', 'discrepancy over time', 'Adaptive/Weights Display', 'Adaptive/prototype', 'Adaptive/Weights Display', 'Trials', 'Trials'],
    4: ['Contextual/Empty', 'Contextual/Empty', 'Contextual/Selected', 'Contextual/Selected', 'Contextual/Empty', 'Contextual/Empty', 'Contextual/Selected', 'Contextual/Empty', 'Contextual/Selected'],
    5: ['Trials', 'Trials', 'Trials', 'Trials'],
    6: ['Balance over time', 'Needs over time', 'Needs over time', 'Needs: security over time', 'Needs over time'],
  };
  /** The titles of the panels that have the largest place, but for the tutorial. */
  const largest = () =>
    page.evaluate(() => {
      const groups = [...document.querySelectorAll('.dv-groupview')].filter((g) => !g.querySelector('[aria-label="Tutorial"]'));
      const area = (g) => g.offsetWidth * g.offsetHeight, most = Math.max(...groups.map(area));
      return groups.filter((g) => area(g) === most).map((g) => g.querySelector('.dv-active-tab')?.textContent.trim());
    });
  for (const [part, processes] of Object.entries(about)) {
    await tutorial.getByRole('button', { name: part, exact: true }).click();
    await tutorial.locator('[data-set]:enabled').first().waitFor({ state: 'detached' }); // they act once their exercise is set up
    const count = await tutorial.locator('[data-open]').count();
    assert.equal(count, processes.length, `set-ups of part ${part}`);
    for (let i = 0; i < (process.env.FORAGE_WHOLE ? count : 1); i++) {
      const button = tutorial.locator(`[data-open="${i}"]`);
      await button.press('Enter');
      await tutorial.locator(`.setup.active [data-open="${i}"]`).waitFor();
      for (const choice of await tutorial.locator(`[data-setup="${i}"] .choices button:first-of-type`).all()) await choice.click();
      await until(page, `${part}, set-up ${i + 1}: its plots`, () => {
        const plots = [...document.querySelectorAll('[aria-label^="Space plot of"] canvas.heat')];
        return plots.every((c) => c.width > 0 && c.getContext('2d').getImageData(0, 0, 1, 1).data[3] > 0);
      });
      assert.deepEqual(await largest(), [asked[part][i]], `${part}, set-up ${i + 1}: the largest panel`);
      await picture(page, `${part}-${i + 1}`);
      const checked = tutorial.locator(`[data-setup="${i}"]`);
      if (await checked.locator('[data-check]').count()) {
        await checked.locator('[data-check]').click();
        await checked.getByRole('listitem').first().waitFor();
      }
      await page.locator('.dv-tab', { hasText: 'Diagram' }).click();
      const shown = page.getByRole('group', { name: 'Diagram' }).getByRole('group', { name: 'Processes' }).locator('button.on');
      assert.equal(await shown.textContent(), processes[i], `${part}, set-up ${i + 1}: the diagram`);
      assert.equal(await refused.count(), 0, `${part}, set-up ${i + 1}: ${await refused.allTextContents()}`);
    }
  }
  if (process.env.FORAGE_WHOLE) return assert.deepEqual(faults, []); // what follows does not begin with checked exercises, and is part of every run

  step('traces and cells are called what they stand for, and moments are seconds, with the cycle in brackets');
  await tutorial.locator('[data-open="0"]').click();
  await until(page, 'the names of the traces', () => [...document.querySelectorAll('.key .name')].map((n) => n.textContent).join() === 'efficiency,fairness,stability');
  await page.getByRole('button', { name: 'Step one cycle' }).click();
  await page.getByText('0.04 s (cycle 1)').waitFor();
  await page.getByTitle('0.04 s (cycle 1). In a cycle each cell is updated once; it lasts 0.04 s in the world.').waitFor();
  await page.getByRole('application', { name: 'Cells of Allostasis/Needs' }).focus();
  for (let i = 0; i < 2; i++) await page.keyboard.press('ArrowRight'); // the first press shows the first cell
  await page.getByRole('group', { name: 'Space plot of Allostasis/Needs' }).getByText('hydration (2, 1)').waitFor();
  await page.getByLabel('Seconds of the world').fill('4');
  await page.getByLabel('Seconds of the world').press('Enter');
  await page.getByText('4.04 s (cycle 101)').waitFor();
  await until(page, 'the mean of each trace, of what the plot shows', () => {
    const means = [...document.querySelectorAll('.key .mean')].map((m) => m.textContent);
    return means.length === 3 && means.every((m) => /^mean 0\.\d+$/.test(m));
  });

  step('an exercise says in words whether what was seen is right, when it is asked');
  await tutorial.getByRole('button', { name: '2', exact: true }).click();
  const reflex = tutorial.locator('[data-setup="1"]');
  assert.ok(await reflex.getByRole('button', { name: 'Check what I have seen' }).isDisabled());
  await reflex.getByRole('button', { name: 'Set it up' }).click();
  await reflex.and(tutorial.locator('.active')).waitFor();
  assert.deepEqual(await reflex.getByRole('listitem').allTextContents(), ['Run 30 trials, then check.']); // what is expected is not seen before
  await reflex.getByRole('button', { name: 'Check what I have seen' }).click();
  await reflex.getByText('0 of 30 trials have finished. Run the rest, then check again.').waitFor();
  await reflex.getByText('Not answered yet: the robot explores until').waitFor();
  await reflex.getByLabel('From all three starts.').check();
  await reflex.getByRole('button', { name: 'Check what I have seen' }).click();
  await reflex.getByText('You said “From all three starts”. It is judged after the other lines of this list.').waitFor();
  await page.getByRole('button', { name: 'Max', exact: true }).click();
  await page.getByRole('group', { name: 'Trials' }).getByRole('button', { name: 'Run for' }).click();
  await page.getByText('14 of 30 reached the target').waitFor();
  await page.getByRole('button', { name: 'Run', exact: true }).first().waitFor();
  const check = reflex.getByRole('button', { name: 'Check what I have seen' });
  await check.evaluate((button) => button.scrollIntoView({ block: 'end' }));
  await check.click();
  const answer = reflex.getByText('You have seen 14 hits in 30 trials (47 %): right, the solution has 47 %, and most seeds have 29 % to 65 %.');
  await answer.waitFor();
  await reflex.getByText('You said “From all three starts”, and it is not so. Look again: the boxes of Trials, by start.').waitFor();
  await reflex.getByLabel('Mostly from the middle.').check();
  await reflex.getByText('and it is not so').waitFor({ state: 'detached' }); // of the answer before
  await check.click();
  await reflex.getByText('You said “Mostly from the middle”: right.').waitFor();
  const line = await answer.boundingBox(), around = await tutorial.boundingBox();
  assert.ok(line.y + line.height < around.y + around.height + 1, 'the answer is in sight');
  await picture(page, 'tutorial-checked');

  step('an answer is compared with the trials of the run; a wrong one learns where to look');
  await tutorial.getByRole('button', { name: '3', exact: true }).click();
  const rates = tutorial.locator('[data-setup="0"]'), number = rates.getByLabel('Your number');
  await rates.getByRole('button', { name: 'Set it up' }).click();
  await rates.getByRole('button', { name: 'Adaptive.eta = 0.02' }).and(page.locator('[aria-pressed="true"]')).waitFor();
  await page.getByRole('button', { name: 'Max', exact: true }).click();
  await page.getByRole('group', { name: 'Trials' }).getByRole('button', { name: 'Run for' }).click();
  await page.getByText('10 of 12 reached the target').waitFor();
  for (const [said, found] of [['3', 'you said 3, and it is not so. Look again: Trials, where a filled box is a hit.'], ['10', 'you said 10, it was 10 hits in 12 trials: right.']]) {
    await number.fill(said);
    await rates.getByRole('button', { name: 'Check what I have seen' }).click();
    await rates.getByText(`eta = 0.02: ${found}`).waitFor();
  }

  step('answers and ticks are kept while other exercises are set up, and in another visit, until they are cleared; the list of exercises shows what is done');
  const listed = tutorial.getByRole('list', { name: 'Exercises' }).getByRole('listitem'), lines = () => rates.locator('.checks li').allTextContents();
  for (const eta of ['0.005', '0']) {
    await page.getByRole('button', { name: 'Stop', exact: true }).click();
    await page.getByText('No trial has finished yet.').waitFor();
    await rates.getByRole('button', { name: `Adaptive.eta = ${eta}`, exact: true }).click();
    await rates.getByRole('button', { name: `Adaptive.eta = ${eta}`, exact: true }).and(page.locator('[aria-pressed="true"]')).waitFor();
    await page.getByRole('group', { name: 'Trials' }).getByRole('button', { name: 'Run for' }).click();
    await page.getByText('of 12 reached the target').waitFor();
    await rates.getByRole('button', { name: 'Check what I have seen' }).click();
    await rates.locator('li.right', { hasText: `eta = ${eta}:` }).waitFor();
  }
  await listed.and(tutorial.locator('.done')).filter({ hasText: 'Exercise 1' }).waitFor();
  const found = await lines();
  await tutorial.locator('[data-open="3"]').click();
  await tutorial.locator('.setup.active [data-open="3"]').waitFor();
  assert.deepEqual(await tutorial.locator('[data-setup="3"] .checks li').allTextContents(), ['eta = 0.1: run until the discrepancy is below 0.1.', 'eta = 0.01: run until the discrepancy is below 0.1.']);
  assert.deepEqual([await lines(), await number.inputValue()], [found, '10']);
  await page.reload();
  await number.waitFor();
  assert.deepEqual([await lines(), await number.inputValue()], [found, '10']);
  await rates.getByRole('button', { name: 'Clear answers and ticks' }).click();
  await rates.getByRole('listitem').first().waitFor({ state: 'detached' });
  assert.equal(await number.inputValue(), '');
  assert.equal(await listed.and(tutorial.locator('.done')).count(), 0);

  step('a plot of weights has the numbers of its rows and columns, and the names of colours and actions');
  await tutorial.locator('[data-open="1"]').click();
  await tutorial.locator('.setup.active [data-open="1"]').waitFor();
  const weights = page.getByRole('group', { name: 'Space plot of Adaptive/Weights Display' });
  await weights.getByRole('application').focus();
  await page.keyboard.press('ArrowRight');
  await weights.getByText('red, ahead 25 %, left 100 % (1, 1)').waitFor();
  const axes = await weights.locator('.names span').evaluateAll((all) => all.map((l) => l.innerText.replace('\n', ' ')));
  for (const name of ['14', '22', 'red', 'cyan', 'magenta', 'ahead 25 %, left 100 %', 'ahead 25 %, right 100 %']) assert.ok(axes.includes(name), `${name} in ${axes}`);
  await picture(page, 'weights');
  await page.getByLabel('Seed of the run').fill('7');
  await page.getByLabel('Seed of the run').press('Enter');
  await tutorial.getByRole('button', { name: '2', exact: true }).click();
  await tutorial.locator('.setup').first().getByRole('button', { name: 'Set it up' }).click();
  await tutorial.locator('.setup.active').waitFor();
  await tutorial.getByRole('button', { name: '3', exact: true }).click();
  await rates.getByRole('button', { name: 'Set it up' }).click(); // with the seed of the text, not the one that the system had last
  await rates.and(tutorial.locator('.active')).waitFor();
  await page.getByRole('button', { name: 'Max', exact: true }).click();
  await page.getByRole('group', { name: 'Trials' }).getByRole('button', { name: 'Run for' }).click();
  await page.getByText('10 of 12 reached the target').waitFor();

  step('the trials of the run before stay in sight, and the last ones are counted');
  await page.getByRole('button', { name: 'Stop', exact: true }).click();
  const before = page.getByText('Before: 10 of 12'), changed = before.filter({ hasText: /changed since: .*eta = 0.005/ });
  await before.waitFor();
  await rates.getByRole('button', { name: 'Adaptive.eta = 0.005' }).click();
  await changed.waitFor();
  await page.getByRole('button', { name: 'Undo' }).click();
  await changed.waitFor({ state: 'detached' }); // what was undone is not changed
  await page.getByLabel('Number of trials').fill('60');
  await page.getByLabel('Number of trials').press('Enter');
  await page.getByText('of 60 reached the target').waitFor();
  await page.getByText(/Of the last/).getByText(/of 50 reached the target/).waitFor();
  await page.getByLabel('Last trials').fill('12');
  await page.getByLabel('Last trials').press('Enter');
  await page.getByText(/of 12 reached the target/).waitFor();
  assert.equal(await page.getByRole('img', { name: /^The run before: hit, miss, / }).count(), 1);
  await picture(page, 'trials-before');

  step('in narrow windows all that it names is seen: the trials, and plots that can be read');
  await tutorial.getByRole('button', { name: '5', exact: true }).click();
  for (const [width, height] of [[1024, 700], [700, 600]]) {
    await page.setViewportSize({ width, height });
    await tutorial.locator('[data-open="0"]').click();
    await tutorial.locator('.setup.active [data-open="0"]').waitFor();
    for (const tab of ['Contextual/Proposal raster', 'Entropy over time', 'Trials', 'Diagram', 'Arena']) {
      await page.locator('.dv-tab', { hasText: tab }).click();
      if (width > 720) assert.deepEqual(await largest(), ['Trials'], `the largest panel at ${width}`);
      await until(page, `${tab} at ${width} x ${height}`, (t) => [...document.querySelectorAll('.dv-groupview')].some((g) => g.querySelector('.dv-active-tab')?.textContent.includes(t) && g.offsetHeight > 200 && g.offsetWidth > 250), tab);
    }
    await until(page, 'the trials', () => [...document.querySelectorAll('.readings > div')].some((d) => d.textContent.startsWith('trials') && d.getBoundingClientRect().bottom <= d.parentElement.getBoundingClientRect().bottom));
    const strip = await page.evaluate(() => [...document.querySelectorAll('footer > *')].filter((e) => e.offsetWidth).map((e) => e.getBoundingClientRect().right));
    assert.ok(Math.max(...strip) <= width, `the status strip at ${width}`);
    await picture(page, `tutorial-${width}`);
  }
  const seen = (titles) =>
    until(page, `${titles} in sight`, (all) => {
      document.querySelector('[aria-label="Forget the session that was not closed"]')?.click(); // in a tab, the message takes the room of a plot
      const shown = [...document.querySelectorAll('.dv-groupview')].filter((g) => g.offsetParent && g.offsetHeight > 200 && g.offsetWidth > 250).map((g) => g.querySelector('.dv-active-tab').textContent.trim());
      return all.every((title) => shown.includes(title));
    }, titles);
  await page.setViewportSize({ width: 1024, height: 700 });
  for (const [part, number, titles] of [['2', 2, ['Diagram', 'Arena', 'Trials']], ['3', 3, ['discrepancy over time', 'Arena', 'Trials']], ['4', 0, ['Contextual/Empty', 'Arena', 'Trials', 'Contextual/Selected', 'Discrepancy over time']]]) {
    await tutorial.getByRole('button', { name: part, exact: true }).click();
    await tutorial.locator(`[data-open="${number}"]`).click();
    await tutorial.locator(`.setup.active [data-open="${number}"]`).waitFor();
    await seen(titles);
  }

  step('a window of another size has the exercise that is set up in sight, and its trials');
  await page.evaluate(() => Object.keys(localStorage).filter((k) => k.startsWith('layout ')).forEach((k) => localStorage.removeItem(k))); // no earlier arrangement comes back
  await page.setViewportSize({ width: 1400, height: 900 });
  await tutorial.locator('[data-open="0"]').click();
  await until(page, 'the panels of the exercise', () => document.querySelectorAll('.dv-groupview').length === 6);
  const exercise = tutorial.locator('.setup.active');
  await exercise.evaluate((e) => (e.parentElement.scrollTop += e.getBoundingClientRect().top - e.parentElement.getBoundingClientRect().top - 0.4 * e.parentElement.clientHeight));
  for (const [width, height] of [[1024, 700], [700, 600], [1024, 700], [1400, 900]]) {
    await page.setViewportSize({ width, height });
    if (width > 720) await seen(['Contextual/Empty', 'Arena', 'Trials']);
    await eventually(`the exercise in sight at ${width}`, () =>
      exercise.evaluate((e) => {
        const top = e.getBoundingClientRect().top - e.parentElement.getBoundingClientRect().top;
        return top > -2 && top < 0.5 * e.parentElement.clientHeight;
      }));
  }

  await tutorial.getByRole('button', { name: '5', exact: true }).click();
  await tutorial.locator('[data-open="0"]').click();
  await until(page, 'as many trials as the exercise asks for', () => document.querySelector('input[aria-label="Number of trials"]')?.value === '100');
  await picture(page, 'tutorial-trials');

  step('a system of the tutorial is saved under another name, in the folder of the user');
  await page.keyboard.press('Control+s');
  const dialog = page.getByRole('dialog');
  await dialog.waitFor();
  if (!site) await until(page, 'the folder in which the studio was started', (name) => document.querySelector('.folder')?.textContent.includes(name), folder.split('/').pop());
  await dialog.getByLabel('Name').fill('mine.iqr');
  await dialog.getByLabel('Name').press('Enter');
  await page.getByText('Saved as mine.iqr.').waitFor();
  assert.ok(site || existsSync(join(folder, 'mine.iqr')));

  step('the answer of 1.1 is seen: cell (5, 1) is held, and the robot has left its start');
  await tutorial.getByRole('button', { name: '1', exact: true }).click();
  await tutorial.locator('[data-open="0"]').click();
  await page.getByText('Bug/Motor driven by hand').waitFor();
  assert.equal(await refused.count(), 0, 'plots of the larger system are closed');
  const drive = page.getByRole('group', { name: 'Drive Bug/Motor' });
  await drive.getByRole('application').focus();
  for (const key of ['Home', 'ArrowRight', 'ArrowRight', 'ArrowRight', 'ArrowRight']) await page.keyboard.press(key);
  await drive.getByText('Cell (5, 1): 1').waitFor();
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await until(page, 'the held cell', () => {
    const c = document.querySelector('[aria-label="Space plot of Bug/Motor"] canvas.heat');
    return c?.width === 9 && c.getContext('2d').getImageData(4, 0, 1, 1).data[0] > 200;
  });
  await page.getByRole('button', { name: 'Pause', exact: true }).click();

  step('what was seen stays, while something else is seen');
  const hand = tutorial.locator('[data-setup="0"]');
  await hand.getByLabel('It turns to the right on the spot.').check();
  const driven = async (keys, found) => {
    await drive.getByRole('button', { name: 'Clear' }).click();
    await drive.getByRole('application').focus();
    for (const key of [...keys, 'Space']) await page.keyboard.press(key);
    await drive.getByRole('button', { name: 'Send again' }).click();
    await page.getByRole('button', { name: 'Step one cycle' }).click();
    await page.getByRole('button', { name: 'Step one cycle' }).click();
    await hand.locator('li.right', { hasText: found }).waitFor();
  };
  await hand.locator('li.open', { hasText: 'Make it drive backwards: this has not been so yet.' }).waitFor();
  await driven(['Home'], 'Make the robot turn to its left.');
  await driven(['End'], 'Make it drive backwards.');
  await hand.getByRole('button', { name: 'Check what I have seen' }).click();
  await hand.getByText('You said “It turns to the right on the spot”. It is judged after the other lines of this list.').waitFor();
  await driven(['End', ...Array(4).fill('ArrowUp')], 'Drive it by the cell (9, 5) alone.');
  // What was seen is over when it is asked.
  await drive.getByRole('button', { name: 'Clear' }).click();
  await drive.getByRole('button', { name: 'Send again' }).click();
  for (let i = 0; i < 2; i++) await page.getByRole('button', { name: 'Step one cycle' }).click();
  await hand.getByRole('button', { name: 'Check what I have seen' }).click();
  await hand.getByText('You said “It turns to the right on the spot”: right.').waitFor();
  assert.deepEqual(await hand.locator('.checks li').evaluateAll((all) => all.map((l) => l.className)), Array(4).fill('right'));

  step('in a small window, what is driven stands beside the arena; names are whole, and the form of what is selected leaves the text in sight');
  await page.setViewportSize({ width: 700, height: 600 });
  await tutorial.locator('[data-open="0"]').click();
  await drive.waitFor();
  assert.ok(await page.getByRole('group', { name: 'Arena', exact: true }).isVisible());
  await tutorial.locator('[data-open="1"]').click();
  const box = page.locator('.svelte-flow__node', { hasText: 'Const Speed' });
  await box.waitFor();
  assert.deepEqual((await page.locator('.svelte-flow__node[aria-label]:not(:has(.phantom))').allInnerTexts()).filter((t) => t.includes('…')), []);
  await box.click();
  await page.getByRole('region', { name: 'Inspector' }).waitFor();
  await until(page, 'the form ends where the tutorial begins', () => {
    const form = document.querySelector('aside.right').getBoundingClientRect(), text = document.querySelector('[role="group"][aria-label="Tutorial"]').getBoundingClientRect();
    return form.bottom < text.top && form.height > 200;
  });
  await picture(page, 'tutorial-small');
  await page.keyboard.press('Escape');
  await page.setViewportSize({ width: 1400, height: 900 });
  await tutorial.locator('[data-open="0"]').click();
  await drive.waitFor();

  step('a choice of the tutorial is a parameter of the run that need not be saved; changes of the user are not dropped without asking');
  const change = async () => {
    await tutorial.locator('[data-open="0"]').click();
    await tutorial.locator('.setup.active [data-open="0"]').waitFor();
    await tutorial.getByRole('button', { name: 'Adaptive.eta = 0.005' }).first().click();
    await page.getByTitle(/^Undo: Adaptive.eta = 0.005/).waitFor();
    const inForce = tutorial.locator('.setup.active').getByRole('button', { name: 'Adaptive.eta = 0.005' }).and(page.locator('[aria-pressed="true"]'));
    await inForce.waitFor();
    await until(page, 'no change to be saved', () => !document.title.startsWith('●'));
    await page.getByRole('button', { name: 'Undo' }).click();
    await inForce.waitFor({ state: 'detached' });
    await page.getByRole('button', { name: 'Redo' }).click();
    await until(page, 'a change of the user', () => document.title.startsWith('●'));
  };
  await tutorial.getByRole('button', { name: '3', exact: true }).click();
  await change();
  await tutorial.locator('[data-open="1"]').click();
  const drop = tutorial.getByRole('button', { name: 'Drop the changes, and set it up' });
  await drop.waitFor();
  await tutorial.getByRole('button', { name: 'Cancel' }).click();
  assert.equal(await drop.count(), 0);
  await tutorial.locator('[data-open="1"]').click();
  await tutorial.getByRole('button', { name: 'Save first' }).click();
  await page.getByRole('dialog', { name: 'Save as' }).getByLabel('Name').fill('changed.iqr');
  await page.keyboard.press('Enter');
  await page.getByText('Saved as changed.iqr.').waitFor();
  // What was asked for continues when the dialog is closed.
  await tutorial.locator('.setup.active [data-open="1"]').waitFor();
  await tutorial.locator('.setup:not(.active) [aria-pressed]').first().waitFor({ state: 'detached' }); // its values were about another system
  assert.equal(await drop.count(), 0, 'what is saved is not lost');
  await change();
  await tutorial.locator('[data-open="1"]').click();
  await drop.click();
  await tutorial.locator('.setup.active [data-open="1"]').waitFor();

  step('what the user changes while a choice acts is not taken for a part of it');
  await tutorial.locator('[data-open="0"]').click();
  await tutorial.locator('.setup.active [data-open="0"]').waitFor();
  await page.evaluate((send) => {
    const socket = window.socket;
    socket[send] = (data) => {
      if (typeof data === 'string' && JSON.parse(data).command === 'stop') {
        delete socket[send];
        for (const command of ['undo', 'redo']) socket[send](JSON.stringify({ id: 1e9, command }));
        socket[send](data);
      } else Object.getPrototypeOf(socket)[send].call(socket, data);
    };
  }, site ? 'postMessage' : 'send');
  const stops = await sent(page, 'stop');
  await tutorial.getByRole('button', { name: 'Adaptive.eta = 0.005' }).first().click();
  await answeredTo(page, 'stop', stops);
  await tutorial.locator('[data-open="1"]').click();
  await drop.click();
  await tutorial.locator('.setup.active [data-open="1"]').waitFor();

  step('its button closes the tutorial, and opens it again');
  await page.getByRole('button', { name: 'Tutorial', exact: true }).click();
  await tutorial.waitFor({ state: 'detached' });
  for (const drawer of [page.getByRole('navigation'), page.getByRole('region', { name: 'Inspector' })]) await drawer.waitFor(); // what it had taken the place of
  await page.getByRole('button', { name: 'Tutorial', exact: true }).click();
  await tutorial.waitFor();
  await tutorial.locator('.setup.active').waitFor();

  step('in a narrow window with trials, it leaves the arena the room that it needs');
  await page.getByRole('button', { name: 'Tutorial', exact: true }).click();
  await tutorial.waitFor({ state: 'detached' });
  await page.setViewportSize({ width: 1024, height: 700 });
  await find(page, 'layout: overview');
  await find(page, 'learning curve');
  await page.getByRole('button', { name: 'Tutorial', exact: true }).click();
  await tutorial.waitFor();
  await until(page, 'room for the arena', () => {
    const { offsetWidth, offsetHeight } = document.querySelector('[role="group"][aria-label="Arena"]');
    return offsetWidth >= 260 && offsetHeight >= 200;
  });
  const wide = () => JSON.stringify(Object.entries(localStorage).filter(([key]) => /^layout (?!narrow |small )/.test(key)));
  const closed = await page.evaluate(wide); // the tutorial was closed when the window was wide
  await page.setViewportSize({ width: 1400, height: 900 });
  await eventually('the wide arrangement is kept', async () => (await page.evaluate(wide)) !== closed);

  step('links lead to other parts; after reloading the same part is shown');
  await page.reload();
  await tutorial.getByRole('heading', { name: 'Tutorial 3: the adaptive layer' }).waitFor();

  step('an address that names an exercise sets it up, and shows its part');
  const address = new URL(page.url());
  address.searchParams.set('exercise', '2-reactive-layer:1');
  await page.goto(address.href);
  await tutorial.getByRole('heading', { name: 'Tutorial 2: the reactive layer' }).waitFor();
  await page.getByRole('button', { name: /Reactive foraging/ }).first().waitFor();

  step('axe finds no fault of accessibility, light and dark');
  for (const scheme of ['light', 'dark']) {
    await page.emulateMedia({ colorScheme: scheme });
    await until(page, scheme, (s) => document.documentElement.classList.contains('dark') === (s === 'dark'), scheme);
    await accessible(page, scheme);
  }
  assert.deepEqual(faults, []);
}
