// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the page of a deck run in headless Chromium: its curves, its units, the layout of the panel, and the clipboard.
//   CRACKLE_PROGRAM: the program; SPECIMENS: folder of cases and decks; CHROMIUM: the browser
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, before, test} from 'node:test';

import {launch, openPage} from './pages.mjs';

let root, browser;
const deck = (name) => join(process.env.SPECIMENS, 'demseg', name);
const crackle = (...options) => execFileSync(process.env.CRACKLE_PROGRAM, options, {stdio: ['ignore', 'ignore', 'inherit']});
const open = (file, options) => openPage(browser, join(root, file), options);

before(async () => {
    root = mkdtempSync(join(tmpdir(), 'crackle-deck-page-'));
    for (const [name, steps] of [['embankment', 2000], ['wave_chain', 400], ['circle', 4000]]) crackle('run', '-q', deck(name), '--steps', String(steps), '-o', join(root, name));
    for (const name of ['embankment', 'wave_chain', 'circle']) crackle('view', join(root, name), '-o', join(root, `${name}.html`));
    crackle('view', join(root, 'embankment', 'output.dat'), '--units', 'cgs', '-o', join(root, 'cgs.html'));
    crackle('view', join(root, 'embankment'), join(root, 'wave_chain'), '-o', join(root, 'two.html'));
    browser = await launch();
});

after(async () => {
    await browser?.close();
    if (root) rmSync(root, {recursive: true, force: true});
});

const settled = (page) => page.evaluate(() => window.crackle.settled());
const shown = (page) => page.evaluate(() => window.crackle.shown());
const rowsOf = (...path) => readFileSync(join(root, ...path), 'utf8').split('\n').filter((line) => line !== '' && !line.startsWith('#')).map((line) => line.split(' ').map(Number));

async function pick(page, id) {
    const [{test: name}] = await shown(page);
    const at = await page.evaluate(([test, number]) => window.crackle.place(test, number), [name, id]);
    await page.mouse.click(at.x, at.y);
    await page.locator('.history svg path[stroke-width="1.4"]').waitFor({state: 'attached', timeout: 10000});
}

test('energies and watched bodies are drawn, and the specimen goes where they are clicked at', async () => {
    const {page, close} = await open('wave_chain.html');
    assert.deepEqual(await page.locator('#deck-curves .frame').evaluateAll((all) => all.map((one) => one.dataset.panel)), ['Energy', 'Horizontal displacement'], 'nothing moves across the chain, nothing drives it');
    const names = await page.locator('[data-panel="Energy"] svg').textContent();
    for (const name of ['kinetic (enva)', 'strain (enka)', 'closing error (err)', 'Energy [10⁶ deck’s units]', 'Time [ms]']) assert.ok(names.replaceAll('\u202f', ' ').includes(name), `expected '${name}' in '${names}'`);
    assert.ok(!names.includes('enca'), 'without dashpots there is no dashpot loss');
    for (const body of [11, 13, 15, 17]) assert.ok((await page.locator('[data-panel="Horizontal displacement"] svg').textContent()).includes(`body ${body}`));
    const panel = page.locator('[data-panel="Energy"] .panel');
    await panel.scrollIntoViewIfNeeded();
    const box = await panel.boundingBox(), left = 82, right = 18, share = 0.6;
    await page.mouse.click(box.x + left + share * (box.width - left - right), box.y + 150);
    await settled(page);
    const end = 400e-5, every = 10e-5, [{time}] = await shown(page);
    console.log(`  clicked at ${share * end} s, got the frame at ${time} s; frames are ${every} s apart`);
    assert.ok(Math.abs(time - share * end) <= 0.51 * every + end / (box.width - left - right), `expected ${share * end}, got ${time}`);
    const line = await panel.locator('.cursor-line').evaluate((one) => parseFloat(one.style.left));
    const expected = left + time / end * (box.width - left - right);
    console.log(`  cursor: expected ${expected.toFixed(1)} px, got ${line.toFixed(1)} px`);
    assert.ok(Math.abs(line - expected) < 2);
    await close();
});

test('the values under the pointer are those of the file', async () => {
    const {page, close} = await open('circle.html');
    const panel = page.locator('[data-panel="Energy"] .panel');
    await panel.scrollIntoViewIfNeeded();
    const box = await panel.boundingBox(), left = 82, right = 18;
    await page.mouse.move(box.x + left + 0.3 * (box.width - left - right), box.y + 150);
    const readout = (await page.locator('[data-panel="Energy"] .cursor').textContent()).replaceAll('\u202f', ' ').replaceAll('−', '-');
    const [, shownTime] = readout.match(/t = ([\d.]+) ms/), [, kinetic, power] = readout.match(/kinetic \(enva\)([\d.]+)(?:×10³)?/) && [, readout.match(/kinetic \(enva\)([\d.]+)/)[1], /kinetic \(enva\)[\d.]+×10³/.test(readout) ? 1e3 : 1];
    // Free fall from rest: the kinetic energy is m (g t)²/2.
    const got = Number(kinetic) * power, t = Number(shownTime) / 1000, expected = 0.5 * 2.5 * Math.PI * 4 * (980 * t) ** 2;
    console.log(`  after ${t} s: expected ${expected.toFixed(0)}, got ${got}`);
    assert.ok(Math.abs(got - expected) < 0.02 * expected, `expected ${expected}, got ${got}`);
    const rows = rowsOf('circle', 'energy.dat');
    assert.ok(rows.some((row) => Math.abs(row[2] - got) < 0.02 * got), 'a value of the file');
    await close();
});

test('what a picked particle shows fits into its panel, whatever the units', async () => {
    for (const file of ['embankment.html', 'cgs.html']) {
        const {page, close} = await open(file);
        await page.locator('.scrub').fill(await page.locator('.scrub').getAttribute('max'));
        await settled(page);
        for (const id of [3, 40, 77, 126]) {
            await pick(page, id);
            const over = await page.locator('.inspector').evaluate((panel) => {
                const {left, right} = panel.getBoundingClientRect();
                return [...panel.querySelectorAll('td, th, svg text')].filter((one) => {
                    const box = one.getBoundingClientRect();
                    return box.width > 0 && (box.right > right + 0.5 || box.left < left - 0.5);
                }).map((one) => one.textContent);
            });
            assert.deepEqual(over, [], `${file}: particle ${id}: texts beyond the panel`);
            const cut = await page.locator('.inspector details').evaluate((one) => one.scrollWidth - one.clientWidth);
            assert.equal(cut, 0, `${file}: particle ${id}: contacts`);
            // The title of the history's axis must be inside its picture.
            const outside = await page.locator('.history svg').evaluate((svg) => {
                const {left, right} = svg.getBoundingClientRect();
                return [...svg.querySelectorAll('text')].filter((one) => one.getBoundingClientRect().left < left - 0.5 || one.getBoundingClientRect().right > right + 0.5).map((one) => one.textContent);
            });
            assert.deepEqual(outside, [], `${file}: particle ${id}: the history's texts`);
        }
        await close();
    }
});

test('units of a deck are named where they are known, and no N/m where they are not', async () => {
    const known = await open('cgs.html');
    await known.page.selectOption('select.quantity', 'displacement');
    await settled(known.page);
    await known.page.locator('.scrub').fill(await known.page.locator('.scrub').getAttribute('max'));
    await settled(known.page);
    assert.match((await known.page.locator('.stage').textContent()).replaceAll('\u202f', ' '), /Displacement \[cm\]/);
    const [touching] = rowsOf('embankment', 'cont.dat').filter((row) => row.length === 6 && row[0] < 127).at(-1);
    await pick(known.page, touching);
    const spaced = (text) => text.replaceAll('\u202f', ' ');
    assert.match(spaced(await known.page.locator('[data-value="radius"]').textContent()), /^[\d.]+ cm$/);
    assert.match(spaced(await known.page.locator('.inspector details').textContent()), /Fn \[(10\S+ )?dyn\]/);
    assert.match(await known.page.locator('footer').textContent(), /forces are in dyn, stresses in dyn\/cm/);
    assert.match(spaced(await known.page.locator('[data-panel="Energy"] svg').textContent()), /Energy \[10\S+ erg\]/);
    await known.close();
    const unknown = await open('embankment.html');
    const footer = await unknown.page.locator('footer').textContent();
    assert.doesNotMatch(footer, /N\/m/);
    assert.match(footer, /the deck, which does not state its units/);
    await pick(unknown.page, 40);
    assert.match(await unknown.page.locator('[data-value="radius"]').textContent(), /^[\d.]+$/);
    assert.doesNotMatch(await unknown.page.locator('body').innerText(), /file’s units/);
    await unknown.close();
});

test('a single particle is counted as one', async () => {
    const {page, close} = await open('circle.html');
    assert.match(await page.locator('.about').textContent(), /: 1 particle, \d+ frames/);
    await close();
});

test('numbers that the zoom hides say so, until they fit', async () => {
    const {page, close} = await open('embankment.html', {viewport: {width: 620, height: 500}});
    const text = async () => {
        await settled(page);
        await page.waitForTimeout(400);
        return page.locator('.stage').textContent();
    };
    assert.doesNotMatch(await text(), /zoom in/i, 'nobody asked for numbers');
    await page.locator('[data-layer="numbers"]').check();
    const before = await text();
    console.log(`  ${before.match(/(Zoom in to see the numbers|Numbers of .* particles fit.*)/)?.[1]}`);
    assert.match(before, /Zoom in to see the numbers|Numbers of \d+ of \d+ particles fit: zoom in to see the others/);
    await page.locator('.stage').focus();
    for (let times = 0; times < 14; ++times) await page.keyboard.press('+');
    assert.doesNotMatch(await text(), /zoom in/i);
    await close();
});

test('the picture is copied to the clipboard by button and by key', async () => {
    const {page, close} = await open('wave_chain.html', {permissions: ['clipboard-read', 'clipboard-write']});
    const copied = () => page.evaluate(async () => {
        const [item] = await navigator.clipboard.read();
        const bitmap = await createImageBitmap(await item.getType('image/png'));
        return {width: bitmap.width, height: bitmap.height};
    });
    const stage = await page.locator('.picture').evaluate(({clientWidth, clientHeight}) => ({width: 2 * clientWidth, height: 2 * clientHeight}));
    await page.click('button[data-save="copy"]');
    await page.locator('.busy', {hasText: 'Copied to the clipboard'}).waitFor();
    assert.deepEqual(await copied(), stage);
    await page.evaluate(() => navigator.clipboard.writeText('something else'));
    await page.locator('.stage').focus();
    await page.keyboard.press('Control+c');
    const pictured = () => page.evaluate(async () => (await navigator.clipboard.read())[0].types.includes('image/png'));
    for (let tries = 0; tries < 100 && !await pictured(); ++tries) await page.waitForTimeout(200);
    assert.deepEqual(await copied(), stage);
    await close();
});

test('curves of several decks name theirs, and a click shows the deck', async () => {
    const {page, close} = await open('two.html');
    const titles = await page.locator('#deck-curves .frame').evaluateAll((all) => all.map((one) => one.dataset.panel));
    assert.ok(titles.includes('wave_chain: energy') && titles.includes('embankment: energy'), `got ${titles}`);
    await page.selectOption('select.layout', 'one');
    await page.selectOption('select.test', '0');
    await settled(page);
    const panel = page.locator('[data-panel="wave_chain: energy"] .panel');
    await panel.scrollIntoViewIfNeeded();
    const box = await panel.boundingBox();
    await page.mouse.click(box.x + 0.5 * box.width, box.y + 150);
    await settled(page);
    assert.deepEqual((await shown(page)).map(({test: name}) => name), ['wave_chain']);
    await close();
});
