// SPDX-License-Identifier: GPL-3.0-or-later
// The cursor on a chart, which several charts share: thin lines at values of the horizontal axis, moved without redrawing the
// chart. A click on the chart reports the value at that point.

import type {ECharts} from 'echarts/core';

import {element} from './dom';

export interface Mark {
    value: number; // value in the axis's own unit
    colour: string;
}

export class Cursor {
    private readonly lines: HTMLElement[] = [];

    constructor(private readonly chart: ECharts, private top: number, private readonly bottom: number, onClick: (value: number) => void) {
        chart.getZr().on('click', ({offsetX, offsetY}) => {
            if (!chart.containPixel({gridIndex: 0}, [offsetX, offsetY])) return; // a click on a legend or an axis
            const [value] = chart.convertFromPixel({gridIndex: 0}, [offsetX, offsetY]) as [number, number];
            if (Number.isFinite(value)) onClick(value);
        });
    }

    /// Call this after a change of the chart's layout.
    moveTo(top: number): void {
        this.top = top;
        for (const line of this.lines) line.style.top = `${top}px`;
    }

    show(marks: readonly Mark[]): void {
        while (this.lines.length < marks.length) {
            const line = element('div', {class: 'cursor-line', style: `top:${this.top}px;bottom:${this.bottom}px`});
            this.lines.push(line);
            this.chart.getDom().append(line);
        }
        this.lines.forEach((line, at) => {
            const mark = marks[at], x = mark && (this.chart.convertToPixel({xAxisIndex: 0}, mark.value) as number);
            // In a zoomed chart, values may lie outside its grid.
            line.hidden = x === undefined || !Number.isFinite(x) || !this.chart.containPixel({gridIndex: 0}, [x, this.top + 1]);
            if (mark && x !== undefined) {
                line.style.left = `${x}px`;
                line.style.background = mark.colour;
            }
        });
    }
}
