// How long a large system takes to open, and how smoothly it is dragged, beside an almost empty one: node large.mjs FORAGE SOURCES
import { writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { inBrowser, launch } from './support.mjs';

const [forage, sources] = process.argv.slice(2).map((p) => resolve(p));

/** A system of equal groups in rows, with connections between any of them. */
function write(file, groups, connections, processes = 1) {
  let out = '<System id="s" name="Large" cylesPerSecond="25">\n';
  const ids = [];
  for (let p = 0; p < processes; p++) {
    out += `<Process id="p${p}" name="Process ${p}"><DiagramIcon x="${(p % 20) * 90}" y="${Math.floor(p / 20) * 90}" width="50" height="50"/>\n`;
    for (let i = 0; i < groups / processes; i++) {
      ids.push(`g${p}_${i}`);
      out += `<Group id="g${p}_${i}" name="Group ${i}"><Topology><TopologyRect hcount="3" vcount="3" cylinderHor="false" cylinderVert="false"/></Topology><Neuron name="neuronLinearThreshold"/><DiagramIcon x="${(i % 25) * 90}" y="${
        Math.floor(i / 25) * 90
      }" width="50" height="50"/></Group>\n`;
    }
    out += '</Process>\n';
  }
  let seed = 7;
  const next = () => ids[(seed = (seed * 1103515245 + 12345) % 2147483648) % ids.length];
  for (let i = 0; i < connections; i++)
    out += `<Connection id="c${i}" name="C ${i}" type="${
      ['excitatory', 'inhibitory', 'modulatory'][i % 3]
    }" source="${next()}" target="${next()}"><Synapse name="synapseFixedWeight"/><DiagramLine APSource="4" APTarget="12"/></Connection>\n`;
  writeFileSync(file, `${out}</System>\n`);
}

const browser = await launch();
await inBrowser(browser, forage, sources, async ({ folder, context, start }) => {
  const measure = async (name, groups, connections, processes = 1) => {
    write(join(folder, `${name}.iqr`), groups, connections, processes);
    const studio = start([`${name}.iqr`]);
    const page = await context.newPage();
    const address = await studio.address;
    const began = performance.now();
    await page.goto(address);
    const lines = processes === 1 ? 0.9 * connections : 1; // some are bundles
    await page.waitForFunction((n) => document.querySelector('.svelte-flow__node') && document.querySelectorAll('.lines g').length >= n, lines);
    const opened = performance.now() - began;
    await page.keyboard.press('Control+k');
    await page.keyboard.type('layout: build');
    await page.keyboard.press('Enter');
    await page.waitForTimeout(1500);
    const box = await page.locator('.svelte-flow__node').first().boundingBox();
    const frames = page.evaluate(() =>
      new Promise((done) => {
        const times = [];
        let last = performance.now();
        const frame = (t) => {
          times.push(t - last);
          last = t;
          if (times.length < 90) requestAnimationFrame(frame);
          else done(times.sort((a, b) => a - b));
        };
        requestAnimationFrame(frame);
      })
    );
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    for (let i = 0; i < 60; i++) {
      await page.mouse.move(x + 3 * i, y + 2 * i);
      await page.waitForTimeout(10);
    }
    const times = await frames;
    await page.mouse.up();
    await page.close();
    studio.child.removeAllListeners('exit');
    studio.child.kill('SIGINT');
    console.log(`${name}: opened in ${(opened / 1000).toFixed(2)} s; frames while dragging: median ${times[45].toFixed(1)} ms, 95 % ${times[85].toFixed(1)} ms`);
    return times[45];
  };
  const empty = await measure('empty', 1, 0);
  const large = await measure('large', 500, 1000);
  await measure('many', 600, 600, 300);
  console.log(`median frame, large to empty: ${(large / empty).toFixed(2)}`);
});
await browser.close();
