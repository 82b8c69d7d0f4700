// SPDX-License-Identifier: GPL-3.0-or-later
// Directions of cracks. An event's orientation is that of the contact's normal; the crack runs across it, a quarter turn on.
// A direction and its opposite are one, so the rose is the same after half a turn.

import type {Events} from '../data/report';

export const directionWidth = 10; // degrees

export interface Directions {
    width: number; // degrees
    tension: number[]; // breaks in each direction, all around from that of the x axis, each break counted on both sides
    shear: number[];
}

export function countDirections(events: Events): Directions {
    const half = 180 / directionWidth;
    const tension = new Array<number>(2 * half).fill(0), shear = new Array<number>(2 * half).fill(0);
    for (let event = 0; event < events.count; ++event) {
        const crack = events.orientation[event]! * 180 / Math.PI + 90; // 0 to 180
        const at = Math.round(crack / directionWidth) % half; // classes lie around their middle: one lies along each axis
        const counts = events.shear[event] === 1 ? shear : tension;
        counts[at]! += 1;
        counts[at + half]! += 1;
    }
    return {width: directionWidth, tension, shear};
}
