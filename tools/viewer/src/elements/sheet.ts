// SPDX-License-Identifier: GPL-3.0-or-later
// A surface for titles, legends and numbers: one interface for a canvas and an SVG element. Lengths are in CSS pixels.

import {svgElement} from './dom';

export const fontFamily = 'system-ui, "Segoe UI", "Helvetica Neue", Arial, "Liberation Sans", sans-serif';

export interface TextStyle {
    size: number;
    colour: string;
    bold?: boolean;
    align?: 'left' | 'center' | 'right';
    halo?: string; // colour around the letters
}

export interface Rectangle { // CSS pixels from the picture's upper left corner
    x: number;
    y: number;
    width: number;
    height: number;
}

export interface Sheet {
    text(x: number, y: number, text: string, style: TextStyle): void;
    line(x1: number, y1: number, x2: number, y2: number, width: number, colour: string): void;
    rectangle(x: number, y: number, width: number, height: number, colour: string): void;
    /// Approximate width of a text, since fonts differ.
    widthOf(text: string, style: TextStyle): number;
}

const font = (style: TextStyle): string => `${style.bold ? 600 : 400} ${style.size}px ${fontFamily}`;

export class CanvasSheet implements Sheet {
    constructor(private readonly context: CanvasRenderingContext2D) {}

    text(x: number, y: number, text: string, style: TextStyle): void {
        const {context} = this;
        context.font = font(style);
        context.textAlign = style.align ?? 'left';
        if (style.halo) {
            context.strokeStyle = style.halo;
            context.lineWidth = 2.5;
            context.lineJoin = 'round';
            context.strokeText(text, x, y);
        }
        context.fillStyle = style.colour;
        context.fillText(text, x, y);
    }

    line(x1: number, y1: number, x2: number, y2: number, width: number, colour: string): void {
        const {context} = this;
        context.strokeStyle = colour;
        context.lineWidth = width;
        context.beginPath();
        context.moveTo(x1, y1);
        context.lineTo(x2, y2);
        context.stroke();
    }

    rectangle(x: number, y: number, width: number, height: number, colour: string): void {
        this.context.fillStyle = colour;
        this.context.fillRect(x, y, width, height);
    }

    widthOf(text: string, style: TextStyle): number {
        this.context.font = font(style);
        return this.context.measureText(text).width;
    }
}

export class SvgSheet implements Sheet {
    private readonly ruler = new OffscreenCanvas(1, 1).getContext('2d')!;

    constructor(private readonly svg: SVGElement) {}

    text(x: number, y: number, text: string, style: TextStyle): void {
        this.svg.append(svgElement('text', {
            x: x.toFixed(1), y: y.toFixed(1), fill: style.colour, 'font-size': style.size, 'font-family': fontFamily, 'font-weight': style.bold ? 600 : 400,
            'text-anchor': {left: 'start', center: 'middle', right: 'end'}[style.align ?? 'left'],
            ...(style.halo ? {stroke: style.halo, 'stroke-width': 2.5, 'stroke-linejoin': 'round', 'paint-order': 'stroke'} : {}),
        }, text));
    }

    line(x1: number, y1: number, x2: number, y2: number, width: number, colour: string): void {
        this.svg.append(svgElement('path', {d: `M${x1.toFixed(1)} ${y1.toFixed(1)}L${x2.toFixed(1)} ${y2.toFixed(1)}`, stroke: colour, 'stroke-width': width.toFixed(2)}));
    }

    rectangle(x: number, y: number, width: number, height: number, colour: string): void {
        this.svg.append(svgElement('rect', {x: x.toFixed(1), y: y.toFixed(1), width: width.toFixed(2), height: height.toFixed(2), fill: colour, 'shape-rendering': 'crispEdges'}));
    }

    widthOf(text: string, style: TextStyle): number {
        this.ruler.font = font(style);
        return this.ruler.measureText(text).width;
    }
}
