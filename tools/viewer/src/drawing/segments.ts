// SPDX-License-Identifier: GPL-3.0-or-later
// Straight lines with widths and colours, for platens, walls, cracks, bonds and forces, and bands for the stresses of faces.
// They are filled on the CPU for each frame, and drawn by WebGL (segment_layer.ts) or written to SVG (picture_svg.ts).

import type {Rgb} from '../colours/palettes';
import type {Point} from '../data/cells';

export class Segments {
    count = 0;
    ends = new Float32Array(4 * 256); // m, start and end of each line
    widths = new Float32Array(256); // px
    colours = new Uint8Array(4 * 256);
    sides = new Float32Array(4 * 256); // m, from the start and end of a band to its side; 0 for lines

    /// Coordinates are stored relative to the origin, so that single precision is enough at any zoom.
    constructor(readonly origin: Point) {}

    clear(): void {
        this.count = 0;
    }

    add(fromX: number, fromY: number, toX: number, toY: number, width: number, colour: Rgb, opacity = 1): void {
        if (this.count === this.widths.length) this.grow();
        const at = this.count++;
        this.ends[4 * at] = fromX - this.origin.x;
        this.ends[4 * at + 1] = fromY - this.origin.y;
        this.ends[4 * at + 2] = toX - this.origin.x;
        this.ends[4 * at + 3] = toY - this.origin.y;
        this.widths[at] = width;
        this.colours[4 * at] = colour[0];
        this.colours[4 * at + 1] = colour[1];
        this.colours[4 * at + 2] = colour[2];
        this.colours[4 * at + 3] = 255 * opacity;
        this.sides.fill(0, 4 * at, 4 * at + 4);
    }

    /// Adds a quadrilateral about a line. @param fromSide, toSide  vectors from the ends of the line to its corners on one side
    addBand(from: Point, to: Point, fromSide: Point, toSide: Point, colour: Rgb, opacity: number): void {
        this.add(from.x, from.y, to.x, to.y, 0, colour, opacity);
        this.sides.set([fromSide.x, fromSide.y, toSide.x, toSide.y], 4 * (this.count - 1));
    }

    isBand(at: number): boolean {
        return this.sides.subarray(4 * at, 4 * at + 4).some((side) => side !== 0);
    }

    private grow(): void {
        const grown = <T extends Float32Array | Uint8Array>(values: T): T => {
            const larger = new (values.constructor as new (size: number) => T)(2 * values.length);
            larger.set(values);
            return larger;
        };
        this.ends = grown(this.ends);
        this.widths = grown(this.widths);
        this.colours = grown(this.colours);
        this.sides = grown(this.sides);
    }
}
