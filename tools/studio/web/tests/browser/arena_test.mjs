// The arena in Chromium against the real program: keys, and the view in space. node arena_test.mjs FORAGE SOURCES
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { resolve } from 'node:path';
import { inBrowser } from './support.mjs';

const [forage, sources] = process.argv.slice(2).map((p) => resolve(p));
const step = (text) => console.log(text);
const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

async function open(context, address, faults) {
  const page = await context.newPage();
  page.on('pageerror', (e) => faults.push(e.message));
  page.on('console', (m) => m.type() === 'error' && faults.push(m.text()));
  await page.goto(address);
  const arena = page.getByRole('group', { name: 'Arena', exact: true });
  await arena.waitFor();
  return { page, arena, view: arena.getByRole('application'), says: arena.locator('[aria-live]') };
}
/** The numbers in what the arena says of a thing. */
async function place(says, name) {
  const [, x, y, heading] = /x (\S+) m, y (\S+) m, heading (\d+)/.exec(await says.filter({ hasText: `${name}: ` }).textContent()).map(Number);
  return { x, y, heading };
}
async function accessible(page) {
  await page.evaluate(axe);
  const serious = await page.evaluate(async () => (await window.axe.run({ exclude: ['.dv-tab'] }, { resultTypes: ['violations'] })).violations.filter((v) => ['serious', 'critical'].includes(v.impact)).map((v) => `${v.id}: ${v.nodes[0].html.slice(0, 160)}`));
  assert.deepEqual(serious, []);
}

await inBrowser(
  sources,
  async ({ context, start, until }) => {
    const faults = [];
    const address = await start(forage, ['systems/team_a.iqr', 'systems/team_b.iqr', '--world', 'systems/worlds/team_arena.world']).address;
    const { page, arena, view, says } = await open(context, address, faults);
    const says_ = async (text) => says.filter({ hasText: text }).waitFor();

    step('Tab goes from robot to robot; arrows move, with Shift farther; brackets turn; it is said where the robot is');
    for (let i = 0; i < 100 && !(await says.textContent()).includes('A_1: '); i++) {
      await view.focus();
      await page.keyboard.press('Tab'); // leaves the arena until the poses are there
      await page.waitForTimeout(50);
    }
    await says_('A_1: ');
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
    const lost = faults.length;
    await arena.getByRole('button', { name: '3-D' }).click();
    await arena.getByRole('application', { name: /in space/ }).waitFor();
    const picture = async () => {
      const [file] = await Promise.all([page.waitForEvent('download'), arena.getByRole('button', { name: 'Save as PNG' }).click()]);
      return readFileSync(await file.path());
    };
    const drawn = async (what, key, differs) => {
      await view.focus();
      await page.keyboard.press(key);
      for (let i = 0; ; i++) {
        const p = await picture();
        if (p.length > 8000 && differs(p)) return p; // an empty picture of this size is smaller
        assert.ok(i < 50, `waited in vain: ${what}`);
      }
    };
    let earlier = await picture();
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
    assert.equal(faults.length, lost, faults.join());
    await accessible(page);
    await arena.getByRole('button', { name: '3-D' }).click();
    await arena.getByRole('application', { name: /from above/ }).waitFor();
    assert.deepEqual(faults, []);
  },
  ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
);

await inBrowser(sources, async ({ context, start }) => {
  step('without WebGL the arena says so, and is shown from above');
  const faults = [];
  await context.addInitScript(() => {
    const getContext = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...more) {
      return kind.startsWith('webgl') ? null : getContext.call(this, kind, ...more);
    };
  });
  const { page, arena, says } = await open(context, await start(forage).address, faults);
  await arena.getByRole('button', { name: '3-D' }).click();
  await says.filter({ hasText: 'This browser has no WebGL, so the arena is shown from above.' }).waitFor();
  await arena.getByRole('application', { name: /from above/ }).waitFor();
  assert.equal(await arena.getByRole('button', { name: '3-D' }).getAttribute('aria-pressed'), 'false');
  await accessible(page);
});
console.log('all fine');
