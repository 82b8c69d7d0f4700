// SPDX-License-Identifier: GPL-3.0-or-later
// The figure of specimens: a card for each test with the drawings of start, peak and end side by side, all at one scale.

import {findCracks, type Crack} from './cracks';
import {element, saveFile} from './dom';
import {sortedBy, type Styled} from './grouping';
import {brokenUntil, drawSpecimen, extentOfTest, type Extent} from './specimen';
import type {Theme} from './theme';
import {counted, quantity, strain} from './units';

export const magnifications = [1, 5, 20, 100] as const;
const drawnHeight = 330; // px, tallest specimen
const cardWidth = 560; // px, three drawings and their gaps

const roleNames = {start: 'Start', peak: 'Peak', end: 'End'} as const;

function roleName(styled: Styled, role: keyof typeof roleNames): string {
    return role === 'peak' && !styled.test.failed ? 'Peak so far' : roleNames[role];
}

function card(styled: Styled, cracks: Crack[], extent: Extent, pixelsPerMetre: number, magnification: number, theme: Theme): HTMLElement {
    const {test} = styled;
    const width = test.summary['initial_width'], height = test.summary['initial_height'];
    const size = typeof width === 'number' && typeof height === 'number' ? `${quantity(width, 'm')} × ${quantity(height, 'm')}` : '';
    const row = element('div', {class: 'moments'});
    for (const [index, frame] of test.frames.entries()) {
        const broken = brokenUntil(cracks, frame.time);
        const drawing = drawSpecimen({test, cracks, frame, extent, pixelsPerMetre, magnification, scaleBar: index === 0}, theme);
        const save = element('button', {type: 'button', class: 'save', title: 'Save this drawing as SVG'}, 'SVG');
        save.addEventListener('click', () => saveFile(`${test.name}-${frame.role}.svg`, 'image/svg+xml', new XMLSerializer().serializeToString(drawing)));
        row.append(element('figure', {},
            drawing,
            element('figcaption', {},
                element('b', {}, roleName(styled, frame.role)), ` ε = ${strain(frame.strain)}`, element('br'),
                `${counted(broken.tension + broken.shear)} broken`, save)));
    }
    return element('article', {class: 'card', 'data-test': test.name},
        element('h3', {}, styled.label, element('small', {}, size), ...(test.failed ? [] : [element('em', {class: 'warning'}, 'not failed')])),
        row);
}

export function drawings(tests: Styled[], magnification: number, theme: Theme): HTMLElement[] {
    const drawn = sortedBy('specimen', tests).filter(({test}) => test.frames.length > 0);
    const extents = drawn.map(({test}) => extentOfTest(test, magnification));
    const scales = extents.map((extent, index) => Math.min(drawnHeight / (extent.y2 - extent.y1),
        (cardWidth / drawn[index]!.test.frames.length - 16) / (extent.x2 - extent.x1)));
    // One scale for all, unless sizes differ so much that small specimens would be lost.
    const smallest = Math.min(...scales), shared = Math.max(...scales) < 2 * smallest;
    return drawn.map((styled, index) =>
        card(styled, findCracks(styled.test.bodies, styled.test.events), extents[index]!, shared ? smallest : scales[index]!, magnification, theme));
}
