// SPDX-License-Identifier: GPL-3.0-or-later
// Text over a pane: names and moments of the tests, a scale bar, and particle numbers that fit.

import type {Theme} from '../colours/theme';
import type {Frame} from '../data/frames';
import {peakOf, type TestData} from '../data/report';
import type {Sheet, TextStyle} from '../elements/sheet';
import {movedCentre} from '../geometry/rigid_motion';
import {counted, quantity, strain, stressText} from '../quantities/units';
import type {SpecimenView} from './specimen_view';
import type {Pane, Placing} from './stage';

/// Text such as "ε = 1.94 ‰ σ = 67.2 kN/m"; the time if the frame has no strain.
export function momentText(frame: Frame, test: TestData): string {
    if (frame.strain === undefined) return `t = ${quantity(frame.time, 's')}`;
    const stress = frame.entry.axial_stress;
    if (stress === undefined) return `ε = ${strain(frame.strain)}`;
    const text = stressText(stress, peakOf(test).stress);
    return `ε = ${strain(frame.strain)}\u2003σ ${text.startsWith('≈') ? text : `= ${text}`}`;
}

/// Note that displacements are magnified; empty if they are not.
export const magnified = (magnification: number): string => (magnification === 1 ? '' : `\u2003displacements ×${magnification}`);

const smallestTitle = 8.5; // px

/// Reduces the text size until the text fits; if the smallest size is not enough, cuts off the end of the text.
function fitted(sheet: Sheet, text: string, style: TextStyle, room: number): {text: string; style: TextStyle; width: number} {
    const size = Math.max(smallestTitle, Math.min(style.size, style.size * room / Math.max(1, sheet.widthOf(text, style))));
    const smaller = {...style, size};
    let shown = text;
    while (shown.length > 1 && sheet.widthOf(shown, smaller) > room + 0.5) shown = `${shown.replace(/…$/, '').slice(0, -1).trimEnd()}…`;
    return {text: shown, style: smaller, width: sheet.widthOf(shown, smaller)};
}

/// Draws the name and the moment of each test, on two lines if the pane is too narrow for one.
export function drawTitles(sheet: Sheet, pane: Pane, names: readonly {label: string; colour: string; moment: string}[], theme: Theme): void {
    let x = pane.rectangle.x + 9;
    const y = pane.rectangle.y + 17;
    for (const {label, colour, moment} of names) {
        const nameStyle = {size: 13, colour, bold: true, halo: theme.background}, momentStyle = {size: 12, colour: theme.muted, halo: theme.background};
        const oneLine = names.length === 1 && sheet.widthOf(label, nameStyle) + sheet.widthOf(moment, momentStyle) + 28 < pane.rectangle.width;
        const room = oneLine ? pane.rectangle.width : (pane.rectangle.width - 18 - 22 * (names.length - 1)) / names.length;
        const name = fitted(sheet, label, nameStyle, room), below = fitted(sheet, moment, momentStyle, room);
        sheet.text(x, y, name.text, name.style);
        sheet.text(oneLine ? x + name.width + 10 : x, oneLine ? y : y + 16, below.text, below.style);
        x += Math.max(name.width, below.width) + 22;
    }
}

/// Draws a scale bar of a round length, at most a quarter of the pane's width.
export function drawScaleBar(sheet: Sheet, pane: Pane, placing: Placing, theme: Theme): void {
    const target = Math.min(130, pane.rectangle.width / 4) / placing.scale, power = 10 ** Math.floor(Math.log10(target));
    const length = [5, 2, 1].map((step) => step * power).find((candidate) => candidate <= target) ?? power;
    const x = pane.rectangle.x + 10, y = pane.rectangle.y + pane.rectangle.height - 9, end = x + length * placing.scale;
    sheet.line(x, y, end, y, 1.5, theme.ink);
    sheet.line(x, y - 4, x, y + 4, 1.5, theme.ink);
    sheet.line(end, y - 4, end, y + 4, 1.5, theme.ink);
    sheet.text(end + 7, y + 4, quantity(length, 'm', 1), {size: 11, colour: theme.ink, halo: theme.background});
}

const numberSize = 10; // px, font size
const digitWidth = 6.2;

/// Counts of particles whose numbers are drawn, and of all particles in the pane.
export interface Numbered {
    shown: number;
    all: number; // number of particles in the pane
}

export function drawNumbers(sheet: Sheet, pane: Pane, placing: Placing, view: SpecimenView, frame: Frame, magnification: number, theme: Theme): Numbered {
    const {cells} = view.test, {rectangle} = pane;
    const numbered = {shown: 0, all: 0};
    for (let cell = 0; cell < cells.count; ++cell) {
        if (cells.open[cell] === 1) continue;
        const centre = movedCentre(cells, frame, cell, magnification);
        const x = placing.x + (centre.x - view.origin.x) * placing.scale, y = placing.y - (centre.y - view.origin.y) * placing.scale;
        if (x < 0 || y < 0 || x > rectangle.width || y > rectangle.height) continue;
        numbered.all += 1;
        const number = String(cells.id[cell]), room = sizeOf(view, cell) * placing.scale;
        if (room < digitWidth * number.length + 3) continue;
        numbered.shown += 1;
        sheet.text(rectangle.x + x, rectangle.y + y + 3.5, number, {size: numberSize, colour: theme.ink, align: 'center', halo: theme.background});
    }
    return numbered;
}

/// Draws a note below the particles if there is no room for some of their numbers.
export function drawNumberNote(sheet: Sheet, pane: Pane, {shown, all}: Numbered, theme: Theme): void {
    if (shown === all) return;
    const {x, y, width, height} = pane.rectangle;
    const text = shown === 0 ? 'Zoom in to see the numbers' : `Numbers of ${counted(shown)} of ${counted(all)} particles fit: zoom in to see the others`;
    const style: TextStyle = {size: 11, colour: theme.muted, align: 'right', halo: theme.background};
    const beside = width - 150; // px, room beside the scale bar
    sheet.text(x + width - 9, y + height - (sheet.widthOf(text, style) < beside ? 5 : 22), text, style);
}

/// Width available for a particle's number, m: most of a circle's diameter or of a polygon's width.
function sizeOf(view: SpecimenView, cell: number): number {
    const {cells} = view.test;
    if (cells.radius[cell]! > 0) return 1.8 * cells.radius[cell]!;
    let low = Infinity, high = -Infinity;
    for (let at = cells.firstPoint[cell]!; at < cells.firstPoint[cell + 1]!; ++at) {
        low = Math.min(low, cells.outlineX[at]!);
        high = Math.max(high, cells.outlineX[at]!);
    }
    return 0.8 * (high - low);
}
