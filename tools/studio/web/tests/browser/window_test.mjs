// The window follows its width, in Chromium against the real program.
import assert from 'node:assert/strict';
import { isDeepStrictEqual } from 'node:util';
import { answered, eventually, find, sent, until } from './support.mjs';

const large = { width: 1600, height: 1000 }, small = { width: 420, height: 800 };

export default async function({ site, start, open, faults, step }) {
  const address = await start().address;
  /** The places of the stacks of panels, with the tabs of each. */
  const stacks = (page) =>
    page.evaluate(() =>
      [...document.querySelectorAll('.dv-groupview')].filter((g) => g.offsetParent).map((g) => {
        const { x, y, width, height } = g.getBoundingClientRect();
        return [[...g.querySelectorAll('.dv-tab')].map((t) => t.textContent.trim()).sort().join(', '), ...[x, y, width, height].map(Math.round)].join(' | ');
      }).sort()
    );
  const count = (page, n) => until(page, `${n} stacks of panels`, (k) => [...document.querySelectorAll('.dv-groupview')].filter((g) => g.offsetParent).length === k, n);
  const tree = (page) => page.getByRole('navigation');
  const inspector = (page) => page.getByRole('region', { name: 'Inspector' });

  const page = await open(address, large);
  await page.getByRole('group', { name: 'Space plot of Bug/Motor' }).waitFor();

  step('the title says which system, file, world and session this is');
  await until(page, 'the title', (port) => document.title === `DAC foraging (systems/dac_foraging.iqr) in basic_arena – Forage ${port}`, new URL(address).port);

  step('narrowed, the columns become one stack with the same panels, and the drawers close');
  await tree(page).waitFor();
  await count(page, 4);
  const before = await stacks(page);
  await page.setViewportSize({ width: 1024, height: 700 });
  await count(page, 2);
  await until(page, 'the diagram below the arena', () => ['Arena', 'Diagram'].every((title) => [...document.querySelectorAll('.dv-active-tab')].some((t) => t.textContent.includes(title))));
  await page.setViewportSize({ width: 1400, height: 900 });
  await count(page, 4);
  await page.getByRole('group', { name: 'Arena' }).evaluate((e) => (e.dataset.same = 'yes'));
  await page.setViewportSize(small);
  await count(page, 1);
  await eventually('it has all panels, and the whole width', async () => /^Arena, Bug\/Light, Bug\/Motor, Diagram \| 0 \| \d+ \| 420 /.test((await stacks(page))[0]));
  assert.deepEqual([await tree(page).count(), await inspector(page).count()], [0, 0]);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth && document.querySelector('header').scrollWidth <= innerWidth));
  await page.getByRole('group', { name: 'Arena' }).waitFor();

  step('what is opened there is a tab of the stack, and the drawer does not hide it');
  await page.getByRole('button', { name: 'Show or hide the tree' }).click();
  await tree(page).getByText('CS', { exact: true }).first().click();
  await inspector(page).getByRole('button', { name: 'Space' }).click();
  await page.getByRole('group', { name: 'Space plot of Adaptive/CS' }).waitFor();
  await count(page, 1);
  await inspector(page).waitFor({ state: 'detached' });
  for (const close of [() => page.keyboard.press('Escape'), () => page.mouse.click(410, 400)]) {
    await page.getByRole('button', { name: 'Show or hide the tree' }).click();
    await tree(page).waitFor();
    await close();
    await tree(page).waitFor({ state: 'detached' });
  }
  await page.locator('.dv-tab', { hasText: 'Bug/Light' }).click();
  await page.locator('.dv-tab', { hasText: 'Bug/Light' }).locator('.dv-default-tab-action').click();

  step('widened, the columns are back, with the panel that was opened and without the one that was closed');
  await page.setViewportSize(large);
  await tree(page).waitFor();
  await inspector(page).waitFor();
  await page.getByRole('group', { name: 'Space plot of Adaptive/CS' }).waitFor();
  await page.getByRole('group', { name: 'Arena' }).waitFor();
  assert.equal(await page.getByRole('group', { name: 'Arena' }).getAttribute('data-same'), 'yes', 'panels are moved, not made again');
  const after = await stacks(page);
  const columns = (all) => all.filter((s) => /^(Arena|Diagram) /.test(s));
  const asBefore = () => eventually('the columns are as before', async () => isDeepStrictEqual(columns(await stacks(page)), columns(before)));
  await asBefore();
  assert.ok(!after.join().includes('Bug/Light') && after.join().includes('Adaptive/CS'), after.join('\n'));

  step('the panels of a small window stand in columns when it is widened, with and without earlier columns');
  await page.setViewportSize(small);
  await page.reload();
  await count(page, 1);
  await page.setViewportSize(large);
  await until(page, 'columns', (n) => [...document.querySelectorAll('.dv-groupview')].filter((g) => g.offsetParent).length >= n, 3);
  await asBefore();
  await page.evaluate(() => localStorage.clear());
  await page.setViewportSize(small);
  await count(page, 1);
  await page.evaluate(() => Object.keys(localStorage).filter((k) => !k.includes('small')).forEach((k) => localStorage.removeItem(k)));
  await page.reload();
  await count(page, 1);
  await page.setViewportSize(large);
  await until(page, 'columns', (n) => [...document.querySelectorAll('.dv-groupview')].filter((g) => g.offsetParent).length >= n, 3);

  step('menus: Home and End, and Escape leads back to the button');
  const focus = (what) => until(page, what, (w) => document.activeElement.textContent.startsWith(w) || document.activeElement.ariaLabel === w, what);
  await page.getByRole('button', { name: /^DAC foraging/ }).press('Enter');
  await focus('New…');
  await page.keyboard.press('End');
  await focus(site ? 'About Forage' : 'Quit…');
  await page.keyboard.press('Home');
  await focus('New…');
  await page.keyboard.press('Escape');
  await focus('DAC foraging');
  await page.getByRole('button', { name: 'Layouts of the panels' }).press('Enter');
  await page.getByRole('button', { name: /^Overview/ }).focus();
  await page.keyboard.press('Escape');
  await focus('Layouts of the panels');

  step('the tree is one stop of the Tab key, and arrows lead through it');
  const row = (name) => until(page, `the row ${name}`, (n) => document.activeElement.matches('nav .row') && document.activeElement.textContent.includes(n), name);
  await page.getByLabel('Filter the tree').focus();
  await page.keyboard.press('ArrowDown');
  await row('DAC foraging');
  await page.keyboard.press('ArrowDown');
  await row('Bug');
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('ArrowDown');
  await row('Reactive Layer');
  await page.keyboard.press('ArrowUp');
  await page.keyboard.press('ArrowRight');
  await page.keyboard.press('ArrowDown');
  await row('Motor');
  await page.keyboard.press('ArrowRight');
  await until(page, 'a button of the row', () => document.activeElement.ariaLabel === 'Space plot of Bug/Motor');
  await page.keyboard.press('ArrowLeft');
  await row('Motor');
  await page.keyboard.press('ArrowLeft');
  await row('Bug');
  await page.keyboard.press('End');
  await row('Connections');
  await page.keyboard.press('Tab');
  assert.equal(await page.evaluate(() => document.activeElement.closest('nav')), null);
  await page.keyboard.press('Shift+Tab');
  await row('Connections');

  step('settings hold for the next page and the next studio');
  const settings = async (page) => {
    await find(page, 'settings');
    return page.getByRole('dialog', { name: 'Settings' });
  };
  let dialog = await settings(page);
  const seconds = () => dialog.getByLabel('Seconds between two savings of the session');
  await until(page, 'the time', () => document.querySelector('dialog[open] input.number')?.value === '20');
  await seconds().fill('4');
  await page.keyboard.press('Enter');
  assert.equal(await dialog.isVisible(), true, 'a crash would lose more than a minute, or the disk is always busy: refused');
  await seconds().fill('30');
  await dialog.getByLabel('Colours').selectOption('dark');
  await page.keyboard.press('Enter');
  await dialog.waitFor({ state: 'hidden' });
  await page.reload();
  await page.locator('.dv-tab').first().waitFor();
  await until(page, 'dark colours', () => document.documentElement.classList.contains('dark'));
  dialog = await settings(page);
  await until(page, 'the time that was set', () => document.querySelector('dialog[open] input.number')?.value === '30');
  await page.keyboard.press('Escape');

  step('names in forms break between their words only');
  await find(page, 'Light to US');
  await inspector(page).getByLabel('Spread', { exact: true }).selectOption('ArbRect');
  await inspector(page).getByLabel('Probability of a synapse').waitFor();
  const broken = await inspector(page).evaluate((form) =>
    [...form.querySelectorAll('label, h2, h3')].flatMap((label) => {
      const texts = document.createTreeWalker(label, NodeFilter.SHOW_TEXT), found = [];
      for (let node = texts.nextNode(); node; node = texts.nextNode())
        for (const word of node.data.matchAll(/\S+/g)) {
          const range = document.createRange();
          range.setStart(node, word.index);
          range.setEnd(node, word.index + word[0].length);
          if (new Set([...range.getClientRects()].map((r) => Math.round(r.top))).size > 1) found.push(label.textContent);
        }
      return found;
    })
  );
  assert.deepEqual(broken, []);
  step('the layouts of the parts leave room for plots and for the names in the diagram');
  for (const size of [large, { width: 1366, height: 768 }]) {
    await page.setViewportSize(size);
    for (const [part, n] of [['Overview', 4], ['Part 3: learning', 6], ['Part 4: memory', 7]]) {
      await find(page, `Layout: ${part}`);
      await count(page, n);
      const plots = await page.evaluate(() => [...document.querySelectorAll('.dv-groupview')].map((g) => [g.querySelector('.dv-tab').textContent.trim(), Math.round(g.offsetWidth), Math.round(g.offsetHeight)]));
      for (const [title, width, height] of plots) assert.ok(width >= 180 && height >= 220, `${part}: ${title} has ${width} x ${height}`);
      await until(page, `names of at least 6.4 px in ${part}`, () => {
        const sizes = [...document.querySelectorAll('.item:not(.phantom) .name')].map((e) => (parseFloat(getComputedStyle(e).fontSize) * e.getBoundingClientRect().width) / e.offsetWidth);
        return sizes.length > 3 && Math.min(...sizes) >= 6.4;
      });
    }
  }
  step('a space plot says that the module of its group is off, with the way to its switch, which keys reach');
  const collector = page.getByRole('group', { name: 'Space plot of Contextual/Collector' });
  await collector.getByText('Module off').waitFor();
  await collector.getByRole('button', { name: 'Enable it…' }).press('Enter');
  await until(page, 'the focus on the switch', () => document.activeElement.matches('aside.right input[type=checkbox]'));
  await page.keyboard.press(' ');
  await collector.getByText('Module off').waitFor({ state: 'detached' });
  await answered(page);
  assert.equal(await sent(page, 'run'), 0);
  assert.equal(await page.getByRole('button', { name: 'Run', exact: true }).count(), 1, 'the key of the switch does not run the system');
  await page.getByRole('button', { name: 'Undo' }).click();
  await collector.getByText('Module off').waitFor();

  await page.close();
  const other = await open(await start().address, { width: 1400, height: 900 });
  await other.getByRole('group', { name: 'Space plot of Bug/Motor' }).waitFor();
  const sizes = [{ width: 1400, height: 900 }, { width: 1024, height: 700 }, { width: 700, height: 600 }];
  const rooms = [4, 3, 1];

  step('each size of the window has its own arrangement, which comes back with it');
  await other.setViewportSize(sizes[1]);
  await count(other, 2);
  await other.locator('.dv-tab', { hasText: 'Bug/Motor' }).click();
  await find(other, 'panel: move right');
  await count(other, 3);
  const seen = [null, await stacks(other), null];
  for (const i of [2, 0, 1, 0, 2, 1, 2, 0]) {
    await other.setViewportSize(sizes[i]);
    await count(other, rooms[i]);
    const now = () => stacks(other);
    seen[i] ??= await now();
    await eventually(`the arrangement for ${sizes[i].width} pixels`, async () => isDeepStrictEqual(await now(), seen[i]));
  }

  step('bars of tools have one row, and stay in place as numbers grow');
  const arena = other.getByRole('group', { name: 'Arena' });
  for (const size of [...sizes, { width: 1280, height: 720 }]) {
    await other.setViewportSize(size);
    await other.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))); // the panels have the new size
    await find(other, 'layout: overview');
    await arena.waitFor();
    await eventually(`a row at ${size.width}`, () => arena.locator('.bar').first().evaluate((e) => e.offsetHeight < 36 && e.scrollWidth <= e.clientWidth));
  }
  for (const width of [700, 861, 990, 991, 1101, 1241, 1321]) {
    await other.setViewportSize({ width, height: 700 });
    await until(other, `the time and the trials at ${width}`, () => {
      const all = document.querySelector('.readings').getBoundingClientRect();
      return [...document.querySelectorAll('.readings > div')].slice(0, 2).every((d) => d.getBoundingClientRect().right <= all.right + 1 && d.getBoundingClientRect().bottom <= all.bottom + 1);
    });
  }
  await other.setViewportSize(sizes[0]);
  const places = () => Promise.all([other.getByLabel('Seed of the run'), other.getByLabel('Colour scale').first(), arena.getByRole('button', { name: 'Rays' })].map(async (e) => Math.round((await e.boundingBox()).x)));
  await find(other, 'layout: overview');
  let began = [];
  await eventually('panels that have their places', async () => String(began) === String(began = await places()));
  await other.getByRole('button', { name: 'Max', exact: true }).click();
  await other.getByRole('button', { name: 'Run', exact: true }).click();
  await until(other, 'many cycles', () => Number(document.querySelector('[aria-label="Moment of the run"]').value) > 1000);
  await other.getByRole('button', { name: 'Pause', exact: true }).click();
  assert.deepEqual(await places(), began);

  step('a plot that is opened from the diagram does not cover it');
  await other.setViewportSize(sizes[0]);
  const diagram = other.getByRole('group', { name: 'Diagram' });
  await find(other, 'layout: build');
  await count(other, 1);
  await diagram.locator('.svelte-flow__node[data-id]', { hasText: 'Light' }).first().dblclick();
  await other.getByRole('group', { name: 'Space plot of Bug/Light' }).waitFor();
  await diagram.waitFor();
  await other.setViewportSize(sizes[1]);
  await find(other, 'layout: overview');
  await diagram.locator('.svelte-flow__node[data-id]', { hasText: 'GPS' }).first().dblclick();
  await other.getByRole('group', { name: 'Space plot of Bug/GPS' }).waitFor();
  await diagram.waitFor();

  step('in a small window, one press beside the form of what was clicked shows a plot; Escape and its button close it, too');
  await other.setViewportSize(sizes[2]);
  const plot = other.locator('.dv-tab', { hasText: 'Bug/Light' }), form = inspector(other);
  const ways = [() => other.keyboard.press('Escape'), () => form.getByRole('button', { name: 'Close the inspector' }).click(), () => plot.click()];
  for (const [i, close] of ways.entries()) {
    await other.locator('.dv-tab', { hasText: 'Diagram' }).click();
    await diagram.locator('.svelte-flow__node[data-id]', { hasText: ['Sensor', 'GPS', 'Sensor'][i] }).first().click();
    await form.waitFor();
    await close();
    await form.waitFor({ state: 'detached' });
  }
  await other.getByRole('group', { name: 'Space plot of Bug/Light' }).waitFor();
  await other.setViewportSize(sizes[0]);

  step('the tutorial shows the same paragraph in windows of all sizes, behind another tab, and when it is opened again');
  const tutorial = other.getByRole('button', { name: 'Tutorial', exact: true });
  await tutorial.click();
  const text = other.getByRole('group', { name: 'Tutorial', exact: true }).locator('.text');
  const wide = () => text.evaluate((e) => e.clientWidth), unmoved = await wide();
  for (const drawn of [true, false]) {
    await other.getByRole('button', { name: 'Show or hide the inspector' }).click();
    await other.getByRole('region', { name: 'Inspector' }).waitFor({ state: drawn ? 'visible' : 'hidden' });
    await eventually('panels as wide as their room', () => other.evaluate(() => document.querySelector('.dock > *').clientWidth === document.querySelector('.dock').clientWidth));
    assert.equal(await wide(), unmoved, 'the text keeps its width');
  }
  const read = () => text.evaluate((e) => [...e.children].findIndex((c) => c.getBoundingClientRect().bottom > e.getBoundingClientRect().top));
  const scrolled = () => eventually('paragraph 15', async () => (await read()) === 15);
  await text.evaluate((e) => e.children[15].scrollIntoView());
  await scrolled();
  for (const i of [1, 2, 0]) {
    await other.setViewportSize(sizes[i]);
    await eventually('its width', () => text.evaluate((e) => e.clientWidth !== Number(e.dataset.width) && (e.dataset.width = e.clientWidth)));
    await scrolled();
  }
  const docked = await stacks(other);
  await other.locator('.dv-tab', { hasText: 'Tutorial' }).click({ button: 'right' });
  await other.getByRole('menuitem', { name: 'Float' }).click();
  await scrolled();
  // The menu lies above a floating window.
  await other.locator('.dv-tab', { hasText: 'Tutorial' }).click({ button: 'right' });
  await other.getByRole('menuitem', { name: 'Dock' }).click();
  await eventually('it is at the edge again', async () => isDeepStrictEqual(await stacks(other), docked));
  await scrolled();
  await other.locator('.dv-tab', { hasText: 'Tutorial' }).click({ button: 'right' });
  await other.getByRole('menuitem', { name: 'Into the tabs of…' }).click();
  await other.getByRole('menuitem', { name: 'Bug/Motor' }).click();
  await scrolled();
  for (const tab of ['Bug/Motor', 'Tutorial']) await other.locator('.dv-tab', { hasText: tab }).click();
  await scrolled();
  await tutorial.click();
  await text.waitFor({ state: 'detached' });
  await tutorial.click();
  await scrolled();

  step('a system that is opened beside the tutorial leaves it open, and gives the diagram a useful share');
  const share = () => eventually('a wide diagram', () => diagram.evaluate((e) => e.clientWidth >= 400));
  await other.keyboard.press('Alt+n');
  await other.getByRole('dialog', { name: 'New system' }).getByRole('button', { name: 'Create' }).click();
  await other.getByText('The system is empty.', { exact: false }).waitFor();
  await share();
  await scrolled();

  assert.deepEqual(faults, []);
}
