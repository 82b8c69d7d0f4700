// SPDX-License-Identifier: GPL-3.0-or-later
// Straight lines with widths and colours, for platens, walls, cracks, bonds and forces. They are filled on the CPU for each
// frame, and drawn by WebGL (segment_layer.ts) or written to SVG (picture_svg.ts).

import type {Rgb} from '../colours/palettes';
import type {Point} from '../data/cells';

export class Segments {
    count = 0;
    ends = new Float32Array(4 * 256); // m, start and end of each line
    widths = new Float32Array(256); // px
    colours = new Uint8Array(4 * 256);

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
    }
}
