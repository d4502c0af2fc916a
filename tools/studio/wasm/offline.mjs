// Lets browsers keep a studio made of static files: node offline.mjs FOLDER writes its service worker, which names all files with their digests.
import { createHash } from 'node:crypto';
import { readdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

const folder = process.argv[2], script = 'service_worker.js';
const digest = (content) => createHash('sha256').update(content).digest('base64');
const paths = readdirSync(folder, { recursive: true }).filter((p) => statSync(join(folder, p)).isFile() && !p.startsWith('licences') && !p.endsWith(script)).sort();
// Some servers redirect from index.html to its folder, and pages must not come from such an answer.
const files = Object.fromEntries(paths.map((p) => [p === 'index.html' ? '' : p, `sha256-${digest(readFileSync(join(folder, p)))}`]));
const code = readFileSync(join(folder, 'assets', script), 'utf8');
writeFileSync(join(folder, script), `const version = ${JSON.stringify(digest(JSON.stringify(files) + code))}, files = ${JSON.stringify(files)};\n${code}`);
