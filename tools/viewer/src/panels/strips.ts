// SPDX-License-Identifier: GPL-3.0-or-later
// Strips below the curves of a panel: one strip per test for its breaks and, if it had slips, one for these. Bars are counts in
// intervals of strain (left axis), stacked by mode; the line is the running total (right axis).

import type {CustomSeriesRenderItemAPI, CustomSeriesRenderItemParams} from 'echarts/types/dist/shared';

import type {Theme} from '../colours/theme';
import {hasSlips, largestOf, type BondEvents} from '../data/report';
import {strainFactor} from '../quantities/units';
import {countBreaks, countIn, countSlips, type Histogram} from './event_histogram';
import type {Member} from './grouping';

export type StripKind = 'breaks' | 'slips';

export interface Strip {
    kind: StripKind;
    member: Member;
    count: number; // number of all events
    histogram: Histogram;
    soFar: {strain: ArrayLike<number>; count: ArrayLike<number>};
}

/// Fill colours of the histogram's parts, from the bottom up.
const fills: Record<StripKind, (theme: Theme) => string[]> = {
    breaks: ({tension, shear}) => [tension, shear],
    slips: ({slid}) => [slid],
};

/// Running total of slips: at the start, after each slip, and at the end of the curve.
function slipsSoFar({count, strain}: BondEvents, end: number): Strip['soFar'] {
    const strains = [0, ...strain];
    return {strain: [...strains, Math.max(end, strains[count]!)], count: Array.from({length: count + 2}, (_, at) => Math.min(at, count))};
}

export function stripsOf(members: readonly Member[], width: number, range: number): Strip[] {
    return members.flatMap((member): Strip[] => {
        const {test} = member, {curve, events} = test;
        const breaks: Strip = {kind: 'breaks', member, count: events.count, histogram: countBreaks(events, width, range), soFar: {strain: curve.strain, count: curve.bondsBroken}};
        if (!hasSlips(test)) return [breaks];
        return [breaks, {kind: 'slips', member, count: test.slips.count, histogram: countSlips(test.slips, width, range), soFar: slipsSoFar(test.slips, largestOf(curve.strain))}];
    });
}

export function pairs(x: ArrayLike<number>, y: ArrayLike<number>, xFactor: number, yFactor: number): [number, number][] {
    return Array.from({length: x.length}, (_, index) => [x[index]! / xFactor, y[index]! / yFactor]);
}

function drawBars(parts: number, colours: readonly string[]) {
    return (_: CustomSeriesRenderItemParams, api: CustomSeriesRenderItemAPI) => {
        const from = Number(api.value(0)), to = Number(api.value(1));
        const rectangle = (low: number, high: number, fill: string) => {
            const [x1, y1] = api.coord([from, high]) as [number, number];
            const [x2, y2] = api.coord([to, low]) as [number, number];
            const gap = Math.min(1, (x2 - x1) * 0.15);
            return {type: 'rect' as const, shape: {x: x1 + gap / 2, y: y1, width: Math.max(0.5, x2 - x1 - gap), height: y2 - y1}, style: {fill}};
        };
        let low = 0;
        const children = Array.from({length: parts}, (__, part) => {
            const high = low + Number(api.value(2 + part)), bar = rectangle(low, high, colours[part]!);
            low = high;
            return bar;
        }).filter((bar) => bar.shape.height > 0);
        return children.length > 0 ? {type: 'group' as const, children} : undefined;
    };
}

/// Chart series for the bars and the line of a strip. @param grid  index of the strip's grid in the panel
export function stripSeries({kind, member, histogram, soFar}: Strip, grid: number, theme: Theme) {
    const colour = theme.series[member.colour % theme.series.length]!, {parts, width} = histogram;
    const line = {
        type: 'line', name: member.shortLabel, xAxisIndex: grid, yAxisIndex: 2 * grid, showSymbol: false,
        data: pairs(soFar.strain, soFar.count, strainFactor, 1), step: 'end', animation: false, emphasis: {disabled: true},
    };
    // The line's colour may be close to that of the bars for slips, so it has an edge in the background colour.
    const edge = kind === 'slips' ? [{...line, id: `edge of ${kind} so far ${member.label}`, lineStyle: {width: 4, color: theme.background}, z: 2}] : [];
    const bars = parts[0]!.flatMap((_, interval) => (countIn(histogram, interval) === 0 ? []
        : [[interval * width / strainFactor, (interval + 1) * width / strainFactor, ...parts.map((counts) => counts[interval]!)]]));
    return [
        {
            type: 'custom', name: member.shortLabel, id: `${kind} ${member.label}`, xAxisIndex: grid, yAxisIndex: 2 * grid - 1,
            renderItem: drawBars(parts.length, fills[kind](theme)), encode: {x: [0, 1], y: parts.map((__, part) => 2 + part)}, data: bars, clip: true, animation: false, silent: true, z: 2,
        },
        ...edge,
        {
            ...line, id: `${kind} so far ${member.label}`, itemStyle: {color: colour}, z: 3,
            lineStyle: {width: 1.3, color: colour, type: member.dashed ? [6, 3] : 'solid'},
        },
    ];
}
