// SPDX-License-Identifier: GPL-3.0-or-later
// Colours for values: perceptually uniform maps, readable with any colour vision and in grey (viridis, cividis), and a
// diverging map for positive and negative values. Materials and fragments have a set of distinct colours.

import {interpolateCividis, interpolateInferno, interpolateRdBu, interpolateViridis} from 'd3-scale-chromatic';

export type Rgb = readonly [number, number, number]; // 0 to 255

export const sequentialNames = ['viridis', 'cividis', 'inferno'] as const;
export type SequentialName = (typeof sequentialNames)[number];

const sequential: Record<SequentialName, (share: number) => string> = {viridis: interpolateViridis, cividis: interpolateCividis, inferno: interpolateInferno};

// Paul Tol's "muted" set, light colours first, so that particle numbers stay readable on most of them.
const distinct = ['#88ccee', '#ddcc77', '#44aa99', '#cc6677', '#aa4499', '#117733', '#999933', '#882255', '#332288'];

export function rgb(colour: string): Rgb {
    if (colour.startsWith('#')) return [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16)) as unknown as Rgb;
    return colour.match(/[\d.]+/g)!.slice(0, 3).map(Number) as unknown as Rgb;
}

export const css = ([r, g, b]: Rgb): string => `rgb(${Math.round(r)},${Math.round(g)},${Math.round(b)})`;

export const paletteSize = 256;

export function sequentialPalette(name: SequentialName): Rgb[] {
    return Array.from({length: paletteSize}, (_, at) => rgb(sequential[name](at / (paletteSize - 1))));
}

/// Blue for values below zero, red for values above.
export function divergingPalette(): Rgb[] {
    return Array.from({length: paletteSize}, (_, at) => rgb(interpolateRdBu(1 - at / (paletteSize - 1))));
}

/// The first colour, for the largest fragment or the first material, is the theme's muted grain colour.
export function categoricalPalette(grain: string): Rgb[] {
    return Array.from({length: paletteSize}, (_, at) => rgb(at === 0 ? grain : distinct[(at - 1) % distinct.length]!));
}

/// Palette index of a category. Beyond the end of the palette, categories repeat it from its second colour. Negative
/// categories (platens) get the first colour.
export function categoryColour(category: number): number {
    const last = paletteSize - 1;
    return category <= last ? Math.max(0, category) : 1 + (category - 1) % last;
}
