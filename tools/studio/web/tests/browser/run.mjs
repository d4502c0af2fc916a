// The tests of the page in Chromium against the real program, topic by topic: node run.mjs FORAGE SOURCES [TOPIC...].
// They also run against the site of tools/web: its folder takes the place of the program. The browser keeps the files there.
// With FORAGE_PICTURES=FOLDER, pictures of what they see are left there.
import { readdirSync } from 'node:fs';
import { resolve } from 'node:path';
import { inBrowser, launch } from './support.mjs';

const [forage, sources] = process.argv.slice(2, 4).map((p) => resolve(p));
const all = readdirSync(import.meta.dirname).flatMap((f) => /^(.*)_test\.mjs$/.exec(f)?.[1] ?? []).sort();
const wanted = process.argv.slice(4), unknown = wanted.filter((t) => !all.includes(t));
if (unknown.length) throw new Error(`there is no topic ${unknown.join(', ')}, but ${all.join(', ')}`);

const browser = await launch(), failed = [];
for (const topic of wanted.length ? wanted : all) {
  const began = performance.now();
  const seconds = () => ((performance.now() - began) / 1000).toFixed(1);
  const { default: test } = await import(`./${topic}_test.mjs`);
  console.log(topic);
  try {
    await inBrowser(browser, forage, sources, (tools) => test({ ...tools, step: (text) => console.log(`  ${seconds().padStart(5)} s  ${text}`) }));
    console.log(`  ${seconds().padStart(5)} s  all fine`);
  } catch (error) {
    console.log(`  ${seconds().padStart(5)} s  FAILED: ${error.stack}`);
    failed.push(topic);
  }
}
await browser.close();
if (failed.length) {
  console.log(`FAILED: ${failed.join(', ')}`);
  process.exit(1);
}
