// Panels are moved, stacked, floated, resized and closed with the keyboard alone, in Chromium against the real program.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { answered, find, picture, sent, until } from './support.mjs';

export default async function({ start, open, onDisk, faults, step }) {
  const page = await open(await start().address, { width: 1600, height: 1000 });
  await page.getByRole('group', { name: 'Space plot of Bug/Motor' }).waitFor();
  const press = async (...keys) => {
    for (const k of keys) await page.keyboard.press(k);
  };

  /** The stacks that are seen: their tabs, in order, and their places. */
  const stacks = () =>
    laidOut().then(() =>
      page.evaluate(() =>
        [...document.querySelectorAll('.dv-groupview')].filter((g) => g.getClientRects().length && g.offsetWidth && g.offsetHeight).map((g) => {
          const { x, y, width, height } = g.getBoundingClientRect();
          return {
            tabs: [...g.querySelectorAll('.dv-tab')].map((t) => t.textContent.trim()).join(', '),
            x: Math.round(x),
            y: Math.round(y),
            right: Math.round(x + width),
            bottom: Math.round(y + height),
            width: Math.round(width),
            height: Math.round(height),
            floats: !!g.closest('.dv-resize-container'),
          };
        })
      )
    );
  // What is in a floating window is laid out with one of the next pictures.
  const laidOut = () =>
    until(page, 'the floating windows are laid out', async () => {
      for (let i = 0; i < 2; i++) await new Promise(requestAnimationFrame);
      return [...document.querySelectorAll('.dv-resize-container')].every((w) => {
        const window = w.getBoundingClientRect(), inside = [...w.querySelectorAll('.dv-groupview')].map((g) => g.getBoundingClientRect());
        return ['right', 'bottom'].every((side) => Math.abs(Math.max(...inside.map((r) => r[side])) - window[side]) < 3);
      });
    });
  const stack = async (tab) => {
    const found = (await stacks()).find((s) => s.tabs.split(', ').includes(tab));
    assert.ok(found, `a stack with ${tab}: ${JSON.stringify(await stacks())}`);
    return found;
  };
  /** The focus is on this tab, and is seen. */
  const focused = (tab) =>
    until(page, `the focus on the tab ${tab}`, (t) => {
      const e = document.activeElement;
      return e.matches('.dv-tab:focus-visible') && e.textContent.trim() === t && getComputedStyle(e, '::after').outlineStyle === 'solid';
    }, tab);
  const settled = (what, condition) => until(page, what, condition);
  /** Goes to a panel from part to part. */
  const go = async (tab) => {
    for (let i = 0; i < 12; i++) {
      if (await page.evaluate((t) => document.activeElement.matches('.dv-tab') && document.activeElement.textContent.trim() === t, tab)) return;
      await page.evaluate(() => (window.before = document.activeElement));
      await press('F6');
      await until(page, 'another part', () => document.activeElement !== window.before);
    }
    assert.fail(`F6 does not lead to ${tab}`);
  };
  /** Chooses from the open menu by arrows and Enter. */
  const choose = async (label) => {
    await page.getByRole('menuitem', { name: label }).first().waitFor();
    for (let i = 0; i < 30; i++) {
      const here = await page.evaluate(() => document.activeElement.matches('[role=menuitem]') && document.activeElement.querySelector('span').textContent);
      if (here === label) return press('Enter');
      await press('ArrowDown');
    }
    assert.fail(`the menu does not lead to ${label}`);
  };
  const inMenu = async (...labels) => {
    await press('Shift+F10');
    for (const label of labels) await choose(label);
    await settled('the menu is closed', () => !document.querySelector('[role=menu]'));
  };

  step('F6 leads from part to part, and back with Shift');
  await press('F6');
  await focused('Arena');
  await press('F6');
  await focused('Diagram');
  await press('F6');
  await focused('Bug/Light');
  await press('F6');
  await focused('Bug/Motor');
  await press('F6');
  await until(page, 'the inspector', () => document.activeElement.closest('aside.right'));
  await press('F6');
  await until(page, 'the line below', () => document.activeElement.closest('footer'));
  await press('F6');
  await until(page, 'the bar above', () => document.activeElement.closest('header.top'));
  await press('F6');
  await until(page, 'the tree', () => document.activeElement.closest('aside.left'));
  await press('F6');
  await focused('Arena');
  await press('Shift+F6');
  await until(page, 'the tree', () => document.activeElement.closest('aside.left'));

  step('keys on a tab do not run the system');
  await go('Bug/Motor');
  await press(' ');
  await answered(page);
  assert.equal(await sent(page, 'run'), 0);
  assert.equal(await page.getByRole('button', { name: 'Run', exact: true }).count(), 1);

  step('a panel becomes a tab of another stack, goes before the other tab, and is split off again');
  await go('Diagram');
  await inMenu('Into the tabs of…', 'Arena');
  await focused('Diagram');
  assert.equal((await stack('Diagram')).tabs, 'Arena, Diagram');
  assert.equal((await stacks()).length, 3);
  assert.equal((await stack('Arena')).bottom, (await stack('Bug/Motor')).bottom, 'the room that it left is taken');
  await press('Control+ArrowLeft');
  await focused('Diagram');
  assert.equal((await stack('Diagram')).tabs, 'Diagram, Arena');
  await press('Control+ArrowLeft');
  assert.equal((await stack('Diagram')).tabs, 'Diagram, Arena');
  await inMenu('Tab after');
  assert.equal((await stack('Diagram')).tabs, 'Arena, Diagram');
  await press('ArrowLeft');
  await focused('Arena');
  await press('ArrowRight', 'Enter');
  await focused('Diagram');
  await inMenu('Move left');
  await focused('Diagram');
  const beside = [await stack('Diagram'), await stack('Arena')];
  assert.ok(beside[0].right <= beside[1].x + 4 && beside[0].y === beside[1].y && beside[0].height === beside[1].height, 'the diagram is left of the arena');
  await picture(page, 'split');

  step('a panel that stands alone goes past its neighbour, and then to the edge of all');
  await press('Control+Shift+ArrowRight');
  await focused('Diagram');
  const past = [await stack('Arena'), await stack('Diagram')];
  assert.ok(past[0].right <= past[1].x + 4 && past[0].y === past[1].y, 'it is right of the arena');
  await go('Bug/Motor');
  await inMenu('Move below');
  await focused('Bug/Motor');
  const all = await stacks(), motor = await stack('Bug/Motor');
  assert.ok(all.every((s) => s.x >= motor.x && s.right <= motor.right && (s.tabs === motor.tabs || s.bottom <= motor.y + 4)), 'it is a row below all');
  await press('Shift+F10');
  assert.equal(await page.getByRole('menuitem', { name: 'Move below' }).isDisabled(), true);
  await press('Escape');
  await focused('Bug/Motor');

  step('the keys of size make a panel wider, narrower, taller and shorter, from within it, too');
  const sizes = async (tab, keys, check) => {
    const before = await stack(tab);
    await press(...keys);
    const after = await stack(tab);
    assert.ok(check(after.width - before.width, after.height - before.height), `${keys}: ${JSON.stringify([before, after])}`);
  };
  await sizes('Bug/Motor', ['Alt+Shift+ArrowDown'], (w, h) => w === 0 && h === 40);
  await sizes('Bug/Motor', ['Alt+Shift+ArrowUp', 'Alt+Shift+ArrowUp'], (w, h) => w === 0 && h === -80);
  await go('Arena');
  await sizes('Arena', ['Alt+Shift+ArrowRight'], (w, h) => w === 40 && h === 0);
  await page.getByRole('application', { name: /^The world from above/ }).focus();
  await sizes('Arena', ['Alt+Shift+ArrowLeft'], (w, h) => w === -40 && h === 0);
  await go('Arena');
  await sizes('Arena', [], () => true);
  const narrow = await stack('Arena');
  await inMenu('Wider');
  assert.equal((await stack('Arena')).width, narrow.width + 40);

  step('a panel floats, and its window is moved and sized');
  await go('Bug/Light');
  await inMenu('Float');
  await focused('Bug/Light');
  const loose = await stack('Bug/Light');
  assert.ok(loose.floats && loose.width >= 400, JSON.stringify(loose));
  await press('Control+Shift+ArrowLeft', 'Control+Shift+ArrowLeft', 'Control+Shift+ArrowUp', 'Alt+Shift+ArrowRight', 'Alt+Shift+ArrowDown');
  await focused('Bug/Light');
  const moved = await stack('Bug/Light');
  assert.deepEqual([moved.x, moved.y, moved.width, moved.height], [loose.x - 80, loose.y - 40, loose.width + 40, loose.height + 40]);
  await picture(page, 'float');

  step('all of it is there after the page is opened again');
  const arrangement = async () => JSON.stringify((await stacks()).sort((a, b) => (a.tabs < b.tabs ? -1 : 1)));
  const before = await arrangement();
  await page.reload();
  await page.getByRole('group', { name: 'Space plot of Bug/Light' }).waitFor();
  await until(page, 'four stacks', () => document.querySelectorAll('.dv-groupview').length === 4);
  assert.equal(await arrangement(), before);

  step('two panels share a floating window: the second is split off in it, and docked again');
  await go('Bug/Motor');
  await inMenu('Into the tabs of…', 'Bug/Light');
  assert.equal((await stack('Bug/Motor')).tabs, 'Bug/Light, Bug/Motor');
  await inMenu('Split below');
  const [light, lower] = [await stack('Bug/Light'), await stack('Bug/Motor')];
  assert.ok(light.floats && lower.floats && light.bottom <= lower.y + 4 && light.x === lower.x, JSON.stringify([light, lower]));
  await focused('Bug/Motor');
  await press('Control+Shift+ArrowDown');
  assert.deepEqual([(await stack('Bug/Light')).y, (await stack('Bug/Motor')).y], [light.y + 40, lower.y + 40], 'the window moves as one');
  await inMenu('Dock');
  await focused('Bug/Motor');
  assert.equal((await stack('Bug/Motor')).floats, false);
  await go('Bug/Light');
  await inMenu('Dock');
  assert.equal((await stacks()).filter((s) => s.floats).length, 0);

  step('what floated is docked where it was, with its size');
  const order = async () => (await stacks()).sort((a, b) => a.x - b.x || a.y - b.y).map((s) => s.tabs);
  const columns = await order();
  for (const tab of ['Arena', 'Bug/Light']) {
    await go(tab);
    const { width, height } = await stack(tab);
    await inMenu('Float');
    assert.equal((await stack(tab)).floats, true);
    await inMenu('Dock');
    await focused(tab);
    assert.deepEqual(await order(), columns);
    const back = await stack(tab);
    assert.ok(Math.abs(back.width - width) <= 2 && Math.abs(back.height - height) <= 2, JSON.stringify([width, height, back]));
  }
  const home = await arrangement();

  step('a panel is shown alone, and all are shown again');
  await go('Arena');
  await inMenu('Maximize');
  await focused('Arena');
  assert.deepEqual((await stacks()).map((s) => s.tabs), ['Arena']);
  await inMenu('Restore');
  await focused('Arena');
  assert.equal(await arrangement(), home);
  await inMenu('Maximize');
  await focused('Arena');
  await inMenu('Move right');
  await focused('Arena');
  assert.deepEqual(await order(), [columns[1], columns[0], ...columns.slice(2)], 'one that is alone goes past its hidden neighbour');
  await inMenu('Move left');
  assert.deepEqual(await order(), columns);

  step('a menu that is opened right after an action keeps the focus');
  await press('Shift+F10');
  await page.getByRole('menuitem', { name: 'Wider' }).waitFor();
  await page.evaluate(async () => {
    [...document.querySelectorAll('[role=menuitem]')].find((e) => e.textContent.startsWith('Maximize')).click();
    document.activeElement.dispatchEvent(new MouseEvent('contextmenu', { bubbles: true, cancelable: true }));
    for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
  });
  await choose('Restore');
  await focused('Arena');
  assert.deepEqual(await order(), columns);

  step('Ctrl+K has the same actions, for the active panel');
  await find(page, 'panel: float');
  await focused('Arena');
  assert.equal((await stack('Arena')).floats, true);
  await find(page, 'panel: dock');
  await focused('Arena');
  assert.deepEqual(await order(), columns);
  await find(page, 'panel: next');
  await until(page, 'another tab', () => document.activeElement.matches('.dv-tab') && document.activeElement.textContent.trim() !== 'Arena');

  step('the button of a stack opens the same menu; the right button, too');
  await go('Diagram');
  await press('Tab');
  await until(page, 'the button', () => document.activeElement.ariaLabel === 'Menu of the panel Diagram');
  await press('Enter');
  await choose('Into the tabs of…');
  await choose('Arena');
  await focused('Diagram');
  await page.locator('.dv-tab', { hasText: 'Arena' }).click({ button: 'right' });
  await page.getByRole('menuitem', { name: 'Close the other tabs' }).waitFor();
  await picture(page, 'menu');
  await press('Escape');

  step('the other tabs are closed, and then a panel; the focus goes to one that is there');
  await go('Bug/Light');
  await go('Diagram');
  await inMenu('Close the other tabs');
  await focused('Diagram');
  await page.getByRole('group', { name: 'Arena' }).waitFor({ state: 'detached' });
  await go('Bug/Light');
  await inMenu('Close');
  assert.equal((await stacks()).some((s) => s.tabs.includes('Bug/Light')), false);
  await until(page, 'the focus on a tab', () => document.activeElement.matches('.dv-tab'));
  const left = await arrangement();
  await page.reload();
  await page.getByRole('group', { name: 'Diagram' }).waitFor();
  await until(page, 'two stacks', () => document.querySelectorAll('.dv-groupview').length === 2);
  assert.equal(await arrangement(), left);

  step('a system whose panel was shown alone has all its panels when it is opened again; a tutorial that was closed stays closed');
  const system = (name) => async () => {
    await page.keyboard.press('Control+o');
    await page.getByRole('dialog', { name: 'Open a system' }).getByRole('button', { name, exact: true }).first().click();
    await page.keyboard.press('Enter');
    await page.getByRole('dialog', { name: 'Open a system' }).waitFor({ state: 'detached' });
  };
  const here = system('dac_foraging.iqr'), there = system('sec_maze.iqr'), tutorial = page.getByRole('group', { name: 'Tutorial', exact: true });
  const panels = (n) => until(page, `${n} stacks of panels`, (wanted) => document.title.startsWith('DAC') && document.querySelectorAll('.dv-groupview').length === wanted, n);
  await here(); // its file has the path by which it is opened again
  await page.getByRole('button', { name: 'Layouts of the panels' }).click();
  await page.getByRole('button', { name: /^Overview/ }).click();
  await panels(4);
  await page.getByRole('button', { name: 'Tutorial', exact: true }).first().click();
  await tutorial.waitFor();
  await panels(5);
  await there();
  await until(page, 'the other system', () => !document.title.startsWith('DAC'));
  await tutorial.waitFor();
  await page.getByRole('button', { name: 'Tutorial', exact: true }).first().click();
  await tutorial.waitFor({ state: 'detached' });
  await here();
  await panels(4);
  assert.equal(await tutorial.count(), 0);
  const withAll = await arrangement();
  await go('Diagram');
  await inMenu('Maximize');
  await there();
  await until(page, 'the other system', () => !document.title.startsWith('DAC'));
  await here();
  await panels(4);
  assert.equal(await arrangement(), withAll);

  step('a layout that is there already is replaced only after a question');
  const kept = async () => readFileSync(await onDisk(page, 'systems/mine.layout.json'), 'utf8');
  await page.getByRole('button', { name: 'Layouts of the panels' }).press('Enter');
  await page.getByLabel('Name of the layout').focus();
  await page.keyboard.type('mine');
  await press('Enter');
  await page.getByText('The layout mine is kept beside the system.').first().waitFor();
  const first = await kept();
  await find(page, 'panel: float');
  await until(page, 'a floating window, with the focus', () => document.querySelector('.dv-resize-container')?.contains(document.activeElement));
  await page.getByRole('button', { name: 'Layouts of the panels' }).press('Enter');
  await page.getByLabel('Name of the layout').focus();
  await press('Enter');
  await page.getByText('A layout mine exists already.').waitFor();
  await picture(page, 'replace');
  assert.equal(await kept(), first);
  await press('Tab', 'Tab', 'Enter');
  await until(page, 'the menu is closed', () => !document.querySelector('.popover .menu'));
  assert.match(await kept(), /floatingGroups/);
  await find(page, 'panel: dock');
  await page.getByRole('button', { name: 'Layouts of the panels' }).press('Enter');
  await page.getByRole('button', { name: 'mine', exact: true }).press('Enter');
  await until(page, 'the layout with its floating window', () => document.querySelector('.dv-resize-container'));

  step('when all panels are closed, it is said how to open some');
  for (const close = page.locator('.dv-default-tab-action'); await close.count();) await close.first().dispatchEvent('click');
  await page.getByText('All panels are closed.').waitFor();
  await page.getByRole('button', { name: 'Overview', exact: true }).click();
  await page.getByRole('group', { name: 'Arena' }).waitFor();

  step('that a panel is closed is said until another one is');
  const closing = (title) => page.locator('.dv-tab', { hasText: title }).locator('.dv-default-tab-action').dispatchEvent('click');
  await closing('Arena');
  await page.getByText('The arena is closed.').waitFor();
  await closing('Bug/Light');
  await page.evaluate(() => new Promise(requestAnimationFrame));
  assert.equal(await page.getByText('The arena is closed.').count(), 0);
  assert.deepEqual(faults, []);
}
