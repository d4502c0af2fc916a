// Two runs side by side in Chromium, and what the canvases show.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { eventually, picture, until } from './support.mjs';

export default async function({ start, open, step }) {
  const page = await open(await start().address);
  await page.getByRole('group', { name: 'Space plot of Bug/Motor' }).waitFor();
  const seek = page.getByLabel('Moment of the run');
  const cycle = (n) => until(page, `cycle ${n}`, (wanted) => Number(document.querySelector('[aria-label="Moment of the run"]')?.value) >= wanted, n);
  const inspector = page.getByRole('region', { name: 'Inspector' });

  step('the canvases show something: several colours in the arena, and the heat map of a group that is zero is one dark blue');
  const count = (selector) => page.locator(selector).first().evaluate((c) => new Set(new Uint32Array(c.getContext('2d').getImageData(0, 0, c.width, c.height).data.buffer)).size);
  await until(page, 'the floor', () => {
    const c = document.querySelector('[role="group"][aria-label="Arena"] canvas');
    return new Set(new Uint32Array(c.getContext('2d').getImageData(0, 0, c.width, c.height).data.buffer)).size > 20;
  });
  await until(page, 'the first colour of viridis, one pixel per cell', () => {
    const c = document.querySelector('[aria-label="Space plot of Bug/Motor"] canvas.heat');
    return c.width === 9 && c.height === 9 && [...c.getContext('2d').getImageData(4, 4, 1, 1).data].join() === '68,1,84,255';
  });
  assert.equal(await count('[aria-label="Space plot of Bug/Motor"] canvas.heat'), 1);

  step('a run, with the motor over time');
  await page.getByRole('navigation').getByText('Motor', { exact: true }).click();
  await inspector.getByRole('button', { name: 'Time' }).click();
  await page.locator('.uplot canvas').first().waitFor();
  await inspector.getByRole('button', { name: 'Raster' }).click();
  await page.getByRole('group', { name: 'Raster plot of Bug/Motor' }).getByText('It fills while the system runs.').waitFor();
  await page.getByRole('button', { name: '4×' }).click();
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await cycle(150);
  await page.getByRole('button', { name: 'Pause', exact: true }).click();

  step('from cycle 50 on twice: with a motor that does nothing, and as it was');
  await seek.fill('50');
  await until(page, 'cycle 50', () => document.querySelector('[aria-label="Moment of the run"]')?.value === '50');
  await page.getByRole('button', { name: 'Compare from here' }).click();
  await page.getByRole('button', { name: 'End comparison' }).waitFor();
  await inspector.getByRole('heading', { name: 'Bug/Motor' }).waitFor();
  const gain = inspector.locator('input[id^="Bug/Motor."]').first();
  await gain.fill('0');
  await gain.press('Enter');
  // It pauses where the motor of the run as it was is at work.
  await page.evaluate(() => window.socket.send(JSON.stringify({ id: 1e9, command: 'run_until', condition: 'cycle >= 160' })));
  await cycle(160);
  await page.getByRole('button', { name: 'Run', exact: true }).waitFor();

  step('both traces are in the plot, with their values; both robots are in the arena');
  await page.locator('.dv-tab', { hasText: 'over time' }).click();
  const key = page.locator('.key .number').filter({ hasText: '/' }).first();
  await key.waitFor();
  const [now, before] = (await key.innerText()).split('/').map(Number);
  assert.ok(Number.isFinite(now) && Number.isFinite(before) && now !== before, `${now} / ${before}`);
  const robots = () =>
    page.locator('[role="group"][aria-label="Arena"] canvas').first().evaluate((c) => {
      const { data } = c.getContext('2d').getImageData(0, 0, c.width, c.height);
      let blue = 0;
      for (let i = 0; i < data.length; i += 4) if (data[i + 2] > 180 && data[i + 2] > data[i] + 60 && data[i + 1] > 100) blue++;
      return blue;
    });
  step('space and raster plots have a picture of each run, or one of their difference');
  /** What is saved of a space plot has both runs. */
  const savedWithBoth = async (plot) => {
    const file = async (format) => {
      const [download] = await Promise.all([page.waitForEvent('download'), page.locator(plot).getByLabel('Save').selectOption(format)]);
      return readFileSync(await download.path());
    };
    const lines = String(await file('csv')).trim().split('\n').map((l) => l.split(','));
    assert.deepEqual([lines.length, lines[0].length, ...lines[0].slice(0, 3), lines[9][1]], [19, 11, 'run', 'row', 'column 1', '9']);
    const of = (run) => lines.slice(1).filter((l) => l[0] === run).flatMap((l) => l.slice(2).map(Number));
    assert.ok(of('now').length === 81 && of('now').every((v) => v === 0), of('now').join());
    assert.ok(of('as it was').length === 81 && of('as it was').some((v) => v > 0), of('as it was').join());
    const svg = String(await file('svg'));
    assert.equal(svg.match(/<rect /g).length, 162);
    assert.match(svg, />now<.*>as it was</);
    const png = await file('png'); // its width and height are in its head
    const [width, height] = [png.readUInt32BE(16), png.readUInt32BE(20)];
    assert.ok(Math.max(width, height) > 1.5 * Math.min(width, height), `${width} x ${height}`);
  };
  const show = (tab) => page.locator('.dv-tab', { hasText: tab }).filter({ hasText: new RegExp(`^${tab}$`) }).click();
  for (const [tab, plot] of [['Bug/Motor', '[aria-label="Space plot of Bug/Motor"] '], ['Bug/Motor raster', '[aria-label="Raster plot of Bug/Motor"] ']]) {
    await show(tab);
    await page.locator(`${plot}canvas.reference`).waitFor();
    // The gain of the motor is zero, so its cells are silent now, and were active.
    await eventually(`fewer colours now than before in ${tab}`, async () => (await count(`${plot}canvas:not(.reference)`)) < (await count(`${plot}canvas.reference`)));
    if (tab === 'Bug/Motor') {
      await page.locator(`${plot}canvas.reference`).hover({ position: { x: 4, y: 4 } });
      await page.locator(plot).getByText('(1, 1)').waitFor();
      const captions = await page.locator(`${plot}figcaption`).allInnerTexts();
      assert.ok(captions.length === 2 && /^now 0$/.test(captions[0]) && /^as it was [\d.]+$/.test(captions[1]), captions.join());
    }
    if (tab === 'Bug/Motor') await savedWithBoth(plot);
    await page.locator(plot).getByLabel('Comparison').selectOption('difference');
    await page.locator(`${plot}canvas.reference`).waitFor({ state: 'detached' });
    await until(page, `blue in ${tab}: less than it was`, (p) => {
      const c = document.querySelector(`${p}canvas`), { data } = c.getContext('2d').getImageData(0, 0, c.width, c.height);
      let blue = 0, red = 0;
      for (let i = 0; i < data.length; i += 4) blue += data[i + 3] && data[i + 2] > data[i] + 20, red += data[i + 3] && data[i] > data[i + 2] + 20;
      return blue > 0 && red === 0;
    }, plot);
  }
  const both = await robots();
  await picture(page, 'compare');
  await page.getByRole('button', { name: 'End comparison' }).click();
  await page.getByRole('button', { name: 'Compare from here' }).waitFor();
  await page.locator('.dv-tab', { hasText: 'over time' }).click();
  await until(page, 'one value', () => ![...document.querySelectorAll('.key .number')].some((n) => n.textContent.includes('/')));
  assert.equal(await page.getByLabel('Comparison').count(), 0);
  await eventually('the pale robot and its trail are gone', async () => (await robots()) < both);

  step('an edit of the structure ends a comparison and the past, and says so');
  await page.getByRole('button', { name: 'Compare from here' }).click();
  await page.getByRole('button', { name: 'End comparison' }).waitFor();
  await page.getByRole('navigation').getByRole('button', { name: 'Open Connections' }).or(page.getByRole('navigation').getByRole('button', { name: 'Connections', exact: true })).first().click();
  await page.getByRole('navigation').locator('.row:has(i)').first().click();
  await page.keyboard.press('Delete');
  await page.getByText('The run continues in the edited system: it cannot go back to before this edit and the comparison has ended.').waitFor();
  await page.getByRole('button', { name: 'Compare from here' }).waitFor();
  assert.ok((await seek.getAttribute('max')) === (await seek.inputValue()) && (await seek.isDisabled()), 'the slider of a run without a past is at its end');
}
