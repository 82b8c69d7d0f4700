// SPDX-License-Identifier: GPL-3.0-or-later
// Curves of deck runs: energies, displacements and velocities of the watched bodies against time, and forces against
// displacements if driven bodies did work. `crackle plot` draws the same curves (tools/plot/deck_panels.cpp).

import * as echarts from 'echarts/core';
import type {ECharts} from 'echarts/core';

import type {Theme} from '../colours/theme';
import type {DeckCurves, EnergyName, TestData} from '../data/report';
import type {LabelledTest} from '../data/test_labels';
import {Cursor} from '../elements/chart_cursor';
import {button, element, saveFile} from '../elements/dom';
import {fontFamily} from '../elements/sheet';
import {quantity, scaleFor, significant, titled, titledInFull, type Scale} from '../quantities/units';
import {tickText, valueAt} from './curves';

type Values = ArrayLike<number>;

interface DrawnCurve {
    name: string;
    x: Values;
    y: Values;
    colour: (theme: Theme) => string;
    dashed?: boolean;
}

interface AxisOf {
    name: string;
    unit: string; // a unit accepted by scaleFor()
}

export interface DeckPanel {
    test: TestData;
    title: string;
    x: AxisOf;
    y: AxisOf;
    overTime: boolean; // whether x is time in s, to which the page's clock can be set
    curves: DrawnCurve[];
}

export type WithCurves = LabelledTest<TestData & {deck: DeckCurves}>;

export function withDeckCurves(labelled: readonly LabelledTest[]): WithCurves[] {
    return labelled.filter((one): one is WithCurves => one.test.deck !== undefined && one.test.deck.energy.time.length > 1);
}

const series = (number: number) => (theme: Theme): string => theme.series[number % theme.series.length]!;

const energyLooks: readonly {part: EnergyName; name: string; colour: (theme: Theme) => string; dashed?: boolean}[] = [
    {part: 'enrg', name: 'potential', colour: series(0)},
    {part: 'enva', name: 'kinetic', colour: series(1)},
    {part: 'enka', name: 'strain', colour: series(2)},
    {part: 'enca', name: 'lost to dashpots', colour: series(3)},
    {part: 'enfr', name: 'lost to friction', colour: series(4)},
    {part: 'enfb', name: 'lost to breaks', colour: ({tension}) => tension},
    {part: 'enxd', name: 'work of displacements', colour: series(6)},
    {part: 'enxf', name: 'work of forces', colour: series(7)},
    {part: 'err', name: 'closing error', colour: ({shear}) => shear, dashed: true},
];

const allZero = (values: Values): boolean => Array.prototype.every.call(values, (value: number) => value === 0);

function ends(values: Values): {low: number; high: number} {
    let low = Infinity, high = -Infinity;
    for (let at = 0; at < values.length; ++at) {
        low = Math.min(low, values[at]!);
        high = Math.max(high, values[at]!);
    }
    return {low, high};
}

const lessFirst = (values: Values): Float64Array => Float64Array.from(values, (value) => value - values[0]!);
const noChange = 1e-9; // smaller changes, relative to those in the other direction, are rounding errors

export function deckPanels({test, label}: WithCurves, several: boolean): DeckPanel[] {
    const {deck} = test, time: AxisOf = deck.inTime ? {name: 'Time', unit: 's'} : {name: 'Step', unit: ''};
    const panel = (title: string, x: AxisOf, y: AxisOf, curves: DrawnCurve[]): DeckPanel =>
        ({test, title: several ? `${label}: ${title.charAt(0).toLowerCase()}${title.slice(1)}` : title, x, y, overTime: x === time && deck.inTime, curves});
    const {parts} = deck.energy;
    const energies = energyLooks.filter(({part}) => part === 'err' || !allZero(parts[part]))
        .map(({part, name, ...look}): DrawnCurve => ({...look, name: `${name} (${part})`, x: deck.energy.time, y: parts[part]}));
    const ofBodies = <Body extends {id: number; time: Values}>(bodies: readonly Body[], x: (body: Body) => Values, y: (body: Body) => Values): DrawnCurve[] =>
        bodies.map((body, at) => ({name: `body ${body.id}`, x: x(body), y: y(body), colour: series(at), dashed: at >= 8}));
    const change = (axis: 'x' | 'y') => Math.max(0, ...deck.bodies.map((body) => ends(body[axis])).map(({low, high}) => high - low));
    const directions = (['x', 'y'] as const).filter((axis) => change(axis) > noChange * change(axis === 'x' ? 'y' : 'x'));
    const way = {x: 'Horizontal', y: 'Vertical'};
    const displacement: AxisOf = {name: 'Displacement', unit: 'm'};
    const driven = !allZero(parts.enxd) || !allZero(parts.enxf);
    return [
        panel('Energy', time, {name: 'Energy', unit: 'J'}, energies),
        ...directions.map((axis) => panel(`${way[axis]} displacement`, time, displacement, ofBodies(deck.bodies, (body) => body.time, (body) => lessFirst(body[axis])))),
        ...(deck.velocities.some(({vy}) => !allZero(vy)) ? [panel('Vertical velocity', time, {name: 'Velocity', unit: 'm/s'}, ofBodies(deck.velocities, (body) => body.time, (body) => body.vy))] : []),
        ...(driven ? directions.map((axis) => panel(`${way[axis]} force against displacement`, displacement, {name: 'Force', unit: 'N'},
            ofBodies(deck.bodies, (body) => lessFirst(body[axis]), (body) => (axis === 'x' ? body.forceX : body.forceY)))) : []),
    ];
}

const left = 82, right = 18, titleLine = 30, legendLine = 20, plotHeight = 210, bottom = 46; // px
const iconOf = (dashed: boolean) => (dashed ? 'path://M0,0L9,0L9,3L0,3ZM13,0L22,0L22,3L13,3Z' : 'path://M0,0L22,0L22,3L0,3Z');

const ruler = new OffscreenCanvas(1, 1).getContext('2d')!;

/// Number of lines that a legend needs below the title.
function legendLines(curves: readonly DrawnCurve[], room: number): number {
    ruler.font = `12px ${fontFamily}`;
    let lines = 1, at = 0;
    for (const {name} of curves) {
        const entry = ruler.measureText(name).width + 22 + 5 + 14;
        if (at > 0 && at + entry > room) [at, lines] = [0, lines + 1];
        at += entry;
    }
    return lines;
}

const scaleOf = (values: readonly Values[], unit: string): Scale => {
    const sizes = values.flatMap((each) => {
        const {low, high} = ends(each);
        return [low, high];
    });
    return unit === '' ? {factor: 1, power: '', unit: ''} : scaleFor(sizes, unit);
};

/// A figure drawn in its container on the page.
export class DeckCurveFigure {
    readonly element: HTMLElement;
    private readonly figure = element('div', {class: 'panel'});
    private readonly xScale: Scale;
    private readonly yScale: Scale;
    private chart: ECharts | undefined;
    private cursor: Cursor | undefined;
    private top = 0;

    constructor(readonly panel: DeckPanel, private readonly theme: Theme, private readonly onClick: (time: number) => void) {
        this.xScale = scaleOf(panel.curves.map(({x}) => x), panel.x.unit);
        this.yScale = scaleOf(panel.curves.map(({y}) => y), panel.y.unit);
        const name = panel.title.toLowerCase().replace(/[^\p{L}\p{N}]+/gu, '_');
        const save = button('SVG', 'Save this figure as SVG', () => saveFile(`${name}.svg`, 'image/svg+xml', this.asSvg()), {class: 'save'});
        this.element = element('div', {class: 'frame', 'data-panel': panel.title}, element('div', {class: 'chart'}, this.figure, save));
    }

    /// Call this once the element is on the page.
    draw(): void {
        this.lay();
        this.chart = echarts.init(this.figure, null, {renderer: 'svg'});
        this.chart.setOption(this.option());
        this.chart.getZr().on('dblclick', () => this.chart?.dispatchAction({type: 'dataZoom', start: 0, end: 100}));
        this.cursor = new Cursor(this.chart, this.top, bottom, (value) => {
            if (this.panel.overTime) this.onClick(value * this.xScale.factor);
        });
        this.element.append(this.readout(this.chart));
    }

    resize(): void {
        this.lay();
        this.chart?.setOption(this.option());
        this.cursor?.moveTo(this.top);
        this.chart?.resize();
    }

    dispose(): void {
        this.chart?.dispose();
    }

    onZoom(react: () => void): void {
        this.chart?.on('datazoom', react);
    }

    /// Moves the cursor to the time of the frame that the specimen shows.
    showTime(time: number | undefined): void {
        this.cursor?.show(time === undefined || !this.panel.overTime ? [] : [{value: time / this.xScale.factor, colour: this.theme.muted}]);
    }

    private asSvg(): string {
        const address = this.chart!.getDataURL({type: 'svg'});
        return decodeURIComponent(address.slice(address.indexOf(',') + 1));
    }

    private get alone(): boolean {
        return this.panel.curves.length === 1;
    }

    private lay(): void {
        this.top = titleLine + (this.alone ? 0 : legendLine * legendLines(this.panel.curves, this.figure.clientWidth - left - right)) + 8;
        this.figure.style.height = `${this.top + plotHeight + bottom}px`;
    }

    private option() {
        const {panel, theme, xScale, yScale} = this, {curves} = panel;
        const text = {color: theme.ink, fontFamily, fontSize: 12};
        const axis = {
            type: 'value', axisLine: {show: true, onZero: false, lineStyle: {color: theme.ink, width: 1}}, axisTick: {show: true, inside: true, length: 5, lineStyle: {color: theme.ink, width: 1}},
            splitLine: {lineStyle: {color: theme.grid}}, nameLocation: 'middle', nameTextStyle: {...text, fontSize: 13}, axisPointer: {show: false},
        };
        const {low, high} = curves.map(({x}) => ends(x)).reduce((so, one) => ({low: Math.min(so.low, one.low), high: Math.max(so.high, one.high)}));
        const title = this.alone ? `${panel.title} of ${curves[0]!.name}` : panel.title;
        return {
            animation: false, backgroundColor: theme.background, textStyle: text,
            title: [{text: title, left, top: 6, padding: 0, textStyle: {...text, fontSize: 15, fontWeight: 600}}],
            legend: {
                show: !this.alone, left, top: titleLine, width: Math.max(80, this.figure.clientWidth - left - right), itemWidth: 22, itemHeight: 8, itemGap: 14, padding: 0, textStyle: text, inactiveColor: theme.grid,
                data: curves.map(({name, colour, dashed}) => ({name, icon: iconOf(dashed === true), itemStyle: {color: colour(theme)}})),
            },
            grid: {left, right, top: this.top, height: plotHeight},
            xAxis: {...axis, min: low / xScale.factor, max: high / xScale.factor, name: panel.x.unit === 'm' ? titledInFull(panel.x.name, xScale) : titled(panel.x.name, xScale), nameGap: 26, splitLine: {show: false},
                axisLabel: {...text, hideOverlap: true, showMinLabel: low === 0, showMaxLabel: false, formatter: (value: number) => significant(value, 6).replace(/(\.\d*?)0+$/, '$1').replace(/\.$/, '')}},
            yAxis: {...axis, scale: true, name: titledInFull(panel.y.name, yScale), nameGap: 62, splitNumber: 5, axisLabel: {...text, formatter: tickText}},
            tooltip: {trigger: 'axis', showContent: false},
            dataZoom: [{type: 'inside', xAxisIndex: 'all', filterMode: 'none', zoomOnMouseWheel: 'shift', moveOnMouseMove: true}],
            series: curves.map(({name, x, y, colour, dashed}) => ({
                type: 'line', name, showSymbol: false, animation: false, emphasis: {disabled: true}, lineStyle: {width: 1.5, color: colour(theme), type: dashed ? [6, 3] : 'solid'}, itemStyle: {color: colour(theme)},
                data: Array.from({length: x.length}, (_, at) => [x[at]! / xScale.factor, y[at]! / yScale.factor]),
            })),
        };
    }

    /// Lists the values at the pointer below the figure. Only for curves against time, which have one value at each time.
    private readout(chart: ECharts): HTMLElement {
        const {panel, theme} = this;
        const idle = element('span', {class: 'hint'}, panel.overTime ? 'Point at the curves: their values are listed here.' : '');
        const readout = element('div', {class: 'cursor', style: `min-height:${panel.overTime ? (panel.curves.length + 1) * 20 : 0}px`}, idle);
        if (!panel.overTime) return readout;
        chart.getZr().on('mousemove', ({offsetX, offsetY}) => {
            if (!chart.containPixel({gridIndex: 0}, [offsetX, offsetY])) return;
            const [shown] = chart.convertFromPixel({gridIndex: 0}, [offsetX, offsetY]) as [number, number], time = shown * this.xScale.factor;
            readout.replaceChildren(element('div', {}, `t = ${quantity(time, 's')}`), element('table', {}, ...panel.curves.map(({name, x, y, colour}) =>
                element('tr', {}, element('th', {}, element('i', {style: `background:${colour(theme)}`}), name), element('td', {}, quantity(valueAt(x, y, time), panel.y.unit))))));
        });
        chart.getZr().on('globalout', () => readout.replaceChildren(idle));
        return readout;
    }
}
