// SPDX-License-Identifier: GPL-3.0-or-later
// Shows the picked particle: its values in the current frame, its contacts, and the history of one of its values.

import * as echarts from 'echarts/core';
import type {ECharts} from 'echarts/core';

import {currentTheme} from '../colours/theme';
import {area} from '../data/cells';
import type {Frame} from '../data/frames';
import {mineralsOf} from '../data/report';
import type {SpecimenView} from '../drawing/specimen_view';
import {Cursor} from '../elements/chart_cursor';
import {button, element, select} from '../elements/dom';
import {fontFamily} from '../elements/sheet';
import {movedCentre} from '../geometry/rigid_motion';
import {quantitiesOf, type Quantity} from '../quantities/quantities';
import {missing, ofStress, quantity as withUnit, scaleFor, significant, strainFactor, suffixOf, titled} from '../quantities/units';
import {momentsOf} from './clock';
import type {Picked, Viewer} from './viewer';

const chartLeft = 44, chartTop = 22, chartBottom = 34; // px
const bondBroken = 2;
const wallNames: Record<number, string> = {[-1]: 'left wall', [-2]: 'right wall', [-3]: 'bottom wall', [-4]: 'top wall'};

interface Touch {
    with: string;
    fn: number;
    fs: number;
    array: string; // name of the array that contains fn
    kind: string;
}

export class Inspector {
    readonly element = element('fieldset', {class: 'inspector', hidden: ''});
    private readonly values = element('div', {class: 'values'});
    private readonly figure = element('div', {class: 'history'});
    private chart: ECharts | undefined;
    private cursor: Cursor | undefined;
    private shown = 'displacement';
    private drawn = '';

    constructor(private readonly viewer: Viewer) {}

    /// Call this after a change of the picked particle, the clock or the theme.
    update(): void {
        const {picked} = this.viewer;
        this.element.hidden = !picked;
        if (!picked) {
            this.drawn = '';
            return;
        }
        const theme = currentTheme();
        const key = `${picked.view.test.index} ${picked.cell} ${this.shown} ${theme.name} ${this.viewer.clock.axis}`;
        if (key !== this.drawn) {
            this.drawn = key;
            this.build(picked);
            void this.drawHistory(picked, key);
        }
        const frame = this.viewer.shownOf(picked.view.test);
        if (frame) this.values.replaceChildren(valueTable(picked, frame), contactTable(picked.view, frame, picked.cell, this.values.querySelector('details')?.open ?? true));
        if (frame) this.cursor?.show([{value: this.onAxis(picked.view, frame.index), colour: theme.picked}]);
    }

    private build({view, cell}: Picked): void {
        const {cells} = view.test;
        const choices = quantitiesOf(view.frames, view.test.meanVelocities).filter(({scaling}) => scaling !== 'categorical');
        if (!choices.some(({key}) => key === this.shown)) this.shown = choices[0]?.key ?? '';
        this.element.replaceChildren(
            element('legend', {}, `Particle ${cells.id[cell]}`),
            element('div', {class: 'picked-head'}, element('span', {}, view.labelled.label), button('×', 'Deselect (Esc)', () => this.viewer.pick(undefined), {'aria-label': 'Deselect the particle'})),
            this.values,
            ...(view.frames.count > 1 && choices.length > 0 ? [
                select('History of', choices.map(({key, name}) => ({value: key, text: name})), this.shown, (key) => {
                    this.shown = key;
                    this.update();
                }, {class: 'history-of'}, true),
                this.figure,
            ] : []));
    }

    private onAxis(view: SpecimenView, index: number): number {
        const {axis} = this.viewer.clock;
        return momentsOf(view.test, axis)[index]! / (axis === 'strain' ? strainFactor : 1);
    }

    private async drawHistory({view, cell}: Picked, key: string): Promise<void> {
        const quantity = quantitiesOf(view.frames, view.test.meanVelocities).find((one) => one.key === this.shown);
        if (!quantity || view.frames.count < 2) return;
        const values = await historyOf(view, quantity, cell);
        if (this.drawn !== key) return; // another particle has been picked since
        const theme = currentTheme(), scale = scaleFor([...values], quantity.unit), {axis} = this.viewer.clock;
        const text = {color: theme.muted, fontFamily, fontSize: 10.5};
        const line = {show: true, onZero: false, lineStyle: {color: theme.muted}};
        this.chart?.dispose();
        this.chart = echarts.init(this.figure, null, {renderer: 'svg'});
        this.chart.setOption({
            animation: false, grid: {left: chartLeft, right: 18, top: chartTop, bottom: chartBottom},
            xAxis: {
                type: 'value', max: 'dataMax', axisLine: line, splitLine: {show: false}, axisLabel: {...text, hideOverlap: true, showMaxLabel: false}, splitNumber: 3,
                name: {strain: 'Strain [‰]', share: 'Strain / strain at peak', time: 'Time [s]', frame: 'Frame'}[axis], nameLocation: 'middle', nameGap: 19, nameTextStyle: text,
            },
            yAxis: {
                type: 'value', axisLine: line, splitLine: {lineStyle: {color: theme.grid}}, axisLabel: text, splitNumber: 3, scale: true,
                name: suffixOf(scale).trim(), nameLocation: 'end', nameGap: 8, nameTextStyle: {...text, align: 'left', padding: [0, 0, 0, -chartLeft]},
            },
            series: [{
                type: 'line', showSymbol: false, data: [...values].map((value, index) => [this.onAxis(view, index), value / scale.factor]),
                lineStyle: {width: 1.4, color: theme.ink}, emphasis: {disabled: true}, silent: true,
            }],
        });
        this.cursor = new Cursor(this.chart, chartTop, chartBottom, (value) => this.viewer.clock.goTo(value * (axis === 'strain' ? strainFactor : 1)));
        const frame = this.viewer.shownOf(view.test);
        if (frame) this.cursor.show([{value: this.onAxis(view, frame.index), colour: theme.picked}]);
    }
}

async function historyOf(view: SpecimenView, quantity: Quantity, cell: number): Promise<Float32Array> {
    const columns = await view.frames.history(quantity.needs, cell);
    return Float32Array.from({length: view.frames.count}, (_, index) =>
        quantity.value(...quantity.needs.map((need) => columns.get(need)?.[index] ?? NaN)));
}

function valueTable({view, cell}: Picked, frame: Frame): HTMLElement {
    const {cells} = view.test, centre = movedCentre(cells, frame, cell, 1), radius = cells.radius[cell]!;
    const pair = (x: number, y: number, unit: string, name: string) => {
        const scale = scaleFor([x, y], unit), one = (value: number) => significant(value / scale.factor, 3, frame.resolution(name, value) / scale.factor);
        return scale.power === '' ? `${one(x)}, ${one(y)}${suffixOf(scale)}` : `(${one(x)}, ${one(y)})${suffixOf(scale)}`;
    };
    const one = (value: number, unit: string, name: string) => withUnit(value, unit, 3, frame.resolution(name, value));
    const field = (name: string) => frame.field(name)?.[cell];
    const [vx, vy, sxx, syy, sxy, fragment, rate] = ['vx', 'vy', 'sxx', 'syy', 'sxy', 'fragment', 'rate'].map(field);
    const rows: [string, string, string, number?][] = [
        ['id', 'Number', String(cells.id[cell]), cells.id[cell]!],
        ['material', 'Material', mineralsOf(view.test.summary)[cells.material[cell]! - 1] ?? String(cells.material[cell]), cells.material[cell]!],
        radius > 0 ? ['radius', 'Radius', withUnit(radius, 'm'), radius] : ['area', 'Area', areaText(area(cells, cell)), area(cells, cell)],
        ['place', 'Centre', pair(centre.x, centre.y, 'm', 'ux')],
        ['displacement', 'Displacement', pair(frame.ux[cell]!, frame.uy[cell]!, 'm', 'ux'), Math.hypot(frame.ux[cell]!, frame.uy[cell]!)],
        ['rotation', 'Rotation', one(frame.angle[cell]!, 'rad', 'angle'), frame.angle[cell]!],
        ...(vx === undefined || vy === undefined ? [] : [['velocity', 'Velocity', pair(vx, vy, 'm/s', 'vx'), Math.hypot(vx, vy)] as [string, string, string, number]]),
        ...(rate === undefined ? [] : [['rate', 'Rotation rate', one(rate, 'rad/s', 'rate'), rate] as [string, string, string, number]]),
        ...(sxx === undefined || syy === undefined || sxy === undefined ? [] : [
            ['stress', 'Stress xx, yy', pair(sxx, syy, ofStress, 'syy')] as [string, string, string], ['stress_shear', 'Stress xy', one(sxy, ofStress, 'sxy'), sxy] as [string, string, string, number]]),
        ...(fragment === undefined ? [] : [['fragment', 'Fragment', fragment === 0 ? 'largest' : `${fragment + 1}`, fragment] as [string, string, string, number]]),
    ];
    return element('table', {class: 'values'}, ...rows.map(([key, name, text, value]) => element('tr', {},
        element('th', {scope: 'row'}, name), element('td', {'data-value': key, ...(value === undefined ? {} : {'data-number': String(value)})}, text))));
}

function areaText(value: number): string {
    // The SI prefix is chosen for the side of a square of this area.
    const side = scaleFor([Math.sqrt(value)], 'm');
    if (side.power !== '') return significant(value) + suffixOf({...side, power: '', unit: side.unit === '' ? '' : `${side.unit}²`});
    return significant(value / side.factor ** 2) + suffixOf({...side, unit: side.unit === '' ? '' : `${side.unit}²`});
}

function contactTable(view: SpecimenView, frame: Frame, cell: number, open: boolean): HTMLElement {
    const touches = touching(view, frame, cell).sort((a, b) => Math.hypot(b.fn, b.fs) - Math.hypot(a.fn, a.fs));
    const scale = scaleFor(touches.flatMap(({fn, fs}) => [fn, fs]), 'N');
    const force = (value: number, array: string) => significant(value / scale.factor, 3, frame.resolution(array, value) / scale.factor);
    return element('details', open ? {open: ''} : {},
        element('summary', {}, `${touches.length} contact ${touches.length === 1 ? 'point' : 'points'}`),
        ...(touches.length === 0 ? [] : [element('table', {class: 'touches'},
            element('tr', {}, element('th', {scope: 'col'}, 'with'), element('th', {scope: 'col', title: 'compression positive'}, titled('Fn', scale)), element('th', {scope: 'col'}, titled('Fs', scale)), element('th', {scope: 'col'}, '')),
            ...touches.map(({with: other, fn, fs, array, kind}) => element('tr', {}, element('td', {}, other), element('td', {}, force(fn, array)), element('td', {}, force(fs, array)), element('td', {class: 'kind'}, kind))))]));
}

function touching(view: SpecimenView, frame: Frame, cell: number): Touch[] {
    const {cells, bonds} = view.test, touches: Touch[] = [];
    const name = (other: number) => (other < 0 ? wallNames[other] ?? missing : `${cells.id[other]}${cells.platen[other] === 1 ? ' (platen)' : ''}`);
    const fn = frame.field('fn'), fs = frame.field('fs'), state = frame.field('state');
    for (let bond = 0; bond < bonds.count; ++bond) {
        const i = bonds.i[bond]!, j = bonds.j[bond]!, now = state?.[bond] ?? 0;
        if ((i !== cell && j !== cell) || now === bondBroken || !fn || !fs) continue;
        touches.push({with: name(i === cell ? j : i), fn: fn[bond]!, fs: fs[bond]!, array: 'fn', kind: ['bond', 'bond, slid', '', 'broken'][now] ?? ''});
    }
    const {contacts} = frame;
    for (let contact = 0; contacts && contact < contacts.count; ++contact) {
        const i = contacts.i[contact]!, j = contacts.j[contact]!;
        if (i === cell || j === cell) touches.push({with: name(i === cell ? j : i), fn: contacts.fn[contact]!, fs: contacts.fs[contact]!, array: 'contacts.fn', kind: 'touches'});
    }
    return touches;
}
