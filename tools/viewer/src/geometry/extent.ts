// SPDX-License-Identifier: GPL-3.0-or-later
// Bounding boxes of specimens.

import {outline} from '../data/cells';
import type {Frame} from '../data/frames';
import type {TestData} from '../data/report';
import {moverOf, movedCentre} from './rigid_motion';

export interface Extent {
    x1: number;
    x2: number;
    y1: number;
    y2: number;
}

/// The box of a frame. Platens may be far wider than the specimen: they set the height of the box, not its width, and particles
/// that fly off beyond them are cut off.
export function extentOf(test: TestData, frame: Frame, magnification: number): Extent {
    const {cells} = test, extent = {x1: Infinity, x2: -Infinity, y1: Infinity, y2: -Infinity};
    const betweenPlatens = cells.platen.includes(1);
    const widen = (x: number, y: number, room: number, platen: boolean) => {
        if (platen || !betweenPlatens) {
            extent.y1 = Math.min(extent.y1, y - room);
            extent.y2 = Math.max(extent.y2, y + room);
        }
        if (platen) return;
        extent.x1 = Math.min(extent.x1, x - room);
        extent.x2 = Math.max(extent.x2, x + room);
    };
    for (let cell = 0; cell < cells.count; ++cell) {
        const platen = cells.platen[cell] === 1, radius = cells.radius[cell]!;
        if (radius > 0) {
            const at = movedCentre(cells, frame, cell, magnification);
            widen(at.x, at.y, radius, false);
            continue;
        }
        const move = moverOf(cells, frame, cell, magnification);
        for (const point of outline(cells, cell)) {
            const at = move(point);
            widen(at.x, at.y, 0, platen);
        }
    }
    return extent;
}

/// The box of the first frame and of all breaks, which may have happened outside it; of the breaks alone where there is no frame.
export function extentOfBreaks(test: TestData): Extent {
    const {cells, events} = test;
    const box = cells.count > 0 ? extentAtStart(test) : {x1: Infinity, x2: -Infinity, y1: Infinity, y2: -Infinity};
    for (let event = 0; event < events.count; ++event) {
        box.x1 = Math.min(box.x1, events.x[event]!);
        box.x2 = Math.max(box.x2, events.x[event]!);
        box.y1 = Math.min(box.y1, events.y[event]!);
        box.y2 = Math.max(box.y2, events.y[event]!);
    }
    // Breaks along a line, or a single one, still get a box with an area.
    const size = Math.max(box.x2 - box.x1, box.y2 - box.y1) || 1;
    const roomX = Math.max(0, 0.2 * size - (box.x2 - box.x1)) / 2, roomY = Math.max(0, 0.2 * size - (box.y2 - box.y1)) / 2;
    return {x1: box.x1 - roomX, x2: box.x2 + roomX, y1: box.y1 - roomY, y2: box.y2 + roomY};
}

/// The box of the first frame, without any frame's arrays, and with the walls; of platens a little more than the width.
export function extentAtStart(test: TestData): Extent {
    const {cells, walls} = test;
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
    const room = cells.platen.includes(1) ? 0.06 * (extent.x2 - extent.x1) : 0;
    return {x1: extent.x1 - room, x2: extent.x2 + room, y1: extent.y1, y2: extent.y2};
}
