// SPDX-License-Identifier: GPL-3.0-or-later
// Tests reports of generated results in headless Chromium: the page must agree with the files.
//   CRACKLE_PROGRAM, SAMPLE_RESULTS: the programs; CHROMIUM: the browser
import assert from 'node:assert/strict';
import {execFileSync} from 'node:child_process';
import {cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, before, test} from 'node:test';

import {launch, openPage} from './pages.mjs';
import {brokenPairs, results, stressAt} from './results.mjs';

const sixFolders = ['tension', 'compression'].flatMap((kind) => ['circles', 'delaunay', 'voronoi'].map((specimen) => `${specimen}-${kind}`));

let root, browser;

before(async () => {
    root = mkdtempSync(join(tmpdir(), 'crackle-browser-'));
    execFileSync(process.env.SAMPLE_RESULTS, [root]);
    report(sixFolders, 'six.html');
    report(['stopped'], 'stopped.html');
    report(['rubble', 'stopped'], 'rubble.html');
    report(['sliding', 'sticking', 'circles-tension'], 'slips.html');
    report(['markup', 'stopped'], 'markup.html');
    report(['markup'], 'markup-title.html');
    for (const [lab, seed] of [['first', 1], ['second', 2]]) copied(join(lab, 'c'), {title: 'Wet rock', seed});
    report(['first/c', 'second/c'], 'same-name.html');
    copied('in-area', {material_units: 'area', bond_law: 'coulomb', mean_tensile_strength: 123, mean_cohesion: 456, out_of_plane_thickness: 1});
    report(['in-area'], 'area.html');
    report(['in-area', 'circles-compression'], 'both-units.html');
    copied('judged', {
        material_units: 'area', peak_stress: 60.1e6, peak_strain: 2.5e-3, fracture_toughness: 1.13e6, valid: false, numerical_errors: {peak_stress: {stated: 0.034}},
        validity: [{claim: 'the specimen is wide', holds: false}, {claim: 'gauge', holds: true}],
    });
    report(['judged'], 'judged.html');
    browser = await launch();
});

after(async () => {
    await browser?.close();
    if (root) rmSync(root, {recursive: true, force: true});
});

/// A copy of the circles' results in tension with changed entries in the summary.
function copied(folder, entries) {
    cpSync(join(root, 'circles-tension'), join(root, folder), {recursive: true});
    const file = join(root, folder, 'summary.json');
    writeFileSync(file, JSON.stringify({...JSON.parse(readFileSync(file, 'utf8')), ...entries}));
}

function report(folders, page) {
    execFileSync(process.env.CRACKLE_PROGRAM, ['report', ...folders.map((folder) => join(root, folder)), '-o', join(root, page)]);
}

const open = (file, options) => openPage(browser, join(root, file), options);

/// Heights of all shapes of one fill in a panel, px.
const filledHeights = (panel, fill) => panel.locator(`path[fill="${fill}"]`).evaluateAll((shapes) => shapes.map((shape) => shape.getBBox().height));

test('opens without a console error, and nothing is asked of the network', async () => {
    const {page, close} = await open('six.html');
    for (const view of ['specimen', 'test', 'kind']) await page.click(`button[data-value="${view}"]`);
    for (const factor of ['20', '1']) await page.click(`button[data-value="${factor}"]`);
    await page.click('button.theme');
    await close();
});

test('a report first states strength, its error and the verdict, with the broken specimen beside the curve', async () => {
    const {page, close} = await open('judged.html');
    const text = (await page.locator('#findings').textContent()).replaceAll('\u202f', ' ');
    for (const part of ['Fracture toughness1.13 MPa √m', 'Strength60.1 MPa', 'at a strain of 2.50 ‰, ± 3.4 %', 'Not a valid test: condition not met: the specimen is wide']) assert.ok(text.includes(part), `${part} in ${text}`);
    const [curve, broken] = await Promise.all(['.curve', '.broken svg'].map((name) => page.locator(`#curves ${name}`).boundingBox()));
    assert.ok(broken.x >= curve.x + curve.width && broken.y < curve.y + curve.height, 'side by side');
    await close();
    const six = await open('six.html');
    const rows = six.page.locator('#findings tbody tr');
    assert.equal(await rows.count(), 6);
    for (const folder of sixFolders) {
        const {peak_stress: peak} = JSON.parse(readFileSync(join(root, folder, 'summary.json'), 'utf8'));
        const shown = (await six.page.locator(`#findings tr[data-test="${folder}"] td.value`).textContent()).replaceAll('\u202f', ' ').match(/^([\d.]+) (k?)N\/m$/);
        assert.ok(Math.abs(Number(shown[1]) * (shown[2] ? 1e3 : 1) / peak - 1) < 5.1e-3, `${folder}: ${shown[0]}, ${peak}`);
    }
    assert.equal(await six.page.locator('#curves .broken svg').count(), 6);
    await six.close();
});

test('two panels, tension and compression, each with three curves that rise to the peaks of the summaries', async () => {
    const {page, close} = await open('six.html');
    assert.deepEqual(await page.locator('[data-panel]').evaluateAll((panels) => panels.map((panel) => panel.dataset.panel)), ['Tension', 'Compression']);
    for (const kind of ['tension', 'compression']) {
        const panel = page.locator(`[data-panel="${kind === 'tension' ? 'Tension' : 'Compression'}"]`);
        const text = await panel.textContent();
        const heights = await panel.locator('path[stroke-width="1.6"]').evaluateAll((curves) => curves.map((curve) => curve.getBBox().height));
        assert.equal(heights.length, 3, `${kind}: expected 3 stress curves, got ${heights.length}`);
        assert.equal(await panel.locator('path[stroke-width="1.3"]').count(), 3, `${kind}: lines of the breaks so far`);
        const peaks = ['circles', 'delaunay', 'voronoi'].map((specimen) => results(join(root, `${specimen}-${kind}`)).summary.peak_stress);
        peaks.forEach((peak, index) => {
            const shown = (peak / 1000).toPrecision(3);
            assert.match(text, new RegExp(`${shown.replace('.', '\\.')}\\s?kN/m`), `${kind}: peak ${shown} kN/m is not shown`);
            const expected = peak / peaks[0], got = heights[index] / heights[0];
            console.log(`  ${kind}: height over that of the circles' curve: expected ${expected.toFixed(3)}, got ${got.toFixed(3)}`);
            assert.ok(Math.abs(got - expected) < 0.02 * expected, `${kind}: curve ${index}: expected height ${expected}, got ${got}`);
        });
        assert.ok(Math.max(...heights) > 200, `the strongest curve should fill the panel, got ${Math.max(...heights)} px`);
    }
    await close();
});

test('bars of bond breaks add up to the events, mode by mode', async () => {
    const {page, close} = await open('six.html', {colorScheme: 'light'});
    await page.click('button[data-value="test"]');
    for (const folder of sixFolders) {
        const {events} = results(join(root, folder));
        const shear = events.filter((event) => event.mode === 'shear').length;
        const [specimen, kind] = folder.split('-');
        const panel = page.locator(`[data-panel="${specimen[0].toUpperCase()}${specimen.slice(1)}, ${kind}"]`);
        const sum = (values) => values.reduce((total, value) => total + value, 0);
        const drawn = {tension: sum(await filledHeights(panel, '#0072b2')), shear: sum(await filledHeights(panel, '#d55e00'))};
        const expected = shear / (events.length - shear), got = drawn.shear / drawn.tension;
        console.log(`  ${folder}: shear to tension bars: expected ${expected.toFixed(4)}, got ${got.toFixed(4)}`);
        assert.ok(Math.abs(got - expected) < 0.01 * expected, `${folder}: shear to tension bars: expected ${expected}, got ${got}`);
        assert.ok((await panel.textContent()).includes(`${events.length} breaks`), `${folder}: expected ${events.length} breaks`);
    }
    await close();
});

test('each specimen is drawn at start, peak and end with all its particles, its platens and its broken bonds', async () => {
    const {page, close} = await open('six.html');
    for (const folder of sixFolders) {
        const {summary, curve, events} = results(join(root, folder));
        const drawings = page.locator(`#specimens article[data-test="${folder}"] svg`);
        assert.deepEqual(await drawings.evaluateAll((all) => all.map((one) => one.dataset.roles)), ['start', 'peak', 'end']);
        const times = [0, summary.peak_strain / 0.01, curve.at(-1).time];
        for (const [index, time] of times.entries()) {
            const drawn = await drawings.nth(index).evaluate((svg) => Object.fromEntries(
                [...svg.querySelectorAll('path[data-count]')].map((path) => [path.getAttribute('class'), Number(path.dataset.count)])));
            assert.equal(drawn.grains, summary.particles, `${folder}: particles`);
            assert.equal(drawn.platens, 2, `${folder}: platens`);
            const faces = drawn.tension + drawn.shear + drawn['tension-part'] + drawn['shear-part'];
            assert.equal(faces, 2 * brokenPairs(events, time * (1 + 1e-12)), `${folder} at ${time} s: faces of broken interfaces`);
        }
        const caption = await page.locator(`#specimens article[data-test="${folder}"] figcaption`).last().textContent();
        assert.ok(caption.includes(`${events.length} broken`), `${folder}: expected ${events.length} broken, got '${caption}'`);
    }
    await close();
});

test('the cursor reads the stress off the curve', async () => {
    const {page, close} = await open('six.html');
    const panel = page.locator('[data-panel="Tension"] .panel');
    await panel.scrollIntoViewIfNeeded();
    const box = await panel.boundingBox();
    await page.mouse.move(box.x + 200, box.y + 180);
    await page.mouse.move(box.x + 204, box.y + 180);
    const cursor = page.locator('[data-panel="Tension"] .cursor');
    await cursor.locator('table').waitFor({state: 'visible', timeout: 5000});
    const place = await cursor.boundingBox();
    assert.ok(place.y >= box.y + box.height - 0.5, `the values stand below the curves: expected from ${box.y + box.height} px on, got ${place.y}`);
    assert.equal(await page.locator('[data-panel="Tension"] .panel > div[style*="pointer-events"]').count(), 0, 'no box over the curves');
    const strain = 1e-3 * Number((await cursor.locator('div div').first().textContent()).match(/strain ([\d.]+)\u202f‰/)[1]);
    const row = await cursor.locator('tr', {hasText: 'Voronoi'}).locator('td').first().textContent();
    const [, number, prefix] = row.match(/([\d.]+)\s?(k?)N\/m/);
    const got = Number(number) * (prefix ? 1000 : 1);
    const expected = stressAt(results(join(root, 'voronoi-tension')).curve, strain);
    console.log(`  stress at strain ${strain}: expected ${expected.toFixed(1)}, got ${got}`);
    assert.ok(Math.abs(got - expected) < 0.02 * expected, `stress at strain ${strain}: expected ${expected}, got ${got}`);
    await close();
});

test('the table states the summaries in one unit a row', async () => {
    const {page, close} = await open('six.html');
    const cells = async (name) => page.locator('table.summary tr', {has: page.locator(`th:text-is("${name}")`)}).locator('td').allTextContents();
    const [unit, ...peaks] = await cells('Peak stress');
    assert.equal(unit, 'kN/m');
    assert.deepEqual(peaks, sixFolders.map((folder) => (results(join(root, folder)).summary.peak_stress / 1000).toPrecision(3)));
    assert.deepEqual((await cells('Failed')).slice(1), sixFolders.map(() => 'yes'));
    assert.deepEqual((await cells('Young’s modulus E')).slice(0, 3), ['MN/m', '5.10', '16.0']);
    assert.deepEqual((await cells('Peak stress: stated')).slice(0, 2), ['%', '1.2']);
    assert.deepEqual((await cells('Peak stress: time step')).slice(0, 2), ['%', '0.40']);
    assert.deepEqual(await cells('Peak stress: loading rate'), [], 'a row of nothing is left out');
    assert.deepEqual((await cells('Peak converged')).slice(1), sixFolders.map(() => 'yes'));
    assert.deepEqual(await cells('Larger stress after the peak'), []);
    assert.deepEqual((await cells('Time step over the stable one')).slice(0, 2), ['%', '80']);
    await close();
});

test('a test that has not failed is marked as such, beside the curve, in the table and by its drawings', async () => {
    const {page, close} = await open('stopped.html');
    assert.match(await page.locator('.notice.warning').textContent(), /^Not failed: Voronoi, compression \(ended by max_axial_strain\)\. .*peak so far/);
    assert.match(await page.locator('[data-panel]').textContent(), /peak so far/);
    assert.match(await page.locator('table.summary').textContent(), /no: peak so far/);
    assert.match(await page.locator('#specimens article .warning').textContent(), /not failed/);
    await close();
});

/// Pairs of texts whose boxes overlap by more than a pixel.
const overlaps = (texts) => texts.evaluateAll((all) => {
    const boxes = all.map((one) => ({text: one.textContent, box: one.getBoundingClientRect()})).filter(({text, box}) => text.trim() !== '' && box.width > 0);
    return boxes.flatMap((a, at) => boxes.slice(at + 1).filter((b) => Math.min(a.box.right, b.box.right) - Math.max(a.box.left, b.box.left) > 1
        && Math.min(a.box.bottom, b.box.bottom) - Math.max(a.box.top, b.box.top) > 1).map((b) => `${a.text} / ${b.text}`));
});

test('labels of the rose keep apart: angles outside, counts on their circles', async () => {
    const {page, close} = await open('six.html');
    const roses = page.locator('.rose svg');
    assert.equal(await roses.count(), 6);
    for (let at = 0; at < 6; ++at) {
        const rose = roses.nth(at), folder = await page.locator('.card.breaks').nth(at).getAttribute('data-test');
        assert.deepEqual(await overlaps(rose.locator('text')), [], folder);
        assert.deepEqual(await rose.locator('text.angle').allTextContents(), ['0°', '90°', '180°', '270°']);
        const counts = (await rose.locator('text.count').allTextContents()).map(Number), {events} = results(join(root, folder));
        const classes = new Array(18).fill(0);
        for (const {orientation} of events) classes[Math.round((orientation * 180 / Math.PI + 90) / 10) % 18] += 1;
        const most = Math.max(...classes), outer = counts.at(-1);
        const radius = Math.max(...await rose.locator('circle').evaluateAll((all) => all.map((one) => Number(one.getAttribute('r')))));
        const far = await rose.locator('path.sector').evaluateAll((all) => Math.max(...all.flatMap((one) => one.getAttribute('d').match(/[ML]([\d.]+) ([\d.]+)/g)
            .map((point) => point.slice(1).split(' ').map(Number)).map(([x, y]) => Math.hypot(x - 118, y - 118)))));
        console.log(`  ${folder}: ${most} of ${events.length} in the fullest class, circles ${counts}: longest sector ${far.toFixed(1)} of ${radius} px`);
        assert.ok(outer >= most && counts.length <= 4, `circles ${counts} for ${most}`);
        assert.ok(Math.abs(far / radius - most / outer) < 0.01, `longest sector: expected ${most / outer}, got ${far / radius}`);
    }
    await close();
});

test('results in folders of equal name have names of their own', async () => {
    const {page, close} = await open('same-name.html');
    const expected = ['Wet rock, seed 1', 'Wet rock, seed 2'];
    assert.equal(await page.locator('.about').textContent(), `2 virtual tests: ${expected.join(' · ')}`);
    assert.deepEqual((await page.locator('table.summary thead tr').last().locator('th').allTextContents()), expected);
    for (const part of ['#breaks', '#specimens']) assert.deepEqual(await page.locator(`${part} h3`).evaluateAll((all) => all.map((one) => one.firstChild.textContent)), expected, part);
    await close();
});

test('a click on a curve brings the specimens into view', async () => {
    for (const panel of ['Tension', 'Compression']) {
        const {page, close} = await open('six.html');
        const seen = () => page.locator('.stage').evaluate((stage) => {
            const box = stage.getBoundingClientRect();
            return Math.max(0, Math.min(innerHeight, box.bottom) - Math.max(0, box.top)) / box.height;
        });
        await page.locator('#curves h2').scrollIntoViewIfNeeded();
        const before = await seen(), box = await page.locator(`[data-panel="${panel}"] .panel`).boundingBox();
        await page.mouse.click(box.x + 0.6 * box.width, box.y + 200);
        await page.evaluate(() => window.crackle.settled());
        console.log(`  share of the picture on the screen: ${before.toFixed(2)} before, ${(await seen()).toFixed(2)} after`);
        assert.ok(before < 0.6 && await seen() > 0.95, `expected the picture on the screen, got ${await seen()} of it`);
        assert.ok((await page.evaluate(() => window.crackle.shown())).some(({frame}) => frame > 0));
        await close();
    }
});

test('on a phone titles, legends and notes are whole and keep apart', async () => {
    for (const file of ['six.html', 'same-name.html', 'stopped.html', 'slips.html']) {
        const {page, close} = await open(file, {viewport: {width: 390, height: 844}, isMobile: true, hasTouch: true});
        const off = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
        assert.ok(off <= 0, `${file}: runs ${off} px off the side`);
        const charts = page.locator('#curves .panel svg');
        for (let at = 0; at < await charts.count(); ++at) {
            const texts = charts.nth(at).locator('text');
            const cut = await texts.evaluateAll((all) => all.filter((one) => {
                const box = one.getBoundingClientRect(), sheet = one.ownerSVGElement.getBoundingClientRect();
                return box.width > 0 && (box.left < sheet.left - 1 || box.right > sheet.right + 1 || box.top < sheet.top - 1 || box.bottom > sheet.bottom + 1);
            }).map((one) => one.textContent));
            assert.deepEqual(cut, [], `${file}: cut`);
            const heads = texts.filter({hasText: /[A-Za-z]{3}/});
            assert.deepEqual(await overlaps(heads), [], `${file}: panel ${at}`);
        }
        const panes = await page.locator('.pane').evaluateAll((all) => all.map((one) => one.getBoundingClientRect().toJSON()));
        const titles = await page.locator('.text-overlay text').evaluateAll((all) => all.map((one) => ({text: one.textContent, box: one.getBoundingClientRect().toJSON()})));
        for (const {text, box} of titles.filter(({text}) => /,|ε/.test(text))) {
            assert.ok(panes.some((pane) => box.left >= pane.left - 1 && box.right <= pane.right + 1 && box.top >= pane.top - 2 && box.bottom <= pane.bottom + 2), `${file}: '${text}' leaves its pane`);
        }
        if (file === 'six.html') assert.equal(titles.filter(({text}) => /, (tension|compression)$/.test(text)).length, 6, 'six complete titles');
        await close();
    }
});

test('curves of one kind that would be slivers beside the other have panels of their own', async () => {
    const {page, close} = await open('six.html');
    await page.click('button[data-value="specimen"]');
    const titles = await page.locator('[data-panel]').evaluateAll((all) => all.map((one) => one.dataset.panel));
    const expected = ['circles', 'delaunay', 'voronoi'].flatMap((specimen) => {
        const name = specimen[0].toUpperCase() + specimen.slice(1);
        const [t, c] = ['tension', 'compression'].map((kind) => results(join(root, `${specimen}-${kind}`)));
        const share = (of) => Math.min(of(t), of(c)) / Math.max(of(t), of(c));
        const sliver = share(({curve}) => Math.max(...curve.map((row) => row.axial_stress))) < 0.25 || share(({curve}) => curve.at(-1).axial_strain) < 0.2;
        return sliver ? [`${name}, tension`, `${name}, compression`] : [name];
    });
    console.log(`  panels: ${titles.join('; ')}`);
    assert.deepEqual(titles, expected);
    await close();
});

test('a larger stress after the peak is marked, and a thickness gives stresses in MPa', async () => {
    const {page, close} = await open('rubble.html');
    const {summary} = results(join(root, 'rubble'));
    const row = (name) => page.locator('table.summary tr', {has: page.locator(`th:text-is("${name}")`)}).locator('td');
    const [unit, rubble, stopped] = await row('Larger stress after the peak').allTextContents();
    assert.deepEqual([unit, rubble, stopped], ['kN/m', '6.00', '–']);
    assert.deepEqual(await row('Larger stress after the peak').evaluateAll((cells) => cells.map((cell) => cell.classList.contains('warning'))), [false, true, false]);
    assert.deepEqual((await row('Peak stress over the thickness').allTextContents()).slice(0, 2), ['kPa', (summary.peak_stress / 0.05 / 1000).toPrecision(3)]);
    assert.deepEqual((await row('Larger stress after the peak over the thickness').allTextContents()).slice(0, 2), ['kPa', '120']);
    assert.match(await page.locator('[data-panel]').first().textContent(), new RegExp(`${(summary.peak_stress / 0.05 / 1000).toPrecision(3)}\\s?kPa`));
    assert.deepEqual((await row('Fragments at the end').allTextContents()).slice(0, 2), ['–', '3']);
    assert.deepEqual((await row('up to the peak in tension').allTextContents()).slice(1), ['2', '2']);
    assert.deepEqual((await row('Area strain at peak').allTextContents()).slice(1, 2), [(0.4 * summary.peak_strain * 1000).toPrecision(3)]);
    await close();
});

const slipFill = {light: '#009e73', dark: '#35c9a4'};

test('slips have a strip of their own below the breaks, with a bar for each interval', async () => {
    const {page, close} = await open('slips.html', {colorScheme: 'light'});
    const {events, slips} = results(join(root, 'sliding')), panel = page.locator('[data-panel="Compression"]');
    const text = await panel.textContent();
    assert.ok(text.includes(`${events.length} breaks`) && text.includes(`${slips.length} slips`), `expected ${events.length} breaks and ${slips.length} slips`);
    assert.doesNotMatch(text, /(^|\D)0 slips/, 'a test that had no slips has no strip of them');
    const width = 1e-3 * Number(text.match(/bars: breaks or slips in each ([\d.]+)\u202f‰/)[1]);
    const counts = new Map();
    for (const {axial_strain: strain} of slips) counts.set(Math.ceil(strain / width - 1e-9), (counts.get(Math.ceil(strain / width - 1e-9)) ?? 0) + 1);
    const bars = await filledHeights(panel, slipFill.light), highest = Math.max(...bars), fullest = Math.max(...counts.values());
    assert.equal(bars.length, counts.size, 'bars of slips');
    const got = bars.reduce((sum, bar) => sum + bar) / highest;
    console.log(`  slips over those of the fullest interval: expected ${(slips.length / fullest).toFixed(3)}, got ${got.toFixed(3)}`);
    assert.ok(Math.abs(got - slips.length / fullest) < 0.01 * got, `bars of slips: expected ${slips.length / fullest}, got ${got}`);

    const box = await panel.locator('.panel').boundingBox();
    await page.mouse.move(box.x + 0.5 * box.width, box.y + 180);
    await page.mouse.move(box.x + 0.5 * box.width + 3, box.y + 180);
    await panel.locator('.cursor table').waitFor({state: 'visible', timeout: 5000});
    const strain = 1e-3 * Number((await panel.locator('.cursor div div').first().textContent()).match(/strain ([\d.]+)\u202f‰/)[1]);
    const rows = await panel.locator('.cursor tr').evaluateAll((all) => all.map((row) => [...row.children].map((cell) => cell.textContent)));
    assert.deepEqual(rows[0], ['', 'stress', 'breaks here', 'so far', 'slips here', 'so far']);
    const soFar = Number(rows.find(([name]) => name === 'Voronoi')[5]), expected = slips.filter((one) => one.axial_strain <= strain).length;
    console.log(`  slips up to strain ${strain}: expected ${expected}, got ${soFar}`);
    assert.ok(expected > 50 && Math.abs(soFar - expected) <= 5, `expected ${expected} slips so far, got ${soFar}`); // the page rounds the strain
    assert.deepEqual(rows.find(([name]) => name === 'Circles').slice(4), ['–', '–']);
    const row = await page.locator('table.summary tr', {has: page.locator('th:text-is("Slips")')}).locator('td').allTextContents();
    assert.deepEqual(row, ['–', '–', '0', String(slips.length)], 'not recorded, none, some');
    await close();
});

test('the map shows every slip beneath the breaks, as a line along its contact, and hides them on request', async () => {
    const {slips, events} = results(join(root, 'sliding'));
    for (const colorScheme of ['light', 'dark']) {
        const {page, close} = await open('slips.html', {colorScheme});
        const card = page.locator('.card.breaks[data-test="sliding"]'), marks = card.locator(`.map path[fill="${slipFill[colorScheme]}"]`);
        assert.match(await card.locator('h3').textContent(), new RegExp(`${events.length} breaks, largest .*, ${slips.length} slips`));
        assert.equal(await marks.count(), slips.length, `${colorScheme}: slips`);
        assert.equal(await page.locator(`.card.breaks:not([data-test="sliding"]) path[fill="${slipFill[colorScheme]}"]`).count(), 0, 'slips of tests without slips.csv');
        const boxes = await marks.evaluateAll((all) => all.map((one) => {
            const {x, y, width, height} = one.getBoundingClientRect();
            return {x: x + width / 2, y: y + height / 2, width, height};
        }));
        for (const [axis, sign] of [['x', 1], ['y', -1]]) {
            const values = slips.map((slip) => slip[axis]), low = values.indexOf(Math.min(...values)), high = values.indexOf(Math.max(...values));
            const scale = (boxes[high][axis] - boxes[low][axis]) / (values[high] - values[low]);
            assert.ok(sign * scale > 0);
            const off = Math.max(...boxes.map((box, at) => Math.abs(box[axis] - boxes[low][axis] - scale * (values[at] - values[low]))));
            assert.ok(off < 1, `${axis} of slips: off by ${off} px`);
        }
        slips.forEach(({orientation}, at) => {
            // Directions of the contact, whose normal is at the orientation.
            const [along, across] = [Math.abs(Math.sin(orientation)), Math.abs(Math.cos(orientation))];
            if (Math.abs(along - across) > 0.3) assert.equal(boxes[at].width > boxes[at].height, along > across, `slip ${at}: normal at ${orientation}`);
        });
        const order = await card.locator('.map path').evaluateAll((all) => all.map((one) => one.getAttribute('fill')));
        const breaks = order.flatMap((fill, at) => (['#0072b2', '#d55e00', '#56b4e9', '#ff8c3a'].includes(fill) ? [at] : []));
        assert.equal(breaks.length, events.length, 'breaks');
        assert.ok(order.lastIndexOf(slipFill[colorScheme]) < breaks[0], 'slips are drawn before the breaks');
        await page.uncheck('#breaks input[type="checkbox"]');
        assert.equal(await marks.count(), 0, 'slips switched off');
        await page.click('#breaks button[data-value="time"]');
        await page.check('#breaks input[type="checkbox"]');
        assert.equal(await card.locator('.map path').count(), order.length, 'coloured by time: as many marks');
        await close();
    }
});

test('a page of tests without slips says nothing of them', async () => {
    const {page, close} = await open('six.html', {colorScheme: 'light'});
    assert.doesNotMatch(await page.locator('main').textContent(), /slips/i);
    assert.equal(await page.locator('#breaks input[type="checkbox"]').count(), 0);
    assert.equal(await page.locator(`#curves path[fill="${slipFill.light}"], #breaks path[fill="${slipFill.light}"]`).count(), 0);
    await close();
});

test('markup in a title stays text', async () => {
    for (const file of ['markup.html', 'markup-title.html']) {
        const {page, close} = await open(file);
        assert.notEqual(await page.title(), 'broken out');
        assert.equal(await page.locator('b:text-is("bold")').count(), 0);
        if (file === 'markup-title.html') {
            assert.equal(await page.locator('h1').textContent(), results(join(root, 'markup')).summary.title);
        }
        await close();
    }
});

test('light and dark, laptop and tablet width: readable, nothing runs off the side', async () => {
    const {page, close} = await open('six.html');
    for (const colorScheme of ['light', 'dark']) {
        await page.emulateMedia({colorScheme});
        for (const width of [1440, 1024, 768]) {
            await page.setViewportSize({width, height: 800});
            const runsOff = () => page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
            // Charts adapt to a new width through a resize observer, which is given a second.
            let overflow = await runsOff();
            for (let wait = 0; overflow > 0 && wait < 20; ++wait) {
                await page.waitForTimeout(50);
                overflow = await runsOff();
            }
            assert.ok(overflow <= 0, `${colorScheme}, ${width} px: runs ${overflow} px off the side`);
        }
        // The page applies a new colour scheme at its next redraw.
        await page.waitForFunction((scheme) => document.documentElement.dataset.shown === scheme, colorScheme, {timeout: 20000});
        const [paper, ink] = await page.evaluate(() => {
            const style = getComputedStyle(document.body);
            return [style.backgroundColor, style.color].map((colour) => colour.match(/\d+/g).map(Number).reduce((a, b) => a + b));
        });
        assert.ok(colorScheme === 'light' ? paper - ink > 400 : ink - paper > 400, `${colorScheme}: paper ${paper}, ink ${ink}`);
    }
    await close();
});

test('stresses are in Pa where stiffnesses are given of an area, and each test keeps its own unit', async () => {
    const peak = (results(join(root, 'in-area')).summary.peak_stress / 1000).toPrecision(3);
    const rows = async (page, name) => Promise.all((await page.locator('table.summary tr', {has: page.locator(`th:text-is("${name}")`)}).all()).map((row) => row.locator('td').allTextContents()));
    const alone = await open('area.html');
    assert.deepEqual(await rows(alone.page, 'Peak stress'), [['kPa', peak]]);
    assert.deepEqual(await rows(alone.page, 'Peak stress over the thickness'), [], 'Pa a second time');
    assert.deepEqual(await rows(alone.page, 'Mean back-tension'), [], 'a coulomb bond has none');
    assert.deepEqual(await rows(alone.page, 'Mean cohesion of a bond'), [['N', '456']]);
    const panel = await alone.page.locator('[data-panel]').textContent();
    assert.match(panel, new RegExp(`${peak}\\s?kPa`), 'label of the peak');
    assert.match(panel, /Axial stress \[kPa\]/);
    assert.doesNotMatch(await alone.page.locator('body').innerText(), /N\/m/);
    await alone.close();
    const both = await open('both-units.html');
    const other = (results(join(root, 'circles-compression')).summary.peak_stress / 1000).toPrecision(3);
    assert.deepEqual(await rows(both.page, 'Peak stress'), [['kPa', peak, '–'], ['kN/m', '–', other]]);
    await both.close();
});

test('the page is one file that names no other place to fetch from', () => {
    const page = readFileSync(join(root, 'six.html'), 'utf8');
    assert.doesNotMatch(page, /<(script|img|iframe|link)[^>]+(src|href)\s*=\s*["']?(https?:)?\/\//i);
    assert.match(page, /Content-Security-Policy" content="default-src 'none'/);
});
