// SPDX-License-Identifier: GPL-3.0-or-later
// The viewer, which shows tests in motion. It holds the settings, and updates picture, clock and controls after each change.

import {colouring, type Colouring} from '../colours/colouring';
import {categoricalPalette, sequentialPalette} from '../colours/palettes';
import {currentTheme} from '../colours/theme';
import type {Frame} from '../data/frames';
import {lastTimeOf, mineralsOf, type TestData} from '../data/report';
import type {CrackColours} from '../drawing/drawn_lines';
import {Picture, type Shown} from '../drawing/picture';
import {initialSettings, type Layer, type Settings} from '../drawing/settings';
import {SpecimenView, type Look} from '../drawing/specimen_view';
import {element} from '../elements/dom';
import {Picking} from '../geometry/picking';
import {movedCentre} from '../geometry/rigid_motion';
import {plain, quantitiesOf, type Quantity} from '../quantities/quantities';
import {categories, forceScaleOf, forceScaleOfAll, joined, joinedForces, noForces, rangeOfFrames, rangeUntil, type ForceScale, type Range} from '../quantities/ranges';
import {axesFor, Clock, type Axis} from './clock';
import {Navigation} from './navigation';

/// Index of the frame at the peak of a test that failed; undefined if no frames follow it.
function peakFrame(test: TestData): number | undefined {
    const at = test.frames.findIndex(({roles}) => roles?.includes('peak'));
    return test.failed && at > 0 && at < test.frames.length - 1 ? at : undefined;
}

/// Largest numbers of cells and tests shown side by side at the start; they are drawn quickly on any machine.
const cellsSideBySide = 20000;
const testsSideBySide = 6;

export interface Picked {
    view: SpecimenView;
    cell: number;
}

export class Viewer {
    readonly clock = new Clock();
    readonly picture = new Picture();
    readonly settings: Settings = structuredClone(initialSettings);
    readonly navigation: Navigation;
    readonly stageElement = element('div', {class: 'stage', tabindex: '0', role: 'application', 'aria-label': 'Specimens in motion; press ? for the keys'});
    picked: Picked | undefined;
    onShown: () => void = () => {}; // called after each change of moment or appearance
    private readonly pickings = new Map<SpecimenView, Picking>();
    private readonly ranges = new Map<string, Range>();
    private readonly forces = new Map<TestData, ForceScale>();
    private paneElements: HTMLElement[] = [];
    private latest = 0; // number of the latest request for a moment
    private settling: Promise<void> = Promise.resolve();

    /// @param tests  tests that have frames
    constructor(readonly tests: readonly SpecimenView[], private readonly large: boolean) {
        const cells = tests.reduce((sum, {test}) => sum + test.cells.count, 0);
        if (tests.length > 1 && tests.length <= testsSideBySide && cells <= cellsSideBySide) this.settings.layout = 'side';
        this.navigation = new Navigation((transform) => {
            this.picture.stage.panZoom = {k: transform.k, x: transform.x, y: transform.y};
            this.picture.stage.request();
        }, (event) => this.large || event.ctrlKey || this.stageElement.contains(document.activeElement));
        this.stageElement.append(this.picture.element);
        this.clock.onTick = () => this.showMoment();
        new ResizeObserver(() => this.layOut()).observe(this.stageElement);
    }

    /// Tests on the screen.
    get chosen(): readonly SpecimenView[] {
        const {layout, test, other} = this.settings;
        return layout === 'side' ? this.tests : [...new Set(layout === 'one' ? [test] : [test, other])].map((at) => this.tests[at]!);
    }

    get axes(): Axis[] {
        return axesFor(this.chosen.map(({test}) => test));
    }

    get quantities(): Quantity[] {
        const lists = this.chosen.map(({frames, test}) => quantitiesOf(frames, test.meanVelocities));
        return lists[0]!.filter(({key}) => lists.every((list) => list.some((other) => other.key === key)));
    }

    get layers(): Set<Layer> {
        return new Set(this.chosen.flatMap((view) => view.layers));
    }

    /// Whether one of the shown tests has frames after its peak.
    get peaked(): boolean {
        return this.chosen.some(({test}) => peakFrame(test) !== undefined);
    }

    get quantity(): Quantity {
        return this.quantities.find(({key}) => key === this.settings.quantity) ?? plain;
    }

    /// Call this to change the layout or the tests.
    choose(change: Partial<Pick<Settings, 'layout' | 'test' | 'other'>>): void {
        Object.assign(this.settings, change);
        if (this.picked && !this.chosen.includes(this.picked.view)) this.picked = undefined;
        const axes = this.axes;
        this.clock.setTests(this.chosen.map(({test}) => test), axes.includes(this.clock.axis) ? this.clock.axis : axes[0]!);
        this.layOut();
    }

    /// Starts the viewer with the clock on the first available axis, which is strain if all tests have curves.
    start(): void {
        this.clock.axis = this.axes[0]!;
        this.choose({});
    }

    setAxis(axis: Axis): void {
        this.clock.setTests(this.chosen.map(({test}) => test), axis);
    }

    /// Call this after a change of colours or layers.
    refresh(): void {
        this.clock.onTick();
    }

    /// Resolves when the most recently requested moment is on the screen.
    async settled(): Promise<void> {
        await this.settling;
    }

    /// The frame of a test on the screen.
    shownOf(test: TestData): Frame | undefined {
        const view = this.tests.find((one) => one.test === test);
        return view && this.picture.shown.get(view)?.frame;
    }

    pick(picked: Picked | undefined): void {
        this.picked = picked;
        this.refresh();
    }

    /// Position of a particle's centre on the page, in CSS pixels from the upper left corner of the window.
    placeOf(name: string, id: number): {x: number; y: number} | undefined {
        const at = this.picture.stage.panes.findIndex((pane) => pane.views.some((view) => view.test.name === name));
        const pane = this.picture.stage.panes[at], view = pane?.views.find((one) => one.test.name === name), shown = view && this.picture.shown.get(view);
        if (!pane || !shown) return undefined;
        const box = this.paneElements[at]!.getBoundingClientRect(), placing = this.picture.stage.placing(pane);
        const centre = movedCentre(view.test.cells, shown.frame, view.test.cells.id.indexOf(id), this.settings.magnification);
        return {x: box.left + placing.x + (centre.x - view.origin.x) * placing.scale, y: box.top + placing.y - (centre.y - view.origin.y) * placing.scale};
    }

    private layOut(): void {
        const {clientWidth: width, clientHeight: height} = this.stageElement;
        if (width === 0 || height === 0) return;
        const views = this.chosen;
        this.picture.layOut(this.settings.layout === 'over' ? [views] : views.map((view) => [view]), width, height);
        for (const old of this.paneElements) old.remove();
        this.paneElements = this.picture.stage.panes.map(({rectangle: {x, y, width: w, height: h}, views: inPane}) => {
            const pane = element('div', {class: 'pane', style: `left:${x}px;top:${y}px;width:${w}px;height:${h}px`, 'data-test': inPane.map((view) => view.test.name).join(' ')});
            pane.addEventListener('click', (event) => this.pickAt(pane, event));
            return pane;
        });
        this.stageElement.append(...this.paneElements);
        this.navigation.attach(this.paneElements);
        this.showMoment();
    }

    private pickAt(element: HTMLElement, event: MouseEvent): void {
        const pane = this.picture.stage.panes[this.paneElements.indexOf(element)]!;
        const placing = this.picture.stage.placing(pane), box = element.getBoundingClientRect();
        for (const view of [...pane.views].reverse()) {
            const shown = this.picture.shown.get(view);
            if (!shown) continue;
            const point = {
                x: view.origin.x + (event.clientX - box.left - placing.x) / placing.scale,
                y: view.origin.y - (event.clientY - box.top - placing.y) / placing.scale,
            };
            let picking = this.pickings.get(view);
            if (!picking) this.pickings.set(view, picking = new Picking(view.test));
            const cell = picking.at(point, shown.frame, this.settings.magnification);
            if (cell !== undefined) {
                this.pick({view, cell});
                return;
            }
        }
        if (this.picked) this.pick(undefined);
    }

    /// Draws the moment at once if all its frames are unpacked, otherwise as soon as they are.
    private showMoment(): void {
        const request = ++this.latest;
        const views = this.chosen;
        const wanted = views.map((view) => ({view, index: this.clock.frameOf(view.test)}));
        const ready = wanted.map(({view, index}) => ({view, frame: view.frames.ready(index)}));
        if (ready.every(({frame}) => frame)) {
            this.show(ready as {view: SpecimenView; frame: Frame}[]);
            return;
        }
        // The first picture need not wait for its frame, because nothing has moved in the first frame.
        if (this.picture.shown.size === 0) this.show(views.map((view) => ({view, frame: view.frames.first()})));
        this.clock.held = true;
        this.settling = Promise.all(wanted.map(async ({view, index}) => ({view, frame: await view.frames.load(index)}))).then((loaded) => {
            this.clock.held = false;
            if (request === this.latest) this.show(loaded);
        });
    }

    private show(frames: {view: SpecimenView; frame: Frame}[]): void {
        const theme = currentTheme(), {settings} = this;
        const over = settings.layout === 'over' && frames.length > 1;
        const colours = this.colours(frames);
        const forceScale = settings.layers.forces ? this.forceScale(frames) : noForces;
        const crackColours = this.crackColours(frames.map(({view}) => view));
        const offered = this.layers;
        const shown = frames.map(({view, frame}, at): Shown => {
            const look: Look = {
                settings, theme, forceScale, offered, crackColours,
                colouring: over && colours.quantity.key === 'none' ? {...colours, palette: categoricalPalette(theme.overlaid[at % 2]!)} : colours,
                picked: this.picked?.view === view ? this.picked.cell : undefined,
                opacity: over ? 0.5 : 1,
            };
            return {view, frame, look};
        });
        this.picture.show(shown, theme);
        for (const {view, frame} of frames) view.frames.prefetch(frame.index);
        this.onShown();
    }

    /// Colours of cracks. All tests shown have the same time scale, since the legend has only one bar.
    private crackColours(views: readonly SpecimenView[]): CrackColours {
        return {
            by: this.settings.crackColour, listed: views.some((view) => view.listsBreaks),
            unlisted: views.some((view) => !view.listsBreaks && view.frames.has('state')),
            palette: sequentialPalette('cividis'), lastTime: Math.max(...views.map(({test}) => lastTimeOf(test))),
        };
    }

    private colours(frames: {view: SpecimenView; frame: Frame}[]): Colouring {
        const {quantity, settings} = this;
        // In tests of different rocks, the same number may denote different minerals.
        const minerals = frames.map(({view}) => mineralsOf(view.test.summary));
        const names = quantity.key === 'material' && minerals.every((one) => one.join('\n') === minerals[0]!.join('\n')) ? minerals[0] : [];
        return colouring(quantity, quantity.scaling === 'categorical' ? categories(frames.map(({view, frame}) => ({frame, cells: view.test.cells})), quantity) : this.range(frames, quantity), settings.map, currentTheme(), names);
    }

    /// Range over all frames or over those up to the peak. Until it is known, or if the setting is 'frame', over the shown frames.
    private range(frames: {view: SpecimenView; frame: Frame}[], quantity: Quantity): Range {
        const last = ({test}: SpecimenView) => (this.settings.range === 'peak' && peakFrame(test)) || test.frames.length - 1;
        const key = (view: SpecimenView) => `${view.test.index} ${quantity.key} ${last(view)}`;
        const known = frames.map(({view}) => this.ranges.get(key(view)));
        if (this.settings.range !== 'frame') {
            if (known.every((range) => range)) return joined(known as Range[]);
            this.inBackground(frames.filter(({view}) => !this.ranges.has(key(view))).map(({view}) => async () => {
                const name = key(view), end = last(view);
                if (!this.ranges.has(name)) this.ranges.set(name, await rangeUntil(end, view.frames, view.test.cells, quantity));
            }));
        }
        return rangeOfFrames(frames.map(({view, frame}) => ({frame, cells: view.test.cells})), quantity);
    }

    /// Scale for all tests on the page, so that widths remain comparable when other tests are shown, or for the shown tests only.
    private forceScale(frames: {view: SpecimenView; frame: Frame}[]): ForceScale {
        const views = this.settings.forcesOf === 'page' ? this.tests : frames.map(({view}) => view);
        const known = views.map((view) => this.forces.get(view.test));
        if (known.every((force) => force)) return joinedForces(known as ForceScale[]);
        this.inBackground(views.filter((view) => !this.forces.has(view.test)).map((view) => async () => {
            if (!this.forces.has(view.test)) this.forces.set(view.test, await forceScaleOfAll(view.frames));
        }));
        return forceScaleOf(frames.map(({frame}) => frame));
    }

    private working: Promise<void> | undefined;

    /// Runs tasks one after another, each of which reads all frames of a test, and then updates the picture.
    private inBackground(tasks: (() => Promise<void>)[]): void {
        if (this.working) return;
        this.working = (async () => {
            for (const task of tasks) await task();
            this.working = undefined;
            this.refresh();
        })();
    }

    /// Resolves when scales that cover all frames are known.
    async scaled(): Promise<void> {
        while (this.working) await this.working.then(() => new Promise((resume) => setTimeout(resume)));
        await this.settled();
    }
}
