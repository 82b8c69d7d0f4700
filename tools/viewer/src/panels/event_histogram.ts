// SPDX-License-Identifier: GPL-3.0-or-later
// Breaks or slips counted in equal intervals of axial strain, as an acoustic-emission monitor would show them.

import type {BondEvents, Events} from '../data/report';

export interface Histogram {
    width: number; // width of an interval of strain
    parts: number[][]; // counts in each interval: one part for tension and one for shear, or one part for all slips
    most: number; // largest count in an interval, over all parts
}

/// Width of the form 1, 2 or 5 times a power of ten that divides `range` into about `target` intervals.
export function intervalWidth(range: number, target = 80): number {
    if (!(range > 0)) return 1e-6;
    const raw = range / target;
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].find((candidate) => candidate * power >= raw * (1 - 1e-9))!;
    return step * power;
}

/// Index of the interval that contains a strain. Interval k is k·width < strain ≤ (k+1)·width; strains ≤ 0 are in the first.
export function intervalOf(strain: number, width: number): number {
    return Math.max(0, Math.ceil(strain / width - 1e-9) - 1);
}

/// Number of events of all parts in an interval; 0 beyond the range.
export function countIn({parts}: Histogram, interval: number): number {
    return parts.reduce((sum, counts) => sum + (counts[interval] ?? 0), 0);
}

function countEvents({count: events, strain}: BondEvents, width: number, range: number, parts: number, partOf: (event: number) => number): Histogram {
    const count = Math.max(1, Math.ceil(range / width - 1e-9));
    const histogram: Histogram = {width, parts: Array.from({length: parts}, () => new Array<number>(count).fill(0)), most: 0};
    for (let event = 0; event < events; ++event) {
        const interval = Math.min(count - 1, intervalOf(strain[event]!, width));
        histogram.parts[partOf(event)]![interval]! += 1;
        histogram.most = Math.max(histogram.most, countIn(histogram, interval));
    }
    return histogram;
}

/// Histogram of breaks with two parts, tension and shear.
export function countBreaks(breaks: Events, width: number, range: number): Histogram {
    return countEvents(breaks, width, range, 2, (event) => (breaks.shear[event] === 1 ? 1 : 0));
}

export function countSlips(slips: BondEvents, width: number, range: number): Histogram {
    return countEvents(slips, width, range, 1, () => 0);
}

export function modeCounts(events: Events): {tension: number; shear: number} {
    let shear = 0;
    for (let event = 0; event < events.count; ++event) shear += events.shear[event]!;
    return {tension: events.count - shear, shear};
}
