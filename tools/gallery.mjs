#!/usr/bin/env node
// SPDX-License-Identifier: GPL-3.0-or-later
// Takes the pictures that the README shows out of the report that tools/quickstart made, and its comparison with the guide.
//   node tools/gallery.mjs [FOLDER] [GALLERY]    default out/guide_rock, specimens/gallery
// Needs tools/quickstart and tools/test run before.
// The browser driver is the one that building the tests installs (tools/test), the browser Debian's Chromium.
import {existsSync} from 'node:fs';
import {copyFile, mkdir} from 'node:fs/promises';
import {createRequire} from 'node:module';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath, pathToFileURL} from 'node:url';

const top = dirname(dirname(fileURLToPath(import.meta.url)));
const results = resolve(process.argv[2] ?? join(top, 'out/guide_rock'));
const gallery = resolve(process.argv[3] ?? join(top, 'specimens/gallery'));
const driver = join(top, 'build/release/tests/browser/package.json');
if (!existsSync(driver)) {
    console.error(`${driver}: found no browser driver, expected the one of the tests; run tools/test first`);
    process.exit(2);
}
const {chromium} = createRequire(driver)('playwright-core');

const browser = await chromium.launch({executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox', '--disable-gpu']});
try {
    const page = await browser.newPage({viewport: {width: 1280, height: 900}, colorScheme: 'light'});
    await page.goto(pathToFileURL(join(results, 'report.html')).href);
    await page.waitForSelector('html[data-ready="true"]');
    await mkdir(gallery, {recursive: true});
    for (const [part, name] of [['#curves', 'curves.png'], ['#specimens', 'specimens.png']]) {
        await page.locator(part).screenshot({path: join(gallery, name), animations: 'disabled'});
        console.log(join(gallery, name));
    }
    await copyFile(join(results, 'comparison.txt'), join(gallery, 'comparison.txt'));
} finally {
    await browser.close();
}
