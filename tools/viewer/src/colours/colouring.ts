// SPDX-License-Identifier: GPL-3.0-or-later
// Maps a particle's value to its colour: an index into a palette of 256, the same in the picture, the SVG file and the legend.

import type {Cells} from '../data/cells';
import type {Frame} from '../data/frames';
import type {Quantity} from '../quantities/quantities';
import type {Range} from '../quantities/ranges';
import {categoricalPalette, categoryColour, divergingPalette, paletteSize, sequentialPalette, type Rgb, type SequentialName} from './palettes';
import type {Theme} from './theme';

export interface Colouring {
    quantity: Quantity;
    range: Range;
    palette: Rgb[];
    names: readonly string[]; // names of the first categories; further ones are numbered
}

export function colouring(quantity: Quantity, range: Range, map: SequentialName, theme: Theme, names: readonly string[] = []): Colouring {
    const palette = quantity.scaling === 'sequential' ? sequentialPalette(map)
        : quantity.scaling === 'diverging' ? divergingPalette() : categoricalPalette(theme.grain);
    return {quantity, range, palette, names};
}

/// Palette index of each cell in a frame.
export function paletteIndices({quantity, range}: Colouring, frame: Frame, cells: Cells): (cell: number) => number {
    const value = quantity.of(frame, cells), last = paletteSize - 1;
    if (quantity.scaling === 'categorical') return (cell) => categoryColour(value(cell));
    const width = range.high - range.low;
    if (!(width > 0)) return () => (quantity.scaling === 'diverging' ? last >> 1 : 0);
    return (cell) => Math.min(last, Math.max(0, Math.round((value(cell) - range.low) / width * last)));
}
