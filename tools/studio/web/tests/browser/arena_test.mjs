// The arena in Chromium against the real program: keys, and the view in space.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { accessible, eventually, until } from './support.mjs';

/** What of the arena is looked at. */
async function shown(page) {
  const arena = page.getByRole('group', { name: 'Arena', exact: true });
  await arena.waitFor();
  return { page, arena, view: arena.getByRole('application'), says: arena.locator('[aria-live]') };
}
/** The numbers in what the arena says of a thing. */
async function place(says, name) {
  const [, x, y, heading] = /x (\S+) m, y (\S+) m, heading (\d+)/.exec(await says.filter({ hasText: `${name}: ` }).textContent()).map(Number);
  return { x, y, heading };
}

export default async function({ context, start, open, faults, step }) {
  const address = await start(['systems/team_a.iqr', 'systems/team_b.iqr', '--world', 'systems/worlds/team_arena.world']).address;
  const { page, arena, view, says } = await shown(await open(address));
  const says_ = async (text) => says.filter({ hasText: text }).waitFor();

  step('Tab goes from robot to robot; arrows move, with Shift farther; brackets turn; it is said where the robot is');
  await eventually('the poses', async () => { // before they are known, Tab leaves the arena
    await view.blur();
    await view.focus();
    await page.keyboard.press('Tab');
    return (await says.filter({ hasText: 'A_1: ' }).count()) > 0;
  });
  await page.keyboard.press('Tab');
  await says_('A_2: ');
  await page.keyboard.press('Shift+Tab');
  await says_('A_1: ');
  const before = await place(says, 'A_1');
  await page.keyboard.press('Shift+ArrowRight');
  await says_(`x ${(before.x + 0.5).toFixed(2)}`);
  await page.keyboard.press('ArrowDown');
  await says_(`y ${(before.y - 0.05).toFixed(2)}`);
  await page.keyboard.press('[');
  await until(page, 'the turn', (h) => !document.querySelector('[aria-label="Arena"] [aria-live]').textContent.includes(`heading ${h}`), before.heading);
  const after = await place(says, 'A_1');
  assert.equal((after.heading - before.heading + 360) % 360, 5);
  assert.deepEqual([after.x, after.y], [before.x + 0.5, before.y - 0.05].map((v) => +v.toFixed(2)));

  step('a place that is taken is refused in words, and the robot stays');
  for (const x of [-4.5, -5, -5.5]) {
    await page.keyboard.press('Shift+ArrowLeft');
    await says_(`x ${x.toFixed(2)} m`);
  }
  await page.keyboard.press('Shift+ArrowDown'); // there is A_2
  await says_('A_1 stays: ');

  step('after the last robot, Tab leaves the arena');
  let tabs = 0;
  while ((await view.evaluate((v) => v === document.activeElement)) && tabs < 20) await page.keyboard.press('Tab'), tabs++;
  assert.ok(tabs >= 3 && tabs < 20, `${tabs} times Tab`);

  step('in space: robots, grippers and walls; keys turn and zoom the view; it draws while the run goes');
  await page.setViewportSize({ width: 1040, height: 560 }); // each pixel is drawn by the processor
  await arena.getByRole('button', { name: '3-D' }).click();
  await arena.getByRole('application', { name: /in space/ }).waitFor();
  const png = async () => {
    const [file] = await Promise.all([page.waitForEvent('download'), arena.getByLabel('Save').selectOption('png')]);
    return readFileSync(await file.path());
  };
  const drawn = async (what, key, differs) => {
    await view.focus();
    await page.keyboard.press(key);
    let p;
    await eventually(what, async () => (p = await png()).length > 8000 && differs(p)); // an empty picture of this size is smaller
    return p;
  };
  let earlier = await png();
  const settled = (p) => {
    const same = p.equals(earlier);
    earlier = p;
    return same;
  };
  const whole = await drawn('the picture', '0', settled);
  await drawn('the view from another side', 'ArrowLeft', (p) => !p.equals(whole));
  await drawn('the view from near by', '+', (p) => !p.equals(whole));
  await drawn('the whole', '0', (p) => p.equals(whole));
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await drawn('the robots drive', '0', (p) => !p.equals(whole));
  await page.getByRole('button', { name: 'Pause', exact: true }).click();
  await accessible(page);
  await arena.getByRole('button', { name: '3-D' }).click();
  await arena.getByRole('application', { name: /from above/ }).waitFor();

  step('the whole floor of an arena without walls around it is seen, from one edge to the other');
  const basic = await shown(await open(await start().address));
  await basic.page.getByRole('group', { name: 'Space plot of Bug/Motor' }).waitFor();
  const { x, y, width, height } = await basic.view.boundingBox();
  for (const [at, edge] of [[4, (v) => v > 3.95], [height - 4, (v) => v < -3.95]]) {
    await basic.page.mouse.move(x + width / 2, y + at);
    await eventually(`the edge at ${at}`, async () => edge(Number(/, (-?[\d.]+) m/.exec(await basic.arena.locator('.where').last().textContent())?.[1])));
  }
  await basic.page.close();
  assert.deepEqual(faults, []);

  step('without WebGL the arena says so, and is shown from above');
  await context.addInitScript(() => {
    const getContext = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function(kind, ...more) {
      return kind.startsWith('webgl') ? null : getContext.call(this, kind, ...more);
    };
  });
  await page.goto(address);
  await arena.getByRole('button', { name: '3-D' }).click();
  await says.filter({ hasText: 'This browser has no WebGL, so the arena is shown from above.' }).waitFor();
  await arena.getByRole('application', { name: /from above/ }).waitFor();
  assert.equal(await arena.getByRole('button', { name: '3-D' }).getAttribute('aria-pressed'), 'false');
  await accessible(page);
}
