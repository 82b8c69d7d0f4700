#!/usr/bin/env node
// SPDX-License-Identifier: GPL-3.0-or-later
// Makes the pictures for specimens/gallery/README.md from the report that tools/quickstart wrote, and copies its
// comparison with DEMseg's guide. If a report of the laboratory tests is given (specimens/laboratory/README.md), a
// picture of their specimens is made as well.
//   node tools/gallery.mjs [FOLDER] [GALLERY] [LABORATORY]    default out/guide_rock, specimens/gallery, none
// Run tools/quickstart and tools/test first: the tests' build installs the browser driver. The browser is Debian's Chromium.
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
    console.error(`${driver}: found no browser driver, expected the one that tools/test installs; run it first`);
    process.exit(2);
}
const {chromium} = createRequire(driver)('playwright-core');

const browser = await chromium.launch({executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader']});
/// Writes pictures of parts of a report. @param parts pairs of selector and file name
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
    page.setDefaultTimeout(240_000);  // ms; long because software rendering of thousands of cells is slow on a busy machine
    await mkdir(gallery, {recursive: true});
    if (laboratory) await pictures(page, resolve(laboratory), [['#specimens', 'laboratory.png']]);
    await pictures(page, join(results, 'report.html'), [['#curves', 'curves.png'], ['#specimens', 'specimens.png']]);
    // The viewer shows all tests side by side at their peaks, with stresses and contact forces.
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
