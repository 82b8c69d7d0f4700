// SPDX-License-Identifier: GPL-3.0-or-later
// What `crackle report` puts into the page, and how it is unpacked.
// The page holds one JSON manifest; a test's numbers are little-endian arrays laid end to end, compressed with zlib and
// written as base64. The manifest says where each array begins. Units are SI in 2D: stress in N/m, angles in radians.

export type Kind = 'compression' | 'tension';

interface ArrayEntry {
    type: 'f64' | 'f32' | 'i32' | 'u8';
    offset: number; // bytes into the test's data
    length: number; // elements
}

interface FrameEntry {
    role: 'start' | 'peak' | 'end';
    file: string;
    time: number; // s
    axial_strain: number;
    prefix: string; // of its arrays: PREFIX.x, PREFIX.y, PREFIX.angle
}

interface TestEntry {
    name: string; // the folder's
    summary: Summary;
    arrays: Record<string, ArrayEntry>;
    frames: FrameEntry[];
    data: string; // base64 of zlib
}

interface Manifest {
    format: string;
    title: string;
    version: string;
    tests: TestEntry[];
}

/// summary.json as the test wrote it; keys and units are listed in the README.
export type Summary = Record<string, unknown>;

type NumberArray = Float64Array | Float32Array | Int32Array | Uint8Array;

export interface Curve {
    strain: NumberArray; // -, positive for the test's own kind
    stress: NumberArray; // N/m, likewise
    bondsBroken: NumberArray; // so far
}

export interface Events {
    count: number;
    time: NumberArray; // s
    strain: NumberArray;
    x: NumberArray; // m
    y: NumberArray;
    bodyI: NumberArray; // ids of the input
    bodyJ: NumberArray;
    shear: NumberArray; // 1: shear mode, 0: tension mode
    last: NumberArray; // 1: the pair's last bonded point
}

/// Bodies as they were in the first drawn frame.
export interface Bodies {
    id: NumberArray;
    radius: NumberArray; // m; 0 for polygons and open chains
    open: NumberArray; // 1: an open chain (a platen)
    firstPoint: NumberArray; // count + 1 entries into x and y
    x: NumberArray; // m, outlines
    y: NumberArray;
}

/// Where the bodies are in one frame: centre (mean of the outline's points) and angle.
export interface Frame {
    role: FrameEntry['role'];
    time: number;
    strain: number;
    x: NumberArray;
    y: NumberArray;
    angle: NumberArray;
}

export interface TestData {
    name: string;
    kind: Kind;
    specimen: string;
    failed: boolean;
    summary: Summary;
    curve: Curve;
    events: Events;
    bodies: Bodies;
    frames: Frame[];
}

export interface Report {
    title: string;
    version: string;
    tests: TestData[];
}

const bytesPerElement = {f64: 8, f32: 4, i32: 4, u8: 1} as const;

async function inflate(base64: string): Promise<ArrayBuffer> {
    const compressed = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const stream = new Blob([compressed]).stream().pipeThrough(new DecompressionStream('deflate'));
    return new Response(stream).arrayBuffer();
}

function view(buffer: ArrayBuffer, name: string, entry: ArrayEntry | undefined): NumberArray {
    if (!entry) throw new Error(`the report's data lack the array '${name}'`);
    if (entry.offset + entry.length * bytesPerElement[entry.type] > buffer.byteLength) {
        throw new Error(`the report's array '${name}' reaches beyond its data`);
    }
    switch (entry.type) {
        case 'f64': return new Float64Array(buffer, entry.offset, entry.length);
        case 'f32': return new Float32Array(buffer, entry.offset, entry.length);
        case 'i32': return new Int32Array(buffer, entry.offset, entry.length);
        case 'u8': return new Uint8Array(buffer, entry.offset, entry.length);
    }
}

async function unpackTest(entry: TestEntry): Promise<TestData> {
    const buffer = await inflate(entry.data);
    const array = (name: string) => view(buffer, name, entry.arrays[name]);
    return {
        name: entry.name,
        kind: entry.summary['kind'] === 'tension' ? 'tension' : 'compression',
        specimen: String(entry.summary['specimen'] ?? 'specimen'),
        failed: entry.summary['failed'] === true,
        summary: entry.summary,
        curve: {
            strain: array('curve.axial_strain'),
            stress: array('curve.axial_stress'),
            bondsBroken: array('curve.bonds_broken'),
        },
        events: {
            count: array('events.time').length,
            time: array('events.time'),
            strain: array('events.axial_strain'),
            x: array('events.x'),
            y: array('events.y'),
            bodyI: array('events.body_i'),
            bodyJ: array('events.body_j'),
            shear: array('events.shear'),
            last: array('events.last_of_interface'),
        },
        bodies: {
            id: array('bodies.id'),
            radius: array('bodies.radius'),
            open: array('bodies.open'),
            firstPoint: array('bodies.first_point'),
            x: array('bodies.x'),
            y: array('bodies.y'),
        },
        frames: entry.frames.map((frame) => ({
            role: frame.role,
            time: frame.time,
            strain: frame.axial_strain,
            x: array(`${frame.prefix}.x`),
            y: array(`${frame.prefix}.y`),
            angle: array(`${frame.prefix}.angle`),
        })),
    };
}

export async function readReport(source: HTMLElement | null): Promise<Report> {
    if (!source?.textContent) throw new Error('this page holds no data: make it with `crackle report`');
    const manifest = JSON.parse(source.textContent) as Manifest;
    if (manifest.format !== 'crackle-report 1') {
        throw new Error(`found data of format '${manifest.format}', expected 'crackle-report 1'`);
    }
    return {
        title: manifest.title,
        version: manifest.version,
        tests: await Promise.all(manifest.tests.map(unpackTest)),
    };
}

/// A number of summary.json, or undefined where the test does not state it.
export function numberOf(summary: Summary, key: string): number | undefined {
    const value = summary[key];
    return typeof value === 'number' && Number.isFinite(value) ? value : undefined;
}

/// The peak, and where it lies: that of the summary, under whichever key the test's outcome gives it.
export function peakOf(test: TestData): {strain: number | undefined; stress: number | undefined} {
    return {
        strain: numberOf(test.summary, 'peak_strain') ?? numberOf(test.summary, 'peak_strain_so_far'),
        stress: numberOf(test.summary, 'peak_stress') ?? numberOf(test.summary, 'peak_stress_so_far'),
    };
}
