// SPDX-License-Identifier: GPL-3.0-or-later
// One specimen at one moment, as SVG: particles, platens, and the faces of broken bonds coloured by mode.
// Bodies move as rigid bodies from the first frame; displacements may be drawn magnified.

import type {Bodies, Frame, TestData} from './data';
import {centre, outline, type Crack, type Point} from './cracks';
import {svgElement} from './dom';
import type {Theme} from './theme';
import {quantity} from './units';

export interface Extent {
    x1: number;
    x2: number;
    y1: number;
    y2: number;
}

/// A body's rigid motion since the first frame, times the magnification.
interface Motion {
    centre: Point; // in the first frame
    moved: Point; // displacement
    cos: number;
    sin: number;
}

function motions(bodies: Bodies, start: Frame, frame: Frame, magnification: number): Motion[] {
    return Array.from({length: bodies.id.length}, (_, body) => {
        const angle = (frame.angle[body]! - start.angle[body]!) * magnification;
        return {
            centre: centre(bodies, body),
            moved: {x: (frame.x[body]! - start.x[body]!) * magnification, y: (frame.y[body]! - start.y[body]!) * magnification},
            cos: Math.cos(angle),
            sin: Math.sin(angle),
        };
    });
}

function move(motion: Motion, point: Point): Point {
    const x = point.x - motion.centre.x, y = point.y - motion.centre.y;
    return {
        x: motion.centre.x + motion.moved.x + motion.cos * x - motion.sin * y,
        y: motion.centre.y + motion.moved.y + motion.sin * x + motion.cos * y,
    };
}

function extentOf(bodies: Bodies, moved: Motion[]): Extent {
    const extent = {x1: Infinity, x2: -Infinity, y1: Infinity, y2: -Infinity};
    const betweenPlatens = bodies.open.includes(1);
    moved.forEach((motion, body) => {
        const room = bodies.radius[body]!, platen = bodies.open[body] === 1;
        for (const point of outline(bodies, body)) {
            const at = move(motion, point);
            if (platen || !betweenPlatens) { // what flies off beyond the platens is cut off
                extent.y1 = Math.min(extent.y1, at.y - room);
                extent.y2 = Math.max(extent.y2, at.y + room);
            }
            if (platen) continue; // platens may be far wider than the specimen: cut off
            extent.x1 = Math.min(extent.x1, at.x - room);
            extent.x2 = Math.max(extent.x2, at.x + room);
        }
    });
    return extent;
}

/// The box that holds all of a test's frames, and of the platens a little more than the specimen's width. Fragments that
/// flew off are followed sideways for three tenths of the width, so that they do not make the specimen small (all the way
/// where displacements are magnified).
export function extentOfTest(test: TestData, magnification: number): Extent {
    const start = test.frames[0]!;
    const extents = test.frames.map((frame) => extentOf(test.bodies, motions(test.bodies, start, frame, magnification)));
    const first = extents[0]!, width = first.x2 - first.x1, room = magnification > 1 ? Infinity : 0.3 * width;
    const left = Math.min(...extents.map((extent) => extent.x1)), right = Math.max(...extents.map((extent) => extent.x2));
    return {
        x1: Math.max(left, first.x1 - room) - 0.06 * width,
        x2: Math.min(right, first.x2 + room) + 0.06 * width,
        y1: Math.min(...extents.map((extent) => extent.y1)),
        y2: Math.max(...extents.map((extent) => extent.y2)),
    };
}

export interface BrokenSoFar {
    tension: number; // bonded points
    shear: number;
}

/// Bonded points broken up to a time. A frame written right after a break carries its time.
export function brokenUntil(cracks: Crack[], time: number): BrokenSoFar {
    const counts = {tension: 0, shear: 0};
    for (const crack of cracks) for (const one of crack.breaks) if (one.time <= time) counts[one.shear ? 'shear' : 'tension'] += 1;
    return counts;
}

interface Drawing {
    test: TestData;
    cracks: Crack[];
    frame: Frame;
    extent: Extent;
    pixelsPerMetre: number;
    magnification: number;
    scaleBar: boolean;
}

const margin = 4; // px around the extent
const barRoom = 24; // px for the scale bar

/// A round length of about a third of the specimen's width.
function barLength(width: number): number {
    const power = 10 ** Math.floor(Math.log10(width / 3));
    return [5, 2, 1].map((step) => step * power).find((length) => length <= width / 2.5) ?? power;
}

export function drawSpecimen(drawing: Drawing, theme: Theme): SVGElement {
    const {test, cracks, frame, extent, pixelsPerMetre: scale, magnification} = drawing;
    const {bodies} = test;
    const moved = motions(bodies, test.frames[0]!, frame, magnification);
    const x = (point: Point) => ((point.x - extent.x1) * scale + margin).toFixed(2);
    const y = (point: Point) => ((extent.y2 - point.y) * scale + margin).toFixed(2);
    const width = (extent.x2 - extent.x1) * scale + 2 * margin;
    const height = (extent.y2 - extent.y1) * scale + 2 * margin;

    const grains: string[] = [], platens: string[] = [];
    for (let body = 0; body < bodies.id.length; ++body) {
        const motion = moved[body]!;
        const radius = bodies.radius[body]!;
        if (radius > 0) {
            const at = move(motion, motion.centre);
            const r = (radius * scale).toFixed(2), d = (2 * radius * scale).toFixed(2);
            grains.push(`M${x(at)} ${y(at)}m-${r} 0a${r} ${r} 0 1 0 ${d} 0a${r} ${r} 0 1 0-${d} 0`);
            continue;
        }
        const points = outline(bodies, body).map((point) => move(motion, point));
        const path = `M${points.map((point) => `${x(point)} ${y(point)}`).join('L')}`;
        if (bodies.open[body] === 1) platens.push(path);
        else grains.push(`${path}Z`);
    }

    const faces = {tension: [] as string[], shear: [] as string[], tensionPart: [] as string[], shearPart: [] as string[]};
    for (const crack of cracks) {
        const broken = crack.breaks.filter((one) => one.time <= frame.time);
        if (broken.length === 0) continue;
        const shear = 2 * broken.filter((one) => one.shear).length > broken.length ? 'shear' : 'tension';
        const list = broken.some((one) => one.last) ? faces[shear] : faces[`${shear}Part`];
        for (const face of crack.faces) {
            const from = move(moved[face.body]!, face.from), to = move(moved[face.body]!, face.to);
            list.push(`M${x(from)} ${y(from)}L${x(to)} ${y(to)}`);
        }
    }

    const edge = Math.min(0.8, Math.max(0.2, 40 / Math.sqrt(bodies.id.length * 20)));
    const line = (list: string[], name: string, colour: string, lineWidth: number, dashes = '') =>
        svgElement('path', {class: name, d: list.join(''), fill: 'none', stroke: colour, 'stroke-width': lineWidth, 'stroke-linecap': 'round',
            ...(dashes ? {'stroke-dasharray': dashes} : {}), 'data-count': list.length});
    const svg = svgElement('svg', {
        viewBox: `0 0 ${width.toFixed(2)} ${(height + barRoom).toFixed(2)}`, width: width.toFixed(2), height: (height + barRoom).toFixed(2), role: 'img',
        'aria-label': `${test.name}, ${frame.role}`, 'data-role': frame.role,
    },
        svgElement('path', {class: 'grains', d: grains.join(''), fill: theme.grain, stroke: theme.grainEdge, 'stroke-width': edge.toFixed(2),
            'stroke-linejoin': 'round', 'data-count': grains.length}),
        line(platens, 'platens', theme.platen, 4),
        line(faces.tensionPart, 'tension-part', theme.tension, 1, '1.5 2.5'), line(faces.shearPart, 'shear-part', theme.shear, 1, '1.5 2.5'),
        line(faces.tension, 'tension', theme.tension, 1.6), line(faces.shear, 'shear', theme.shear, 1.6));
    if (drawing.scaleBar) {
        const length = barLength(extent.x2 - extent.x1), low = height + 8;
        svg.append(
            svgElement('path', {d: `M${margin} ${low - 3}v6M${margin} ${low}h${(length * scale).toFixed(2)}m0-3v6`, stroke: theme.ink, fill: 'none'}),
            svgElement('text', {x: (margin + length * scale + 6).toFixed(2), y: low + 4, fill: theme.ink, 'font-size': 11, 'font-family': 'system-ui, Arial, sans-serif'},
                quantity(length, 'm', 2)));
    }
    return svg;
}
