// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a results folder independently of the program and of the page.
import {existsSync, readFileSync} from 'node:fs';
import {join} from 'node:path';
import {inflateSync} from 'node:zlib';

export function table(file) {
    const [names, ...rows] = readFileSync(file, 'utf8').trim().split('\n').map((line) => line.split(','));
    return rows.map((row) => Object.fromEntries(names.map((name, column) => [name, Number.isNaN(Number(row[column])) ? row[column] : Number(row[column])])));
}

export function results(folder) {
    return {
        summary: JSON.parse(readFileSync(join(folder, 'summary.json'), 'utf8')),
        curve: table(join(folder, 'curve.csv')),
        events: table(join(folder, 'events.csv')),
        slips: existsSync(join(folder, 'slips.csv')) ? table(join(folder, 'slips.csv')) : undefined,
    };
}

/// Pairs of bodies with a break at or before a time; each pair is one crack.
export function brokenPairs(events, until) {
    return new Set(events.filter((event) => event.time <= until).map(({body_i: i, body_j: j}) => `${Math.min(i, j)} ${Math.max(i, j)}`)).size;
}

/// Stress of the curve, interpolated linearly between rows.
export function stressAt(curve, strain) {
    const after = curve.findIndex((row) => row.axial_strain >= strain);
    if (after <= 0) return curve[Math.max(0, after)].axial_stress;
    const [a, b] = [curve[after - 1], curve[after]];
    return a.axial_stress + (b.axial_stress - a.axial_stress) * (strain - a.axial_strain) / (b.axial_strain - a.axial_strain);
}

/// Reads one array of a VTK file: blocks compressed with zlib, preceded by their sizes, both in base64.
function vtkArray(text, name, nth = 0) {
    const found = [...text.matchAll(new RegExp(`<DataArray type="(\\w+)" Name="${name}"[^>]*>([^<]*)<`, 'g'))][nth];
    const [, type, raw] = found, base64 = raw.trim();
    const blocks = Number(Buffer.from(base64.slice(0, 12), 'base64').readBigUInt64LE(0));
    const headLetters = 4 * Math.ceil(8 * (3 + blocks) / 3);
    const head = Buffer.from(base64.slice(0, headLetters), 'base64'), data = Buffer.from(base64.slice(headLetters), 'base64');
    const parts = [];
    for (let block = 0, at = 0; block < blocks; ++block) {
        const size = Number(head.readBigUInt64LE(8 * (3 + block)));
        parts.push(inflateSync(data.subarray(at, at += size)));
    }
    const bytes = Buffer.concat(parts), buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
    return Array.from(new {Float64: Float64Array, Float32: Float32Array, Int32: Int32Array, Int64: BigInt64Array}[type](buffer), Number);
}

/// Particles of a frame by number: position (mean of the outline), radius, velocity and shear stress. Lines (platens)
/// precede polygons.
export function particles(file) {
    const text = readFileSync(file, 'utf8');
    const points = vtkArray(text, 'points'), ids = vtkArray(text, 'id'), radii = vtkArray(text, 'radius'), velocity = vtkArray(text, 'velocity'), shear = vtkArray(text, 'stress_xy');
    const found = new Map();
    let cell = 0;
    for (const part of [0, 1]) {
        const connectivity = vtkArray(text, 'connectivity', part);
        let first = 0;
        for (const end of vtkArray(text, 'offsets', part)) {
            const corners = connectivity.slice(first, end);
            const mean = (axis) => corners.reduce((sum, corner) => sum + points[3 * corner + axis], 0) / corners.length;
            found.set(ids[cell], {x: mean(0), y: mean(1), radius: radii[cell], velocity: Math.hypot(velocity[3 * cell], velocity[3 * cell + 1]), shear: shear[cell]});
            first = end;
            ++cell;
        }
    }
    return found;
}
