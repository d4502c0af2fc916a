// Diagrams that can be read: the systems that come with Forage, at two sizes of the window.
import assert from 'node:assert/strict';
import { eventually, find, picture, until } from './support.mjs';

const systems = [['reactive_foraging', 'basic_arena'], ['dac_foraging', 'basic_arena'], ['learners_foraging', 'ambiguous_arena'], ['allostasis', 'desert'], ['sec_maze', 'double_t_maze'], ['q_maze', 'double_t_maze']];

/** What is wrong on the page that is seen. */
const faults = () => {
  const found = [], boxes = [...document.querySelectorAll('.svelte-flow__node-item')].map((e) => ({ e, r: e.getBoundingClientRect() }));
  const zoom = Number(/scale\(([\d.]+)\)/.exec(document.querySelector('.svelte-flow__viewport').style.transform)[1]);
  for (const { e } of boxes)
    for (const text of e.querySelectorAll('.name, .about, .port')) {
      const size = zoom * parseFloat(getComputedStyle(text).fontSize);
      if (size < 10.99) found.push(`'${text.textContent}' has ${size} pixels`);
      if (text.scrollWidth > e.offsetWidth) found.push(`'${text.textContent}' is cut`);
    }
  // A line may touch the boxes at its ends.
  for (const path of document.querySelectorAll('g[data-connection] .thin')) {
    const length = path.getTotalLength(), at = path.getScreenCTM();
    for (let d = 12; d < length - 12; d += 4) {
      const p = path.getPointAtLength(d).matrixTransform(at);
      const box = boxes.find(({ r }) => p.x > r.left + 2 && p.x < r.right - 2 && p.y > r.top + 2 && p.y < r.bottom - 2);
      if (box) {
        found.push(`${path.parentElement.getAttribute('aria-label')} passes through ${box.e.textContent}`);
        break;
      }
    }
  }
  const pane = document.querySelector('[aria-label="Canvas"]').getBoundingClientRect();
  for (const { e, r } of boxes) if (r.left < pane.left - 1 || r.right > pane.right + 1 || r.top < pane.top - 1 || r.bottom > pane.bottom + 1) found.push(`${e.textContent} is outside`);
  return found;
};

/** What stays wrong on a page with at least this many boxes. */
async function remaining(page, boxes) {
  await until(page, 'the boxes', (n) => document.querySelectorAll('.svelte-flow__node-item').length >= n, boxes);
  let found = [];
  await eventually('a page without faults', async () => !(found = await page.evaluate(faults)).length).catch(() => {});
  return found;
}

export default async function({ site, start, open, faults: thrown, step }) {
  for (const [system, world] of process.env.FORAGE_WHOLE ? systems : systems.slice(0, 2)) {
    step(`${system}: names of 11 pixels at least, lines around boxes, each page whole at 1400 and 1024`);
    const page = await open(await start([`systems/${system}.iqr`, '--world', `systems/worlds/${world}.world`]).address);
    await page.getByRole('group', { name: 'Arena' }).waitFor();
    await find(page, 'layout: build');
    const tabs = page.getByRole('group', { name: 'Processes' }).getByRole('button');
    for (const [width, height] of [[1400, 900], [1024, 700]]) {
      await page.setViewportSize({ width, height });
      if (width === 1024) {
        await page.getByRole('tab', { name: 'Diagram' }).click();
        await until(page, 'the whole height for the diagram, as the arena was behind it', () => document.querySelector('[aria-label="Canvas"]').offsetHeight > 450);
      }
      for (let i = 0; i < (await tabs.count()); i++) {
        await tabs.nth(i).click();
        await until(page, 'this page', (n) => document.querySelectorAll('[aria-label="Processes"] button')[n].matches('.on'), i);
        const found = await remaining(page, system === 'allostasis' ? 0 : 1); // of which a process has no groups
        await picture(page, `${system}-${width}-${i}`);
        assert.deepEqual(found, [], `page ${i} of ${system} at ${width}`);
      }
    }
    if (system !== 'allostasis') {
      step(`${system}: whole names in the diagram beside the arena, on each page`);
      await page.setViewportSize({ width: 1400, height: 900 });
      await find(page, 'layout: overview');
      for (let i = 0; i < (await tabs.count()); i++) {
        await tabs.nth(i).click();
        await until(page, 'this page', (n) => document.querySelectorAll('[aria-label="Processes"] button')[n].matches('.on'), i);
        await until(page, `page ${i} of ${system}: whole names`, () => {
          const names = [...document.querySelectorAll('.svelte-flow__node-item .item:not(.phantom) .name')].map((n) => n.textContent);
          return names.length > 0 && names.every((n) => n && !n.includes('…'));
        });
        await picture(page, `${system}-overview-${i}`);
      }
    }
    await page.close();
  }

  step('another system is shown whole, also after one that was zoomed; two fingers zoom');
  const address = await start(['systems/reactive_foraging.iqr', '--world', 'systems/worlds/basic_arena.world']).address;
  const context = await (await open(address)).context().browser().newContext({ hasTouch: true, viewport: { width: 1400, height: 900 } });
  const page = await context.newPage();
  await page.goto(address);
  await page.getByRole('group', { name: 'Arena' }).waitFor();
  await find(page, 'layout: build');
  await page.getByRole('group', { name: 'Processes' }).getByRole('button', { name: 'System' }).click();
  const zoom = () => page.evaluate(() => Number(/scale\(([\d.]+)\)/.exec(document.querySelector('.svelte-flow__viewport').style.transform)[1]));
  const whole = await zoom(), touch = await context.newCDPSession(page);
  const { x, y, width } = await page.getByRole('application', { name: 'Canvas' }).boundingBox();
  const fingers = (type, half) => touch.send('Input.dispatchTouchEvent', { type, touchPoints: half ? [-half, half].map((dx, id) => ({ x: x + width / 2 + dx, y: y + 30, id })) : [] });
  await fingers('touchStart', 40);
  for (const half of [60, 80, 120]) await fingers('touchMove', half);
  await fingers('touchEnd', 0);
  await until(page, 'a larger page', (z) => Number(/scale\(([\d.]+)\)/.exec(document.querySelector('.svelte-flow__viewport').style.transform)[1]) > 1.5 * z, whole);
  await page.keyboard.press('Control+o');
  await page.getByRole('dialog').getByLabel('Name', { exact: true }).fill(site ? '/forage/systems/sec_maze.iqr' : 'sec_maze.iqr');
  await page.keyboard.press('Enter');
  await page.getByRole('navigation').getByText('Entropy').waitFor();
  await picture(page, 'other-system');
  await page.getByRole('group', { name: 'Processes' }).getByRole('button', { name: 'System' }).click();
  await until(page, 'its boxes', () => document.querySelectorAll('.svelte-flow__node-item').length === 4);
  assert.deepEqual(await remaining(page, 4), []);
  await context.close();
  assert.deepEqual(thrown, []);
}
