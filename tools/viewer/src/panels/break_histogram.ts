// SPDX-License-Identifier: GPL-3.0-or-later
// Bond breaks counted in equal intervals of axial strain, by mode, as an acoustic-emission monitor would show them.

import type {Events} from '../data/report';

export interface Histogram {
    width: number; // strain of one interval
    tension: number[];
    shear: number[];
    most: number; // breaks in the fullest interval
}

/// 1, 2 or 5 times a power of ten: the interval that cuts `range` into about `target` pieces.
export function intervalWidth(range: number, target = 80): number {
    if (!(range > 0)) return 1e-6;
    const raw = range / target;
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].find((candidate) => candidate * power >= raw * (1 - 1e-9))!;
    return step * power;
}

/// Interval k holds the breaks with k·width < strain ≤ (k+1)·width; those at strain ≤ 0 go into the first.
export function countBreaks(events: Events, width: number, range: number): Histogram {
    const count = Math.max(1, Math.ceil(range / width - 1e-9));
    const tension = new Array<number>(count).fill(0);
    const shear = new Array<number>(count).fill(0);
    for (let event = 0; event < events.count; ++event) {
        const interval = Math.min(count - 1, Math.max(0, Math.ceil(events.strain[event]! / width - 1e-9) - 1));
        const counts = events.shear[event] === 1 ? shear : tension;
        counts[interval]! += 1;
    }
    return {width, tension, shear, most: Math.max(...tension.map((value, interval) => value + shear[interval]!))};
}

export function modeCounts(events: Events): {tension: number; shear: number} {
    let shear = 0;
    for (let event = 0; event < events.count; ++event) shear += events.shear[event]!;
    return {tension: events.count - shear, shear};
}
