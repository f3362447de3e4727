// bundle.mjs PACKAGES PAGE: makes one HTML file of this folder and of what it takes from the packages, with their licences.
import { readFileSync, readdirSync, renameSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const [packages, page] = process.argv.slice(2).map((path) => resolve(path));
const here = dirname(fileURLToPath(import.meta.url));
const modules = join(packages, 'node_modules');
const esbuild = createRequire(join(packages, 'package.json'))('esbuild');

const common = { bundle: true, minify: true, write: false, metafile: true, nodePaths: [modules], legalComments: 'none' };
const script = esbuild.buildSync({ ...common, entryPoints: [join(here, 'main.js')], format: 'iife', charset: 'utf8', target: 'es2022' });
const style = esbuild.buildSync({ ...common, entryPoints: [join(here, 'page.css')] });

// "node_modules/@kitware/vtk.js/macros.js" -> "@kitware/vtk.js"
const packageOf = (file) => /.*node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(file)?.[1];
const used = new Set([script, style].flatMap((result) => Object.keys(result.metafile.inputs).map(packageOf).filter(Boolean)));

const licenceOf = (name) => {
  const folder = join(modules, name);
  const { version, license } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
  const texts = readdirSync(folder).filter((entry) => /^(licen[cs]e|copyright)/i.test(entry)).map((entry) => readFileSync(join(folder, entry), 'utf8').trim());
  return `${name} ${version} (${license})\n\n${texts.join('\n\n')}\n`;
};
const escaped = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;');
const licences = escaped([...used].sort().map(licenceOf).join('\n----------\n\n'));

// A script ends at the first "</script", wherever it stands.
const text = script.outputFiles[0].text.replaceAll('</script', '<\\/script');
const parts = { STYLE: style.outputFiles[0].text, SCRIPT: text, LICENCES: licences };
const html = readFileSync(join(here, 'page.html'), 'utf8').replace(/@PAGE_(STYLE|SCRIPT|LICENCES)@/g, (_, part) => parts[part]);

writeFileSync(`${page}.part`, html);
renameSync(`${page}.part`, page);
