// SPDX-License-Identifier: GPL-3.0-or-later
// Bundles src/ into one self-contained page template: page.html with its style and its compressed script inlined.
// `crackle report` and `crackle view` replace its markers by a manifest, the first block of each test, and all other blocks.
//   node build.mjs [output file, default dist/page.html]
import {build} from 'esbuild';
import {mkdir, readFile, writeFile} from 'node:fs/promises';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';
import {deflateSync} from 'node:zlib';

const here = dirname(fileURLToPath(import.meta.url));
const output = process.argv[2] ?? join(here, 'dist', 'page.html');

async function bundle(entry, options) {
    const result = await build({
        entryPoints: [join(here, 'src', entry)],
        bundle: true,
        minify: true,
        write: false,
        target: ['es2022', 'chrome100', 'firefox113', 'safari16.4'],
        charset: 'utf8',
        legalComments: 'inline',
        logLevel: 'warning',
        ...options,
    });
    return result.outputFiles[0].text;
}

const script = await bundle('main.ts', {format: 'iife'});
const loader = await bundle('loader.ts', {format: 'iife'});
const style = await bundle('style.css', {});
const template = await readFile(join(here, 'src', 'page.html'), 'utf8');

const filled = template
    .replace('@CRACKLE_STYLE@', () => style.trim())
    .replace('@CRACKLE_SCRIPT@', () => deflateSync(script, {level: 9}).toString('base64'))
    // An HTML parser ends the script at the first closing tag, even inside a string.
    .replace('@CRACKLE_LOADER@', () => loader.trim().replaceAll('</script', '<\\/script'));
for (const marker of ['@CRACKLE_DATA@', '@CRACKLE_FIRST@', '@CRACKLE_REST@']) {
    const found = filled.split(marker).length - 1;
    if (found !== 1) throw new Error(`marker ${marker}: found ${found} times in the page, expected once`);
}
await mkdir(dirname(output), {recursive: true});
await writeFile(output, filled);
console.log(`${output}: ${(filled.length / 1024).toFixed(0)} KiB`);
