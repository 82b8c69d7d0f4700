// SPDX-License-Identifier: GPL-3.0-or-later
// Measures how soon a page of the viewer shows its first picture, and how many pictures per second it draws while it is
// panned and zoomed. It uses headless Chromium with WebGL in software, and waits for each picture.
//   node viewer_rate.mjs PAGE.html [pictures, default 60]      CHROMIUM: the browser; playwright-core must be found from here
import {pathToFileURL} from 'node:url';

import {chromium} from 'playwright-core';

const flags = ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
const [file, pictures = '60'] = process.argv.slice(2);
if (!file) throw new Error('node viewer_rate.mjs PAGE.html [pictures]');

const browser = await chromium.launch({executablePath: process.env.CHROMIUM ?? 'chromium', args: flags});
const page = await browser.newPage({viewport: {width: 1440, height: 900}});
await page.goto(pathToFileURL(file).href);
await page.waitForSelector('html[data-first-picture]', {timeout: 120000});
const first = Number(await page.evaluate(() => document.documentElement.dataset.firstPicture));
await page.waitForSelector('html[data-ready]', {timeout: 120000});
await page.evaluate(() => window.crackle.settled());

// Pans and zooms alternate, as from a user's mouse.
const times = await page.evaluate(async (count) => {
    const pane = document.querySelector('.pane'), box = pane.getBoundingClientRect();
    const x = box.left + box.width / 2, y = box.top + box.height / 2;
    document.querySelector('.stage').focus();
    const mouse = (type, dx, dy) => (type === 'mousedown' ? pane : window).dispatchEvent(new MouseEvent(type, {clientX: x + dx, clientY: y + dy, bubbles: true, cancelable: true, view: window}));
    const times = [];
    for (let picture = 0; picture < count; ++picture) {
        const before = performance.now();
        if (picture % 2 === 0) {
            const way = 40 * Math.sin(picture);
            mouse('mousedown', 0, 0);
            mouse('mousemove', way, way / 2);
            mouse('mouseup', way, way / 2);
        } else {
            pane.dispatchEvent(new WheelEvent('wheel', {clientX: x, clientY: y, deltaY: picture % 20 < 10 ? -60 : 60, bubbles: true, cancelable: true}));
        }
        window.crackle.draw();
        times.push(performance.now() - before);
        await new Promise((resume) => setTimeout(resume));
    }
    return times;
}, Number(pictures));
const zoom = await page.evaluate(() => window.crackle.zoom());
await browser.close();

const sorted = [...times].sort((a, b) => a - b), at = (share) => sorted[Math.floor(share * (sorted.length - 1))];
console.log(`first picture ${first.toFixed(0)} ms`);
console.log(`pan and zoom: median ${(1000 / at(0.5)).toFixed(1)} frames/s (${at(0.5).toFixed(1)} ms), slowest tenth ${(1000 / at(0.9)).toFixed(1)} frames/s; ${times.length} pictures, zoom at the end ${zoom.k.toFixed(2)}`);
