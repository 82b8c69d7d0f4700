// SPDX-License-Identifier: GPL-3.0-or-later
// Counts the directions of cracks in classes. A crack is perpendicular to the contact normal, whose orientation the event has.
// Opposite directions are equivalent, so the rose diagram repeats after half a turn.

import type {Events} from '../data/report';

export const directionWidth = 10; // degrees

export interface Directions {
    width: number; // degrees
    tension: number[]; // breaks in each direction, counter-clockwise from the x axis, each break counted in both directions
    shear: number[];
}

export function countDirections(events: Events): Directions {
    const half = 180 / directionWidth;
    const tension = new Array<number>(2 * half).fill(0), shear = new Array<number>(2 * half).fill(0);
    for (let event = 0; event < events.count; ++event) {
        const crack = events.orientation[event]! * 180 / Math.PI + 90; // 0 to 180
        const at = Math.round(crack / directionWidth) % half; // both coordinate axes are at the centres of classes
        const counts = events.shear[event] === 1 ? shear : tension;
        counts[at]! += 1;
        counts[at + half]! += 1;
    }
    return {width: directionWidth, tension, shear};
}
