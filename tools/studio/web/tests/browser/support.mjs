// A studio with a page in Chromium, for tests. Exit code 77: skipped, as there is no browser.
import { spawn } from 'node:child_process';
import { cpSync, existsSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import assert from 'node:assert/strict';

// What waits is patient: tests run on machines that do much else.
const patience = 30000;

const browserPath = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find((p) => existsSync(p));
if (!browserPath) {
  console.log('SKIPPED: there is no Chromium');
  process.exit(77);
}
const { chromium } = await import('playwright-core');

/** Starts `forage studio` in `folder`, which also has its state. The address is a promise. */
export function startStudio(forage, folder, args = ['systems/dac_foraging.iqr', '--world', 'systems/worlds/basic_arena.world']) {
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

/** Calls `test` with a folder that has the systems, the context of a browser (with further options) and what waits for a condition in a page. */
export async function inBrowser(sources, test, options = ['--disable-gpu']) {
  const folder = mkdtempSync(join(tmpdir(), 'forage-page-'));
  cpSync(join(sources, 'systems'), join(folder, 'systems'), { recursive: true });
  let browser;
  const studios = [];
  try {
    browser = await chromium.launch({ executablePath: browserPath, args: ['--no-sandbox', ...options, '--disable-background-networking', '--disable-dev-shm-usage'] });
    const context = await browser.newContext({ viewport: { width: 1400, height: 900 }, colorScheme: 'light' });
    context.setDefaultTimeout(patience);
    const start = (forage, args) => {
      studios.push(startStudio(forage, folder, args));
      return studios[studios.length - 1];
    };
    const until = (page, what, condition, argument) => page.waitForFunction(condition, argument, { timeout: patience, polling: 100 }).catch(() => assert.fail(`waited in vain: ${what}`));
    await test({ folder, context, start, until });
  } finally {
    await browser?.close();
    for (const s of studios) {
      s.child.removeAllListeners('exit');
      s.child.kill('SIGKILL');
    }
    rmSync(folder, { recursive: true, force: true });
  }
}
