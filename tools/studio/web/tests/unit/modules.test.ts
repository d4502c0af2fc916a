// How the modules of the page depend on each other.
import { expect, it } from 'vitest';

const sources = import.meta.glob<string>(['../../src/**/*.{ts,svelte}', './*.ts', '../../tutorial/*.ts'], { query: '?raw', import: 'default', eager: true });
const files = new Map(Object.entries(sources).map(([path, text]) => [path.startsWith('./') ? `tests/unit/${path.slice(2)}` : path.slice('../../'.length), text]));

function resolve(from: string, path: string): string | undefined {
  const file = new URL(path, `file:///${from}`).pathname.slice(1);
  return [file, `${file}.ts`].find((f) => files.has(f));
}

type Import = { file: string; names: string[] };

/** The modules that a module needs when it is loaded, or only for its types. */
const imports = new Map(
  [...files].map(([from, text]) => [
    from,
    [...text.matchAll(/\bimport\s([^;'"]*?)from\s+'(\.[^']*)'/g)].flatMap(([, names, path]): Import[] => {
      const file = resolve(from, path!);
      return file ? [{ file, names: names!.match(/\w+/g) ?? [] }] : [];
    }),
  ]),
);
/** The modules that are loaded later, as a whole. */
const loadedLater = new Set([...files].flatMap(([from, text]) => [...text.matchAll(/\bimport\('(\.[^']*)'\)/g)].map(([, path]) => resolve(from, path!))));

it('has no import cycles', () => {
  const visited = new Set<string>(), cycles: string[] = [];
  function visit(file: string, path: string[]) {
    if (path.includes(file)) cycles.push([...path.slice(path.indexOf(file)), file].join(' -> '));
    if (visited.has(file)) return;
    visited.add(file);
    for (const next of imports.get(file)!) visit(next.file, [...path, file]);
  }
  for (const file of files.keys()) visit(file, []);
  expect(cycles).toEqual([]);
});

it('has no unused exports', () => {
  const used = new Set([...imports.values()].flat().flatMap(({ file, names }) => names.map((name) => `${file} ${name}`)));
  // The protocol has all types of the server's messages, whether the page uses them or not.
  const checked = [...files].filter(([file]) => /^src\/(?!protocol\/).*(?<!\.d)\.ts$/.test(file) && !loadedLater.has(file));
  const exported = checked.flatMap(([file, text]) => [...text.matchAll(/^export (?:async )?(?:const|let|function\*?|class|interface|type) (\w+)/gm)].map(([, name]) => `${file} ${name}`));
  expect(exported.filter((name) => !used.has(name))).toEqual([]);
});
