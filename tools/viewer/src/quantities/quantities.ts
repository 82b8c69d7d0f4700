// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities by which particles can be coloured: a value for each cell and frame, a unit, and the arrays needed to compute it.

import type {Cells} from '../data/cells';
import type {Frame, Frames} from '../data/frames';
import {ofStress} from './units';

export type Scaling =
    | 'sequential' // from zero up
    | 'diverging' // positive and negative, zero in the middle
    | 'categorical'; // whole numbers from 0

export interface Quantity {
    key: string;
    name: string;
    unit: string;
    scaling: Scaling;
    needs: readonly string[]; // names of the arrays of a frame that are needed
    value: (...values: number[]) => number; // computed from one value of each needed array
    of: (frame: Frame, cells: Cells) => (cell: number) => number;
}

type Values = Float32Array;

function quantity(key: string, name: string, unit: string, scaling: Scaling, needs: readonly string[],
    value: (...values: number[]) => number): Quantity {
    return {
        key, name, unit, scaling, needs, value,
        of: (frame) => {
            const arrays = needs.map((need) => frame.field(need));
            if (arrays.some((array) => !array)) return () => 0; // in the first frame, before its block is loaded
            const [a, b, c] = arrays as [Values, Values?, Values?];
            return (cell) => value(a[cell]!, b?.[cell] ?? 0, c?.[cell] ?? 0);
        },
    };
}

const stress = ['sxx', 'syy', 'sxy'] as const;
const radius = (xx: number, yy: number, xy: number): number => Math.hypot((xx - yy) / 2, xy);

export const plain: Quantity = {key: 'none', name: 'None', unit: '', scaling: 'categorical', needs: [], value: () => 0, of: () => () => 0};

const all: readonly Quantity[] = [
    plain,
    {key: 'material', name: 'Material', unit: '', scaling: 'categorical', needs: [], value: () => 0, of: (_, cells) => (cell) => Math.max(0, cells.material[cell]! - 1)},
    quantity('fragment', 'Fragment', '', 'categorical', ['fragment'], (fragment) => fragment),
    quantity('displacement', 'Displacement', 'm', 'sequential', ['ux', 'uy'], Math.hypot),
    quantity('displacement_x', 'Displacement, horizontal', 'm', 'diverging', ['ux'], (x) => x),
    quantity('displacement_y', 'Displacement, vertical', 'm', 'diverging', ['uy'], (y) => y),
    quantity('velocity', 'Velocity', 'm/s', 'sequential', ['vx', 'vy'], Math.hypot),
    quantity('velocity_x', 'Velocity, horizontal', 'm/s', 'diverging', ['vx'], (x) => x),
    quantity('velocity_y', 'Velocity, vertical', 'm/s', 'diverging', ['vy'], (y) => y),
    quantity('rotation', 'Rotation', 'rad', 'diverging', ['angle'], (angle) => angle),
    quantity('rate', 'Rotation rate', 'rad/s', 'diverging', ['rate'], (rate) => rate),
    quantity('stress_mean', 'Stress, mean', ofStress, 'diverging', stress, (xx, yy) => (xx + yy) / 2),
    quantity('stress_y', 'Stress, vertical', ofStress, 'diverging', stress, (_, yy) => yy),
    quantity('stress_x', 'Stress, horizontal', ofStress, 'diverging', stress, (xx) => xx),
    quantity('stress_major', 'Stress, largest principal', ofStress, 'diverging', stress, (xx, yy, xy) => (xx + yy) / 2 + radius(xx, yy, xy)),
    quantity('stress_minor', 'Stress, smallest principal', ofStress, 'diverging', stress, (xx, yy, xy) => (xx + yy) / 2 - radius(xx, yy, xy)),
    quantity('stress_shear', 'Stress, largest shear', ofStress, 'sequential', stress, radius),
];

/// The quantities whose arrays a test has. @param meanVelocities  whether velocities are means between two frames
export function quantitiesOf(frames: Frames, meanVelocities: boolean): Quantity[] {
    return all.filter(({needs}) => needs.every((need) => frames.has(need)))
        .map((one) => (meanVelocities && /^(velocity|rate)/.test(one.key) ? {...one, name: `${one.name} (mean)`} : one));
}
