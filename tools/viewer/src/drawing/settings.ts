// SPDX-License-Identifier: GPL-3.0-or-later
// Settings of the viewer: layers, colours, magnification, layout, tests.

import type {SequentialName} from '../colours/palettes';

export const layerNames = {
    particles: 'Particles',
    outlines: 'Outlines',
    platens: 'Platens and walls',
    cracks: 'Cracks',
    bonds: 'Bonds',
    forces: 'Contact forces',
    numbers: 'Particle numbers',
} as const;
export type Layer = keyof typeof layerNames;

export type Layout = 'one' | 'side' | 'over';

export interface Settings {
    layers: Record<Layer, boolean>;
    quantity: string; // key of a Quantity
    map: SequentialName;
    range: 'peak' | 'all' | 'frame'; // frames that determine the colour scale
    forcesOf: 'page' | 'shown'; // tests that determine the scale of force widths
    crackColour: 'mode' | 'time';
    magnification: number;
    layout: Layout;
    test: number; // index of the test shown alone, or of the first of two overlaid tests
    other: number; // index of the second of two overlaid tests
}

export const initialSettings: Settings = {
    layers: {particles: true, outlines: true, platens: true, cracks: true, bonds: false, forces: false, numbers: false},
    quantity: 'none',
    map: 'viridis',
    range: 'peak',
    forcesOf: 'page',
    crackColour: 'mode',
    magnification: 1,
    layout: 'one',
    test: 0,
    other: 1,
};
