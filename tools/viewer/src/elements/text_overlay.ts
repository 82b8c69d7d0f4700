// SPDX-License-Identifier: GPL-3.0-or-later
// A small piece of writing over the WebGL picture, in a layer of its own and touched only when its text changes: a browser
// without a graphics card pays for every pixel that lies over another.

import {svgElement} from './dom';
import {SvgSheet, type Rectangle, type Sheet} from './sheet';

export class TextOverlay {
    readonly svg = svgElement('svg', {class: 'text-overlay', 'aria-hidden': 'true'});
    private last = '';

    /// Writes what falls into a rectangle of the picture.
    write({x, y, width, height}: Rectangle, write: (sheet: Sheet) => void): void {
        const group = svgElement('g');
        write(new SvgSheet(group));
        const text = `${x} ${y} ${width} ${height} ${group.innerHTML}`;
        if (text === this.last) return;
        this.last = text;
        this.svg.setAttribute('viewBox', `${x} ${y} ${width} ${height}`);
        this.svg.setAttribute('style', `left:${x}px;top:${y}px;width:${width}px;height:${height}px`);
        this.svg.replaceChildren(group);
    }
}
