// The simulator: WebAssembly in two parts. The first has what a first visit calls; the second one follows while the robot already runs.
export interface Engine {
  ccall(name: string, result: 'string' | 'number' | null, types: 'string'[], values: string[]): unknown;
  FS: {
    mkdirTree(path: string): void;
    mount(kind: unknown, options: { autoPersist: boolean }, path: string): void;
    syncfs(load: boolean, done: (error: unknown) => void): void;
    chdir(path: string): void;
    readFile(path: string): Uint8Array;
    writeFile(path: string, content: string | Uint8Array): void;
    analyzePath(path: string): { exists: boolean; object: unknown };
    rename(from: string, to: string): void;
    hashRemoveNode(file: unknown): void;
  };
  IDBFS: unknown;
}

/** The address of a file beside the page. */
export const address = (file: string) => new URL(`../${file}`, self.location.href).href;

/** Some servers give WebAssembly another type, which browsers do not compile while it arrives. */
const compile = (file: string): Promise<WebAssembly.Module> => WebAssembly.compileStreaming(fetch(address(file))).catch(async () => WebAssembly.compile(await (await fetch(address(file))).arrayBuffer()));

const rest = 'forage-web.rest.wasm';
const first = compile('forage-web.wasm');
let exports: WebAssembly.Exports;
let whole = false;

function add(module: WebAssembly.Module): void {
  if (!whole) new WebAssembly.Instance(module, { primary: exports });
  whole = true;
}

/** Loads the other part, as soon as the first one is there. */
export async function loadRest(): Promise<void> {
  const module = await compile(rest);
  await loadEngine();
  add(module);
}

/** Loads it at once, for a call that cannot wait. */
function loadRestNow(): void {
  const request = new XMLHttpRequest();
  request.open('GET', address(rest), false);
  request.responseType = 'arraybuffer';
  request.send();
  add(new WebAssembly.Module(request.response as ArrayBuffer));
}

/** What calls of functions in the other part do until it is there; their names are their places in the last table. */
const placeholder = new Proxy({}, {
  get: (_, place: string) => (...values: unknown[]) => {
    loadRestNow();
    const tables = Object.values(exports).filter((e) => e instanceof WebAssembly.Table);
    return tables.at(-1)!.get(Number(place))(...values);
  },
});

let engine: Promise<Engine> | undefined;
export const loadEngine = (): Promise<Engine> => (engine ??= load());

async function load(): Promise<Engine> {
  const { default: create } = (await import(/* @vite-ignore */ address('forage-web.mjs'))) as { default(options: object): Promise<Engine> };
  const created = create({
    locateFile: address,
    instantiateWasm: (imports: WebAssembly.Imports, done: (instance: WebAssembly.Instance, module: WebAssembly.Module) => void) => {
      void first.then(async (module) => {
        const instance = await WebAssembly.instantiate(module, { ...imports, placeholder });
        exports = instance.exports;
        done(instance, module);
      });
      return {};
    },
  });
  const [engine] = await Promise.all([created, first]);
  forgetReplaced(engine.FS);
  return engine;
}

/** Emscripten keeps a file that another one replaces, for ever: it is found again when the new one is deleted. */
function forgetReplaced(files: Engine['FS']): void {
  const { rename } = files;
  files.rename = (from, to) => {
    const replaced = files.analyzePath(to).object;
    rename(from, to);
    if (replaced && replaced !== files.analyzePath(to).object) files.hashRemoveNode(replaced);
  };
}
