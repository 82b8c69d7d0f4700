// SPDX-License-Identifier: GPL-3.0-or-later
// The view as an SVG file, with the same particles, lines, titles and legend as on the screen. Each particle is a separate shape.

import {paletteIndices} from '../colours/colouring';
import {css, type Rgb} from '../colours/palettes';
import {outline} from '../data/cells';
import type {Frame} from '../data/frames';
import {svgElement} from '../elements/dom';
import {movedCentre, moverOf} from '../geometry/rigid_motion';
import type {Segments} from './segments';
import {lineScale, outlineOf, type Look, type SpecimenView} from './specimen_view';
import type {Pane, Placing} from './stage';

/// The specimens of a pane, clipped at its border.
export function paneAsSvg(pane: Pane, placing: Placing, shown: readonly {view: SpecimenView; frame: Frame; look: Look}[]): SVGElement {
    const {x, y, width, height} = pane.rectangle;
    const svg = svgElement('svg', {x, y, width, height, viewBox: `0 0 ${width} ${height}`});
    for (const {view, frame, look} of shown) {
        view.fillLines(frame, look);
        const group = svgElement('g', {'data-test': view.test.name});
        if (look.settings.layers.particles) group.append(particles(view, frame, look, placing));
        group.append(lines(view.lines, placing, lineScale(view.meanSize * placing.scale)), lines(view.forces, placing, view.widestForce(placing.scale)));
        svg.append(group);
    }
    return svg;
}

function particles(view: SpecimenView, frame: Frame, look: Look, placing: Placing): SVGElement {
    const {cells} = view.test, {magnification, layers} = look.settings;
    const edge = layers.outlines ? outlineOf(view.meanSize * placing.scale) : {width: 0, strength: 0};
    const group = svgElement('g', {class: 'particles', ...(look.opacity < 1 ? {opacity: look.opacity} : {}), ...(edge.width > 0 ? {stroke: look.theme.grainEdge, 'stroke-width': edge.width.toFixed(2), 'stroke-opacity': edge.strength.toFixed(2), 'stroke-linejoin': 'round'} : {})});
    const index = paletteIndices(look.colouring, frame, cells);
    const x = (value: number) => (placing.x + (value - view.origin.x) * placing.scale).toFixed(2);
    const y = (value: number) => (placing.y - (value - view.origin.y) * placing.scale).toFixed(2);
    for (let cell = 0; cell < cells.count; ++cell) {
        if (cells.open[cell] === 1) continue;
        const fill = css(look.colouring.palette[index(cell)]!);
        if (cells.radius[cell]! > 0) {
            const centre = movedCentre(cells, frame, cell, magnification);
            group.append(svgElement('circle', {class: 'particle', cx: x(centre.x), cy: y(centre.y), r: (cells.radius[cell]! * placing.scale).toFixed(2), fill}));
            continue;
        }
        const corners = outline(cells, cell).map(moverOf(cells, frame, cell, magnification));
        group.append(svgElement('path', {class: 'particle', d: `M${corners.map((corner) => `${x(corner.x)} ${y(corner.y)}`).join('L')}Z`, fill}));
    }
    return group;
}

/// The segments as paths; all lines of the same width and colour share one path, and all bands of the same colour.
function lines(segments: Segments, placing: Placing, widest: number): SVGElement {
    const group = svgElement('g', {fill: 'none', 'stroke-linecap': 'round'});
    const paths = new Map<string, string[]>();
    for (let at = 0; at < segments.count; ++at) {
        const [x1, y1, x2, y2] = segments.ends.subarray(4 * at, 4 * at + 4) as unknown as [number, number, number, number];
        const [r, g, b, a] = segments.colours.subarray(4 * at, 4 * at + 4) as unknown as [number, number, number, number];
        const point = (x: number, y: number) => `${(placing.x + x * placing.scale).toFixed(2)} ${(placing.y - y * placing.scale).toFixed(2)}`;
        const isBand = segments.isBand(at), [u1, v1, u2, v2] = segments.sides.subarray(4 * at, 4 * at + 4) as unknown as [number, number, number, number];
        const width = isBand ? 'band' : (Math.round(20 * Math.max(0.3, segments.widths[at]! * widest)) / 20).toFixed(2);
        const key = `${css([r, g, b] as Rgb)} ${width} ${(a / 255).toFixed(2)}`;
        const found = paths.get(key);
        const d = isBand ? `M${point(x1 + u1, y1 + v1)}L${point(x2 + u2, y2 + v2)}L${point(x2 - u2, y2 - v2)}L${point(x1 - u1, y1 - v1)}Z` : `M${point(x1, y1)}L${point(x2, y2)}`;
        if (found) found.push(d);
        else paths.set(key, [d]);
    }
    for (const [key, d] of paths) {
        const [stroke, width, opacity] = key.split(' ') as [string, string, string];
        group.append(svgElement('path', width === 'band' ? {d: d.join(''), fill: stroke, 'fill-opacity': opacity} : {d: d.join(''), stroke, 'stroke-width': width, 'stroke-opacity': opacity}));
    }
    return group;
}
