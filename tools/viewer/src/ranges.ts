// SPDX-License-Identifier: GPL-3.0-or-later
// Ranges of the colour scale: of one frame, or of all frames of all shown tests. A range leaves out the farthest two per cent
// of the values (splinters that fly off would leave one colour to all others); legends mark such ends with ≤ and ≥.

import type {Cells} from './cells';
import type {Frame, Frames} from './frames';
import type {Quantity} from './quantities';

export interface Range {
    low: number;
    high: number;
    beyond: boolean; // values lie outside
}

const leftOut = 0.02;
const samplesWanted = 60000;

function rangeOfSamples(samples: number[], quantity: Quantity): Range {
    if (samples.length === 0) return {low: 0, high: 0, beyond: false};
    const sizes = Float64Array.from(samples, Math.abs).sort();
    const largest = sizes[sizes.length - 1]!;
    const kept = sizes[Math.floor((1 - leftOut) * (sizes.length - 1))]!;
    // A tail that hardly reaches farther is no reason to cut.
    const high = largest > 1.3 * kept && kept > 0 ? kept : largest;
    return {low: quantity.scaling === 'diverging' ? -high : 0, high, beyond: high < largest};
}

function sample(samples: number[], frame: Frame, cells: Cells, quantity: Quantity, stride: number): void {
    const value = quantity.of(frame, cells);
    for (let cell = 0; cell < cells.count; cell += stride) {
        if (cells.open[cell] !== 1) samples.push(value(cell));
    }
}

export function rangeOfFrames(frames: readonly {frame: Frame; cells: Cells}[], quantity: Quantity): Range {
    const samples: number[] = [];
    for (const {frame, cells} of frames) sample(samples, frame, cells, quantity, 1);
    return rangeOfSamples(samples, quantity);
}

/// Numbers of the categories that the shown frames have: low to high.
export function categories(frames: readonly {frame: Frame; cells: Cells}[], quantity: Quantity): Range {
    let high = 0;
    for (const {frame, cells} of frames) {
        const value = quantity.of(frame, cells);
        for (let cell = 0; cell < cells.count; ++cell) high = Math.max(high, value(cell));
    }
    return {low: 0, high, beyond: false};
}

export async function rangeOfAll(frames: Frames, cells: Cells, quantity: Quantity): Promise<Range> {
    const samples: number[] = [];
    const frameStride = Math.max(1, Math.floor(frames.count / 60));
    const stride = Math.max(1, Math.floor(cells.count * Math.ceil(frames.count / frameStride) / samplesWanted));
    for await (const frame of frames.pass(frameStride)) sample(samples, frame, cells, quantity, stride);
    return rangeOfSamples(samples, quantity);
}

export function joined(ranges: readonly Range[]): Range {
    const high = Math.max(0, ...ranges.map((range) => range.high));
    return {low: Math.min(0, ...ranges.map((range) => range.low)), high, beyond: ranges.some((range) => range.beyond)};
}

/// End of the scale of contact forces, N.
export async function largestForceOfAll(frames: Frames): Promise<number> {
    const samples: number[] = [];
    for await (const frame of frames.pass(Math.max(1, Math.floor(frames.count / 60)))) sampleForces(samples, frame);
    return upper(samples);
}

export function largestForceOf(frames: readonly Frame[]): number {
    const samples: number[] = [];
    for (const frame of frames) sampleForces(samples, frame);
    return upper(samples);
}

function sampleForces(samples: number[], frame: Frame): void {
    const add = (fn: Float32Array | undefined, fs: Float32Array | undefined) => {
        if (!fn || !fs) return;
        for (let at = 0, stride = Math.max(1, Math.floor(fn.length / 4000)); at < fn.length; at += stride) samples.push(Math.hypot(fn[at]!, fs[at]!));
    };
    add(frame.field('fn'), frame.field('fs'));
    add(frame.contacts?.fn, frame.contacts?.fs);
}

function upper(samples: number[]): number {
    const sorted = Float64Array.from(samples).sort();
    return sorted[Math.floor((1 - leftOut) * (sorted.length - 1))] || 1;
}
