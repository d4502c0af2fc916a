// The hand-written page of the studio. docs/design/studio-protocol.md describes the messages.
'use strict';
const $ = (id) => document.getElementById(id);
const replies = new Map();
const streams = new Map();  // number -> function that takes a chunk
let socket, next = 1, system, world, status, picture, frame = null, floor = null;

function send(command, members = {}) {
  const id = next++;
  socket.send(JSON.stringify({id, command, ...members}));
  return new Promise((resolve) => replies.set(id, resolve));
}
async function ask(command, members) {
  const reply = await send(command, members);
  $('problem').hidden = reply.ok;
  if (!reply.ok) $('problem').textContent = reply.problems.map((p) => p.message + (p.hint ? ` (${p.hint})` : '')).join('; ');
  return reply.ok ? reply.result : null;
}
async function watch(source, members, draw) {
  const result = await ask('subscribe', {source, ...members});
  if (result) streams.set(result.stream, draw);
  return result;
}

function decode(buffer) {
  const view = new DataView(buffer), n = view.getUint16(6, true), out = {seq: view.getUint32(8, true), epoch: view.getUint32(12, true), chunks: []};
  for (let i = 0; i < n; i++) {
    const at = 32 + 32 * i, type = view.getUint8(at + 12), offset = view.getUint32(at + 24, true), bytes = view.getUint32(at + 28, true);
    const Numbers = [Float32Array, Float64Array, Uint8Array][type];
    out.chunks.push({stream: view.getUint32(at, true), rows: view.getUint32(at + 4, true), columns: view.getUint32(at + 8, true),
      low: view.getFloat32(at + 16, true), high: view.getFloat32(at + 20, true),
      numbers: new Numbers(buffer, offset, bytes / Numbers.BYTES_PER_ELEMENT)});
  }
  return out;
}
const waiting = [];
function paint() {
  requestAnimationFrame(paint);
  if (!waiting.length) return;
  let seq = 0;
  for (const f of waiting.splice(0)) {
    seq = f.seq;
    for (const c of f.chunks) streams.get(c.stream)?.(c, f.epoch);
  }
  socket.send(JSON.stringify({command: 'ack', seq}));
}

function shade(v) { return `hsl(${260 - 200 * v} 80% ${15 + 65 * v}%)`; }
function figure(title) {
  const f = document.createElement('figure'), c = document.createElement('canvas'), t = document.createElement('figcaption');
  c.width = 400, c.height = 120, t.textContent = title, f.append(t, c), $('plots').prepend(f);
  return [c, t];
}
async function space(path) {
  const [canvas, caption] = figure(path), context = canvas.getContext('2d');
  await watch(path, {}, (c) => {
    canvas.width = c.columns * 8, canvas.height = c.rows * 8;
    const range = c.high > c.low ? c.high - c.low : 1;
    for (let i = 0; i < c.numbers.length; i++) {
      context.fillStyle = shade((c.numbers[i] - c.low) / range);
      context.fillRect(i % c.columns * 8, Math.floor(i / c.columns) * 8, 8, 8);
    }
    caption.textContent = `${path}: ${c.low.toPrecision(3)} to ${c.high.toPrecision(3)}`;
  });
}
async function time(path) {
  const source = `mean(${path})`, [canvas, caption] = figure(source), context = canvas.getContext('2d');
  let points = [], epoch = 0;
  await watch(source, {class: 'append'}, (c, e) => {
    if (e !== epoch) points = [], epoch = e;
    for (let i = 0; i < c.rows; i++) points.push(c.numbers[2 * i + 1]);
    points = points.slice(-1000);
    const low = Math.min(...points), high = Math.max(...points), range = high > low ? high - low : 1;
    context.clearRect(0, 0, 400, 120), context.beginPath(), context.strokeStyle = '#3478f6';
    points.forEach((v, i) => context.lineTo(i / points.length * 400, 115 - (v - low) / range * 110));
    context.stroke();
    caption.textContent = `${source}: ${low.toPrecision(3)} to ${high.toPrecision(3)}`;
  });
}

function arena(poses) {
  const canvas = $('arena'), context = canvas.getContext('2d'), [left, bottom, right, top] = world.view;
  const scale = canvas.width / (right - left);
  canvas.height = Math.round((top - bottom) * scale);
  const x = (v) => (v - left) * scale, y = (v) => (top - v) * scale;
  if (floor?.complete) context.drawImage(floor, 0, 0, canvas.width, canvas.height);
  context.fillStyle = '#f5c518';
  for (const [tx, ty] of world.targets) context.beginPath(), context.arc(x(tx), y(ty), .25 * scale, 0, 7), context.fill();
  for (let i = 0; i < poses.rows; i++) {
    const [px, py, , yaw, there] = poses.numbers.subarray(5 * i, 5 * i + 5);
    if (!there) continue;
    const robot = world.robots[i], radius = robot ? robot.radius : .15;
    context.fillStyle = robot ? '#1565c0' : '#888', context.strokeStyle = '#fff', context.lineWidth = 2;
    context.beginPath(), context.arc(x(px), y(py), radius * scale, 0, 7), context.fill();
    context.beginPath(), context.moveTo(x(px), y(py)), context.lineTo(x(px + radius * Math.cos(yaw)), y(py + radius * Math.sin(yaw))), context.stroke();
  }
}

async function parameters() {
  const found = await ask('parameters', {item: $('item').value});
  const body = $('parameters').tBodies[0];
  body.replaceChildren();
  for (const p of found?.parameters ?? []) {
    const row = body.insertRow(), input = document.createElement('input');
    input.value = p.value, input.title = p.doc, input.setAttribute('aria-label', p.label);
    input.onchange = () => ask('set', {assignments: [`${p.assignment}=${input.value}`]});
    row.insertCell().textContent = p.label;
    row.insertCell().append(input);
    row.insertCell().textContent = `${p.unit} ${p.low === null ? '' : `${p.low} to ${p.high}`}`;
  }
}

const handlers = {
  reply: (m) => { replies.get(m.id)?.(m), replies.delete(m.id); },
  system: (m) => {
    system = m, $('name').textContent = m.name;
    const groups = m.processes.flatMap((p) => p.groups.map((g) => g.path));
    $('group').replaceChildren(...groups.map((g) => new Option(g)));
    $('item').replaceChildren(...groups.map((g) => new Option(g)),
      ...m.processes.filter((p) => p.module).map((p) => new Option(p.name)), ...m.connections.map((c) => new Option(c.name, c.id)));
    parameters();
  },
  world: (m) => {
    world = m.file ? m : null;
    $('arena').parentElement.hidden = !world;
    if (!world) return;
    floor = new Image(), floor.src = m.picture;
    watch('world:poses', {}, arena);
  },
  status: (m) => {
    status = m, $('run').textContent = m.running ? 'Pause' : 'Run', $('undo').disabled = !m.undo, $('undo').title = m.undo ?? '';
    $('status').textContent = `cycle ${m.cycle}, ${m.seconds.toFixed(1)} s, ${m.cycles_per_second.toFixed(0)} cycles/s (${m.times_real_time.toFixed(1)} times real time)`
      + (m.trials ? `, trial ${m.trials.current.number}, ${m.trials.reached} of ${m.trials.finished} reached the target` : '') + (m.failed ? `; failed: ${m.failed}` : '');
  },
  action: (m) => { $('actions').textContent = `${m.title}\n  ${m.shell}\n  ${m.python}\n` + $('actions').textContent; },
  hello: (m) => { if (m.protocol !== 1) { $('problem').hidden = false, $('problem').textContent = 'This page is of another version: load it anew.'; } },
};
function connect() {
  socket = new WebSocket(`ws://${location.host}/ws`), socket.binaryType = 'arraybuffer';
  socket.onmessage = ({data}) => {
    if (typeof data !== 'string') return waiting.push(decode(data));
    const m = JSON.parse(data);
    handlers[m.type]?.(m);
  };
  socket.onclose = () => { $('status').textContent = 'the server is gone; trying again', streams.clear(), $('plots').replaceChildren(), setTimeout(connect, 1000); };
}
$('run').onclick = () => ask(status?.running ? 'pause' : 'run');
$('step').onclick = () => ask('step');
$('stop').onclick = () => ask('stop');
$('undo').onclick = () => ask('undo').then(parameters);
$('speed').onchange = () => { const [mode, value] = $('speed').value.split(' '); ask('speed', {mode, value: Number(value)}); };
$('space').onclick = () => space($('group').value);
$('time').onclick = () => time($('group').value);
$('item').onchange = parameters;
connect(), requestAnimationFrame(paint);
