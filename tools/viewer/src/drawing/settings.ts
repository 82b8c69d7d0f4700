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
    range: 'peak' | 'all' | 'frame'; // frames that the colours are of
    forcesOf: 'page' | 'shown'; // tests that the widths of forces are of
    crackColour: 'mode' | 'time';
    magnification: number;
    layout: Layout;
    test: number; // the one shown alone, or first of two overlaid
    other: number; // second of two overlaid
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
