// SPDX-License-Identifier: GPL-3.0-or-later
// Opens pages in headless Chromium and records errors and requests to other addresses; also reads the sizes of saved
// pictures.
import assert from 'node:assert/strict';
import {pathToFileURL} from 'node:url';

import {chromium} from 'playwright-core';

const flags = [
    '--no-sandbox', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync',
    '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', // WebGL without a graphics card
];

export const launch = () => chromium.launch({executablePath: process.env.CHROMIUM, args: flags});

/// The opened page. `close` checks that the page reported no errors and requested nothing else.
export async function openPage(browser, file, options = {}) {
    const context = await browser.newContext({viewport: {width: 1280, height: 800}, ...options});
    const page = await context.newPage();
    const complaints = [], requests = [];
    page.on('console', (message) => { if (['error', 'warning'].includes(message.type())) complaints.push(message.text()); });
    page.on('pageerror', (error) => complaints.push(String(error)));
    page.on('request', (request) => { if (!/^(data|blob):/.test(request.url())) requests.push(request.url()); });
    const address = pathToFileURL(file).href;
    await page.goto(address);
    await page.waitForSelector('html[data-ready="true"]', {timeout: 60000});
    return {page, close: async () => {
        await context.close();
        assert.deepEqual(complaints, [], 'complaints of the page');
        assert.deepEqual(requests, [address], 'requests of the page');
    }};
}

export function pngSize(bytes) {
    assert.equal(bytes.subarray(1, 4).toString(), 'PNG');
    return {width: bytes.readUInt32BE(16), height: bytes.readUInt32BE(20)};
}

/// Size and number of frames of a GIF, block by block.
export function gifSize(bytes) {
    assert.equal(bytes.subarray(0, 6).toString(), 'GIF89a');
    const tableBytes = (flags) => (flags & 0x80 ? 3 * 2 ** ((flags & 7) + 1) : 0);
    let at = 13 + tableBytes(bytes[10]), frames = 0;
    const skipParts = () => {
        while (bytes[at] !== 0) at += bytes[at] + 1;
        ++at;
    };
    while (bytes[at] !== 0x3b) {
        if (bytes[at] === 0x21) {
            at += 2;
            skipParts();
        } else {
            assert.equal(bytes[at], 0x2c, `an image at byte ${at}`);
            ++frames;
            at += 10 + tableBytes(bytes[at + 9]) + 1;
            skipParts();
        }
    }
    return {width: bytes.readUInt16LE(6), height: bytes.readUInt16LE(8), frames};
}
