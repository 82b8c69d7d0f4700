// SPDX-License-Identifier: GPL-3.0-or-later
// Which key does what: the layers' letters, and the list that the help shows.

import {layerNames, type Layer} from '../drawing/settings';

export const layerKeys: Record<string, Layer> = {p: 'particles', o: 'outlines', w: 'platens', k: 'cracks', b: 'bonds', f: 'forces', n: 'numbers'};

export const keyList: readonly (readonly [string, string])[] = [
    ['Space', 'play, pause'],
    ['← →', 'a frame back, on; ten with Shift'],
    ['Home End', 'first, last frame'],
    ['+ − 0', 'zoom in, out, fit (also a double click)'],
    ['c', 'colour by the next quantity; by the one before with Shift'],
    ['m', 'magnify displacements: ×1, ×10, ×100'],
    ...Object.entries(layerKeys).map(([key, layer]) => [key, `${layerNames[layer].toLowerCase()} on, off`] as const),
    ['Esc', 'let go of the picked particle'],
    ['?', 'this list'],
];
