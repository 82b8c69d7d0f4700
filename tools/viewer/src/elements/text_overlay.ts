// SPDX-License-Identifier: GPL-3.0-or-later
// A small SVG with text over the WebGL picture. It is updated only when its content changes, because without a graphics card
// every pixel that covers another one takes time.

import {svgElement} from './dom';
import {SvgSheet, type Rectangle, type Sheet} from './sheet';

export class TextOverlay {
    readonly svg = svgElement('svg', {class: 'text-overlay', 'aria-hidden': 'true'});
    private last = '';

    /// Draws the part of the picture's text that lies in a rectangle.
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
