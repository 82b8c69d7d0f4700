// SPDX-License-Identifier: GPL-3.0-or-later
// The fragments at the end of a test: groups of cells joined by unbroken bonds. A card has a drawing coloured by
// fragment, and the areas of the largest fragments relative to the specimen's area.

import {categoricalPalette, categoryColour, css} from '../colours/palettes';
import type {Theme} from '../colours/theme';
import {area} from '../data/cells';
import type {Frame} from '../data/frames';
import {drawSpecimen, leftOutText, viewsOfMoments} from '../drawing/specimen_svg';
import type {SpecimenView} from '../drawing/specimen_view';
import {element, saveFile, svgText} from '../elements/dom';
import type {InView} from '../geometry/extent';
import {counted, significant, strain, thinSpace} from '../quantities/units';
import type {Moments} from './specimen_cards';

const drawnHeight = 330; // px
const drawnWidth = 300;
const listed = 6;

interface Fragment {
    particles: number; // a clump counts as one
    area: number; // m²
}

/// The fragments of a frame, the largest first.
export function fragmentsOf(view: SpecimenView, frame: Frame): Fragment[] {
    const {cells} = view.test, member = frame.field('fragment'), found: (Fragment & {ids: Set<number>})[] = [];
    for (let cell = 0; member && cell < cells.count; ++cell) {
        if (cells.open[cell] === 1) continue;
        const fragment = found[member[cell]!] ??= {particles: 0, area: 0, ids: new Set()};
        fragment.ids.add(cells.id[cell]!);
        fragment.particles = fragment.ids.size;
        fragment.area += area(cells, cell);
    }
    return found.filter((fragment) => fragment).sort((a, b) => b.area - a.area);
}

export function fragmentCard({view, frames}: Moments, theme: Theme): HTMLElement | undefined {
    const frame = frames[frames.length - 1];
    if (!frame) return undefined;
    const fragments = fragmentsOf(view, frame), member = frame.field('fragment');
    if (fragments.length === 0 || !member) return undefined;
    const {test} = view, palette = categoricalPalette(theme.grain);
    const [seen] = viewsOfMoments(test, [frame], 1) as [InView], {extent} = seen;
    const pixelsPerMetre = Math.min(drawnHeight / (extent.y2 - extent.y1), drawnWidth / (extent.x2 - extent.x1));
    const drawing = drawSpecimen({test, cracks: [], frame, view: seen, pixelsPerMetre, magnification: 1, scaleBar: true,
        fills: (cell) => css(palette[categoryColour(member[cell]!)]!)}, theme);
    const whole = fragments.reduce((sum, fragment) => sum + fragment.area, 0);
    const share = (part: number) => `${significant(100 * part / whole, 3)}${thinSpace}%`;
    const save = element('button', {type: 'button', class: 'save', title: 'Save this drawing as SVG'}, 'SVG');
    save.addEventListener('click', () => saveFile(`${test.name}-fragments.svg`, 'image/svg+xml', svgText(drawing)));
    const rest = fragments.slice(listed), single = fragments.filter(({particles}) => particles === 1).length;
    return element('article', {class: 'card fragments', 'data-test': test.name},
        element('h3', {}, view.labelled.label, element('small', {}, `${counted(fragments.length)} ${fragments.length === 1 ? 'fragment' : 'fragments'} at ε = ${strain(frame.strain)}`)),
        element('div', {class: 'fragments-row'},
            element('figure', {}, drawing, element('figcaption', {}, leftOutText(seen.leftOut), save)),
            element('table', {class: 'shares'},
                element('tr', {}, element('th', {scope: 'col'}, 'Fragment'), element('th', {scope: 'col'}, 'Particles'), element('th', {scope: 'col'}, 'Share of the area')),
                ...fragments.slice(0, listed).map((fragment, at) => element('tr', {},
                    element('td', {}, element('i', {class: 'swatch', style: `background:${css(palette[at]!)}`}), String(at + 1)), element('td', {}, counted(fragment.particles)), element('td', {}, share(fragment.area)))),
                ...(rest.length > 0 ? [element('tr', {}, element('td', {}, `${counted(rest.length)} more`), element('td', {}, counted(rest.reduce((sum, {particles}) => sum + particles, 0))),
                    element('td', {}, share(rest.reduce((sum, fragment) => sum + fragment.area, 0))))] : []),
                element('tr', {class: 'total'}, element('td', {}, 'Single particles'), element('td', {}, counted(single)), element('td', {}, '')))));
}
