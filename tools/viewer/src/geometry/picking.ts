// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the cell at a point. The bounding boxes of the cells of one frame are indexed at the first click.

import Flatbush from 'flatbush';

import {outline, reach, type Point} from '../data/cells';
import type {Frame} from '../data/frames';
import type {TestData} from '../data/report';
import {movedCentre, moverOf} from './rigid_motion';

export class Picking {
    private index: Flatbush | undefined;
    private of: {frame: number; magnification: number} | undefined;

    constructor(private readonly test: TestData) {}

    at(point: Point, frame: Frame, magnification: number): number | undefined {
        if (this.of?.frame !== frame.index || this.of.magnification !== magnification) this.build(frame, magnification);
        const {cells} = this.test;
        return this.index!.search(point.x, point.y, point.x, point.y).sort((a, b) => b - a).find((cell) => {
            if (cells.open[cell] === 1) return false;
            if (cells.radius[cell]! > 0) {
                const centre = movedCentre(cells, frame, cell, magnification);
                return Math.hypot(point.x - centre.x, point.y - centre.y) <= cells.radius[cell]!;
            }
            return inside(point, outline(cells, cell).map(moverOf(cells, frame, cell, magnification)));
        });
    }

    private build(frame: Frame, magnification: number): void {
        const {cells} = this.test;
        this.index = new Flatbush(Math.max(1, cells.count));
        for (let cell = 0; cell < cells.count; ++cell) {
            const {x, y} = movedCentre(cells, frame, cell, magnification), far = reach(cells, cell);
            this.index.add(x - far, y - far, x + far, y + far);
        }
        this.index.finish();
        this.of = {frame: frame.index, magnification};
    }
}

/// Whether a point is inside a polygon, by counting the crossings of a ray.
function inside(point: Point, corners: readonly Point[]): boolean {
    let within = false;
    corners.forEach((a, at) => {
        const b = corners[(at + corners.length - 1) % corners.length]!;
        if ((a.y > point.y) !== (b.y > point.y) && point.x < a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y)) within = !within;
    });
    return within;
}
