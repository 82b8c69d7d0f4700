// SPDX-License-Identifier: GPL-3.0-or-later
// One panel: overlaid stress-strain curves of its tests, and below them, on the same strain axis, strips of breaks and slips
// (strips.ts). Stresses are positive in a test's loading direction: in compression for compression tests, in tension for
// tension tests.

import {CustomChart, LineChart, ScatterChart} from 'echarts/charts';
import {
    AxisPointerComponent, DataZoomInsideComponent, GridComponent, LegendComponent, TitleComponent, TooltipComponent,
} from 'echarts/components';
import * as echarts from 'echarts/core';
import type {ECharts} from 'echarts/core';
import {SVGRenderer} from 'echarts/renderers';

import type {Theme} from '../colours/theme';
import {inArea, largestOf, numberOf, peakOf, stressUnitOf, type Curve, type MeasuredCurve, type TestData} from '../data/report';
import {unique} from '../data/test_labels';
import {Cursor} from '../elements/chart_cursor';
import {element} from '../elements/dom';
import {fontFamily} from '../elements/sheet';
import {counted, ofStress, quantity, scaleFor, significant, strain as strainText, strainFactor, strainUnit, stressText, titled, type Scale} from '../quantities/units';
import {countIn, intervalOf, intervalWidth} from './event_histogram';
import type {Member, Panel} from './grouping';
import {pairs, stripSeries, stripsOf, type Strip, type StripKind} from './strips';

echarts.use([
    AxisPointerComponent, CustomChart, DataZoomInsideComponent, GridComponent, LegendComponent, LineChart, ScatterChart,
    SVGRenderer, TitleComponent, TooltipComponent,
]);

const solidIcon = 'path://M0,0L22,0L22,3L0,3Z';
const dashedIcon = 'path://M0,0L9,0L9,3L0,3ZM13,0L22,0L22,3L13,3Z';

// Sizes in CSS pixels.
const left = 66, right = 58, titleLine = 36, legendLine = 22;
const stressHeight = 300, stripHeight = 58, stripGap = 30, bottom = 66;
const leastStressHeight = 150, noteSize = 11;

/// Positions of the parts of a panel. A legend that does not fit beside the title is placed below it, on one or more lines.
export interface PanelLayout {
    top: number; // top of the curves
    legendTop: number;
    legendWidth: number;
    stressHeight: number;
    height: number; // height of the panel
    note: {text: string; left: number};
}

const ruler = new OffscreenCanvas(1, 1).getContext('2d')!;

function textWidth(text: string, size: number): number {
    ruler.font = `600 ${size}px ${fontFamily}`;
    return ruler.measureText(text).width;
}

/// @param height  requested height of the panel, px; by default, the curves have their usual height
export function layoutOf({title, members, measured}: Panel, width: number, height?: number): PanelLayout {
    const labels = [...members.map(({shortLabel}) => shortLabel), ...(measured ? [measured.label] : [])];
    const entries = labels.map((label) => textWidth(label, 12) + 22 + 5 + 14);
    const legend = entries.reduce((sum, entry) => sum + entry, 0), beside = width - left - right - textWidth(title, 15) - 16;
    const room = Math.max(60, width - left - right);
    let lines = 0;
    if (legend > beside) {
        lines = 1;
        for (let at = 0, x = 0; at < entries.length; ++at) {
            if (x > 0 && x + entries[at]! > room) [x, lines] = [0, lines + 1];
            x += entries[at]!;
        }
    }
    const {strips, width: interval} = prepare({title, members, measured});
    const note = `bars: ${kindsOf(strips).join(' or ')} in each ${strainText(interval, 1)} of strain, line: so far`;
    const top = titleLine + 8 + lines * legendLine, below = strips.length * (stripHeight + stripGap) + bottom;
    const stress = height === undefined ? stressHeight : Math.max(leastStressHeight, height - top - below);
    return {top, legendTop: lines === 0 ? 6 : titleLine - 6, legendWidth: lines === 0 ? legend + 16 : room, stressHeight: stress, height: top + stress + below,
        note: {text: note, left: Math.max(2, Math.min(left, width - textWidth(note, noteSize) - 4))}};
}

/// Value of a curve's column at a strain, interpolated linearly between rows; undefined outside the range of the test.
export function valueAt(strains: ArrayLike<number>, values: ArrayLike<number>, at: number): number | undefined {
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

/// A round number at or above the value, for the end of an axis with one interval.
function roundUp(value: number): number {
    if (value <= 1) return 1;
    const power = 10 ** Math.floor(Math.log10(value));
    return [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10].map((step) => step * power)
        .find((step) => step >= value && Number.isInteger(step)) ?? Math.ceil(value);
}

export const tickText = (value: number): string => (Number.isInteger(value) ? counted(value) : String(value).replace('-', '−'));

/// The kinds of strips that a panel has.
function kindsOf(strips: readonly Strip[]): StripKind[] {
    return unique(strips.map(({kind}) => kind));
}

/// The curves' values at a strain.
function valuesAt(at: number, {members}: Panel, strips: readonly Strip[], theme: Theme): HTMLElement {
    const kinds = kindsOf(strips);
    const rows = members.map((member) => {
        const {curve} = member.test;
        const stress = valueAt(curve.strain, curve.stress, at);
        const counts = kinds.flatMap((kind) => {
            const strip = strips.find((one) => one.member === member && one.kind === kind);
            if (stress === undefined || !strip) return [undefined, undefined];
            const soFar = valueAt(strip.soFar.strain, strip.soFar.count, at);
            return [countIn(strip.histogram, intervalOf(at, strip.histogram.width)), soFar === undefined ? undefined : Math.floor(soFar)];
        });
        return element('tr', {},
            element('th', {}, element('i', {style: `background:${theme.series[member.colour % theme.series.length]}`}), member.shortLabel),
            element('td', {}, stress === undefined ? 'ended' : stressText(stress, peakOf(member.test).stress)),
            ...counts.map((count) => element('td', {}, counted(count))));
    });
    return element('div', {},
        element('div', {}, `strain ${strainText(at)}`),
        element('table', {},
            element('tr', {}, ...['', 'stress', ...kinds.flatMap((kind) => [`${kind} here`, 'so far'])].map((head) => element('td', {}, head))),
            ...rows));
}

function peakLabel(test: TestData, stress: number): string {
    const thickness = numberOf(test.summary, 'out_of_plane_thickness');
    return quantity(stress, stressUnitOf(test)) + (thickness === undefined || inArea(test) ? '' : `, ${quantity(stress / thickness, 'Pa')}`) + (test.failed ? '' : ', peak so far');
}

/// First point at which a curve reaches a stress.
function firstReached({strain, stress}: Curve, level: number): [number, number] | undefined {
    for (let k = 0; k < stress.length; ++k) if (stress[k]! >= level) return [strain[k]!, stress[k]!];
    return undefined;
}

/// Crack initiation and damage on the curve.
function crackMarks(member: Member, scale: Scale, theme: Theme) {
    const {test} = member, colour = theme.series[member.colour % theme.series.length]!;
    const marks = [['crack_initiation_stress', 'σci'], ['crack_damage_stress', 'σcd']].flatMap(([key, label]) => {
        const level = numberOf(test.summary, key!), place = level === undefined ? undefined : firstReached(test.curve, level);
        return place ? [{value: [place[0] / strainFactor, place[1] / scale.factor], label: {formatter: label}}] : [];
    });
    if (marks.length === 0) return [];
    return [{
        type: 'scatter', name: member.shortLabel, id: `cracks ${member.label}`, xAxisIndex: 0, yAxisIndex: 0, data: marks,
        symbol: 'triangle', symbolSize: 8, itemStyle: {color: theme.background, borderColor: colour, borderWidth: 1.5, opacity: 1},
        label: {show: true, position: 'left', distance: 5, color: colour, fontFamily, fontSize: 11.5, textBorderColor: theme.background, textBorderWidth: 3},
        labelLayout: {hideOverlap: true},
        tooltip: {show: false}, emphasis: {disabled: true}, animation: false, z: 4,
    }];
}

function measuredSeries({label, strain, stress}: MeasuredCurve, scale: Scale, theme: Theme) {
    return {
        type: 'line', name: label, id: 'measured', xAxisIndex: 0, yAxisIndex: 0, showSymbol: false,
        data: pairs(strain, stress, strainFactor, scale.factor),
        lineStyle: {width: 1.6, color: theme.ink, type: [6, 3]}, itemStyle: {color: theme.ink}, emphasis: {disabled: true}, animation: false, z: 4,
    };
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
    return [curve, ...crackMarks(member, scale, theme), {
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

function prepare({members, measured}: Panel): {range: number; width: number; strips: Strip[]} {
    const curves = [...members.map((member) => member.test.curve), ...(measured ? [measured] : [])];
    const range = Math.max(...curves.map(({strain}) => largestOf(strain)), 1e-9), width = intervalWidth(range);
    return {range, width, strips: stripsOf(members, width, range)};
}

/// Everything that ECharts needs for one panel.
export function panelOption(panel: Panel, {top, legendTop, legendWidth, stressHeight: high, note}: PanelLayout, theme: Theme) {
    const {members, measured} = panel, {range, strips} = prepare(panel);
    const scale = scaleFor([...members.map((member) => largestOf(member.test.curve.stress)), ...(measured ? [largestOf(measured.stress)] : [])], ofStress);

    const text = {color: theme.ink, fontFamily, fontSize: 12};
    const small = {...text, fontSize: 11, color: theme.muted};
    const axisLine = {show: true, onZero: false, lineStyle: {color: theme.ink, width: 1}};
    const axisTick = {show: true, inside: true, length: 5, lineStyle: {color: theme.ink, width: 1}};
    const stripTop = (strip: number) => top + high + stripGap + (strip - 1) * (stripHeight + stripGap);
    const last = strips.length;

    const xAxis = Array.from({length: last + 1}, (_, index) => ({
        type: 'value', gridIndex: index, min: 0, max: range / strainFactor, axisLine, axisTick, splitLine: {show: index === 0, lineStyle: {color: theme.grid}},
        axisLabel: {...text, show: index === last, hideOverlap: true, showMaxLabel: false, formatter: (value: number) => significant(value, 6).replace(/\.?0+$/, '') || '0'},
        ...(index === last ? {name: `Axial strain [${strainUnit}]`, nameLocation: 'middle', nameGap: 28, nameTextStyle: {...text, fontSize: 13}} : {}),
        axisPointer: {show: true, type: 'line', snap: false, label: {show: false}, lineStyle: {color: theme.muted, type: 'solid', width: 1}},
    }));
    const yAxis: object[] = [{
        type: 'value', gridIndex: 0, axisLine, axisTick, splitLine: {lineStyle: {color: theme.grid}}, axisLabel: {...text, formatter: tickText}, splitNumber: 6, boundaryGap: [0, '7%'],
        name: titled('Axial stress', scale), nameLocation: 'middle', nameGap: 44, nameTextStyle: {...text, fontSize: 13},
        axisPointer: {show: false},
    }];
    strips.forEach(({histogram, soFar}, index) => {
        const most = roundUp(histogram.most), total = roundUp(largestOf(soFar.count));
        const strip = {type: 'value', gridIndex: index + 1, min: 0, splitLine: {show: false}, axisLine, axisTick, axisPointer: {show: false}};
        yAxis.push({...strip, max: most, interval: most, axisLabel: {...small, formatter: tickText}, position: 'left'});
        yAxis.push({...strip, max: total, interval: total, axisLabel: {...small, formatter: tickText}, position: 'right'});
    });

    const titles = strips.map(({kind, member, count}, index) => ({
        text: `{name|${member.shortLabel}}  ${kind === 'slips' ? '{slips|■} ' : ''}{what|${counted(count)} ${kind}}`,
        left: left + 4, top: stripTop(index + 1) - 19, padding: 0,
        textStyle: {rich: {
            name: {...text, fontSize: 11.5, fontWeight: 600, color: theme.series[member.colour % theme.series.length]},
            what: small,
            slips: {...small, color: theme.slid},
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
                text: note.text, left: note.left, bottom: 6, padding: 0, textStyle: {...small, fontSize: noteSize, fontWeight: 400},
            },
        ],
        legend: {
            ...(legendTop > 10 ? {left} : {right}), top: legendTop, width: legendWidth, itemWidth: 22, itemHeight: 8, itemGap: 14, padding: 0, textStyle: text,
            data: [
                ...members.map((member) => ({name: member.shortLabel, icon: member.dashed ? dashedIcon : solidIcon,
                    itemStyle: {color: theme.series[member.colour % theme.series.length]}})),
                ...(measured ? [{name: measured.label, icon: dashedIcon, itemStyle: {color: theme.ink}}] : []),
            ],
            inactiveColor: theme.grid,
        },
        grid: Array.from({length: last + 1}, (_, index) => (index === 0
            ? {left, right, top, height: high}
            : {left, right, top: stripTop(index), height: stripHeight})),
        xAxis,
        yAxis,
        axisPointer: {link: [{xAxisIndex: 'all'}]},
        tooltip: {
            trigger: 'axis', showContent: false, // values are listed below the curves, since a box would hide them
        },
        dataZoom: [{type: 'inside', xAxisIndex: 'all', filterMode: 'none', zoomOnMouseWheel: 'shift', moveOnMouseMove: true}],
        series: [
            ...members.flatMap((member) => stressSeries(member, range, scale, theme)),
            ...(measured ? [measuredSeries(measured, scale, theme)] : []),
            ...strips.flatMap((strip, index) => stripSeries(strip, index + 1, theme)),
        ],
    };
}

/// A panel drawn in its container on the page.
export class CurvePanel {
    readonly chart: ECharts;
    readonly cursor: Cursor;
    private layout: PanelLayout;

    /// @param height  height of the panel, px; by default, the curves have their usual height
    constructor(private readonly container: HTMLElement, readonly panel: Panel, private readonly theme: Theme, private readonly onClick: (strain: number) => void,
        private readonly height?: () => number) {
        this.layout = this.newLayout();
        container.style.height = `${this.layout.height}px`;
        this.chart = echarts.init(container, null, {renderer: 'svg'});
        this.chart.setOption(panelOption(panel, this.layout, theme));
        this.chart.getZr().on('dblclick', () => this.chart.dispatchAction({type: 'dataZoom', start: 0, end: 100}));
        this.cursor = this.newCursor();
    }

    /// Call this after a change of the container's width.
    resize(): void {
        const now = this.newLayout();
        if (JSON.stringify(now) !== JSON.stringify(this.layout)) {
            this.layout = now;
            this.container.style.height = `${now.height}px`;
            this.chart.setOption(panelOption(this.panel, now, this.theme));
            this.cursor.moveTo(now.top);
        }
        this.chart.resize();
    }

    /// The panel as SVG text, for a file.
    asSvg(): string {
        const address = this.chart.getDataURL({type: 'svg'});
        return decodeURIComponent(address.slice(address.indexOf(',') + 1));
    }

    private newLayout(): PanelLayout {
        return layoutOf(this.panel, this.container.clientWidth, this.height?.());
    }

    /// A cursor at the strain of the specimens shown, from the top of the curves to the bottom of the lowest strip.
    private newCursor(): Cursor {
        return new Cursor(this.chart, this.layout.top, bottom, this.onClick);
    }
}

/// A table below the panel with the values of the curves at the pointer.
export function readoutOf({chart, panel}: CurvePanel, theme: Theme): HTMLElement {
    const {strips} = prepare(panel), lineHeight = 20; // px
    const idle = element('span', {class: 'hint'}, 'Point at the curves: their values are listed here.');
    const readout = element('div', {class: 'cursor', style: `min-height:${(panel.members.length + 2) * lineHeight}px`}, idle);
    const zr = chart.getZr();
    zr.on('mousemove', ({offsetX, offsetY}) => {
        const grid = Array.from({length: strips.length + 1}, (_, index) => index).find((index) => chart.containPixel({gridIndex: index}, [offsetX, offsetY]));
        if (grid === undefined) return;
        const [value] = chart.convertFromPixel({gridIndex: grid}, [offsetX, offsetY]) as [number, number];
        readout.replaceChildren(valuesAt(value * strainFactor, panel, strips, theme));
    });
    zr.on('globalout', () => readout.replaceChildren(idle));
    return readout;
}
