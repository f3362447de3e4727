// browser.mjs PAGE WIDTH HEIGHT FOLDER: opens a report in Chromium without a display, uses it as a reader would, puts
// pictures into FOLDER and prints what was seen as JSON. Speaks the DevTools protocol through a pipe: no package needed.
import { spawn } from 'node:child_process';
import { accessSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [page, width, height, folder] = process.argv.slice(2);
const kPatience = 120e3;  // [ms]
accessSync(page);

const profile = mkdtempSync(join(tmpdir(), 'articular-browser-'));
const browser = spawn(process.env.ARTICULAR_CHROMIUM ?? 'chromium', [
  '--headless=new', '--no-sandbox', '--remote-debugging-pipe', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
  '--disable-dev-shm-usage', '--no-first-run', '--disable-extensions', '--disable-background-networking', `--user-data-dir=${profile}`,
], { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });

/** The browser ends by itself, else it is killed; some of its processes write into the profile a little longer. */
async function finish(code) {
  clearTimeout(limit);
  const gone = new Promise((done) => browser.once('exit', done));
  session = undefined;
  call('Browser.close').catch(() => {});
  setTimeout(() => browser.kill('SIGKILL'), 5e3).unref();
  await gone;
  rmSync(profile, { recursive: true, force: true, maxRetries: 20, retryDelay: 100 });
  process.exit(code);
}
function fail(what) {
  console.error(`browser.mjs: ${what}`);
  finish(1);
}
const limit = setTimeout(() => fail(`not done after ${kPatience / 1e3} s`), kPatience);
browser.once('error', (error) => {
  console.error(`browser.mjs: chromium can't be started: ${error.message}`);
  process.exit(1);
});

let [session, count, rest] = [undefined, 0, ''];
const waiting = new Map();
const listeners = [];

function take(message) {
  if (message.id === undefined) return listeners.forEach((listen) => listen(message));
  const { done, refuse } = waiting.get(message.id);
  waiting.delete(message.id);
  return message.error ? refuse(new Error(message.error.message)) : done(message.result);
}
browser.stdio[4].on('data', (chunk) => {
  const messages = (rest + chunk).split('\0');
  rest = messages.pop();
  messages.forEach((text) => take(JSON.parse(text)));
});
function call(method, params = {}) {
  const id = ++count;
  browser.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId: session })}\0`);
  return new Promise((done, refuse) => waiting.set(id, { done, refuse }));
}

async function evaluate(expression) {
  const { result, exceptionDetails } = await call('Runtime.evaluate', { expression, returnByValue: true, awaitPromise: true });
  if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
  return result.value;
}
const twoFrames = () => evaluate('new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))');

async function picture(name, selector) {
  await twoFrames();
  const clip = selector
    ? await evaluate(`(() => { const b = document.querySelector('${selector}').getBoundingClientRect(); return { x: b.x + scrollX, y: b.y + scrollY, width: b.width, height: b.height, scale: 1 }; })()`)
    : undefined;
  const { data } = await call('Page.captureScreenshot', { clip, captureBeyondViewport: true });
  writeFileSync(join(folder, `${name}.png`), Buffer.from(data, 'base64'));
}

const setValue = (selector, value) => evaluate(`(() => { const e = document.querySelector(${JSON.stringify(selector)}); if (!e) return false; e.value = '${value}';
  e.dispatchEvent(new Event('input', { bubbles: true })); e.dispatchEvent(new Event('change', { bubbles: true })); return true; })()`);

async function click(selector) {
  await evaluate(`document.querySelector('${selector}').scrollIntoView({ block: 'center' })`);
  const [x, y] = await evaluate(`(() => { const b = document.querySelector('${selector}').getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; })()`);
  for (const type of ['mousePressed', 'mouseReleased']) await call('Input.dispatchMouseEvent', { type, x, y, button: 'left', clickCount: 1 });
  await twoFrames();
}

const inkOfPlots = `[...document.querySelectorAll('.plot:not([hidden]) canvas')].map((canvas) => {
  const data = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
  let coloured = 0;
  for (let i = 0; i < data.length; i += 4) coloured += data[i + 3] > 0 && Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]) > 60;
  return coloured;
})`;

async function look() {
  const { targetId } = await call('Target.createTarget', { url: 'about:blank' });
  session = (await call('Target.attachToTarget', { targetId, flatten: true })).sessionId;
  const errors = [], requests = [];
  listeners.push(({ method, params }) => {
    if (method === 'Runtime.exceptionThrown') errors.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
    if (method === 'Runtime.consoleAPICalled' && ['error', 'warning', 'assert'].includes(params.type)) errors.push(params.args.map((one) => one.value ?? one.description).join(' '));
    if (method === 'Log.entryAdded' && params.entry.level === 'error') errors.push(params.entry.text);
    if (method === 'Network.requestWillBeSent' && !/^(data|blob):/.test(params.request.url)) requests.push(params.request.url);
  });
  for (const domain of ['Page', 'Runtime', 'Log', 'Network']) await call(`${domain}.enable`);
  await call('Emulation.setDeviceMetricsOverride', { width: Number(width), height: Number(height), deviceScaleFactor: 1, mobile: Number(width) < 600 });
  await call('Emulation.setScrollbarsHidden', { hidden: true });  // pictures of the page and of its parts agree
  await call('Page.navigate', { url: pathToFileURL(resolve(page)).href });
  let state;
  while (state !== 'ready' && state !== 'failed') {
    await new Promise((done) => setTimeout(done, 100));
    state = await evaluate('document.documentElement?.dataset.state');
  }

  const seen = { state };
  seen.width = await evaluate('[document.documentElement.scrollWidth, innerWidth]');
  seen.sections = await evaluate("[...document.querySelectorAll('section')].map((section) => section.id)");
  seen.text = await evaluate('document.body.innerText');
  seen.inkOfPlots = await evaluate(inkOfPlots);
  seen.widthsOfPictures = await evaluate("[...document.querySelectorAll('img')].map((image) => image.naturalWidth)");
  await picture('page');
  if (await evaluate("document.querySelector('.stage') !== null")) {
    seen.legend = await evaluate("document.querySelector('.legend').innerText");
    await picture('last', '.stage');
    await click('.stage');
    seen.readout = await evaluate("document.querySelector('.readout').innerText");
    if (await setValue('.time input', 0)) await picture('first', '.stage');
    await setValue('select[name=cut]', 0);
    await picture('cut', '.stage');
    await setValue('select[name=cut]', '');
    // All values lie above this range, so that all have the colour of its upper end.
    await evaluate("document.querySelector('input[name=shading]').click()");
    if (await setValue("[aria-label='lowest colour']", -2)) {
      await setValue("[aria-label='highest colour']", -1);
      await picture('above', '.stage');
    }
  }
  return { ...seen, errors, requests: requests.filter((url) => !url.startsWith('file:')) };
}

look().then((seen) => {
  console.log(JSON.stringify(seen));
  finish(0);
}, (error) => fail(error.message));
