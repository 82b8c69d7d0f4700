#!/usr/bin/env node
// SPDX-License-Identifier: GPL-3.0-or-later
// Takes the pictures of specimens/gallery/README.md out of the report that tools/quickstart made, and its comparison with the guide;
// where a report of the laboratory is given (specimens/laboratory/README.md), that of its specimens, too.
//   node tools/gallery.mjs [FOLDER] [GALLERY] [LABORATORY]    default out/guide_rock, specimens/gallery, none
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
const laboratory = process.argv[4];
const driver = join(top, 'build/release/tests/browser/package.json');
if (!existsSync(driver)) {
    console.error(`${driver}: found no browser driver, expected the one of the tests; run tools/test first`);
    process.exit(2);
}
const {chromium} = createRequire(driver)('playwright-core');

const browser = await chromium.launch({executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader']});
/// Pictures of parts of a report: selectors and files.
async function pictures(page, report, parts) {
    await page.goto(pathToFileURL(report).href);
    await page.waitForSelector('html[data-ready="true"]');
    for (const [part, name] of parts) {
        await page.locator(part).screenshot({path: join(gallery, name), animations: 'disabled'});
        console.log(join(gallery, name));
    }
}
try {
    const page = await browser.newPage({viewport: {width: 1280, height: 900}, colorScheme: 'light'});
    await mkdir(gallery, {recursive: true});
    if (laboratory) await pictures(page, resolve(laboratory), [['#specimens', 'laboratory.png']]);
    await pictures(page, join(results, 'report.html'), [['#curves', 'curves.png'], ['#specimens', 'specimens.png']]);
    // The viewer: all tests side by side at their peaks, stresses and forces.
    const viewer = page.locator('#viewer');
    for (const [name, value] of [['layout', 'side'], ['axis', 'share'], ['quantity', 'stress_y']]) await viewer.locator(`select.${name}`).selectOption(value);
    await viewer.getByLabel('Contact forces').check();
    await viewer.locator('.stage').focus();
    while (await page.evaluate(() => window.crackle.moment()) < 1) await page.keyboard.press('ArrowRight');
    await page.evaluate(async () => {
        document.activeElement.blur();
        await window.crackle.settled();
    });
    await viewer.screenshot({path: join(gallery, 'viewer.png'), animations: 'disabled'});
    console.log(join(gallery, 'viewer.png'));
    await copyFile(join(results, 'comparison.txt'), join(gallery, 'comparison.txt'));
} finally {
    await browser.close();
}
