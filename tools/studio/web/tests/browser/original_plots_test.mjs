// Plots of the original (.conf) in Chromium, and what a time plot and the data sampler show.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { until } from './support.mjs';

export default async function({ folder, start, open, step }) {
  const text = readFileSync(join(folder, 'systems/dac_foraging.iqr'), 'utf8');
  const id = (name) => (new RegExp(`<Group [^>]*name="${name}"[^>]*`).exec(text)?.[0] ?? '').match(/ id="([^"]+)"/)[1];
  const shown = (item, states) => `<StateVariableDisplay><StateVariableDisplays ID="1" itemID="${item}" indices=""><Average>true</Average><SelectedStates>${states}</SelectedStates></StateVariableDisplays></StateVariableDisplay>`;
  const conf = join(folder, 'plots.conf');
  writeFileSync(
    conf,
    `<iqrDataManagerConfiguration>
<DataClient type="PlotTypeGroup" ID="a">${shown(id('Sensor'), 'act;')}</DataClient>
<DataClient type="PlotTypeTime" ID="b">${shown(id('GPS'), 'act;')}</DataClient>
<DataClient type="DataSampler" ID="c"><AutoStart>true</AutoStart><TARGET_MODE>6</TARGET_MODE><SamplingRate>2</SamplingRate><FileName>gps.dat</FileName>${shown(id('GPS'), 'act;')}</DataClient>
<DataClient type="PlotTypeGroup" ID="d">${shown('gone', 'act;')}</DataClient>
</iqrDataManagerConfiguration>
`,
  );
  const page = await open(await start().address);
  await page.getByRole('group', { name: 'Space plot of Bug/Motor' }).waitFor();

  step('a file .conf opens its plots, and says what it cannot');
  await page.getByRole('button', { name: 'Layouts of the panels' }).click();
  await page.locator('input[type="file"]').setInputFiles(conf);
  await page.getByRole('group', { name: 'Space plot of Bug/Sensor' }).waitFor();
  await page.getByText('plots.conf:5').waitFor();
  assert.equal(await page.getByRole('group', { name: 'Space plot of Bug/Motor' }).count(), 0);
  await page.getByRole('button', { name: 'Close the message' }).click();
  const file = page.locator('.form label').filter({ hasText: /^File/ }).locator('input');
  assert.equal(await file.inputValue(), 'gps.dat');
  assert.equal(await page.getByLabel('begin and end with the run').isChecked(), true);

  step('the sampler begins with the run');
  await page.locator('.panel .bar button.primary').filter({ hasText: 'Record' }).click();
  await page.getByText('begins with the run').waitFor();
  await page.locator('body').press('.');
  await page.getByText('1 row in gps_001.dat').waitFor();

  step('the time plot draws a line');
  await page.getByRole('button', { name: '4×' }).click();
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await until(page, 'a line in the colour of the first source', () => {
    const c = document.querySelector('.uplot canvas');
    if (!c) return false;
    const { data } = c.getContext('2d').getImageData(0, 0, c.width, c.height);
    let line = 0;
    for (let i = 0; i < data.length; i += 4) line += data[i] < 30 && Math.abs(data[i + 1] - 114) < 30 && Math.abs(data[i + 2] - 178) < 30 && data[i + 3] > 100;
    return line > 30;
  });
}
