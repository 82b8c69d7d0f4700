// SPDX-License-Identifier: GPL-3.0-or-later
// Positions and directions of bond breaks, on one card per test. A card has a map of breaks, as acoustic-emission sensors would
// locate them, with slips beneath, and a rose diagram of crack directions.

import * as echarts from 'echarts/core';
import type {ECharts} from 'echarts/core';

import {css, sequentialPalette} from '../colours/palettes';
import type {Theme} from '../colours/theme';
import {hasSlips, largestOf, lastTimeOf, type BondEvents, type TestData} from '../data/report';
import type {LabelledTest} from '../data/test_labels';
import {element, saveFile, svgText} from '../elements/dom';
import {fontFamily} from '../elements/sheet';
import {extentOfBondEvents} from '../geometry/extent';
import {counted, quantity, scaleFor, significant, titled} from '../quantities/units';
import {drawRose} from './rose';

/// Settings of the maps.
export interface MapSettings {
    colour: 'mode' | 'time';
    slips: boolean;
}

const mapHeight = 380; // px
const largestMark = 26; // px, upper limit for the diameter of the mark of the largest energy
const smallestMark = 1.5;
const covered = 0.3; // fraction of the map that all circles together may cover
const slipWidth = 1.4; // px, width of the lines for slips
const longestSlip = 9, shortestSlip = 3, slipShare = 0.8; // px, px, and fraction of the mean distance between slips

function sumOf(values: ArrayLike<number>): number {
    let sum = 0;
    for (let at = 0; at < values.length; ++at) sum += values[at]!;
    return sum;
}

function svgOf(chart: ECharts): string {
    const address = chart.getDataURL({type: 'svg'});
    return decodeURIComponent(address.slice(address.indexOf(',') + 1));
}

function saveButton(name: string, svg: () => string): HTMLElement {
    const save = element('button', {type: 'button', class: 'save', title: 'Save this figure as SVG'}, 'SVG');
    save.addEventListener('click', () => saveFile(`${name}.svg`, 'image/svg+xml', svg()));
    return save;
}

/// Makes the card of a test. Its charts must be drawn after it has been inserted into the page.
export function breakCard({test, label}: LabelledTest, settings: MapSettings, theme: Theme): {element: HTMLElement; draw: () => ECharts[]} {
    const slips = hasSlips(test) ? `${counted(test.slips.count)} slips` : '';
    const positions = [`${test.events.count} breaks`, ...(slips && settings.slips ? [slips] : [])].join(' and ');
    const map = element('div', {class: 'map', role: 'img', 'aria-label': `Positions of ${positions} in ${label}`});
    const directions = drawRose(test.events, theme);
    const rose = element('div', {class: 'rose', role: 'img', 'aria-label': `Directions of the cracks in ${label}`}, directions);
    const charts: ECharts[] = [];
    const largest = largestOf(test.events.energy);
    const counts = [`${counted(test.events.count)} breaks`, ...(largest > 0 ? [`largest ${quantity(largest, 'J', 2)}`] : []), ...(slips ? [slips] : [])].join(', ');
    const card = element('article', {class: 'card breaks', 'data-test': test.name},
        element('h3', {}, label, element('small', {}, counts)),
        element('div', {class: 'breaks-row'},
            element('figure', {}, map, element('figcaption', {}, saveButton(`${test.name}-breaks`, () => svgOf(charts[0]!)))),
            element('figure', {}, rose, element('figcaption', {}, saveButton(`${test.name}-rose`, () => svgText(directions))))));
    return {element: card, draw: () => {
        charts.push(drawMap(map, test, settings, largest, theme));
        return charts;
    }};
}

function drawMap(container: HTMLElement, test: TestData, {colour, slips}: MapSettings, largest: number, theme: Theme): ECharts {
    const {events} = test, extent = extentOfBondEvents(test);
    // Size without the room for marks.
    const width = container.clientWidth, scale = scaleFor([0.9 * Math.max(extent.x2 - extent.x1, extent.y2 - extent.y1)], 'm');
    const left = 54, right = 12, top = 10, bottom = 40;
    // Both axes have the same scale.
    const perMetre = Math.min((mapHeight - top - bottom) / (extent.y2 - extent.y1), (width - left - right) / (extent.x2 - extent.x1));
    container.style.height = `${(extent.y2 - extent.y1) * perMetre + top + bottom}px`;
    const chart = echarts.init(container, null, {renderer: 'svg'});
    const palette = sequentialPalette('cividis'), last = lastTimeOf(test);
    const text = {color: theme.ink, fontFamily, fontSize: 11};
    const axis = {type: 'value', axisLine: {show: true, onZero: false, lineStyle: {color: theme.ink}}, axisTick: {show: true, inside: true, lineStyle: {color: theme.ink}},
        splitLine: {show: false}, axisLabel: {...text, hideOverlap: true, showMinLabel: false, showMaxLabel: false, formatter: (value: number) => significant(value, 4).replace(/(\.\d*?)0+$/, '$1').replace(/\.$/, '')}, nameLocation: 'middle', nameTextStyle: text};
    const ofTime = (time: number) => css(palette[Math.min(255, Math.floor(last > 0 ? 256 * time / last : 0))]!);
    const inner = (extent.x2 - extent.x1) * perMetre;
    const energies = sumOf(events.energy) / (largest || 1);
    const widest = Math.min(largestMark, Math.sqrt(covered * inner * (extent.y2 - extent.y1) * perMetre * 4 / Math.PI / Math.max(1e-9, energies)));
    // Large circles are drawn first, so that they do not hide small ones.
    const order = Array.from({length: events.count}, (_, event) => event).sort((a, b) => events.energy[b]! - events.energy[a]!);
    const place = ({x, y}: BondEvents, event: number) => [x[event]! / scale.factor, y[event]! / scale.factor];
    // Slips are drawn as lines along the contacts, the direction in which bodies slide past each other.
    const slipMarks = (all: BondEvents) => {
        const distance = Math.sqrt(inner * (extent.y2 - extent.y1) * perMetre / all.count);
        const length = Math.max(shortestSlip, Math.min(longestSlip, slipShare * distance));
        return {
            type: 'scatter', silent: true, symbol: 'rect', symbolSize: [length, slipWidth], z: 2,
            data: Array.from({length: all.count}, (_, event) => ({
                value: place(all, event), symbolRotate: all.orientation[event]! * 180 / Math.PI + 90,
                itemStyle: {color: colour === 'mode' ? theme.slid : ofTime(all.time[event]!), opacity: 0.85},
            })),
        };
    };
    chart.setOption({
        animation: false, grid: {left, width: inner, top, bottom},
        xAxis: {...axis, min: extent.x1 / scale.factor, max: extent.x2 / scale.factor, name: titled('x', scale), nameGap: 24, splitNumber: 3},
        yAxis: {...axis, min: extent.y1 / scale.factor, max: extent.y2 / scale.factor, name: titled('y', scale), nameGap: 40},
        series: [...(slips && hasSlips(test) ? [slipMarks(test.slips)] : []), {
            type: 'scatter', silent: true, z: 3,
            data: order.map((event) => ({
                value: place(events, event),
                symbolSize: Math.max(smallestMark, widest * Math.sqrt(events.energy[event]! / (largest || 1))),
                itemStyle: {
                    color: colour === 'mode' ? (events.shear[event] === 1 ? theme.shear : theme.tension) : ofTime(events.time[event]!),
                    opacity: 0.6, borderColor: theme.background, borderWidth: 0.4,
                },
            })),
        }],
    });
    return chart;
}
