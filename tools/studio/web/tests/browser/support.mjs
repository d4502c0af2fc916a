// A studio with pages in Chromium, for tests and pictures. Exit code 77: skipped, as there is no browser.
import { spawn } from 'node:child_process';
import { cpSync, createReadStream, existsSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { extname, join, normalize } from 'node:path';
import assert from 'node:assert/strict';

// What waits is patient: tests run on machines that do much else.
const patience = 60000;
const axe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

/** Chromium, for all topics; its shell without windows is half as busy. WebGL is drawn without a graphics card, which would take thirty times as long for all else. */
export async function launch() {
  const executablePath = ['/usr/bin/chromium-headless-shell', '/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find((p) => existsSync(p));
  if (!executablePath) {
    console.log('SKIPPED: there is no Chromium');
    process.exit(77);
  }
  const { chromium } = await import('playwright-core');
  return chromium.launch({ executablePath, args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-gpu-compositing', '--disable-background-networking', '--disable-dev-shm-usage'] });
}

const types = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.svg': 'image/svg+xml', '.png': 'image/png' };
/** Serves the files of a site (tools/web) until `close()` or the end of the test, at a free port or at the one of `address`, which is that of the studio. */
export async function serve(site, address = 'http://127.0.0.1:0') {
  const server = createServer(({ url }, response) => {
    const path = join(site, normalize(new URL(url, 'http://x').pathname).replace(/\/$/, '/index.html'));
    if (!existsSync(path) || statSync(path).isDirectory()) return response.writeHead(404).end();
    response.writeHead(200, { 'Content-Type': types[extname(path)] ?? 'application/octet-stream' });
    createReadStream(path).pipe(response);
  });
  await new Promise((ready) => server.listen(new URL(address).port, '127.0.0.1', ready));
  server.unref();
  const close = () => new Promise((closed) => (server.close(closed), server.closeAllConnections()));
  return { address: `http://127.0.0.1:${server.address().port}/studio/`, close };
}

const usual = ['systems/dac_foraging.iqr', '--world', 'systems/worlds/basic_arena.world'];

/** The browser of that name: Firefox, or by default Chromium. */
export async function launchNamed(name) {
  const { firefox } = await import('playwright-core');
  return name === 'firefox' ? firefox.launch({ channel: 'moz-firefox', executablePath: '/usr/bin/firefox-esr' }) : launch();
}

/** Where the studio without a server has the files of its user. */
const home = '/home/web_user';

/** The studio without a server, where the browser keeps the files of `folder`, with the first system of `args` and its world. */
async function startInBrowser(site, folder, context, args = usual) {
  const { address } = await serve(site), world = args.includes('--world') ? args[args.indexOf('--world') + 1] : '';
  const texts = ['', 'systems', 'systems/worlds'].flatMap((inside) => readdirSync(join(folder, inside), { withFileTypes: true }).flatMap((f) => (f.isFile() ? [join(inside, f.name)] : [])));
  const files = Object.fromEntries(texts.map((f) => [`${home}/${f}`, readFileSync(join(folder, f), 'utf8')]));
  // Each studio has an address of its own, so they do not share what the browser keeps.
  await context.addInitScript(([studio, opened]) => location.href.startsWith(studio) && (window.opened = opened), [address, { system: `${home}/${args[0]}`, world: world && `${home}/${world}`, files }]);
  return `${address}?system=${args[0].replace('systems/', '')}&world=${world.replace('systems/worlds/', '')}`; // for a page that keeps nothing
}

/** Starts `forage studio` in `folder`, which also has its state. The address is a promise. */
export function startStudio(forage, folder, args = usual) {
  const child = spawn(forage, ['studio', ...args], { cwd: folder, env: { ...process.env, XDG_STATE_HOME: join(folder, 'state') } });
  const address = new Promise((resolve, reject) => {
    let text = '';
    const read = (chunk) => {
      text += chunk;
      const found = /http:\/\/\S+/.exec(text);
      if (found) resolve(found[0]);
    };
    child.stdout.on('data', read);
    child.stderr.on('data', read);
    child.on('exit', () => reject(new Error(`the studio ended:\n${text}`)));
  });
  return { child, address };
}

/** Whether a condition holds in the page, sooner or later. */
export const until = (page, what, condition, argument) => page.waitForFunction(condition, argument, { timeout: patience }).catch((e) => assert.fail(`waited in vain: ${what} (${e.message})`));

/** Whether a condition outside of the page holds, sooner or later. */
export async function eventually(what, condition) {
  for (const end = performance.now() + patience; !(await condition()); await new Promise((done) => setTimeout(done, 20))) assert.ok(performance.now() < end, `waited in vain: ${what}`);
}

/** Waits until a browser without a server keeps the session as it was at a time, or later. */
export const sessionIsKept = (page, since) =>
  eventually('the session is kept', () =>
    page.evaluate((time) =>
      new Promise((done) => {
        indexedDB.open('/home/web_user').onsuccess = ({ target: { result: all } }) => {
          all.transaction('FILE_DATA').objectStore('FILE_DATA').openCursor().onsuccess = ({ target: { result: file } }) => {
            const found = file?.key.endsWith('/running.forage') && file.value.timestamp >= time;
            if (file && !found) return file.continue();
            all.close();
            done(found === true);
          };
        };
      }), since));

/** Types into Ctrl+K, and takes the first that is found. */
export async function find(page, text) {
  await page.keyboard.press('Control+k');
  await until(page, 'the field of Ctrl+K', () => document.activeElement?.matches('dialog[aria-label="Find"] input'));
  await page.keyboard.insertText(text);
  await page.keyboard.press('Enter');
  await until(page, 'the keys are those of the page again', () => !document.activeElement?.closest('dialog[aria-label="Find"]'));
}

/** axe finds no fault of accessibility. Dockview's own tabs hold a close button, which axe calls nested. */
export async function accessible(page, what) {
  if (!(await page.evaluate(() => 'axe' in window))) await page.evaluate(axe);
  const found = await page.evaluate(async () => (await window.axe.run({ exclude: ['.dv-tab'] }, { resultTypes: ['violations'] })).violations.map((v) => `${v.id}: ${v.nodes.slice(0, 3).map((n) => n.html.slice(0, 200)).join(' | ')}`));
  assert.deepEqual(found, [], what);
}

/** Waits until the page has what the server says of all that it was sent: what came of it is not still under way. */
export const answered = (page) =>
  page.evaluate(() =>
    new Promise((done) => {
      const id = 1e9 + Math.floor(1e9 * Math.random());
      const listen = ({ data }) => {
        if (typeof data !== 'string' || JSON.parse(data).id !== id) return;
        window.socket.removeEventListener('message', listen);
        setTimeout(done); // the page has drawn it
      };
      window.socket.addEventListener('message', listen);
      window.socket.send(JSON.stringify({ id, command: 'settings' }));
    })
  );
/** How often the page has sent a command. */
export const sent = (page, command) => page.evaluate((c) => window.sent.filter((s) => s === c).length, command);
/** Waits until the page has sent a command more often than `before`, and it was answered. */
export async function answeredTo(page, command, before) {
  await until(page, `the command ${command}`, ([c, n]) => window.sent.filter((s) => s === c).length > n, [command, before]);
  await answered(page);
}
/** How many frames of numbers have arrived; in the page it is `frames_`. */
export const frames = (page) => page.evaluate(() => window.frames_);
// Each page counts what goes over its socket, or to the worker in its place.
function watchSocket() {
  window.sent = [];
  window.frames_ = 0;
  window.WebSocket = class extends WebSocket {
    constructor(...given) {
      super(...given);
      window.socket = this;
      this.addEventListener('message', ({ data }) => (window.frames_ += typeof data !== 'string'));
    }
    send(data) {
      window.sent.push(JSON.parse(data).command);
      super.send(data);
    }
  };
  window.Worker = class extends Worker {
    constructor(...given) {
      super(...given);
      window.socket = this;
      this.addEventListener('message', ({ data }) => (window.frames_ += data instanceof ArrayBuffer));
    }
    postMessage(data) {
      if (typeof data === 'string') window.sent.push(JSON.parse(data).command);
      if (data.open && window.opened && !sessionStorage.opened) { // a page that is loaded again knows it
        data = { open: { ...data.open, ...window.opened } };
        sessionStorage.opened = true;
      }
      super.postMessage(data);
    }
    send(data) {
      this.postMessage(data);
    }
  };
}

// Playwright looks for an element every half second, after the first tries. With shorter limits, it looks every 50 ms.
function lookOften(locator) {
  const prototype = Object.getPrototypeOf(locator), { waitFor } = prototype;
  if (prototype.looksOften) return;
  prototype.looksOften = true;
  prototype.waitFor = async function(options) {
    const end = performance.now() + patience;
    for (let timeout = 400;; timeout *= 2)
      try {
        return await waitFor.call(this, { timeout, ...options });
      } catch (error) {
        if (error.name !== 'TimeoutError' || performance.now() > end) throw error;
      }
  };
  // What acts on an element waits for it in the same way.
  for (const act of ['click', 'dblclick', 'fill', 'press', 'selectOption', 'focus', 'innerText', 'textContent', 'inputValue']) {
    const { [act]: then } = prototype;
    prototype[act] = async function(...given) {
      await this.first().waitFor({ state: 'attached' });
      return then.apply(this, given);
    };
  }
}

/** Calls `test` with a folder of its own that has the systems, a fresh context of the browser, and what starts studios and opens their pages. */
export async function inBrowser(browser, forage, sources, test) {
  const folder = mkdtempSync(join(tmpdir(), 'forage-page-'));
  cpSync(join(sources, 'systems'), join(folder, 'systems'), { recursive: true });
  const context = await browser.newContext({ viewport: { width: 1400, height: 900 }, colorScheme: 'light' });
  context.setDefaultTimeout(patience);
  await context.addInitScript(watchSocket);
  const studios = [], faults = [], addresses = new Map();
  context.on('page', (page) => {
    page.on('pageerror', (e) => faults.push(e.message));
    page.on('console', (m) => m.type() === 'error' && faults.push(m.text()));
  });
  const site = statSync(forage).isDirectory();
  const start = (args) => {
    if (site) return { address: startInBrowser(forage, folder, context, args) };
    studios.push(startStudio(forage, folder, args));
    return studios[studios.length - 1];
  };
  /** A page that shows the address, or the last studio of this origin; `size` is that of its window. */
  const open = async (address, size) => {
    const { origin, search, hash } = new URL(address);
    if (search || hash) addresses.set(origin, address);
    const page = await context.newPage();
    lookOften(page.locator('body'));
    if (size) await page.setViewportSize(size);
    await page.goto(addresses.get(origin));
    return page;
  };
  /** The path of a file that the studio has written, named as from `folder`. */
  const onDisk = async (page, name) => {
    const path = join(folder, name);
    if (!site) return path;
    const text = await page.evaluate((file) =>
      new Promise((done, failed) => {
        const listen = ({ data }) => {
          if (data.content) done(new TextDecoder().decode(data.content));
          else if (data.refused) failed(new Error(data.refused));
          else return;
          window.socket.removeEventListener('message', listen);
        };
        window.socket.addEventListener('message', listen);
        window.socket.postMessage({ read: file });
      }), `${home}/${name}`);
    writeFileSync(path, text);
    return path;
  };
  try {
    // Beside the site is the command line, for Node.
    await test({ forage: site ? join(forage, '../forage') : forage, site, folder, context, faults, start, open, onDisk });
  } catch (error) {
    for (const [i, page] of context.pages().entries()) await picture(page, `failed-${i}`);
    throw error;
  } finally {
    await context.close();
    for (const s of studios) {
      s.child.removeAllListeners('exit');
      s.child.kill('SIGKILL');
    }
    rmSync(folder, { recursive: true, force: true });
  }
}

/** Keeps a picture of the page, for whoever looks at FORAGE_PICTURES. */
export const picture = async (page, name) => {
  if (process.env.FORAGE_PICTURES) await page.screenshot({ path: join(process.env.FORAGE_PICTURES, `${name}.png`) });
};
