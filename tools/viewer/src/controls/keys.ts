// SPDX-License-Identifier: GPL-3.0-or-later
// The key bindings: the letters of the layers, and the list that the help dialog shows.

import {layerNames, type Layer} from '../drawing/settings';

export const layerKeys: Record<string, Layer> = {p: 'particles', o: 'outlines', w: 'platens', k: 'cracks', b: 'bonds', f: 'forces', n: 'numbers'};

export const keyList: readonly (readonly [string, string])[] = [
    ['Space', 'play, pause'],
    ['← →', 'previous, next frame; ten frames with Shift'],
    ['Home End', 'first, last frame'],
    ['+ − 0', 'zoom in, zoom out, fit (or double-click)'],
    ['c', 'colour by the next quantity; with Shift, by the previous one'],
    ['m', 'magnify displacements: ×1, ×10, ×100'],
    ...Object.entries(layerKeys).map(([key, layer]) => [key, `show, hide ${layerNames[layer].toLowerCase()}`] as const),
    ['Ctrl C', 'copy the picture'],
    ['Esc', 'deselect the picked particle'],
    ['?', 'this list'],
];
