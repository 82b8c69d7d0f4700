// SPDX-License-Identifier: GPL-3.0-or-later
// The viewer in headless Chromium with WebGL in software: what it shows, prints and saves agrees with the files.
//   CRACKLE_PROGRAM, SAMPLE_RESULTS: the programs; SPECIMENS: folder of cases and decks; CHROMIUM: the browser
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync, statSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, before, test} from 'node:test';

import {gifSize, launch, openPage, pngSize} from './pages.mjs';
import {particles, results} from './results.mjs';

const sixFolders = ['tension', 'compression'].flatMap((kind) => ['circles', 'delaunay', 'voronoi'].map((specimen) => `${specimen}-${kind}`));
let root, browser;

const crackle = (...options) => execFileSync(process.env.CRACKLE_PROGRAM, options, {stdio: ['ignore', 'ignore', 'inherit']});
const open = (file, options) => openPage(browser, join(root, file), options);

/// A particle file with one polygon.
const deckOf = (corners) => ['1 0 0', '1.0d-4 0.0 0.0', '1', '1.0 1.0d8 1.0d8 0.0 0.0 0.0', '-1.0 4.0 -1.0 4.0 0.0', '0 1 0', `1 1 ${corners.length}`, '0.0 0.0 0.0',
    ...corners.flatMap(([x, y], at) => [`${at + 1} ${x}.0 ${y}.0`, corners[(at + 1) % corners.length].map((value) => `${value}.0`).join(' ')])].join('\n');

/// Of a case: the largest grains are quartz.
const minerals = '[minerals]\nassign = "size"\n[[mineral]]\nname = "quartz"\narea_share = 0.5\n[[mineral]]\nname = "feldspar"\n';

before(async () => {
    root = mkdtempSync(join(tmpdir(), 'crackle-viewer-'));
    execFileSync(process.env.SAMPLE_RESULTS, [root]);
    crackle('report', ...sixFolders.map((folder) => join(root, folder)), '-o', join(root, 'six.html'));
    crackle('test', join(process.env.SPECIMENS, 'guide_rock', 'circles_tension.toml'), '-o', join(root, 'pulled'));
    crackle('view', join(root, 'pulled'), '-o', join(root, 'pulled.html'));
    const tension = readFileSync(join(process.env.SPECIMENS, 'guide_rock', 'circles_tension.toml'), 'utf8');
    writeFileSync(join(root, 'many.toml'), `${tension.replace('"rock.toml"', `"${join(process.env.SPECIMENS, 'guide_rock', 'rock.toml')}"`)}\n[output]\nframes = 1200\n`);
    crackle('test', join(root, 'many.toml'), '-o', join(root, 'many'));
    crackle('view', join(root, 'many'), '-o', join(root, 'many.html'));
    crackle('view', join(process.env.SPECIMENS, 'demseg', 'embankment', 'in_gm.dat'), '-o', join(root, 'particles.html'));
    crackle('run', join(process.env.SPECIMENS, 'demseg', 'embankment'), '--steps', '2000', '-o', join(root, 'deck'));
    crackle('view', join(root, 'deck'), '-o', join(root, 'deck.html'));
    writeFileSync(join(root, 'in_gm_notched.dat'), deckOf([[0, 0], [3, 0], [3, 3], [2, 3], [2, 1], [1, 1], [1, 3], [0, 3]]));
    crackle('view', join(root, 'in_gm_notched.dat'), '-o', join(root, 'notched.html'));
    writeFileSync(join(root, 'minerals.toml'), `include = "${join(process.env.SPECIMENS, 'guide_rock', 'circles_tension.toml')}"\n[packing]\ncount = 60\n[loading]\nmax_axial_strain = 1e-4\n[output]\nframes = 2\n${minerals}`);
    crackle('test', join(root, 'minerals.toml'), '-o', join(root, 'minerals'));
    crackle('view', join(root, 'minerals'), '-o', join(root, 'minerals.html'));
    browser = await launch();
});

after(async () => {
    await browser?.close();
    if (root) rmSync(root, {recursive: true, force: true});
});

const shown = (page) => page.evaluate(() => window.crackle.shown());
const settled = (page) => page.evaluate(() => window.crackle.settled());
const frameNow = async (page) => (await shown(page))[0].frame;
const choose = async (page, list, value) => {
    await page.selectOption(`select.${list}`, value);
    await settled(page);
};
/// The stage as the screen shows it, once it has come to rest.
async function picture(page) {
    await settled(page);
    await page.waitForTimeout(400);
    return (await page.locator('.stage').screenshot()).toString('base64');
}
async function saved(page, kind) {
    const [download] = await Promise.all([page.waitForEvent('download', {timeout: 120000}), page.click(`button[data-save="${kind}"]`)]);
    return {name: download.suggestedFilename(), file: await download.path()};
}
/// Width, height, how many colours there are, and the share of pixels that are not the most frequent one, decoded by the browser.
const pixels = (page, file, type) => page.evaluate(async ([base64, kind]) => {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], {type: kind}));
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
    context.drawImage(bitmap, 0, 0);
    const colours = new Map();
    for (const colour of new Uint32Array(context.getImageData(0, 0, bitmap.width, bitmap.height).data.buffer)) colours.set(colour, (colours.get(colour) ?? 0) + 1);
    return {width: bitmap.width, height: bitmap.height, colours: colours.size, drawn: 1 - Math.max(...colours.values()) / (bitmap.width * bitmap.height)};
}, [readFileSync(file).toString('base64'), type]);

test('plays, pauses, steps and scrubs', async () => {
    const {page, close} = await open('pulled.html');
    assert.equal(await frameNow(page), 0);
    await choose(page, 'speed', '0.25'); // it must not be through before a busy machine has pressed the button
    await page.click('button[aria-label="Play"]');
    await page.waitForFunction(() => window.crackle.shown()[0].frame >= 3, null, {timeout: 20000});
    await page.click('button[aria-label="Pause"]');
    await settled(page);
    const paused = await frameNow(page);
    await page.waitForTimeout(400);
    assert.equal(await frameNow(page), paused, 'the frame does not change while paused');
    await page.click('button[aria-label="Next frame"]');
    await settled(page);
    assert.equal(await frameNow(page), paused + 1, 'a step on');
    await page.click('button[aria-label="Previous frame"]');
    await settled(page);
    assert.equal(await frameNow(page), paused, 'a step back');
    const last = Number(await page.locator('.scrub').getAttribute('max'));
    await page.locator('.scrub').fill(String(last));
    await settled(page);
    const end = results(join(root, 'pulled')).curve.at(-1).time, got = (await shown(page))[0].time;
    console.log(`  time at the end: expected ${end}, got ${got}`);
    assert.ok(Math.abs(got - end) <= 1e-9 * end, `time at the end: expected ${end}, got ${got}`);
    assert.match(await page.locator('.readout').textContent(), new RegExp(`Frame ${last + 1}/${last + 1}`));
    await close();
});

test('each layer changes the picture, and the same way back', async () => {
    const {page, close} = await open('pulled.html');
    await page.locator('.scrub').fill(await page.locator('.scrub').getAttribute('max'));
    const layers = await page.locator('[data-layer]').evaluateAll((boxes) => boxes.map((box) => box.dataset.layer));
    assert.deepEqual(layers, ['particles', 'outlines', 'platens', 'cracks', 'bonds', 'forces', 'numbers']);
    await picture(page);
    const before = await picture(page);
    for (const layer of layers) {
        await page.click(`[data-layer="${layer}"]`);
        assert.notEqual(await picture(page), before, `${layer}: the picture should change`);
        await page.click(`[data-layer="${layer}"]`);
        assert.equal(await picture(page), before, `${layer}: the picture should be as before`);
    }
    await close();
});

test('each colouring has its legend with unit, and its own picture', async () => {
    const {page, close} = await open('pulled.html');
    await page.locator('.scrub').fill(await page.locator('.scrub').getAttribute('max'));
    const keys = await page.locator('select.quantity option').evaluateAll((options) => options.map((option) => option.value));
    for (const key of ['none', 'material', 'displacement', 'velocity', 'rotation']) assert.ok(keys.includes(key), `expected colouring by ${key}, got ${keys}`);
    const plain = await picture(page);
    for (const [key, unit] of [['displacement', /Displacement \[[µm]?m\]/], ['velocity', /Velocity \[[µm]?m\/s\]/], ['rotation', /Rotation \[[µm]?rad\]/]]) {
        await choose(page, 'quantity', key);
        assert.notEqual(await picture(page), plain, `${key}: the picture should change`);
        assert.match(await page.locator('.stage').textContent(), unit);
    }
    await choose(page, 'magnification', '100');
    assert.notEqual(await picture(page), plain);
    await close();
});

test('a picked particle shows the values of the file', async () => {
    const {page, close} = await open('pulled.html');
    await page.locator('.scrub').fill(await page.locator('.scrub').getAttribute('max'));
    await settled(page);
    const [{test: name}] = await shown(page);
    const {summary} = results(join(root, 'pulled'));
    const first = particles(join(root, 'pulled', summary.frame_start)), last = particles(join(root, 'pulled', summary.frame_end));
    for (const id of [7, 152, 290]) {
        const at = await page.evaluate(([test, number]) => window.crackle.place(test, number), [name, id]);
        await page.mouse.click(at.x, at.y);
        assert.deepEqual(await page.evaluate(() => window.crackle.picked()), {test: name, id});
        const a = first.get(id), b = last.get(id), expected = Math.hypot(b.x - a.x, b.y - a.y);
        const got = Number(await page.locator('[data-value="displacement"]').getAttribute('data-number'));
        console.log(`  particle ${id}: displacement expected ${expected}, got ${got}`);
        assert.ok(Math.abs(got - expected) < 0.01 * expected + 2e-6, `particle ${id}: displacement: expected ${expected}, got ${got}`);
        const radius = Number(await page.locator('[data-value="radius"]').getAttribute('data-number'));
        assert.ok(Math.abs(radius - a.radius) < 1e-6 * a.radius, `particle ${id}: radius: expected ${a.radius}, got ${radius}`);
        // Shown to 0.4 % of themselves, however small.
        for (const [key, value] of [['velocity', b.velocity], ['stress_shear', b.shear]]) {
            const printed = Number(await page.locator(`[data-value="${key}"]`).getAttribute('data-number'));
            console.log(`  particle ${id}: ${key} expected ${value}, got ${printed}`);
            assert.ok(Math.abs(printed - value) <= 0.005 * Math.abs(value), `particle ${id}: ${key}: expected ${value}, got ${printed}`);
        }
    }
    await page.locator('.history svg path[stroke-width="1.4"]').waitFor({state: 'attached', timeout: 10000});
    await page.locator('.stage').press('Escape');
    assert.equal(await page.evaluate(() => window.crackle.picked()), undefined);
    assert.ok(await page.locator('.inspector').isHidden());
    await close();
});

test('minerals are told by name', async () => {
    const {page, close} = await open('minerals.html');
    const plain = await picture(page);
    await choose(page, 'quantity', 'material');
    assert.notEqual(await picture(page), plain);
    const legend = await page.locator('.stage').textContent();
    assert.match(legend, /quartz\s*feldspar/);
    assert.doesNotMatch(legend, /feldspar\s*3/, "the platens' material is no mineral");
    const [{test: name}] = await shown(page);
    const sizes = [...particles(join(root, 'minerals', results(join(root, 'minerals')).summary.frame_start))].filter(([, {radius}]) => radius > 0).sort(([, a], [, b]) => a.radius - b.radius);
    for (const [[id], mineral] of [[sizes[0], 'feldspar'], [sizes.at(-1), 'quartz']]) {
        const at = await page.evaluate(([test, number]) => window.crackle.place(test, number), [name, id]);
        await page.mouse.click(at.x, at.y);
        assert.equal(await page.locator('[data-value="material"]').textContent(), mineral, `particle ${id}`);
    }
    await close();
});

test('saves the view as PNG and SVG', async () => {
    const {page, close} = await open('pulled.html');
    await choose(page, 'quantity', 'displacement');
    await page.locator('.scrub').fill('20');
    await settled(page);
    const stage = await page.locator('.picture').evaluate(({clientWidth, clientHeight}) => ({width: clientWidth, height: clientHeight}));
    const png = await saved(page, 'png');
    assert.equal(png.name, 'pulled.png');
    assert.deepEqual(pngSize(readFileSync(png.file)), {width: 2 * stage.width, height: 2 * stage.height});
    const found = await pixels(page, png.file, 'image/png');
    console.log(`  PNG: ${found.width} × ${found.height}, ${found.colours} colours, ${(100 * found.drawn).toFixed(0)} % drawn`);
    assert.ok(found.colours > 40 && found.drawn > 0.05, `PNG: expected a picture, got ${JSON.stringify(found)}`);

    const svg = readFileSync((await saved(page, 'svg')).file, 'utf8');
    const {summary} = results(join(root, 'pulled'));
    assert.equal([...svg.matchAll(/class="particle"/g)].length, summary.particles, 'shapes of particles');
    assert.ok(new Set([...svg.matchAll(/class="particle"[^>]*fill="([^"]*)"/g)].map((match) => match[1])).size > 20, 'particles coloured by displacement');
    assert.equal(await page.evaluate((text) => new DOMParser().parseFromString(text, 'image/svg+xml').querySelectorAll('parsererror').length, svg), 0);
    await close();
});

test('saves the animation as GIF, a frame a moment, and as a video', {timeout: 240000}, async () => {
    const {page, close} = await open('pulled.html', {viewport: {width: 900, height: 640}});
    const moments = Number(await page.locator('.scrub').getAttribute('max')) + 1;
    const gif = await saved(page, 'gif');
    const {width, height, frames} = gifSize(readFileSync(gif.file));
    console.log(`  GIF: ${width} × ${height}, ${frames} frames, ${(statSync(gif.file).size / 1e6).toFixed(2)} MB`);
    assert.equal(frames, moments, 'frames of the GIF');
    const found = await pixels(page, gif.file, 'image/gif');
    assert.deepEqual([found.width, found.height], [width, height]);
    assert.ok(found.colours > 5 && found.drawn > 0.05, `GIF: expected a picture, got ${JSON.stringify(found)}`);
    await page.locator('.busy:empty').waitFor({state: 'attached'});
    if (await page.locator('button[data-save="video"]').count() > 0) {
        const video = await saved(page, 'video');
        console.log(`  video: ${video.name}, ${(statSync(video.file).size / 1e3).toFixed(0)} kB`);
        assert.ok(statSync(video.file).size > 10000, 'a video of more than nothing');
    }
    await close();
});

test('a GIF of more than 200 moments has 200, evenly spaced, including the last', {timeout: 240000}, async () => {
    const {page, close} = await open('many.html', {viewport: {width: 480, height: 400}});
    const moments = Number(await page.locator('.scrub').getAttribute('max')) + 1;
    assert.ok(moments > 200 && moments < 400, `expected some more than 200 moments, got ${moments}`);
    await page.evaluate(() => {
        window.reported = [];
        new MutationObserver(() => window.reported.push(document.querySelector('.busy').textContent)).observe(document.querySelector('.busy'), {childList: true, characterData: true, subtree: true});
    });
    const saving = saved(page, 'gif');
    await page.waitForFunction(() => window.reported.length > 0);
    assert.ok(await page.locator('button[data-save="png"]').isDisabled(), 'one saving at a time');
    const {frames} = gifSize(readFileSync((await saving).file));
    await page.locator('button[data-save="png"]:enabled').waitFor();
    const taken = (await page.evaluate(() => window.reported)).filter((text) => text !== '').map((text) => Number(text.match(/Frame (\d+) of/)[1]));
    const steps = new Set(taken.slice(1).map((frame, at) => frame - taken[at]));
    console.log(`  ${moments} moments: ${frames} frames, from ${taken[0]} to ${taken.at(-1)}, ${[...steps].join(' or ')} apart`);
    assert.deepEqual([frames, taken.length, taken[0], taken.at(-1)], [200, 200, 1, moments]);
    assert.deepEqual([...steps].sort(), [1, 2]);
    assert.equal(await frameNow(page), 0, 'the clock is back at its start');
    await close();
});

test('the map of breaks shows every one of them', async () => {
    const {page, close} = await open('six.html');
    for (const name of sixFolders) {
        const {events} = results(join(root, name));
        const got = await page.locator(`.card.breaks[data-test="${name}"] .map svg path[fill-opacity="0.6"]`).count();
        console.log(`  ${name}: ${events.length} breaks, ${got} drawn`);
        assert.equal(got, events.length, name);
    }
    await close();
});

test('keys play, step, zoom, switch layers and explain themselves', async () => {
    const {page, close} = await open('pulled.html');
    await page.keyboard.press('End');
    await settled(page);
    const last = await frameNow(page);
    assert.ok(last > 10, `End: expected the last frame, got ${last}`);
    await page.keyboard.press('ArrowLeft');
    await settled(page);
    assert.equal(await frameNow(page), last - 1);
    await page.keyboard.press('Shift+ArrowLeft');
    await settled(page);
    assert.equal(await frameNow(page), last - 11);
    await choose(page, 'speed', '0.25');
    await page.locator('.stage').focus();
    await page.keyboard.press('Home');
    await page.keyboard.press('Space');
    await page.waitForFunction(() => window.crackle.playing() && window.crackle.shown()[0].frame > 0, null, {timeout: 20000});
    await page.keyboard.press('Space');
    assert.equal(await page.evaluate(() => window.crackle.playing()), false);
    await page.keyboard.press('f');
    assert.ok(await page.locator('[data-layer="forces"]').isChecked());
    await page.keyboard.press('+');
    const zoom = () => page.evaluate(() => window.crackle.zoom().k);
    assert.ok(await zoom() > 1.2, `+: expected to be nearer, got ${await zoom()}`);
    await page.keyboard.press('0');
    assert.equal(await zoom(), 1);
    await page.keyboard.press('c');
    assert.equal((await page.evaluate(() => window.crackle.settings())).quantity, 'material');
    await page.keyboard.press('?');
    assert.ok(await page.locator('dialog.help').isVisible());
    await page.keyboard.press('Escape');
    assert.ok(await page.locator('dialog.help').isHidden());
    await close();
});

test('the wheel zooms about the pointer, dragging pans, a double click fits', async () => {
    const {page, close} = await open('pulled.html');
    const box = await page.locator('.pane').boundingBox(), x = box.x + box.width / 2, y = box.y + box.height / 2;
    const [{test: name}] = await shown(page);
    const place = () => page.evaluate((test) => window.crackle.place(test, 152), name);
    const before = await place();
    await page.mouse.move(before.x, before.y);
    await page.mouse.wheel(0, -200);
    await page.waitForFunction(() => window.crackle.zoom().k > 1.1);
    const after = await place();
    assert.ok(Math.hypot(after.x - before.x, after.y - before.y) < 0.5, `the particle under the pointer stays: expected ${JSON.stringify(before)}, got ${JSON.stringify(after)}`);
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 60, y + 25, {steps: 4});
    await page.mouse.up();
    const moved = await place();
    assert.ok(Math.hypot(moved.x - after.x - 60, moved.y - after.y - 25) < 0.5, `dragged by 60, 25: expected, got ${moved.x - after.x}, ${moved.y - after.y}`);
    await page.mouse.dblclick(x, y);
    assert.deepEqual(await page.evaluate(() => window.crackle.zoom()), {k: 1, x: 0, y: 0});
    await close();
});

test('a click on the curve sends the specimen there, and the cursor follows the specimen', async () => {
    const {page, close} = await open('pulled.html');
    const panel = page.locator('.panel').first();
    await panel.scrollIntoViewIfNeeded();
    const line = () => panel.locator('.cursor-line').evaluate((one) => parseFloat(one.style.left));
    const at0 = await line();
    const box = await panel.boundingBox();
    await page.mouse.click(box.x + box.width * 0.6, box.y + 200);
    await settled(page);
    const frame = await frameNow(page);
    assert.ok(frame > 2, `expected a frame past the first ones, got ${frame}`);
    const got = await line();
    console.log(`  cursor: expected about ${(box.width * 0.6).toFixed(0)} px, got ${got.toFixed(0)} px`);
    assert.ok(got > at0 && Math.abs(got - 0.6 * box.width) < 0.06 * box.width, `cursor: expected about ${0.6 * box.width}, got ${got}`);
    await close();
});

test('several tests side by side and overlaid, by one clock', async () => {
    const {page, close} = await open('six.html');
    assert.equal(await page.locator('.pane').count(), 6, 'side by side from the start');
    await page.locator('.scrub').fill(await page.locator('.scrub').getAttribute('max'));
    await settled(page);
    const side = await shown(page);
    assert.deepEqual(side.map(({test: name}) => name).sort(), [...sixFolders].sort());
    for (const {test: name, time} of side) {
        const end = results(join(root, name)).curve.at(-1).time;
        assert.ok(Math.abs(time - end) < 1e-9 * end, `${name} at the end: expected ${end} s, got ${time} s`);
    }
    await choose(page, 'axis', 'share');
    await page.locator('.scrub').fill('0');
    await settled(page);
    assert.deepEqual(new Set((await shown(page)).map(({frame}) => frame)), new Set([0]));
    const apart = await picture(page);
    await choose(page, 'layout', 'over');
    assert.equal(await page.locator('.pane').count(), 1, 'overlaid in one pane');
    assert.equal((await page.locator('.pane').getAttribute('data-test')).split(' ').length, 2);
    const pair = await picture(page);
    await choose(page, 'other', '3');
    assert.notEqual(await picture(page), pair, 'another second test');
    assert.notEqual(await picture(page), apart);
    // One time for the colours of all cracks on the screen: the later of the two ends.
    const last = Math.max(...(await shown(page)).map(({test: name}) => results(join(root, name)).curve.at(-1).time));
    await choose(page, 'cracks-by', 'time');
    const legend = (await page.locator('.stage').textContent()).match(/Time of first break\s*0\s*([\d.]+)\s*(µs|ms|s)/);
    const printed = Number(legend[1]) * {s: 1, ms: 1e-3, µs: 1e-6}[legend[2]];
    console.log(`  legend's end: expected ${last} s, got ${printed} s`);
    assert.ok(Math.abs(printed - last) < 0.006 * last, `expected ${last}, got ${printed}`);
    await choose(page, 'layout', 'one');
    await choose(page, 'test', '4');
    const [{test: only}] = await shown(page);
    const at = await page.evaluate(([name, id]) => window.crackle.place(name, id), [only, results(join(root, only)).events[0].body_i]);
    await page.mouse.click(at.x, at.y);
    assert.equal((await page.evaluate(() => window.crackle.picked())).test, only);
    await choose(page, 'test', '3');
    assert.ok(await page.locator('.inspector').isHidden(), 'a hidden test has no picked particle');
    assert.equal((await shown(page)).length, 1);
    await close();
});

test('a particle file: a still picture of all particles, no curves, nothing to play', async () => {
    const {page, close} = await open('particles.html');
    assert.equal(await page.locator('#curves').count(), 0);
    assert.ok(await page.locator('.transport').isHidden());
    assert.equal(await page.locator('button[data-save="gif"]').count(), 0);
    const svg = readFileSync((await saved(page, 'svg')).file, 'utf8');
    assert.equal([...svg.matchAll(/class="particle"/g)].length, 127);
    await close();
});

test('a polygon with a notch is filled exactly to its outline', async () => {
    const {page, close} = await open('notched.html');
    await page.click('[data-layer="outlines"]');
    await page.click('[data-layer="platens"]');
    await settled(page);
    const {file} = await saved(page, 'png');
    const got = await page.evaluate(async (base64) => {
        const bitmap = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0))]));
        const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
        context.drawImage(bitmap, 0, 0);
        const {data} = context.getImageData(0, 0, bitmap.width, bitmap.height);
        let left = bitmap.width, right = 0, low = bitmap.height, high = 0, count = 0;
        for (let at = 0; at < data.length; at += 4) {
            if (data[at] - data[at + 2] < 5) continue; // grain is warmer than paper, ink and letters
            const x = (at / 4) % bitmap.width, y = Math.floor(at / 4 / bitmap.width);
            [left, right, low, high, count] = [Math.min(left, x), Math.max(right, x), Math.min(low, y), Math.max(high, y), count + 1];
        }
        return count / ((right - left + 1) * (high - low + 1));
    }, readFileSync(file).toString('base64'));
    const expected = 7 / 9; // three by three less a notch of one by two
    console.log(`  share of its box: expected ${expected.toFixed(4)}, got ${got.toFixed(4)}`);
    assert.ok(Math.abs(got - expected) < 0.01, `expected ${expected}, got ${got}`);
    await close();
});

test("a deck's run moves, within its walls", async () => {
    const {page, close} = await open('deck.html');
    assert.equal(await page.locator('#curves').count(), 0);
    await page.locator('.scrub').fill(await page.locator('.scrub').getAttribute('max'));
    await settled(page);
    const last = (await shown(page))[0];
    assert.ok(last.frame > 5 && last.time > 0, `expected a late frame, got ${JSON.stringify(last)}`);
    const walled = await picture(page);
    await page.click('[data-layer="platens"]');
    assert.notEqual(await picture(page), walled, 'walls are drawn');
    await choose(page, 'quantity', 'displacement');
    assert.notEqual(await picture(page), walled);
    await close();
});

test('on paper: the drawings at start, peak and end, light, without buttons', async () => {
    const {page, close} = await open('pulled.html', {colorScheme: 'dark'});
    await page.emulateMedia({media: 'print', colorScheme: 'dark'});
    const paper = await page.evaluate(() => {
        dispatchEvent(new Event('beforeprint'));
        const stage = document.querySelector('.stage canvas'), probe = new OffscreenCanvas(1, 1).getContext('2d');
        probe.drawImage(stage, 0, 0); // in the same turn, before the browser paints: what paper would show
        return [...probe.getImageData(0, 0, 1, 1).data];
    });
    console.log(`  corner of the printed picture: ${paper}`);
    assert.ok(Math.min(...paper) > 240, `expected white paper, got ${paper}`);
    assert.deepEqual(await page.locator('#specimens svg').evaluateAll((all) => all.map((one) => one.dataset.roles)), ['start', 'peak', 'end']);
    assert.ok(await page.locator('.transport').isHidden());
    assert.equal(await page.evaluate(() => document.documentElement.dataset.shown), 'light');
    await page.evaluate(() => dispatchEvent(new Event('afterprint')));
    assert.equal(await page.evaluate(() => document.documentElement.dataset.shown), 'dark');
    await close();
});
