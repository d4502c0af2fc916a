// Systems with mistakes, and the XML editor, in Chromium against the real program.
import assert from 'node:assert/strict';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { accessible, answeredTo, find, picture, sent, until } from './support.mjs';

export default async function({ site, folder, context, start, open, onDisk, faults, step }) {
  const file = join(folder, 'systems/reactive_foraging.iqr');
  const sound = readFileSync(file, 'utf8');
  // Lines of a file from Windows, some of them: they stay.
  const author = sound.replace('\n', '\r\n').replace('<System', '<!-- Größe, 😀 -->\n<System');
  const wrongLine = author.split('\n').findIndex((l) => l.includes('</Group>'));
  const broken = author.replace('</Group>', '</Grup>');
  writeFileSync(file, broken);
  writeFileSync(join(folder, 'systems/other.iqr'), '<System id="s" name="Other">\n  <Process id="p" name="P"><DiagramIcon x="9" y="9"/></Process>\n  <Proces id="q" name="Q"/>\n</System>\n');
  const studio = start(['systems/reactive_foraging.iqr', '--world', 'systems/worlds/basic_arena.world']);
  let printed = '';
  studio.child?.stderr.on('data', (d) => (printed += d));
  const page = await open(await studio.address);
  const panel = page.getByRole('group', { name: 'XML of the system' });
  const text = panel.getByRole('textbox', { name: 'XML of the system' });
  const status = panel.getByRole('status');
  const list = page.getByRole('listbox', { name: 'Completions' });
  const option = (name) => list.getByRole('option', { name });
  // The editor takes no Enter within 75 ms after its list appears.
  const accept = async (name) => {
    await list.getByRole('option', { name, selected: true }).waitFor();
    await page.evaluate(() => new Promise((done) => setTimeout(done, 80)));
    await page.keyboard.press('Enter');
    await list.getByRole('option', { name, selected: true }).waitFor({ state: 'detached' });
  };
  const problems = page.getByRole('group', { name: 'Problems' });
  const line = () =>
    page.evaluate(() => {
      const node = getSelection().anchorNode;
      return (node instanceof Element ? node : node?.parentElement)?.closest('.cm-line')?.textContent ?? '';
    });

  step('a file that is not XML opens with its text, its mistake and the list of them');
  await text.waitFor();
  if (!site) assert.match(printed, new RegExp(`reactive_foraging\\.iqr:${wrongLine + 1}:\\d+: error: .*Grup`));
  await status.getByText('1 mistake: corrected, the system runs').waitFor();
  await panel.locator('.cm-lintRange-error').filter({ hasText: 'Grup' }).waitFor();
  await problems.getByRole('button', { name: /Grup/ }).waitFor();
  await accessible(page);
  await picture(page, 'broken');

  step('a click on the problem leads to its line; it is corrected by the keyboard, and the system runs');
  // As long as that of a hand: the editor has noticed that the focus left it.
  await problems.getByRole('button', { name: /Grup/ }).click({ delay: 50 });
  await until(page, 'the editor moves there', () => getSelection().anchorNode?.parentElement?.closest('.cm-line')?.textContent.includes('</Grup>'));
  await page.keyboard.press('End');
  for (let i = 0; i < '</Grup>'.length; ++i) await page.keyboard.press('Backspace');
  await page.keyboard.type('</'); // the editor ends what is open
  assert.match(await line(), /^\s*<\/Group>$/);
  await status.getByText('No mistakes').waitFor();
  await page.getByRole('navigation').getByText('Approach', { exact: true }).first().waitFor();
  await page.keyboard.press('Control+s');
  await page.getByText('Saved.').waitFor();
  const inFile = async (name) => readFileSync(await onDisk(page, `systems/${name}.iqr`), 'utf8');
  const saved = (await inFile('reactive_foraging')).split('\n');
  assert.deepEqual(author.split('\n').flatMap((l, i) => (l === saved[i] ? [] : [[l, saved[i]]])), []);
  assert.equal(saved.join('\n').length, author.length);

  step('a closing tag that is typed in full stands there once');
  const beforeFirstConnection = async () => {
    await page.keyboard.press('Control+Home');
    await page.keyboard.press('Control+f');
    await page.keyboard.type('<Connection');
    await page.keyboard.press('Enter');
    await page.keyboard.press('Escape');
    await text.press('Home');
  };
  await beforeFirstConnection();
  const typed = '<Topology><TopologyRect hcount="2" vcount="2"/></Topology><A><B></B></A>';
  await page.keyboard.type(typed);
  assert.equal((await line()).trim().split('<Connection')[0], typed);
  for (let i = 0; i < '</A>'.length; ++i) await page.keyboard.press('Backspace');
  await page.keyboard.type('</A>');
  assert.equal((await line()).trim().split('<Connection')[0], typed);
  for (let i = 0; i < typed.length; ++i) await page.keyboard.press('Backspace');
  assert.match(await line(), /^\s*<Connection [^<]*$/);

  step('elements, attributes and values are completed, with what they mean');
  await beforeFirstConnection();
  await page.keyboard.type('<');
  await option(/^Process/).waitFor();
  await page.keyboard.type('Conn');
  await accept(/^Connection/);
  await page.keyboard.type('new');
  await page.keyboard.press('Tab');
  await page.keyboard.type('New');
  await page.keyboard.press('Tab');
  await page.keyboard.press('Control+Space');
  await option(/Bug\/Light/).waitFor();
  await page.keyboard.type('selection/ur');
  await accept(/Selection\/UR/);
  await page.keyboard.press('Tab');
  await page.keyboard.press('Control+Space');
  await page.keyboard.type('motor in');
  await accept(/Selection\/Motor In/);
  assert.match(await line(), /<Connection id="new" name="New" source="selection\.ur" target="selection\.motor_in"><\/Connection>/);
  await page.keyboard.press('Tab');
  await page.keyboard.type('<Syn');
  await accept(/Synapse/);
  await page.keyboard.press('Control+Space');
  await page.keyboard.type('Fixed');
  await accept(/synapseFixedWeight/);
  await page.keyboard.press('Tab');
  await page.keyboard.type('<Par');
  await accept(/Parameter/);
  await page.keyboard.press('Control+Space');
  await option(/weight/).waitFor();
  await page.locator('.cm-completionInfo').getByText(/default 1/).waitFor();
  await picture(page, 'completion');
  await accessible(page);
  await accept(/weight/);
  await page.keyboard.press('Tab');
  await page.keyboard.type('0.5');
  assert.match(await line(), /<Synapse name="synapseFixedWeight"><Parameter name="weight" value="0\.5"\/><\/Synapse>/);
  await status.getByText('No mistakes').waitFor();
  await page.getByRole('navigation').getByText('11', { exact: true }).waitFor(); // connections

  step('a mistake is marked as it is written; F8 leads to it; undo takes it back');
  await page.keyboard.press('Escape');
  await page.keyboard.press('Home');
  const before = await line();
  await page.keyboard.insertText('<Nonsense/>'); // at once, so that it is checked once
  await panel.locator('.cm-lintRange-error').filter({ hasText: '<Nonsense' }).waitFor();
  await status.getByText(/1 mistake: the last version without mistakes runs/).waitFor();
  await page.keyboard.press('Control+Home');
  await page.keyboard.press('F8');
  await page.locator('.cm-tooltip-lint').getByText(/Nonsense/).waitFor();
  assert.match(await line(), /<Nonsense/);
  await page.keyboard.press('Escape');
  await page.evaluate(() => document.documentElement.classList.add('dark'));
  await picture(page, 'dark');
  await accessible(page);
  await page.evaluate(() => document.documentElement.classList.remove('dark'));
  for (let i = 0; i < '<Nonsense/>'.length && (await line()) !== before; i++) await page.keyboard.press('Control+z');
  assert.equal(await line(), before);
  await status.getByText('No mistakes').waitFor();

  step('Tab writes, and after Escape it leaves the editor');
  const inside = () => page.evaluate(() => !!document.activeElement?.closest('.cm-editor'));
  assert.equal(await inside(), true);
  await page.keyboard.press('Escape');
  await page.keyboard.press('Tab');
  assert.equal(await inside(), false);

  step('an edit of the diagram appears in the text, and a step of the text is undone like others');
  await find(page, 'Approach Inhibition');
  const inspector = page.getByRole('region', { name: 'Inspector' });
  const reads = await sent(page, 'document');
  await inspector.getByLabel('Name', { exact: true }).fill('Renamed here');
  await inspector.getByLabel('Name', { exact: true }).press('Enter');
  await answeredTo(page, 'document', reads);
  await find(page, 'Edit the XML');
  await page.keyboard.press('Escape');
  await text.press('Control+Home');
  await page.keyboard.press('Control+f');
  await page.keyboard.type('Renamed here');
  await page.keyboard.press('Enter');
  await panel.locator('.cm-searchMatch').first().waitFor();
  await page.keyboard.press('Escape');

  step('what is done with the run meanwhile is no conflict with what is written');
  const done = await page.evaluate(() =>
    new Promise((answer) => { // not as the page does it, which would know of it
      window.socket.addEventListener('message', ({ data }) => {
        const message = typeof data === 'string' ? JSON.parse(data) : {};
        if (message.type === 'reply' && message.id === 1e9) answer(message.ok);
      });
      window.socket.send(JSON.stringify({ id: 1e9, command: 'manipulate', group: 'Bug/Motor', patterns: [Array(81).fill(0)] }));
    })
  );
  assert.equal(done, true);
  await text.press('Control+End');
  await page.keyboard.type('<!-- meanwhile -->');
  await page.keyboard.press('Control+s');
  await until(page, 'the saved file', () => !document.title.startsWith('●'));
  assert.equal(await panel.getByRole('alert').count(), 0);
  assert.match(await inFile('reactive_foraging'), /<!-- meanwhile -->/);

  step('the XML of an item: marks while it is written, completion, and what is taken over');
  await find(page, 'US to Approach');
  await inspector.getByText('XML', { exact: true }).click();
  const item = inspector.getByRole('textbox', { name: 'XML of the item' });
  await item.waitFor();
  const written = (await item.locator('.cm-line').allInnerTexts()).join('\n');
  await item.fill(written.replace('excitatory', 'excited'));
  await inspector.locator('.cm-lintRange-error').filter({ hasText: 'excited' }).waitFor();
  await accessible(page);
  await item.fill(written.replace('excitatory', 'inhibitory'));
  await inspector.locator('.cm-lintRange-error').waitFor({ state: 'detached' });
  await item.press('Control+Enter');
  await inspector.getByText(/inhibitory, \d/).waitFor();

  step('opening a file with mistakes from the menu shows them, and a small window too');
  await page.keyboard.press('Control+s');
  await page.getByText('Saved.').last().waitFor();
  await page.keyboard.press('Control+o');
  const dialog = page.getByRole('dialog', { name: 'Open a system' });
  await dialog.getByRole('button', { name: 'other.iqr' }).click();
  await dialog.getByRole('button', { name: 'Open', exact: true }).click();
  await dialog.waitFor({ state: 'detached' });
  await panel.locator('.cm-lintRange-error').filter({ hasText: 'Proces' }).waitFor();
  if (!site) { // another page has a session of its own there
    const small = await open(new URL(page.url()).origin, { width: 420, height: 800 });
    await small.locator('.cm-lintRange-error').filter({ hasText: 'Proces' }).waitFor();
    await picture(small, 'small');
    await accessible(small);
    await small.close();
  }
  await text.fill('<System id="s" name="Other">\n  <Process id="p" name="P"><DiagramIcon x="9" y="9"/></Process>\n</System>\n');
  await status.getByText('No mistakes').waitFor();
  await page.keyboard.press('Control+s');
  await until(page, 'the saved file', () => !document.title.startsWith('●'));
  assert.equal(await inFile('other'), '<System id="s" name="Other">\n  <Process id="p" name="P"><DiagramIcon x="9" y="9"/></Process>\n</System>\n');

  step('the first page of a sound system loads no editor');
  const loaded = [];
  const second = start(['systems/dac_foraging.iqr', '--world', 'systems/worlds/basic_arena.world']);
  const other = await context.newPage();
  other.on('request', (r) => loaded.push(r.url()));
  await other.goto(await second.address);
  await other.getByRole('group', { name: 'Arena' }).waitFor();
  assert.deepEqual(loaded.filter((u) => /XmlEditor/.test(u)), []);
  await find(other, 'edit the xml');
  await other.getByRole('textbox', { name: 'XML of the system' }).waitFor();
  assert.equal(loaded.filter((u) => /XmlEditor\.js/.test(u)).length, 1);

  assert.deepEqual(faults, []);
}
