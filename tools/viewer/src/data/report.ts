// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the data that `crackle report` and `crackle view` put into the page: format "crackle-report 2".
// A JSON manifest describes each test and gives the positions of its arrays in the blocks. Block 0 of a test holds its
// specimen, curve, breaks and slips as plain little-endian arrays. The others hold the frames, group by group
// (frames.ts). Units are SI in 2D: stress in N/m, angles in radians.

import {readBlock} from './blocks';
import type {Cells} from './cells';
import type {CodedEntry} from './coded_arrays';
import {plainArray, type ArrayEntry, type NumberArray} from './plain_arrays';

/// Kind of test, as named on the page.
export type Kind = string;
const kindNames: Record<string, Kind> = {scb: 'semi-circular bend'};

export type Role = 'start' | 'peak' | 'end';

/// One frame in the manifest.
export interface FrameEntry {
    time: number; // s
    axial_strain?: number;
    axial_stress?: number; // N/m
    step?: number;
    roles?: Role[];
    file?: string;
}

export interface GroupEntry {
    block: number;
    first: number; // index of the first frame
    count: number;
    arrays: Record<string, CodedEntry>;
}

/// Ids of a deck's bodies that have curves on the page, and the number of bodies for which the run wrote curves.
interface ListedBodies {
    ids: number[];
    of: number;
}

interface TestEntry {
    name: string; // unique on the page
    kind: 'test' | 'deck' | 'particles';
    summary: Summary;
    walls?: [number, number, number, number];
    sides?: [number, number]; // m, left and right end of the specimen over all frames, without splinters far away
    velocities?: 'mean'; // present if velocities are means between two frames
    curves?: {in_time: boolean; bodies: ListedBodies; velocities: ListedBodies}; // only for decks
    arrays: Record<string, ArrayEntry>;
    frames: FrameEntry[];
    groups: GroupEntry[];
}

interface Manifest {
    format: string;
    title: string;
    version: string;
    view: 'report' | 'view';
    units?: UnitNames;
    measured?: MeasuredCurve;
    tests: TestEntry[];
}

/// Names of the units of particle files and decks.
export interface UnitNames {
    length: string;
    velocity: string;
    force: string;
    energy: string;
    stress: string;
    prefixes: boolean; // whether SI prefixes can be added, as in kN
}

/// A curve from a laboratory, drawn over the curves of the tests.
export interface MeasuredCurve {
    label: string;
    strain: number[]; // -
    stress: number[]; // in the unit of the tests' stresses
}

/// summary.json as the test wrote it; keys and units are listed in specimens/results/FILES.md.
export type Summary = Record<string, unknown>;

export interface Curve {
    strain: NumberArray; // -, positive in the test's loading direction
    stress: NumberArray; // N/m, positive in the test's loading direction
    bondsBroken: NumberArray; // running total
}

/// Columns of energy.dat, in file order.
export const energyNames = ['enrg', 'enva', 'enka', 'enca', 'enfr', 'enxd', 'enxf', 'err', 'enfb'] as const;
export type EnergyName = (typeof energyNames)[number];

/// Values that the run of a deck wrote every nprn2 steps, in the deck's units, against time (or steps if times are unknown).
export interface DeckCurves {
    inTime: boolean;
    energy: {time: NumberArray; parts: Record<EnergyName, NumberArray>};
    bodies: {id: number; time: NumberArray; forceX: NumberArray; x: NumberArray; forceY: NumberArray; y: NumberArray}[];
    velocities: {id: number; time: NumberArray; vy: NumberArray}[];
    watched: number; // number of bodies for which the run wrote curves; the page has the first of them
}

/// Events of bonds (breaks or slips), ordered by time.
export interface BondEvents {
    count: number;
    time: NumberArray; // s
    strain: NumberArray;
    x: NumberArray; // m
    y: NumberArray;
    orientation: NumberArray; // direction of the contact normal, rad, in (-π/2, π/2]
}

/// Bond breaks.
export interface Events extends BondEvents {
    energy: NumberArray; // J
    bodyI: NumberArray; // ids of the bodies in the input
    bodyJ: NumberArray;
    shear: NumberArray; // 1: shear mode, 0: tension mode
    last: NumberArray; // 1 if this was the last bonded point of the pair
}

/// Bonded points of the first frame.
export interface Bonds {
    count: number;
    i: NumberArray; // cells
    j: NumberArray;
    x: NumberArray; // m, contact point
    y: NumberArray;
    halfX: NumberArray; // m, from the contact point to the second end of a face; empty without faces
    halfY: NumberArray;
}

export interface TestData {
    index: number; // position in the manifest
    name: string;
    source: TestEntry['kind'];
    meanVelocities: boolean; // whether velocities are means between two frames
    kind: Kind;
    specimen: string;
    failed: boolean;
    summary: Summary;
    walls: TestEntry['walls'];
    sides: TestEntry['sides'];
    curve: Curve | undefined; // only for tests
    deck: DeckCurves | undefined; // only for decks
    events: Events;
    slips: BondEvents | undefined; // first arrivals of bonds at their Coulomb limit; undefined if they were not recorded
    cells: Cells;
    bonds: Bonds;
    frames: FrameEntry[];
    groups: GroupEntry[];
}

/// A test with a curve, as needed for the report's figures and table.
export type CurvedTest = TestData & {curve: Curve};

export interface Report {
    title: string;
    version: string;
    view: Manifest['view'];
    units: UnitNames | undefined;
    measured: MeasuredCurve | undefined;
    tests: TestData[];
}

const none = new Uint8Array(0);

async function unpackTest(entry: TestEntry, index: number): Promise<TestData> {
    const buffer = await readBlock(index, 0);
    const optional = (name: string) => (entry.arrays[name] ? plainArray(buffer, name, entry.arrays[name]) : none);
    const array = (name: string) => {
        const found = entry.arrays[name];
        if (!found) throw new Error(`the page's data do not contain the array '${name}'`);
        return plainArray(buffer, name, found);
    };
    const bondEvents = (prefix: 'events' | 'slips'): BondEvents => ({
        count: optional(`${prefix}.time`).length,
        time: optional(`${prefix}.time`),
        strain: optional(`${prefix}.axial_strain`),
        x: optional(`${prefix}.x`),
        y: optional(`${prefix}.y`),
        orientation: optional(`${prefix}.orientation`),
    });
    const deckCurves = ({in_time: inTime, bodies, velocities}: NonNullable<TestEntry['curves']>): DeckCurves => ({
        inTime,
        energy: {time: array('energy.time'), parts: Object.fromEntries(energyNames.map((name) => [name, array(`energy.${name}`)])) as Record<EnergyName, NumberArray>},
        bodies: bodies.ids.map((id) => {
            const of = (name: string) => array(`body.${id}.${name}`);
            return {id, time: of('time'), forceX: of('force_x'), x: of('x'), forceY: of('force_y'), y: of('y')};
        }),
        velocities: velocities.ids.map((id) => ({id, time: array(`velocity.${id}.time`), vy: array(`velocity.${id}.vy`)})),
        watched: Math.max(bodies.of, velocities.of),
    });
    return {
        index,
        name: entry.name,
        source: entry.kind,
        meanVelocities: entry.velocities === 'mean',
        kind: kindNames[String(entry.summary['kind'])] ?? String(entry.summary['kind'] ?? 'compression').replaceAll('_', ' '),
        specimen: String(entry.summary['specimen'] ?? 'specimen'),
        failed: entry.summary['failed'] === true,
        summary: entry.summary,
        walls: entry.walls,
        sides: entry.sides,
        curve: entry.arrays['curve.axial_strain'] ? {
            strain: array('curve.axial_strain'),
            stress: array('curve.axial_stress'),
            bondsBroken: array('curve.bonds_broken'),
        } : undefined,
        deck: entry.curves && deckCurves(entry.curves),
        events: {
            ...bondEvents('events'),
            energy: optional('events.energy'),
            bodyI: optional('events.body_i'),
            bodyJ: optional('events.body_j'),
            shear: optional('events.shear'),
            last: optional('events.last_of_interface'),
        },
        slips: entry.arrays['slips.time'] ? bondEvents('slips') : undefined,
        cells: {
            count: array('cells.id').length,
            id: array('cells.id'),
            radius: array('cells.radius'),
            open: array('cells.open'),
            platen: array('cells.platen'),
            material: array('cells.material'),
            x: array('cells.x'),
            y: array('cells.y'),
            firstPoint: array('cells.first_point'),
            outlineX: array('outline.x'),
            outlineY: array('outline.y'),
        },
        bonds: {
            count: optional('bonds.i').length,
            i: optional('bonds.i'),
            j: optional('bonds.j'),
            x: optional('bonds.x'),
            y: optional('bonds.y'),
            halfX: optional('bonds.half_x'),
            halfY: optional('bonds.half_y'),
        },
        frames: entry.frames,
        groups: entry.groups,
    };
}

export async function readReport(source: HTMLElement | null): Promise<Report> {
    if (!source?.textContent) throw new Error('this page contains no data: create it with `crackle report` or `crackle view`');
    const manifest = JSON.parse(source.textContent) as Manifest;
    if (manifest.format !== 'crackle-report 2') {
        throw new Error(`found data of format '${manifest.format}', expected 'crackle-report 2'`);
    }
    return {
        title: manifest.title,
        version: manifest.version,
        view: manifest.view,
        units: manifest.units,
        measured: manifest.measured,
        tests: await Promise.all(manifest.tests.map(unpackTest)),
    };
}

/// The largest of the values, at least 0.
export function largestOf(values: ArrayLike<number>): number {
    let largest = 0;
    for (let at = 0; at < values.length; ++at) largest = Math.max(largest, values[at]!);
    return largest;
}

/// Whether the test recorded any slips.
export function hasSlips(test: TestData): test is TestData & {slips: BondEvents} {
    return test.slips !== undefined && test.slips.count > 0;
}

/// Time of the last frame, break or slip, s.
export function lastTimeOf({frames, events, slips}: TestData): number {
    return Math.max(frames[frames.length - 1]?.time ?? 0, largestOf(events.time), largestOf(slips?.time ?? none));
}

/// Names of the minerals in the order of their material numbers; empty for a rock of one material.
export function mineralsOf(summary: Summary): string[] {
    const minerals = summary['minerals'];
    return Array.isArray(minerals) ? minerals.map((mineral: {name: string}) => mineral.name) : [];
}

/// Whether the case gives stiffnesses and strengths per area, so that stresses are in Pa.
export const inArea = (test: {summary: Summary}): boolean => test.summary['material_units'] === 'area';
/// Unit of a test's stresses and moduli.
export const stressUnitOf = (test: {summary: Summary}): string => (inArea(test) ? 'Pa' : 'N/m');

export function numberOf(summary: Summary, key: string): number | undefined {
    const value = summary[key];
    return typeof value === 'number' && Number.isFinite(value) ? value : undefined;
}

/// Strain and stress at the peak, from the summary. Its keys depend on whether the specimen failed.
export function peakOf(test: TestData): {strain: number | undefined; stress: number | undefined} {
    return {
        strain: numberOf(test.summary, 'peak_strain') ?? numberOf(test.summary, 'peak_strain_so_far'),
        stress: numberOf(test.summary, 'peak_stress') ?? numberOf(test.summary, 'peak_stress_so_far'),
    };
}
