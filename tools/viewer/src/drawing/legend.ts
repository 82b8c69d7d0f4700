// SPDX-License-Identifier: GPL-3.0-or-later
// The legend under the picture: the meaning of its colours and line widths.

import type {Colouring} from '../colours/colouring';
import {css, paletteSize, type Rgb} from '../colours/palettes';
import type {Theme} from '../colours/theme';
import type {Sheet, TextStyle} from '../elements/sheet';
import type {ForceScale} from '../quantities/ranges';
import {ofStress, quantity, scaleFor, significant, thinSpace, titledInFull} from '../quantities/units';
import {smallestForceShown} from './drawn_lines';
import type {Layer} from './settings';
import type {Look} from './specimen_view';

export const legendHeight = 44; // px
const barWidth = 190, barHeight = 9, gap = 24;

export function drawLegend(sheet: Sheet, look: Look, left: number, top: number): void {
    const {settings, colouring, theme, offered} = look;
    const shown = (layer: Layer) => settings.layers[layer] && offered.has(layer);
    let x = left;
    if (shown('particles') && colouring.quantity.key !== 'none') x += drawColours(sheet, colouring, theme, x, top) + gap;
    if (shown('cracks')) {
        const {by, listed, unlisted, palette, lastTime} = look.crackColours;
        if (listed) {
            x += (by === 'mode' ? drawMarks(sheet, 'Broken in', [['tension', theme.tension, 2.5], ['shear', theme.shear, 2.5]], theme, x, top)
                : drawBar(sheet, 'Time of first break', palette, '0', quantity(lastTime, 's'), theme, x, top)) + gap;
        }
        if (unlisted) x += drawMarks(sheet, 'Bonds', [['broken', theme.picked, 2.5]], theme, x, top) + gap;
    }
    if (shown('bonds')) x += drawMarks(sheet, 'Bonds', [['intact', theme.bond, 1.5], ['slid', theme.slid, 1.5]], theme, x, top) + gap;
    if (shown('forces')) {
        const {end, stress} = look.forceScale;
        if (stress.end > 0) x += drawMarks(sheet, stressTitle(stress), [['compression', theme.compressive, 5], ['tension', theme.tensile, 5]], theme, x, top) + gap;
        if (end > 0 || stress.end === 0) drawMarks(sheet, forceTitle(look.forceScale), [['compression', theme.compressive, 5], ['tension', theme.tensile, 5]], theme, x, top);
    }
}

function forceTitle({end, largest}: ForceScale): string {
    if (end === 0) return 'Contact force: none';
    return `Contact force, widest ${largest > end ? `≥${thinSpace}` : ''}${quantity(end, 'N', 2)}, none drawn below ${quantity(smallestForceShown * end, 'N', 2)}`;
}

function stressTitle({end}: ForceScale['stress']): string {
    return `Stress of faces, ½ particle: ${quantity(end, ofStress, 2)}`;
}

const small = (theme: Theme): TextStyle => ({size: 11, colour: theme.ink});

function drawMarks(sheet: Sheet, title: string, marks: readonly [string, string, number][], theme: Theme, x: number, top: number): number {
    sheet.text(x, top + 12, title, {...small(theme), colour: theme.muted});
    let at = x;
    for (const [name, colour, width] of marks) {
        sheet.line(at, top + 26, at + 20, top + 26, Math.min(10, width), colour);
        sheet.text(at + 25, top + 30, name, small(theme));
        at += 25 + sheet.widthOf(name, small(theme)) + 14;
    }
    return Math.max(at - 14 - x, sheet.widthOf(title, small(theme)));
}

function drawBar(sheet: Sheet, title: string, palette: readonly Rgb[], low: string, high: string, theme: Theme, x: number, top: number, middle = ''): number {
    sheet.text(x, top + 12, title, {...small(theme), colour: theme.muted});
    const steps = 64; // fewer rectangles than colours make smaller files without a visible difference
    for (let step = 0; step < steps; ++step) {
        const colour = palette[Math.round(step / (steps - 1) * (paletteSize - 1))]!;
        sheet.rectangle(x + step * barWidth / steps, top + 17, barWidth / steps + 0.4, barHeight, css(colour));
    }
    sheet.text(x, top + 38, low, small(theme));
    sheet.text(x + barWidth, top + 38, high, {...small(theme), align: 'right'});
    if (middle) sheet.text(x + barWidth / 2, top + 38, middle, {...small(theme), align: 'center'});
    return barWidth;
}

function drawColours(sheet: Sheet, {quantity: shown, range, palette, names}: Colouring, theme: Theme, x: number, top: number): number {
    if (shown.scaling === 'categorical') {
        sheet.text(x, top + 12, shown.key === 'fragment' ? 'Fragment, largest first' : shown.name, {...small(theme), colour: theme.muted});
        let at = x;
        const last = names.length > 0 ? names.length - 1 : range.high; // named minerals leave out the platens' material
        for (let number = 0; number <= Math.min(5, last); ++number) {
            const text = number === 5 && last > 5 ? '…' : names[number] ?? String(number + 1);
            sheet.rectangle(at, top + 19, 13, 13, css(palette[number]!));
            sheet.text(at + 17, top + 30, text, small(theme));
            at += Math.max(34, 17 + sheet.widthOf(text, small(theme)) + 14);
        }
        return at - x;
    }
    const scale = scaleFor([range.low, range.high], shown.unit);
    const end = (value: number) => significant(value / scale.factor);
    const diverging = shown.scaling === 'diverging';
    const name = shown.key.startsWith('stress') && diverging ? `${shown.name}, compression positive` : shown.name;
    const title = titledInFull(name, scale);
    return Math.max(barWidth, drawBar(sheet, title, palette,
        diverging ? `${range.least < range.low ? `≤${thinSpace}` : ''}${end(range.low)}` : '0', `${range.most > range.high ? `≥${thinSpace}` : ''}${end(range.high)}`,
        theme, x, top, diverging ? '0' : end(range.high / 2)), sheet.widthOf(title, small(theme)));
}
