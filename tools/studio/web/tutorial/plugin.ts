// The module `virtual:tutorial`: the pages of docs/tutorial as HTML, with their pictures as assets.
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Plugin } from 'vite';
import { makePage } from './page';

/** The parts and the appendix, in their order. */
const partsOf = (folder: string) => readdirSync(folder).flatMap((file) => /^((?:\d|appendix)\S*)\.md$/.exec(file)?.[1] ?? []).sort();

/** `folder` is docs/tutorial. */
export function tutorial(folder: string): Plugin {
  return {
    name: 'tutorial',
    resolveId: (id) => (id === 'virtual:tutorial' ? '\0virtual:tutorial' : undefined),
    load(id) {
      if (id !== '\0virtual:tutorial') return undefined;
      const imports: string[] = [];
      const ids = partsOf(folder);
      const pages = ids.map((name) => {
        const file = join(folder, `${name}.md`);
        this.addWatchFile(file);
        const { title, html, setups, pictures } = makePage(name, readFileSync(file, 'utf8'), ids);
        const pieces = html.split(/(?<=src=")picture:[^"]+/).map((p) => JSON.stringify(p));
        const urls = pictures.map((p) => {
          imports.push(`import p${imports.length} from ${JSON.stringify(`${join(folder, 'pictures', p)}?url`)};`);
          return `p${imports.length - 1}`;
        });
        const text = pieces.map((p, i) => (i ? `${urls[i - 1]} + ${p}` : p)).join(' + ');
        return `{ id: ${JSON.stringify(name)}, title: ${JSON.stringify(title)}, html: ${text}, setups: ${JSON.stringify(setups)} }`;
      });
      return `${imports.join('\n')}\nexport const pages = [${pages.join(',\n')}];\n`;
    },
  };
}
