// A system in the words of its author: constants, equations with their values, and arrays, in Chromium against the real program.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { accessible, find, picture, until } from './support.mjs';

const text = `<System id="s" name="Words" cylesPerSecond="100">
  <Constant name="n" value="12"/>
  <Constant name="rate" value="2" minimum="0" maximum="4" unit="1/s" doc="How fast x follows."/>
  <Constant name="half" value="{rate / 2}"/>
  <NeuronType name="leaky" doc="A leaky integrator with a gain of each cell.">
    <State name="gain" value="1"/>
    <Equations>
      u = gain * half - x
      dx/dt = rate * u
      when x' &lt; -100: x' = 0
      output y = max(x', 0)
    </Equations>
  </NeuronType>
  <SynapseType name="fading" doc="Its weight fades.">
    <Equations>
      weight' = 0.999 * weight
      output psp = weight' * pre'
    </Equations>
  </SynapseType>
  <Process id="p" name="P">
    <Group id="a" name="A"><Topology><TopologyRect hcount="{n / 3}" vcount="3"/></Topology><Neuron name="leaky"><Initial state="gain" file="gains.csv"/></Neuron></Group>
    <Group id="b" name="B"><Topology><TopologyRect hcount="40" vcount="25"/></Topology><Neuron name="leaky"/></Group>
  </Process>
  <Connection id="c" name="few" source="a" target="a"><Weights form="list">0 0 0.1
    1 3 -0.4
    11 2 0.2</Weights></Connection>
  <Connection id="d" name="many" source="b" target="b"><Weights file="w.csv"/></Connection>
  <Connection id="e" name="fades" source="b" target="a"><Weights file="fades.csv"/><Synapse name="fading"/></Connection>
</System>
`;

export default async function({ folder, start, open, onDisk, faults, step }) {
  const numbers = (rows, columns, value) => Array.from({ length: rows }, (_, r) => Array.from({ length: columns }, (_, c) => value(r, c)).join()).join('\n');
  writeFileSync(join(folder, 'words.iqr'), text);
  writeFileSync(join(folder, 'gains.csv'), numbers(12, 1, (r) => (r - 4) / 4));
  writeFileSync(join(folder, 'w.csv'), numbers(1000, 1000, (r, c) => (r < 500 && c >= 500 ? 'nan' : (Math.cos((r - c) / 80) / 1000).toFixed(5))));
  writeFileSync(join(folder, 'fades.csv'), numbers(12, 1000, (r, c) => (r === c % 12 ? 0.5 : 'nan')));
  writeFileSync(join(folder, 'other.csv'), numbers(12, 12, (r, c) => (r === c ? 1 : -0.1)));
  const page = await open(await start(['words.iqr']).address);
  const inspector = page.getByRole('region', { name: 'Inspector' }), plot = (name) => page.getByRole('group', { name, exact: true });
  const equations = inspector.getByRole('list', { name: 'Equations' }), line = (begin) => equations.getByRole('listitem').filter({ hasText: begin }).locator('.number');
  const system = () => page.getByRole('navigation').locator('[data-id="system"]').click();

  step('constants are a part of the form of the system: a number with a slider, a formula with its value');
  await system();
  const rate = page.locator('[id="rate"]'), half = page.locator('[id="half"]');
  await rate.fill('3');
  await rate.press('Enter');
  await inspector.getByText('= 1.5', { exact: true }).waitFor();
  assert.equal(await inspector.getByLabel('rate, slider').inputValue(), '3');
  await half.fill('{rate / 4}');
  await half.press('Enter');
  await inspector.getByText('= 0.75', { exact: true }).waitFor();
  await half.fill('{rat}');
  await half.press('Enter');
  await inspector.getByRole('alert').filter({ hasText: "there is no constant 'rat'" }).waitFor();
  assert.equal(await half.inputValue(), '{rate / 4}');
  await accessible(page);
  await picture(page, 'constants');

  step('what more than parameters depends on is refused; undo takes a constant back');
  await page.locator('[id="n"]').fill('15');
  await page.locator('[id="n"]').press('Enter');
  await inspector.getByRole('alert').filter({ hasText: 'more than parameters depends on this constant' }).waitFor();
  assert.equal(await page.locator('[id="n"]').inputValue(), '15', 'what is refused can be mended');
  await page.locator('[id="n"]').press('Escape');
  assert.equal(await page.locator('[id="n"]').inputValue(), '12');
  await page.getByRole('heading', { name: 'Inspector' }).click();
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+z');
  await until(page, 'the former value', () => document.getElementById('rate')?.value === '2');
  await inspector.getByText('= 1', { exact: true }).waitFor();

  step('equations have the values of the states that they compute, of all cells or of one');
  await find(page, 'P/A');
  await equations.waitFor();
  assert.deepEqual(await equations.locator('code').allInnerTexts(), ['u = gain * half - x', 'dx/dt = rate * u', "when x' < -100: x' = 0", "output y = max(x', 0)"]);
  assert.equal(await page.locator('[id="P/A.half"]').inputValue(), '{half}');
  await line('dx/dt').getByText('0', { exact: true }).waitFor();
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await until(page, 'the mean changes', () => Number(document.querySelectorAll('[aria-label="Equations"] .number')[1]?.textContent) > 0.2);
  await page.getByRole('button', { name: 'Pause', exact: true }).click();
  const gains = inspector.getByRole('application', { name: 'gain of the cells of P/A' });
  await gains.focus();
  await page.keyboard.press('End');
  await inspector.getByText('of cell (4, 3)').first().waitFor();
  await inspector.locator('.state').filter({ hasText: 'gain' }).getByText('1.75').waitFor();
  assert.deepEqual(await gains.locator('canvas').evaluate((c) => [c.width, c.height]), [4, 3]);
  await gains.scrollIntoViewIfNeeded();
  await accessible(page);
  await picture(page, 'equations');

  step('a list of weights, with other cells without synapses, is a matrix');
  await find(page, 'few');
  const few = inspector.getByRole('application', { name: 'Weight of few' });
  await until(page, 'the matrix', () => document.querySelector('[aria-label="Weight of few"] canvas')?.width === 12);
  const pixel = (label, x, y) => page.evaluate(([l, x, y]) => [...document.querySelector(`[aria-label="${l}"] canvas`).getContext('2d').getImageData(x, y, 1, 1).data], [label, x, y]);
  assert.equal((await pixel('Weight of few', 5, 5))[3], 0);
  const [red, , blue] = await pixel('Weight of few', 1, 3);
  assert.ok(blue > red, 'a weight below 0 is blue');
  await few.focus();
  await few.press('Enter');

  step('the file of weights is chosen from the list of files');
  await inspector.getByText('The numbers stand in the XML.').waitFor();
  await inspector.getByLabel('List', { exact: true }).click();
  await inspector.getByRole('button', { name: 'Choose a file…' }).click();
  const dialog = page.getByRole('dialog', { name: 'Weights' });
  await dialog.getByRole('button', { name: 'other.csv' }).click();
  await dialog.getByRole('button', { name: 'Take', exact: true }).click();
  await until(page, 'the name of the file', () => [...document.querySelectorAll('aside input')].some((i) => i.value === 'other.csv'));
  await inspector.getByText('144 synapses').first().waitFor();
  await picture(page, 'weights-file');

  step('a matrix of 1000 x 1000 is shown as the means of blocks');
  await find(page, 'many');
  await inspector.locator('.open').getByRole('button', { name: 'Weight' }).click();
  const many = plot('Weights of many');
  await many.getByText('1000 source cells across, 1000 target cells down; means of 4 × 4').waitFor();
  await many.getByRole('application').focus();
  await page.keyboard.press('End');
  await many.getByText(/^mean 0\.001: \(37, 25\) to \(40, 25\) → \(37, 25\) to \(40, 25\)$/).waitFor();
  assert.equal(await many.getByLabel('Colours').inputValue(), 'diverging');
  assert.equal((await pixel('Weights of many', 249, 0))[3], 0);
  await accessible(page);
  await picture(page, 'weights-many');

  step('weights that change are those of now');
  await find(page, 'fades');
  await line("weight'").getByText('0.5', { exact: true }).waitFor({ state: 'detached' });
  await inspector.getByText('Its weight fades.').waitFor();

  step('a mistake in an equation stands at its line, in the form and in the list; a click leads there');
  await find(page, 'Edit the XML');
  const xml = page.getByRole('textbox', { name: 'XML of the system' });
  await xml.waitFor();
  await xml.press('Control+Home');
  await page.keyboard.press('Control+f');
  await page.keyboard.type('rate * u');
  await page.keyboard.press('Enter');
  await page.keyboard.press('Escape');
  await page.keyboard.type('rate * w');
  await find(page, 'P/A');
  const wrong = equations.getByRole('button', { name: /'w'/ });
  await wrong.waitFor();
  await picture(page, 'mistake');
  await page.getByRole('button', { name: 'earlier version runs' }).click();
  await page.getByRole('group', { name: 'Problems' }).getByRole('button', { name: /'w'/ }).click({ delay: 50 });
  const there = () => until(page, 'the editor moves there', () => getSelection().anchorNode?.parentElement?.closest('.cm-line')?.textContent.includes('rate * w'));
  await there();
  await page.keyboard.press('Control+Home');
  await wrong.click({ delay: 50 });
  await there();
  assert.ok(readFileSync(await onDisk(page, 'words.iqr'), 'utf8') === text, 'nothing is saved');

  assert.deepEqual(faults, []);
}
