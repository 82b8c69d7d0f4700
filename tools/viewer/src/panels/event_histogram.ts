// SPDX-License-Identifier: GPL-3.0-or-later
// Breaks or slips counted in equal intervals of axial strain, as an acoustic-emission monitor would show them.

import type {BondEvents, Events} from '../data/report';

export interface Histogram {
    width: number; // strain of one interval
    parts: number[][]; // counts in each interval: of breaks in tension and in shear, of slips all in one
    most: number; // in the fullest interval, of all parts
}

/// 1, 2 or 5 times a power of ten: the interval that cuts `range` into about `target` pieces.
export function intervalWidth(range: number, target = 80): number {
    if (!(range > 0)) return 1e-6;
    const raw = range / target;
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].find((candidate) => candidate * power >= raw * (1 - 1e-9))!;
    return step * power;
}

/// The interval of a strain: number k holds k·width < strain ≤ (k+1)·width, the first one also strains ≤ 0.
export function intervalOf(strain: number, width: number): number {
    return Math.max(0, Math.ceil(strain / width - 1e-9) - 1);
}

/// How many events an interval has in all parts; none beyond the range.
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

/// Two parts: tension, shear.
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
