// SPDX-License-Identifier: GPL-3.0-or-later
// What the tests know of a folder of results, read independently of the program and of the page.
import {readFileSync} from 'node:fs';
import {join} from 'node:path';

export function table(file) {
    const [names, ...rows] = readFileSync(file, 'utf8').trim().split('\n').map((line) => line.split(','));
    return rows.map((row) => Object.fromEntries(names.map((name, column) => [name, Number.isNaN(Number(row[column])) ? row[column] : Number(row[column])])));
}

export function results(folder) {
    return {
        summary: JSON.parse(readFileSync(join(folder, 'summary.json'), 'utf8')),
        curve: table(join(folder, 'curve.csv')),
        events: table(join(folder, 'events.csv')),
    };
}

/// Pairs of bodies with a break at or before a time: one crack each.
export function brokenPairs(events, until) {
    return new Set(events.filter((event) => event.time <= until).map(({body_i: i, body_j: j}) => `${Math.min(i, j)} ${Math.max(i, j)}`)).size;
}

/// Linear between the curve's rows.
export function stressAt(curve, strain) {
    const after = curve.findIndex((row) => row.axial_strain >= strain);
    if (after <= 0) return curve[Math.max(0, after)].axial_stress;
    const [a, b] = [curve[after - 1], curve[after]];
    return a.axial_stress + (b.axial_stress - a.axial_stress) * (strain - a.axial_strain) / (b.axial_strain - a.axial_strain);
}
