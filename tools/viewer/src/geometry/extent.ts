// SPDX-License-Identifier: GPL-3.0-or-later
// Bounding boxes of specimens.

import {outline} from '../data/cells';
import type {Frame} from '../data/frames';
import type {BondEvents, TestData} from '../data/report';
import {moverOf, movedCentre} from './rigid_motion';

export interface Extent {
    x1: number;
    x2: number;
    y1: number;
    y2: number;
}

const followed = 0.4; // distance up to which fragments are shown, relative to the specimen's width
const largeShare = 0.2; // fragments with at least this fraction of all cells are always shown

/// What a drawing of a frame shows. A fragment is shown completely or, if it is far away, left out, since the specimen would
/// otherwise be drawn small.
export interface InView {
    extent: Extent; // encloses the specimen at the start and all cells shown
    shows: (cell: number) => boolean;
    leftOut: number; // number of cells
}

const nothing = (): Extent => ({x1: Infinity, x2: -Infinity, y1: Infinity, y2: -Infinity});

function include(extent: Extent, x: number, y: number, room = 0): void {
    extent.x1 = Math.min(extent.x1, x - room);
    extent.x2 = Math.max(extent.x2, x + room);
    extent.y1 = Math.min(extent.y1, y - room);
    extent.y2 = Math.max(extent.y2, y + room);
}

/// Chooses the cells to show. Platens affect only the height of the extent, since they may be far wider than the specimen.
export function inView(test: TestData, frame: Frame, magnification: number): InView {
    const {cells} = test, start = nothing(), extent = nothing();
    const member = frame.field('fragment');
    const numberOf = (cell: number) => member?.[cell] ?? cell;
    const fragments = new Map<number, {extent: Extent; x: number; y: number; cells: number}>();
    for (let cell = 0; cell < cells.count; ++cell) {
        const corners = outline(cells, cell), move = moverOf(cells, frame, cell, magnification);
        if (cells.platen[cell] === 1) {
            for (const {y} of corners.map(move)) [extent.y1, extent.y2] = [Math.min(extent.y1, y), Math.max(extent.y2, y)];
            continue;
        }
        const radius = cells.radius[cell]!, at = movedCentre(cells, frame, cell, magnification);
        const found = fragments.get(numberOf(cell)) ?? {extent: nothing(), x: 0, y: 0, cells: 0};
        fragments.set(numberOf(cell), found);
        found.x += at.x;
        found.y += at.y;
        found.cells += 1;
        if (radius > 0) {
            include(start, cells.x[cell]!, cells.y[cell]!, radius);
            include(found.extent, at.x, at.y, radius);
        }
        for (const corner of corners) {
            const {x, y} = move(corner);
            include(start, corner.x, corner.y);
            include(found.extent, x, y);
        }
    }
    const room = followed * (start.x2 - start.x1), shown = new Set<number>();
    [extent.x1, extent.x2] = [start.x1, start.x2];
    for (const [number, fragment] of fragments) {
        const x = fragment.x / fragment.cells, y = fragment.y / fragment.cells;
        const near = x > start.x1 - room && x < start.x2 + room && y > start.y1 - room && y < start.y2 + room;
        if (!near && fragment.cells < largeShare * cells.count) continue;
        shown.add(number);
        include(extent, fragment.extent.x1, fragment.extent.y1);
        include(extent, fragment.extent.x2, fragment.extent.y2);
    }
    const shows = (cell: number) => cells.platen[cell] === 1 || shown.has(numberOf(cell));
    let leftOut = 0;
    for (let cell = 0; cell < cells.count; ++cell) if (!shows(cell)) ++leftOut;
    return {extent, shows, leftOut};
}

/// Bounding box of the first frame, if any, and of all breaks and slips, which may lie outside it.
export function extentOfBondEvents(test: TestData): Extent {
    const {cells, events, slips} = test;
    const box = cells.count > 0 ? extentAtStart({...test, sides: undefined}) : nothing();
    const includeAll = ({count, x, y}: BondEvents) => {
        for (let event = 0; event < count; ++event) include(box, x[event]!, y[event]!);
    };
    includeAll(events);
    if (slips) includeAll(slips);
    // The box has an area even for a single break or for breaks along a line.
    const size = Math.max(box.x2 - box.x1, box.y2 - box.y1) || 1;
    const roomX = Math.max(0, 0.2 * size - (box.x2 - box.x1)) / 2, roomY = Math.max(0, 0.2 * size - (box.y2 - box.y1)) / 2;
    const marks = 0.03 * size; // room for the circles of breaks at the edge
    return {x1: box.x1 - roomX - marks, x2: box.x2 + roomX + marks, y1: box.y1 - roomY - marks, y2: box.y2 + roomY + marks};
}

/// Bounding box of the first frame and the walls, computed without the arrays of frames. It is little wider than the specimen,
/// even if platens are wider. At the sides it has room for fragments in later frames.
export function extentAtStart(test: TestData): Extent {
    const {cells, walls, sides} = test;
    const extent = {x1: Infinity, x2: -Infinity, y1: Infinity, y2: -Infinity};
    const widen = (x: number, y: number, room: number, platen: boolean) => {
        extent.y1 = Math.min(extent.y1, y - room);
        extent.y2 = Math.max(extent.y2, y + room);
        if (platen) return;
        extent.x1 = Math.min(extent.x1, x - room);
        extent.x2 = Math.max(extent.x2, x + room);
    };
    for (let cell = 0; cell < cells.count; ++cell) {
        const platen = cells.platen[cell] === 1;
        if (cells.radius[cell]! > 0) widen(cells.x[cell]!, cells.y[cell]!, cells.radius[cell]!, false);
        for (let at = cells.firstPoint[cell]!; at < cells.firstPoint[cell + 1]!; ++at) widen(cells.outlineX[at]!, cells.outlineY[at]!, 0, platen);
    }
    if (walls) {
        widen(walls[0], walls[2], 0, false);
        widen(walls[1], walls[3], 0, false);
    }
    if (extent.x1 > extent.x2) return {x1: 0, x2: 1, y1: 0, y2: 1};
    const width = extent.x2 - extent.x1, beside = sides ? Math.max(0, extent.x1 - sides[0], sides[1] - extent.x2) : 0;
    const room = Math.max(beside, cells.platen.includes(1) ? 0.06 * width : 0); // equal on both sides, so that the specimen is in the middle
    return {x1: extent.x1 - room, x2: extent.x2 + room, y1: extent.y1, y2: extent.y2};
}
