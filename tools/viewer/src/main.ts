// SPDX-License-Identifier: GPL-3.0-or-later
// Builds the page: title, curves, viewer, breaks, fragments, summaries, drawings. Redraws the figures for printing, and when
// theme, view or size change.

import type {ECharts} from 'echarts/core';

import {currentTheme} from './colours/theme';
import {momentNear} from './controls/clock';
import {Inspector} from './controls/inspector';
import {listen} from './controls/keyboard';
import {expose} from './controls/test_access';
import {Viewer} from './controls/viewer';
import {ViewerControls} from './controls/viewer_controls';
import {particleCount} from './data/cells';
import {hasSlips, inArea, numberOf, readReport, stressUnitOf, type CurvedTest, type Report, type TestData} from './data/report';
import {labelTests, sortedBy, withCurve, type LabelledTest} from './data/test_labels';
import {SpecimenView} from './drawing/specimen_view';
import {button, checkbox, choice, element, saveFile} from './elements/dom';
import {breakCard, type MapSettings} from './panels/breaks';
import {directionWidth} from './panels/crack_directions';
import {CurvePanel, readoutOf} from './panels/curves';
import {DeckCurveFigure, deckPanels, withDeckCurves} from './panels/deck_curves';
import {findings} from './panels/findings';
import {fragmentCard} from './panels/fragments';
import {panels, viewsFor, type Panel, type View} from './panels/grouping';
import {brokenSpecimen, drawings, momentsOf, type Moments, magnifications} from './panels/specimen_cards';
import {summaryTable} from './panels/summary_table';
import {counted, quantity, strainFactor, useFileUnits, useStressUnits} from './quantities/units';

const viewNames: Record<View, string> = {kind: 'Kind of test', specimen: 'Specimen', test: 'Each test'};

const leastBeside = 700; // px, least width of the viewer for a curve beside the specimen
const mostBroken = 4; // tests of a panel whose broken specimens are drawn beside their curves
const brokenHeight = {alone: 430, below: 190}; // px, of these drawings

interface State {
    view: View;
    magnification: number;
}

class Page {
    private charts: CurvePanel[] = [];
    private deckFigures: DeckCurveFigure[] = [];
    private readonly deckHolder = element('div', {class: 'panels'});
    private beside: CurvePanel | undefined; // curve beside a test that is shown alone
    private readonly besideHolder = element('div', {class: 'beside-curve'});
    private readonly front = element('div', {class: 'front'});
    private readonly state: State = {view: 'kind', magnification: 1};
    private readonly tests: LabelledTest[];
    private readonly views: SpecimenView[];
    private viewer: Viewer | undefined;
    private controls: ViewerControls | undefined;
    private moments: Moments[] = [];
    private breakCharts: ECharts[] = [];
    private readonly map: MapSettings = {colour: 'mode', slips: true};
    private readonly breakHolder = element('div', {class: 'cards'});
    private readonly fragmentHolder = element('div', {class: 'cards'});
    private readonly fragmentSection = element('section', {id: 'fragments', hidden: ''});
    private readonly panelHolder = element('div', {class: 'panels'});
    private readonly cardHolder = element('div', {class: 'cards'});

    constructor(private readonly report: Report, private readonly root: HTMLElement) {
        this.tests = labelTests(report.tests);
        this.views = this.tests.map((labelled) => new SpecimenView(labelled));
        document.title = report.title;
        document.documentElement.dataset['view'] = report.view;
        this.layOut();
    }

    /// Draws the parts that need no frames, the viewer first, and then the parts that need frames.
    async draw(): Promise<void> {
        this.applyTheme();
        if (this.viewer) {
            this.viewer.start();
            this.controls?.build();
            await this.firstPicture(this.viewer);
        }
        this.drawCurves();
        this.drawDeckCurves();
        this.drawBreaks();
        this.watch();
        for (const view of this.views) this.moments.push(await momentsOf(view));
        this.drawBroken();
        this.drawFragments();
        this.drawSpecimens();
    }

    private layOut(): void {
        this.fragmentSection.append(element('h2', {}, 'Fragments at the end'), this.fragmentHolder,
            element('p', {class: 'caption'}, 'Particles joined by unbroken bonds share a colour; the largest fragment is drawn in the neutral particle colour.'));
        const curved = withCurve(this.tests);
        const unfinished = curved.filter(({test}) => !test.failed);
        const curves = curved.length === 0 ? [] : [this.curveSection(curved)];
        const viewer = this.viewerSection();
        this.root.replaceChildren(
            element('header', {}, element('div', {}, element('h1', {}, this.report.title), element('p', {class: 'about'}, this.about())), this.themeButton()),
            ...(unfinished.length === 0 ? [] : [element('p', {class: 'notice warning', role: 'note'},
                `Not failed: ${unfinished.map(({label, test}) => label + endedBy(test.summary['ended_by'])).join('; ')}. What is shown as the peak of ${unfinished.length === 1 ? 'this test' : 'these tests'} is the peak so far.`)]),
            ...(this.report.view === 'view' ? [viewer, ...curves] : [...this.findingsSection(curved), ...curves, viewer]),
            ...this.deckSection(),
            ...(this.tests.some(({test}) => onMap(test)) ? [this.breakSection()] : []),
            this.fragmentSection,
            ...(curved.length === 0 ? [] : [element('section', {id: 'summary'}, element('h2', {}, 'Summary'), summaryTable(curved))]),
            ...(this.tests.some(({test}) => test.frames.some(({roles}) => roles)) ? [this.drawingSection()] : []),
            element('footer', {}, `Made by crackle ${this.report.version}. Strictly 2D: ${this.unitsText()}`));
    }

    private unitsText(): string {
        const {tests, units} = this.report;
        if (tests.every(({source}) => source === 'test')) return this.testUnitsText();
        if (units) return `forces are in ${units.force}, stresses in ${units.stress}, for a slice of unit thickness.`;
        const own = 'lengths, forces and stresses are shown as the numbers of';
        const name = tests.every(({source}) => source !== 'test') ? 'the deck, which does not state its units (name them with crackle view --units)' : 'each file, in the units of that file';
        return `${own} ${name}; times are in s.`;
    }

    private testUnitsText(): string {
        const area = 'if stiffnesses are given per area, stresses and moduli are those of a slice, in Pa.';
        const length = 'stresses and moduli are forces per unit length, N/m';
        const tests = this.report.tests.filter(({source}) => source === 'test');
        if (!tests.some(inArea)) return `${length}.`;
        return tests.every(inArea) ? 'stresses and moduli are those of a slice, in Pa.' : `${length}; ${area}`;
    }

    private findingsSection(curved: LabelledTest<CurvedTest>[]): HTMLElement[] {
        if (curved.length === 0) return [];
        return [element('section', {id: 'findings'}, ...findings(sortedBy('kind', curved) as LabelledTest<CurvedTest>[]))];
    }

    private curveSection(curved: LabelledTest<CurvedTest>[]): HTMLElement {
        const views = viewsFor(curved.map(({test}) => test)).map((value) => ({value, text: viewNames[value]}));
        return element('section', {id: 'curves'},
            element('h2', {}, 'Stress, strain and bond breaks'),
            ...(views.length > 1 ? [element('div', {class: 'controls'}, choice('One panel for each', views, this.state.view, (value) => {
                this.state.view = value;
                this.drawCurves();
            }))] : []),
            this.panelHolder,
            element('p', {class: 'hint'}, 'A click on a curve shows the specimens at that strain. Shift and wheel zoom the strain axis, dragging moves it, a double click resets it.'),
            element('p', {class: 'caption'},
                'Stress is the mean of the two platens’ forces over the initial width, strain the platen displacement over the initial height (for tests without platens, they are defined by the kind of test: Hondros’ stress for a disc, fibre stress for a beam). Both are positive in ',
                'the loading direction. Below the curves: bonds broken in each interval of strain, by mode (', mark('tension'), ' tension, ', mark('shear'), ' shear), ',
                'and the total so far as a line.',
                ...(curved.some(({test}) => hasSlips(test)) ? [' Separate strips show slips (', mark('slid'), `): ${slipMeaning}.`] : [])));
    }

    private deckSection(): HTMLElement[] {
        const decks = withDeckCurves(this.tests);
        if (decks.length === 0) return [];
        const cut = decks.filter(({test: {deck}}) => deck.watched > Math.max(deck.bodies.length, deck.velocities.length))
            .map(({label, test: {deck}}) => `${label}: the first ${Math.max(deck.bodies.length, deck.velocities.length)} of ${deck.watched} watched bodies.`);
        return [element('section', {id: 'deck-curves'}, element('h2', {}, 'Energy and watched bodies'),
            element('div', {class: 'controls'}, element('span', {class: 'hint'}, 'A click shows the specimen at that time. Shift and wheel zoom the time axis, dragging moves it, a double click resets it.')),
            this.deckHolder,
            element('p', {class: 'caption'}, 'From energy.dat, f-d_curve.dat and velocity_y.dat: parts of the energy that are always 0 are left out; displacements are relative to the first row of a body.', ...cut.map((text) => ` ${text}`)))];
    }

    private viewerSection(): HTMLElement {
        const large = this.report.view === 'view';
        const section = element('section', {id: 'viewer', class: large ? 'large' : ''}, ...(large ? [] : [element('h2', {}, 'Specimens in motion')]));
        const shown = this.views.filter(({test}) => test.frames.length > 0);
        if (shown.length === 0) {
            section.append(element('p', {class: 'hint'}, 'There are no frames to show.'));
            return section;
        }
        try {
            this.viewer = new Viewer(shown, large);
        } catch (error) {
            section.append(element('p', {class: 'notice warning'}, `This browser does not support WebGL 2, so the specimens in motion are not shown: ${String(error)}`));
            return section;
        }
        const {viewer} = this, controls = new ViewerControls(viewer), inspector = new Inspector(viewer);
        this.controls = controls;
        controls.panel.prepend(inspector.element);
        section.append(element('div', {class: 'viewer'}, this.front, controls.panel, controls.help));
        this.front.append(viewer.stageElement, this.besideHolder, controls.transport);
        viewer.onShown = () => {
            controls.update();
            this.drawBeside();
            inspector.update();
            this.moveCursors();
        };
        listen(viewer, controls, section, large);
        return section;
    }

    private breakSection(): HTMLElement {
        const slips = this.tests.some(({test}) => hasSlips(test));
        return element('section', {id: 'breaks'},
            element('h2', {}, 'Positions and directions of bond breaks'),
            element('div', {class: 'controls'}, choice<MapSettings['colour']>('Colour by', [{value: 'mode', text: 'Mode'}, {value: 'time', text: 'Time'}], this.map.colour, (colour) => {
                this.map.colour = colour;
                this.drawBreaks();
            }), ...(slips ? [checkbox('Slips', this.map.slips, (shown) => {
                this.map.slips = shown;
                this.drawBreaks();
            })] : [])),
            this.breakHolder,
            element('p', {class: 'caption'}, 'Map: position of each broken bond, the area of its circle proportional to its energy (', mark('tension'), ' tension, ', mark('shear'),
                ' shear; by time: dark is early, bright is late).',
                ...(slips ? [' Lines along the contacts (', mark('slid'), `, or coloured by time): slips, ${slipMeaning}.`] : []), ' Rose: directions of the cracks, perpendicular to the contact normals; breaks in each ',
                `${directionWidth}°, counted in both directions. The loading axis is at 90°.`));
    }

    private drawBreaks(): void {
        for (const chart of this.breakCharts) chart.dispose();
        const theme = currentTheme();
        const cards = sortedBy('specimen', this.tests.filter(({test}) => onMap(test))).map((labelled) => breakCard(labelled, this.map, theme));
        this.breakHolder.replaceChildren(...cards.map(({element: card}) => card));
        this.breakCharts = cards.flatMap(({draw}) => draw());
    }

    private drawFragments(): void {
        const theme = currentTheme();
        const cards = this.moments.flatMap((moments) => fragmentCard(moments, theme) ?? []);
        this.fragmentSection.hidden = cards.length === 0;
        this.fragmentHolder.replaceChildren(...cards);
    }

    private drawingSection(): HTMLElement {
        return element('section', {id: 'specimens'},
            element('h2', {}, 'Specimens and broken bonds'),
            element('div', {class: 'controls'}, choice('Displacements', magnifications.map((value) => ({value: String(value), text: `×${value}`})), '1', (value) => {
                this.state.magnification = Number(value);
                this.drawSpecimens();
            }), element('span', {class: 'legend'}, 'Broken in ', mark('tension'), ' tension, ', mark('shear'),
                ' shear; dotted: some bonded points of the interface are still intact.')),
            this.cardHolder);
    }

    private about(): string {
        const count = this.tests.length;
        const curved = withCurve(this.tests).length;
        if (curved === 0) return this.tests.map(({test}) => `${test.name}: ${countOf(particleCount(test.cells), 'particle')}, ${countOf(test.frames.length, 'frame')}`).join(' · ');
        if (count === 1) return `Virtual test: ${this.tests[0]!.label} of ${countOf(particleCount(this.tests[0]!.test.cells), 'particle')}${sizeOf(this.tests[0]!.test)}`;
        return `${count} virtual tests: ${this.tests.map(({label}) => label).join(' · ')}`;
    }

    private themeButton(): HTMLElement {
        return button('Light / dark', 'Switch between light and dark', () => {
            document.documentElement.dataset['theme'] = currentTheme().name === 'dark' ? 'light' : 'dark';
            this.redraw();
        }, {class: 'theme'});
    }

    private applyTheme(): void {
        const theme = currentTheme();
        document.documentElement.dataset['shown'] = theme.name;
        document.documentElement.style.setProperty('--tension', theme.tension);
        document.documentElement.style.setProperty('--shear', theme.shear);
        document.documentElement.style.setProperty('--slid', theme.slid);
    }

    private redraw(): void {
        this.applyTheme();
        this.drawCurves();
        this.drawDeckCurves();
        this.drawBreaks();
        this.drawFragments();
        this.drawSpecimens();
        this.viewer?.refresh();
    }

    private async firstPicture(viewer: Viewer): Promise<void> {
        await new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
        await viewer.picture.stage.finished();
        document.documentElement.dataset['firstPicture'] = performance.now().toFixed(0);
    }

    private drawCurves(): void {
        for (const {chart} of this.charts) chart.dispose();
        this.beside?.chart.dispose();
        this.beside = undefined;
        const theme = currentTheme();
        const shown = panels(withCurve(this.tests), this.state.view).map((panel) => ({...panel, measured: this.report.measured}));
        this.panelHolder.classList.toggle('single', shown.length === 1);
        const holders = shown.map((panel) => {
            const figure = element('div', {class: 'panel'});
            const save = element('button', {type: 'button', class: 'save', title: 'Save this figure as SVG'}, 'SVG');
            const chart = element('div', {class: 'chart'}, figure, save);
            const drawn = panel.members.length <= mostBroken ? panel.members.filter(({test}) => test.frames.some(({roles}) => roles)) : [];
            const broken = drawn.map(({test, shortLabel}) => element('div', {class: 'broken', 'data-test': test.name, 'data-name': shown.length === 1 && drawn.length === 1 ? '' : shortLabel}));
            const curve = element('div', {class: 'curve'}, chart);
            const holder = element('div', {class: broken.length === 0 ? 'frame' : 'frame with-broken', 'data-panel': panel.title},
                curve, ...(broken.length === 0 ? [] : [element('div', {class: 'broken-row'}, ...broken)]));
            return {panel, figure, save, holder, curve};
        });
        this.panelHolder.replaceChildren(...holders.map(({holder}) => holder));
        this.charts = holders.map(({panel, figure, save, curve}) => {
            const drawn = new CurvePanel(figure, panel, theme, (value) => {
                this.goToStrain(panel, value * strainFactor);
                this.showViewer();
            });
            save.addEventListener('click', () => saveFile(`${panel.title.toLowerCase()}.svg`, 'image/svg+xml', drawn.asSvg()));
            curve.append(readoutOf(drawn, theme));
            drawn.chart.on('datazoom', () => this.moveCursors());
            return drawn;
        });
        this.drawBeside();
        this.drawBroken();
        this.moveCursors();
    }

    /// Draws the specimens at the end of their tests beside the curves.
    private drawBroken(): void {
        const theme = currentTheme();
        for (const holder of this.panelHolder.querySelectorAll<HTMLElement>('.broken')) {
            const moments = this.moments.find(({view}) => view.test.name === holder.dataset['test']);
            const name = holder.dataset['name']!, height = name === '' ? brokenHeight.alone : brokenHeight.below;
            if (moments) holder.replaceChildren(brokenSpecimen(moments, height, holder.clientWidth, name, theme));
        }
    }

    /// Draws the curve of a test that is shown alone, in the free space beside its specimen.
    private drawBeside(): void {
        const {viewer} = this, alone = viewer?.chosen.length === 1 ? viewer.chosen[0]!.labelled : undefined;
        const [curved] = alone ? withCurve([alone]) : [];
        const wanted = curved !== undefined && this.front.clientWidth >= leastBeside;
        this.front.classList.toggle('beside', wanted);
        if (!wanted || this.beside?.panel.members[0]?.test !== curved.test) {
            this.beside?.chart.dispose();
            this.beside = undefined;
        }
        if (!wanted || this.beside) return;
        const panel: Panel = {...panels([curved], 'test')[0]!, measured: this.report.measured};
        const figure = element('div', {class: 'panel'}), theme = currentTheme();
        this.besideHolder.replaceChildren(figure);
        this.beside = new CurvePanel(figure, panel, theme, (value) => this.goToStrain(panel, value * strainFactor), () => viewer!.stageElement.clientHeight - 70);
        this.besideHolder.append(readoutOf(this.beside, theme));
        this.beside.chart.on('datazoom', () => this.moveCursors());
        this.moveCursors();
    }

    /// Scrolls to the viewer if it is out of view, after a click on a curve has moved the specimens.
    private showViewer(): void {
        const stage = this.viewer?.stageElement, box = stage?.getBoundingClientRect();
        if (!stage || !box) return;
        const seen = Math.min(innerHeight, box.bottom) - Math.max(0, box.top);
        if (seen < 0.6 * Math.min(box.height, innerHeight)) stage.scrollIntoView({block: 'nearest'});
    }

    /// Moves each curve's cursor to the frame that its specimen shows.
    private moveCursors(): void {
        const theme = currentTheme();
        for (const {panel, cursor} of [...this.charts, ...(this.beside ? [this.beside] : [])]) {
            cursor.show(panel.members.flatMap((member) => {
                const strain = this.viewer?.shownOf(member.test)?.strain;
                return strain === undefined ? [] : [{value: strain / strainFactor, colour: theme.series[member.colour % theme.series.length]!}];
            }));
        }
        for (const figure of this.deckFigures) figure.showTime(this.viewer?.shownOf(figure.panel.test)?.time);
    }

    private drawDeckCurves(): void {
        for (const figure of this.deckFigures) figure.dispose();
        const theme = currentTheme(), decks = withDeckCurves(this.tests);
        this.deckFigures = decks.flatMap((deck) => deckPanels(deck, decks.length > 1)).map((panel) => new DeckCurveFigure(panel, theme, (time) => {
            this.goTo(({test}) => test === panel.test, 'time', time);
            this.showViewer();
        }));
        this.deckHolder.replaceChildren(...this.deckFigures.map(({element: figure}) => figure));
        for (const figure of this.deckFigures) {
            figure.draw();
            figure.onZoom(() => this.moveCursors());
        }
        this.moveCursors();
    }

    private goToStrain(panel: Panel, strain: number): void {
        this.goTo(({test}) => panel.members.some((member) => member.test === test), 'strain', strain);
    }

    /// @param ofPanel returns whether the panel that was clicked shows a test
    private goTo(ofPanel: (view: SpecimenView) => boolean, axis: 'strain' | 'time', value: number): void {
        const {viewer} = this;
        if (!viewer) return;
        let view = viewer.chosen.find(ofPanel);
        if (!view) {
            // If no test of the panel is shown, the panel's first test is shown.
            view = viewer.tests.find(ofPanel);
            if (!view) return;
            viewer.choose({test: viewer.tests.indexOf(view)});
            this.controls?.build();
        }
        viewer.clock.goTo(momentNear(view.test, viewer.clock.axis, axis, value));
    }

    private drawSpecimens(): void {
        this.cardHolder.replaceChildren(...drawings(this.moments, this.state.magnification, currentTheme()));
    }

    private watch(): void {
        new ResizeObserver(() => {
            for (const chart of this.charts) chart.resize();
            this.moveCursors();
        }).observe(this.panelHolder);
        new ResizeObserver(() => {
            for (const figure of this.deckFigures) figure.resize();
            this.moveCursors();
        }).observe(this.deckHolder);
        new ResizeObserver(() => {
            this.drawBeside();
            this.beside?.resize();
            this.moveCursors();
        }).observe(this.front);
        matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.redraw());
        const paper = (printing: boolean) => {
            if (printing) document.documentElement.dataset['printing'] = 'true';
            else delete document.documentElement.dataset['printing'];
            this.redraw();
            this.viewer?.picture.stage.drawStill(); // the printer uses the current picture
        };
        addEventListener('beforeprint', () => paper(true));
        addEventListener('afterprint', () => paper(false));
    }

    get shownViewer(): Viewer | undefined {
        return this.viewer;
    }
}

const slipMeaning = 'bonds that reached their Coulomb limit for the first time; they are not among the breaks unless they broke later';

/// Whether the test has breaks or slips to show on the map.
function onMap(test: TestData): boolean {
    return test.events.count > 0 || hasSlips(test);
}

function countOf(count: number, what: string): string {
    return `${counted(count)} ${what}${count === 1 ? '' : 's'}`;
}

/// Width and height of a specimen, such as ", 50 mm × 100 mm"; empty if the summary lacks them.
function sizeOf({summary}: TestData): string {
    const width = numberOf(summary, 'initial_width'), height = numberOf(summary, 'initial_height');
    return width === undefined || height === undefined ? '' : `, ${quantity(width, 'm')} × ${quantity(height, 'm')}`;
}

function endedBy(reason: unknown): string {
    return typeof reason === 'string' && reason !== '' ? ` (ended by ${reason})` : '';
}

function mark(kind: 'tension' | 'shear' | 'slid'): HTMLElement {
    return element('i', {class: `mark ${kind}`});
}

async function start(): Promise<void> {
    const root = document.getElementById('page')!;
    try {
        const report = await readReport(document.getElementById('crackle-data'));
        if (report.tests.some(({source}) => source !== 'test')) useFileUnits(report.units);
        else useStressUnits([...new Set(report.tests.map(stressUnitOf))].sort());
        const page = new Page(report, root);
        if (page.shownViewer) expose(page.shownViewer);
        await page.draw();
        document.documentElement.dataset['ready'] = 'true';
    } catch (error) {
        root.replaceChildren(element('p', {class: 'notice warning'}, `This page cannot be shown: ${error instanceof Error ? error.message : String(error)}`));
        throw error;
    }
}

void start();
