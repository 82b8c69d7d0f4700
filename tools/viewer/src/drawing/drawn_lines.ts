// SPDX-License-Identifier: GPL-3.0-or-later
// Lines drawn over the particles at one moment: platens and walls, cracks, bonds, contact forces, and the picked particle.

import {paletteSize, rgb, type Rgb} from '../colours/palettes';
import type {Theme} from '../colours/theme';
import {outline, type Cells, type Point} from '../data/cells';
import type {Contacts, Frame} from '../data/frames';
import type {TestData} from '../data/report';
import {crackState, facesOf, type Crack, type CrackFace} from '../geometry/cracks';
import {movedCentre, moverOf} from '../geometry/rigid_motion';
import type {ForceScale} from '../quantities/ranges';
import type {Segments} from './segments';

const bondBroken = 2; // smallest state of a broken bond
const bondSlid = 1;
/// Forces below this fraction of the scale's end are left out.
export const smallestForceShown = 0.02;

export function addChains(lines: Segments, test: TestData, frame: Frame, magnification: number, theme: Theme): void {
    const {cells} = test, colour = rgb(theme.platen);
    for (let cell = 0; cell < cells.count; ++cell) {
        if (cells.open[cell] !== 1) continue;
        const move = moverOf(cells, frame, cell, magnification);
        addPath(lines, outline(cells, cell).map(move), 3, colour);
    }
    if (!test.walls) return;
    const [x1, x2, y1, y2] = test.walls;
    addPath(lines, [{x: x1, y: y1}, {x: x2, y: y1}, {x: x2, y: y2}, {x: x1, y: y2}, {x: x1, y: y1}], 1.5, colour);
}

/// Outlines of the polygons that the particle layer draws without an outline.
export function addOutlines(lines: Segments, cells: Cells, frame: Frame, jagged: readonly number[], magnification: number, theme: Theme): void {
    for (const cell of jagged) {
        const corners = outline(cells, cell);
        addPath(lines, [...corners, corners[0]!].map(moverOf(cells, frame, cell, magnification)), 1, rgb(theme.grainEdge));
    }
}

function addPath(lines: Segments, points: readonly Point[], width: number, colour: Rgb): void {
    points.slice(1).forEach((to, at) => lines.add(points[at]!.x, points[at]!.y, to.x, to.y, width, colour));
}

function addFaces(lines: Segments, cells: Cells, frame: Frame, faces: readonly CrackFace[], magnification: number, width: number, colour: Rgb, opacity: number): void {
    for (const face of faces) {
        const move = moverOf(cells, frame, face.cell, magnification);
        const from = move(face.from), to = move(face.to);
        lines.add(from.x, from.y, to.x, to.y, width, colour, opacity);
    }
}

export interface CrackColours {
    by: 'mode' | 'time';
    listed: boolean; // whether a shown test has a list of its breaks
    unlisted: boolean; // whether breaks of a shown test are known only from the state of its bonds
    palette: readonly Rgb[]; // colours for times from 0 to lastTime
    lastTime: number; // s, end of the longest of the shown tests
}

export function addCracks(lines: Segments, test: TestData, cracks: readonly Crack[], frame: Frame, magnification: number, colours: CrackColours, theme: Theme): void {
    const modes = {shear: rgb(theme.shear), tension: rgb(theme.tension)};
    for (const crack of cracks) {
        const state = crackState(crack, frame.time);
        if (!state) continue;
        const share = colours.lastTime > 0 ? state.since / colours.lastTime : 0;
        const colour = colours.by !== 'time' ? (state.shear ? modes.shear : modes.tension) : colours.palette[Math.min(paletteSize - 1, Math.floor(share * paletteSize))]!;
        addFaces(lines, test.cells, frame, crack.faces, magnification, state.parted ? 2 : 1, colour, state.parted ? 1 : 0.55);
    }
    if (test.events.count === 0) addBrokenBonds(lines, test, frame, magnification, theme);
}

/// Adds the cracks of a run without a list of breaks, whose modes are unknown.
function addBrokenBonds(lines: Segments, test: TestData, frame: Frame, magnification: number, theme: Theme): void {
    const state = frame.field('state');
    if (!state) return;
    const colour = rgb(theme.picked);
    for (let bond = 0; bond < test.bonds.count; ++bond) {
        if (state[bond]! < bondBroken) continue;
        addFaces(lines, test.cells, frame, facesOf(test.cells, test.bonds.i[bond]!, test.bonds.j[bond]!), magnification, 2, colour, 1);
    }
}

/// Position of a bonded point of the first frame in this frame: the mean of the positions to which its two cells move it.
function bondedPoint(test: TestData, frame: Frame, bond: number, magnification: number): Point {
    const {bonds, cells} = test, at = {x: bonds.x[bond]!, y: bonds.y[bond]!};
    const a = moverOf(cells, frame, bonds.i[bond]!, magnification)(at), b = moverOf(cells, frame, bonds.j[bond]!, magnification)(at);
    return {x: (a.x + b.x) / 2, y: (a.y + b.y) / 2};
}

/// Adds lines from both centres to the contact point, except from the centre of a platen.
function addBranches(lines: Segments, cells: Cells, frame: Frame, i: number, j: number, at: Point, magnification: number, width: number, colour: Rgb, opacity: number): void {
    for (const cell of [i, j]) {
        if (cell < 0 || cells.open[cell] === 1) continue;
        const centre = movedCentre(cells, frame, cell, magnification);
        lines.add(centre.x, centre.y, at.x, at.y, width, colour, opacity);
    }
}

export function addBonds(lines: Segments, test: TestData, frame: Frame, magnification: number, theme: Theme): void {
    const {bonds, cells} = test, state = frame.field('state');
    const intact = rgb(theme.bond), slid = rgb(theme.slid);
    for (let bond = 0; bond < bonds.count; ++bond) {
        const now = state?.[bond] ?? 0;
        if (now >= bondBroken) continue;
        addBranches(lines, cells, frame, bonds.i[bond]!, bonds.j[bond]!, bondedPoint(test, frame, bond, magnification), magnification, 1, now === bondSlid ? slid : intact, 0.9);
    }
}

const bondTouchingAgain = 3; // state of a broken bond

/// Adds the stresses of faces as bands across them, as the figures of `crackle plot` do (tools/plot/face_bands.hpp).
/// @param highest  m, half the width of the band of a stress at the scale's end
function addStresses(lines: Segments, test: TestData, frame: Frame, magnification: number, end: number, highest: number, theme: Theme): void {
    const {bonds} = test, atBegin = frame.field('sb'), atEnd = frame.field('se'), fs = frame.field('fs'), state = frame.field('state');
    if (!atBegin || !atEnd || !fs || !state || bonds.halfX.length === 0 || end === 0) return;
    const compression = rgb(theme.compressive), tension = rgb(theme.tensile), reach = highest / end;
    for (let bond = 0; bond < bonds.count; ++bond) {
        if (state[bond] === bondBroken) continue;
        const at = bondedPoint(test, frame, bond, magnification), angle = (frame.angle[bonds.i[bond]!]! + frame.angle[bonds.j[bond]!]!) / 2;
        const turned = {x: Math.cos(angle) * bonds.halfX[bond]! - Math.sin(angle) * bonds.halfY[bond]!, y: Math.sin(angle) * bonds.halfX[bond]! + Math.cos(angle) * bonds.halfY[bond]!};
        const half = Math.hypot(turned.x, turned.y), t = {x: turned.x / half, y: turned.y / half}, shear = fs[bond]! / (2 * half);
        const place = (share: number): Point => ({x: at.x + share * turned.x, y: at.y + share * turned.y});
        const side = (stress: number): Point => ({x: reach * (stress * t.y - shear * t.x), y: reach * (-stress * t.x - shear * t.y)});
        const add = (from: number, stressFrom: number, to: number, stressTo: number) => {
            const pressed = stressFrom + stressTo >= 0;
            if (from === to || (stressFrom === 0 && stressTo === 0 && shear === 0) || (!pressed && state[bond] === bondTouchingAgain)) return;
            lines.addBand(place(from), place(to), side(stressFrom), side(stressTo), pressed ? compression : tension, 0.85);
        };
        const begin = atBegin[bond]!, last = atEnd[bond]!;
        if (begin * last >= 0) {
            add(-1, begin, 1, last);
            continue;
        }
        const zero = (begin + last) / (begin - last); // where the stress changes its sign
        add(-1, begin, zero, 0);
        add(zero, 0, 1, last);
    }
}

/// Adds contact forces. Line widths are relative to the widest line: the force divided by the scale's end.
/// @param highest  m, half the width of the widest band of faces
export function addForces(lines: Segments, test: TestData, frame: Frame, magnification: number, {end, stress}: ForceScale, highest: number, theme: Theme): void {
    addStresses(lines, test, frame, magnification, stress.end, highest, theme);
    if (end === 0) return;
    const {bonds, cells} = test, compression = rgb(theme.compressive), tension = rgb(theme.tensile);
    const add = (i: number, j: number, fn: number, fs: number, at: () => Point) => {
        const share = Math.hypot(fn, fs) / end;
        if (share >= smallestForceShown) addBranches(lines, cells, frame, i, j, at(), magnification, Math.min(1, share), fn < 0 ? tension : compression, 0.85);
    };
    const fn = frame.field('fn'), fs = frame.field('fs');
    if (fn && fs && bonds.halfX.length === 0) {
        for (let bond = 0; bond < bonds.count; ++bond) {
            add(bonds.i[bond]!, bonds.j[bond]!, fn[bond]!, fs[bond]!, () => bondedPoint(test, frame, bond, magnification));
        }
    }
    const contacts = frame.contacts;
    for (let contact = 0; contacts && contact < contacts.count; ++contact) {
        add(contacts.i[contact]!, contacts.j[contact]!, contacts.fn[contact]!, contacts.fs[contact]!, () => contactPoint(contacts, contact, frame, magnification));
    }
}

/// Position of a contact point. Stored positions are true ones, to which magnification adds the mean displacement of both cells.
function contactPoint(contacts: Contacts, contact: number, frame: Frame, magnification: number): Point {
    const cells = [contacts.i[contact]!, contacts.j[contact]!].filter((cell) => cell >= 0);
    const mean = (values: Float32Array) => cells.reduce((sum, cell) => sum + values[cell]!, 0) / cells.length;
    return {x: contacts.x[contact]! + (magnification - 1) * mean(frame.ux), y: contacts.y[contact]! + (magnification - 1) * mean(frame.uy)};
}

export function addPicked(lines: Segments, cells: Cells, frame: Frame, cell: number, magnification: number, theme: Theme): void {
    const move = moverOf(cells, frame, cell, magnification), radius = cells.radius[cell]!;
    const round = Array.from({length: 49}, (_, k) => {
        const angle = (2 * Math.PI * k) / 48;
        return {x: cells.x[cell]! + radius * Math.cos(angle), y: cells.y[cell]! + radius * Math.sin(angle)};
    });
    const corners = outline(cells, cell);
    const points = radius > 0 ? round : cells.open[cell] === 1 ? corners : [...corners, corners[0]!];
    addPath(lines, points.map(move), 2.5, rgb(theme.picked));
}
