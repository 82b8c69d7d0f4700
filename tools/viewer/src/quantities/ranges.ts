// SPDX-License-Identifier: GPL-3.0-or-later
// Ranges of the colour scale: of one frame, of the frames up to the peak, or of all frames of all shown tests. A range
// excludes the largest two per cent of the values; otherwise splinters that fly away would leave a single colour for
// all others. A range up to the peak excludes later frames, because after the collapse most values are many times
// larger. If values lie beyond the range, legends mark its ends with ≤ and ≥.

import type {Cells} from '../data/cells';
import type {Frame, Frames} from '../data/frames';
import type {Quantity} from './quantities';

export interface Range {
    low: number; // ends of the scale
    high: number;
    least: number; // smallest and largest of all values
    most: number;
}

const excluded = 0.02;
const samplesWanted = 60000;
const framesSampled = 60;

/// Collects values. The ends of the scale are found from samples, `least` and `most` from all values.
class Values {
    private readonly samples: number[] = [];
    private least = Infinity;
    private most = -Infinity;
    private largest = 0; // largest absolute value in the frames that determine the range

    /// @param within  whether the frame is one of those that determine the range
    add(frame: Frame, cells: Cells, quantity: Quantity, stride: number, within = true): void {
        const value = quantity.of(frame, cells);
        for (let cell = 0; cell < cells.count; ++cell) {
            if (cells.open[cell] === 1) continue;
            const one = value(cell);
            if (one < this.least) this.least = one;
            if (one > this.most) this.most = one;
            if (!within) continue;
            this.largest = Math.max(this.largest, Math.abs(one));
            if (cell % stride === 0) this.samples.push(Math.abs(one));
        }
    }

    range(quantity: Quantity): Range {
        if (this.samples.length === 0) return {low: 0, high: 0, least: 0, most: 0};
        const {largest} = this, kept = upper(this.samples);
        // The largest values are not cut off if they exceed the others only slightly.
        const high = largest > 1.3 * kept && kept > 0 ? kept : largest;
        return {low: quantity.scaling === 'diverging' ? -high : 0, high, least: this.least, most: this.most};
    }
}

function upper(samples: readonly number[], without = excluded): number {
    const sorted = Float64Array.from(samples).sort();
    return sorted[Math.floor((1 - without) * (sorted.length - 1))] ?? 0;
}

export function rangeOfFrames(frames: readonly {frame: Frame; cells: Cells}[], quantity: Quantity): Range {
    const values = new Values();
    for (const {frame, cells} of frames) values.add(frame, cells, quantity, 1);
    return values.range(quantity);
}

/// Range of the category numbers in the shown frames.
export function categories(frames: readonly {frame: Frame; cells: Cells}[], quantity: Quantity): Range {
    let high = 0;
    for (const {frame, cells} of frames) {
        const value = quantity.of(frame, cells);
        for (let cell = 0; cell < cells.count; ++cell) high = Math.max(high, value(cell));
    }
    return {low: 0, high, least: 0, most: high};
}

/// Range over the frames up to `last`; `least` and `most` are over all frames.
export async function rangeUntil(last: number, frames: Frames, cells: Cells, quantity: Quantity): Promise<Range> {
    const count = Math.min(last + 1, frames.count);
    const values = new Values(), frameStride = Math.max(1, Math.floor(count / framesSampled));
    const stride = Math.max(1, Math.floor(cells.count * Math.ceil(count / frameStride) / samplesWanted));
    for await (const frame of frames.pass(1)) values.add(frame, cells, quantity, frame.index % frameStride === 0 ? stride : Infinity, frame.index < count);
    return values.range(quantity);
}

export function joined(ranges: readonly Range[]): Range {
    const over = (which: keyof Range, start: number, choose: (...values: number[]) => number) => ranges.reduce((so, range) => choose(so, range[which]), start);
    return {low: over('low', 0, Math.min), high: over('high', 0, Math.max), least: over('least', Infinity, Math.min), most: over('most', -Infinity, Math.max)};
}

const stressesExcluded = 0.1; // after a collapse, stresses at some corners are several times as large as at the peak

/// A scale whose end excludes the largest of the non-zero sizes: two per cent of the forces, ten of the stresses.
interface SizeScale {
    end: number; // 0 if there are none
    largest: number;
}

/// The scales of contact forces, N, and of the stresses of faces, N/m.
export interface ForceScale extends SizeScale {
    stress: SizeScale;
}

export const noForces: ForceScale = {end: 0, largest: 0, stress: {end: 0, largest: 0}};

class Sizes {
    private readonly samples: number[] = [];
    private largest = 0;

    constructor(private readonly without: number) {}

    get scale(): SizeScale {
        return {end: upper(this.samples, this.without) || this.largest, largest: this.largest};
    }

    add(a: Float32Array | undefined, b: Float32Array | undefined, sizeOf: (a: number, b: number) => number, sampled: boolean): void {
        if (!a || !b) return;
        const stride = Math.max(1, Math.floor(a.length / 4000));
        for (let at = 0; at < a.length; ++at) {
            const size = sizeOf(a[at]!, b[at]!);
            if (size > this.largest) this.largest = size;
            if (sampled && size > 0 && at % stride === 0) this.samples.push(size);
        }
    }
}

class Forces {
    private readonly forces = new Sizes(excluded);
    private readonly stresses = new Sizes(stressesExcluded);

    add(frame: Frame, sampled: boolean): void {
        const begin = frame.field('sb'), {contacts} = frame;
        if (begin) this.stresses.add(begin, frame.field('se'), (one, other) => Math.max(Math.abs(one), Math.abs(other)), sampled);
        else this.forces.add(frame.field('fn'), frame.field('fs'), Math.hypot, sampled);
        this.forces.add(contacts?.fn, contacts?.fs, Math.hypot, sampled);
    }

    get scale(): ForceScale {
        return {...this.forces.scale, stress: this.stresses.scale};
    }
}

export async function forceScaleOfAll(frames: Frames): Promise<ForceScale> {
    const forces = new Forces(), stride = Math.max(1, Math.floor(frames.count / framesSampled));
    for await (const frame of frames.pass(1)) forces.add(frame, frame.index % stride === 0);
    return forces.scale;
}

export function forceScaleOf(frames: readonly Frame[]): ForceScale {
    const forces = new Forces();
    for (const frame of frames) forces.add(frame, true);
    return forces.scale;
}

export function joinedForces(scales: readonly ForceScale[]): ForceScale {
    const join = (sizes: readonly SizeScale[]) => ({end: Math.max(...sizes.map(({end}) => end)), largest: Math.max(...sizes.map(({largest}) => largest))});
    return {...join(scales), stress: join(scales.map(({stress}) => stress))};
}
