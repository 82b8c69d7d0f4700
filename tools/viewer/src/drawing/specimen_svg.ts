// SPDX-License-Identifier: GPL-3.0-or-later
// One specimen at one moment, as SVG: particles, platens, and the faces of broken bonds coloured by mode.
// Bodies are moved rigidly from their positions in the first frame; displacements may be magnified.

import type {Theme} from '../colours/theme';
import {outline, type Point} from '../data/cells';
import type {Frame} from '../data/frames';
import type {TestData} from '../data/report';
import {svgElement} from '../elements/dom';
import {crackState, type Crack} from '../geometry/cracks';
import {inView, type InView} from '../geometry/extent';
import {movedCentre, moverOf} from '../geometry/rigid_motion';
import {counted, quantity} from '../quantities/units';
import {magnified} from './annotations';

/// Extents of the drawings of a test's frames, with room for the ends of the platens. Widths differ, but all heights are equal.
export function viewsOfMoments(test: TestData, frames: readonly Frame[], magnification: number): InView[] {
    const views = frames.map((frame) => inView(test, frame, magnification));
    const y1 = Math.min(...views.map(({extent}) => extent.y1)), y2 = Math.max(...views.map(({extent}) => extent.y2));
    return views.map((view) => {
        const room = 0.06 * (view.extent.x2 - view.extent.x1);
        return {...view, extent: {x1: view.extent.x1 - room, x2: view.extent.x2 + room, y1, y2}};
    });
}

/// Note on the number of particles that a drawing does not show; empty if it shows all.
export const leftOutText = (count: number): string => (count === 0 ? '' : `${counted(count)} ${count === 1 ? 'particle' : 'particles'} farther out`);

interface Drawing {
    test: TestData;
    cracks: Crack[];
    frame: Frame;
    view: InView;
    pixelsPerMetre: number;
    magnification: number;
    scaleBar: boolean;
    fills?: (cell: number) => string; // colour of each cell; by default the theme's grain colour
}

const margin = 4; // px, around the extent
const barRoom = 24; // px, height for the scale bar

/// A round length of about a third of the specimen's width.
function barLength(width: number): number {
    const power = 10 ** Math.floor(Math.log10(width / 3));
    return [5, 2, 1].map((step) => step * power).find((length) => length <= width / 2.5) ?? power;
}

function addTo(lists: Map<string, string[]>, key: string, path: string): void {
    const list = lists.get(key);
    if (list) list.push(path);
    else lists.set(key, [path]);
}

export function drawSpecimen(drawing: Drawing, theme: Theme): SVGElement {
    const {test, cracks, frame, view: {extent, shows}, pixelsPerMetre: scale, magnification} = drawing;
    const {cells} = test;
    const x = (point: Point) => ((point.x - extent.x1) * scale + margin).toFixed(2);
    const y = (point: Point) => ((extent.y2 - point.y) * scale + margin).toFixed(2);
    const width = (extent.x2 - extent.x1) * scale + 2 * margin;
    const height = (extent.y2 - extent.y1) * scale + 2 * margin;

    const grains = new Map<string, string[]>(), platens: string[] = [];
    for (let cell = 0; cell < cells.count; ++cell) {
        if (!shows(cell)) continue;
        const radius = cells.radius[cell]!, fill = drawing.fills?.(cell) ?? theme.grain;
        if (radius > 0) {
            const at = movedCentre(cells, frame, cell, magnification);
            const r = (radius * scale).toFixed(2), d = (2 * radius * scale).toFixed(2);
            addTo(grains, fill, `M${x(at)} ${y(at)}m-${r} 0a${r} ${r} 0 1 0 ${d} 0a${r} ${r} 0 1 0-${d} 0`);
            continue;
        }
        const points = outline(cells, cell).map(moverOf(cells, frame, cell, magnification));
        const path = `M${points.map((point) => `${x(point)} ${y(point)}`).join('L')}`;
        if (cells.open[cell] === 1) platens.push(path);
        else addTo(grains, fill, `${path}Z`);
    }

    const faces = {tension: [] as string[], shear: [] as string[], tensionPart: [] as string[], shearPart: [] as string[]};
    for (const crack of cracks) {
        const state = crackState(crack, frame.time);
        if (!state) continue;
        const mode = state.shear ? 'shear' : 'tension';
        const list = state.parted ? faces[mode] : faces[`${mode}Part`];
        for (const face of crack.faces.filter(({cell}) => shows(cell))) {
            const move = moverOf(cells, frame, face.cell, magnification);
            const from = move(face.from), to = move(face.to);
            list.push(`M${x(from)} ${y(from)}L${x(to)} ${y(to)}`);
        }
    }

    // Line widths are proportional to the particle size, since lines of fixed width would cover small particles.
    const size = scale * Math.sqrt((extent.x2 - extent.x1) * (extent.y2 - extent.y1) / Math.max(1, cells.count));
    const edge = Math.min(0.8, Math.max(0.1, 0.03 * size)), crack = Math.min(1.6, Math.max(0.6, 0.1 * size));
    const line = (list: string[], name: string, colour: string, lineWidth: number, dashes = '') =>
        svgElement('path', {class: name, d: list.join(''), fill: 'none', stroke: colour, 'stroke-width': lineWidth.toFixed(2), 'stroke-linecap': 'round',
            ...(dashes ? {'stroke-dasharray': dashes} : {}), 'data-count': list.length});
    const svg = svgElement('svg', {
        viewBox: `0 0 ${width.toFixed(2)} ${(height + barRoom).toFixed(2)}`, width: width.toFixed(2), height: (height + barRoom).toFixed(2), role: 'img',
        'aria-label': `${test.name}, ${frame.entry.roles?.join(', ') ?? `frame ${frame.index}`}`, 'data-roles': frame.entry.roles?.join(' ') ?? '',
    },
        ...[...grains].map(([fill, list]) => svgElement('path', {class: 'grains', d: list.join(''), fill, stroke: theme.grainEdge, 'stroke-width': edge.toFixed(2),
            'stroke-linejoin': 'round', 'data-count': list.length})),
        line(platens, 'platens', theme.platen, 4),
        line(faces.tensionPart, 'tension-part', theme.tension, 0.6 * crack, '1.5 2.5'), line(faces.shearPart, 'shear-part', theme.shear, 0.6 * crack, '1.5 2.5'),
        line(faces.tension, 'tension', theme.tension, crack), line(faces.shear, 'shear', theme.shear, crack));
    if (drawing.scaleBar) {
        const length = barLength(extent.x2 - extent.x1), low = height + 8;
        svg.append(
            svgElement('path', {d: `M${margin} ${low - 3}v6M${margin} ${low}h${(length * scale).toFixed(2)}m0-3v6`, stroke: theme.ink, fill: 'none'}),
            svgElement('text', {x: (margin + length * scale + 6).toFixed(2), y: low + 4, fill: theme.ink, 'font-size': 11, 'font-family': 'system-ui, Arial, sans-serif'},
                quantity(length, 'm', 2) + magnified(drawing.magnification)));
    }
    return svg;
}
