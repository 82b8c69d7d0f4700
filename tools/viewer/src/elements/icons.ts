// SPDX-License-Identifier: GPL-3.0-or-later
// Icons of the playback buttons, drawn as SVG because symbols differ between fonts.

import {svgElement} from './dom';

const paths = {
    first: 'M3 3h2v10h-2zM13 3v10l-7-5z',
    back: 'M11 3v10l-7-5z',
    play: 'M4 2.5v11l9-5.5z',
    pause: 'M4 3h3v10h-3zM9 3h3v10h-3z',
    on: 'M5 3v10l7-5z',
    last: 'M11 3h2v10h-2zM3 3v10l7-5z',
} as const;

export function icon(name: keyof typeof paths): SVGElement {
    return svgElement('svg', {viewBox: '0 0 16 16', width: 15, height: 15, class: 'icon', 'aria-hidden': 'true'}, svgElement('path', {d: paths[name]}));
}
