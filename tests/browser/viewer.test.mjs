// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the viewer in headless Chromium with WebGL in software: what it shows, prints and saves must agree with files.
//   CRACKLE_PROGRAM, SAMPLE_RESULTS: the programs; SPECIMENS: folder of cases and decks; CHROMIUM: the browser
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {mkdtempSync, readdirSync, readFileSync, rmSync, statSync, writeFileSync} from 'node:fs';
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

/// Minerals of a case in which the largest grains are quartz.
const minerals = '[minerals]\nassign = "size"\n[[mineral]]\nname = "quartz"\narea_share = 0.5\n[[mineral]]\nname = "feldspar"\n';

before(async () => {
    root = mkdtempSync(join(tmpdir(), 'crackle-viewer-'));
    execFileSync(process.env.SAMPLE_RESULTS, [root]);
    crackle('report', ...sixFolders.map((folder) => join(root, folder)), '-o', join(root, 'six.html'));
    crackle('test', join(process.env.SPECIMENS, 'guide_rock', 'circles_tension.toml'), '-o', join(root, 'pulled'));
    crackle('view', join(root, 'pulled'), '-o', join(root, 'pulled.html'));
    crackle('test', join(process.env.SPECIMENS, 'guide_rock', 'circles_compression.toml'), '-o', join(root, 'squeezed'));
    crackle('test', join(process.env.SPECIMENS, 'guide_rock', 'voronoi_compression.toml'), '-o', join(root, 'burst'));
    crackle('view', join(root, 'burst'), '-o', join(root, 'burst.html'));
    crackle('view', join(root, 'pulled'), join(root, 'squeezed'), '-o', join(root, 'pair.html'));
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
/// The stage as shown on the screen, once it is at rest.
async function picture(page) {
    await settled(page);
    await page.waitForTimeout(400);
    return (await page.locator('.stage').screenshot()).toString('base64');
}
async function saved(page, kind) {
    const [download] = await Promise.all([page.waitForEvent('download', {timeout: 120000}), page.click(`button[data-save="${kind}"]`)]);
    return {name: download.suggestedFilename(), file: await download.path()};
}
/// Width, height, number of colours, and fraction of pixels that do not have the most frequent colour, as decoded by
/// the browser.
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
    await choose(page, 'speed', '0.25'); // slow, so that it is not over before a busy machine has clicked
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
        // Values are shown with a relative accuracy of 0.4 %, however small they are.
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

test('a test alone has its curve beside it, with the cursor', async () => {
    const {page, close} = await open('pulled.html');
    const stage = await page.locator('.stage').boundingBox(), curve = await page.locator('.beside-curve .panel').boundingBox(), front = await page.locator('.front').boundingBox();
    console.log(`  picture ${stage.width.toFixed(0)}, curve ${curve.width.toFixed(0)} of ${front.width.toFixed(0)} px`);
    assert.ok(stage.width < 0.55 * front.width && curve.width > 0.4 * front.width && curve.x >= stage.x + stage.width, 'side by side');
    assert.ok(curve.y >= stage.y - 1 && curve.y + curve.height <= stage.y + stage.height + 1, 'as high as the picture');
    const line = () => page.locator('.beside-curve .cursor-line').evaluate((one) => parseFloat(one.style.left));
    const before = await line();
    await page.locator('.scrub').fill(await page.locator('.scrub').getAttribute('max'));
    await settled(page);
    const {curve: rows} = results(join(root, 'pulled')), span = curve.width - 66 - 58;
    console.log(`  cursor at the end: expected ${(before + span).toFixed(0)} px, got ${(await line()).toFixed(0)}`);
    assert.ok(Math.abs(await line() - before - span) < 3, `cursor: expected at the end of the curve (${rows.length} rows)`);
    await close();
});

test('the residual of the solve for the modulus is not shown as its error', async () => {
    const {page, close} = await open('pulled.html');
    const {stated} = results(join(root, 'pulled')).summary.numerical_errors.youngs_modulus;
    assert.ok(stated > 0 && stated < 1e-9, `this test is of a residual, found ${stated}`);
    const rows = await page.locator('table.summary th[scope="row"]').allTextContents();
    assert.ok(rows.includes('Peak stress: energy closing'), 'other errors are listed');
    assert.deepEqual(rows.filter((name) => /modulus.*stated/.test(name)), []);
    await close();
});

test('no stress is printed where there is none', async () => {
    const {page, close} = await open('pulled.html');
    const {summary, curve} = results(join(root, 'pulled'));
    console.log(`  first row: ${curve[0].axial_stress} N/m of ${summary.peak_stress}`);
    assert.ok(curve[0].axial_stress > 0, 'this test needs a stress that is not exactly 0');
    const title = await page.locator('.stage').textContent();
    assert.match(title, /ε = 0\s+σ ≈ 0/);
    assert.doesNotMatch(title, /mN\/m/);
    await page.keyboard.press('End');
    await settled(page);
    assert.match(await page.locator('.stage').textContent(), /σ = [\d.]+\s?k?N\/m/);
    await close();
});

/// The number after a text in the picture's legend, converted by its unit.
async function legendNumber(page, before) {
    const text = (await page.locator('.stage').textContent()).match(new RegExp(`${before}\\s*(?:≥\\s*)?([\\d.]+)\\s*([kMµmn]?)N`));
    return Number(text[1]) * ({k: 1e3, M: 1e6, m: 1e-3, µ: 1e-6, n: 1e-9}[text[2]] ?? 1);
}

test('widths of forces mean the same whichever tests are shown', async () => {
    const {page, close} = await open('pair.html');
    const widest = async () => {
        await settled(page);
        return legendNumber(page, 'Contact force, widest');
    };
    await page.click('[data-layer="forces"]');
    const side = await widest();
    const alone = [];
    await choose(page, 'layout', 'one');
    for (const at of ['0', '1']) {
        await choose(page, 'test', at);
        alone.push(await widest());
    }
    await choose(page, 'layout', 'over');
    console.log(`  widest force: side by side ${side} N, alone ${alone} N, overlaid ${await widest()} N`);
    assert.deepEqual([...alone, await widest()], [side, side, side]);
    await choose(page, 'layout', 'one');
    await choose(page, 'test', '0');
    await choose(page, 'forces-of', 'shown');
    const own = await widest();
    await choose(page, 'test', '1');
    console.log(`  on their own: ${own} N pulled, ${await widest()} N squeezed`);
    assert.equal(Math.max(own, await widest()), side, 'only of the requested test');
    assert.notEqual(own, await widest());
    await close();
});

test('colours are those of the frames up to the peak, so that what precedes the collapse is seen', async () => {
    const {page, close} = await open('pulled.html');
    const {summary} = results(join(root, 'pulled')), folder = join(root, 'pulled', 'frames');
    const peak = Number(summary.frame_peak.match(/(\d+)\.vtp/)[1]), ids = Array.from({length: summary.particles}, (_, at) => at + 1);
    const percentile = (last) => {
        const sizes = readdirSync(folder).filter((name) => name.startsWith('particles_') && Number(name.match(/\d+/)[0]) <= last)
            .flatMap((name) => { const found = particles(join(folder, name)); return ids.map((id) => found.get(id).velocity); }).sort((a, b) => a - b);
        return sizes[Math.floor(0.98 * (sizes.length - 1))];
    };
    const shownEnd = async () => {
        await settled(page);
        const [, number, unit] = (await page.locator('.stage').textContent()).match(/Velocity \[([µmn]?)m\/s\]/) ? ['', (await page.locator('.text-overlay text').allTextContents()).find((text) => text.startsWith('≥')).replace(/[^\d.]/g, ''),
            (await page.locator('.stage').textContent()).match(/Velocity \[([µmn]?)m\/s\]/)[1]] : [];
        return Number(number) * ({m: 1e-3, µ: 1e-6, n: 1e-9}[unit] ?? 1);
    };
    await choose(page, 'quantity', 'velocity');
    const upTo = await shownEnd(), expected = percentile(peak);
    await choose(page, 'range', 'all');
    const all = await shownEnd(), expectedAll = percentile(Infinity);
    console.log(`  end of the scale: up to the peak expected ${expected.toPrecision(3)}, got ${upTo} m/s; of all frames expected ${expectedAll.toPrecision(3)}, got ${all} m/s`);
    assert.ok(Math.abs(upTo - expected) < 0.02 * expected, `up to the peak: expected ${expected}, got ${upTo}`);
    assert.ok(Math.abs(all - expectedAll) < 0.02 * expectedAll, `of all frames: expected ${expectedAll}, got ${all}`);
    await close();
});

test('lists of choices and of contacts cut no text', async () => {
    for (const [file, options] of [['six.html', {}], ['pulled.html', {}], ['deck.html', {}], ['six.html', {viewport: {width: 390, height: 844}}]]) {
        const {page, close} = await open(file, options);
        await page.locator('.scrub').fill('3');
        await settled(page);
        const [{test: name}] = await shown(page);
        await page.locator('.stage').scrollIntoViewIfNeeded();
        const folder = join(root, name), ids = file === 'deck.html' ? [] : [results(folder).events[0].body_i];
        for (const id of ids) {
            const at = await page.evaluate(([test, number]) => window.crackle.place(test, number), [name, id]);
            await page.mouse.click(at.x, at.y);
        }
        await choose(page, 'quantity', 'displacement_x');
        const cut = await page.locator('.viewer select').evaluateAll((lists) => lists.flatMap((list) => {
            const style = getComputedStyle(list), ruler = new OffscreenCanvas(1, 1).getContext('2d');
            ruler.font = `${style.fontSize} ${style.fontFamily}`;
            const room = list.clientWidth - 26; // arrow and padding
            return [...list.options].filter((option) => ruler.measureText(option.text).width > room).map((option) => `${option.text}: ${ruler.measureText(option.text).width.toFixed(0)} of ${room} px`);
        }));
        assert.deepEqual(cut, [], `${file}: choices`);
        const wide = await page.locator('.inspector details').evaluateAll((all) => all.map((one) => one.scrollWidth - one.clientWidth));
        assert.deepEqual(wide.filter((over) => over > 0), [], `${file}: contacts`);
        await close();
    }
});

test('fragments are whole or left out in drawings, and near ones lie within the picture', async () => {
    const {page, close} = await open('burst.html');
    const drawings = page.locator('#specimens svg, .fragments svg');
    assert.equal(await drawings.count(), 4);
    const over = await drawings.evaluateAll((all) => all.map((svg) => {
        const {width, height} = svg.viewBox.baseVal;
        return [...svg.querySelectorAll('.grains')].map((one) => one.getBBox()).reduce((most, {x, y, width: w, height: h}) => Math.max(most, -x, -y, x + w - width, y + h - height), 0);
    }));
    assert.deepEqual(over, [0, 0, 0, 0], 'px by which particles leave their drawings');
    const {summary} = results(join(root, 'burst')), drawn = await page.locator('#specimens svg').nth(2).locator('.grains').getAttribute('data-count');
    const text = await page.locator('#specimens figcaption').nth(2).textContent(), leftOut = Number(text.match(/(\d+) particles farther out/)[1]);
    console.log(`  at the end ${drawn} of ${summary.particles} drawn, ${leftOut} left out`);
    assert.equal(Number(drawn) + leftOut, summary.particles);
    await page.keyboard.press('End');
    await settled(page);
    const first = particles(join(root, 'burst', summary.frame_start)), last = particles(join(root, 'burst', summary.frame_end));
    const ids = Array.from({length: summary.particles}, (_, at) => at + 1), xs = ids.map((id) => first.get(id).x), width = Math.max(...xs) - Math.min(...xs);
    const pane = await page.locator('.pane').boundingBox();
    const near = ids.filter((id) => last.get(id).x > Math.min(...xs) - 0.35 * width && last.get(id).x < Math.max(...xs) + 0.35 * width);
    const places = await page.evaluate((all) => all.map((id) => window.crackle.place('burst', id)), near);
    const outside = places.filter(({x}) => x < pane.x || x > pane.x + pane.width).length;
    console.log(`  ${near.length} particles near the specimen at the end, ${outside} of them outside the picture`);
    assert.ok(near.length > 200);
    assert.equal(outside, 0);
    await close();
});

test('outlines leave small particles their colour', async () => {
    for (const [options, most] of [[{viewport: {width: 390, height: 844}, deviceScaleFactor: 2}, 0.3], [{}, 0.35]]) {
        const {page, close} = await open('six.html', options);
        const darkness = async () => {
            const base64 = await picture(page);
            return page.evaluate(async (data) => {
                const bitmap = await createImageBitmap(new Blob([Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0))]));
                const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
                context.drawImage(bitmap, 0, 0);
                const values = context.getImageData(0, 0, bitmap.width, bitmap.height).data;
                let sum = 0;
                for (let at = 0; at < values.length; at += 4) sum += 255 - values[at + 1];
                return sum;
            }, base64);
        };
        for (const layer of ['platens', 'cracks']) await page.click(`[data-layer="${layer}"]`);
        const lined = await darkness();
        await page.click('[data-layer="outlines"]');
        const more = lined / await darkness() - 1;
        console.log(`  outlines darken the specimens by ${(100 * more).toFixed(0)} %`);
        assert.ok(more < most, `expected at most ${100 * most} %, got ${(100 * more).toFixed(0)} %`);
        if (!options.viewport) assert.ok(more > 0.03, 'outlines are visible');
        await close();
    }
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
        assert.ok(statSync(video.file).size > 10000, 'a video that is not empty');
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
    assert.equal(await frameNow(page), 0, 'the clock is at its start again');
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
    assert.ok(await page.locator('.beside-curve').isHidden(), 'a curve next to a single test');
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
    // All cracks on the screen share one time scale: up to the later of the two ends.
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
            if (data[at] - data[at + 2] < 5) continue; // particles have a warmer colour than paper and text
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
        probe.drawImage(stage, 0, 0); // before the browser paints, so this is what would be printed
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
