// Notes which functions a first visit calls: node first_visit.mjs PROGRAM INSTRUMENTED PROFILE. PROGRAM.mjs and PROGRAM.data are those of the
// studio for browsers, INSTRUMENTED is its WebAssembly as wasm-split has instrumented it. What is not called goes into a file of its own,
// which browsers load while the robot already runs (../web/src/browser/engine.ts).
import { readFileSync, writeFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [, , program, instrumented, profile] = process.argv, script = pathToFileURL(`${resolve(program)}.mjs`);
// The program runs in workers only.
Object.assign(globalThis, { self: globalThis, WorkerGlobalScope: Object, location: script });
const { default: create } = await import(script);
let exports;
const engine = await create({
  getPreloadedPackage: () => new Uint8Array(readFileSync(`${program}.data`)).buffer,
  instantiateWasm: (imports, done) =>
    void WebAssembly.instantiate(readFileSync(instrumented), imports).then(({ instance, module }) => {
      ({ exports } = instance);
      done(instance, module);
    }),
});

/** What the page sends when it opens and Run is pressed. */
let id = 0;
const send = (command, given = {}) => engine.ccall('forage_receive', null, ['string'], [JSON.stringify({ id: ++id, command, ...given })]);
const messages = [];
globalThis.postMessage = (data) => {
  if (typeof data === 'string') messages.push(JSON.parse(data));
  else messages.push({ type: 'frame', seq: new DataView(data).getUint32(8, true) });
};
function work(times) {
  for (let n = 0; n < times; n++) {
    engine.ccall('forage_work', 'number', [], []);
    for (const { type, seq } of messages.splice(0)) if (type === 'frame') send('ack', { seq });
  }
}
const wrong = engine.ccall('forage_open', 'string', ['string', 'string'], ['/forage/systems/dac_foraging.iqr', '/forage/systems/worlds/basic_arena.world']);
if (wrong) throw new Error(wrong);
work(1);
send('item', { item: 'system' });
send('world_document');
send('types');
for (const source of ['Bug/Motor:act', 'Bug/Motor', 'Bug/Light', 'world:poses', 'world:rays:Bug']) send('subscribe', { source, delivery: 'latest', every: 1 });
for (const source of ['world:trail:Bug', 'mean(Bug/Motor)']) send('subscribe', { source, delivery: 'append', every: 1 });
send('panels_keep', { content: { dock: {} } });
send('run');
work(20);
send('speed', { mode: 'free' });
work(2000); // several trials
send('pause');
work(1);

// The memory has a page that nothing else uses.
const memory = Object.values(exports).find((e) => e instanceof WebAssembly.Memory), size = exports.__write_profile(0, 0), at = memory.buffer.byteLength;
memory.grow(Math.ceil(size / 65536));
exports.__write_profile(at, size);
writeFileSync(profile, new Uint8Array(memory.buffer, at, size));
