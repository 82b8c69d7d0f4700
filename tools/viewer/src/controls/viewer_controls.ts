// SPDX-License-Identifier: GPL-3.0-or-later
// The viewer's controls: playback below the picture, and a side panel for settings.

import {sequentialNames, type SequentialName} from '../colours/palettes';
import {momentText} from '../drawing/annotations';
import {layerNames, type Layout, type Settings} from '../drawing/settings';
import {button, checkbox, element, select} from '../elements/dom';
import {icon} from '../elements/icons';
import {largestMagnifiedAngle} from '../geometry/rigid_motion';
import {axisNames, clockText, type Axis} from './clock';
import {keyList} from './keys';
import {canCopy, copyPng, gifFrames, saveAnimation, saveGif, savePng, saveSvg, videoType} from './saving';
import type {Viewer} from './viewer';

const speeds = ['0.1', '0.25', '0.5', '1', '2', '4', '8'] as const;
const magnifications = ['1', '2', '5', '10', '20', '50', '100', '500'] as const;
const layoutNames: Record<Layout, string> = {one: 'One test', side: 'Side by side', over: 'Overlaid'};

export class ViewerControls {
    readonly transport = element('div', {class: 'transport', role: 'group', 'aria-label': 'Playback'});
    readonly panel = element('div', {class: 'side'});
    readonly help = element('dialog', {class: 'help', 'aria-label': 'Keys'});
    private readonly playButton: HTMLButtonElement;
    private readonly slider = element('input', {type: 'range', class: 'scrub', min: '0', step: '1', 'aria-label': 'Moment'});
    private readonly readout = element('output', {class: 'readout', 'aria-live': 'off'});
    private readonly announcement = element('span', {class: 'unseen', 'aria-live': 'polite'});
    private readonly busy = element('span', {class: 'busy', role: 'status'});
    private readonly choices = element('div', {class: 'choices'});
    private copyButton: HTMLButtonElement | undefined;

    constructor(private readonly viewer: Viewer) {
        const {clock} = viewer;
        this.playButton = button(icon('play'), 'Play (space)', () => (clock.playing ? clock.pause() : clock.play()), {class: 'play', 'aria-label': 'Play'});
        this.slider.addEventListener('input', () => {
            clock.pause();
            clock.go(Number(this.slider.value));
        });
        this.transport.append(
            button(icon('first'), 'First frame (Home)', () => clock.step(-clock.count), {'aria-label': 'First frame'}),
            button(icon('back'), 'Previous frame (←)', () => clock.step(-1), {'aria-label': 'Previous frame'}),
            this.playButton,
            button(icon('on'), 'Next frame (→)', () => clock.step(1), {'aria-label': 'Next frame'}),
            button(icon('last'), 'Last frame (End)', () => clock.step(clock.count), {'aria-label': 'Last frame'}),
            this.slider, this.readout, this.announcement,
            select('Speed', speeds.map((value) => ({value, text: `×${value}`})), '1', (value) => { clock.speed = Number(value); }, {class: 'speed'}));
        this.help.append(
            element('h3', {}, 'Keys'),
            element('table', {}, ...keyList.map(([keys, what]) => element('tr', {}, element('th', {scope: 'row'}, element('kbd', {}, keys)), element('td', {}, what)))),
            button('Close', 'Close (Escape)', () => this.help.close()));
        this.panel.append(this.choices, this.saving(), this.busy);
    }

    /// Rebuilds the side panel after a change of the available choices.
    build(): void {
        const {viewer} = this, {settings, tests} = viewer;
        const refresh = () => viewer.refresh();
        const scaled = viewer.quantity.scaling !== 'categorical';
        const several = tests.length > 1;
        this.choices.replaceChildren(
            ...(several ? [group('Tests',
                select('Show', (['one', 'side', 'over'] as const).map((value) => ({value, text: layoutNames[value]})), settings.layout, (layout) => {
                    viewer.choose({layout});
                    this.build();
                }, {class: 'layout'}),
                ...(settings.layout === 'side' ? [] : [this.testList('test', settings.layout === 'one' ? 'Test' : 'First')]),
                ...(settings.layout === 'over' ? [this.testList('other', 'Second')] : []))] : []),
            ...(viewer.clock.count > 1 ? [group('', select('Clock', viewer.axes.map((value) => ({value, text: axisNames[value]})), viewer.clock.axis,
                (axis: Axis) => viewer.setAxis(axis), {class: 'axis'}, true))] : []),
            group('Colour',
                select('By', viewer.quantities.map(({key, name}) => ({value: key, text: name})), viewer.quantity.key, (quantity) => {
                    settings.quantity = quantity;
                    this.build();
                    refresh();
                }, {class: 'quantity'}, true),
                ...(scaled ? [
                    select('Range', [...(viewer.peaked ? [{value: 'peak', text: 'Up to the peak'}] : []), {value: 'all', text: 'All frames'}, {value: 'frame', text: 'This frame'}],
                        settings.range === 'peak' && !viewer.peaked ? 'all' : settings.range, (range) => {
                        settings.range = range as Settings['range'];
                        refresh();
                    }, {class: 'range'}),
                    ...(viewer.quantity.scaling === 'sequential' ? [select('Map', sequentialNames.map((value) => ({value, text: value})), settings.map, (map: SequentialName) => {
                        settings.map = map;
                        refresh();
                    }, {class: 'map'})] : []),
                ] : [])),
            group('Layers', element('div', {class: 'checks'}, ...[...viewer.layers].map((layer) => checkbox(layerNames[layer], settings.layers[layer], (shown) => {
                settings.layers[layer] = shown;
                if (layer === 'forces') this.build();
                refresh();
            }, {'data-layer': layer})))),
            ...(several && settings.layers.forces && viewer.layers.has('forces') ? [group('', select('Force widths', [{value: 'page', text: 'Same for all tests'}, {value: 'shown', text: 'For the tests shown'}], settings.forcesOf, (of) => {
                settings.forcesOf = of as Settings['forcesOf'];
                refresh();
            }, {class: 'forces-of'}))] : []),
            group('', ...(viewer.chosen.some(({test}) => test.events.count > 0) ? [select('Cracks by', [{value: 'mode', text: 'Mode'}, {value: 'time', text: 'Time'}], settings.crackColour, (by) => {
                settings.crackColour = by as 'mode' | 'time';
                refresh();
            }, {class: 'cracks-by'})] : []),
            ...(viewer.clock.count > 1 ? [select('Displacements', magnifications.map((value) => ({value, text: `×${value}`})), String(settings.magnification), (value) => {
                settings.magnification = Number(value);
                refresh();
            }, {class: 'magnification', title: `Rotations are magnified up to ${largestMagnifiedAngle} rad`})] : [])));
    }

    /// Copies the picture to the clipboard. @return whether this browser allows it
    copy(): boolean {
        this.copyButton?.click();
        return this.copyButton !== undefined;
    }

    private testList(which: 'test' | 'other', label: string): HTMLElement {
        const {viewer} = this;
        return select(label, viewer.tests.map(({labelled}, at) => ({value: String(at), text: labelled.label})), String(viewer.settings[which]), (test) => {
            viewer.choose({[which]: Number(test)});
            this.build();
        }, {class: which}, true);
    }

    /// Updates the playback bar after a change of the clock or the picture.
    update(): void {
        const {clock, picture} = this.viewer;
        this.playButton.replaceChildren(icon(clock.playing ? 'pause' : 'play'));
        this.playButton.setAttribute('aria-label', clock.playing ? 'Pause' : 'Play');
        this.transport.hidden = clock.count < 2;
        this.slider.max = String(clock.count - 1);
        this.slider.value = String(clock.index);
        const first = [...picture.shown.values()][0];
        const text = picture.shown.size > 1 ? clockText(clock) : first ? `Frame ${first.frame.index + 1}/${first.view.frames.count}\u2003${momentText(first.frame, first.view.test)}` : '';
        this.readout.textContent = text;
        // The moment is announced only while paused, since a screen reader cannot follow an animation.
        if (!clock.playing) this.announcement.textContent = text;
    }

    private saving(): HTMLElement {
        const {viewer} = this;
        const report = (text: string) => { this.busy.textContent = text; };
        const buttons: HTMLButtonElement[] = [];
        type Save = () => Promise<string | void> | void; // returns a message for the reader, if any
        const saver = (name: string, title: string, save: Save, key: string) => {
            const one = button(name, title, () => void run(save), {'data-save': key});
            buttons.push(one);
            return one;
        };
        // Only one file is saved at a time, because saving steps the clock through all frames.
        const run = async (save: Save) => {
            for (const one of buttons) one.disabled = true;
            try {
                report(await save() || '');
            } catch (error) {
                report(`Not saved: ${error instanceof Error ? error.message : String(error)}`);
            } finally {
                for (const one of buttons) one.disabled = false;
            }
        };
        return group('Save as', element('div', {class: 'saves'},
            saver('PNG', 'The picture as PNG', () => savePng(viewer), 'png'),
            saver('SVG', 'The picture as SVG', () => saveSvg(viewer), 'svg'),
            ...(viewer.clock.count > 1 || viewer.tests.some(({test}) => test.frames.length > 1) ? [
                saver('GIF', `All frames as an animated GIF; at most ${gifFrames} frames, evenly spaced`, () => saveGif(viewer, report), 'gif'),
                ...(videoType() ? [saver('Video', 'All frames as a video', () => saveAnimation(viewer, report), 'video')] : []),
            ] : []),
            ...(canCopy() ? [this.copyButton = saver('Copy', 'The picture on the clipboard (Ctrl C)', () => copyPng(viewer), 'copy')] : []),
            button('?', 'Keys (?)', () => this.help.showModal(), {'aria-label': 'Keys'})));
    }
}

function group(title: string, ...children: HTMLElement[]): HTMLElement {
    return element('fieldset', title ? {} : {class: 'untitled'}, ...(title ? [element('legend', {}, title)] : []), ...children);
}
