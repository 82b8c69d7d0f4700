// SPDX-License-Identifier: GPL-3.0-or-later
// Cards with drawings of the specimens: for each test at start, peak and end, side by side at the same scale.

import type {Theme} from '../colours/theme';
import type {Frame} from '../data/frames';
import type {Role} from '../data/report';
import {sortedBy, type LabelledTest} from '../data/test_labels';
import {drawSpecimen, leftOutText, viewsOfMoments} from '../drawing/specimen_svg';
import type {SpecimenView} from '../drawing/specimen_view';
import {element, saveFile, svgText} from '../elements/dom';
import {brokenUntil} from '../geometry/cracks';
import type {InView} from '../geometry/extent';
import {counted, quantity, strain} from '../quantities/units';

export const magnifications = [1, 5, 20, 100] as const;
const drawnHeight = 330; // px, height of the tallest specimen
const cardWidth = 560; // px, width of three drawings with gaps

function rolesText(labelled: LabelledTest, roles: readonly Role[]): string {
    const text = roles.map((role) => (role === 'peak' && !labelled.test.failed ? 'peak so far' : role)).join(', ');
    return text.charAt(0).toUpperCase() + text.slice(1);
}

/// The frames of a test that have a role, in order.
export interface Moments {
    view: SpecimenView;
    frames: Frame[];
}

export async function momentsOf(view: SpecimenView): Promise<Moments> {
    const wanted = view.test.frames.flatMap(({roles}, index) => (roles ? [index] : []));
    const frames: Frame[] = [];
    for (const index of wanted) frames.push(await view.frames.load(index));
    return {view, frames};
}

function card({view, frames}: Moments, seen: readonly InView[], pixelsPerMetre: number, magnification: number, theme: Theme): HTMLElement {
    const {labelled, test, cracks} = view;
    const width = test.summary['initial_width'], height = test.summary['initial_height'];
    const size = typeof width === 'number' && typeof height === 'number' ? `${quantity(width, 'm')} × ${quantity(height, 'm')}` : '';
    const row = element('div', {class: 'moments'});
    for (const [index, frame] of frames.entries()) {
        const roles = frame.entry.roles ?? [];
        const broken = brokenUntil(test.events, frame.time);
        const drawing = drawSpecimen({test, cracks, frame, view: seen[index]!, pixelsPerMetre, magnification, scaleBar: index === 0}, theme);
        const save = element('button', {type: 'button', class: 'save', title: 'Save this drawing as SVG'}, 'SVG');
        save.addEventListener('click', () => saveFile(`${test.name}-${roles.join('-')}.svg`, 'image/svg+xml', svgText(drawing)));
        row.append(element('figure', {},
            drawing,
            element('figcaption', {},
                element('b', {}, rolesText(labelled, roles)), ` ε = ${strain(frame.strain)}`, element('br'),
                [`${counted(broken.tension + broken.shear)} broken`, leftOutText(seen[index]!.leftOut)].filter((text) => text !== '').join(', '), save)));
    }
    return element('article', {class: 'card', 'data-test': test.name},
        element('h3', {}, labelled.label, element('small', {}, size), ...(test.failed ? [] : [element('em', {class: 'warning'}, 'not failed')])),
        row);
}

/// The specimen of a test at its last moment. @param height, width  px, of the space for it @param name  of the test in the caption
export function brokenSpecimen({view, frames}: Moments, height: number, width: number, name: string, theme: Theme): HTMLElement {
    const frame = frames[frames.length - 1]!, {labelled, test, cracks} = view;
    const seen = viewsOfMoments(test, [frame], 1)[0]!, {extent} = seen;
    const pixelsPerMetre = Math.min(height / (extent.y2 - extent.y1), Math.max(width, 120) / (extent.x2 - extent.x1));
    return element('figure', {},
        drawSpecimen({test, cracks, frame, view: seen, pixelsPerMetre, magnification: 1, scaleBar: true}, theme),
        element('figcaption', {}, element('b', {}, name || rolesText(labelled, frame.entry.roles ?? [])), element('br'), `ε = ${strain(frame.strain)}`));
}

export function drawings(moments: Moments[], magnification: number, theme: Theme): HTMLElement[] {
    const order = sortedBy('specimen', moments.map(({view}) => view.labelled)).map(({test}) => test);
    const drawn = moments.filter(({frames}) => frames.length > 0).sort((a, b) => order.indexOf(a.view.test) - order.indexOf(b.view.test));
    const seen = drawn.map(({view, frames}) => viewsOfMoments(view.test, frames, magnification));
    const scales = seen.map((views) => Math.min(drawnHeight / (views[0]!.extent.y2 - views[0]!.extent.y1),
        (cardWidth - 16 * views.length) / views.reduce((sum, {extent}) => sum + extent.x2 - extent.x1, 0)));
    // All specimens have the same scale, unless sizes differ so much that small ones would be hard to see.
    const smallest = Math.min(...scales), shared = Math.max(...scales) < 2 * smallest;
    return drawn.map((one, index) => card(one, seen[index]!, shared ? smallest : scales[index]!, magnification, theme));
}
