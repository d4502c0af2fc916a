// Serves the studio from the files that the browser has kept, also without a network. ../../../wasm/offline.mjs puts the constants in front.
declare const version: string;
/** The paths of all files of this version, each with its digest. */
declare const files: Record<string, string>;

interface ExtendableEvent extends Event {
  waitUntil(done: Promise<unknown>): void;
}
interface FetchEvent extends Event {
  request: Request;
  respondWith(response: Promise<Response>): void;
}

// The studio of another folder of the same server has caches, too.
const scope = new URL('./', self.location.href).href, kept = `${scope}#${version}`;

/** All files or none: each has its digest, so a server that is being updated leaves no mixture. */
async function keep(): Promise<void> {
  const cache = await caches.open(kept);
  await cache.addAll(Object.entries(files).map(([path, integrity]) => new Request(scope + path, { cache: 'no-cache', integrity }))).catch(async (error) => {
    await caches.delete(kept);
    throw error;
  });
}

async function forgetOthers(): Promise<void> {
  for (const name of await caches.keys()) if (name.startsWith(`${scope}#`) && name !== kept) await caches.delete(name);
}

/** A cache is there as a whole; when the browser has removed it, all files come from the server. */
async function answer(request: Request, path: string): Promise<Response> {
  return (await caches.match(scope + path, { cacheName: kept })) ?? fetch(request);
}

// The browser begins to use another version when the last tab with this one is closed.
addEventListener('install', (event) => (event as ExtendableEvent).waitUntil(keep()));
addEventListener('activate', (event) => (event as ExtendableEvent).waitUntil(forgetOthers()));
addEventListener('fetch', (event) => {
  const { request, respondWith } = event as FetchEvent;
  const address = request.url.replace(/[?#].*$/, ''), path = address.startsWith(scope) ? address.slice(scope.length).replace(/^index\.html$/, '') : null;
  if (request.method === 'GET' && path !== null && path in files) respondWith.call(event, answer(request, path));
});
