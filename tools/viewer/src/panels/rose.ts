// SPDX-License-Identifier: GPL-3.0-or-later
// The rose diagram of crack directions as SVG. Lengths of sectors are counts, stacked by mode; circles mark round counts.

import type {Theme} from '../colours/theme';
import type {Events} from '../data/report';
import {svgElement} from '../elements/dom';
import {fontFamily} from '../elements/sheet';
import {counted} from '../quantities/units';
import {countDirections} from './crack_directions';

const size = 236, radius = 86; // px
const sectorShare = 0.92; // width of a sector relative to that of a class

/// Counts marked by circles: at most four, of which the outermost is at or above the largest count.
function circles(most: number): number[] {
    const power = 10 ** Math.floor(Math.log10(Math.max(1, most)));
    const step = [0.5, 1, 2, 5, 10].map((factor) => factor * power).find((candidate) => Number.isInteger(candidate) && candidate * 4 >= most) ?? 1;
    return Array.from({length: Math.max(1, Math.ceil(most / step))}, (_, at) => (at + 1) * step);
}

export function drawRose(events: Events, theme: Theme): SVGElement {
    const {tension, shear, width} = countDirections(events);
    const all = tension.map((count, at) => count + shear[at]!), rings = circles(Math.max(...all)), outer = rings[rings.length - 1]!;
    const at = (degrees: number, r: number) => {
        const angle = degrees * Math.PI / 180;
        return {x: size / 2 + r * Math.cos(angle), y: size / 2 - r * Math.sin(angle)};
    };
    const text = (degrees: number, r: number, content: string, colour: string, name: string) => {
        const {x, y} = at(degrees, r);
        return svgElement('text', {class: name, x: x.toFixed(1), y: (y + 3.5).toFixed(1), 'text-anchor': 'middle', fill: colour, 'font-size': 10.5, 'font-family': fontFamily,
            stroke: theme.background, 'stroke-width': 2.5, 'stroke-linejoin': 'round', 'paint-order': 'stroke'}, content);
    };
    const sector = (middle: number, from: number, to: number, fill: string) => {
        const half = sectorShare * width / 2, [a, b] = [from, to].map((count) => radius * count / outer) as [number, number];
        const point = (degrees: number, r: number) => `${at(degrees, r).x.toFixed(2)} ${at(degrees, r).y.toFixed(2)}`;
        const [rA, rB] = [a.toFixed(2), b.toFixed(2)];
        return svgElement('path', {class: 'sector', fill,
            d: `M${point(middle - half, a)}L${point(middle - half, b)}A${rB} ${rB} 0 0 0 ${point(middle + half, b)}L${point(middle + half, a)}A${rA} ${rA} 0 0 1 ${point(middle - half, a)}Z`});
    };
    // Counts are printed in the direction with the fewest cracks, away from the axes, whose ends have their own labels.
    const fewest = [20, 30, 40, 50, 60, 70].map((degrees) => ({degrees, cracks: [-1, 0, 1].reduce((sum, off) => sum + all[degrees / width + off]!, 0)}))
        .reduce((best, one) => (one.cracks < best.cracks ? one : best)).degrees;
    return svgElement('svg', {viewBox: `0 0 ${size} ${size}`, width: size, height: size},
        ...rings.map((count) => svgElement('circle', {cx: size / 2, cy: size / 2, r: (radius * count / outer).toFixed(2), fill: 'none', stroke: theme.grid})),
        ...[0, 90, 180, 270].map((degrees) => svgElement('path', {d: `M${size / 2} ${size / 2}L${at(degrees, radius).x} ${at(degrees, radius).y}`, stroke: theme.grid})),
        ...all.flatMap((count, k) => [
            ...(tension[k]! > 0 ? [sector(k * width, 0, tension[k]!, theme.tension)] : []),
            ...(shear[k]! > 0 ? [sector(k * width, tension[k]!, count, theme.shear)] : []),
        ]),
        ...[0, 90, 180, 270].map((degrees) => text(degrees, radius + (degrees % 180 === 0 ? 18 : 11), `${degrees}°`, theme.muted, 'angle')),
        ...rings.map((count) => text(fewest, radius * count / outer, counted(count), theme.ink, 'count')));
}
