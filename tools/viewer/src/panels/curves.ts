// SPDX-License-Identifier: GPL-3.0-or-later
// One panel: stress-strain curves of its tests overlaid, and below, on the same strain axis, a strip for each test with its bond
// breaks per strain interval (stacked by mode, left axis) and the cumulative number of breaks (line, right axis).
// Stresses are shown positive in a test's own sense: compression in compression tests, tension in tension tests.

import {CustomChart, LineChart, ScatterChart} from 'echarts/charts';
import {
    AxisPointerComponent, DataZoomInsideComponent, GridComponent, LegendComponent, TitleComponent, TooltipComponent,
} from 'echarts/components';
import * as echarts from 'echarts/core';
import type {ECharts} from 'echarts/core';
import {SVGRenderer} from 'echarts/renderers';
import type {CustomSeriesRenderItemAPI, CustomSeriesRenderItemParams} from 'echarts/types/dist/shared';

import type {Theme} from '../colours/theme';
import {numberOf, peakOf, type TestData} from '../data/report';
import {Cursor} from '../elements/chart_cursor';
import {element} from '../elements/dom';
import {counted, quantity, scaleFor, significant, strain as strainText, strainFactor, strainUnit, type Scale} from '../quantities/units';
import {countBreaks, intervalWidth, type Histogram} from './break_histogram';
import type {Member, Panel} from './grouping';

echarts.use([
    AxisPointerComponent, CustomChart, DataZoomInsideComponent, GridComponent, LegendComponent, LineChart, ScatterChart,
    SVGRenderer, TitleComponent, TooltipComponent,
]);

const solidIcon = 'path://M0,0L22,0L22,3L0,3Z';
const dashedIcon = 'path://M0,0L9,0L9,3L0,3ZM13,0L22,0L22,3L13,3Z';

// Sizes in CSS pixels.
const left = 66, right = 58, top = 44;
const stressHeight = 300, stripHeight = 58, stripGap = 30, bottom = 46;
const fontFamily = 'system-ui, "Segoe UI", "Helvetica Neue", Arial, "Liberation Sans", sans-serif';

export function panelHeight(memberCount: number): number {
    return top + stressHeight + memberCount * (stripHeight + stripGap) + bottom;
}

function largest(values: ArrayLike<number>): number {
    let found = 0;
    for (let index = 0; index < values.length; ++index) {
        const value = values[index]!;
        if (value > found) found = value;
    }
    return found;
}

/// Value of a curve's column at a strain, linear between rows; undefined outside the test.
function valueAt(strains: ArrayLike<number>, values: ArrayLike<number>, at: number): number | undefined {
    const count = strains.length;
    if (count === 0 || at < strains[0]! || at > strains[count - 1]!) return undefined;
    let low = 0, high = count - 1;
    while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (strains[middle]! <= at) low = middle;
        else high = middle;
    }
    const width = strains[high]! - strains[low]!;
    const share = width > 0 ? (at - strains[low]!) / width : 0;
    return values[low]! + share * (values[high]! - values[low]!);
}

function pairs(x: ArrayLike<number>, y: ArrayLike<number>, xFactor: number, yFactor: number): [number, number][] {
    return Array.from({length: x.length}, (_, index) => [x[index]! / xFactor, y[index]! / yFactor]);
}

/// A round number at or above the value, for the end of an axis with one interval.
function roundUp(value: number): number {
    if (value <= 1) return 1;
    const power = 10 ** Math.floor(Math.log10(value));
    return [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10].map((step) => step * power)
        .find((step) => step >= value && Number.isInteger(step)) ?? Math.ceil(value);
}

function drawBars(histogram: Histogram, theme: Theme) {
    return (_: CustomSeriesRenderItemParams, api: CustomSeriesRenderItemAPI) => {
        const [from, to, tension, shear] = [0, 1, 2, 3].map((dimension) => Number(api.value(dimension))) as [number, number, number, number];
        const rectangle = (low: number, high: number, fill: string) => {
            const [x1, y1] = api.coord([from, high]) as [number, number];
            const [x2, y2] = api.coord([to, low]) as [number, number];
            const gap = Math.min(1, (x2 - x1) * 0.15);
            return {type: 'rect' as const, shape: {x: x1 + gap / 2, y: y1, width: Math.max(0.5, x2 - x1 - gap), height: y2 - y1}, style: {fill}};
        };
        const children = [rectangle(0, tension, theme.tension), rectangle(tension, tension + shear, theme.shear)]
            .filter((bar) => bar.shape.height > 0);
        return histogram.most > 0 && children.length > 0 ? {type: 'group' as const, children} : undefined;
    };
}

interface Prepared {
    member: Member;
    histogram: Histogram;
}

function tooltip(at: number, prepared: Prepared[], theme: Theme): HTMLElement {
    const rows = prepared.map(({member, histogram}) => {
        const {curve} = member.test;
        const stress = valueAt(curve.strain, curve.stress, at);
        const broken = valueAt(curve.strain, curve.bondsBroken, at);
        const interval = Math.max(0, Math.ceil(at / histogram.width - 1e-9) - 1);
        const inInterval = stress === undefined ? undefined
            : (histogram.tension[interval] ?? 0) + (histogram.shear[interval] ?? 0);
        return element('tr', {},
            element('th', {}, element('i', {style: `background:${theme.series[member.colour % theme.series.length]}`}), member.shortLabel),
            element('td', {}, stress === undefined ? 'ended' : quantity(stress, 'N/m')),
            element('td', {}, counted(inInterval)),
            element('td', {}, counted(broken === undefined ? undefined : Math.floor(broken))));
    });
    return element('div', {class: 'cursor'},
        element('div', {}, `strain ${strainText(at)}`),
        element('table', {},
            element('tr', {}, element('td'), element('td', {}, 'stress'), element('td', {}, 'breaks here'), element('td', {}, 'so far')),
            ...rows));
}

function peakLabel(test: TestData, stress: number): string {
    const thickness = numberOf(test.summary, 'out_of_plane_thickness');
    return quantity(stress, 'N/m') + (thickness === undefined ? '' : `, ${quantity(stress / thickness, 'Pa')}`) + (test.failed ? '' : ', peak so far');
}

function stressSeries(member: Member, range: number, scale: Scale, theme: Theme) {
    const colour = theme.series[member.colour % theme.series.length]!;
    const peak = peakOf(member.test);
    const curve = {
        type: 'line', name: member.shortLabel, id: `curve ${member.label}`, xAxisIndex: 0, yAxisIndex: 0, showSymbol: false,
        data: pairs(member.test.curve.strain, member.test.curve.stress, strainFactor, scale.factor),
        lineStyle: {width: 1.6, color: colour, type: member.dashed ? [6, 3] : 'solid'}, itemStyle: {color: colour},
        emphasis: {disabled: true}, animation: false, z: 3,
    };
    if (peak.strain === undefined || peak.stress === undefined) return [curve];
    return [curve, {
        type: 'scatter', name: member.shortLabel, id: `peak ${member.label}`, xAxisIndex: 0, yAxisIndex: 0,
        data: [[peak.strain / strainFactor, peak.stress / scale.factor]],
        symbol: member.test.failed ? 'circle' : 'diamond', symbolSize: member.test.failed ? 7 : 10,
        itemStyle: {color: member.test.failed ? colour : theme.background, borderColor: colour, borderWidth: 1.5, opacity: 1},
        label: {
            show: true, position: peak.strain > 0.85 * range ? 'left' : 'top', distance: 6, formatter: peakLabel(member.test, peak.stress), color: colour,
            fontFamily, fontSize: 11.5, textBorderColor: theme.background, textBorderWidth: 3,
        },
        labelLayout: {moveOverlap: 'shiftY'},
        tooltip: {show: false}, emphasis: {disabled: true}, animation: false, z: 5,
    }];
}

function stripSeries({member, histogram}: Prepared, strip: number, theme: Theme) {
    const colour = theme.series[member.colour % theme.series.length]!;
    const bars = histogram.tension.map((tension, interval) => [
        (interval * histogram.width) / strainFactor, ((interval + 1) * histogram.width) / strainFactor, tension, histogram.shear[interval]!,
    ]).filter((bar) => bar[2]! + bar[3]! > 0);
    return [
        {
            type: 'custom', name: member.shortLabel, id: `breaks ${member.label}`, xAxisIndex: strip, yAxisIndex: 2 * strip - 1,
            renderItem: drawBars(histogram, theme), encode: {x: [0, 1], y: [2, 3]}, data: bars, clip: true, animation: false, silent: true, z: 2,
        },
        {
            type: 'line', name: member.shortLabel, id: `so far ${member.label}`, xAxisIndex: strip, yAxisIndex: 2 * strip, showSymbol: false,
            data: pairs(member.test.curve.strain, member.test.curve.bondsBroken, strainFactor, 1), step: 'end',
            lineStyle: {width: 1.3, color: colour, type: member.dashed ? [6, 3] : 'solid'}, itemStyle: {color: colour}, animation: false, z: 3,
            emphasis: {disabled: true},
        },
    ];
}

/// Everything that ECharts needs for one panel.
export function panelOption(panel: Panel, theme: Theme) {
    const {members} = panel;
    const range = Math.max(...members.map((member) => largest(member.test.curve.strain)), 1e-9);
    const width = intervalWidth(range);
    const prepared: Prepared[] = members.map((member) => ({member, histogram: countBreaks(member.test.events, width, range)}));
    const scale = scaleFor(members.map((member) => largest(member.test.curve.stress)), 'N/m');

    const text = {color: theme.ink, fontFamily, fontSize: 12};
    const small = {...text, fontSize: 11, color: theme.muted};
    const axisLine = {show: true, onZero: false, lineStyle: {color: theme.ink, width: 1}};
    const axisTick = {show: true, inside: true, length: 5, lineStyle: {color: theme.ink, width: 1}};
    const stripTop = (strip: number) => top + stressHeight + stripGap + (strip - 1) * (stripHeight + stripGap);
    const last = members.length;

    const xAxis = Array.from({length: last + 1}, (_, index) => ({
        type: 'value', gridIndex: index, min: 0, max: range / strainFactor, axisLine, axisTick, splitLine: {show: index === 0, lineStyle: {color: theme.grid}},
        axisLabel: {...text, show: index === last, hideOverlap: true, showMaxLabel: false, formatter: (value: number) => significant(value, 6).replace(/\.?0+$/, '') || '0'},
        ...(index === last ? {name: `Axial strain [${strainUnit}]`, nameLocation: 'middle', nameGap: 28, nameTextStyle: {...text, fontSize: 13}} : {}),
        axisPointer: {show: true, type: 'line', snap: false, label: {show: false}, lineStyle: {color: theme.muted, type: 'solid', width: 1}},
    }));
    const yAxis: object[] = [{
        type: 'value', gridIndex: 0, axisLine, axisTick, splitLine: {lineStyle: {color: theme.grid}}, axisLabel: text, splitNumber: 6, boundaryGap: [0, '7%'],
        name: `Axial stress [${scale.unit}]`, nameLocation: 'middle', nameGap: 44, nameTextStyle: {...text, fontSize: 13},
        axisPointer: {show: false},
    }];
    prepared.forEach(({member, histogram}, index) => {
        const most = roundUp(histogram.most), total = roundUp(largest(member.test.curve.bondsBroken));
        const strip = {type: 'value', gridIndex: index + 1, min: 0, splitLine: {show: false}, axisLine, axisTick, axisPointer: {show: false}};
        yAxis.push({...strip, max: most, interval: most, axisLabel: small, position: 'left'});
        yAxis.push({...strip, max: total, interval: total, axisLabel: small, position: 'right'});
    });

    const titles = prepared.map(({member}, index) => ({
        text: `{name|${member.shortLabel}}  {what|${counted(member.test.events.count)} breaks}`,
        left: left + 4, top: stripTop(index + 1) - 19, padding: 0,
        textStyle: {rich: {
            name: {...text, fontSize: 11.5, fontWeight: 600, color: theme.series[member.colour % theme.series.length]},
            what: small,
        }},
    }));

    return {
        animation: false,
        backgroundColor: theme.background,
        textStyle: text,
        title: [
            {text: panel.title, left, top: 8, padding: 0, textStyle: {...text, fontSize: 15, fontWeight: 600}},
            ...titles,
            {
                text: `bars: per ${strainText(width, 1)} of strain, line: so far`,
                right, top: stripTop(1) - 19, padding: 0, textAlign: 'auto', textStyle: {...small, fontWeight: 400},
            },
        ],
        legend: {
            right, top: 6, itemWidth: 22, itemHeight: 8, itemGap: 14, padding: 0, textStyle: text,
            data: members.map((member) => ({name: member.shortLabel, icon: member.dashed ? dashedIcon : solidIcon,
                itemStyle: {color: theme.series[member.colour % theme.series.length]}})),
            inactiveColor: theme.grid,
        },
        grid: Array.from({length: last + 1}, (_, index) => (index === 0
            ? {left, right, top, height: stressHeight}
            : {left, right, top: stripTop(index), height: stripHeight})),
        xAxis,
        yAxis,
        axisPointer: {link: [{xAxisIndex: 'all'}]},
        tooltip: {
            trigger: 'axis', confine: true, transitionDuration: 0, backgroundColor: theme.background, borderColor: theme.grid, padding: 8,
            textStyle: text,
            formatter: (params: unknown) => {
                const first = (Array.isArray(params) ? params[0] : params) as {axisValue?: number} | undefined;
                return tooltip(Number(first?.axisValue ?? 0) * strainFactor, prepared, theme);
            },
        },
        dataZoom: [{type: 'inside', xAxisIndex: 'all', filterMode: 'none', zoomOnMouseWheel: 'shift', moveOnMouseMove: true}],
        series: [
            ...members.flatMap((member) => stressSeries(member, range, scale, theme)),
            ...prepared.flatMap((one, index) => stripSeries(one, index + 1, theme)),
        ],
    };
}

export function drawPanel(container: HTMLElement, panel: Panel, theme: Theme): ECharts {
    container.style.height = `${panelHeight(panel.members.length)}px`;
    const chart = echarts.init(container, null, {renderer: 'svg'});
    chart.setOption(panelOption(panel, theme));
    chart.getZr().on('dblclick', () => chart.dispatchAction({type: 'dataZoom', start: 0, end: 100}));
    return chart;
}

/// The cursor that the panel shares with the specimens, from the top of the curves to the foot of the lowest strip.
export function panelCursor(chart: ECharts, onClick: (strain: number) => void): Cursor {
    return new Cursor(chart, top, bottom, onClick);
}

/// The panel as SVG text, for a file.
export function panelAsSvg(chart: ECharts): string {
    const address = chart.getDataURL({type: 'svg'});
    return decodeURIComponent(address.slice(address.indexOf(',') + 1));
}
